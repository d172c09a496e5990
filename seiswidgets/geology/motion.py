"""Rigid motion of blocks, and of the limbs beside faults that die out: how far each has turned and moved."""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np
import shapely
from shapely import LineString, MultiPolygon, Polygon

from seiswidgets.core.mesh import Mesh
from seiswidgets.core.rigid import RigidMotion, rigid_motion
from seiswidgets.geology.cutoffs import WALLS
from seiswidgets.geology.domain import RestorationDomain
from seiswidgets.geology.findings import Finding
from seiswidgets.geology.report import MotionReport
from seiswidgets.geology.segments import hanging_side

FOLDED, SEVERELY = 5.0, 15.0  # degrees about a fault's tip: a warning, a problem
BESIDE = 1e-3  # of a fault's length: distance of points on either side of it
LEAST = 1e-3  # of the rock's area: smaller parts are slivers between lines
TRIANGLES = 20_000  # are enough for the mean motion of all parts
NAMED = 2  # faults in the name of a part, at most


@dataclass(frozen=True, eq=False)
class RockParts:
    """The parts that faults divide the rock into; a fault that dies out is continued straight from its tip.

    Attributes
    ----------
    outline : shapely Polygon or MultiPolygon
    faults : dict of str to LineString
    """

    outline: Polygon | MultiPolygon
    faults: Mapping[str, LineString]

    @cached_property
    def continuations(self) -> dict[tuple[str, int], LineString]:
        """The straight line from each tip to what it meets first, by fault and end (0 or -1)."""
        found: dict[tuple[str, int], LineString] = {}
        for name, fault in self.faults.items():
            others = [line for other, line in self.faults.items() if other != name]
            for which in (0, -1):
                tip, direction = _heading(fault, which)
                barriers = shapely.union_all([self.outline.boundary, *others, *found.values()])
                touch = 1e-6 * fault.length
                if self.outline.contains(shapely.Point(tip)) and barriers.distance(shapely.Point(tip)) > touch:
                    found[name, which] = _continued(tip, direction, barriers)
        return found

    @cached_property
    def faces(self) -> np.ndarray:
        """The parts, as shapely polygons."""
        lengthened = [_overshooting(line) for line in (*self.faults.values(), *self.continuations.values())]
        lines = shapely.union_all([self.outline.boundary, *lengthened])
        faces = shapely.get_parts(shapely.polygonize(shapely.get_parts(lines)))
        inside = shapely.contains(self.outline, shapely.point_on_surface(faces))
        return faces[inside & (shapely.area(faces) > LEAST * self.outline.area)]

    @cached_property
    def names(self) -> list[str]:
        """A name for each part, after the faults that bound it."""
        walls: list[list[str]] = [[] for _ in self.faces]
        for name, fault in self.faults.items():
            for share in np.linspace(0.05, 0.95, 10):
                at = fault.interpolate(share, normalized=True).coords[0]
                beside = _beside(fault, share)
                for point, face in zip(beside, self.locate(beside), strict=True):
                    wall = f"{WALLS[hanging_side(fault, at, point)]} of {name}"
                    if face >= 0 and wall not in walls[face]:
                        walls[face].append(wall)
        return [_joined(words) for words in walls]

    def locate(self, points: np.ndarray) -> np.ndarray:
        """Index of the part that holds each point, -1 where there is none; shape (n,)."""
        index = np.full(len(points), -1)
        at, face = shapely.STRtree(self.faces).query(shapely.points(points), predicate="within")
        index[at] = face
        return index


def observe_motion(
    mesh: Mesh, vertices: np.ndarray, faults: Mapping[str, LineString], domain: RestorationDomain
) -> tuple[tuple[MotionReport, ...], list[Finding]]:
    """Rigid motion of each part of the rock, and a finding for each fault whose tip the section folds about.

    Parameters
    ----------
    mesh : Mesh
        Before the step.
    vertices : array, shape (n, 2)
        After it.
    faults : dict of str to LineString
        Those that the mesh is cut along.
    domain : RestorationDomain
    """
    parts = RockParts(domain.outline, faults)
    motions = _motions(parts, mesh, vertices)
    reports = []
    for face, motion in motions.items():
        dx, dz = ((motion.stop - motion.start) / domain.section.metres).tolist()
        turn = float(np.degrees(motion.angle))
        reports.append(MotionReport(parts.names[face], turn, dx, dz, domain.position(motion.start)))
    return tuple(reports), _folds(parts, motions, domain)


def _motions(parts: RockParts, mesh: Mesh, vertices: np.ndarray) -> dict[int, RigidMotion]:
    """Rigid motion of each part, by its index, largest part first."""
    some = slice(None, None, 1 + len(mesh.triangles) // TRIANGLES)
    triangles, areas = mesh.triangles[some], mesh.areas[some]
    before, after = (points[triangles].mean(axis=1) for points in (mesh.vertices, vertices))
    face = parts.locate(before)
    found = [(areas[face == index].sum(), index) for index in np.unique(face[face >= 0]).tolist()]
    members = {index: face == index for _, index in sorted(found, reverse=True)}
    return {index: rigid_motion(before[own], after[own], areas[own]) for index, own in members.items()}


def _folds(parts: RockParts, motions: Mapping[int, RigidMotion], domain: RestorationDomain) -> list[Finding]:
    """A finding for each fault past whose tip the rock, unbroken there, has turned by different angles."""
    findings: dict[str, Finding] = {}
    for (name, which), line in parts.continuations.items():
        one, other = (int(parts.locate(point[None])[0]) for point in _beside(line, 0.5))
        if name in findings or one not in motions or other not in motions:
            continue
        angle = np.degrees(motions[one].angle - motions[other].angle)
        angle = abs((angle + 180) % 360 - 180)
        if angle > FOLDED:
            findings[name] = _fold(name, parts.faults[name], which, angle, domain)
    return list(findings.values())


def _fold(name: str, fault: LineString, which: int, angle: float, domain: RestorationDomain) -> Finding:
    tip, far = np.array(fault.coords[which]), np.array(fault.coords[-1 - which])
    question = (
        f"is the young cover older than the fault, or does {name} reach the border?"
        if tip[1] <= far[1]
        else f"does {name} end there, or go on down to the border or a detachment?"
    )
    text = f"the section folds by {angle:.0f} degrees about the tip of {name}: {question}"
    return Finding("problem" if angle > SEVERELY else "warning", "fold", text, name, domain.position(tip))


def _heading(line: LineString, which: int) -> tuple[np.ndarray, np.ndarray]:
    """An end of a line, and the unit vector in which its last segment leads."""
    points = shapely.get_coordinates(line)
    arm = points[which] - points[1 if which == 0 else -2]
    return points[which], arm / np.hypot(*arm)


def _continued(tip: np.ndarray, direction: np.ndarray, barriers: shapely.Geometry) -> LineString:
    x_min, z_min, x_max, z_max = barriers.bounds
    ray = LineString([tip, tip + 2 * np.hypot(x_max - x_min, z_max - z_min) * direction])
    return LineString([tip, tip + shapely.Point(tip).distance(ray.intersection(barriers)) * direction])


def _overshooting(line: LineString) -> LineString:
    """A line made longer by a millionth at both ends, so that rounding leaves no gap where it ends at another."""
    (first, back), (last, on) = (_heading(line, which) for which in (0, -1))
    reach = 1e-6 * line.length
    return LineString([first + reach * back, *line.coords, last + reach * on])


def _beside(line: LineString, share: float) -> np.ndarray:
    """Two points on either side of a line, at a share of its length; shape (2, 2)."""
    before, at, after = (
        np.array(line.interpolate(share + step, normalized=True).coords[0]) for step in (-BESIDE, 0, BESIDE)
    )
    across = (after - before)[::-1] * [-1, 1] / 2
    return np.stack([at + across, at - across])


def _joined(words: list[str]) -> str:
    if not words:
        return "the whole section"
    more = len(words) - NAMED
    return ", ".join(words[:NAMED]) + (f" and {more} more" if more > 0 else "")
