"""A ramp that branches off a floor: three blocks, and the sides that may come to lie on each other."""

from dataclasses import replace

import numpy as np
import pytest
import shapely

from seiswidgets.core.contact import contacts
from seiswidgets.core.junctions import continuations
from seiswidgets.core.triangulation import edges_along, triangulate

OUTLINE, FOOT = shapely.box(0, 0, 4000, 1000), (2000.0, 800.0)
FLOOR, SPACING = shapely.LineString([(0, 800), (4000, 800)]), 150.0
FLOOR_SIDES = {"above": 1, "below": 0}  # of a line drawn to the right
RAMP_SIDES = {"sheet": 1, "toe": 0}  # of a line drawn up to the right: above it, and between it and the floor


@pytest.fixture(params=[25, 40, 70])
def branch(request):
    """The cut mesh, both sides of floor and ramp, and what continues them."""
    dip = np.radians(request.param)
    ramp = shapely.LineString([FOOT, (FOOT[0] + 800 / np.tan(dip), 0)])
    mesh = triangulate(OUTLINE, [FLOOR, ramp], SPACING)
    edges = [edges_along(mesh, line, SPACING) for line in (FLOOR, ramp)]
    cut = mesh.cut(np.concatenate(edges))
    sides = [cut.sides(along) for along in edges]
    return request.param, cut, sides, continuations(mesh.vertices, edges, sides)


def test_the_sheet_that_slides_off_a_ramp_lands_on_the_floor(branch):
    dip, _, (floor, _), (_, of_ramp) = branch
    sheet, toe = of_ramp[RAMP_SIDES["sheet"]], of_ramp[RAMP_SIDES["toe"]]
    if dip > 45:  # it would have to turn too sharply
        assert not len(sheet.segments)
        return
    below = {tuple(edge) for edge in floor[FLOOR_SIDES["below"]].tolist()}
    landing = {tuple(sorted(edge)) for edge in sheet.segments.tolist()}
    assert landing == {tuple(sorted(edge)) for edge in below}
    above = {tuple(sorted(edge)) for edge in floor[FLOOR_SIDES["above"]].tolist()}
    assert {tuple(sorted(edge)) for edge in toe.segments.tolist()} <= above


def test_continuations_have_their_rock_on_the_same_hand_as_the_opposite_side(branch):
    _, cut, sides, found = branch
    for pair, continued in zip(sides, found, strict=True):
        for side, continuation in enumerate(continued):
            for edge in [*pair[1 - side].tolist(), *continuation.segments.tolist()]:
                assert _rock_on_the_right(cut.mesh, edge) == (side == 1)


def _rock_on_the_right(mesh, edge):
    """True if the triangle at a directed border edge follows it in its own sense."""
    return tuple(edge) in {tuple(half_edge) for half_edge in mesh.boundary.tolist()}


def test_a_side_beyond_its_end_is_held_to_the_continuation(branch):
    """Slide the sheet along the floor past the foot of the ramp: its ramp side hangs over the floor, or lies on it."""
    dip, cut, sides, found = branch
    if dip > 45:
        return
    mesh = cut.mesh
    sheet = mesh.blocks == mesh.blocks[sides[1][RAMP_SIDES["sheet"], 0, 0]]
    vertices = mesh.vertices - np.outer(sheet, [700.0, 0.0])
    line = shapely.LineString([FOOT, (FOOT[0] + 800 / np.tan(np.radians(dip)), 0)])
    term = contacts(mesh, sides[1], line, 1.0, "contact", found[1])[RAMP_SIDES["sheet"]].with_contacts(vertices)
    assert (term.partner >= term.own).sum() >= 2
    height = FOOT[1] - vertices[term.held_points, 1]
    on_floor = term.partner[term.partner >= 0] >= term.own
    np.testing.assert_allclose(np.abs(term.distances(vertices))[on_floor], height[on_floor], atol=1e-6)


def test_a_point_that_keeps_its_partner_a_little_beyond_an_end_does_not_where_the_floor_goes_on(branch):
    """It would sink into the floor by its distance from the end times the sine of the turn."""
    dip, cut, sides, found = branch
    if dip > 45:
        return
    mesh = cut.mesh
    sheet = mesh.blocks == mesh.blocks[sides[1][RAMP_SIDES["sheet"], 0, 0]]
    line = shapely.LineString([FOOT, (FOOT[0] + 800 / np.tan(np.radians(dip)), 0)])
    term = contacts(mesh, sides[1], line, 1.0, "contact", found[1])[RAMP_SIDES["sheet"]].with_contacts(mesh.vertices)
    returning = replace(term, stay=np.full(len(term.points), 0.5))
    slid = returning.with_contacts(mesh.vertices - np.outer(sheet, [40.0, 0.0]))
    foot = np.argmax(mesh.vertices[term.points, 1])
    assert slid.partner[foot] >= term.own
