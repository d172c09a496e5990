"""Pieces of horizons brought to the faults they end at.

Pieces are seldom drawn to a fault exactly: one that ends short is extended along its last stretch, by a fifth of its
length at most; one that overshoots is trimmed.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np
import shapely
from shapely import LineString, Point
from shapely.ops import substring

EXTENSION = 0.2  # of a piece's length: how far it is extended to a fault, and how short an overshoot is


@dataclass(frozen=True)
class End:
    """An end of a piece at a fault.

    Attributes
    ----------
    fault : int
        Which of the faults.
    point : tuple (x, z)
    side : int
        1 where the piece lies in the hanging wall, -1 in the footwall.
    gap : float
        How far the piece had to be extended.
    """

    fault: int
    point: tuple[float, float]
    side: int
    gap: float


@dataclass(frozen=True, eq=False)
class HorizonSegment:
    """A piece of a horizon, or what a fault leaves of it, drawn on to the faults at its ends.

    Attributes
    ----------
    line : shapely LineString
    ends : the End at its first and at its last point, None where it ends freely
    number : int
        Of the piece as it was drawn, from 1.
    short : bool
        Whether it is a short end beyond a fault, which counts only if no other piece lies there.
    """

    line: LineString
    ends: tuple[End | None, End | None]
    number: int
    short: bool = False


def horizon_segments(pieces: Sequence[LineString], faults: Sequence[LineString]) -> list[HorizonSegment]:
    """The pieces of a horizon, split where they cross faults and extended to the faults they end short of.

    A short end beyond a fault is left out if another piece lies there: then it is an overshoot.
    """
    split = [part for number, piece in enumerate(pieces, 1) for part in split_at_faults(piece, faults, number)]
    found = [_extended(part, faults) for part in split]
    claimed = {(end.fault, end.side) for part in found if not part.short for end in part.ends if end}
    return [
        part for part in found if not (part.short and any((end.fault, end.side) in claimed for end in part.ends if end))
    ]


def split_at_faults(piece: LineString, faults: Sequence[LineString], number: int = 1) -> list[HorizonSegment]:
    """A line in parts, cut where it crosses faults."""
    crossings = sorted(
        (piece.project(point), fault)
        for fault in _near(faults, piece, 1e-9 * piece.length)  # rounding can part a line from its own crossing
        for point in _points(piece.intersection(faults[fault]))
    )
    length = piece.length
    if not crossings and length > 0:
        return [HorizonSegment(piece, (None, None), number)]
    inner = [(way, fault) for way, fault in crossings if 1e-9 * length < way < (1 - 1e-9) * length]
    stops = [(0.0, None), *inner, (length, None)]
    found = []
    for (start, first), (stop, last) in pairwise(stops):
        if stop - start <= 1e-9 * length:
            continue
        line = substring(piece, start, stop)
        ends = tuple(
            None if fault is None else _end(line, place, fault, faults[fault], shapely.get_coordinates(line)[place])
            for fault, place in ((first, 0), (last, -1))
        )
        outer = (first is None) != (last is None)
        found.append(HorizonSegment(line, ends, number, outer and stop - start < EXTENSION * length))
    return found


def _extended(part, faults):
    """A part with its free ends drawn on to the first fault in reach."""
    if not faults:
        return part
    points, ends = shapely.get_coordinates(part.line), list(part.ends)
    for place in (0, -1):
        end = ends[place] or reached(part.line, place, faults, EXTENSION * part.line.length)
        if end and end.gap > 0:
            points = np.insert(points, 0 if place == 0 else len(points), end.point, axis=0)
        elif end:
            points[place] = end.point
        ends[place] = end
    return replace(part, line=LineString(points), ends=tuple(ends))


def reached(line: LineString, place: int, faults: Sequence[LineString], reach: float) -> End | None:
    """The End at the first fault that a line meets when it is drawn on by so much, or None."""
    tip, direction = _heading(line, place)
    touch = 1e-6 * line.length
    ray = LineString([tip, tip + (reach + touch) * direction])
    met = [
        (max(0.0, Point(tip).distance(point)), number, point.coords[0])
        for number in _near(faults, Point(tip), 2 * (reach + touch))
        for point in [*_points(ray.intersection(faults[number])), *_touched(faults[number], tip, touch)]
    ]
    if not met:
        return None
    gap, number, point = min(met)
    return _end(line, place, number, faults[number], point, gap if gap > touch else 0.0)


def _near(faults, geometry, reach):
    """Which of the faults come so near."""
    return np.flatnonzero(shapely.dwithin(np.array(faults, object), geometry, reach)).tolist()


def _touched(fault, tip, touch):
    near = fault.interpolate(fault.project(Point(tip)))
    return [near] if near.distance(Point(tip)) <= touch else []


def _heading(line, place):
    """An end of a line and the direction in which it goes on there, from the last tenth of its length."""
    back = line.interpolate(0.1 if place == 0 else 0.9, normalized=True).coords[0]
    tip = shapely.get_coordinates(line)[place]
    arm = tip - back
    return tip, arm / np.hypot(*arm)


def _end(line, place, number, fault, point, gap=0.0):
    inside = line.interpolate(0.05 if place == 0 else 0.95, normalized=True)
    return End(number, tuple(point), hanging_side(fault, point, inside.coords[0]), gap)


def hanging_side(fault: LineString, place, point) -> int:
    """1 if a point lies in the hanging wall of a fault, as seen from a place on it; -1 if in its footwall.

    The hanging wall is the side that lies above the fault as a whole: along a fault that is overturned in part it
    stays the same side. Where the fault is upright, that is its right side.
    """
    way, reach = fault.project(Point(place)), 1e-3 * fault.length
    before, after = (np.array(fault.interpolate(max(0.0, way + step)).coords[0]) for step in (-reach, reach))
    along, whole = after - before, np.subtract(*shapely.get_coordinates(fault)[[-1, 0]])
    across = along[0] * (point[1] - place[1]) - along[1] * (point[0] - place[0])
    drawn_down = whole[1] > 0 or (whole[1] == 0 and whole[0] > 0)
    dips_right = whole[0] * (1 if drawn_down else -1) >= 0
    return 1 if (across < 0) == (drawn_down == dips_right) else -1


def _points(geometry):
    """The points that lines have in common; where they share a stretch, neither parts the other there."""
    return [part for part in shapely.get_parts(geometry) if part.geom_type == "Point" and not part.is_empty]
