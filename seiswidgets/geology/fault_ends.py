"""Faults that end inside the section: genuine tips, and faults that were not drawn up to what they reach."""

from collections.abc import Iterable, Mapping

import numpy as np
import shapely
from shapely import LineString, Point

from seiswidgets.geology.domain import RestorationDomain
from seiswidgets.geology.fault_lines import NO_ENDS
from seiswidgets.geology.findings import Finding
from seiswidgets.geology.picks import AUTO, TIP, Ends
from seiswidgets.geology.section import Section

NEAR = 0.05  # of the section's height
BENDS = "the rock there must bend instead of slip"


def fault_end_findings(
    faults: Mapping[str, LineString],
    slips: Mapping[str, np.ndarray],
    domain: RestorationDomain,
    ends: Mapping[str, Ends] = NO_ENDS,
) -> list[Finding]:
    """A finding for each end of a fault that lies inside the section, off all other faults, and is not a chosen tip.

    It is a warning if the border, or another fault straight ahead, lies nearer than 5% of the section's height, or
    nearer than the slip at the fault's nearest cut-offs, which would have to die out over so short a distance.
    Elsewhere it is a note: faults may die out inside a section.

    Parameters
    ----------
    faults : dict of str to LineString
        In metres of rock.
    slips : dict of str to array, shape (c, 3)
        For each fault the points between its pairs of cut-offs, and the distance of each pair, in metres.
    domain : RestorationDomain
    ends : dict of str to pair of str
        See `Fault.ends`.
    """
    findings = []
    for name, line in faults.items():
        others = {other: drawn for other, drawn in faults.items() if other != name}
        from_ends = (shapely.get_coordinates(line), shapely.get_coordinates(line)[::-1])
        for points, choice in zip(from_ends, ends.get(name, (AUTO, AUTO)), strict=True):
            if choice != TIP and _is_inside(Point(points[0]), domain, others.values(), 1e-6 * line.length):
                near = _near_distance(points[0], slips[name], domain)
                findings.append(_finding(name, points, others, near, domain))
    return findings


def _is_inside(tip: Point, domain: RestorationDomain, others: Iterable[LineString], touch: float) -> bool:
    lines = [domain.outline.boundary, *others]
    return domain.outline.contains(tip) and min(other.distance(tip) for other in lines) > touch


def _near_distance(tip: np.ndarray, slips: np.ndarray, domain: RestorationDomain) -> float:
    """The distance within which an end counts as near, in metres."""
    _, low, _, high = domain.outline.bounds
    nearest = np.argmin(np.hypot(*(slips[:, :2] - tip).T))
    return float(max(NEAR * (high - low), slips[nearest, 2]))


def _finding(
    name: str, points: np.ndarray, others: Mapping[str, LineString], near: float, domain: RestorationDomain
) -> Finding:
    tip, where = Point(points[0]), domain.position(points[0])
    text = _text_at_other_fault(name, points, others, near, domain)
    if text is None:
        border = domain.outline.boundary.interpolate(domain.outline.boundary.project(tip))
        distance = _distance_to_border(np.subtract(border.coords[0], points[0]), domain.section)
        if tip.distance(border) > near:
            return Finding("note", "fault end", f"{name} dies out inside the section, {distance}.", name, where)
        text = f"{name} dies out {distance} of the section; {BENDS}. Extend it to the border if it reaches it."
    return Finding("warning", "fault end", text, name, where)


def _distance_to_border(arm: np.ndarray, section: Section) -> str:
    """Text for the distance of an end from the nearest border, in the section's units."""
    x, z = np.abs(section.from_rock(arm))
    if abs(arm[1]) >= abs(arm[0]):
        return f"{z:.3g} {section.z_unit} {'below the top' if arm[1] < 0 else 'above the bottom'}"
    return f"{x:.3g} {section.x_unit} from the {'left' if arm[0] < 0 else 'right'} border"


def _text_at_other_fault(
    name: str, points: np.ndarray, others: Mapping[str, LineString], near: float, domain: RestorationDomain
) -> str | None:
    """Text about an end that lies a little short of another fault, or a little beyond it; None if it does not."""
    tip, arm = Point(points[0]), points[0] - points[1]
    ahead = LineString([points[0], points[0] + near * arm / np.hypot(*arm)])
    for line, relation, advice in (
        (ahead, "short of", "extend it to {0} if it reaches it"),
        (LineString(points), "beyond", "end it at {0} if it does not cut it"),
    ):
        hits = [(line.intersection(other), fault) for fault, other in others.items() if line.intersects(other)]
        distance, fault = min(((tip.distance(point), fault) for point, fault in hits), default=(np.inf, ""))
        if distance <= near:
            where = f"near {domain.where(points[0])}"
            return f"{name} ends {domain.length(distance)} {relation} {fault} {where}; {BENDS}: {advice.format(fault)}."
    return None
