"""What a pen holds, as the lines and marks that a pane draws."""

from dataclasses import dataclass

import numpy as np

from seiswidgets.widgets.panes.overlay import Mark, Stroke
from seiswidgets.widgets.picking.cutoffmarks import CutOff
from seiswidgets.widgets.picking.drawing import FAULT, Points, Spot
from seiswidgets.widgets.picking.pen import Pen
from seiswidgets.widgets.picking.penstate import LOOK
from seiswidgets.widgets.picking.sight import Sight

UNDER_WAY = "#d81b60"
WIDTHS = {True: 3.5, False: 2.0}  # css pixels, of what is selected and of what is not
DASH = (6, 4)
APART = 10.0  # css pixels between two dots of a line


def strokes(pen: Pen, sight: Sight) -> list[Stroke]:
    """All visible picks, the line under way, and the way from that to the keyboard cursor; then vertices, as dots."""
    lines = list(_lines(pen))
    shown = sight.shown([(line.points, line.spot.kind == FAULT) for line in lines])
    drawn = [line.stroke(seen) for line, seen in zip(lines, shown, strict=True)]
    open_lines = [line for line in lines if line.is_open]
    places = sight.vertices([(line.points, line.spot.kind == FAULT) for line in open_lines])
    return drawn + [line.dots(seen, sight.view.pixel) for line, seen in zip(open_lines, places, strict=True)]


@dataclass(frozen=True)
class _Line:
    """A line to be drawn; open if its vertices can be taken hold of, with the chosen one among them."""

    spot: Spot
    points: Points
    colour: str
    is_selected: bool = False
    is_open: bool = False
    chosen: int | None = None
    dash: tuple = ()

    def stroke(self, seen):
        label = (self.spot.name or "") if self.spot.piece == 0 else ""
        return Stroke(seen, self.colour, WIDTHS[self.is_selected], dash=self.dash, label=label)

    def dots(self, seen, pixel):
        """Its vertices; where they are dense, not all of them, but the chosen one for certain."""
        kept = _apart(seen / pixel, self.chosen)
        alone = np.repeat(seen[kept], 2, axis=0)  # vertices without lines between them
        alone[1::2] = np.nan
        chosen = None if self.chosen is None else 2 * kept.index(self.chosen)
        return Stroke(alone, self.colour, WIDTHS[self.is_selected], dots=True, chosen=chosen)


def _lines(pen):
    for pick in pen.drawing.picks:
        if pick.visible:
            for number, points in enumerate(pick.pieces):
                yield _line(pen, Spot(pick.kind, pick.name, number), points, pick.colour)
    line, cursor = pen.drawing.under_way, pen.state.cursor
    if line:
        yield _line(pen, Spot(line.kind, None, 0), line.points, UNDER_WAY)
    if line and cursor and cursor != line.points[-1]:
        yield _Line(Spot(line.kind, None), (line.points[-1], cursor), UNDER_WAY, dash=DASH)


def _line(pen, spot, points, colour):
    chosen = pen.state.selection
    is_selected = chosen is not None and (chosen.kind, chosen.name) == (spot.kind, spot.name)
    is_open = spot.name is None or pen.state.mode == spot.kind or (is_selected and pen.state.mode == LOOK)
    vertex = chosen.vertex if is_selected and chosen.piece == spot.piece else None
    return _Line(spot, points, colour, is_selected, is_open, vertex)


def marks(pen: Pen, sight: Sight, cutoffs: tuple[CutOff, ...]) -> list[Mark]:
    """The cut-offs, numbered; the point that is held; the keyboard cursor."""
    colours = {pick.name: pick.colour for pick in pen.drawing.picks if pick.kind == FAULT}
    places = [(mark.inside, "cutoff", str(mark.number), colours[mark.fault]) for mark in cutoffs]
    if pen.drawing.fixed:
        places.append((pen.drawing.fixed, "held", "held", UNDER_WAY))
    if pen.state.cursor:
        places.append((pen.state.cursor, "cursor", "", UNDER_WAY))
    points = sight.to_pane([point for point, *_ in places])
    return [
        Mark(tuple(at.tolist()), *rest) for at, (_, *rest) in zip(points, places, strict=True) if np.isfinite(at).all()
    ]


def rubber(pen: Pen, sight: Sight) -> list[tuple[float, float]]:
    """Where the line to the pointer starts; nowhere if no line is under way, or the keyboard leads it."""
    if pen.rubber_band is None or pen.state.cursor:
        return []
    (start,) = sight.to_pane([pen.rubber_band])
    return [tuple(start.tolist())] if np.isfinite(start).all() else []


def _apart(pixels, chosen):
    """The first of some points, and each that is far enough from the last one kept; and the chosen one."""
    kept = []
    for number, place in enumerate(pixels):
        if not kept or number == chosen or not np.hypot(*(place - pixels[kept[-1]])) < APART:
            kept.append(number)
    return kept
