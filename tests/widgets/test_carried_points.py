"""The browser carries points through maps exactly as the kernel does, on edges and outside by rounding too."""

import json
import sys
from base64 import b64encode
from pathlib import Path
from subprocess import run

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from seiswidgets.core.mapping import PiecewiseAffineMap
from seiswidgets.core.point_location import TOLERANCE
from seiswidgets.interaction.overlay import map_state

NODE = Path(sys.executable).with_name("node")  # of the wheel in the extra "test"
SCRIPT = Path(__file__).with_name("js") / "carry_points.js"
TRIANGLE = np.array([[0.0, 0.0], [200.0, 0.0], [0.0, 100.0]])
SLIVER = np.array([[1e6, 1000.0], [1e6 + 5000, 1000.2], [1e6 + 2500, 1000.3]])  # far from the origin
INSIDE, OUTSIDE = 0.9 * TOLERANCE, 1.1 * TOLERANCE


def carried_in_browser(maps, points):
    """Points after a chain of maps, NaN where one is left; shape (p, 2)."""
    states = [map_state(one.source, one.target, one.triangles) for one in maps]
    packed = [
        {name: b64encode(value).decode() if isinstance(value, bytes) else value for name, value in state.items()}
        for state in states
    ]
    task = json.dumps({"maps": packed, "points": np.where(np.isnan(points), None, points).tolist()})
    done = run([NODE, SCRIPT], input=task, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    return np.array([point or [np.nan, np.nan] for point in json.loads(done.stdout)])


def carried_in_kernel(maps, points):
    for one in maps:
        points = one.forward(points)
    return points


def near_the_border(corners, slack):
    """Points whose least barycentric coordinate is -slack: beyond each edge and each corner, and along the edges."""
    weights = []
    for k in range(3):
        for share in (0.0, 0.25, 0.5, 1.0):
            edge = np.roll([-slack, (1 + slack) * share, (1 + slack) * (1 - share)], k)
            weights.append(edge)
        weights.append(np.roll([-slack, -slack, 1 + 2 * slack], k))
    return np.array(weights) @ corners


@pytest.mark.parametrize("corners", [TRIANGLE, TRIANGLE[::-1], SLIVER])
@pytest.mark.parametrize(("slack", "is_inside"), [(-INSIDE, True), (0, True), (INSIDE, True), (OUTSIDE, False)])
def test_browser_and_kernel_agree_on_the_border(corners, slack, is_inside):
    maps = [PiecewiseAffineMap(corners, 2 * corners + [[5, 7]], [[0, 1, 2]])]
    points = near_the_border(corners, slack)
    browser, kernel = carried_in_browser(maps, points), carried_in_kernel(maps, points)
    assert np.isfinite(kernel).all(axis=1).tolist() == [is_inside] * len(points)
    np.testing.assert_allclose(browser, kernel, rtol=1e-12, atol=1e-9)


def lattice(rows, columns, seed):
    """Vertices and triangles of a lattice of 10 m, distorted so little that no triangles overlap."""
    x, z = np.meshgrid(10.0 * np.arange(columns), 10.0 * np.arange(rows))
    shift = np.random.default_rng(seed).uniform(-1.2, 1.2, (rows * columns, 2))
    vertices = np.column_stack([x.ravel(), z.ravel()]) + shift
    index = np.arange(rows * columns).reshape(rows, columns)
    a, b, c, d = (part.ravel() for part in (index[:-1, :-1], index[:-1, 1:], index[1:, 1:], index[1:, :-1]))
    return vertices, np.vstack([np.column_stack([a, b, c]), np.column_stack([a, c, d])])


@settings(max_examples=10, deadline=None, suppress_health_check=[HealthCheck.too_slow])
@given(rows=st.integers(2, 12), columns=st.integers(2, 12), seed=st.integers(0, 99))
def test_browser_and_kernel_agree_in_any_mesh(rows, columns, seed):
    vertices, triangles = lattice(rows, columns, seed)
    rng = np.random.default_rng(seed)
    target = vertices @ [[0.9, 0.2], [0.1, 1.1]] + rng.uniform(-0.2, 0.2, vertices.shape)
    degenerate = np.vstack([triangles, np.repeat(triangles[:1, :1], 3, axis=1)])  # one triangle without area
    maps = [PiecewiseAffineMap(vertices, target, degenerate), PiecewiseAffineMap(target, vertices + 100, triangles)]
    corners = vertices[triangles]
    shares = rng.dirichlet([1, 1, 1], len(corners))
    points = np.vstack(
        [
            (shares[:, :, None] * corners).sum(axis=1),  # inside
            corners.mean(axis=1),
            (corners + np.roll(corners, 1, axis=1)).reshape(-1, 2) / 2,  # on edges
            vertices,
            rng.uniform(vertices.min(axis=0) - 5, vertices.max(axis=0) + 5, (50, 2)),  # some of them outside
            [[np.nan, 0]],
        ]
    )
    browser, kernel = carried_in_browser(maps, points), carried_in_kernel(maps, points)
    assert np.isfinite(kernel[: 2 * len(corners)]).all()
    assert np.isnan(kernel[-1]).all()
    np.testing.assert_allclose(browser, kernel, rtol=1e-9, atol=1e-9)
