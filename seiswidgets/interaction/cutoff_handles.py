"""The numbered cut-offs of a drawing, and dragging them along their faults."""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
import shapely
from shapely import LineString

from seiswidgets.geology.cutoffs import WALLS, places_along
from seiswidgets.geology.picks import FAULT, HORIZON
from seiswidgets.geology.section import Section
from seiswidgets.geology.segments import HorizonSegment, hanging_side, horizon_segments
from seiswidgets.interaction.drawing import Drawing, Pick, PickSelection, Point, Points

INSIDE = 1e-3  # share of a segment's length at which a point of it is clear of the fault
ENDS = (0, -1)  # indices of a line's first and last point


@dataclass(frozen=True)
class CutOffHandle:
    """A point at which a horizon ends at a fault, or is cut by it.

    Attributes
    ----------
    number : int
        From 1; the two cut-offs of a horizon at one place along a fault share one.
    fault, horizon : str
        Their names.
    wall : {"hanging wall", "footwall"}
        Wall that the horizon's segment lies in.
    point : tuple (x, z)
        On the fault, in the section's units.
    inside : tuple (x, z)
        A point of the segment that is near the fault but clear of it.
    segment : int
        Index of the segment, of those into which the faults split the horizon.
    end : {0, -1}
        The segment's end at the fault: its first or its last point.
    """

    number: int
    fault: str
    horizon: str
    wall: str
    point: Point
    inside: Point
    segment: int
    end: int


def cutoff_handles(drawing: Drawing, section: Section) -> tuple[CutOffHandle, ...]:
    """Cut-offs of all visible horizons at all visible faults; hidden ones keep their numbers."""
    faults = [fault.name for fault in drawing.interpretation.faults]
    lines = [_rock_line(fault.points, section) for fault in drawing.interpretation.faults]
    horizons = {pick.name: _segments(drawing, section, pick) for pick in drawing.picks if pick.kind == HORIZON}
    places = [
        (fault, horizon, ends)
        for index, fault in enumerate(faults)
        for horizon in drawing.names(HORIZON)
        for ends in places_along(lines[index], index, horizons[horizon])
    ]
    visible = {(pick.kind, pick.name) for pick in drawing.picks if pick.visible}
    return tuple(
        _handle(number, fault, horizon, horizons[horizon], *end, section)
        for number, (fault, horizon, ends) in enumerate(places, 1)
        if (FAULT, fault) in visible and (HORIZON, horizon) in visible
        for end in sorted(filter(None, ends))
    )


def split_at_cutoff(drawing: Drawing, section: Section, handle: CutOffHandle) -> tuple[Drawing, PickSelection]:
    """End a horizon's piece at a cut-off with a vertex of its own; return the drawing and that vertex.

    A piece that crosses the fault is cut in two there, one that overshoots is trimmed, and the last vertex of one that
    ends short is moved onto the fault.
    """
    pick = drawing.pick(HORIZON, handle.horizon)
    segments = _segments(drawing, section, pick)
    segment = segments[handle.segment]
    piece = drawing.valid_pieces(pick)[segment.piece - 1]
    drawn = dict(zip(map(tuple, section.to_rock(pick.pieces[piece]).tolist()), pick.pieces[piece], strict=True))
    siblings = [other for other in segments if other.piece == segment.piece]
    lines = [_vertices(other, handle.end if other is segment else None, drawn, section) for other in siblings]
    index = next(index for index, other in enumerate(siblings) if other is segment)
    vertex = 0 if handle.end == 0 else len(lines[index]) - 1
    pieces = [*pick.pieces[:piece], *lines, *pick.pieces[piece + 1 :]]
    target = PickSelection(HORIZON, handle.horizon, piece + index, vertex)
    return drawing.with_pieces(HORIZON, handle.horizon, pieces), target


def slide_along_fault(drawing: Drawing, section: Section, target: PickSelection, fault: str, point: Point) -> Drawing:
    """Move a vertex to the point of a fault that is nearest to a point."""
    line = _rock_line(drawing.pick(FAULT, fault).pieces[0], section)
    return drawing.with_vertex_moved(target, _in_section(_nearest(line, section.to_rock(point)), section))


def wall_of(drawing: Drawing, section: Section, fault: str, point: Point) -> str:
    """Wall of a fault in which a point lies."""
    line, rock = _rock_line(drawing.pick(FAULT, fault).pieces[0], section), section.to_rock(point)
    return WALLS[hanging_side(line, _nearest(line, rock), rock)]


def _handle(
    number: int, fault: str, horizon: str, segments: list[HorizonSegment], index: int, which: int, section: Section
) -> CutOffHandle:
    segment = segments[index]
    end = segment.ends[which]
    if end is None:
        raise ValueError("a segment has no cut-off at its free end")
    point, inside = _in_section(end.point, section), _in_section(_point_inside(segment, which), section)
    return CutOffHandle(number, fault, horizon, WALLS[end.side], point, inside, index, which)


def _point_inside(segment: HorizonSegment, end: int) -> Point:
    share = INSIDE if end == 0 else 1 - INSIDE
    x, z = segment.line.interpolate(share, normalized=True).coords[0]
    return x, z


def _vertices(
    segment: HorizonSegment, dragged: int | None, drawn: Mapping[tuple[float, ...], Point], section: Section
) -> Points:
    """Points of a segment as they were drawn, without an extension to a fault; a dragged end keeps its tip instead."""
    points = list(segment.line.coords)
    for index, end in zip(ENDS, segment.ends, strict=True):
        if end and end.gap > 0:
            del points[index if index != dragged else (1 if index == 0 else -2)]
    return tuple(drawn.get(point) or _in_section(point, section) for point in points)


def _segments(drawing: Drawing, section: Section, pick: Pick) -> list[HorizonSegment]:
    """Segments into which the faults split a horizon, in metres of rock."""
    pieces = tuple(pick.pieces[piece] for piece in drawing.valid_pieces(pick))
    faults = tuple(fault.pieces[0] for fault in drawing.picks if fault.kind == FAULT and drawing.valid_pieces(fault))
    cell = section.metres * (section.dx, section.dz)
    return _cached_segments(pieces, faults, tuple(section.metres.tolist()), tuple(cell.tolist()))


@lru_cache(maxsize=64)  # while one horizon is dragged, the others stay as they are
def _cached_segments(pieces: Points, faults: Points, metres: Point, cell: Point) -> list[HorizonSegment]:
    beds, walls = ([LineString(np.array(line) * metres) for line in lines] for lines in (pieces, faults))
    return horizon_segments(beds, walls, np.array(cell))


def _nearest(line: LineString, point: np.ndarray) -> Point:
    """Point of a line that is nearest to another point."""
    x, z = line.interpolate(line.project(shapely.Point(point))).coords[0]
    return x, z


def _in_section(point: tuple[float, ...], section: Section) -> Point:
    """Convert a point from metres of rock to the section's units."""
    x, z = section.from_rock(point).tolist()
    return x, z


def _rock_line(points: Points | np.ndarray, section: Section) -> LineString:
    return LineString(section.to_rock(points))
