"""Terms for rock whose beds slip past each other: they keep areas, and lengths along the beds."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy.sparse import csr_array

from seiswidgets.core.mesh import Mesh, triangle_areas
from seiswidgets.core.term import STEADY, Layer, Term
from seiswidgets.core.terms import AREA_MODES, coordinates, sparse_rows


@dataclass(frozen=True, eq=False)
class BedStretch(Term):
    """Term that keeps lengths along the beds in each triangle, weighted by the root of its area.

    Parameters
    ----------
    mesh : Mesh
    directions : array, shape (m, 2)
        Unit vector along the beds in each triangle, at rest.
    weight : float
    """

    mesh: Mesh
    directions: np.ndarray
    weight: float = 1.0
    name = "bedding"
    pattern = STEADY

    @cached_property
    def _shares(self) -> np.ndarray:
        """Coefficients of the corners in the image of the triangle's direction, shape (m, 3)."""
        corners = self.mesh.vertices[self.mesh.triangles]
        opposite = corners[:, [2, 0, 1]] - corners[:, [1, 2, 0]]
        across = opposite[..., ::-1] * [-1, 1]  # twice the area times the gradient of each barycentric coordinate
        return np.asarray(np.einsum("mcx,mx->mc", across, self.directions) / (2 * self.mesh.areas[:, None]))

    @cached_property
    def _weights(self) -> np.ndarray:
        return self.weight * np.sqrt(self.mesh.areas)

    def _images(self, vertices: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Unit vectors along the deformed directions, and their stretches."""
        images = np.einsum("mc,mcx->mx", self._shares, vertices[self.mesh.triangles])
        stretches = np.maximum(np.hypot(*images.T), np.finfo(float).tiny)
        return images / stretches[:, None], stretches

    def residual(self, vertices: np.ndarray) -> np.ndarray:
        return np.asarray(self._weights * (self._images(vertices)[1] - 1))

    def _rows(self, along: np.ndarray) -> np.ndarray:
        return np.asarray((self._shares[:, :, None] * along[:, None, :]).reshape(-1, 6))

    def jacobian(self, vertices: np.ndarray) -> csr_array:
        rows = self._weights[:, None] * self._rows(self._images(vertices)[0])
        return sparse_rows(coordinates(self.mesh.triangles), rows, vertices.size)

    def curvature(self, vertices: np.ndarray) -> Sequence[Layer]:
        """Second derivatives, as in `Term`: stretched beds resist turning."""
        unit, stretches = self._images(vertices)
        return [(self._rows(unit[:, ::-1] * [-1, 1]).ravel(), self._weights**2 * (1 - 1 / stretches))]


@dataclass(frozen=True, eq=False)
class AreaChange(Term):
    """Term that keeps the area of each triangle: relative change, times the root of the area at rest."""

    mesh: Mesh
    weight: float = 1.0
    name = "bedding"
    pattern = STEADY

    @cached_property
    def _scale(self) -> np.ndarray:
        return self.weight / np.sqrt(self.mesh.areas)

    def residual(self, vertices: np.ndarray) -> np.ndarray:
        return np.asarray(self._scale * (triangle_areas(vertices, self.mesh.triangles) - self.mesh.areas))

    def jacobian(self, vertices: np.ndarray) -> csr_array:
        corners = vertices[self.mesh.triangles]
        opposite = corners[:, [2, 0, 1]] - corners[:, [1, 2, 0]]
        rows = 0.5 * self._scale[:, None] * (opposite[..., ::-1] * [-1, 1]).reshape(-1, 6)
        return sparse_rows(coordinates(self.mesh.triangles), rows, vertices.size)

    def curvature(self, vertices: np.ndarray) -> Sequence[Layer]:
        """Second derivatives, as in `Term`."""
        bend = self._scale * self.residual(vertices)
        return [(np.tile(direction, len(bend)), size * bend) for size, direction in zip(*AREA_MODES, strict=True)]
