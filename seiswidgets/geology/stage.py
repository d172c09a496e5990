"""One stage of a restoration: a mesh before and after it, and how it carries points and lines along."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property, partial

import numpy as np
import shapely
from shapely import LineString

from seiswidgets.core import deformation
from seiswidgets.core.mapping import PiecewiseAffineMap
from seiswidgets.core.mesh import Mesh, triangle_areas
from seiswidgets.core.rigid import part_of_motion
from seiswidgets.core.seams import outline
from seiswidgets.geology.domain import RestorationDomain
from seiswidgets.geology.findings import Finding, worst_first
from seiswidgets.geology.report import Report
from seiswidgets.geology.segments import horizon_segments, split_at_faults
from seiswidgets.geology.solve import vertex_masses

PERCENTS = (1, 50, 99)
FINE, PLACES = 0.25, 64  # a line is carried at places a quarter of the spacing apart, and at so many at least
CLOSED = 0.02  # of the mesh spacing: half the width of gaps that are filled between two stages


@dataclass(frozen=True, eq=False)
class Stage:
    """A step of a restoration, in metres of rock.

    Attributes
    ----------
    kind : "unfault" or "flatten"
    mesh : Mesh
        Before the step.
    vertices : array, shape (n, 2)
        Where the mesh's vertices are after it.
    faults : tuple of shapely LineString
        What the mesh is cut along, before the step.
    domain : RestorationDomain
        What the step started from.
    found : callable() -> Report
        Makes out what the solver reached; ``report`` adds what asks for the outline.
    mesh_setup : Blocks or Bed
        The mesh before it was welded, and where the picks lie in it: a later stage of the same task takes it over.
    whole : Stage, optional
        The step that this is only a part of.
    """

    kind: str
    mesh: Mesh
    vertices: np.ndarray
    faults: tuple[LineString, ...]
    domain: RestorationDomain
    found: Callable[[], Report]
    mesh_setup: object
    whole: "Stage | None" = None

    def __post_init__(self):
        self.vertices.setflags(write=False)

    @property
    def spacing(self) -> float:
        """Of the mesh, in metres."""
        return self.domain.spacing

    @cached_property
    def report(self) -> Report:
        """What the step has achieved, with a word in it where rock has come to lie on other rock.

        Made when it is first read: pictures that follow the mouse have no time for it.
        """
        if self.whole is not None:
            return self.whole.report
        areas = triangle_areas(self.vertices, self.mesh.triangles)
        found = self.found()
        overlap, findings = max(0.0, float(areas.sum() - self.outline.area)), found.findings
        if overlap > self.domain.slack * self.spacing:
            findings = (*findings, self._overlapping(overlap))
        return replace(found, overlap=overlap, findings=worst_first(findings))

    def _overlapping(self, area):
        """The finding that rock lies on other rock, at the largest triangle whose centre another triangle holds too."""
        centres = self.vertices[self.mesh.triangles].mean(axis=1)
        covered = np.flatnonzero(self.map.target_finder(centres) != np.arange(len(centres)))
        words, where = "", None
        if len(covered):
            largest = self.mesh.triangles[covered[np.argmax(self.mesh.areas[covered])]]
            place = self.mesh.vertices[largest].mean(axis=0)
            words, where = f", such as the rock from near {self.domain.where(place)}", self.domain.position(place)
        text = (
            f"{area:.3g} m² of rock lie on other rock{words}: the picture shows only one of the two there. Check the "
            "throws and the shape of the faults nearby, or undo the faults one after the other"
        )
        return Finding("problem", "overlap", text, where=where)

    def part(self, share: float) -> "Stage":
        """The step at a share of its way, from 0 to 1."""
        masses = vertex_masses(self.mesh)
        vertices = part_of_motion(self.mesh.vertices, self.vertices, self.mesh.blocks, masses, share)
        return replace(self, vertices=vertices, whole=self)

    @cached_property
    def outline(self):
        """What the rock covers after the step, hairline gaps filled: a shapely Polygon or MultiPolygon."""
        return outline(self.mesh, self.vertices, CLOSED * self.spacing, self.map.target_finder)

    @cached_property
    def map(self) -> PiecewiseAffineMap:
        """From before the step to after it."""
        return PiecewiseAffineMap(self.mesh.vertices, self.vertices, self.mesh.triangles)

    @cached_property
    def area_ratio(self) -> np.ndarray:
        """Initial over final area of each triangle (the paper's fig. 6d), shape (m,); above 1 is compression."""
        return deformation.area_ratio(self.mesh, self.vertices)

    @cached_property
    def principal_stretches(self) -> np.ndarray:
        """Length after over before along the two principal directions of each triangle, larger first; shape (m, 2)."""
        return deformation.principal_stretches(self.mesh, self.vertices)

    def carried_horizon(self, pieces) -> list[LineString]:
        """The pieces of a horizon as they lie after the step, drawn on to the faults they end at."""
        return self._carried([part.line for part in horizon_segments(pieces, self.faults)], sideways=0.0)

    def carried_fault(self, line) -> list[LineString]:
        """A fault as it lies after the step, in order, parted where another fault crosses it.

        A fault that the mesh is cut along goes with one of its sides, the same from end to end.
        """
        return self._carried([part.line for part in split_at_faults(line, self.faults)], sideways=1e-3 * self.spacing)

    def _carried(self, lines, sideways):
        carried = [self._moved(line, sideways) for line in lines]
        return [line for line in carried if line is not None]

    def _moved(self, line, sideways):
        points = shapely.get_coordinates(line.segmentize(min(FINE * self.spacing, line.length / PLACES)))
        within = points.copy()  # a line's end on a fault belongs to the triangles of its own side
        nudge = min(2e-3 * self.spacing, line.length / 4)
        within[[0, -1]] = [line.interpolate(way).coords[0] for way in (nudge, line.length - nudge)]
        along = np.gradient(points, axis=0)
        within += sideways * along[:, ::-1] * [-1, 1] / np.hypot(*along.T)[:, None]
        moved = self.map.forward(points, self.map.source_finder(within))
        moved = moved[np.isfinite(moved).all(axis=1)]
        return LineString(moved) if len(moved) > 1 else None


def staged(kind, picks, domain, mesh, vertices, solution, solver, seconds, mesh_setup, achieved, faults=()) -> Stage:
    """The stage that a solution makes.

    Parameters
    ----------
    achieved : callable() -> dict
        What the report says of cut-offs, seams and beds, and which constraints gave way.
    """
    found = partial(_found, kind, picks, domain, mesh, vertices, solution, solver, seconds, achieved)
    return Stage(kind, mesh, vertices, faults, domain, found, mesh_setup)


def _found(kind, picks, domain, mesh, vertices, solution, solver, seconds, achieved):
    ratio = deformation.area_ratio(mesh, vertices)
    percentiles = deformation.weighted_percentiles(ratio, mesh.areas, PERCENTS)
    return Report(
        kind=kind,
        picks=picks,
        solver=solver,
        vertices=len(mesh.vertices),
        triangles=len(mesh.triangles),
        iterations=solution.iterations,
        factorisations=solution.factorisations,
        converged=solution.converged,
        seconds=seconds,
        energy=_energy(solution),
        flipped=int(np.sum(ratio <= 0)),
        area_ratio=dict(zip(PERCENTS, percentiles.tolist(), strict=True)),
        x_unit=domain.section.x_unit,
        z_unit=domain.section.z_unit,
        **_with_settling(achieved(), picks, domain, mesh, ratio, solution),
    )


def _with_settling(achieved, picks, domain, mesh, ratio, solution):
    """What was achieved, with a finding if the solver did not settle."""
    if solution.converged:
        return achieved
    place = mesh.vertices[mesh.triangles[np.argmax(np.abs(np.log(ratio)))]].mean(axis=0)
    text = (
        f"the solver did not settle in {solution.iterations} iterations, so this is not yet the best fit to the picks. "
        f"Allow more (max_iterations), or check the picks near {domain.where(place)}, where the rock is deformed most: "
        "horizons that contradict each other, or a fault that ends too early"
    )
    finding = Finding("problem", "unsettled", text, picks[0] if len(picks) == 1 else None, domain.position(place))
    return {**achieved, "findings": (finding, *achieved["findings"])}


def _energy(solution):
    energy = {}
    for term in solution.terms:
        energy[term.name] = energy.get(term.name, 0.0) + float(np.sum(term.residual(solution.vertices) ** 2))
    return energy
