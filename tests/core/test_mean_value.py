import numpy as np
import pytest
from scipy.sparse import diags_array

from seiswidgets.core.mean_value import mean_value_matrix
from seiswidgets.core.mesh import Mesh
from seiswidgets.core.triangulation import triangulate
from tests.core.meshes import BLIND, BOX, PLANAR, cut_along, grid

MESHES = {
    "grid": lambda: grid(5, 4),
    "triangulated": lambda: triangulate(BOX, [PLANAR], 80.0),
    "cut": lambda: cut_along(BLIND)[0].mesh,
}


@pytest.fixture(params=MESHES)
def mesh(request):
    return MESHES[request.param]()


def test_rows_sum_to_zero(mesh):
    np.testing.assert_allclose(mean_value_matrix(mesh).sum(axis=1), 0, atol=1e-14)


def test_vertices_at_rest_are_their_neighbours_mean(mesh):
    scale = np.ptp(mesh.vertices)
    np.testing.assert_allclose(mean_value_matrix(mesh) @ mesh.vertices, 0, atol=1e-13 * scale)


def test_so_are_all_affine_images(mesh):
    rng = np.random.default_rng(0)
    image = mesh.vertices @ rng.standard_normal((2, 2)) + rng.standard_normal(2)
    np.testing.assert_allclose(mean_value_matrix(mesh) @ image, 0, atol=1e-13 * np.ptp(image))


def test_weights_are_positive(mesh):
    matrix = mean_value_matrix(mesh)
    assert matrix.shape == (len(mesh.interior), len(mesh.vertices))
    own = matrix[np.arange(len(mesh.interior)), mesh.interior]
    np.testing.assert_allclose(own, -1)
    weights = matrix - diags_array(np.full(len(mesh.vertices), -1.0)).tocsr()[mesh.interior]
    weights.data[abs(weights.data) < 1e-12] = 0
    weights.eliminate_zeros()
    assert (weights.data > 0).all()
    neighbours = np.bincount(mesh.edges.ravel())[mesh.interior]
    np.testing.assert_array_equal(np.diff(weights.indptr), neighbours)


def test_a_regular_hexagons_weights_are_equal():
    angles = np.pi / 3 * np.arange(6)
    vertices = np.vstack([[0, 0], np.column_stack([np.cos(angles), np.sin(angles)])])
    triangles = [[0, k + 1, (k + 1) % 6 + 1] for k in range(6)]
    matrix = mean_value_matrix(Mesh(vertices, triangles))
    np.testing.assert_allclose(matrix.toarray(), [[-1, *[1 / 6] * 6]])
