"""Stages whose vertices are computed in closed form, without a solver."""

import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from shapely import LineString

from seiswidgets.core.mesh import Mesh, triangle_areas
from seiswidgets.core.solver import Progress, Solution
from seiswidgets.errors import Cancelled, FlippedError
from seiswidgets.geology.domain import RestorationDomain
from seiswidgets.geology.findings import Finding
from seiswidgets.geology.report import CLOSED_FORM, Observations
from seiswidgets.geology.stage import Outcome, Stage


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
        """The stage that moves a mesh's vertices.

        Raises
        ------
        FlippedError
            If triangles are turned over.
        Cancelled
            If ``progress`` returned False.
        """
        flipped = np.flatnonzero(triangle_areas(vertices, mesh.triangles) <= 0)
        if len(flipped):
            point = mesh.vertices[mesh.triangles[flipped[0]]].mean(axis=0)
            raise FlippedError(
                f"the step {self.kind} would turn {len(flipped)} of {len(mesh.triangles)} triangles over, the first "
                f"near {self.domain.where(point)}: the surface there is too steep for rock that moves upright; undo "
                "the slip of the faults first, or draw it smoother",
                count=len(flipped),
                where=self.domain.position(point),
            )
        if self.progress is not None and self.progress(1, 0.0, vertices) is False:
            raise Cancelled("cancelled")
        solution = Solution(vertices, (), 0, 0, True, ())
        seconds = 0.0 if began is None else time.perf_counter() - began
        outcome = Outcome(self.picks, solution, CLOSED_FORM, seconds, observe, tuple(notes))
        setup = PlainSetup(mesh, ())
        return Stage(self.kind, mesh, vertices, (), self.domain, outcome, setup, self.boundaries, burial=burial)
