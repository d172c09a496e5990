"""Segments of horizons, each brought to the faults that it ends at.

Pieces are seldom drawn exactly to a fault: one that ends short is extended along its last stretch, by at most a fifth
of its length; one that overshoots is trimmed.
"""

from collections.abc import Container, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np
import shapely
from numpy.typing import ArrayLike
from shapely import LineString, Point
from shapely.geometry.base import BaseGeometry
from shapely.ops import substring

EXTENSION = 0.2  # of a piece's length: how far it is extended to a fault, and how short an overshoot is
JOINED = 0.5  # of the mesh spacing: ends of two pieces that lie closer become one point


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


def horizon_segments(pieces: Sequence[LineString], faults: Sequence[LineString]) -> list[HorizonSegment]:
    """The pieces of a horizon, split where they cross faults and extended to the faults they end short of.

    A short end beyond a fault is left out if another piece lies there: then it is an overshoot.
    """
    split = [segment for index, piece in enumerate(pieces, 1) for segment in split_at_faults(piece, faults, index)]
    extended = [_extend(segment, faults) for segment in split]
    claimed = {(end.fault, end.side) for segment in extended if not segment.short for end in segment.ends if end}

    def is_overshoot(segment: HorizonSegment) -> bool:
        return segment.short and any((end.fault, end.side) in claimed for end in segment.ends if end)

    return [segment for segment in extended if not is_overshoot(segment)]


def split_at_faults(line: LineString, faults: Sequence[LineString], piece: int = 1) -> list[HorizonSegment]:
    """Cut a line where it crosses faults."""
    crossings = sorted(
        (line.project(point), fault)
        for fault in _within_reach(faults, line, 1e-9 * line.length)  # rounding can part a line from its own crossing
        for point in _common_points(line.intersection(faults[fault]))
    )
    length = line.length
    if not crossings and length > 0:
        return [HorizonSegment(line, (None, None), piece)]
    inner: list[tuple[float, int]] = []
    for at, fault in crossings:
        if inner and at - inner[-1][0] <= 1e-9 * length:  # on a stretch that faults share: the first one counts
            inner[-1] = at, min(fault, inner[-1][1])
        elif 1e-9 * length < at < (1 - 1e-9) * length:
            inner.append((at, fault))
    stops: list[tuple[float, int | None]] = [(0.0, None), *inner, (length, None)]
    segments = []
    for (start, first), (stop, last) in pairwise(stops):
        if stop - start <= 1e-9 * length:
            continue
        part = substring(line, start, stop)
        ends = _end_at(part, 0, first, faults), _end_at(part, -1, last, faults)
        outer = (first is None) != (last is None)
        segments.append(HorizonSegment(part, ends, piece, outer and stop - start < EXTENSION * length))
    return segments


def _end_at(line: LineString, which: int, fault: int | None, faults: Sequence[LineString]) -> End | None:
    """The End of a line that was cut at a fault, None if no fault cut it there."""
    if fault is None:
        return None
    return _end(line, which, fault, faults[fault], shapely.get_coordinates(line)[which])


def _extend(segment: HorizonSegment, faults: Sequence[LineString]) -> HorizonSegment:
    """Extend the free ends of a segment to the first fault in reach."""
    if not faults:
        return segment
    points = shapely.get_coordinates(segment.line)
    ends: list[End | None] = []
    for which in (0, -1):
        end = segment.ends[which] or nearest_fault_ahead(segment.line, which, faults, EXTENSION * segment.line.length)
        if end and end.gap > 0:
            points = np.insert(points, 0 if which == 0 else len(points), end.point, axis=0)
        elif end:
            points[which] = end.point
        ends.append(end)
    return replace(segment, line=LineString(points), ends=(ends[0], ends[1]))


def nearest_fault_ahead(line: LineString, which: int, faults: Sequence[LineString], reach: float) -> End | None:
    """The End at the first fault that a line meets when this end of it is extended by ``reach``, or None."""
    tip, direction = _heading(line, which)
    touch = 1e-6 * line.length
    ray = LineString([tip, tip + (reach + touch) * direction])
    hits = [
        (max(0.0, Point(tip).distance(point)), fault, point.coords[0])
        for fault in _within_reach(faults, Point(tip), 2 * (reach + touch))
        for point in [*_common_points(ray.intersection(faults[fault])), *_touching_point(faults[fault], tip, touch)]
    ]
    if not hits:
        return None
    first, *_ = min(hits)
    fault, gap, point = min((fault, gap, point) for gap, fault, point in hits if gap <= first + touch)
    return _end(line, which, fault, faults[fault], point, gap if gap > touch else 0.0)


def _within_reach(faults: Sequence[LineString], geometry: BaseGeometry, reach: float) -> list[int]:
    """Indices of the faults within a distance of a geometry."""
    indices: list[int] = np.flatnonzero(shapely.dwithin(np.array(faults, object), geometry, reach)).tolist()
    return indices


def _touching_point(fault: LineString, tip: np.ndarray, touch: float) -> list[Point]:
    nearest = fault.interpolate(fault.project(Point(tip)))
    return [nearest] if nearest.distance(Point(tip)) <= touch else []


def _heading(line: LineString, which: int) -> tuple[np.ndarray, np.ndarray]:
    """An end of a line and the unit vector in which it continues there, from the last tenth of its length."""
    back = line.interpolate(0.1 if which == 0 else 0.9, normalized=True).coords[0]
    tip = shapely.get_coordinates(line)[which]
    arm = tip - back
    return tip, arm / np.hypot(*arm)


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
    pieces: Sequence[LineString], spacing: float, apart: Container[tuple[int, int]] = ()
) -> list[LineString]:
    """Join pieces of a horizon whose ends nearly meet, as across a restored fault.

    Parameters
    ----------
    pieces : list of LineString
    spacing : float
        Mesh spacing.
    apart : set of (index, end)
        Ends (0 or -1) of pieces that stay as they are.
    """
    points = [shapely.get_coordinates(piece).copy() for piece in pieces]
    ends = [(piece, end) for piece in range(len(points)) for end in (0, -1) if (piece, end) not in apart]
    pairs = sorted(
        (float(np.hypot(*(points[one][a] - points[other][b]))), (one, a), (other, b))
        for index, (one, a) in enumerate(ends)
        for other, b in ends[:index]
        if one != other
    )
    joined: set[tuple[int, int]] = set()
    for distance, first, second in pairs:
        if distance < JOINED * spacing and not {first, second} & joined:
            middle = (points[first[0]][first[1]] + points[second[0]][second[1]]) / 2
            points[first[0]][first[1]] = points[second[0]][second[1]] = middle
            joined |= {first, second}
    lines = shapely.multilinestrings([LineString(piece) for piece in points])
    return list(shapely.get_parts(shapely.line_merge(lines)))
