"""Length and width of a bed before and after restoring: a horizon block by block, drawn on to the faults around it."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
import shapely
from shapely import LineString
from shapely.ops import substring

from seiswidgets.errors import PickError
from seiswidgets.geology.picks import Fault, Horizon
from seiswidgets.geology.restoration import Restoration
from seiswidgets.geology.segments import HorizonSegment, horizon_segments
from seiswidgets.geology.transfer import carried_boundaries

INSET = 1 / 20  # of the mesh spacing: what is left out beside a fault, whose edges in the mesh are chords of its curve
BELOW = 0.2, 1.0  # samples below a line that rock was stripped down to, which is simplified
FINE = 1 / 8  # of the mesh spacing: distance of the points that are carried


@dataclass(frozen=True)
class BedExtent:
    """Length and width of a horizon in metres of rock, present-day and restored."""

    length: float
    restored_length: float
    width: float
    restored_width: float

    @property
    def change(self) -> float:
        """Relative change of the length by restoring."""
        return self.restored_length / self.length - 1

    @property
    def beta(self) -> float:
        """Present-day over restored width."""
        return self.width / max(self.restored_width, np.finfo(float).tiny)

    @property
    def extension(self) -> float:
        """Present-day over restored width, less 1."""
        return self.beta - 1


def bed_extent(restored: Restoration, faults: Sequence[Fault], horizon: Horizon) -> BedExtent | None:
    """Measure a horizon; None if it crosses itself or lies outside the section, or a part of it was removed.

    Its pieces are drawn on to the faults as for unfaulting, so that gaps of the picks beside a fault count as bed.
    """
    segments = list(_segments(restored, faults, horizon))
    spacing = restored.stages[0].spacing if restored.stages else restored.domain.spacing
    before = [_points(segment, spacing) for segment in segments]
    after = [_carried(points, restored) for points in before]
    if not after or not all(np.isfinite(points).all() for points in after):
        return None
    whole = [segment.line.length for segment in segments]
    stretch = [_length(new) / _length(old) for old, new in zip(before, after, strict=True)]
    return BedExtent(
        sum(whole),
        float(np.dot(whole, stretch)),
        *(float(np.ptp(np.concatenate(lines)[:, 0])) for lines in (before, after)),
    )


def _segments(restored: Restoration, faults: Sequence[Fault], horizon: Horizon) -> Iterator[HorizonSegment]:
    picks = Restoration(restored.original, bodies=restored.bodies).usable_picks
    try:
        pieces = picks.bed_lines(horizon)
    except PickError:
        return
    used = {fault.name: fault for fault in faults if fault.constrains}
    curves = carried_boundaries(restored.original, (), used, picks.domain)
    yield from horizon_segments(pieces, [LineString(points) for points in curves.values()], picks.domain.cell)


def _points(segment: HorizonSegment, spacing: float) -> np.ndarray:
    """Close points along a segment, without its ends at faults."""
    inset = min(INSET * spacing, 0.1 * segment.line.length)
    first, last = (inset if end else 0.0 for end in segment.ends)
    line = substring(segment.line, first, segment.line.length - last)
    return np.asarray(shapely.get_coordinates(shapely.segmentize(line, FINE * spacing)))


def _carried(points: np.ndarray, restored: Restoration) -> np.ndarray:
    """The points after all stages; those of a bed that rock was stripped down to are taken from just below it."""
    for stage in restored.stages:
        moved = stage.map.forward(points)
        for share in BELOW:
            lost = ~np.isfinite(moved).all(axis=1)
            moved[lost] = stage.map.forward(points[lost] + (0, share * stage.domain.sample))
        points = moved
    return points


def _length(line: np.ndarray) -> float:
    return float(np.hypot(*np.diff(line, axis=0).T).sum())
