"""Stages whose vertices are computed in closed form, without a solver."""

import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from scipy.sparse import csr_array
from scipy.sparse.csgraph import connected_components
from shapely import LineString

from seiswidgets.core.mesh import Mesh, triangle_areas
from seiswidgets.core.solver import Progress, Solution
from seiswidgets.errors import Cancelled, FlippedError
from seiswidgets.geology.domain import RestorationDomain
from seiswidgets.geology.findings import Finding
from seiswidgets.geology.report import CLOSED_FORM, Observations
from seiswidgets.geology.stage import Outcome, Stage

LEAST = 1e-3  # of its area, that a triangle keeps
SMOOTHINGS = 200


@dataclass(frozen=True, eq=False)
class PlainSetup:
    """A mesh that needs no solver, and everything that shaped it."""

    mesh: Mesh
    fingerprint: tuple


@dataclass(frozen=True, eq=False)
class ClosedForm:
    """A stage in the making.

    Attributes
    ----------
    kind : str
    picks : tuple of str
        Names of the horizons that it is about.
    domain : RestorationDomain
        The rock before it.
    progress : callable, optional
        See `Restoration.unfault`.
    boundaries : tuple of LineString
        Faults that no bed crosses, before the step.
    """

    kind: str
    picks: tuple[str, ...]
    domain: RestorationDomain
    progress: Progress | None = None
    boundaries: tuple[LineString, ...] = ()

    def stage(
        self,
        mesh: Mesh,
        vertices: np.ndarray,
        observe: Callable[[], Observations] = Observations,
        notes: Sequence[Finding] = (),
        began: float | None = None,
        burial: np.ndarray | None = None,
    ) -> Stage:
        """The stage that moves a mesh's vertices; where it would turn triangles over, they move as one.

        Raises
        ------
        FlippedError
            If triangles are turned over even so.
        Cancelled
            If ``progress`` returned False.
        """
        smooth = _without_flips(mesh, vertices)
        flipped = np.flatnonzero(_squashed(mesh, smooth))
        if len(flipped):
            point = mesh.vertices[mesh.triangles[flipped[0]]].mean(axis=0)
            raise FlippedError(
                f"the step {self.kind} would turn {len(flipped)} of {len(mesh.triangles)} triangles over, the first "
                f"near {self.domain.where(point)}: the surface there is too steep for rock that moves upright; undo "
                "the slip of the faults first, or draw it smoother",
                count=len(flipped),
                where=self.domain.position(point),
            )
        notes = (*notes, *self._smoothed(mesh, vertices, smooth))
        vertices = smooth
        if self.progress is not None and self.progress(1, 0.0, vertices) is False:
            raise Cancelled("cancelled")
        solution = Solution(vertices, (), 0, 0, True, ())
        seconds = 0.0 if began is None else time.perf_counter() - began
        outcome = Outcome(self.picks, solution, CLOSED_FORM, seconds, observe, tuple(notes))
        setup = PlainSetup(mesh, ())
        return Stage(self.kind, mesh, vertices, (), self.domain, outcome, setup, self.boundaries, burial=burial)

    def _smoothed(self, mesh: Mesh, vertices: np.ndarray, smooth: np.ndarray) -> tuple[Finding, ...]:
        """A finding if the displacement was changed by more than the slack, where it was most."""
        change = np.abs(smooth - vertices).max(axis=1)
        if change.max() <= self.domain.slack:
            return ()
        point = mesh.vertices[np.argmax(change)]
        text = (
            f"the rock moves so differently from column to column near {self.domain.where(point)} that the step "
            f"{self.kind} was smoothed there, by up to {self.domain.length(change.max())}; a fault whose slip was not "
            "undone, or a steep surface, does that"
        )
        return (Finding("warning", "smoothed", text, where=self.domain.position(point)),)


def _squashed(mesh: Mesh, vertices: np.ndarray) -> np.ndarray:
    """True for triangles that have lost nearly all of their area, or are turned over."""
    return np.asarray(triangle_areas(vertices, mesh.triangles) <= LEAST * mesh.areas)


def _without_flips(mesh: Mesh, vertices: np.ndarray) -> np.ndarray:
    """Vertices after a step, where groups of triangles that it would turn over, as slivers, move without deformation.

    Neighbours that this turns over join their group, until no triangle is turned over.
    """
    displacement, count = vertices - mesh.vertices, len(vertices)
    stiff = np.zeros(len(mesh.triangles), bool)
    for _ in range(SMOOTHINGS):
        bad = _squashed(mesh, vertices)
        if not (bad & ~stiff).any():
            break
        stiff |= bad
        pairs = mesh.triangles[stiff][:, [0, 1, 1, 2]].reshape(-1, 2)
        _, group = connected_components(csr_array((np.ones(len(pairs)), pairs.T), shape=(count, count)), directed=False)
        sizes = np.bincount(group)
        means = [np.bincount(group, displacement[:, axis]) / sizes for axis in (0, 1)]
        vertices = mesh.vertices + np.column_stack(means)[group]
    return vertices
