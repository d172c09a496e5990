"""The smooth curve through a drawn line: it recovers an arc from a few points; corners and straights stay."""

import numpy as np
import pytest
import shapely

from seiswidgets.core.curves import CORNER, along_curve, move_onto, smooth_curve
from seiswidgets.core.triangulation import edges_along, triangulate
from tests.core.meshes import BOX, arc, rotated

RADIUS, TOLERANCE = 4000.0, 0.01


def on_arc(degrees):
    angles = np.radians(degrees)
    return RADIUS * np.column_stack([np.sin(angles), np.cos(angles)])


@pytest.mark.parametrize(
    ("degrees", "error"),
    [
        (np.linspace(35, 62, 4), 0.05),
        (np.linspace(62, 35, 7), 0.01),
        ([35, 41, 45, 53, 57, 62], 0.02),
        (np.linspace(10, 70, 4), 0.5),
    ],
    ids=["4 points", "7 points, drawn the other way", "unevenly", "turns of 20 degrees"],
)
def test_a_few_points_of_an_arc_give_the_arc(degrees, error):
    curve = smooth_curve(on_arc(degrees), TOLERANCE)
    assert np.abs(np.hypot(*curve.T) - RADIUS).max() < error
    chords = shapely.LineString(on_arc(degrees))
    assert shapely.distance(chords, shapely.points(curve)).max() > 50 * error


def test_the_curve_passes_through_the_points_and_does_not_depend_on_the_axes():
    points = np.array([(0, 0), (300, 30), (500, 70), (900, 100), (1000, 400), (1020, 600)], float)
    curve = smooth_curve(points, TOLERANCE)
    assert all((curve == point).all(axis=1).any() for point in points)
    np.testing.assert_allclose(smooth_curve(points[::-1], TOLERANCE), curve[::-1], atol=1e-9)
    np.testing.assert_allclose(smooth_curve(rotated(points, 2.0), TOLERANCE), rotated(curve, 2.0), atol=1e-9)
    again = smooth_curve(curve, TOLERANCE)
    assert shapely.hausdorff_distance(shapely.LineString(again), shapely.LineString(curve)) < 3 * TOLERANCE


@pytest.mark.parametrize(("turn", "bends"), [(9.0, True), (11.0, False), (-11.0, False), (90.0, False), (0.0, False)])
def test_larger_turns_are_corners(turn, bends):
    end = [100 + 100 * np.cos(np.radians(turn)), 100 * np.sin(np.radians(turn))]
    points = np.array([(0, 0), (100, 0), end])
    assert (len(smooth_curve(points, TOLERANCE)) > 3) == bends == (0 < abs(np.radians(turn)) <= CORNER)


@pytest.mark.parametrize(("next_turn", "bends"), [(15, True), (8, True), (5, False), (-15, False), (30, False)])
def test_a_large_turn_is_smooth_in_a_series_only(next_turn, bends):
    """A listric fault keeps on turning; a ramp turns back, or ends on a flat."""
    angles = np.radians(np.cumsum([0, 15, next_turn]))
    points = np.append([[0, 0]], 300 * np.cumsum(np.column_stack([np.cos(angles), np.sin(angles)]), axis=0), axis=0)
    curve = smooth_curve(points, TOLERANCE)
    assert (np.abs(curve[curve[:, 0] < 299, 1]).max() > 1) == bends


def test_two_points_are_a_straight_line():
    np.testing.assert_array_equal(smooth_curve(on_arc([30, 60]), TOLERANCE), on_arc([30, 60]))


def test_a_long_segment_bends_only_near_a_short_one():
    curve = smooth_curve(np.array([(0, 0), (3000, 0), (3100, 12), (3200, 36.0)]), TOLERANCE)
    np.testing.assert_array_equal(curve[curve[:, 0] < 2790, 1], 0)
    assert np.abs(curve[curve[:, 0] < 3000, 1]).max() < 3


def test_along_a_curve():
    line = shapely.LineString([(0, 0), (100, 0), (100, 100)])
    points = shapely.get_coordinates(along_curve(line, [130.0, 100.0, -1e-9, 100.0], 60))
    np.testing.assert_allclose(points, [(0, 0), (50, 0), (100, 0), (100, 30), (100, 65), (100, 100)], atol=1e-9)


def test_vertices_move_onto_the_curve():
    curve = shapely.LineString(smooth_curve(shapely.get_coordinates(arc(150.0)), 1e-4))
    chords = along_curve(curve, [], 150.0)
    mesh = triangulate(BOX, [chords], 60)
    edges = edges_along(mesh, chords, 60)
    moved = move_onto(mesh, edges, curve)
    inner = np.setdiff1d(edges, mesh.boundary)  # the border stays straight
    before, after = (shapely.distance(curve, shapely.points(at.vertices[inner])) for at in (mesh, moved))
    assert after.max() < 1e-9 < before.max()
    assert moved.areas.min() > 0
    assert move_onto(moved, edges, curve) is moved or np.allclose(
        moved.vertices, move_onto(moved, edges, curve).vertices
    )
