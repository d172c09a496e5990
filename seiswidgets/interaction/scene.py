"""Strokes and marks that a pane draws for the state of the editor."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from seiswidgets.geology.bodies import BODY
from seiswidgets.geology.picks import FAULT
from seiswidgets.interaction.cutoff_handles import CutOffHandle
from seiswidgets.interaction.drawing import PickSelection, Point, Points, closed
from seiswidgets.interaction.editor_state import LOOK, MOVE, EditorState
from seiswidgets.interaction.overlay import Mark, Stroke
from seiswidgets.interaction.projection import PaneProjection, side_of

DRAFT_COLOUR = "#d81b60"
WIDTH, WIDTH_SELECTED = 2.0, 3.5  # css pixels
DASH = (6, 4)


def strokes(state: EditorState, projection: PaneProjection) -> list[Stroke]:
    """All visible picks, the draft line and its dashed continuation to the keyboard cursor; then vertices as dots."""
    lines = list(_lines(state))
    open_lines = [line for line in lines if line.is_open]
    shown = projection.lines([(line.border, line.side) for line in lines])
    vertices = projection.vertices([(line.points, line.side) for line in open_lines])
    return [
        *(line.stroke(points) for line, points in zip(lines, shown, strict=True)),
        *(line.dots(points) for line, points in zip(open_lines, vertices, strict=True)),
        *_regional(state, projection),
        *_rectangle(state, projection),
    ]


def _regional(state: EditorState, projection: PaneProjection) -> list[Stroke]:
    """The level or line that keeps its depth."""
    level, (x_min, x_max, *_) = state.document.plan.regional, state.document.section.extent
    if level is None:
        return []
    points = ((x_min, level), (x_max, level)) if isinstance(level, float) else level
    (shown,) = projection.lines([(points, 0)])
    return [Stroke(shown, DRAFT_COLOUR, 1.0, dash=DASH, label="regional")]


@dataclass(frozen=True, eq=False)
class Ghost:
    """A proposed piece of a horizon, shown dashed until it is accepted or dismissed."""

    points: Points
    colour: str
    label: str


def ghost_strokes(ghosts: Sequence[Ghost], projection: PaneProjection) -> list[Stroke]:
    """Proposed pieces as the pane shows them."""
    shown = projection.lines([(ghost.points, 0) for ghost in ghosts])
    return [
        Stroke(points, ghost.colour, WIDTH_SELECTED, dash=DASH, label=ghost.label)
        for ghost, points in zip(ghosts, shown, strict=True)
    ]


def _rectangle(state: EditorState, projection: PaneProjection) -> list[Stroke]:
    """The rectangle that selects pieces, in the pane in which it is drawn."""
    drag = state.drag
    if drag is None or drag.target is not None or drag.is_restored != (projection.restoration is not None):
        return []
    (left, top), (right, bottom) = drag.pixel, drag.last
    corners = [(left, top), (right, top), (right, bottom), (left, bottom), (left, top)]
    return [Stroke(projection.view.to_section(corners), DRAFT_COLOUR, WIDTH, dash=DASH)]


def marks(state: EditorState, projection: PaneProjection, cutoffs: tuple[CutOffHandle, ...]) -> list[Mark]:
    """The numbered cut-offs, the held point, and the keyboard cursor."""
    colours = {pick.name: pick.colour for pick in state.drawing.picks if pick.kind == FAULT}
    present = [Mark(handle.inside, "cutoff", str(handle.number), colours[handle.fault]) for handle in cutoffs]
    if state.fixed:
        present.append(Mark(state.fixed, "held", "held", DRAFT_COLOUR))
    present += [Mark(pin, "held", "pin", DRAFT_COLOUR) for pin in state.pins]
    if state.cursor:
        present.append(Mark(state.cursor, "cursor", "", DRAFT_COLOUR))
    points = projection.to_pane([mark.point for mark in present]).tolist()
    return [
        Mark((x, z), mark.kind, mark.text, mark.colour)
        for (x, z), mark in zip(points, present, strict=True)
        if np.isfinite((x, z)).all()
    ]


def rubber_band(state: EditorState, projection: PaneProjection) -> list[Point]:
    """Start of the line to the pointer, or the line along an event that leads there.

    Empty without a draft line, or while the keyboard cursor leads it.
    """
    draft = state.drawing.draft
    if draft is None or state.cursor:
        return []
    points = projection.to_pane(state.preview or [draft.points[-1]])
    return [(x, z) for x, z in points.tolist() if np.isfinite((x, z)).all()]


@dataclass(frozen=True)
class _Line:
    """A line to be drawn; open if its vertices can be dragged, ``chosen`` being the index of the selected one."""

    target: PickSelection
    points: Points
    colour: str
    is_selected: bool = False
    is_open: bool = False
    chosen: int | None = None
    dash: tuple[float, ...] = ()

    @property
    def border(self) -> Points:
        """The points; those of a finished body are closed."""
        is_closed = self.target.kind == BODY and self.target.name is not None
        return closed(self.points) if is_closed else self.points

    @property
    def side(self) -> int:
        return side_of(self.target.kind, self.points)

    @property
    def width(self) -> float:
        return WIDTH_SELECTED if self.is_selected else WIDTH

    def stroke(self, points: np.ndarray) -> Stroke:
        label = (self.target.name or "") if self.target.piece == 0 else ""
        return Stroke(points, self.colour, self.width, dash=self.dash, label=label)

    def dots(self, points: np.ndarray) -> Stroke:
        """Dots at the vertices; the browser shows some of them where they are dense."""
        return Stroke(points, self.colour, self.width, dots=True, chosen=self.chosen, joined=False)


def _lines(state: EditorState) -> Iterator[_Line]:
    for pick in state.drawing.picks:
        if pick.visible:
            for piece, points in enumerate(pick.pieces):
                yield _line(state, PickSelection(pick.kind, pick.name, piece), points, pick.colour)
    draft, cursor = state.drawing.draft, state.cursor
    if draft:
        yield _line(state, PickSelection(draft.kind, None, 0), draft.points, DRAFT_COLOUR)
    if draft and cursor and cursor != draft.points[-1]:
        line = state.preview or (draft.points[-1], cursor)
        yield _Line(PickSelection(draft.kind, None), line, DRAFT_COLOUR, dash=DASH)


def _line(state: EditorState, target: PickSelection, points: Points, colour: str) -> _Line:
    selection = state.selection
    if state.mode == MOVE or state.others:
        is_chosen = target in state.chosen_pieces
        return _Line(target, points, colour, is_selected=is_chosen, is_open=state.mode == target.kind)
    if selection is None or (selection.kind, selection.name) != (target.kind, target.name):
        return _Line(target, points, colour, is_open=target.name is None or state.mode == target.kind)
    is_open = target.name is None or state.mode in (target.kind, LOOK)
    chosen = selection.vertex if selection.piece == target.piece else None
    return _Line(target, points, colour, is_selected=True, is_open=is_open, chosen=chosen)
