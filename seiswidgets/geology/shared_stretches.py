"""Stretches that two faults share: thrusts on one floor, or a fault drawn along the younger one that offset it."""

from collections.abc import Iterable, Sequence
from itertools import pairwise

import numpy as np
import shapely
from shapely import LineString, Point
from shapely.ops import substring

from seiswidgets.geology.segments import split_at_faults

TIGHT = 0.01  # share of the reach: lines drawn along each other with snapping are closer than this
LONG = 12  # times the distance between the lines: two that cross at more than 10 degrees part sooner

ONWARDS = np.sqrt(0.5)  # cosine of the largest turn in which slip on a fault continues along another

Stretch = tuple[float, float]  # arc lengths of its ends along a line


def shared_stretches(line: LineString, other: LineString, reach: float) -> list[Stretch]:
    """The stretches of a line that lie on top of another line, in order; ``reach`` is the largest distance."""
    stretches: list[Stretch] = []
    if not shapely.dwithin(line, other, reach):
        return stretches
    for part in _parts_within(line, other, reach):
        tight = _parts_within(part, other, TIGHT * reach)
        ends = [line.project(Point(piece.coords[which])) for piece in tight or [part] for which in (0, -1)]
        apart = TIGHT * reach if tight else float(shapely.distance(other, shapely.points(part.coords)).max())
        if max(ends) - min(ends) > LONG * apart:
            stretches.append((min(ends), max(ends)))
    return sorted(stretches)


def _parts_within(line: LineString, other: LineString, distance: float) -> list[LineString]:
    near = line.intersection(other.buffer(distance))
    return [part for part in shapely.get_parts(shapely.line_merge(near)) if part.geom_type == "LineString"]


def follow(line: LineString, others: Iterable[LineString], reach: float) -> LineString:
    """Make a line coincide exactly with others where it lies on top of them."""
    for other in others:
        for start, stop in reversed(shared_stretches(line, other, reach)):
            stretch = substring(other, *(other.project(line.interpolate(end)) for end in (start, stop)))
            arc_lengths = [line.project(Point(point)) for point in line.coords]
            before = [point for point, at in zip(line.coords, arc_lengths, strict=True) if at < start]
            after = [point for point, at in zip(line.coords, arc_lengths, strict=True) if at > stop]
            line = LineString([*before, *stretch.coords, *after])
    return line


def split_into_stretches(line: LineString, faults: Sequence[LineString], reach: float) -> list[tuple[LineString, bool]]:
    """Parts of a fault between the faults of a stage, in order, each with True if it lies on one of them."""
    stretches = sorted(stretch for fault in faults for stretch in shared_stretches(line, fault, reach))
    stops = np.clip([0, *np.maximum.accumulate(np.array(stretches).ravel()), line.length], 0, line.length)
    parts: list[tuple[LineString, bool]] = []
    for index, (start, stop) in enumerate(pairwise(stops)):
        if stop - start > 1e-9 * line.length:
            part, shared = substring(line, start, stop), index % 2 == 1
            pieces = [part] if shared else [segment.line for segment in split_at_faults(part, faults)]
            parts += [(piece, shared) for piece in pieces]
    return parts


def continue_along(line: LineString, boundaries: Sequence[LineString], others: Sequence[LineString]) -> LineString:
    """Draw a fault on along the boundaries that it ends at, if the turn is no more than 45 degrees.

    A thrust that branches off an older or a younger one has slid on the floor that both share.

    Parameters
    ----------
    line : LineString
    boundaries : list of LineString
        Faults that are not restored together with this one.
    others : list of LineString
        Faults that are; a fault that ends at one of them is not drawn on.
    """
    touch = 1e-6 * line.length
    for _ in (0, 1):  # the end, then the start
        left = list(boundaries)
        while (end := Point(line.coords[-1])) and not any(other.distance(end) <= touch for other in others):
            arms = [(arm, index) for index, boundary in enumerate(left) for arm in _arms(boundary, end, touch)]
            turns = [_turn(line, arm) for arm, _ in arms]
            if max(turns, default=-1.0) < ONWARDS:
                break
            arm, index = arms[int(np.argmax(turns))]
            line = LineString([*line.coords, *arm.coords[1:]])
            del left[index]
        line = line.reverse()
    return line


def _arms(boundary: LineString, point: Point, touch: float) -> list[LineString]:
    """The two parts of a line from a point on it to its ends, if they are longer than ``touch``."""
    if boundary.distance(point) > touch:
        return []
    arc_length = boundary.project(point)
    arms = [substring(boundary, arc_length, end) for end in (0, boundary.length)]
    return [arm for arm in arms if arm.length > touch]


def _turn(line: LineString, arm: LineString) -> float:
    """Cosine of the angle between the end of a line and the start of another one."""
    one, other = np.diff(line.coords[-2:], axis=0)[0], np.diff(arm.coords[:2], axis=0)[0]
    return float(one @ other / (np.hypot(*one) * np.hypot(*other)))
