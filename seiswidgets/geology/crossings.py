"""Horizons that cross each other, as beds never do."""

from collections.abc import Iterable
from itertools import combinations

import shapely
from shapely import LineString, MultiLineString

from seiswidgets.geology.findings import Finding
from seiswidgets.geology.picks import Horizon
from seiswidgets.geology.section import Section

OVERSHOOT = 2.0  # traces or samples: a line that ends just beyond another one is truncated there, and does not cross it


def crossing_findings(section: Section, horizons: Iterable[Horizon]) -> list[Finding]:
    """A warning for each pair of horizons that cross, at the first crossing along the first one."""
    lines = [(pick.name, [LineString(section.to_rock(piece)) for piece in pick.pieces]) for pick in horizons]
    slack = OVERSHOOT * max((section.dx, section.dz) * section.metres)
    findings = []
    for (name, pieces), (other, other_pieces) in combinations(lines, 2):
        if not MultiLineString(pieces).intersects(MultiLineString(other_pieces)):
            continue
        points = [point for one in pieces for two in other_pieces for point in _crossings(one, two, slack)]
        if points:
            x, z = section.from_rock(points[0].coords[0]).tolist()
            text = (
                f"horizon {other!r} crosses horizon {name!r} near {section.where((x, z))}, which beds do not; end one "
                "of them there, or let it only be carried"
            )
            findings.append(Finding("warning", "crossing", text, other, (x, z)))
    return findings


def _crossings(one: LineString, other: LineString, slack: float) -> list[shapely.Point]:
    """Points at which two lines cross, and that lie farther from all their ends than the slack."""
    parts = shapely.get_parts(one.intersection(other))
    met = [part.interpolate(0.5, normalized=True) if part.length else part for part in parts]
    return [point for point in met if all(slack < line.project(point) < line.length - slack for line in (one, other))]
