import numpy as np
import pytest
import shapely
from scipy.spatial import Delaunay

from seiswidgets.core.mapping import PiecewiseAffineMap, triangles_at_grid
from seiswidgets.core.mesh import triangle_areas
from seiswidgets.core.point_location import TOLERANCE, TriangleFinder, triangle_at
from seiswidgets.core.resampling import resample
from seiswidgets.core.triangulation import edges_along, triangulate

BOX = shapely.box(0, 0, 120, 80)
FAULT = shapely.LineString([(40, 10), (75, 70)])


@pytest.fixture(scope="module")
def mesh():
    return triangulate(BOX, [FAULT], 4.0)


@pytest.fixture(scope="module")
def cut(mesh):
    return mesh.cut(edges_along(mesh, FAULT, 4.0)).mesh


def bent(vertices, amount=1.0):
    """A smooth deformation without overlaps, of places in a section of about 100 by 100."""
    x, z = vertices.T
    return vertices + amount * np.column_stack([3 * np.sin(z / 20) + 0.1 * x, 4 * np.cos(x / 25)])


def barycentric(corners, points):
    """Barycentric coordinates of each point in each triangle, shape (p, m, 3), by a linear solve."""
    system = np.concatenate([corners.transpose(0, 2, 1), np.ones((len(corners), 1, 3))], axis=1)
    points = np.column_stack([points, np.ones(len(points))])
    return np.einsum("mij,pj->pmi", np.linalg.inv(system), points)


def least_in(corners, triangle, points):
    """The least barycentric coordinate of each point in its own triangle."""
    edges = np.stack([corners[triangle, 1], corners[triangle, 2]], axis=2) - corners[triangle, 0][:, :, None]
    b, c = np.linalg.solve(edges, (points - corners[triangle, 0])[:, :, None])[:, :, 0].T
    return np.minimum.reduce([1 - b - c, b, c])


@pytest.mark.parametrize("seed", [0, 2, 4])
def test_finder_agrees_with_brute_force(seed):
    rng = np.random.default_rng(seed)
    vertices = rng.uniform(-5, 5, (60, 2)) * [1, 10.0**-seed] + 1000 * seed
    triangles = Delaunay(vertices - vertices.mean(axis=0)).simplices
    triangles = triangles[rng.random(len(triangles)) < 0.8]  # with gaps
    low, high = vertices.min(axis=0), vertices.max(axis=0)
    points = rng.uniform(low - 0.1 * (high - low), high + 0.1 * (high - low), (3000, 2))
    weights = barycentric(vertices[triangles], points).min(axis=2)
    expected = np.where(weights.max(axis=1) >= 0, weights.argmax(axis=1), -1)
    clear = np.abs(weights).min(axis=1) > TOLERANCE
    np.testing.assert_array_equal(TriangleFinder(vertices, triangles)(points)[clear], expected[clear])


@pytest.mark.parametrize("offset", [0.0, 3e5])
def test_finder_finds_vertices_and_points_on_edges(cut, offset):
    vertices = cut.vertices + offset
    share = np.random.default_rng(7).random((len(cut.edges), 1))
    on_edges = vertices[cut.edges[:, 0]] * share + vertices[cut.edges[:, 1]] * (1 - share)
    points = np.concatenate([vertices, on_edges])
    triangle = TriangleFinder(vertices, cut.triangles)(points)
    assert np.all(triangle >= 0)
    assert least_in(vertices[cut.triangles], triangle, points).min() > -1e-6


@pytest.mark.parametrize("angle", [0.0, 0.3, 1.2])
def test_finder_forgives_rounding_outside_the_outline_and_no_more(mesh, angle):
    turn = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
    vertices = mesh.vertices @ turn.T
    finder = TriangleFinder(vertices, mesh.triangles)
    middles = vertices[mesh.boundary].mean(axis=1)
    outwards = (np.diff(vertices[mesh.boundary], axis=1)[:, 0] @ [[0, -1], [1, 0]]) / 4.0
    assert np.all(finder(middles + 1e-7 * outwards) >= 0)
    assert np.all(finder(middles + 1e-3 * outwards) == -1)


def test_finder_prefers_a_triangle_that_holds_the_point_to_one_that_nearly_does(cut):
    vertices = cut.vertices.copy()
    rng = np.random.default_rng(8)
    weights = rng.dirichlet([1, 1, 1], (20, len(cut.triangles)))
    weights[:10, :, 0] = 1e-8
    weights /= weights.sum(axis=2, keepdims=True)
    points = np.einsum("pmk,mkd->pmd", weights, vertices[cut.triangles])
    expected = np.broadcast_to(np.arange(len(cut.triangles)), points.shape[:2])
    found = TriangleFinder(vertices, cut.triangles)(points.reshape(-1, 2))
    np.testing.assert_array_equal(found, expected.ravel())


def test_finder_takes_one_of_overlapping_triangles():
    vertices = np.array([[0, 0], [4, 0], [0, 4], [1, 1], [5, 1], [1, 5.0]])
    triangles = np.array([[0, 1, 2], [3, 4, 5]])
    assert TriangleFinder(vertices, triangles)([[1.2, 1.2], [0.5, 0.5], [4, 1.5], [9, 9]]).tolist()[1:] == [0, 1, -1]
    assert TriangleFinder(vertices, triangles)([[1.2, 1.2]])[0] in (0, 1)


def test_finder_knows_no_triangle_for_nan_or_infinity_or_in_a_flat_triangle(mesh):
    finder = TriangleFinder(mesh.vertices, mesh.triangles)
    assert finder([[np.nan, 1], [1, np.nan], [np.inf, 1], [1, -np.inf], [50, 50]])[:4].tolist() == [-1] * 4
    assert finder(np.empty((0, 2))).shape == (0,)
    flat = TriangleFinder([[0, 0], [1, 1], [2, 2], [0, 2.0]], [[0, 1, 2], [0, 2, 3]])
    assert flat([[1, 1], [0.5, 1.5], [1.5, 0.5]]).tolist() == [1, 1, -1]


def test_identity_returns_the_points(mesh):
    points = np.random.default_rng(9).uniform([0, 0], [120, 80], (1000, 2))
    still = PiecewiseAffineMap(mesh.vertices, mesh.vertices, mesh.triangles)
    np.testing.assert_allclose(still.forward(points), points, atol=1e-12)
    np.testing.assert_allclose(still.gradient, np.tile(np.eye(2), (len(mesh.triangles), 1, 1)), atol=1e-10)


def test_affine_map_is_exact_and_has_its_gradient(mesh):
    rng = np.random.default_rng(10)
    matrix, shift = rng.normal(size=(2, 2)), rng.normal(size=2)
    points = rng.uniform([0, 0], [120, 80], (1000, 2))
    moved = PiecewiseAffineMap(mesh.vertices, mesh.vertices @ matrix.T + shift, mesh.triangles)
    there_and_back = np.tile(np.eye(2), (len(mesh.triangles), 1, 1))
    np.testing.assert_allclose(moved.forward(points), points @ matrix.T + shift, atol=1e-10)
    np.testing.assert_allclose(moved.gradient, np.tile(matrix, (len(mesh.triangles), 1, 1)), atol=1e-9)
    np.testing.assert_allclose(
        PiecewiseAffineMap(moved.target, moved.source, moved.triangles).gradient @ moved.gradient,
        there_and_back,
        atol=1e-9,
    )


@pytest.mark.parametrize(("unit", "offset"), [(1.0, 0.0), (1e-3, 0.0), (0.25, 5e5)])
def test_there_and_back_again_is_where_it_was(mesh, unit, offset):
    rng = np.random.default_rng(11)
    source, target = (unit * places + offset for places in (mesh.vertices, bent(mesh.vertices)))
    points = unit * rng.uniform([0, 0], [120, 80], (100_000, 2)) + offset
    there = PiecewiseAffineMap(source, target, mesh.triangles)
    back = there.inverse(there.forward(points))
    np.testing.assert_allclose(back, points, rtol=0, atol=max(1e-9 * unit, 4 * np.spacing(offset)))


def test_vertices_are_carried_to_their_targets(mesh):
    there = PiecewiseAffineMap(mesh.vertices, bent(mesh.vertices), mesh.triangles)
    np.testing.assert_allclose(there.forward(mesh.vertices), there.target, atol=1e-10)
    np.testing.assert_allclose(there.inverse(there.target), mesh.vertices, atol=1e-10)


def test_a_known_triangle_carries_a_point_of_the_fault_with_its_own_side(mesh):
    edges = edges_along(mesh, FAULT, 4.0)
    cut = mesh.cut(edges)
    one, other = cut.sides(edges)
    target = cut.mesh.vertices.copy()
    inner = one[:-1, 1]  # the far ends of all edges but the last: not the tips
    target[inner] += [5.0, 2.0]
    there = PiecewiseAffineMap(cut.mesh.vertices, target, cut.mesh.triangles)
    for side in (inner, other[:-1, 1]):
        triangle = np.array([np.flatnonzero((cut.mesh.triangles == vertex).any(axis=1))[0] for vertex in side])
        points = cut.mesh.vertices[side]
        np.testing.assert_allclose(there.forward(points, triangle), target[side], atol=1e-10)
        np.testing.assert_allclose(there.inverse(target[side], triangle), points, atol=1e-10)


def test_outside_is_nan(mesh):
    there = PiecewiseAffineMap(mesh.vertices, bent(mesh.vertices), mesh.triangles)
    outside = [[-1, 5], [50, 81], [np.nan, 3]]
    assert np.isnan(there.forward(outside)).all()
    assert np.isnan(there.forward([[50, 50]], [-1])).all()
    assert np.isfinite(there.forward([[50, 50]])).all()


def test_a_map_does_not_change_behind_its_caches(mesh):
    there = PiecewiseAffineMap(mesh.vertices, mesh.vertices, mesh.triangles)
    with pytest.raises(ValueError, match="read-only"):
        there.target[0] = 0


GRIDS = [
    (np.linspace(-3, 140, 301), np.linspace(-8, 90, 203)),
    (np.arange(0, 121.0), np.arange(0, 81.0)),
    (np.arange(30.0, 60.0, 0.37), np.arange(20.0, 50.0, 0.21)),
    (np.array([55.0]), np.arange(0, 81.0)),
    (np.arange(-200.0, -100.0), np.arange(500.0, 600.0)),
]


@pytest.mark.parametrize(("x", "z", "amount"), [*((*grid, 1.0) for grid in GRIDS), (*GRIDS[1], 0.0)])
def test_raster_agrees_with_the_finder(cut, x, z, amount):
    vertices = bent(cut.vertices, amount)
    raster = triangles_at_grid(vertices, cut.triangles, x, z)
    assert raster.shape == (len(z), len(x))
    points = np.stack(np.meshgrid(x, z), axis=-1).reshape(-1, 2)
    raster, found = raster.ravel(), TriangleFinder(vertices, cut.triangles)(points)
    np.testing.assert_array_equal(raster >= 0, found >= 0)
    differ = np.flatnonzero(raster != found)
    for triangle in (raster, found):
        assert np.all(np.abs(least_in(vertices[cut.triangles], triangle[differ], points[differ])) < 1e-5)


@pytest.mark.parametrize("seed", range(4))
def test_raster_has_no_pinholes(seed):
    rng = np.random.default_rng(seed)
    vertices = np.concatenate([rng.uniform(0, 50, (400, 2)), [[0, 0], [50, 0], [0, 50], [50, 50]]])
    if seed % 2:
        vertices = np.rint(vertices)  # every vertex on a node, many edges along rows and columns
    vertices = np.unique(vertices, axis=0) + 1e5 + seed / 7
    triangles = Delaunay(vertices - vertices.min(axis=0)).simplices
    areas = np.abs(triangle_areas(vertices, triangles))
    triangles = triangles[areas > 1e-6]
    raster = triangles_at_grid(vertices, triangles, *(1e5 + seed / 7 + np.linspace(0, 50, n) for n in (101, 201)))
    assert np.all(raster >= 0)


@pytest.mark.parametrize("rounding", [-1e-9, 1e-9])
def test_nodes_on_the_outline_are_in_in_spite_of_rounding(rounding):
    vertices = np.array([[0, 0], [10, 0], [10, 10], [0, 10]]) * (1 + rounding) - 0.1 * rounding
    raster = triangles_at_grid(vertices, [[0, 1, 2], [0, 2, 3]], np.arange(11.0), np.arange(11.0))
    assert np.all(raster >= 0)


def test_raster_leaves_gaps_open(cut):
    vertices = cut.vertices * 10
    middles = vertices[cut.triangles].mean(axis=1)
    shrunk = (vertices[cut.triangles] - middles[:, None]) * 0.5 + middles[:, None]
    triangles = np.arange(3 * len(middles)).reshape(-1, 3)
    raster = triangles_at_grid(shrunk.reshape(-1, 2), triangles, np.arange(1201.0), np.arange(801.0))
    assert np.mean(raster >= 0) == pytest.approx(0.25, rel=0.01)
    shares = np.bincount(raster[raster >= 0], minlength=len(middles))
    np.testing.assert_allclose(shares, cut.areas * 25, atol=25)


@pytest.mark.parametrize(("x", "z"), GRIDS)
def test_inverse_on_a_grid_is_the_inverse_of_its_nodes(mesh, x, z):
    there = PiecewiseAffineMap(mesh.vertices, bent(mesh.vertices), mesh.triangles)
    on_grid = there.inverse_on_grid(x, z)
    assert on_grid.shape == (len(z), len(x), 2)
    expected = there.inverse(np.stack(np.meshgrid(x, z), axis=-1).reshape(-1, 2))
    np.testing.assert_allclose(on_grid.reshape(-1, 2), expected, atol=1e-6)


def test_a_picture_carried_there_and_sampled_back_is_the_picture(mesh):
    rng = np.random.default_rng(15)
    z, x = np.indices((81, 121)).astype(float)
    picture = np.sin(x / 9) * np.cos(z / 7)
    there = PiecewiseAffineMap(mesh.vertices, bent(mesh.vertices), mesh.triangles)
    left, top = np.floor(there.target.min(axis=0))
    right, bottom = np.ceil(there.target.max(axis=0))
    source = there.inverse_on_grid(np.arange(left, right + 1), np.arange(top, bottom + 1))
    carried = resample(picture, source[..., 0], source[..., 1], 3)
    points = rng.uniform([10, 10], [110, 70], (2000, 2))
    column, row = (there.forward(points) - [left, top]).T
    seen = resample(carried, column, row, 3)
    np.testing.assert_allclose(seen, np.sin(points[:, 0] / 9) * np.cos(points[:, 1] / 7), atol=0.02)


def test_one_point_is_found_as_by_a_finder():
    vertices, cut = np.array([(0, 0), (4, 0), (4, 3), (0, 3), (2, 1.0)]), np.array([(0, 1, 4), (1, 2, 4), (2, 3, 4)])
    points = np.random.default_rng(3).uniform(-1, 5, (300, 2))
    found = [triangle_at(vertices, cut, point) for point in points]
    np.testing.assert_array_equal(found, TriangleFinder(vertices, cut)(points))
    assert {-1, 0, 1, 2} == set(found)
    assert triangle_at(vertices, cut, (0.0, 0.0)) == 0
    assert triangle_at(np.zeros((3, 2)), np.array([(0, 1, 2)]), (0.0, 0.0)) == -1
