"""Lines and marks that a pane draws for the state of the editor."""

from dataclasses import dataclass

import numpy as np

from seiswidgets.interaction.cutoff_handles import CutOffHandle
from seiswidgets.interaction.drawing import FAULT, PickSelection, Points
from seiswidgets.interaction.editor_state import LOOK, EditorState
from seiswidgets.interaction.overlay import Mark, Stroke
from seiswidgets.interaction.projection import PaneProjection

DRAFT = "#d81b60"
WIDTHS = {True: 3.5, False: 2.0}  # css pixels, of what is selected and of what is not
DASH = (6, 4)
APART = 10.0  # css pixels between two dots of a line


def strokes(state: EditorState, projection: PaneProjection) -> list[Stroke]:
    """All visible picks, the line under way, and the way from that to the keyboard cursor; then vertices, as dots."""
    lines = list(_lines(state))
    shown = projection.shown([(line.points, line.target.kind == FAULT) for line in lines])
    drawn = [line.stroke(seen) for line, seen in zip(lines, shown, strict=True)]
    open_lines = [line for line in lines if line.is_open]
    places = projection.vertices([(line.points, line.target.kind == FAULT) for line in open_lines])
    return drawn + [line.dots(seen, projection.view.pixel) for line, seen in zip(open_lines, places, strict=True)]


@dataclass(frozen=True)
class _Line:
    """A line to be drawn; open if its vertices can be taken hold of, with the chosen one among them."""

    target: PickSelection
    points: Points
    colour: str
    is_selected: bool = False
    is_open: bool = False
    chosen: int | None = None
    dash: tuple = ()

    def stroke(self, seen):
        label = (self.target.name or "") if self.target.piece == 0 else ""
        return Stroke(seen, self.colour, WIDTHS[self.is_selected], dash=self.dash, label=label)

    def dots(self, seen, pixel):
        """Its vertices; where they are dense, not all of them, but the chosen one for certain."""
        kept = _apart(seen / pixel, self.chosen)
        alone = np.repeat(seen[kept], 2, axis=0)  # vertices without lines between them
        alone[1::2] = np.nan
        chosen = None if self.chosen is None else 2 * kept.index(self.chosen)
        return Stroke(alone, self.colour, WIDTHS[self.is_selected], dots=True, chosen=chosen)


def _lines(state):
    for pick in state.drawing.picks:
        if pick.visible:
            for number, points in enumerate(pick.pieces):
                yield _line(state, PickSelection(pick.kind, pick.name, number), points, pick.colour)
    line, cursor = state.drawing.draft, state.cursor
    if line:
        yield _line(state, PickSelection(line.kind, None, 0), line.points, DRAFT)
    if line and cursor and cursor != line.points[-1]:
        yield _Line(PickSelection(line.kind, None), (line.points[-1], cursor), DRAFT, dash=DASH)


def _line(state, target, points, colour):
    chosen = state.selection
    is_selected = chosen is not None and (chosen.kind, chosen.name) == (target.kind, target.name)
    is_open = target.name is None or state.mode == target.kind or (is_selected and state.mode == LOOK)
    vertex = chosen.vertex if is_selected and chosen.piece == target.piece else None
    return _Line(target, points, colour, is_selected, is_open, vertex)


def marks(state: EditorState, projection: PaneProjection, cutoffs: tuple[CutOffHandle, ...]) -> list[Mark]:
    """The cut-offs, numbered; the point that is held; the keyboard cursor."""
    colours = {pick.name: pick.colour for pick in state.drawing.picks if pick.kind == FAULT}
    places = [(mark.inside, "cutoff", str(mark.number), colours[mark.fault]) for mark in cutoffs]
    if state.fixed:
        places.append((state.fixed, "held", "held", DRAFT))
    if state.cursor:
        places.append((state.cursor, "cursor", "", DRAFT))
    points = projection.to_pane([point for point, *_ in places])
    return [
        Mark(tuple(at.tolist()), *rest) for at, (_, *rest) in zip(points, places, strict=True) if np.isfinite(at).all()
    ]


def rubber(state: EditorState, projection: PaneProjection) -> list[tuple[float, float]]:
    """Where the line to the pointer starts; nowhere if no line is under way, or the keyboard leads it."""
    draft = state.drawing.draft
    if draft is None or state.cursor:
        return []
    (start,) = projection.to_pane([draft.points[-1]])
    return [tuple(start.tolist())] if np.isfinite(start).all() else []


def _apart(pixels, chosen):
    """The first of some points, and each that is far enough from the last one kept; and the chosen one."""
    kept = []
    for number, place in enumerate(pixels):
        if not kept or number == chosen or not np.hypot(*(place - pixels[kept[-1]])) < APART:
            kept.append(number)
    return kept
