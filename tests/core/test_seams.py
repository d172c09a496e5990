import numpy as np
import pytest
import shapely
from shapely import Polygon, box

from seiswidgets.core.mapping import PiecewiseAffineMap
from seiswidgets.core.mesh import triangle_areas
from seiswidgets.core.seams import new_holes, outline, weld_seams
from seiswidgets.core.triangulation import triangulate
from tests.core.meshes import BOX, PLANAR, arc, cut_along, rotated

CENTRE = (1500.0, -300.0)  # of the arcs


def slid(line, motion):
    """The box cut along a line, its block at larger x moved, and the two sides of the cut."""
    cut, sides = cut_along(line, spacing=70.0)
    mesh = cut.mesh
    block = mesh.blocks == mesh.blocks[sides[1, 0, 0]]
    return mesh, np.where(block[:, None], motion(mesh.vertices), mesh.vertices), sides, block


@pytest.fixture(params=["slide", "turn"])
def case(request):
    if request.param == "slide":
        along = np.array([200.0, 600.0]) / np.hypot(200, 600)
        return slid(PLANAR, lambda points: points - 83.0 * along)
    return slid(arc(50.0), lambda points: rotated(points, 0.05, CENTRE))


def test_what_is_not_moved_stays_as_it_is():
    mesh, vertices, sides, _ = slid(PLANAR, lambda points: points)
    whole, moved = weld_seams(mesh, vertices, [sides])
    np.testing.assert_array_equal(whole.triangles.shape, mesh.triangles.shape)
    np.testing.assert_allclose(moved, vertices, atol=1e-9)


def test_the_master_does_not_move_and_the_slave_lies_on_it(case):
    mesh, vertices, sides, _ = case
    slave, master = sides
    _, moved = weld_seams(mesh, vertices, [(slave, master)])
    np.testing.assert_array_equal(moved[np.unique(master)], vertices[np.unique(master)])
    seam = shapely.MultiLineString(list(vertices[master]))
    span = shapely.LineString(vertices[np.append(master[:, 0], master[-1, 1])])
    ways = shapely.line_locate_point(span, shapely.points(moved[np.unique(slave)]))
    inner = (ways > 0) & (ways < span.length)
    assert inner.sum() > 5
    assert shapely.distance(seam, shapely.points(moved[np.unique(slave)]))[inner].max() < 1e-9


def test_nothing_turns_over_and_no_area_is_lost(case):
    mesh, vertices, sides, _ = case
    whole, moved = weld_seams(mesh, vertices, [sides])
    assert triangle_areas(moved, whole.triangles).min() > 0
    assert (whole.areas > 0).all()
    assert whole.areas.sum() == pytest.approx(mesh.areas.sum(), rel=1e-12)


def test_the_map_is_one_to_one_along_the_seam(case):
    """Before, points beside the seam fall into slivers of gap or overlap; afterwards all go there and back."""
    mesh, vertices, sides, _ = case
    whole, moved = weld_seams(mesh, vertices, [sides])
    rng = np.random.default_rng(0)
    edges = mesh.vertices[sides[0]]
    beside = edges[:, :1] + rng.uniform(0, 1, (len(edges), 400, 1)) * (edges[:, 1:] - edges[:, :1])
    points = beside.reshape(-1, 2) + rng.normal(0, 0.5, (beside.size // 2, 2))
    there = PiecewiseAffineMap(whole.vertices, moved, whole.triangles)
    points = points[np.isfinite(there.forward(points)).all(axis=1)]
    np.testing.assert_allclose(there.inverse(there.forward(points)), points, atol=1e-6)


def test_the_outline_is_that_of_the_rock(case):
    mesh, vertices, sides, _ = case
    whole, moved = weld_seams(mesh, vertices, [sides])
    rock = outline(whole, moved, closing=0.5)
    assert rock.geom_type == "Polygon"
    assert rock.area == pytest.approx(triangle_areas(moved, whole.triangles).sum(), rel=1e-6)
    assert rock.is_valid


def test_narrow_gaps_are_closed_and_wide_ones_stay():
    across = np.array([600.0, -200.0]) / np.hypot(600, 200)
    for gap, parts in ((0.4, 1), (40.0, 2)):
        mesh, vertices, _, _ = slid(PLANAR, lambda points, gap=gap: points + gap * across)
        rock = outline(mesh, vertices, closing=0.5)
        assert len(shapely.get_parts(rock)) == parts
        assert rock.area >= BOX.area * (1 - 1e-9)


def test_an_outline_has_no_corners_that_crowd_a_mesh():
    mesh, _, (one, _), _ = slid(arc(50.0), lambda points: points)
    angles = np.arctan2(*(mesh.vertices[one[3]] - CENTRE).T)
    angle = 1.0003 * abs(angles[1] - angles[0])  # vertices come to lie 2 cm beside those of the other side
    mesh, vertices, sides, _ = slid(arc(50.0), lambda points: rotated(points, angle, CENTRE))
    rock = outline(*weld_seams(mesh, vertices, [sides]), closing=0.5)
    assert np.hypot(*np.diff(shapely.get_coordinates(rock.exterior), axis=0).T).min() > 1


def test_new_holes_are_those_that_were_not_there_before():
    square, holed = shapely.box(0, 0, 10, 10), shapely.box(0, 0, 10, 10) - shapely.box(2, 2, 6, 6)
    gaping = holed - shapely.box(8, 4, 9, 6)
    assert [hole.area for hole in new_holes(square, gaping)] == [2, 16]
    assert [hole.area for hole in new_holes(holed, gaping)] == [2]
    assert new_holes(holed, holed) == []


def test_a_hairline_that_is_open_at_one_end_is_closed():
    """As between the sides of a fault above the stretch along which they are welded."""
    points = [(0, 0), (99.9997, 0), (100, 4), (100.0003, 0), (200, 0), (200, 100), (0, 100)]
    rock = triangulate(Polygon(points), [], 40.0)
    assert outline(rock, rock.vertices, closing=1.0).symmetric_difference(box(0, 0, 200, 100)).area < 1e-6
