"""Points inside a mesh move with it affinely, and terms about them are those of vertices where the points are these."""

import numpy as np
import pytest

from seiswidgets.core.interpolated import AtPoints, PointsInMesh
from seiswidgets.core.terms import EdgeLength, Level, Stitch
from tests.core.derivatives import check_curvature, check_jacobian
from tests.core.meshes import PLANAR, cut_along

RNG = np.random.default_rng(12)
MESH = cut_along(PLANAR)[0].mesh
TRIANGLES = MESH.triangles[10:18]  # neighbours: they share vertices
SHARES = RNG.dirichlet((1, 1, 1), len(TRIANGLES))
CHAIN = np.column_stack([np.arange(7), np.arange(1, 8)])


def terms(rest, count):
    return {
        "stitch": Stitch(CHAIN[::2], count, 1.5),
        "level": Level(np.arange(8), 120.0, count, 1.5),
        "bed length": EdgeLength(rest, CHAIN, 1.5),
    }


@pytest.mark.parametrize("name", terms(MESH.vertices, 8))
def test_derivatives(name):
    points = PointsInMesh(TRIANGLES, SHARES)
    term = AtPoints(terms(points.positions(MESH.vertices), len(TRIANGLES))[name], points)
    moved = MESH.vertices + 15 * RNG.standard_normal(MESH.vertices.shape)
    check_jacobian(term, moved, RNG)
    check_curvature(term, moved, RNG)


@pytest.mark.parametrize("name", terms(MESH.vertices, 8))
def test_points_at_vertices_are_vertices(name):
    corners = np.column_stack([np.arange(8), np.arange(8, 16), np.arange(16, 24)])
    points = PointsInMesh(corners, np.tile([1.0, 0.0, 0.0], (8, 1)))
    moved = MESH.vertices + 15 * RNG.standard_normal(MESH.vertices.shape)
    inside = AtPoints(terms(points.positions(MESH.vertices), 8)[name], points)
    at_vertices = terms(MESH.vertices, len(MESH.vertices))[name]
    np.testing.assert_allclose(inside.residual(moved), at_vertices.residual(moved))
    difference = inside.jacobian(moved) - at_vertices.jacobian(moved)
    np.testing.assert_allclose(difference.toarray(), 0, atol=1e-12)


def test_points_keep_their_place_in_a_triangle():
    points = RNG.uniform((100, 100), (900, 500), (20, 2))
    corners = MESH.triangles[RNG.integers(len(MESH.triangles), size=20)]  # others than those that hold them
    stretch, shift = np.array([[1.1, 0.3], [-0.2, 0.9]]), np.array([40.0, -7.0])
    carried = PointsInMesh.in_triangles(MESH.vertices, corners, points).positions(MESH.vertices @ stretch + shift)
    np.testing.assert_allclose(carried, points @ stretch + shift)


def test_a_point_beside_edges_moves_onto_the_nearest():
    vertices, edges = np.array([(0.0, 0.0), (10.0, 0.0), (10.0, 10.0)]), np.array([(0, 1), (1, 2)])
    nearest = PointsInMesh.on_edges(vertices, edges, np.array([(4.0, 1.0), (11.0, 7.0), (-3.0, 0.0)]))
    np.testing.assert_allclose(nearest.positions(vertices), [(4, 0), (10, 7), (0, 0)])
