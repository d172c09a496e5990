"""The energy's terms, each with its residual and the exact Jacobian of it.

All terms take the positions of all vertices, shape (n, 2), in metres. ``residual`` gives a vector whose squared length
is the term's energy; ``jacobian`` its derivative, a sparse matrix with columns x0, z0, x1, z1, ... A term multiplies
its rows by its weight, as in the paper's eq. 14.

The terms of the paper also give the rows and the lagged targets of its fixed point (eq. 16): ``rows`` is a sparse
matrix over vertices, ``target(vertices)`` what ``rows @ vertices`` is pulled to.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy.sparse import csr_array, eye_array, kron

from seiswidgets.core.mean_value import mean_value_matrix
from seiswidgets.core.mesh import Mesh, triangle_areas

# How a term's Jacobian changes from one place to the next
STEADY = "steady"  # the Jacobian's pattern never changes
CONSTANT = "constant"  # nor do its numbers
MOVING = "moving"  # the pattern follows the vertices


@dataclass(frozen=True, eq=False)
class MeanValue:
    """Keeps each inner vertex at the same weighted mean of its neighbours (eq. 5, 6): keeps shapes."""

    mesh: Mesh
    weight: float = 1.0
    name = "mean value"
    pattern = CONSTANT

    @cached_property
    def rows(self):
        return self.weight * mean_value_matrix(self.mesh)

    def target(self, vertices):
        return np.zeros((self.rows.shape[0], 2))

    def residual(self, vertices):
        return (self.rows @ vertices).ravel()

    def jacobian(self, vertices):
        return kron(self.rows, eye_array(2), format="csr")


@dataclass(frozen=True, eq=False)
class ContourLaplacian:
    """Keeps the bend of the contour at each of its vertices, turned with the contour (eq. 7, 8).

    The turn is the best rotation of the two contour edges (Procrustes in the plane); the paper's T_i is singular
    wherever the contour is straight.
    """

    mesh: Mesh
    weight: float = 1.0
    name = "contour"
    pattern = STEADY

    @cached_property
    def rows(self):
        before, vertex, after = self.mesh.contour.T
        columns, data = np.column_stack([before, vertex, after]), np.tile([-0.5, 1.0, -0.5], (len(vertex), 1))
        return sparse_rows(columns, self.weight * data, len(self.mesh.vertices))

    @cached_property
    def _rest(self):
        return self._arms(self.mesh.vertices), self.rows @ self.mesh.vertices

    def _arms(self, vertices):
        before, vertex, after = self.mesh.contour.T
        return vertices[vertex] - vertices[before], vertices[after] - vertices[vertex]

    def _turn(self, vertices):
        """Cosine and sine of each turn, times a common length, and the edges at rest."""
        rest, _ = self._rest
        arms = self._arms(vertices)
        cosine = sum(np.sum(a * b, axis=1) for a, b in zip(rest, arms, strict=True))
        sine = sum(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0] for a, b in zip(rest, arms, strict=True))
        return cosine, sine

    def target(self, vertices):
        _, bend = self._rest
        cosine, sine = self._turn(vertices)
        length = np.maximum(np.hypot(cosine, sine), np.finfo(float).tiny)
        cosine, sine = cosine / length, sine / length
        return np.column_stack([cosine * bend[:, 0] - sine * bend[:, 1], sine * bend[:, 0] + cosine * bend[:, 1]])

    def residual(self, vertices):
        return (self.rows @ vertices - self.target(vertices)).ravel()

    def jacobian(self, vertices):
        rest, _ = self._rest
        cosine, sine = self._turn(vertices)
        # the angle's derivative by an edge (x, z) whose rest is (a, b) is (cosine (-b, a) - sine (a, b)) / length^2
        by_arm = [cosine[:, None] * arm[:, ::-1] * [-1, 1] - sine[:, None] * arm for arm in rest]
        by_arm = [arm / np.maximum(cosine**2 + sine**2, np.finfo(float).tiny)[:, None] for arm in by_arm]
        by_angle = self.target(vertices)[:, ::-1] * [-1, 1]
        angle = np.concatenate([-by_arm[0], by_arm[0] - by_arm[1], by_arm[1]], axis=1)
        linear = self.weight * np.kron([-0.5, 1.0, -0.5], np.eye(2))
        data = linear[None] - by_angle[:, :, None] * angle[:, None, :]
        columns = np.repeat(coordinates(self.mesh.contour), 2, axis=0)
        return sparse_rows(columns, data.reshape(-1, 6), vertices.size)


@dataclass(frozen=True, eq=False)
class EdgeLength:
    """Keeps the lengths of edges (eq. 9, with the edge vector that eq. 10 misses): keeps areas and bed lengths."""

    rest: np.ndarray
    edges: np.ndarray
    weight: float = 1.0
    name: str = "edge length"
    pattern = STEADY

    @cached_property
    def _lengths(self):
        return self._vectors(self.rest)[1]

    def _vectors(self, vertices):
        vectors = vertices.take(self.edges[:, 0], axis=0) - vertices.take(self.edges[:, 1], axis=0)
        lengths = np.sqrt(vectors[:, 0] ** 2 + vectors[:, 1] ** 2)
        return vectors / np.maximum(lengths, np.finfo(float).tiny)[:, None], lengths

    @cached_property
    def rows(self):
        return sparse_rows(self.edges, np.tile([self.weight, -self.weight], (len(self.edges), 1)), len(self.rest))

    def target(self, vertices):
        return self.weight * self._lengths[:, None] * self._vectors(vertices)[0]

    def residual(self, vertices):
        return self.weight * (self._vectors(vertices)[1] - self._lengths)

    def jacobian(self, vertices):
        unit, _ = self._vectors(vertices)
        return sparse_rows(coordinates(self.edges), self.weight * np.hstack([unit, -unit]), vertices.size)

    def curvature(self, vertices):
        """What the residual's second derivatives add: an edge resists turning as far as it is stretched.

        Returns
        -------
        list of (data, factor)
            Entries of rows with the Jacobian's pattern, and a factor for each row, such that the sum of factor times
            row times row is the sum of residual times its Hessian.
        """
        unit, lengths = self._vectors(vertices)
        normal = unit[:, ::-1] * [-1, 1]
        factor = self.weight**2 * (1 - self._lengths / np.maximum(lengths, np.finfo(float).tiny))
        return [(np.hstack([normal, -normal]).ravel(), factor)]


@dataclass(frozen=True, eq=False)
class Stitch:
    """Brings pairs of vertices together: the two cut-offs of a horizon at a fault (eq. 18)."""

    pairs: np.ndarray
    count: int
    weight: float = 1.0
    name = "stitch"
    pattern = CONSTANT

    @cached_property
    def rows(self):
        return sparse_rows(self.pairs, np.tile([self.weight, -self.weight], (len(self.pairs), 1)), self.count)

    def target(self, vertices):
        return np.zeros((len(self.pairs), 2))

    def residual(self, vertices):
        return (self.rows @ vertices).ravel()

    def jacobian(self, vertices):
        return kron(self.rows, eye_array(2), format="csr")


@dataclass(frozen=True, eq=False)
class Level:
    """Brings vertices to a level z (eq. 20). The paper's target for x, where x is now, would only drag: left out."""

    vertices: np.ndarray
    datum: float
    count: int
    weight: float = 1.0
    name = "level"
    pattern = CONSTANT

    @cached_property
    def rows(self):
        return sparse_rows(self.vertices[:, None], np.full((len(self.vertices), 1), self.weight), self.count)

    def target(self, vertices):
        return self.weight * np.column_stack([vertices[self.vertices, 0], np.full(len(self.vertices), self.datum)])

    def residual(self, vertices):
        return self.weight * (vertices[self.vertices, 1] - self.datum)

    def jacobian(self, vertices):
        data = np.full((len(self.vertices), 1), self.weight)
        return sparse_rows(2 * self.vertices[:, None] + 1, data, 2 * self.count)


@dataclass(frozen=True, eq=False)
class AreaBarrier:
    """Keeps triangles from turning over; silent while they keep more than a share ``onset`` of their area.

    The residual is 1/s - 1/onset, times the triangle's size, where s is the area now over the area at rest.
    """

    mesh: Mesh
    onset: float = 0.4
    name = "area barrier"
    pattern = MOVING

    def at(self, vertices) -> "AreaBarrier":
        """The same term: which triangles it holds follows from the vertices alone."""
        return self

    def _pressed(self, vertices):
        share = triangle_areas(vertices, self.mesh.triangles) / self.mesh.areas
        pressed = np.flatnonzero(share < self.onset)
        return self.mesh.triangles[pressed], self.mesh.areas[pressed], share[pressed]

    def residual(self, vertices):
        _, areas, share = self._pressed(vertices)
        return np.sqrt(areas) * (1 / share - 1 / self.onset)

    def jacobian(self, vertices):
        triangles, areas, share = self._pressed(vertices)
        corners = vertices[triangles]
        opposite = corners[:, [2, 0, 1]] - corners[:, [1, 2, 0]]
        by_corner = 0.5 * opposite[..., ::-1] * [-1, 1]
        data = -(areas**-0.5 / share**2)[:, None] * by_corner.reshape(-1, 6)
        return sparse_rows(coordinates(triangles), data, vertices.size)

    def curvature(self, vertices):
        """What the residual's second derivatives add, as for ``EdgeLength``.

        The residual bends as 1/s does, and the area s itself is a quadratic form of the corners, the same for all
        triangles: it is taken along its four principal directions.
        """
        _, areas, share = self._pressed(vertices)
        residual = self.residual(vertices)
        bend = -residual / (np.sqrt(areas) * share**2)
        rows = [(np.tile(direction, len(areas)), size * bend) for size, direction in zip(*AREA_MODES, strict=True)]
        return [(self.jacobian(vertices).data, 2 * residual * share / np.sqrt(areas)), *rows]


def _area_modes():
    """Principal curvatures of a triangle's area over its corners' coordinates, and their directions in rows."""
    hessian = np.zeros((6, 6))
    for corner in range(3):
        after = (corner + 1) % 3
        hessian[2 * corner, 2 * after + 1] = 0.5
        hessian[2 * after, 2 * corner + 1] = -0.5
    sizes, directions = np.linalg.eigh(hessian + hessian.T)
    curved = np.abs(sizes) > 0.1  # a shift of the whole triangle is no curvature
    return sizes[curved], directions.T[curved]


AREA_MODES = _area_modes()


def coordinates(vertices):
    """Columns of the x and z of each vertex, side by side: shape (r, k) to (r, 2 k)."""
    return (2 * vertices[..., None] + [0, 1]).reshape(len(vertices), 2 * vertices.shape[1])


def sparse_rows(columns, data, width):
    """A sparse matrix whose rows all have the same number of entries, given row by row."""
    pointers = np.arange(len(columns) + 1) * columns.shape[1]
    return csr_array(
        (np.ascontiguousarray(data, float).ravel(), columns.ravel(), pointers), shape=(len(columns), width)
    )
