"""Terms that hold points and directions: linear, silent at rest, and zero only where what they hold is kept."""

import numpy as np
import pytest

from seiswidgets.core.holds import EdgeDirection, Hold
from seiswidgets.core.interpolated import PointsInMesh
from tests.core.derivatives import check_curvature, check_jacobian
from tests.core.meshes import PLANAR, cut_along, rotated

RNG = np.random.default_rng(5)
MESH = cut_along(PLANAR)[0].mesh
SHARES = np.array([[0.2, 0.3, 0.5], [1.0, 0.0, 0.0], [0.0, 0.5, 0.5]])
CORNERS = MESH.triangles[[3, 40, 100]]
POINTS = np.einsum("kc,kcx->kx", SHARES, MESH.vertices[CORNERS])


def hold(held=True):
    return Hold(PointsInMesh(CORNERS, SHARES), POINTS, np.broadcast_to(held, (3, 2)), len(MESH.vertices), 1.5)


def terms():
    return {"hold": hold(), "level": hold((False, True)), "rotation": EdgeDirection(MESH.vertices, MESH.edges, 1.5)}


@pytest.mark.parametrize("name", terms())
def test_derivatives_and_rest(name):
    term = terms()[name]
    np.testing.assert_allclose(term.residual(MESH.vertices), 0, atol=1e-9)
    moved = MESH.vertices + 15 * RNG.standard_normal(MESH.vertices.shape)
    check_jacobian(term, moved, RNG)
    check_curvature(term, moved, RNG)


def test_a_shift_moves_points_and_turns_nothing():
    moved = MESH.vertices + (3.0, 4.0)
    np.testing.assert_allclose(hold().residual(moved).reshape(-1, 2), np.tile((4.5, 6.0), (3, 1)))
    np.testing.assert_allclose(hold((False, True)).residual(moved), 6.0)
    np.testing.assert_allclose(terms()["rotation"].residual(moved), 0, atol=1e-9)


@pytest.mark.parametrize("angle", [0.2, -0.5])
def test_a_turn_costs_its_sine(angle):
    lengths = np.hypot(*(MESH.vertices[MESH.edges[:, 1]] - MESH.vertices[MESH.edges[:, 0]]).T)
    residual = terms()["rotation"].residual(rotated(MESH.vertices, angle))
    np.testing.assert_allclose(np.abs(residual), 1.5 * abs(np.sin(angle)) * lengths, rtol=1e-9)
