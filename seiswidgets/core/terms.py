"""Terms of the energy, each with its residual and the exact Jacobian of it."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy.sparse import csr_array, eye_array, kron

from seiswidgets.core.mean_value import mean_value_matrix
from seiswidgets.core.mesh import Mesh, triangle_areas
from seiswidgets.core.term import CONSTANT, MOVING, STEADY, Layer, PaperTerm, Term


@dataclass(frozen=True, eq=False)
class MeanValue(PaperTerm):
    """Term that keeps shapes: each inner vertex stays the same weighted mean of its neighbours (eq. 5, 6)."""

    mesh: Mesh
    weight: float = 1.0
    name = "mean value"
    pattern = CONSTANT

    @cached_property
    def rows(self) -> csr_array:
        return self.weight * mean_value_matrix(self.mesh)

    def target(self, vertices: np.ndarray) -> np.ndarray:
        return np.zeros((self.rows.shape[0], 2))

    def residual(self, vertices: np.ndarray) -> np.ndarray:
        return (self.rows @ vertices).ravel()

    def jacobian(self, vertices: np.ndarray) -> csr_array:
        return kron(self.rows, eye_array(2), format="csr")


@dataclass(frozen=True, eq=False)
class ContourLaplacian(PaperTerm):
    """Term that keeps the bend of the contour at each of its vertices, turned with the contour (eq. 7, 8).

    The turn is the best rotation of the two contour edges (Procrustes in the plane); the paper's T_i is singular
    wherever the contour is straight.
    """

    mesh: Mesh
    weight: float = 1.0
    name = "contour"
    pattern = STEADY

    @cached_property
    def rows(self) -> csr_array:
        before, vertex, after = self.mesh.contour.T
        columns, data = np.column_stack([before, vertex, after]), np.tile([-0.5, 1.0, -0.5], (len(vertex), 1))
        return sparse_rows(columns, self.weight * data, len(self.mesh.vertices))

    @cached_property
    def _rest(self) -> tuple[tuple[np.ndarray, np.ndarray], np.ndarray]:
        """Edges and bends at rest."""
        return self._arms(self.mesh.vertices), self.rows @ self.mesh.vertices

    def _arms(self, vertices: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        before, vertex, after = self.mesh.contour.T
        return vertices[vertex] - vertices[before], vertices[after] - vertices[vertex]

    def _turn(self, vertices: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Cosine and sine of each turn, times a common length."""
        rest, _ = self._rest
        arms = self._arms(vertices)
        cosine = sum(np.sum(a * b, axis=1) for a, b in zip(rest, arms, strict=True))
        sine = sum(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0] for a, b in zip(rest, arms, strict=True))
        return cosine, sine

    def _turn_gradient(self, vertices: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Derivatives of the logarithm of that length, and of the angle, by each vertex's six coordinates."""
        rest, _ = self._rest
        cosine, sine = self._turn(vertices)
        square = np.maximum(cosine**2 + sine**2, np.finfo(float).tiny)[:, None]
        cosine, sine = cosine[:, None] / square, sine[:, None] / square
        # by an edge (x, z) whose rest is (a, b), the cosine changes by (a, b) and the sine by (-b, a)
        arms = [(arm, arm[:, ::-1] * [-1, 1]) for arm in rest]
        lengths = [cosine * along + sine * across for along, across in arms]
        angles = [cosine * across - sine * along for along, across in arms]
        first, second = (np.hstack([-by[0], by[0] - by[1], by[1]]) for by in (lengths, angles))
        return first, second

    def target(self, vertices: np.ndarray) -> np.ndarray:
        _, bend = self._rest
        cosine, sine = self._turn(vertices)
        length = np.maximum(np.hypot(cosine, sine), np.finfo(float).tiny)
        cosine, sine = cosine / length, sine / length
        return np.column_stack([cosine * bend[:, 0] - sine * bend[:, 1], sine * bend[:, 0] + cosine * bend[:, 1]])

    def residual(self, vertices: np.ndarray) -> np.ndarray:
        return (self.rows @ vertices - self.target(vertices)).ravel()

    def jacobian(self, vertices: np.ndarray) -> csr_array:
        _, angle = self._turn_gradient(vertices)
        by_angle = self.target(vertices)[:, ::-1] * [-1, 1]
        linear = self.weight * np.kron([-0.5, 1.0, -0.5], np.eye(2))
        data = linear[None] - by_angle[:, :, None] * angle[:, None, :]
        columns = np.repeat(coordinates(self.mesh.contour), 2, axis=0)
        return sparse_rows(columns, data.reshape(-1, 6), vertices.size)

    def curvature(self, vertices: np.ndarray) -> Sequence[Layer]:
        """Second derivatives, as in `Term`; the two rows of a vertex share theirs.

        The angle is the imaginary part of the logarithm of a linear complex function, so the gradients a of the real
        part and b of the angle make its Hessian, -(a b' + b a').
        """
        log_length, angle = self._turn_gradient(vertices)
        target, residual = self.target(vertices), self.residual(vertices).reshape(-1, 2)
        outward = np.sum(residual * target, axis=1)
        aside = np.sum(residual * target[:, ::-1] * [-1, 1], axis=1)
        crossed = np.stack([log_length + angle, log_length - angle], axis=1)
        both = np.repeat(angle, 2, axis=0)
        return [(crossed.ravel(), np.outer(aside / 2, [1, -1]).ravel()), (both.ravel(), np.repeat(outward / 2, 2))]


@dataclass(frozen=True, eq=False)
class EdgeLength(PaperTerm):
    """Term that keeps the lengths of edges, and so areas and bed lengths (eq. 9, with the vector missing in eq. 10)."""

    rest: np.ndarray
    edges: np.ndarray
    weight: float = 1.0
    name: str = "edge length"
    pattern = STEADY

    @cached_property
    def _lengths(self) -> np.ndarray:
        return self._vectors(self.rest)[1]

    def _vectors(self, vertices: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Unit vectors and lengths of the edges."""
        vectors = vertices.take(self.edges[:, 0], axis=0) - vertices.take(self.edges[:, 1], axis=0)
        lengths = np.sqrt(vectors[:, 0] ** 2 + vectors[:, 1] ** 2)
        return vectors / np.maximum(lengths, np.finfo(float).tiny)[:, None], lengths

    @cached_property
    def rows(self) -> csr_array:
        return sparse_rows(self.edges, np.tile([self.weight, -self.weight], (len(self.edges), 1)), len(self.rest))

    def target(self, vertices: np.ndarray) -> np.ndarray:
        return self.weight * self._lengths[:, None] * self._vectors(vertices)[0]

    def residual(self, vertices: np.ndarray) -> np.ndarray:
        return self.weight * (self._vectors(vertices)[1] - self._lengths)

    def jacobian(self, vertices: np.ndarray) -> csr_array:
        unit, _ = self._vectors(vertices)
        return sparse_rows(coordinates(self.edges), self.weight * np.hstack([unit, -unit]), vertices.size)

    def curvature(self, vertices: np.ndarray) -> Sequence[Layer]:
        """Second derivatives, as in `Term`: a stretched edge resists turning."""
        unit, lengths = self._vectors(vertices)
        normal = unit[:, ::-1] * [-1, 1]
        factor = self.weight**2 * (1 - self._lengths / np.maximum(lengths, np.finfo(float).tiny))
        return [(np.hstack([normal, -normal]).ravel(), factor)]


@dataclass(frozen=True, eq=False)
class Stitch(PaperTerm):
    """Term that brings pairs of vertices together: the two cut-offs of a horizon at a fault (eq. 18)."""

    pairs: np.ndarray
    count: int
    weight: float = 1.0
    name = "stitch"
    pattern = CONSTANT

    @cached_property
    def rows(self) -> csr_array:
        return sparse_rows(self.pairs, np.tile([self.weight, -self.weight], (len(self.pairs), 1)), self.count)

    def target(self, vertices: np.ndarray) -> np.ndarray:
        return np.zeros((len(self.pairs), 2))

    def residual(self, vertices: np.ndarray) -> np.ndarray:
        return (self.rows @ vertices).ravel()

    def jacobian(self, vertices: np.ndarray) -> csr_array:
        return kron(self.rows, eye_array(2), format="csr")


@dataclass(frozen=True, eq=False)
class Level(PaperTerm):
    """Term that brings vertices to a level z, one for all or one for each (eq. 20).

    The paper's target for x, its present value, would only drag.
    """

    vertices: np.ndarray
    datum: float | np.ndarray
    count: int
    weight: float = 1.0
    name = "level"
    pattern = CONSTANT

    @cached_property
    def rows(self) -> csr_array:
        return sparse_rows(self.vertices[:, None], np.full((len(self.vertices), 1), self.weight), self.count)

    def target(self, vertices: np.ndarray) -> np.ndarray:
        datum = np.broadcast_to(self.datum, self.vertices.shape)
        return self.weight * np.column_stack([vertices[self.vertices, 0], datum])

    def residual(self, vertices: np.ndarray) -> np.ndarray:
        return self.weight * (vertices[self.vertices, 1] - self.datum)

    def jacobian(self, vertices: np.ndarray) -> csr_array:
        data = np.full((len(self.vertices), 1), self.weight)
        return sparse_rows(2 * self.vertices[:, None] + 1, data, 2 * self.count)


@dataclass(frozen=True, eq=False)
class AreaBarrier(Term):
    """Term that keeps triangles from turning over; zero while they keep more than a share ``onset`` of their area.

    The residual is (1 - s/onset)^2 / s, times the root of the area at rest, where s is the area now over the area at
    rest. Its square has three continuous derivatives at the onset, so Newton's method does not stumble there.
    """

    mesh: Mesh
    onset: float = 0.4
    name = "area barrier"
    pattern = MOVING

    def _pressed(self, vertices: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Corners, areas at rest and shares of the triangles that are smaller than the onset."""
        share = triangle_areas(vertices, self.mesh.triangles) / self.mesh.areas
        pressed = np.flatnonzero(share < self.onset)
        return self.mesh.triangles[pressed], self.mesh.areas[pressed], share[pressed]

    def residual(self, vertices: np.ndarray) -> np.ndarray:
        _, areas, share = self._pressed(vertices)
        return np.sqrt(areas) * (1 - share / self.onset) ** 2 / share

    def jacobian(self, vertices: np.ndarray) -> csr_array:
        triangles, areas, share = self._pressed(vertices)
        corners = vertices[triangles]
        opposite = corners[:, [2, 0, 1]] - corners[:, [1, 2, 0]]
        by_corner = 0.5 * opposite[..., ::-1] * [-1, 1]
        slope = (self.onset**-2 - share**-2) / np.sqrt(areas)
        return sparse_rows(coordinates(triangles), slope[:, None] * by_corner.reshape(-1, 6), vertices.size)

    def curvature(self, vertices: np.ndarray) -> Sequence[Layer]:
        """Second derivatives, as in `Term`.

        The area is a quadratic form of the corners, the same for all triangles, and split into its four principal
        directions.
        """
        _, areas, share = self._pressed(vertices)
        residual, slope = self.residual(vertices), self.onset**-2 - share**-2
        bend = residual * slope / np.sqrt(areas)
        rows = [(np.tile(direction, len(areas)), size * bend) for size, direction in zip(*AREA_MODES, strict=True)]
        return [(self.jacobian(vertices).data, 2 * residual / (np.sqrt(areas) * share**3 * slope**2)), *rows]


def _area_modes() -> tuple[np.ndarray, np.ndarray]:
    """Principal curvatures of a triangle's area over its corners' coordinates, and their directions in rows."""
    hessian = np.zeros((6, 6))
    for corner in range(3):
        after = (corner + 1) % 3
        hessian[2 * corner, 2 * after + 1] = 0.5
        hessian[2 * after, 2 * corner + 1] = -0.5
    sizes, directions = np.linalg.eigh(hessian + hessian.T)
    curved = np.abs(sizes) > 0.1  # a shift of the whole triangle has none
    return sizes[curved], directions.T[curved]


AREA_MODES = _area_modes()


def coordinates(vertices: np.ndarray) -> np.ndarray:
    """Columns of the x and z of each vertex, side by side: shape (r, k) to (r, 2 k)."""
    return np.asarray((2 * vertices[..., None] + [0, 1]).reshape(len(vertices), 2 * vertices.shape[1]))


def sparse_rows(columns: np.ndarray, data: np.ndarray, width: int) -> csr_array:
    """Sparse matrix whose rows all have the same number of entries, given row by row."""
    pointers = np.arange(len(columns) + 1) * columns.shape[1]
    return csr_array(
        (np.ascontiguousarray(data, float).ravel(), columns.ravel(), pointers), shape=(len(columns), width)
    )
