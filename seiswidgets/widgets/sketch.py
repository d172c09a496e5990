"""What a pen holds, as the lines and marks that a pane draws."""

import numpy as np

from seiswidgets.widgets.cutoffmarks import CutOff
from seiswidgets.widgets.drawing import FAULT, Spot
from seiswidgets.widgets.overlay import Mark, Stroke
from seiswidgets.widgets.pen import Pen
from seiswidgets.widgets.penstate import LOOK
from seiswidgets.widgets.sight import Sight

UNDER_WAY = "#d81b60"
WIDTHS = {True: 3.5, False: 2.0}  # css pixels, of what is selected and of what is not
DASH = (6, 4)


def strokes(pen: Pen, sight: Sight) -> list[Stroke]:
    """All visible picks, the line under way, and the way from that to the keyboard cursor."""
    drawn = [
        stroke
        for pick in pen.drawing.picks
        if pick.visible
        for number, points in enumerate(pick.pieces)
        for stroke in _line(pen, sight, Spot(pick.kind, pick.name, number), points, pick.colour)
    ]
    line, cursor = pen.drawing.under_way, pen.state.cursor
    if line:
        drawn += _line(pen, sight, Spot(line.kind, None, 0), line.points, UNDER_WAY)
    if line and cursor and cursor != line.points[-1]:
        drawn.append(Stroke(sight.shown([line.points[-1], cursor]), UNDER_WAY, 1.5, dash=DASH))
    return drawn


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


def _line(pen, sight, spot, points, colour):
    """A piece of a pick, and its vertices where they can be taken hold of."""
    chosen = pen.state.selection
    selected = chosen is not None and (chosen.kind, chosen.name) == (spot.kind, spot.name)
    label = (spot.name or "") if spot.piece == 0 else ""
    fault = spot.kind == FAULT
    yield Stroke(sight.shown(points, fault=fault), colour, WIDTHS[selected], label=label)
    if spot.name is None or pen.state.mode == spot.kind or (selected and pen.state.mode == LOOK):
        here = selected and chosen.piece == spot.piece
        alone = np.repeat(sight.vertices(points, fault=fault), 2, axis=0)  # vertices without lines between them
        alone[1::2] = np.nan
        vertex = 2 * chosen.vertex if here and chosen.vertex is not None else None
        yield Stroke(alone, colour, WIDTHS[selected], dots=True, chosen=vertex)
