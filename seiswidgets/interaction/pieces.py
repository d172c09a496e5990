"""Edits of whole pieces of a drawing: move, slide, copy, join, split, reverse, extend and delete."""

from collections.abc import Callable, Collection, Iterable, Sequence
from itertools import product

import numpy as np
from numpy.typing import ArrayLike

from seiswidgets.errors import PickError
from seiswidgets.geology.bodies import BODY
from seiswidgets.geology.picks import AUTO, FAULT, HORIZON
from seiswidgets.geology.section import Section
from seiswidgets.interaction.drawing import Drawing, PickSelection, Point, Points
from seiswidgets.interaction.piece_ends import ENDS, extend_end, fit_ends
from seiswidgets.interaction.sliding import slide_piece, slip_to, within_section

FEWEST = "select two pieces of horizons, or two faults, to join them: Shift+click in the mode Move"


def transform_pieces(
    drawing: Drawing,
    section: Section,
    targets: Collection[PickSelection],
    transform: Callable[[PickSelection, Points], ArrayLike],
) -> Drawing:
    """Replace the points of pieces by what a function makes of each, as far as it lies in the section.

    A horizon that ends at a fault goes on ending there, if it is near. A piece stays as it is if nothing is left of it.
    The points of a body are moved to the border instead.
    """
    x_min, x_max, z_min, z_max = section.extent
    moving = set(targets)
    walls = [
        pick.pieces[0]
        for pick in drawing.picks
        if pick.kind == FAULT and PickSelection(FAULT, pick.name, 0) not in moving
    ]
    for target in targets:
        before = drawing.line(target)
        points = np.asarray(transform(target, before), float)
        if target.kind == BODY:
            points = np.clip(points, (x_min, z_min), (x_max, z_max))
        else:
            points = within_section(points, section)
        if target.kind == HORIZON:
            points = fit_ends(points, before, walls, section)
        if len(points) > 1:
            drawing = drawing.with_line(target, points)
    return drawing


def slide_to(drawing: Drawing, section: Section, targets: Sequence[PickSelection], fault: str, point: Point) -> Drawing:
    """Slide pieces along a fault until the cut-off of the first lies at the point of it that is nearest to a point."""
    line = drawing.pick(FAULT, fault).pieces[0]
    slip = slip_to(drawing.line(targets[0]), line, point, section)
    return transform_pieces(drawing, section, targets, lambda _, points: slide_piece(points, line, slip, section))


def delete_pieces(drawing: Drawing, targets: Sequence[PickSelection]) -> Drawing:
    """Delete pieces, and picks of which no piece is left; targets are in the order of the drawing."""
    for target in reversed(targets):
        drawing = drawing.with_line(target, [])
    return drawing


def copy_horizon(drawing: Drawing, section: Section, name: str, dz: float) -> tuple[Drawing, str]:
    """Add a copy of a horizon, moved by ``dz`` in the section's unit of z; return its new name too."""
    new, pick = drawing.free_name(HORIZON), drawing.pick(HORIZON, name)
    walls = [fault.pieces[0] for fault in drawing.picks if fault.kind == FAULT]
    moved = [(within_section(np.add(piece, (0.0, dz)), section), piece) for piece in pick.pieces]
    pieces = [fit_ends(copy, piece, walls, section) for copy, piece in moved if len(copy) > 1]
    if not pieces:
        raise PickError(f"there is no room in the section for a copy of {name}; zoom in for a smaller step", pick=name)
    return drawing.with_pick(HORIZON, new, pieces, use=pick.use), new


def reverse_piece(drawing: Drawing, target: PickSelection) -> Drawing:
    """Turn a piece round, so that it starts where it ended."""
    pick = drawing.pick(target.kind, target.name or "")
    reversed_ = drawing.with_line(target, drawing.line(target)[::-1])
    return reversed_.with_changes(pick.kind, pick.name, ends=pick.ends[::-1])


def split_piece(drawing: Drawing, target: PickSelection) -> tuple[Drawing, PickSelection]:
    """Split a piece at a vertex: a horizon into two pieces, a fault into two faults; select the second part."""
    pick, points, vertex = drawing.pick(target.kind, target.name or ""), drawing.line(target), target.vertex or 0
    if pick.kind == BODY or not 0 < vertex < len(points) - 1:
        raise PickError(f"{pick.name} can be split at a vertex between the ends of a line only", pick=pick.name)
    first, second = points[: vertex + 1], points[vertex:]
    if pick.kind == HORIZON:
        piece = target.piece or 0
        pieces = [*pick.pieces[:piece], first, second, *pick.pieces[piece + 1 :]]
        return drawing.with_pieces(HORIZON, pick.name, pieces), PickSelection(HORIZON, pick.name, piece + 1)
    name = drawing.free_name(FAULT)
    shortened = drawing.with_changes(FAULT, pick.name, pieces=(first,), ends=(pick.ends[0], AUTO))
    split = shortened.with_pick(FAULT, name, [second], use=pick.use, ends=(AUTO, pick.ends[1]))
    return split, PickSelection(FAULT, name, 0)


def join_pieces(drawing: Drawing, section: Section, targets: Sequence[PickSelection]) -> tuple[Drawing, PickSelection]:
    """Join pieces end to end, nearest ends first, to one piece of the pick of the first; it is selected.

    A single piece of a horizon is joined to the piece of it that is nearest.

    Raises
    ------
    PickError
        Unless all of them are horizons, or all are faults, and there are two of them.
    """
    kinds = {target.kind for target in targets}
    if len(targets) == 1 and kinds == {HORIZON}:
        targets = [*targets, *_nearest_sibling(drawing, section, targets[0])]
    if len(targets) < 2 or len(kinds) > 1 or BODY in kinds:
        raise PickError(FEWEST)
    first, *others = targets
    line, rest = drawing.line(first), [drawing.line(target) for target in others]
    while rest:
        gap, index, here, there = min(
            (_gap(line, other, here, there, section), index, here, there)
            for (index, other), here, there in product(enumerate(rest), ENDS, ENDS)
        )
        line = _appended(line if here == -1 else line[::-1], rest.pop(index)[:: 1 if there == 0 else -1], gap)
    joined = drawing.with_line(first, line)
    if first.kind == FAULT and first.name is not None:
        joined = joined.with_changes(FAULT, first.name, ends=_outer_ends(drawing, targets, line))
    return _without(joined, first, others)


def extend_piece(
    drawing: Drawing, section: Section, target: PickSelection, ends: Iterable[int] = ENDS
) -> tuple[Drawing, list[str]]:
    """Extend ends of a line straight ahead to the first fault or the border; return what each meets, too."""
    faults = {pick.name: pick.pieces[0] for pick in drawing.picks if pick.kind == FAULT and pick.name != target.name}
    x_min, x_max, z_min, z_max = section.extent
    border = [(x_min, z_min), (x_max, z_min), (x_max, z_max), (x_min, z_max), (x_min, z_min)]
    names, walls = [*faults, "the border"], [*faults.values(), border]
    points, met = np.array(drawing.line(target)), []
    for which in ends:
        points, wall = extend_end(points, which, walls, section, np.inf)
        met += [] if wall is None else [names[wall]]
    return drawing.with_line(target, np.clip(points, border[0], border[2])), met


def _nearest_sibling(drawing: Drawing, section: Section, target: PickSelection) -> list[PickSelection]:
    """The other piece of the same horizon whose end is nearest to an end of this one; none if it is the only one."""
    line, pieces = drawing.line(target), drawing.pick(target.kind, target.name or "").pieces
    others = [
        (min(_gap(line, other, here, there, section) for here, there in product(ENDS, ENDS)), index)
        for index, other in enumerate(pieces)
        if index != target.piece
    ]
    return [PickSelection(target.kind, target.name, min(others)[1])] if others else []


def _gap(line: Points, other: Points, here: int, there: int, section: Section) -> float:
    """Metres of rock between an end of a line and an end of another."""
    return float(np.hypot(*section.metres * np.subtract(line[here], other[there])))


def _appended(line: Points, other: Points, gap: float) -> Points:
    return (*line, *(other if gap > 0 else other[1:]))


def _outer_ends(drawing: Drawing, targets: Sequence[PickSelection], line: Points) -> tuple[str, str]:
    """The choices for the ends of joined faults: those that the faults had at these points."""
    choices = {
        drawing.line(target)[end]: drawing.pick(FAULT, target.name or "").ends[end]
        for target in targets
        for end in ENDS
    }
    return choices[line[0]], choices[line[-1]]


def _without(drawing: Drawing, kept: PickSelection, others: Sequence[PickSelection]) -> tuple[Drawing, PickSelection]:
    """Delete pieces; return the selection of the one that is kept, whose index may change."""
    before = sum(
        (one.kind, one.name) == (kept.kind, kept.name) and (one.piece or 0) < (kept.piece or 0) for one in others
    )
    ordered = sorted(others, key=lambda one: one.piece or 0)
    return delete_pieces(drawing, ordered), PickSelection(kept.kind, kept.name, (kept.piece or 0) - before)
