"""Faults that end inside the section: genuine tips, and faults that were not drawn on to what they reach."""

import numpy as np
import shapely
from shapely import LineString, Point

from seiswidgets.geology.domain import RestorationDomain
from seiswidgets.geology.findings import Finding

NEAR = 0.05  # of the section's height
BENDS = "the rock there must bend instead of slip"


def fault_end_findings(faults: dict[str, LineString], slips: dict, domain: RestorationDomain) -> list[Finding]:
    """A finding for each end of a fault that lies inside the section, off all other faults.

    It is a warning if the border, or another fault straight ahead, lies nearer than 5% of the section's height, or
    nearer than the slip at the fault's nearest cut-offs, which would have to die out on so short a way. Elsewhere it is
    a note: faults may die out inside a section.

    Parameters
    ----------
    faults : dict of str to LineString
        In metres of rock.
    slips : dict of str to array, shape (c, 3)
        For each fault the points between its pairs of cut-offs, and the distance of each pair, in metres.
    domain : RestorationDomain
    """
    found = []
    for name, line in faults.items():
        others = {other: drawn for other, drawn in faults.items() if other != name}
        for points in (shapely.get_coordinates(line), shapely.get_coordinates(line)[::-1]):
            if _is_inside(Point(points[0]), domain, others.values(), 1e-6 * line.length):
                found.append(_finding(name, points, others, _nearness(points[0], slips[name], domain), domain))
    return found


def _is_inside(tip, domain, others, touch):
    lines = [domain.outline.boundary, *others]
    return domain.outline.contains(tip) and min(other.distance(tip) for other in lines) > touch


def _nearness(tip, slips, domain):
    """The distance within which an end counts as near, in metres."""
    _, low, _, high = domain.outline.bounds
    nearest = np.argmin(np.hypot(*(slips[:, :2] - tip).T))
    return max(NEAR * (high - low), slips[nearest, 2])


def _finding(name, points, others, near, domain):
    tip, where = Point(points[0]), domain.position(points[0])
    text = _at_other_fault(name, points, others, near, domain)
    if text is None:
        border = domain.outline.boundary.interpolate(domain.outline.boundary.project(tip))
        way = _way_to(np.subtract(border.coords[0], points[0]), domain.section)
        if tip.distance(border) > near:
            return Finding("note", "fault end", f"{name} dies out inside the section, {way}.", name, where)
        text = f"{name} dies out {way} of the section; {BENDS}. Draw it on to the border if it reaches it."
    return Finding("warning", "fault end", text, name, where)


def _way_to(arm, section):
    """How far an end lies from the border, and from which one, in the section's units."""
    x, z = np.abs(section.from_rock(arm))
    if abs(arm[1]) >= abs(arm[0]):
        return f"{z:.3g} {section.z_unit} {'below the top' if arm[1] < 0 else 'above the bottom'}"
    return f"{x:.3g} {section.x_unit} from the {'left' if arm[0] < 0 else 'right'} border"


def _at_other_fault(name, points, others, near, domain):
    """What there is to say of an end that lies a little short of another fault, or a little beyond it."""
    tip, arm = Point(points[0]), points[0] - points[1]
    ahead = LineString([points[0], points[0] + near * arm / np.hypot(*arm)])
    for line, relation, advice in (
        (ahead, "short of", "draw it on to {0} if it reaches it"),
        (LineString(points), "beyond", "end it at {0} if it does not cut it"),
    ):
        met = [(line.intersection(other), fault) for fault, other in others.items() if line.intersects(other)]
        distance, fault = min(((tip.distance(point), fault) for point, fault in met), default=(np.inf, None))
        if distance <= near:
            place = f"near {domain.where(points[0])}"
            return f"{name} ends {domain.length(distance)} {relation} {fault} {place}; {BENDS}: {advice.format(fault)}."
    return None
