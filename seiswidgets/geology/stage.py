"""One stage of a restoration: a mesh before and after it, and how it carries points and lines along."""

from collections.abc import Callable, Hashable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from itertools import pairwise
from typing import Protocol

import numpy as np
import shapely
from shapely import LineString, MultiPolygon, Polygon

from seiswidgets.core import deformation
from seiswidgets.core.mapping import PiecewiseAffineMap
from seiswidgets.core.mesh import Mesh, triangle_areas
from seiswidgets.core.meshers import chosen_mesher
from seiswidgets.core.rigid import part_of_motion
from seiswidgets.core.seams import new_holes, outline
from seiswidgets.core.solver import Solution
from seiswidgets.errors import Keyword, Text
from seiswidgets.geology.bodies import Region
from seiswidgets.geology.domain import ON_BORDER, RestorationDomain
from seiswidgets.geology.findings import Finding, worst_first
from seiswidgets.geology.motion import observe_motion
from seiswidgets.geology.picks import Fault, Horizon
from seiswidgets.geology.report import BodyReport, Observations, Report
from seiswidgets.geology.segments import JOINED, horizon_segments, join_pieces
from seiswidgets.geology.shared_stretches import follow, split_into_stretches
from seiswidgets.geology.slip_profile import SlipProfile
from seiswidgets.geology.weights import Weights

STRIP, UNERODE, DECOMPACT, ISOSTASY = "strip", "unerode", "decompact", "isostasy"
SAGITTA = 0.025  # of the mesh spacing: farther from the nearest edge, a point of a fault lies in the rock
SIDEWAYS, INWARDS = 1e-3, 0.02  # of the mesh spacing, from a line on a fault to the triangles that carry it
PERCENTS = (1, 50, 99)
FINE, LEAST_POINTS = 0.25, 64  # a line is carried at points a quarter of the spacing apart, and at least this many
WITHIN = np.vstack([np.full(3, 1 / 3), 0.1 + 0.7 * np.eye(3), 0.45 - 0.35 * np.eye(3)])  # points in a triangle
COMPASS = [np.array([np.sin(turn), np.cos(turn)]) for turn in np.pi / 4 * np.arange(8)]
TOUCHING = 1e-4  # of the mesh spacing, from a line to a border that it made
REMEMBERED = 200  # picks whose lines a stage keeps
MEETING = 0.3  # traces and samples: ends of pieces that meet after a step of a sequence
CLOSED = 0.02  # of the mesh spacing: half the width of gaps that are filled between two stages


class MeshSetup(Protocol):
    """A stage's mesh before it is welded, and the picks in it; a later stage with the same fingerprint reuses it."""

    @property
    def mesh(self) -> Mesh:
        """The mesh before the step."""

    @property
    def fingerprint(self) -> tuple:
        """Everything that shaped the mesh; see `RestorationDomain.fingerprint`."""


@dataclass(frozen=True, eq=False)
class Outcome:
    """The solution of a stage, from which the report is made when it is first read.

    Attributes
    ----------
    picks : tuple of str
        Names of the faults, or of the horizon.
    solution : Solution
    solver : str
    seconds : float
    observe : callable() -> Observations
        Measures what the solution has done to cut-offs, seams and beds.
    notes : tuple of Finding
        About how the picks were brought into the mesh.
    """

    picks: tuple[str, ...]
    solution: Solution
    solver: str
    seconds: float
    observe: Callable[[], Observations]
    notes: tuple[Finding, ...] = ()

    @property
    def energy(self) -> dict[str, float]:
        """Energy by the name of the term, in square metres."""
        energy: dict[str, float] = {}
        for term in self.solution.terms:
            energy[term.name] = energy.get(term.name, 0.0) + float(np.sum(term.residual(self.solution.vertices) ** 2))
        return energy


@dataclass(frozen=True, eq=False)
class Stage:
    """A step of a restoration, in metres of rock.

    Attributes
    ----------
    kind : str
        "unfault", "flatten", "strip", "unerode", "decompact" or "isostasy".
    mesh : Mesh
        Before the step; of the rock that remains after it.
    vertices : array, shape (n, 2)
        Positions of the mesh's vertices after it.
    faults : tuple of shapely LineString
        Lines that the mesh is cut along, before the step.
    boundaries : tuple of shapely LineString
        Faults that this step does not restore, before the step: no bed crosses them.
    domain : RestorationDomain
        The rock before the step.
    outcome : Outcome
        The solution, for the report.
    mesh_setup : MeshSetup
    whole : Stage, optional
        The step that this is only a part of.
    weights : Weights, optional
    slip : dict of str to SlipProfile
        Prescribed slip, by fault.
    fixed, pins, regional
        What was held, in the present-day section's units; see `Restoration.unfault`.
    drawn : tuple of Fault or Horizon
        The picks that the step was given, on the present-day section.
    age : float, optional
        Time that the rock after the step stands for, in Ma.
    burial : array, shape (n,), optional
        Depth of burial that the porosity at each vertex stands for after the step, in metres; the deepest one, as far
        as it is known. None if the step leaves porosities as they are.
    carried : dict
        Lines of picks after this step, which the next steps start from.
    """

    kind: str
    mesh: Mesh
    vertices: np.ndarray
    faults: tuple[LineString, ...]
    domain: RestorationDomain
    outcome: Outcome
    mesh_setup: MeshSetup
    boundaries: tuple[LineString, ...] = ()
    whole: "Stage | None" = None
    weights: Weights | None = None
    fixed: tuple[float, float] | None = None
    pins: tuple[tuple[float, float], ...] = ()
    regional: float | Sequence[tuple[float, float]] | None = None
    slip: Mapping[str, SlipProfile] = field(default_factory=dict)
    drawn: tuple[Fault | Horizon, ...] = ()
    age: float | None = None
    burial: np.ndarray | None = None
    carried: dict[Hashable, list[LineString]] = field(default_factory=dict, init=False, repr=False)

    def __post_init__(self) -> None:
        self.vertices.setflags(write=False)

    @property
    def spacing(self) -> float:
        """Mesh spacing, in metres."""
        return self.domain.spacing

    @cached_property
    def report(self) -> Report:
        """The report of the whole step, with its findings.

        Made when it is first read: pictures that follow the mouse have no time for it.
        """
        if self.whole is not None:
            return self.whole.report
        outcome, solution = self.outcome, self.outcome.solution
        observations = outcome.observe()
        percentiles = deformation.weighted_percentiles(self.area_ratio, self.mesh.areas, PERCENTS)
        areas = triangle_areas(self.vertices, self.mesh.triangles)
        overlap = max(0.0, float(areas.sum() - self.outline.area))
        holes = new_holes(self.domain.outline, self.outline)
        gap = sum(hole.area for hole in holes)
        names = outcome.picks if self.faults else ()
        motions, folds = observe_motion(
            self.mesh, self.vertices, dict(zip(names, self.faults, strict=False)), self.domain
        )
        findings = (
            *self._unsettled(),
            *folds,
            *observations.findings,
            *outcome.notes,
            *self._overlapping(overlap),
            *self._gaping(holes),
        )
        return Report(
            kind=self.kind,
            picks=outcome.picks,
            solver=outcome.solver,
            mesher=chosen_mesher(),
            vertices=len(self.mesh.vertices),
            triangles=len(self.mesh.triangles),
            iterations=solution.iterations,
            factorisations=solution.factorisations,
            converged=solution.converged,
            seconds=outcome.seconds,
            energy=outcome.energy,
            flipped=int(np.sum(self.area_ratio <= 0)),
            area_ratio=dict(zip(PERCENTS, percentiles.tolist(), strict=True)),
            overlap=overlap,
            gap=gap,
            cutoffs=observations.cutoffs,
            seams=observations.seams,
            beds=observations.beds,
            slips=observations.slips,
            motions=motions,
            bodies=tuple(
                BodyReport(name, body.area, self.carried_bodies[name].area) for name, body in self.domain.bodies.items()
            ),
            findings=worst_first(findings),
            x_unit=self.domain.section.x_unit,
            z_unit=self.domain.section.z_unit,
            sample=self.domain.sample,
            velocity=self.domain.section.velocity_text,
            age=self.age,
            details=observations.details,
        )

    def remember(self, key: Hashable, lines: list[LineString]) -> None:
        """Keep the lines of a pick after the step, for the next stages; the oldest are forgotten."""
        self.carried[key] = lines
        if len(self.carried) > REMEMBERED:
            self.carried.pop(next(iter(self.carried)), None)

    def with_notes(self, *notes: Finding) -> "Stage":
        """The stage with findings about its picks that were made before solving."""
        return replace(self, outcome=replace(self.outcome, notes=notes))

    def _unsettled(self) -> tuple[Finding, ...]:
        """A finding if the solver did not settle."""
        solution, picks = self.outcome.solution, self.outcome.picks
        if solution.converged:
            return ()
        most = np.argmax(np.abs(np.log(self.area_ratio)))
        point = self.mesh.vertices[self.mesh.triangles[most]].mean(axis=0)
        text = Text(
            f"the solver did not settle in {solution.iterations} iterations, so this is not yet the best fit to the "
            "picks. Allow more by ",
            Keyword("max_iterations"),
            f", or check the picks near {self.domain.where(point)}, where the rock is deformed most: horizons that "
            "contradict each other, or a fault that ends too early",
        )
        pick = picks[0] if len(picks) == 1 else None
        return (Finding("problem", "unsettled", text, pick, self.domain.position(point)),)

    def _overlapping(self, area: float) -> tuple[Finding, ...]:
        """A finding if rock lies on other rock, at the largest triangle in which another one covers a point too."""
        if area <= self.domain.slack * self.spacing:
            return ()
        inside = np.einsum("pc,tcx->ptx", WITHIN, self.vertices[self.mesh.triangles])
        holders = self.map.target_finder(inside.reshape(-1, 2)).reshape(len(WITHIN), -1)
        which, covered = np.nonzero(holders != np.arange(len(self.mesh.triangles)))
        example, where = "", None
        if len(covered):
            largest = np.argmax(self.mesh.areas[covered])
            point = WITHIN[which[largest]] @ self.mesh.vertices[self.mesh.triangles[covered[largest]]]
            example, where = f", such as the rock from near {self.domain.where(point)}", self.domain.position(point)
        text = (
            f"{self.domain.area(area)} of rock lie on other rock{example}: the picture shows only one of the two. "
            "Check the throws and the shape of the faults nearby, or undo the faults one after the other"
        )
        return (Finding("problem", "overlap", text, where=where),)

    def _gaping(self, holes: Sequence[Polygon]) -> tuple[Finding, ...]:
        """A finding if the step has opened holes, at the largest."""
        area = sum(hole.area for hole in holes)
        if area <= self.domain.slack * self.spacing:
            return ()
        largest = max(holes, key=lambda hole: hole.area).representative_point().coords[0]
        point = self.mesh.vertices[np.argmin(np.hypot(*(self.vertices - largest).T))]
        text = (
            f"{self.domain.area(area)} of gaps have opened between the blocks, the largest next to the rock from near "
            f"{self.domain.where(point)}; check the throws and the shape of the faults there"
        )
        return (Finding("warning", "gap", text, where=self.domain.position(point)),)

    def part(self, share: float) -> "Stage":
        """The step carried out in part, for a share from 0 to 1."""
        vertices = part_of_motion(self.mesh.vertices, self.vertices, self.mesh.blocks, self.mesh.vertex_areas, share)
        return replace(self, vertices=vertices, whole=self)

    @cached_property
    def outline(self) -> Polygon | MultiPolygon:
        """Outline of the rock after the step, hairline gaps filled."""
        return outline(self.mesh, self.vertices, CLOSED * self.spacing, self.map.target_finder)

    @cached_property
    def map(self) -> PiecewiseAffineMap:
        """From before the step to after it."""
        return PiecewiseAffineMap(self.mesh.vertices, self.vertices, self.mesh.triangles)

    @cached_property
    def area_ratio(self) -> np.ndarray:
        """Area before over area after the step, of each triangle (the paper's fig. 6d), shape (m,).

        Above 1, rock was compressed by restoring it, so that it was dilated in nature: the ratio equals the deformed
        area over the undeformed one. The change by the restoration itself is its reciprocal.
        """
        return deformation.area_ratio(self.mesh, self.vertices)

    @cached_property
    def principal_stretches(self) -> np.ndarray:
        """Length after over before along the two principal directions of each triangle, larger first; shape (m, 2)."""
        return deformation.principal_stretches(self.mesh, self.vertices)

    def carried_horizon(self, pieces: Sequence[LineString]) -> list[LineString]:
        """The pieces of a horizon after the step, joined where they now meet across its faults.

        In a sequence only those that meet exactly: older horizons keep what is left of their offset.
        """
        segments = horizon_segments(pieces, (*self.faults, *self.boundaries), self.domain.cell)
        carried = [(line, segment.ends) for segment in segments if (line := self._carry_line(segment.line, 0.0))]
        at_boundary = {
            (index, which)
            for index, (_, ends) in enumerate(carried)
            for which, end in zip((0, -1), ends, strict=True)
            if end and end.fault >= len(self.faults)
        }
        reach = JOINED if self.age is None else MEETING
        return join_pieces([line for line, _ in carried], self.domain.cell, at_boundary, reach)

    def carried_fault(self, line: LineString) -> list[LineString]:
        """A fault after the step, in order, split where another fault crosses it.

        A fault that the mesh is cut along goes with one of its sides, the same from end to end. Of a fault that
        shares a stretch with another one, that side is chosen, with or without that stretch, on which its parts
        stay together.
        """
        if self.kind == STRIP:
            return self._carry(self._kept(line), 0.0)
        line = follow(line, self.faults, self.domain.sample)
        parts = split_into_stretches(line, self.faults, self.domain.sample)
        own = [part for part, shared in parts if not shared]
        ways = [
            self._carry(lines, side * self._sideways(line))
            for lines in ([part for part, _ in parts], own)
            for side in ((1, -1) if len(parts) > 1 else (1,))
            if lines
        ]
        return min(ways, key=lambda lines: round(_gaps(lines) / (CLOSED * self.spacing)))

    @cached_property
    def carried_bodies(self) -> dict[str, Region]:
        """The bodies after the step, by name."""
        return {name: self.carried_body(body) for name, body in self.domain.bodies.items()}

    def carried_body(self, body: Region) -> Region:
        """A body after the step, as far as there is rock around it: its border moves with that rock."""
        parts = [self._carry_ring(part.exterior) for part in shapely.get_parts(body)]
        return shapely.union_all([part for part in parts if part is not None])

    def _carry_ring(self, ring: shapely.LinearRing) -> Region | None:
        points = shapely.get_coordinates(ring.segmentize(FINE * self.spacing))[:-1]
        along = np.roll(points, -1, axis=0) - np.roll(points, 1, axis=0)
        outwards = along[:, ::-1] * [1, -1] * (1 if ring.is_ccw else -1)
        outwards /= np.maximum(np.hypot(*outwards.T), np.finfo(float).tiny)[:, None]
        triangles = np.full(len(points), -1)
        for direction in (outwards, *COMPASS):  # at a corner on the border, the rock lies in another one
            missing = np.flatnonzero(triangles < 0)
            triangles[missing] = self.map.source_finder((points + INWARDS * self.spacing * direction)[missing])
        moved = self.map.forward(points, triangles)
        moved = moved[np.isfinite(moved).all(axis=1)]
        return Polygon(moved).buffer(0) if len(moved) > 2 else None

    def _carry(self, lines: Iterable[LineString], sideways: float) -> list[LineString]:
        carried = [self._carry_line(line, sideways) for line in lines]
        return [line for line in carried if line is not None]

    def _sideways(self, line: LineString) -> float:
        """Distance from a fault that is surely in the triangles of one side: they have chords where it is curved."""
        points = shapely.points(shapely.get_coordinates(line))
        _, distances = self._border.query_nearest(points, all_matches=False, return_distance=True)
        close = distances[distances < SAGITTA * self.spacing]
        return float(max(SIDEWAYS * self.spacing, 2 * np.max(close, initial=0.0)))

    def _kept(self, line: LineString) -> list[LineString]:
        """The parts of a fault that lie in the rock that remains, or along its border, which follows faults exactly."""
        parts = shapely.get_parts(line.intersection(self.outline.buffer(TOUCHING * self.spacing)))
        return [part for part in parts if part.geom_type == "LineString" and part.length > self.domain.sample]

    def _carry_line(self, line: LineString, sideways: float) -> LineString | None:
        points = shapely.get_coordinates(line.segmentize(min(FINE * self.spacing, line.length / LEAST_POINTS)))
        within = points.copy()  # what ends on a fault belongs to the triangles of its own side
        nudge = min(INWARDS * self.spacing, line.length / 4)
        at = np.append(0.0, np.hypot(*np.diff(points, axis=0).T).cumsum())
        for end, distance in ((at < nudge, nudge), (at > line.length - nudge, line.length - nudge)):
            within[end] = line.interpolate(distance).coords[0]
        along = np.gradient(points, axis=0)
        lengths = np.maximum(np.hypot(*along.T), np.finfo(float).tiny)  # 0 where a line turns back
        within += sideways * along[:, ::-1] * [-1, 1] / lengths[:, None]
        triangles = self.map.source_finder(within)
        missing = np.flatnonzero(triangles < 0)
        if len(missing):
            near, edge = self._border.query_nearest(
                shapely.points(within[missing]), max_distance=ON_BORDER * self.domain.sample, all_matches=False
            )
            missing = missing[near]
            triangles[missing] = self.mesh.boundary_half_edges[edge] // 3
            points[missing] = _onto(points[missing], self._border.geometries[edge])
        moved = self.map.forward(points, triangles)
        moved = moved[np.isfinite(moved).all(axis=1)]
        return LineString(moved) if len(moved) > 1 else None

    @cached_property
    def _border(self) -> shapely.STRtree:
        """The edges of the mesh's boundary, before the step: a line along the border may lie just outside them."""
        return shapely.STRtree(shapely.linestrings(self.mesh.vertices[self.mesh.boundary]))


def _onto(points: np.ndarray, edges: np.ndarray) -> np.ndarray:
    """The point of each edge nearest to a point, shape (n, 2)."""
    return shapely.get_coordinates(
        shapely.line_interpolate_point(edges, shapely.line_locate_point(edges, shapely.points(points)))
    )


def _gaps(lines: Sequence[LineString]) -> float:
    """Total distance from the end of each line to the start of the next."""
    ends = ((one.coords[-1], other.coords[0]) for one, other in pairwise(lines))
    return sum(float(np.hypot(*np.subtract(end, start))) for end, start in ends)
