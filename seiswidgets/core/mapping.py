"""Maps that are affine in each triangle of a mesh."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from seiswidgets.core.point_location import (
    TOLERANCE,
    TriangleFinder,
    barycentric_coefficients,
    batches,
    concatenate_ranges,
    reduce_three,
    twice_areas,
)


@dataclass(frozen=True, eq=False)
class PiecewiseAffineMap:
    """Map from one shape of a mesh to another, by the affine map of the triangle that holds each point.

    Parameters
    ----------
    source, target : array, shape (n, 2)
        Positions of the vertices before and after.
    triangles : array, shape (m, 3)
    """

    source: np.ndarray
    target: np.ndarray
    triangles: np.ndarray

    def __post_init__(self) -> None:
        for name, dtype in (("source", float), ("target", float), ("triangles", np.int64)):
            array = np.array(getattr(self, name), dtype=dtype)
            array.setflags(write=False)
            object.__setattr__(self, name, array)

    @property
    def gradient(self) -> np.ndarray:
        """Jacobian of each triangle's map, NaN where the triangle has no area; shape (m, 2, 2)."""
        return np.asarray(self._forward[:-1, 4:].reshape(-1, 2, 2))

    @cached_property
    def source_finder(self) -> TriangleFinder:
        """Finder of the triangles before."""
        return TriangleFinder(self.source, self.triangles)

    @cached_property
    def target_finder(self) -> TriangleFinder:
        """Finder of the triangles after."""
        return TriangleFinder(self.target, self.triangles)

    @cached_property
    def _forward(self) -> np.ndarray:
        return _affine(self.source[self.triangles], self.target[self.triangles])

    @cached_property
    def _inverse(self) -> np.ndarray:
        return _affine(self.target[self.triangles], self.source[self.triangles])

    def forward(self, points: ArrayLike, triangles: np.ndarray | None = None) -> np.ndarray:
        """Carry points of the source to the target, NaN outside; shape (p, 2).

        Parameters
        ----------
        points : array, shape (p, 2)
        triangles : array, shape (p,), optional
            The triangle of each point where it is known (-1: outside), as for the end of a line on one side of a cut.
        """
        return _carry(points, self.source_finder(points) if triangles is None else triangles, self._forward)

    def inverse(self, points: ArrayLike, triangles: np.ndarray | None = None) -> np.ndarray:
        """Carry points of the target back to the source; as `forward`."""
        return _carry(points, self.target_finder(points) if triangles is None else triangles, self._inverse)

    def inverse_on_grid(self, x: ArrayLike, z: ArrayLike) -> np.ndarray:
        """Carry the nodes of a regular grid over the target back, NaN outside; shape (len(z), len(x), 2)."""
        x, z = np.asarray(x, float), np.asarray(z, float)
        triangle = triangles_at_grid(self.target, self.triangles, x, z)
        origins = np.empty((2, *triangle.shape))  # one component after the other: each is used on its own
        for rows in batches(len(z), len(x)):
            origins[:, rows] = _affine_at(x, z[rows, None], triangle[rows], self._inverse)
        return np.moveaxis(origins, 0, -1)


def triangles_at_grid(vertices: np.ndarray, triangles: np.ndarray, x: np.ndarray, z: np.ndarray) -> np.ndarray:
    """The triangle that holds each node of a regular grid, -1 where there is none; shape (len(z), len(x)).

    Filled by spans: the rows of each triangle, then the columns of each row. A node on a shared edge goes to one of
    the two triangles; where triangles overlap, to the last.

    Parameters
    ----------
    vertices : array, shape (n, 2)
    triangles : array, shape (m, 3)
    x, z : array, shapes (nx,) and (nz,)
        Ascending and evenly spaced.
    """
    nodes = np.column_stack([_in_cells(np.asarray(vertices)[:, k], axis) for k, axis in enumerate((x, z))])
    corners = nodes[triangles]
    sides = reduce_three(np.maximum, *corners.swapaxes(0, 1)) - reduce_three(np.minimum, *corners.swapaxes(0, 1))
    longest = sides.max(axis=1)
    solid = np.flatnonzero(np.abs(twice_areas(corners)) > TOLERANCE * longest)
    corners = corners[solid]
    corners = np.take_along_axis(corners, np.argsort(corners[:, :, 1], axis=1, kind="stable")[:, :, None], axis=1)
    span_triangle, row, left, right = _spans(corners, len(z))
    first = np.maximum(np.ceil(left - TOLERANCE), 0).astype(np.int64)
    last = np.minimum(np.floor(right + TOLERANCE), len(x) - 1).astype(np.int64)
    span, node = concatenate_ranges(row * len(x) + first, np.maximum(last - first + 1, 0))
    result = np.full(len(z) * len(x), -1)
    result[node] = solid[span_triangle][span]
    return result.reshape(len(z), len(x))


def _in_cells(positions: np.ndarray, axis: np.ndarray) -> np.ndarray:
    """Positions along an axis in grid cells from its first node, moved onto a node where they differ by rounding."""
    axis = np.asarray(axis, float)
    step = (axis[-1] - axis[0]) / (len(axis) - 1) if len(axis) > 1 else 1.0
    cells = (positions - axis[0]) / step
    node = np.rint(cells)
    return np.where(np.abs(cells - node) <= TOLERANCE, node, cells)


def _spans(corners: np.ndarray, rows: int) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """Triangle, row, and leftmost and rightmost position of each row of each triangle; corners sorted downwards.

    An edge's crossing is computed downwards in both of its triangles, hence equal to the last bit: no pinholes.
    """
    first = np.clip(np.ceil(corners[:, 0, 1]), 0, rows).astype(np.int64)
    last = np.clip(np.floor(corners[:, 2, 1]), -1, rows - 1).astype(np.int64)
    triangle, row = concatenate_ranges(first, np.maximum(last - first + 1, 0))
    top, middle, bottom = np.ascontiguousarray(corners.transpose(1, 2, 0)).take(triangle, axis=2)
    lower = row >= middle[1]
    straight = _crossing(top, bottom, row)
    bent = _crossing(np.where(lower, middle, top), np.where(lower, bottom, middle), row)
    return triangle, row, np.minimum(bent, straight), np.maximum(bent, straight)


def _crossing(start: np.ndarray, end: np.ndarray, row: np.ndarray) -> np.ndarray:
    share = (row - start[1]) / np.maximum(end[1] - start[1], np.finfo(float).tiny)
    return np.asarray(start[0] + np.clip(share, 0, 1) * (end[0] - start[0]))


def _affine(start: np.ndarray, end: np.ndarray) -> np.ndarray:
    """Each triangle's first corner before and after, and the Jacobian between, row by row; shape (m + 1, 8).

    The last row is NaN, for triangle -1, which means no triangle.
    """
    gradients = barycentric_coefficients(start)[:, 2:].reshape(-1, 2, 2)
    edges = (end[:, 1:] - end[:, :1]).transpose(0, 2, 1)
    coefficients = np.hstack([start[:, 0], end[:, 0], (edges @ gradients).reshape(-1, 4)])
    return np.append(coefficients, np.full((1, 8), np.nan), axis=0)


def _affine_at(
    x: np.ndarray, z: np.ndarray, triangle: np.ndarray, coefficients: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    x0, z0, x1, z1, xx, xz, zx, zz = np.moveaxis(coefficients.take(triangle, axis=0), -1, 0)
    x, z = x - x0, z - z0
    return x1 + xx * x + xz * z, z1 + zx * x + zz * z


def _carry(points: ArrayLike, triangles: np.ndarray, coefficients: np.ndarray) -> np.ndarray:
    points, triangles = np.asarray(points, float).reshape(-1, 2), np.asarray(triangles)
    result = np.empty(points.shape)
    for batch in batches(len(points)):
        x, z = points[batch].T
        result[batch, 0], result[batch, 1] = _affine_at(x, z, triangles[batch], coefficients)
    return result
