"""The rock that a stage starts from: its outline, the mesh that fills it, and positions in the user's units."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike
from shapely import LineString, MultiPolygon, Polygon

from seiswidgets.core.mesh import Mesh
from seiswidgets.core.triangulation import DENSITY, expected_vertices, triangulate, triangulate_to
from seiswidgets.geology.section import Section

SLACK = 0.1  # of a sample: the largest misfit that counts as met
SIMPLIFIED = 0.01  # of the mesh spacing, at most
VERTICES = 2500  # of a mesh whose spacing is not given


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
    """

    outline: Polygon | MultiPolygon
    section: Section
    requested_spacing: float | None
    quick: bool = False

    def __post_init__(self) -> None:
        if self.requested_spacing:
            expected_vertices(self.outline, self.requested_spacing)

    @cached_property
    def spacing(self) -> float:
        """Typical length of the mesh's edges, in metres."""
        return self.requested_spacing or float(np.sqrt(self.outline.area * DENSITY / VERTICES))

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

    def simplify(self, line: LineString) -> LineString:
        """Remove the points of a line that a mesh does not need."""
        return line.simplify(self.tolerance)

    def mesh(self, lines: Sequence[LineString]) -> Mesh:
        """Triangulate the outline with all lines among the edges."""
        if self.requested_spacing:
            return triangulate(self.outline, lines, self.requested_spacing)
        return triangulate_to(self.outline, lines, VERTICES)

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
        return f"{rounded:.6g} {self.section.x_unit}{' of rock' if self.section.is_time else ''}"

    def position(self, point: ArrayLike) -> tuple[float, float]:
        """A point given in metres of rock, in the section's units."""
        x, z = self.section.from_rock(point)
        return float(x), float(z)

    def where(self, point: ArrayLike) -> str:
        """Text for the position of a point given in metres of rock, with the section's units."""
        x, z = self.position(point)
        return f"x={x:.6g} {self.section.x_unit}, z={z:.6g} {self.section.z_unit}"
