"""Prescribed slip: the term of the energy that brings points of one side of a fault to given points of the other."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy.sparse import csr_array, eye_array, kron

from seiswidgets.core.term import MOVING, PaperTerm
from seiswidgets.core.terms import sparse_rows

ACROSS = np.array([[0.0, 1.0], [-1.0, 0.0]])  # a row (x, z) times this is (-z, x)


@dataclass(frozen=True, eq=False)
class Facing(PaperTerm):
    """Term that brings each of some vertices to a point between two others, on the smooth curve over their chord.

    Linear in the positions, and without cost under rigid motions.

    Parameters
    ----------
    points : array, shape (p,)
        Vertices of one side of a fault.
    segments : array, shape (p, 2)
        The edge of the other side that each is brought to.
    shares : array, shape (p,)
        Position along that edge, from 0 to 1.
    heights : array, shape (p,)
        Distance there of the curve from the chord, as a share of the chord's length.
    count : int
        Number of vertices of the mesh.
    """

    points: np.ndarray
    segments: np.ndarray
    shares: np.ndarray
    heights: np.ndarray
    count: int
    weight: float = 1.0
    name = "slip"
    pattern = MOVING  # not within one solution, but from one slip to the next

    @property
    def nearest(self) -> np.ndarray:
        """The vertex that lies nearest to each of those points, shape (p,)."""
        return np.asarray(self.segments[np.arange(len(self.points)), (self.shares > 0.5).astype(int)])

    @cached_property
    def rows(self) -> csr_array:
        data = np.column_stack([np.ones(len(self.points)), self.shares - 1, -self.shares])
        return sparse_rows(np.column_stack([self.points, self.segments]), self.weight * data, self.count)

    @cached_property
    def _jacobian(self) -> csr_array:
        ends = np.outer(self.weight * self.heights, [1, -1])
        over = kron(sparse_rows(self.segments, ends, self.count), ACROSS.T)
        return csr_array(kron(self.rows, eye_array(2)) + over)

    def target(self, vertices: np.ndarray) -> np.ndarray:
        chords = vertices[self.segments[:, 1]] - vertices[self.segments[:, 0]]
        return np.asarray(self.weight * self.heights[:, None] * (chords @ ACROSS))

    def residual(self, vertices: np.ndarray) -> np.ndarray:
        return np.asarray(self._jacobian @ vertices.ravel())

    def jacobian(self, vertices: np.ndarray) -> csr_array:
        return self._jacobian

    def distances(self, vertices: np.ndarray) -> np.ndarray:
        """Distance of each vertex from where it should be, in metres."""
        return np.hypot(*(self.residual(vertices) / self.weight).reshape(-1, 2).T)
