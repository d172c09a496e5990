"""The problems that stages hand to their solver, to be solved on their own."""

from dataclasses import dataclass, field, replace
from unittest.mock import patch

import numpy as np

import seiswidgets as sw
from seiswidgets.core.mesh import Mesh
from seiswidgets.core.solver import gauss_newton
from seiswidgets.geology import flattening, unfaulting
from seiswidgets.geology.solve import SETTLED


@dataclass
class Problem(Exception):
    """Raised in place of solving."""

    mesh: Mesh
    terms: list
    start: np.ndarray
    free: np.ndarray
    tolerance: float
    rigid: list = field(default_factory=list)  # how rigid_blocks was called

    def solved(self, **keywords):
        """By Gauss-Newton, with nothing kept from an earlier time but the triangulation."""
        mesh = Mesh(self.mesh.vertices, self.mesh.triangles)
        terms = [replace(term, mesh=mesh) if hasattr(term, "mesh") else replace(term) for term in self.terms]
        keywords = {"start": self.start, **keywords}
        return gauss_newton(terms, mesh.triangles, free=self.free, tolerance=self.tolerance, **keywords)


def problem(case, count, fixed=None, **options) -> Problem:
    """Problem of flattening a case's middle horizon, or of unfaulting it if it has faults; about ``count`` vertices."""
    x_min, x_max, z_min, z_max = case.section.extent
    spacing = np.sqrt((x_max - x_min) * (z_max - z_min) * 1.15 / count)
    for _ in range(3):  # picks make a mesh finer than the spacing
        found = _problem(case, spacing, fixed, options)
        spacing *= np.sqrt(len(found.mesh.vertices) / count)
    return found


def _problem(case, spacing, fixed, options):
    calls, rigid_blocks = [], unfaulting.rigid_blocks

    def recorded(*call):
        calls.append(call)
        return rigid_blocks(*call)

    def caught(mesh, terms, start, free, domain, *_, **options):
        raise Problem(mesh, terms, start, free, SETTLED * domain.slack, calls)

    picks, start = case.interpretation, sw.Restoration(case.section, spacing=spacing)
    changes = [
        (unfaulting, "rigid_blocks", recorded),
        *((module, "minimise", caught) for module in (unfaulting, flattening)),
    ]
    with patch.object(*changes[0]), patch.object(*changes[1]), patch.object(*changes[2]):
        try:
            if picks.faults:
                start.unfault(picks.faults, picks.horizons, fixed=fixed, **options)
            else:
                start.flatten(picks.horizons[len(picks.horizons) // 2], **options)
        except Problem as found:
            return found
    raise RuntimeError("the stage has not called its solver")
