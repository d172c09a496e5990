"""Slip profiles on a mesh: the point of the other side that each vertex beside a fault faced before it slipped."""

from dataclasses import dataclass

import numpy as np
import shapely
from shapely import LineString, Point

from seiswidgets.core.contact import bulges_of
from seiswidgets.core.facing import Facing
from seiswidgets.core.mesh import Mesh
from seiswidgets.errors import PickError
from seiswidgets.geology.domain import RestorationDomain
from seiswidgets.geology.findings import Finding
from seiswidgets.geology.report import SlipReport
from seiswidgets.geology.segments import hanging_side
from seiswidgets.geology.slip_profile import SlipProfile

POSITIONS = 2001  # at which a profile is evaluated to be inverted
STEEPEST = 0.5  # metres of slip per metre of fault, towards a tip
FOLDING = 1.9  # the same, anywhere: from 2 on, two points of one side would face the same point
ROWS = 9


@dataclass(frozen=True, eq=False)
class FaultSides:
    """The two sides of a fault in a mesh that is cut along it, and the slip that is prescribed there.

    Attributes
    ----------
    name : str
    profile : SlipProfile
    mesh : Mesh
    line : LineString
        The fault's smooth curve.
    edges : array, shape (2, s, 2)
        Edges of the hanging wall, then of the footwall.
    start : float
        Arc length on the curve of the fault's upper end as it was drawn.
    down : 1 or -1
        1 if arc lengths on the curve grow downwards.
    """

    name: str
    profile: SlipProfile
    mesh: Mesh
    line: LineString
    edges: np.ndarray
    start: float
    down: int

    @classmethod
    def of(
        cls, name: str, profile: SlipProfile, mesh: Mesh, sides: np.ndarray, line: LineString, drawn: np.ndarray
    ) -> "FaultSides":
        """Find the hanging wall among two sides as `Cut.sides` has them; ``drawn`` are the fault's own points."""
        first, last = drawn[[0, -1]]
        down = 1 if (first[1], first[0]) <= (last[1], last[0]) else -1
        position, arm = mesh.vertices[sides[0, 0]].mean(axis=0), np.subtract(*mesh.vertices[sides[0, 0, ::-1]])
        right = position + 1e-3 * arm[::-1] * [-1, 1]
        order = [0, 1] if hanging_side(line, position, right) == 1 else [1, 0]
        start = line.project(Point(first if down == 1 else last))
        return cls(name, profile, mesh, line, sides[order], start, down)

    def arcs(self, vertices: np.ndarray) -> np.ndarray:
        """Arc lengths of vertices from the fault's upper end, in metres."""
        points = shapely.points(self.mesh.vertices[vertices])
        return np.asarray(self.down * (shapely.line_locate_point(self.line, points) - self.start))

    @property
    def _tips(self) -> list[float]:
        """Arc lengths of the ends at which the fault dies out: there both sides have the same vertex."""
        ends = self.edges[:, [0, -1], [0, 1]]
        return self.arcs(ends[0, ends[0] == ends[1]]).tolist()

    @property
    def positions(self) -> tuple[np.ndarray, np.ndarray]:
        """Positions along the fault and the slip there, which falls to 0 towards each tip; arrays of shape (k,)."""
        low, high = np.sort(self.arcs(self.edges[0, [0, -1], [0, 1]]))
        reach = np.abs(self.profile.slip).max()
        low, high = (end if np.isin(end, self._tips) else end + out for end, out in ((low, -reach), (high, reach)))
        s = np.union1d(np.linspace(low, high, POSITIONS), np.clip(self.profile.s, low, high))
        slip = self.profile.at(s)
        for tip in self._tips:
            slip = np.clip(slip, -STEEPEST * np.abs(s - tip), STEEPEST * np.abs(s - tip))
        return s, slip

    def facing(self, weight: float) -> list[Facing]:
        """The terms that bring each vertex of one side to the point of the other side that it faced.

        PickError if the slip changes so fast along the fault that two points of one side would face the same one.
        """
        s, slip = self.positions
        steep = np.abs(np.diff(slip) / np.diff(s))
        if steep.max() > FOLDING:
            raise PickError(
                f"the slip prescribed for fault {self.name!r} changes by {steep.max():.1f} m per metre of fault near "
                f"s={s[np.argmax(steep)]:.0f} m, so that rock would have to turn over; let it change more slowly",
                pick=self.name,
            )
        above, below = s + slip / 2, s - slip / 2
        return [
            self._facing(self.edges, (above, below), weight),
            self._facing(self.edges[::-1], (below, above), weight),
        ]

    def _facing(self, edges: np.ndarray, walls: tuple[np.ndarray, np.ndarray], weight: float) -> Facing:
        own, other = edges
        points = np.setdiff1d(own, other)
        partner = np.interp(self.arcs(points), *walls, left=np.nan, right=np.nan)
        ends = self.arcs(other.ravel()).reshape(-1, 2)
        within = (partner[:, None] >= ends.min(axis=1)) & (partner[:, None] <= ends.max(axis=1))
        met = within.any(axis=1)
        points, partner, segment = points[met], partner[met], within[met].argmax(axis=1)
        share = (partner - ends[segment, 0]) / (ends[segment, 1] - ends[segment, 0])
        rest = self.mesh.vertices[other]
        heights = bulges_of(rest, self.line)[:, 1] / np.hypot(*(rest[:, 1] - rest[:, 0]).T)
        count = len(self.mesh.vertices)
        return Facing(points, other[segment], share, heights[segment] * share * (1 - share), count, weight)

    @property
    def rows(self) -> np.ndarray:
        """Points along the fault and the size of the slip there, as `Blocks.slips` has them; shape (k, 3)."""
        s, slip = self.positions
        inner = np.linspace(0, len(s) - 1, ROWS + 2).astype(int)[1:-1]
        points = shapely.line_interpolate_point(self.line, np.clip(self.start + self.down * s[inner], 0, None))
        return np.column_stack([shapely.get_coordinates(points), np.abs(slip[inner])])

    def findings(self, domain: RestorationDomain) -> list[Finding]:
        """A finding for each tip at which the profile is not 0."""
        found = []
        for tip in self._tips:
            slip = float(self.profile.at(tip))
            if abs(slip) > domain.slack:
                point = self.line.interpolate(self.start + self.down * tip).coords[0]
                text = (
                    f"the slip prescribed for fault {self.name} is {slip:.3g} m at its end near {domain.where(point)}, "
                    "where it dies out: it was reduced to 0 there; prescribe 0, or extend the fault if it goes on"
                )
                found.append(Finding("warning", "slip", text, self.name, domain.position(point)))
        return found

    def report(self, vertices: np.ndarray, domain: RestorationDomain) -> tuple[SlipReport, list[Finding]]:
        """The slip that was prescribed, how far the sides are from it, and a finding if that is more than the slack."""
        terms = self.facing(1.0)
        misfits = np.concatenate([term.distances(vertices) for term in terms])
        points = np.concatenate([term.points for term in terms])
        _, slip = self.positions
        worst = float(np.max(misfits, initial=0))
        report = SlipReport(self.name, float(slip.min()), float(slip.max()), worst)
        if worst <= domain.slack:
            return report, []
        point = self.mesh.vertices[points[np.argmax(misfits)]]
        text = (
            f"the sides of fault {self.name} are still up to {domain.length(worst)} off the slip prescribed for it, "
            f"most of all near {domain.where(point)}; check the profile and the shape of the fault there"
        )
        return report, [Finding("problem", "slip", text, self.name, domain.position(point))]
