"""Flags on a section at the positions of findings."""

from collections.abc import Sequence

import numpy as np

from seiswidgets.geology.findings import Finding
from seiswidgets.interaction.overlay import Mark
from seiswidgets.interaction.projection import PaneProjection
from seiswidgets.widgets.severity import LOOKS


def flags(findings: Sequence[Finding], projection: PaneProjection) -> list[tuple[Finding, Mark]]:
    """The findings with a position that a pane shows, each with its flag; notes have none."""
    flagged = [(finding, finding.where) for finding in findings if finding.where and finding.severity != "note"]
    if not flagged:
        return []
    points = projection.to_pane([where for _, where in flagged])
    return [
        (finding, _flag(finding, point))
        for (finding, _), point in zip(flagged, points, strict=True)
        if np.isfinite(point).all()
    ]


def _flag(finding: Finding, point: np.ndarray) -> Mark:
    look = LOOKS[finding.severity]
    x, z = point.tolist()
    return Mark((x, z), "finding", finding.text, look.colours[0], look.path)
