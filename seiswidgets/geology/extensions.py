"""Horizons that were not drawn up to the faults that they end at, and how far they had to be extended."""

from collections.abc import Mapping, Sequence

import numpy as np
import shapely

from seiswidgets.geology.domain import RestorationDomain
from seiswidgets.geology.findings import Finding
from seiswidgets.geology.segments import HorizonSegment

FAR = 5.0  # traces: a longer extension is a warning
TURN = np.radians(30)  # a last stretch that differs more from the direction of the extension makes that a warning
NAMED = 4  # extensions of one horizon that are named one by one

Extension = tuple[float, str, np.ndarray, float]  # length, fault, end of the drawn piece, turn from its last stretch


def extension_findings(
    horizons: Mapping[str, Sequence[HorizonSegment]], faults: Sequence[str], domain: RestorationDomain
) -> list[Finding]:
    """A finding for each horizon that was extended to faults, at its longest extension.

    It is a warning if that is longer than five traces, or does not continue the piece's last stretch; else a note.

    Parameters
    ----------
    horizons : dict of str to list of HorizonSegment
    faults : list of str
        Names of the faults, by index; the ends of segments at others are left out.
    domain : RestorationDomain
    """
    findings = []
    for name, segments in horizons.items():
        extensions = sorted(
            (extension for segment in segments for extension in _extensions(segment, faults, domain.slack)),
            key=lambda extension: -extension[0],
        )
        if extensions:
            findings.append(_finding(name, extensions, domain))
    return findings


def _extensions(segment: HorizonSegment, faults: Sequence[str], least: float) -> list[Extension]:
    found = []
    for end, points in zip(segment.ends, (coords := shapely.get_coordinates(segment.line), coords[::-1]), strict=True):
        if end and end.gap > least and end.fault < len(faults):
            ahead, before = points[0] - points[1], points[1] - points[2]
            turn = abs(np.arctan2(before[0] * ahead[1] - before[1] * ahead[0], before @ ahead))
            found.append((end.gap, faults[end.fault], points[1], float(turn)))
    return found


def _finding(name: str, extensions: Sequence[Extension], domain: RestorationDomain) -> Finding:
    gap, _, point, _ = extensions[0]
    parts = [f"by {domain.length(gap)} to {fault} near {domain.where(at)}" for gap, fault, at, _ in extensions[:NAMED]]
    if len(extensions) > NAMED:
        parts.append(f"at {len(extensions) - NAMED} more ends by less")
    text = f"horizon {name} was extended {', '.join(parts)}; check that it runs on so, or draw it up to the fault"
    turned = any(turn > TURN and gap > domain.cell[0] for gap, *_, turn in extensions)
    severity = "warning" if turned or gap > FAR * domain.cell[0] else "note"
    return Finding(severity, "extension", text, name, domain.position(point))
