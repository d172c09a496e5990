"""The rock that a stage starts from: its outline, the mesh that fills it, and positions in the user's units."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
import shapely
from numpy.typing import ArrayLike
from shapely import LineString, MultiPolygon, Point, Polygon

from seiswidgets.core.linework import follow_border
from seiswidgets.core.mesh import Mesh
from seiswidgets.core.triangulation import DENSITY, CrowdedError, expected_vertices, triangulate, triangulate_to
from seiswidgets.errors import PickError, number_text
from seiswidgets.geology.bodies import Region
from seiswidgets.geology.section import Section

SLACK = 0.1  # of a sample: the largest misfit that counts as met
SHORT = 3.0  # traces and samples: too short a line
ON_BORDER = 0.5  # of a trace and of a sample
SIMPLIFIED = 0.01  # of the mesh spacing, at most
VERTICES = 2500  # of a mesh whose spacing is not given

PickKey = tuple[str, str]  # "fault" or "horizon", and the name


@dataclass(frozen=True, eq=False)
class RestorationDomain:
    """The rock before a stage, in metres.

    Attributes
    ----------
    outline : shapely Polygon or MultiPolygon
    section : Section
        The present-day section, for its units.
    requested_spacing : float or None
        Mesh spacing requested by the user.
    quick : bool
        True if lines may lose details that are small beside the mesh spacing, for a preview.
    bodies : dict of str to shapely Polygon or MultiPolygon
        The bodies by name, which the outline leaves out.
    """

    outline: Polygon | MultiPolygon
    section: Section
    requested_spacing: float | None
    quick: bool = False
    bodies: Mapping[str, Region] = field(default_factory=dict)

    def __post_init__(self) -> None:
        if self.requested_spacing:
            expected_vertices(self.outline, self.requested_spacing)

    @cached_property
    def spacing(self) -> float:
        """Typical length of the mesh's edges, in metres."""
        return self.requested_spacing or float(np.sqrt(self.outline.area * DENSITY / VERTICES))

    @cached_property
    def cell(self) -> np.ndarray:
        """Distance between two traces and between two samples, in metres of rock; shape (2,)."""
        return np.array([self.section.dx, self.section.dz]) * self.section.metres

    @property
    def sample(self) -> float:
        """Height of a sample, in metres."""
        return float(self.section.dz * self.section.metres[1])

    @property
    def slack(self) -> float:
        """Largest misfit that counts as met: a tenth of a sample, in metres."""
        return SLACK * self.sample

    @property
    def tolerance(self) -> float:
        """Largest distance of a simplified line from the original, in metres; in previews it may exceed the slack."""
        return SIMPLIFIED * self.spacing if self.quick else min(self.slack, SIMPLIFIED * self.spacing)

    def is_short(self, points: np.ndarray) -> bool:
        """True for a line that is no longer than three traces and samples; ``points`` has the shape (n, 2)."""
        return bool(np.hypot(*(np.diff(points, axis=0) / self.cell).T).sum() <= SHORT)

    def simplify(self, line: LineString) -> LineString:
        """Remove the points of a line that a mesh does not need; what lies on the border stays there."""
        simple = line.simplify(self.tolerance)
        return self.on_border(simple) if simple.dwithin(self.outline.boundary, self.tolerance) else simple

    def on_border(self, line: LineString) -> LineString:
        """Lay a line onto the border wherever it lies within half a trace and half a sample of it.

        Nobody can pick the difference, and the sliver between would need a mesh of its own.
        """
        for part in shapely.get_parts(self.outline):
            for ring in (part.exterior, *part.interiors):
                line = follow_border(line, LineString(ring), ON_BORDER * self.cell)
        return line

    def mesh(self, lines: Mapping[PickKey, Sequence[LineString]]) -> Mesh:
        """Triangulate the outline with all lines, given by kind and name of their picks, among the edges.

        PickError if two of them lie too close together.
        """
        every = [line for drawn in lines.values() for line in drawn]
        try:
            if self.requested_spacing:
                return triangulate(self.outline, every, self.requested_spacing)
            return triangulate_to(self.outline, every, VERTICES)
        except CrowdedError as error:
            crowded = error.point
        (kind, name), other = self._two_nearest(crowded, lines)
        raise PickError(
            f"{kind} {name!r} and {other} lie so close together near {self.where(crowded)}, or meet at so small an "
            "angle, that the rock between them cannot be meshed; move them apart, or leave one of them out",
            pick=name,
            where=self.position(crowded),
        )

    def _two_nearest(self, point: np.ndarray, lines: Mapping[PickKey, Sequence[LineString]]) -> tuple[PickKey, str]:
        """The pick nearest to a point, and the name of the next one, or of the border."""
        distances = sorted((line.distance(Point(point)), key) for key, drawn in lines.items() for line in drawn)
        border = self.outline.boundary.distance(Point(point))
        if len(distances) < 2 or border < distances[1][0]:
            return distances[0][1], "the border of the section"
        (_, first), (_, second) = distances[:2]
        return first, "another part of it" if first == second else f"{second[0]} {second[1]!r}"

    def fingerprint(self, *drawn: Mapping[str, Sequence[LineString]]) -> tuple:
        """Everything that shapes a stage's mesh: two stages with equal fingerprints have the same mesh.

        Parameters
        ----------
        *drawn : dict of str to list of LineString
            Faults by name, horizons by name; only those that the stage uses.
        """
        lines = tuple(
            tuple((name, *(line.wkb for line in pieces)) for name, pieces in picks.items()) for picks in drawn
        )
        return self.outline.wkb, self.requested_spacing, self.tolerance, lines

    def length(self, metres: float) -> str:
        """Text for a length, in the section's unit of x, also where z is a time."""
        rounded = float(f"{metres / self.section.metres[0]:.2g}")
        return f"{number_text(rounded)} {self.section.x_unit}"

    def area(self, square_metres: float) -> str:
        """Text for an area of rock, in squares of the section's unit of x."""
        rounded = float(f"{square_metres / self.section.metres[0] ** 2:.2g}")
        return f"{number_text(rounded)} {self.section.x_unit}²"

    def position(self, point: ArrayLike) -> tuple[float, float]:
        """A point given in metres of rock, in the section's units."""
        x, z = self.section.from_rock(point)
        return float(x), float(z)

    def where(self, point: ArrayLike) -> str:
        """Text for the position of a point given in metres of rock, with the section's units."""
        return self.section.where(self.position(point))
