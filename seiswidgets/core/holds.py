"""Terms of the energy that hold points where they are, and edges in their directions."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy.sparse import csr_array, eye_array, kron

from seiswidgets.core.interpolated import PointsInMesh
from seiswidgets.core.term import CONSTANT, Term
from seiswidgets.core.terms import coordinates, sparse_rows


@dataclass(frozen=True, eq=False)
class Hold(Term):
    """Term that keeps coordinates of points in triangles.

    Parameters
    ----------
    within : PointsInMesh
    points : array, shape (k, 2)
        Where the points are held.
    held : array of bool, shape (k, 2)
        The coordinates that are held.
    count : int
        Number of vertices.
    weight : float
    """

    within: PointsInMesh
    points: np.ndarray
    held: np.ndarray
    count: int
    weight: float = 1.0
    name = "hold"
    pattern = CONSTANT

    @cached_property
    def _rows(self) -> csr_array:
        means = sparse_rows(self.within.corners, self.weight * self.within.shares, self.count)
        return csr_array(kron(means, eye_array(2), format="csr")[np.flatnonzero(self.held.ravel())])

    def residual(self, vertices: np.ndarray) -> np.ndarray:
        return np.asarray(self.weight * (self.within.positions(vertices) - self.points)[self.held])

    def jacobian(self, vertices: np.ndarray) -> csr_array:
        return self._rows


@dataclass(frozen=True, eq=False)
class EdgeDirection(Term):
    """Term that keeps edges from turning: the part of each edge across its direction at rest.

    For a block that turns by an angle a, it is the sine of a times the lengths of its edges.

    Parameters
    ----------
    rest : array, shape (n, 2)
    edges : array, shape (k, 2)
    weight : float
    """

    rest: np.ndarray
    edges: np.ndarray
    weight: float = 1.0
    name = "rotation"
    pattern = CONSTANT

    @cached_property
    def _rows(self) -> csr_array:
        arms = self.rest[self.edges[:, 1]] - self.rest[self.edges[:, 0]]
        across = self.weight * arms[:, ::-1] * [-1, 1] / np.hypot(*arms.T)[:, None]
        return sparse_rows(coordinates(self.edges), np.hstack([-across, across]), self.rest.size)

    def residual(self, vertices: np.ndarray) -> np.ndarray:
        return np.asarray(self._rows @ vertices.ravel())

    def jacobian(self, vertices: np.ndarray) -> csr_array:
        return self._rows
