"""Stretches that two faults share: thrusts on one floor, or a fault drawn along the younger one that offset it."""

from collections.abc import Iterable

import shapely
from shapely import LineString, Point
from shapely.ops import substring

TIGHT = 0.01  # share of the reach: lines drawn along each other with snapping are closer than this
LONG = 12  # times the distance between the lines: two that cross at more than 10 degrees part sooner

Stretch = tuple[float, float]  # arc lengths of its ends along a line


def shared_stretches(line: LineString, other: LineString, reach: float) -> list[Stretch]:
    """The stretches of a line that lie on top of another line, in order; ``reach`` is the largest distance."""
    stretches = []
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
