"""Offsets that grow down along a fault, as where it moved while the beds were deposited."""

from collections.abc import Mapping

import numpy as np
from shapely import LineString, Point

from seiswidgets.geology.domain import RestorationDomain
from seiswidgets.geology.findings import Finding

GROWN = 1.5  # largest ratio of the lowest offset to the highest one that counts as constant
LEAST = 3.0  # samples by which the offset grows, at least


def growth_findings(
    faults: Mapping[str, LineString], slips: Mapping[str, np.ndarray], domain: RestorationDomain
) -> list[Finding]:
    """A finding for each fault whose offset grows from each bed to the next one below.

    It is a note where the fault dies out upwards, because slip falls to 0 towards a tip anyway.

    Parameters
    ----------
    faults : dict of str to LineString
        In metres of rock.
    slips : dict of str to array, shape (c, 3)
        For each fault the points between its pairs of cut-offs, and the distance of each pair, in metres.
    domain : RestorationDomain
    """
    findings = []
    for name, fault in faults.items():
        rows = slips[name][np.argsort(slips[name][:, 1])]
        offsets = rows[:, 2]
        if len(rows) < 2 or (np.diff(offsets) <= 0).any():
            continue
        if offsets[-1] > GROWN * offsets[0] and offsets[-1] - offsets[0] > LEAST * domain.sample:
            findings.append(_growth(name, fault, rows, domain))
    return findings


def _growth(name: str, fault: LineString, rows: np.ndarray, domain: RestorationDomain) -> Finding:
    top = min((fault.coords[0], fault.coords[-1]), key=lambda end: end[1])
    blind = domain.outline.contains(Point(top)) and domain.outline.boundary.distance(Point(top)) > domain.slack
    (_, _, least), (*point, most) = rows[0], rows[-1]
    text = (
        f"the offset along {name} grows downwards from {domain.length(least)} to {domain.length(most)}, as along a "
        "fault that moved while the beds were deposited; if it did, restore one bed at a time, the youngest first"
    )
    return Finding("note" if blind else "warning", "growth", text, name, domain.position(point))
