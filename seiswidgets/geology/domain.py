"""What a stage starts from: the outline of the rock, the mesh that will fill it, and the words for a place in it."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from shapely import LineString

from seiswidgets.core.mesh import Mesh
from seiswidgets.core.triangulation import DENSITY, expected_vertices, triangulate, triangulate_to
from seiswidgets.geology.section import Section

SIMPLIFIED = 0.01  # of the mesh spacing, at most
VERTICES = 2500  # of a mesh whose spacing is not given


@dataclass(frozen=True, eq=False)
class RestorationDomain:
    """The rock before a stage, in metres.

    Attributes
    ----------
    outline : shapely Polygon or MultiPolygon
    section : Section
        As it is today, for its units.
    asked : float or None
        The mesh spacing that the user asked for.
    quick : bool
        Whether lines may lose what is small beside the mesh spacing, for a quick look.
    """

    outline: object
    section: Section
    asked: float | None
    quick: bool = False

    def __post_init__(self):
        if self.asked:
            expected_vertices(self.outline, self.asked)

    @cached_property
    def spacing(self) -> float:
        """Typical length of the mesh's edges, in metres."""
        return self.asked or float(np.sqrt(self.outline.area * DENSITY / VERTICES))

    @property
    def slack(self) -> float:
        """What counts as met: a tenth of a sample, in metres."""
        return 0.1 * self.section.dz * self.section.metres[1]

    @property
    def tolerance(self) -> float:
        """How far a simplified line may lie from itself: a tenth of a sample at most, but for a quick look; metres."""
        return SIMPLIFIED * self.spacing if self.quick else min(self.slack, SIMPLIFIED * self.spacing)

    def simplified(self, line: LineString) -> LineString:
        """A line without the points that a mesh has no need of."""
        return line.simplify(self.tolerance)

    def mesh(self, lines) -> Mesh:
        """A mesh of the outline that has all lines among its edges."""
        if self.asked:
            return triangulate(self.outline, lines, self.asked)
        return triangulate_to(self.outline, lines, VERTICES)

    def fingerprint(self, *drawn: dict) -> tuple:
        """What shapes a stage's mesh, for comparison: two stages with equal tasks have the same mesh.

        Parameters
        ----------
        *drawn : dict of str to list of LineString
            Faults by name, horizons by name: as many of these as the stage has use for.
        """
        lines = tuple(tuple((name, *(line.wkb for line in pieces)) for name, pieces in kind.items()) for kind in drawn)
        return self.outline.wkb, self.asked, self.tolerance, lines

    def length(self, metres: float) -> str:
        """A length in the words of the section: in its unit of x, also where z is a time."""
        shown = float(f"{metres / self.section.metres[0]:.2g}")
        return f"{shown:.6g} {self.section.x_unit}{' of rock' if self.section.is_time else ''}"

    def position(self, point) -> tuple[float, float]:
        """A point in metres of rock, in the section's units."""
        x, z = self.section.from_rock(point)
        return float(x), float(z)

    def where(self, point) -> str:
        """A place in the words of the section: with its units."""
        x, z = self.position(point)
        return f"x={x:.6g} {self.section.x_unit}, z={z:.6g} {self.section.z_unit}"
