"""Finding the triangle that holds a point."""

import numpy as np

from seiswidgets.core.mesh import triangle_areas

TOLERANCE = 1e-5  # how far outside still counts as inside: of a triangle, a grid cell, a sample
MOST_CELLS = 1_000_000
CELLS_ACROSS = 2  # finder cells along the side of a median triangle: more build slower and find faster
BATCH = 16_384  # points found at a time: what fits the processor's cache


class TriangleFinder:
    """Finds the triangle that holds each point, in any set of triangles: cut, with gaps, even overlapping.

    Parameters
    ----------
    vertices : array, shape (n, 2)
    triangles : array, shape (m, 3)
    """

    def __init__(self, vertices, triangles):
        corners = np.asarray(vertices, float)[triangles]
        self._coefficients = barycentric_coefficients(corners)
        self._set_grid(corners)
        self._fill_cells(corners)

    def _set_grid(self, corners):
        low, high = corners.reshape(-1, 2).min(axis=0), corners.reshape(-1, 2).max(axis=0)
        pad = 2 * TOLERANCE * (high - low).max() or 1.0  # as far as the tolerance extends a triangle beyond a corner
        self._low, self._high = low - pad, high + pad
        size = self._high - self._low
        side = np.sqrt(np.median(np.abs(twice_areas(corners)))) / CELLS_ACROSS
        side = max(side, np.sqrt(size.prod() / MOST_CELLS), size.max() / MOST_CELLS)
        self._shape = np.ceil(size / side).astype(np.int64)
        self._cell_size = size / self._shape

    def _cell(self, places, axis):
        cell = ((places - self._low[axis]) / self._cell_size[axis]).astype(np.int64)
        return np.clip(cell, 0, self._shape[axis] - 1)

    def _fill_cells(self, corners):
        """Lists the triangles that reach into each cell, first those that hold most of it."""
        low, high = of_three(np.minimum, *corners.swapaxes(0, 1)), of_three(np.maximum, *corners.swapaxes(0, 1))
        margin = 2 * TOLERANCE * (high - low)
        low, high = low - margin, high + margin
        (left, right), (top, bottom) = ([self._cell(end[:, axis], axis) for end in (low, high)] for axis in (0, 1))
        triangle, row = expanded(top, bottom - top + 1)
        span, column = expanded(left[triangle], (right - left)[triangle] + 1)
        triangle, row = triangle[span], row[span]
        depth, reaches = self._depth(triangle, column, row)
        triangle, cell, depth = triangle[reaches], (row * self._shape[0] + column)[reaches], depth[reaches]
        shallow = 0.5 - depth / (1 + np.abs(depth)) / 2  # from 0 to 1: one number to sort by is quicker than two
        self._candidates = triangle[np.argsort(cell + np.clip(shallow, 0, 0.999))]
        self._first = np.append(0, np.cumsum(np.bincount(cell, minlength=self._shape.prod())))

    def _depth(self, triangle, column, row):
        """Least barycentric coordinate of each cell's centre, and whether the cell can touch the triangle at all."""
        x, z = (self._low[k] + (index + 0.5) * self._cell_size[k] for k, index in enumerate((column, row)))
        weights = self._barycentric(triangle, x, z)
        b, c = self._coefficients[:, 2:4], self._coefficients[:, 4:6]
        reaches = (np.abs(gradient) @ self._cell_size / 2 + 2 * TOLERANCE for gradient in (b + c, b, c))
        touching = (weight + reach[triangle] >= 0 for weight, reach in zip(weights, reaches, strict=True))
        return of_three(np.minimum, *weights), of_three(np.logical_and, *touching)

    def _barycentric(self, triangle, x, z):
        x0, z0, bx, bz, cx, cz = self._coefficients.take(triangle, axis=0).T
        x, z = x - x0, z - z0
        b, c = bx * x + bz * z, cx * x + cz * z
        return 1 - b - c, b, c

    def __call__(self, points) -> np.ndarray:
        """Index of a triangle that holds each point, -1 where there is none; shape (p,).

        A point that no triangle holds, but that lies outside one by rounding, is given to the nearest.

        Parameters
        ----------
        points : array, shape (p, 2)
            A point with NaN is in no triangle.
        """
        points = np.asarray(points, float).reshape(-1, 2)
        found = np.full(len(points), -1)
        for batch in batches(len(points)):
            self._find(points[batch, 0], points[batch, 1], found[batch])
        return found

    def _find(self, x, z, found):
        (low_x, low_z), (high_x, high_z) = self._low, self._high
        left = np.flatnonzero((x >= low_x) & (x <= high_x) & (z >= low_z) & (z <= high_z))
        x, z = x[left], z[left]
        cell = self._cell(z, 1) * self._shape[0] + self._cell(x, 0)
        following, end = self._first[cell], self._first[cell + 1]
        nearness = np.full(len(found), -TOLERANCE)
        while True:
            more = np.flatnonzero(following < end)
            if not len(more):
                return
            if len(more) < len(left):
                left, x, z, following, end = left[more], x[more], z[more], following[more], end[more]
            triangle = self._candidates[following]
            least = of_three(np.minimum, *self._barycentric(triangle, x, z))
            better = least >= nearness[left]
            found[left[better]] = triangle[better]
            nearness[left[better]] = least[better]
            following += 1
            following[least >= 0] = end[least >= 0]


def of_three(operation, a, b, c):
    """What an operation of two makes of three arrays: several times faster than its ``reduce`` over a short axis."""
    return operation(operation(a, b), c)


def triangle_at(vertices, triangles, point) -> int:
    """Index of a triangle that holds one point, -1 if none does: for a single one, quicker than a finder.

    Parameters
    ----------
    vertices : array, shape (n, 2)
    triangles : array, shape (m, 3)
    point : array, shape (2,)
    """
    x0, z0, bx, bz, cx, cz = barycentric_coefficients(vertices[triangles]).T
    x, z = point[0] - x0, point[1] - z0
    b, c = bx * x + bz * z, cx * x + cz * z
    least = np.nan_to_num(of_three(np.minimum, 1 - b - c, b, c), nan=-np.inf)
    return int(np.argmax(least)) if least.max() >= -TOLERANCE else -1


def twice_areas(corners):
    """Twice the signed area of each triangle, from its corners, shape (m, 3, 2); shape (m,)."""
    return 2 * triangle_areas(corners.reshape(-1, 2), np.arange(3 * len(corners)).reshape(-1, 3))


def barycentric_coefficients(corners):
    """First corner of each triangle, and the gradients of its barycentric coordinates 1 and 2; shape (m, 6).

    Counted from the corner, a point keeps its digits however far from the origin the triangle lies.
    """
    (ux, uz), (vx, vz) = (corners[:, k].T - corners[:, 0].T for k in (1, 2))
    twice_area = ux * vz - uz * vx
    twice_area = np.where(twice_area == 0, np.nan, twice_area)
    return np.column_stack([corners[:, 0], vz / twice_area, -vx / twice_area, -uz / twice_area, ux / twice_area])


def batches(count, size=1):
    """Slices of so many things of a size, each about a batch long."""
    step = max(BATCH // size, 1)
    return (slice(start, start + step) for start in range(0, count, step))


def expanded(first, counts):
    """Runs of whole numbers, each from its first and so many long: the run of each number, and the number."""
    run = np.repeat(np.arange(len(counts)), counts)
    before = np.cumsum(counts) - counts
    return run, np.arange(len(run)) + np.repeat(first - before, counts)
