"""Point location: finding the triangle that holds a point."""

from collections.abc import Iterator

import numpy as np
from numpy.typing import ArrayLike

from seiswidgets.core.mesh import triangle_areas

TOLERANCE = 5e-5  # distance outside that still counts as inside, in triangles, grid cells or samples
MOST_CELLS = 1_000_000
CELLS_ACROSS = 2  # finder cells along the side of a median triangle: more are slower to build and faster to search
BATCH = 16_384  # points located at a time: they fit the processor's cache


class TriangleFinder:
    """Finder of the triangle that holds each point, in any set of triangles: cut, with gaps, even overlapping.

    Parameters
    ----------
    vertices : array, shape (n, 2)
    triangles : array, shape (m, 3)
    """

    def __init__(self, vertices: ArrayLike, triangles: np.ndarray):
        corners = np.asarray(vertices, float)[triangles]
        self._coefficients = barycentric_coefficients(corners)
        self._set_grid(corners)
        self._fill_cells(corners)

    def _set_grid(self, corners: np.ndarray) -> None:
        low, high = corners.reshape(-1, 2).min(axis=0), corners.reshape(-1, 2).max(axis=0)
        pad = 2 * TOLERANCE * (high - low).max() or 1.0  # as far as the tolerance extends a triangle beyond a corner
        self._low, self._high = low - pad, high + pad
        size = self._high - self._low
        side = np.sqrt(np.median(np.abs(twice_areas(corners)))) / CELLS_ACROSS
        side = max(side, np.sqrt(size.prod() / MOST_CELLS), size.max() / MOST_CELLS)
        self._shape = np.ceil(size / side).astype(np.int64)
        self._cell_size = size / self._shape

    def _cell(self, positions: np.ndarray, axis: int) -> np.ndarray:
        cell = ((positions - self._low[axis]) / self._cell_size[axis]).astype(np.int64)
        return np.clip(cell, 0, self._shape[axis] - 1)

    def _fill_cells(self, corners: np.ndarray) -> None:
        """List the triangles that reach into each cell, first those that hold most of it."""
        low, high = reduce_three(np.minimum, *corners.swapaxes(0, 1)), reduce_three(np.maximum, *corners.swapaxes(0, 1))
        margin = 2 * TOLERANCE * (high - low)
        low, high = low - margin, high + margin
        (left, right), (top, bottom) = ([self._cell(end[:, axis], axis) for end in (low, high)] for axis in (0, 1))
        triangle, row = concatenate_ranges(top, bottom - top + 1)
        span, column = concatenate_ranges(left[triangle], (right - left)[triangle] + 1)
        triangle, row = triangle[span], row[span]
        depth, reaches = self._depth(triangle, column, row)
        triangle, cell, depth = triangle[reaches], (row * self._shape[0] + column)[reaches], depth[reaches]
        shallow = 0.5 - depth / (1 + np.abs(depth)) / 2  # from 0 to 1: one number to sort by is quicker than two
        self._candidates = triangle[np.argsort(cell + np.clip(shallow, 0, 0.999))]
        self._first = np.append(0, np.cumsum(np.bincount(cell, minlength=self._shape.prod())))

    def _depth(self, triangle: np.ndarray, column: np.ndarray, row: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Least barycentric coordinate of each cell's centre, and True where the cell may touch the triangle."""
        x, z = (self._low[k] + (index + 0.5) * self._cell_size[k] for k, index in enumerate((column, row)))
        weights = self._barycentric(triangle, x, z)
        b, c = self._coefficients[:, 2:4], self._coefficients[:, 4:6]
        reaches = (np.abs(gradient) @ self._cell_size / 2 + 2 * TOLERANCE for gradient in (b + c, b, c))
        touching = (weight + reach[triangle] >= 0 for weight, reach in zip(weights, reaches, strict=True))
        return reduce_three(np.minimum, *weights), reduce_three(np.logical_and, *touching)

    def _barycentric(
        self, triangle: np.ndarray, x: np.ndarray, z: np.ndarray
    ) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        x0, z0, bx, bz, cx, cz = self._coefficients.take(triangle, axis=0).T
        x, z = x - x0, z - z0
        b, c = bx * x + bz * z, cx * x + cz * z
        return 1 - b - c, b, c

    def __call__(self, points: ArrayLike) -> np.ndarray:
        """Return the index of a triangle that holds each point, -1 where there is none; shape (p,).

        A point that lies outside all triangles only by rounding is assigned to the nearest.

        Parameters
        ----------
        points : array, shape (p, 2)
            A point with NaN is in no triangle.
        """
        points = np.asarray(points, float).reshape(-1, 2)
        triangles = np.full(len(points), -1)
        for batch in batches(len(points)):
            self._find(points[batch, 0], points[batch, 1], triangles[batch])
        return triangles

    def _find(self, x: np.ndarray, z: np.ndarray, result: np.ndarray) -> None:
        """Write the triangle of each point into ``result``, candidate by candidate."""
        (low_x, low_z), (high_x, high_z) = self._low, self._high
        left = np.flatnonzero((x >= low_x) & (x <= high_x) & (z >= low_z) & (z <= high_z))
        x, z = x[left], z[left]
        cell = self._cell(z, 1) * self._shape[0] + self._cell(x, 0)
        following, end = self._first[cell], self._first[cell + 1]
        nearness = np.full(len(result), -TOLERANCE)
        while True:
            more = np.flatnonzero(following < end)
            if not len(more):
                return
            if len(more) < len(left):
                left, x, z, following, end = left[more], x[more], z[more], following[more], end[more]
            triangle = self._candidates[following]
            least = reduce_three(np.minimum, *self._barycentric(triangle, x, z))
            better = least >= nearness[left]
            result[left[better]] = triangle[better]
            nearness[left[better]] = least[better]
            following += 1
            following[least >= 0] = end[least >= 0]


def reduce_three(operation: np.ufunc, a: np.ndarray, b: np.ndarray, c: np.ndarray) -> np.ndarray:
    """Apply a binary operation to three arrays: several times faster than its ``reduce`` over a short axis."""
    return np.asarray(operation(operation(a, b), c))


def triangle_at(vertices: np.ndarray, triangles: np.ndarray, point: np.ndarray) -> int:
    """Index of a triangle that holds a point, shape (2,); -1 if none does."""
    return int(triangles_at(vertices, triangles, np.reshape(point, (1, 2)))[0])


def triangles_at(vertices: np.ndarray, triangles: np.ndarray, points: np.ndarray) -> np.ndarray:
    """Index of a triangle that holds each point, -1 where none does; for few points, faster than a finder.

    Parameters
    ----------
    vertices : array, shape (n, 2)
    triangles : array, shape (m, 3)
    points : array, shape (p, 2)
    """
    x0, z0, bx, bz, cx, cz = barycentric_coefficients(vertices[triangles]).T
    x, z = points[:, :1] - x0, points[:, 1:] - z0
    b, c = bx * x + bz * z, cx * x + cz * z
    least = np.nan_to_num(reduce_three(np.minimum, 1 - b - c, b, c), nan=-np.inf)
    found = np.argmax(least, axis=1)
    return np.where(least.max(axis=1) >= -TOLERANCE, found, -1)


def twice_areas(corners: np.ndarray) -> np.ndarray:
    """Twice the signed area of each triangle, from its corners, shape (m, 3, 2); shape (m,)."""
    return 2 * triangle_areas(corners.reshape(-1, 2), np.arange(3 * len(corners)).reshape(-1, 3))


def barycentric_coefficients(corners: np.ndarray) -> np.ndarray:
    """First corner of each triangle, and the gradients of its barycentric coordinates 1 and 2; shape (m, 6).

    Coordinates relative to the corner keep their digits however far from the origin the triangle lies.
    """
    (ux, uz), (vx, vz) = (corners[:, k].T - corners[:, 0].T for k in (1, 2))
    twice_area = ux * vz - uz * vx
    twice_area = np.where(twice_area == 0, np.nan, twice_area)
    return np.column_stack([corners[:, 0], vz / twice_area, -vx / twice_area, -uz / twice_area, ux / twice_area])


def batches(count: int, size: int = 1) -> Iterator[slice]:
    """Cache-sized slices that cover ``count`` rows of ``size`` entries each."""
    step = max(BATCH // size, 1)
    return (slice(start, start + step) for start in range(0, count, step))


def concatenate_ranges(first: np.ndarray, counts: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Concatenate integer ranges; return the index of the range, and the integer, for each.

    Parameters
    ----------
    first, counts : array, shape (k,)
        First integer and length of each range.
    """
    index = np.repeat(np.arange(len(counts)), counts)
    before = np.cumsum(counts) - counts
    return index, np.arange(len(index)) + np.repeat(first - before, counts)
