"""Maps that are affine in each triangle of a mesh."""

from dataclasses import dataclass
from functools import cached_property

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
        self._coefficients = _barycentric_coefficients(corners)
        self._set_grid(corners)
        self._fill_cells(corners)

    def _set_grid(self, corners):
        low, high = corners.min(axis=(0, 1)), corners.max(axis=(0, 1))
        pad = TOLERANCE * (high - low).max() or 1.0
        self._low, self._high = low - pad, high + pad
        size = self._high - self._low
        side = np.sqrt(np.median(np.abs(_twice_areas(corners)))) / CELLS_ACROSS
        side = max(side, np.sqrt(size.prod() / MOST_CELLS), size.max() / MOST_CELLS)
        self._shape = np.ceil(size / side).astype(np.int64)
        self._cell_size = size / self._shape

    def _cell(self, places, axis):
        cell = ((places - self._low[axis]) / self._cell_size[axis]).astype(np.int64)
        return np.clip(cell, 0, self._shape[axis] - 1)

    def _fill_cells(self, corners):
        """Lists the triangles that reach into each cell, first those that hold most of it."""
        margin = 2 * TOLERANCE * np.ptp(corners, axis=1)
        low, high = corners.min(axis=1) - margin, corners.max(axis=1) + margin
        (left, right), (top, bottom) = ([self._cell(end[:, axis], axis) for end in (low, high)] for axis in (0, 1))
        triangle, row = _expanded(top, bottom - top + 1)
        span, column = _expanded(left[triangle], (right - left)[triangle] + 1)
        triangle, row = triangle[span], row[span]
        depth, reaches = self._depth(triangle, column, row)
        triangle, cell, depth = triangle[reaches], (row * self._shape[0] + column)[reaches], depth[reaches]
        order = np.lexsort((-depth, cell))
        self._candidates = triangle[order]
        self._first = np.searchsorted(cell[order], np.arange(self._shape.prod() + 1))

    def _depth(self, triangle, column, row):
        """Least barycentric coordinate of each cell's centre, and whether the cell can touch the triangle at all."""
        x, z = (self._low[k] + (index + 0.5) * self._cell_size[k] for k, index in enumerate((column, row)))
        weights = self._barycentric(triangle, x, z)
        b, c = self._coefficients[:, 2:4], self._coefficients[:, 4:6]
        reaches = (np.abs(gradient) @ self._cell_size / 2 + 2 * TOLERANCE for gradient in (b + c, b, c))
        touching = [weight + reach[triangle] >= 0 for weight, reach in zip(weights, reaches, strict=True)]
        return np.minimum.reduce(weights), np.logical_and.reduce(touching)

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
            a, b, c = self._barycentric(triangle, x, z)
            least = np.minimum(np.minimum(a, b), c)
            better = least >= nearness[left]
            found[left[better]] = triangle[better]
            nearness[left[better]] = least[better]
            following += 1
            following[least >= 0] = end[least >= 0]


@dataclass(frozen=True, eq=False)
class PiecewiseAffineMap:
    """Carries points from one shape of a mesh to another, by the affine map of the triangle that holds them.

    Parameters
    ----------
    source, target : array, shape (n, 2)
        Places of the vertices before and after.
    triangles : array, shape (m, 3)
    """

    source: np.ndarray
    target: np.ndarray
    triangles: np.ndarray

    def __post_init__(self):
        for name, kind in (("source", float), ("target", float), ("triangles", np.int64)):
            array = np.array(getattr(self, name), dtype=kind)
            array.setflags(write=False)
            object.__setattr__(self, name, array)

    @property
    def gradient(self) -> np.ndarray:
        """Jacobian of each triangle's map, NaN where the triangle has no area; shape (m, 2, 2)."""
        return self._forward[:-1, 4:].reshape(-1, 2, 2)

    @cached_property
    def source_finder(self) -> TriangleFinder:
        """Finder of the triangles where they were."""
        return TriangleFinder(self.source, self.triangles)

    @cached_property
    def target_finder(self) -> TriangleFinder:
        """Finder of the triangles where they are carried to."""
        return TriangleFinder(self.target, self.triangles)

    @cached_property
    def _forward(self):
        return _affine(self.source[self.triangles], self.target[self.triangles])

    @cached_property
    def _inverse(self):
        return _affine(self.target[self.triangles], self.source[self.triangles])

    def forward(self, points, triangles=None) -> np.ndarray:
        """Where points of the source are carried to, NaN outside; shape (p, 2).

        Parameters
        ----------
        points : array, shape (p, 2)
        triangles : array, shape (p,), optional
            The triangle of each point where it is known (-1: outside), as for the end of a line on one side of a cut.
        """
        return _carried(points, self.source_finder(points) if triangles is None else triangles, self._forward)

    def inverse(self, points, triangles=None) -> np.ndarray:
        """Where points of the target come from, NaN outside; as `forward`."""
        return _carried(points, self.target_finder(points) if triangles is None else triangles, self._inverse)

    def inverse_on_grid(self, x, z) -> np.ndarray:
        """Where the nodes of a regular grid over the target come from, NaN outside; shape (len(z), len(x), 2)."""
        x, z = np.asarray(x, float), np.asarray(z, float)
        triangle = triangles_at_grid(self.target, self.triangles, x, z)
        places = np.empty((2, *triangle.shape))  # one component after the other: each is used on its own
        for rows in batches(len(z), len(x)):
            places[:, rows] = _affine_at(x, z[rows, None], triangle[rows], self._inverse)
        return np.moveaxis(places, 0, -1)


def triangles_at_grid(vertices, triangles, x, z) -> np.ndarray:
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
    places = np.column_stack([_in_cells(np.asarray(vertices)[:, k], axis) for k, axis in enumerate((x, z))])
    corners = places[triangles]
    longest = np.ptp(corners, axis=1).max(axis=1)
    solid = np.flatnonzero(np.abs(_twice_areas(corners)) > TOLERANCE * longest)
    corners = corners[solid]
    corners = np.take_along_axis(corners, np.argsort(corners[:, :, 1], axis=1, kind="stable")[:, :, None], axis=1)
    span_triangle, row, left, right = _spans(corners, len(z))
    first = np.maximum(np.ceil(left - TOLERANCE), 0).astype(np.int64)
    last = np.minimum(np.floor(right + TOLERANCE), len(x) - 1).astype(np.int64)
    span, node = _expanded(row * len(x) + first, np.maximum(last - first + 1, 0))
    result = np.full(len(z) * len(x), -1)
    result[node] = solid[span_triangle][span]
    return result.reshape(len(z), len(x))


def _in_cells(places, axis):
    """Places along an axis in grid cells from its first node, put on a node where they differ by rounding."""
    axis = np.asarray(axis, float)
    step = (axis[-1] - axis[0]) / (len(axis) - 1) if len(axis) > 1 else 1.0
    cells = (places - axis[0]) / step
    node = np.rint(cells)
    return np.where(np.abs(cells - node) <= TOLERANCE, node, cells)


def _spans(corners, rows):
    """Triangle, row, and leftmost and rightmost place of each row of each triangle; corners sorted downwards.

    An edge's crossing is computed downwards in both of its triangles, hence alike to the last bit: no pinholes.
    """
    first = np.clip(np.ceil(corners[:, 0, 1]), 0, rows).astype(np.int64)
    last = np.clip(np.floor(corners[:, 2, 1]), -1, rows - 1).astype(np.int64)
    triangle, row = _expanded(first, np.maximum(last - first + 1, 0))
    top, middle, bottom = np.ascontiguousarray(corners.transpose(1, 2, 0)).take(triangle, axis=2)
    lower = row >= middle[1]
    straight = _crossing(top, bottom, row)
    bent = _crossing(np.where(lower, middle, top), np.where(lower, bottom, middle), row)
    return triangle, row, np.minimum(bent, straight), np.maximum(bent, straight)


def _crossing(start, end, row):
    share = (row - start[1]) / np.maximum(end[1] - start[1], np.finfo(float).tiny)
    return start[0] + np.clip(share, 0, 1) * (end[0] - start[0])


def _twice_areas(corners):
    return 2 * triangle_areas(corners.reshape(-1, 2), np.arange(3 * len(corners)).reshape(-1, 3))


def _barycentric_coefficients(corners):
    """First corner of each triangle, and the gradients of its barycentric coordinates 1 and 2; shape (m, 6).

    Counted from the corner, a point keeps its digits however far from the origin the triangle lies.
    """
    (ux, uz), (vx, vz) = (corners[:, k].T - corners[:, 0].T for k in (1, 2))
    twice_area = ux * vz - uz * vx
    twice_area = np.where(twice_area == 0, np.nan, twice_area)
    return np.column_stack([corners[:, 0], vz / twice_area, -vx / twice_area, -uz / twice_area, ux / twice_area])


def _affine(start, end):
    """Each triangle's first corner before and after, and the Jacobian between, row by row; shape (m + 1, 8).

    The last row is NaN: it stands for triangle -1, which is none.
    """
    gradients = _barycentric_coefficients(start)[:, 2:].reshape(-1, 2, 2)
    edges = (end[:, 1:] - end[:, :1]).transpose(0, 2, 1)
    coefficients = np.hstack([start[:, 0], end[:, 0], (edges @ gradients).reshape(-1, 4)])
    return np.append(coefficients, np.full((1, 8), np.nan), axis=0)


def _affine_at(x, z, triangle, coefficients):
    x0, z0, x1, z1, xx, xz, zx, zz = np.moveaxis(coefficients.take(triangle, axis=0), -1, 0)
    x, z = x - x0, z - z0
    return x1 + xx * x + xz * z, z1 + zx * x + zz * z


def _carried(points, triangles, coefficients):
    points, triangles = np.asarray(points, float).reshape(-1, 2), np.asarray(triangles)
    result = np.empty(points.shape)
    for batch in batches(len(points)):
        result[batch, 0], result[batch, 1] = _affine_at(*points[batch].T, triangles[batch], coefficients)
    return result


def batches(count, size=1):
    """Slices of so many things of a size, each about a batch long."""
    step = max(BATCH // size, 1)
    return (slice(start, start + step) for start in range(0, count, step))


def _expanded(first, counts):
    """Runs of whole numbers, each from its first and so many long: the run of each number, and the number."""
    run = np.repeat(np.arange(len(counts)), counts)
    before = np.cumsum(counts) - counts
    return run, np.arange(len(run)) + np.repeat(first - before, counts)
