"""Segments of horizons, each brought to the faults that it ends at.

Pieces are seldom drawn exactly to a fault: one that ends short is extended, one that overshoots is trimmed. An
extension takes the median direction of the last ten traces, so that a steep last segment does not decide where it goes.
It is 20 traces long at most, less where it is steep, and no longer than the piece itself, except over three traces and
samples; and it is made only where another piece reaches the fault from its other side.
"""

from collections.abc import Callable, Container, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np
import shapely
from numpy.typing import ArrayLike
from shapely import LineString, Point
from shapely.geometry.base import BaseGeometry
from shapely.ops import substring

MOST, LEAST = 20.0, 3.0  # traces by which a piece is extended; traces and samples by which even a short one is
STEEP = 2.0  # times as much counts what an extension falls or rises
BASELINE = 10.0  # traces at the end of a piece, whose median direction an extension takes
EXTENSION = 0.2  # of a piece's length, where the size of traces is not known
SPECK = 1e-3  # of a trace or a sample: shorter parts between two crossings are rounding
TOUCHING = 0.1  # of a trace or a sample: a horizon that ends so close to the end of a fault meets it there
JOINED = 3.0  # traces and samples: ends of two pieces that lie closer become one point


@dataclass(frozen=True)
class End:
    """An end of a segment at a fault.

    Attributes
    ----------
    fault : int
        Index of the fault.
    point : tuple (x, z)
    side : int
        1 where the segment lies in the hanging wall, -1 in the footwall.
    gap : float
        Length by which the segment had to be extended.
    """

    fault: int
    point: tuple[float, float]
    side: int
    gap: float


@dataclass(frozen=True, eq=False)
class HorizonSegment:
    """A piece of a horizon, or the part of it between two faults, extended to the faults at its ends.

    Attributes
    ----------
    line : shapely LineString
    ends : pair of End or None
        At the first and the last point; None for a free end.
    piece : int
        Number of the drawn piece, from 1.
    short : bool
        True for a short end beyond a fault, which counts only if no other piece lies there.
    """

    line: LineString
    ends: tuple[End | None, End | None]
    piece: int
    short: bool = False

    def end_point(self, which: int) -> tuple[float, float]:
        """The first (0) or last (-1) point."""
        end = self.ends[which]
        return end.point if end else self.line.coords[which]


def horizon_segments(
    pieces: Sequence[LineString], faults: Sequence[LineString], cell: np.ndarray | None = None
) -> list[HorizonSegment]:
    """The pieces of a horizon, split where they cross faults and extended to the faults they end short of.

    A short end beyond a fault is left out if another piece lies there: then it is an overshoot.

    Parameters
    ----------
    pieces, faults : list of LineString
    cell : array, shape (2,), optional
        Distance between two traces and between two samples, in the unit of the lines. Without it, a piece is extended
        by at most a fifth of its length.
    """
    split = [
        segment for index, piece in enumerate(pieces, 1) for segment in split_at_faults(piece, faults, index, cell)
    ]
    extended = [_extend(segment, faults, cell) for segment in split]
    claimed = {(end.fault, end.side) for segment in extended if not segment.short for end in segment.ends if end}

    def is_overshoot(segment: HorizonSegment) -> bool:
        return segment.short and any((end.fault, end.side) in claimed for end in segment.ends if end)

    kept = [segment for segment in extended if not is_overshoot(segment)]
    reached = {(end.fault, end.side) for segment in kept for end in segment.ends if end}
    return kept if cell is None else [_without_one_sided(segment, reached, cell) for segment in kept]


def split_at_faults(
    line: LineString, faults: Sequence[LineString], piece: int = 1, cell: np.ndarray | None = None
) -> list[HorizonSegment]:
    """Cut a line where it crosses faults."""
    crossings = sorted(
        (line.project(point), fault)
        for fault in _within_reach(faults, line, 1e-9 * line.length)  # rounding can part a line from its own crossing
        for point in _common_points(line.intersection(faults[fault]))
    )
    length = line.length
    if not crossings and length > 0:
        return [HorizonSegment(line, (None, None), piece)]
    least = max(1e-9 * length, 0.0 if cell is None else SPECK * float(np.min(cell)))
    inner: list[tuple[float, int]] = []
    for at, fault in crossings:
        if inner and at - inner[-1][0] <= least:  # on a stretch that faults share: one counts
            inner[-1] = at, min(fault, inner[-1][1], key=_through_first(faults, line.interpolate(at)))
        elif least < at < length - least:
            inner.append((at, fault))
    stops: list[tuple[float, int | None]] = [(0.0, None), *inner, (length, None)]
    segments = []
    for (start, first), (stop, last) in pairwise(stops):
        if stop - start <= least:
            continue
        part = substring(line, start, stop)
        ends = _end_at(part, 0, first, faults), _end_at(part, -1, last, faults)
        outer = (first is None) != (last is None)
        most = EXTENSION * length if cell is None else min(_most(np.ptp(part.coords, axis=0), cell), length / 2)
        segments.append(HorizonSegment(part, ends, piece, outer and stop - start < most))
    return segments


def _most(arm: np.ndarray, cell: np.ndarray) -> float:
    """Length of an extension in the direction of an arm, or of an overshoot, at most."""
    across, along = np.abs(arm) / np.hypot(*arm)
    return float(MOST * cell[0] / max(across, STEEP * along))


def _end_at(line: LineString, which: int, fault: int | None, faults: Sequence[LineString]) -> End | None:
    """The End of a line that was cut at a fault, None if no fault cut it there."""
    if fault is None:
        return None
    return _end(line, which, fault, faults[fault], shapely.get_coordinates(line)[which])


def _extend(segment: HorizonSegment, faults: Sequence[LineString], cell: np.ndarray | None) -> HorizonSegment:
    """Extend the free ends of a segment to the first fault in reach."""
    if not faults:
        return segment
    points = shapely.get_coordinates(segment.line)
    ends: list[End | None] = []
    for which in (0, -1):
        end = segment.ends[which] or nearest_fault_ahead(segment.line, which, faults, cell)
        if end and end.gap > 0:
            points = np.insert(points, 0 if which == 0 else len(points), end.point, axis=0)
        elif end:
            points[which] = end.point
        ends.append(end)
    bridges = None not in ends and cell is not None and segment.line.length > LEAST * float(np.max(cell))
    return replace(segment, line=LineString(points), ends=(ends[0], ends[1]), short=segment.short and not bridges)


def _without_one_sided(
    segment: HorizonSegment, reached: Container[tuple[int, int]], cell: np.ndarray
) -> HorizonSegment:
    """Undo extensions, except short ones, to faults that the horizon does not reach from the other side."""
    points, ends = shapely.get_coordinates(segment.line), list(segment.ends)
    for which, end in zip((0, -1), segment.ends, strict=True):
        if end and (end.fault, -end.side) not in reached:
            inner = points[1 if which == 0 else -2]
            if end.gap > 0 and np.hypot(*((points[which] - inner) / cell)) > LEAST:
                points, ends[which] = np.delete(points, which, axis=0), None
    return replace(segment, line=LineString(points), ends=(ends[0], ends[1]))


def _reach(line: LineString, direction: np.ndarray, cell: np.ndarray | None) -> float:
    """Length by which a line may be extended in a direction."""
    if cell is None:
        return EXTENSION * line.length
    least = LEAST / float(np.hypot(*(direction / cell)))
    return max(least, min(_most(direction, cell), line.length))


def segments_beside(segments: Sequence[HorizonSegment], region: BaseGeometry) -> list[HorizonSegment]:
    """The parts of segments outside a region, such as salt; an end inside it is no end at a fault any more."""
    beside: list[HorizonSegment] = []
    for segment in segments:
        parts = [part for part in shapely.get_parts(segment.line.difference(region)) if part.length > 0]
        for part in parts:
            first, last = (
                end if shapely.dwithin(Point(segment.line.coords[which]), Point(part.coords[which]), 1e-6) else None
                for which, end in zip((0, -1), segment.ends, strict=True)
            )
            beside.append(replace(segment, line=part, ends=(first, last)))
    return beside


def nearest_fault_ahead(
    line: LineString, which: int, faults: Sequence[LineString], cell: np.ndarray | None, reach: float | None = None
) -> End | None:
    """The End at the first fault that a line meets when this end of it is extended, or None.

    The extension has the length ``reach``, or the greatest one allowed.
    """
    tip, direction = _heading(line, which, cell)
    reach = _reach(line, direction, cell) if reach is None else reach
    touch = 1e-6 * line.length
    ray = LineString([tip, tip + (reach + touch) * direction])
    hits = [
        (max(0.0, Point(tip).distance(point)), fault, point.coords[0])
        for fault in _within_reach(faults, Point(tip), 2 * (reach + touch))
        for point in [*_common_points(ray.intersection(faults[fault])), *_touching_point(faults[fault], tip, touch)]
    ]
    if not hits and cell is not None:  # a fault that ends beside the tip, as along the border that a step left
        touch = TOUCHING * float(np.min(cell))
        near = [
            (fault, point)
            for fault in _within_reach(faults, Point(tip), touch)
            for point in _touching_point(faults[fault], tip, touch)
        ]
        hits = [(0.0, fault, point.coords[0]) for fault, point in near]
    if not hits:
        return None
    first, *_ = min(hits)
    tied = [hit for hit in hits if hit[0] <= first + touch]
    gap, fault, point = min(tied, key=lambda hit: _through_first(faults, Point(hit[2]))(hit[1]))
    return _end(line, which, fault, faults[fault], point, gap if gap > touch else 0.0)


def _through_first(faults: Sequence[LineString], point: Point) -> Callable[[int], tuple[bool, int]]:
    """Key that sorts the faults at a point: those that run through it before those that end at it."""
    return lambda fault: (faults[fault].boundary.dwithin(point, 1e-6 * faults[fault].length), fault)


def _within_reach(faults: Sequence[LineString], geometry: BaseGeometry, reach: float) -> list[int]:
    """Indices of the faults within a distance of a geometry."""
    indices: list[int] = np.flatnonzero(shapely.dwithin(np.array(faults, object), geometry, reach)).tolist()
    return indices


def _touching_point(fault: LineString, tip: np.ndarray, touch: float) -> list[Point]:
    nearest = fault.interpolate(fault.project(Point(tip)))
    return [nearest] if nearest.distance(Point(tip)) <= touch else []


def _heading(line: LineString, which: int, cell: np.ndarray | None) -> tuple[np.ndarray, np.ndarray]:
    """An end of a line and the unit vector in which it continues there: the median of its last stretch."""
    baseline = 0.1 * line.length if cell is None else min(BASELINE * float(cell[0]), line.length)
    stretch = substring(line, *((baseline, 0.0) if which == 0 else (line.length - baseline, line.length)))
    points = shapely.get_coordinates(stretch)
    arms, whole = np.diff(points, axis=0), points[-1] - points[0]
    order = np.argsort(np.arctan2(whole[0] * arms[:, 1] - whole[1] * arms[:, 0], arms @ whole))
    shares = np.cumsum(np.hypot(*arms[order].T)) / stretch.length
    median = arms[order[np.searchsorted(shares, 0.5)]]
    return shapely.get_coordinates(line)[which], median / np.hypot(*median)


def _end(line: LineString, which: int, index: int, fault: LineString, point: ArrayLike, gap: float = 0.0) -> End:
    inside = line.interpolate(0.05 if which == 0 else 0.95, normalized=True)
    x, z = np.asarray(point)
    return End(index, (x, z), hanging_side(fault, (x, z), inside.coords[0]), gap)


def hanging_side(fault: LineString, position: ArrayLike, point: ArrayLike) -> int:
    """Side of a fault on which a point lies, seen from a position on it: 1 hanging wall, -1 footwall.

    The hanging wall is the side that lies above the fault as a whole: along a fault that is overturned in part it
    stays the same side. Where the fault is upright, that is its right side.
    """
    position, point = np.asarray(position, float), np.asarray(point, float)
    arc_length, reach = fault.project(Point(position)), 1e-3 * fault.length
    before, after = (np.array(fault.interpolate(max(0.0, arc_length + step)).coords[0]) for step in (-reach, reach))
    along, whole = after - before, np.subtract(*shapely.get_coordinates(fault)[[-1, 0]])
    across = along[0] * (point[1] - position[1]) - along[1] * (point[0] - position[0])
    drawn_down = whole[1] > 0 or (whole[1] == 0 and whole[0] > 0)
    dips_right = whole[0] * (1 if drawn_down else -1) >= 0
    return 1 if (across < 0) == (drawn_down == dips_right) else -1


def _common_points(geometry: BaseGeometry) -> list[Point]:
    """The points that lines have in common; a stretch they share splits neither."""
    return [part for part in shapely.get_parts(geometry) if part.geom_type == "Point" and not part.is_empty]


def join_pieces(
    pieces: Sequence[LineString],
    cell: np.ndarray,
    apart: Container[tuple[int, int]] = (),
    reach: float = JOINED,
) -> list[LineString]:
    """Join pieces of a horizon whose ends nearly meet, as across a restored fault.

    Parameters
    ----------
    pieces : list of LineString
    cell : array, shape (2,)
        Distance between two traces and between two samples.
    apart : set of (index, end)
        Ends (0 or -1) of pieces that stay as they are.
    reach : float
        Distance of ends that are joined, in traces and samples.
    """
    if not pieces:
        return []
    points = [shapely.get_coordinates(piece).copy() for piece in pieces]
    ends = [(piece, end) for piece in range(len(points)) for end in (0, -1) if (piece, end) not in apart]
    pairs = sorted(
        (float(np.hypot(*((points[one][a] - points[other][b]) / cell))), (one, a), (other, b))
        for index, (one, a) in enumerate(ends)
        for other, b in ends[:index]
        if one != other
    )
    joined: set[tuple[int, int]] = set()
    for distance, first, second in pairs:
        if distance < reach and not {first, second} & joined:
            middle = (points[first[0]][first[1]] + points[second[0]][second[1]]) / 2
            points[first[0]][first[1]] = points[second[0]][second[1]] = middle
            joined |= {first, second}
    lines = shapely.multilinestrings([LineString(piece) for piece in points])
    return list(shapely.get_parts(shapely.line_merge(lines)))
