"""Points that lie inside the triangles of a mesh and move with them, and terms of the energy about such points."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.sparse import csr_array

from seiswidgets.core.point_location import barycentric_coefficients
from seiswidgets.core.term import MOVING, Layer, Term


@dataclass(frozen=True, eq=False)
class PointsInMesh:
    """Points with fixed barycentric coordinates in the triangles, or on the edges, of a mesh.

    Attributes
    ----------
    corners : array, shape (k, 3) or (k, 2)
        The vertices of the triangle or edge of each point.
    shares : array, of the same shape
        The point's barycentric coordinates.
    """

    corners: np.ndarray
    shares: np.ndarray

    @classmethod
    def in_triangles(cls, vertices: np.ndarray, corners: np.ndarray, points: np.ndarray) -> "PointsInMesh":
        """Points of shape (k, 2) in triangles with these corners, shape (k, 3); also a little beyond them."""
        x0, z0, bx, bz, cx, cz = barycentric_coefficients(vertices[corners]).T
        x, z = points[:, 0] - x0, points[:, 1] - z0
        second, third = bx * x + bz * z, cx * x + cz * z
        return cls(corners, np.column_stack([1 - second - third, second, third]))

    @classmethod
    def on_edges(cls, vertices: np.ndarray, edges: np.ndarray, points: np.ndarray) -> "PointsInMesh":
        """The nearest points to some points, shape (k, 2), on some edges, shape (e, 2)."""
        start, along = vertices[edges[:, 0]], vertices[edges[:, 1]] - vertices[edges[:, 0]]
        arms = points[:, None] - start
        share = np.clip(np.sum(arms * along, axis=2) / np.sum(along**2, axis=1), 0, 1)
        nearest = np.argmin(np.sum((arms - share[..., None] * along) ** 2, axis=2), axis=1)
        second = share[np.arange(len(points)), nearest]
        return cls(edges[nearest], np.column_stack([1 - second, second]))

    def positions(self, vertices: np.ndarray) -> np.ndarray:
        """The points after a deformation, shape (k, 2)."""
        return np.einsum("kc,kcx->kx", self.shares, vertices[self.corners])


@dataclass(frozen=True, eq=False)
class AtPoints(Term):
    """A term of points inside a mesh: `Level`, `Stitch` or `EdgeLength` of points instead of vertices.

    Parameters
    ----------
    term : Term
        The term as a function of the points' positions.
    points : PointsInMesh
    """

    term: Term
    points: PointsInMesh
    pattern = MOVING

    @property
    def name(self) -> str:
        return self.term.name

    def residual(self, vertices: np.ndarray) -> np.ndarray:
        return self.term.residual(self.points.positions(vertices))

    def jacobian(self, vertices: np.ndarray) -> csr_array:
        jacobian = self.term.jacobian(self.points.positions(vertices))
        return self._over_vertices(jacobian, jacobian.data, vertices.size)

    def curvature(self, vertices: np.ndarray) -> Sequence[Layer]:
        positions = self.points.positions(vertices)
        layers = self.term.curvature(positions)
        pattern = self.term.jacobian(positions) if layers else None
        return [(self._over_vertices(pattern, data, vertices.size).data, factor) for data, factor in layers]

    def _over_vertices(self, pattern: csr_array, data: np.ndarray, width: int) -> csr_array:
        """Rows over the coordinates of points as rows over those of vertices; zeros stay in the pattern."""
        point, axis = np.divmod(pattern.indices, 2)
        columns = 2 * self.points.corners[point] + axis[:, None]
        entries = data[:, None] * self.points.shares[point]
        pointers = pattern.indptr * columns.shape[1]
        rows = csr_array((entries.ravel(), columns.ravel(), pointers), shape=(pattern.shape[0], width))
        rows.sum_duplicates()
        return rows
