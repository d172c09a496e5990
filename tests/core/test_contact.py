from dataclasses import replace

import numpy as np
import pytest
import shapely

from seiswidgets.core.contact import contacts
from seiswidgets.core.mesh import Mesh
from tests.core.meshes import BLIND, PLANAR, arc, chain, cut_along, rotated, smooth

RADIUS, CENTRE = 1500.0, (1500.0, -300.0)


def two_sided(line):
    """Two copies of a drawn line's points, as the sides of a fault without any rock: vertices and both contacts."""
    points = shapely.get_coordinates(line)
    count = len(points)
    mesh = Mesh(np.vstack([points, points]), np.empty((0, 3)))
    sides = np.stack([chain(np.arange(count)), chain(np.arange(count, 2 * count))])
    return mesh.vertices, contacts(mesh, sides, smooth(line), 1.0, "contact")


def moved(vertices, motion):
    """The first half of the vertices moved, the other held."""
    half = len(vertices) // 2
    return np.vstack([motion(vertices[:half]), vertices[half:]])


def flat(term):
    """The term without bulges."""
    return replace(term, bulge=0 * term.bulge)


def largest(term, vertices):
    return np.abs(term.with_contacts(vertices).residual(vertices)).max()


STRAIGHT = shapely.LineString(np.outer(np.linspace(0, 1, 9) ** 1.5, [300, 600]))


@pytest.mark.parametrize(("share", "turn"), [(-0.8, 1.0), (0.0, 0.0), (0.25, 0.0), (0.77, 1.0)])
def test_sliding_along_a_straight_fault_costs_nothing(share, turn):
    rest, terms = two_sided(STRAIGHT)
    vertices = rotated(moved(rest, lambda points: points + np.multiply(share, [300, 600])), turn)
    for term in terms:
        np.testing.assert_allclose(term.with_contacts(vertices).residual(vertices), 0, atol=1e-10)


@pytest.mark.parametrize("distance", [-40.0, 5.0])
def test_the_residual_is_the_distance(distance):
    rest, terms = two_sided(STRAIGHT)
    normal = np.array([-2.0, 1.0]) / np.sqrt(5)  # from x towards z: the positive side
    vertices = moved(rest, lambda points: points + distance * normal)
    for term, sign in zip(terms, (1, -1), strict=True):
        held = replace(term, weight=3.0).with_contacts(vertices)
        np.testing.assert_allclose(held.residual(vertices), sign * 3 * distance, atol=1e-9)


def errors_by_chord(simplify):
    """Largest residual, for ever shorter chords, of a circular fault's side turned about the circle's centre."""
    errors = []
    for chord in (125.0, 62.5, 31.25):
        rest, terms = two_sided(arc(chord, RADIUS, CENTRE))
        turn = 2.5 * chord / RADIUS  # vertices come to lie over the middle of chords, where the error is largest
        vertices = moved(rest, lambda points, turn=turn: rotated(points, turn, CENTRE))
        errors.append(max(largest(simplify(term), vertices) for term in terms))
    return np.array(errors)


def test_a_polygonal_fault_catches_by_its_sagitta():
    errors = errors_by_chord(flat)
    np.testing.assert_allclose(errors, np.array([125, 62.5, 31.25]) ** 2 / (8 * RADIUS), rtol=0.02)


def test_bulges_let_a_circular_fault_turn():
    errors = errors_by_chord(lambda term: term)
    rates = np.log2(errors[:-1] / errors[1:])
    np.testing.assert_allclose(rates, 4, atol=0.2)
    assert errors[0] < 1e-2 * 125**2 / (8 * RADIUS)


@pytest.mark.parametrize("spacing", [30.0, 60.0, 200.0])
def test_bulges_serve_a_mesh_of_any_spacing(spacing):
    """Mesh edges shorter and longer than drawn chords of 60 m."""
    line = arc(60.0, RADIUS, CENTRE)
    cut, sides = cut_along(line, spacing=spacing)
    mesh = cut.mesh
    turned = mesh.blocks == mesh.blocks[sides[1, 0, 0]]
    vertices = np.where(turned[:, None], rotated(mesh.vertices, 0.07, CENTRE), mesh.vertices)
    for term in contacts(mesh, sides, smooth(line), 1.0, "contact"):
        assert largest(term, vertices) < 0.02
        assert largest(flat(term), vertices) > 0.05


def test_beyond_the_end_nothing_is_known():
    rest, (term, _) = two_sided(STRAIGHT)
    half, ahead = len(rest) // 2, STRAIGHT.interpolate(0.5, normalized=True).coords[0]
    vertices = moved(rest, lambda points: points + ahead)
    along = np.linalg.norm(vertices[:half], axis=1) / STRAIGHT.length
    held = term.with_contacts(vertices)
    np.testing.assert_array_equal(held.partner >= 0, along <= 1 + 1e-9)
    assert len(held.residual(vertices)) == (along <= 1 + 1e-9).sum() < half
    np.testing.assert_array_equal(held.target(vertices)[held.partner < 0], vertices[:half][held.partner < 0])


def test_all_silent_is_an_empty_term():
    rest, (term, _) = two_sided(STRAIGHT)
    vertices = moved(rest, lambda points: np.add(points, (300, 601)))
    held = term.with_contacts(vertices)
    assert held.residual(vertices).shape == (0,)
    assert held.jacobian(vertices).shape == (0, vertices.size)


def test_the_tips_of_a_blind_fault_are_in_no_contact():
    cut, sides = cut_along(BLIND)
    tips = {sides[0, 0, 0], sides[0, -1, 1]}
    for term, side in zip(contacts(cut.mesh, sides, BLIND, 1.0, "contact"), sides, strict=True):
        assert {*term.points} == {*side.ravel()} - tips
        assert (term.with_contacts(cut.mesh.vertices).partner >= 0).all()


def test_both_sides_see_each_other():
    cut, sides = cut_along(PLANAR)
    for term, side, other in zip(contacts(cut.mesh, sides, PLANAR, 1.0, "c"), sides, sides[::-1], strict=True):
        assert {*term.points} == {*side.ravel()}
        np.testing.assert_array_equal(term.segments, other)


@pytest.mark.parametrize("bend", [-30.0, 30.0])
def test_the_distance_is_continuous_where_the_partner_changes(bend):
    """At a corner both segments are equally far on the bisector, inside the bend and outside."""
    line = shapely.LineString([(0, 0), (100, 0), (200, bend)])
    rest, (term, _) = two_sided(line)
    distances, partners = [], []
    for way in np.linspace(80, 120, 401):
        vertices = rest.copy()
        vertices[term.points[0]] = (way, 20.0)
        term = term.with_contacts(vertices)
        distances.append(term.distances(vertices)[0])
        partners.append(term.partner[0])
    assert set(partners) == {0, 1}
    assert np.abs(np.diff(distances)).max() < 0.1


@pytest.mark.parametrize(("way", "partner"), [(0.95, 0), (1.05, 0), (1.09, 0), (1.11, 1)])
def test_a_partner_that_was_returned_to_is_kept_a_little_beyond_its_end(way, partner):
    line = shapely.LineString([(0, 0), (100, 0), (200, 0)])
    rest, (term, _) = two_sided(line)
    for x in (90, 110, 90):
        term = term.with_contacts(moved(rest, lambda points, x=x: np.add(points, (x, 0))))
        assert term.partner[0] == (x > 100)
    assert term.with_contacts(moved(rest, lambda points: np.add(points, (100 * way, 0)))).partner[0] == partner


def test_without_a_partner_the_nearest_is_taken():
    line = shapely.LineString([(0, 0), (100, 0), (200, 0)])
    rest, (term, _) = two_sided(line)
    assert term.with_contacts(moved(rest, lambda points: np.add(points, (105, 0)))).partner[0] == 1
