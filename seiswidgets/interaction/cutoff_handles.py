"""The cut-offs of a drawing, numbered, and dragged along their faults."""

from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np
from shapely import LineString
from shapely import Point as Place

from seiswidgets.geology.cutoffs import WALLS
from seiswidgets.geology.section import Section
from seiswidgets.geology.segments import hanging_side, horizon_segments
from seiswidgets.interaction.drawing import FAULT, HORIZON, Drawing, PickSelection, Point

INTO = 1e-3  # of its length: how far into a piece a place is clear of the fault


@dataclass(frozen=True)
class CutOffHandle:
    """Where a piece of a horizon ends at a fault, or is cut by it.

    Attributes
    ----------
    number : int
        From 1; the two cut-offs of a horizon at a fault have the same.
    fault, horizon : str
        Their names.
    wall : {"hanging wall", "footwall"}
        That the piece lies in.
    point : tuple (x, z)
        On the fault, in the section's units.
    inside : tuple (x, z)
        A little way into the piece, clear of the fault.
    part, place : int
        Which of the parts that the faults leave of the horizon, and the end of it (0 or -1).
    """

    number: int
    fault: str
    horizon: str
    wall: str
    point: Point
    inside: Point
    part: int
    place: int


def cut_offs(drawing: Drawing, section: Section) -> tuple[CutOffHandle, ...]:
    """The cut-offs of all visible horizons at all visible faults; hidden ones keep their numbers."""
    faults = {fault.name: fault for fault in drawing.interpretation.faults}
    found = {}
    for pick in drawing.picks:
        if pick.kind == HORIZON:
            for index, part in enumerate(_parts(drawing, section, pick)):
                for place, end in zip((0, -1), part.ends, strict=True):
                    if end:
                        name = list(faults)[end.fault]
                        point, inside = (
                            tuple(at) for at in section.from_rock([end.point, _into(part, place)]).tolist()
                        )
                        mark = CutOffHandle(0, name, pick.name, WALLS[end.side], point, inside, index, place)
                        found.setdefault((name, pick.name), []).append(mark)
    order = sorted(found, key=lambda pair: (list(faults).index(pair[0]), drawing.names(HORIZON).index(pair[1])))
    shown = {(pick.kind, pick.name) for pick in drawing.picks if pick.visible}
    return tuple(
        replace(mark, number=number)
        for number, (fault, horizon) in enumerate(order, 1)
        if (FAULT, fault) in shown and (HORIZON, horizon) in shown
        for mark in found[fault, horizon]
    )


def _into(part, place):
    way = INTO * part.line.length
    return part.line.interpolate(way if place == 0 else part.line.length - way).coords[0]


def parted(drawing: Drawing, section: Section, mark: CutOffHandle) -> tuple[Drawing, PickSelection]:
    """A drawing in which the piece at a cut-off ends there with a vertex of its own, and where that is.

    A piece that crosses the fault is cut in two there, one that overshoots is trimmed, and of one that ends short the
    last vertex comes to lie on the fault.
    """
    pick = drawing.pick(HORIZON, mark.horizon)
    found = _parts(drawing, section, pick)
    part = found[mark.part]
    piece = drawing.valid_pieces(pick)[part.piece - 1]
    drawn = dict(zip(map(tuple, section.to_rock(pick.pieces[piece]).tolist()), pick.pieces[piece], strict=True))
    same = [other for other in found if other.piece == part.piece]
    lines = [_vertices(other, mark.place if other is part else None, drawn, section) for other in same]
    number = next(number for number, other in enumerate(same) if other is part)
    pieces = [*pick.pieces[:piece], *lines, *pick.pieces[piece + 1 :]]
    target = PickSelection(HORIZON, mark.horizon, piece + number, 0 if mark.place == 0 else len(lines[number]) - 1)
    return drawing.with_pieces(HORIZON, mark.horizon, pieces), target


def slid(drawing: Drawing, section: Section, target: PickSelection, fault: str, point: Point) -> Drawing:
    """With a vertex at the place of a fault that is nearest to a point."""
    line = _rock_line(drawing.pick(FAULT, fault).pieces[0], section)
    place = line.interpolate(line.project(Place(section.to_rock(point)))).coords[0]
    return drawing.moved(target, tuple(section.from_rock(place).tolist()))


def wall_of(drawing: Drawing, section: Section, fault: str, point: Point) -> str:
    """The wall of a fault that a point lies in."""
    line, point = _rock_line(drawing.pick(FAULT, fault).pieces[0], section), section.to_rock(point)
    place = line.interpolate(line.project(Place(point))).coords[0]
    return WALLS[hanging_side(line, place, point)]


def _vertices(part, dragged, drawn, section):
    """The points of a part, as they were drawn; where it was extended to a fault and is dragged, its tip goes."""
    points = list(part.line.coords)
    for place, end in zip((0, -1), part.ends, strict=True):
        if end and end.gap > 0:
            del points[place if place != dragged else (1 if place == 0 else -2)]
    return [drawn.get(point) or section.from_rock(point) for point in points]


def _parts(drawing, section, pick):
    """What the faults leave of a horizon, in metres of rock."""
    pieces = tuple(pick.pieces[piece] for piece in drawing.valid_pieces(pick))
    faults = tuple(fault.pieces[0] for fault in drawing.picks if fault.kind == FAULT and drawing.valid_pieces(fault))
    return _parts_of(pieces, faults, tuple(section.metres.tolist()))


@lru_cache(maxsize=64)  # while one horizon is dragged, the others stay as they are
def _parts_of(pieces, faults, metres):
    return horizon_segments(*([LineString(np.array(line) * metres) for line in lines] for lines in (pieces, faults)))


def _rock_line(points, section):
    return LineString(section.to_rock(points))
