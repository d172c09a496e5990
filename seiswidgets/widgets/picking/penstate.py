"""All that a pen shows, as one frozen value."""

from dataclasses import dataclass, field, replace

from seiswidgets.widgets.picking.drawing import FAULT, HORIZON, Drawing, Point, Spot

LOOK, BLOCK = "look", "block"
MODES = (LOOK, FAULT, HORIZON, BLOCK)


@dataclass(frozen=True)
class Drag:
    """A vertex held by the pointer.

    Attributes
    ----------
    spot : Spot
        The vertex, in ``base``.
    before : Drawing
    selection : Spot or None
        As they were, for undo and Escape.
    base : Drawing
        What the vertex is moved in: with the vertex inserted, or the piece cut at its fault.
    pixel, last : tuple
        Where it was taken hold of, and where the pointer was when it was last told of.
    fault : str or None
        That a cut-off is dragged along.
    moves : bool
        Whether it has left its place; a click does not move.
    """

    spot: Spot
    before: Drawing
    selection: Spot | None
    base: Drawing
    pixel: tuple[float, float]
    last: tuple[float, float]
    fault: str | None = None
    moves: bool = False


@dataclass(frozen=True)
class PenState:
    """All that a pen shows.

    Attributes
    ----------
    mode : {"look", "fault", "horizon", "block"}
        That of the line under way, if there is one.
    drawing : Drawing
    selection : Spot or None
        A pick, a piece of it, or one vertex of that or of the line under way.
    cursor : (x, z) or None
        The keyboard's; none in look mode.
    drag : Drag or None
    """

    mode: str = LOOK
    drawing: Drawing = field(default_factory=Drawing)
    selection: Spot | None = None
    cursor: Point | None = None
    drag: Drag | None = None


def known(state: PenState) -> Spot | None:
    """What is selected and there: the piece or pick where the vertex cannot be changed now, None where all is gone."""
    spot, drawing = state.selection, state.drawing
    if spot is None:
        return None
    points = drawing.line(spot)
    there = spot.vertex is not None and spot.vertex < len(points)
    if spot.name is None:
        return spot if there else None
    if not any(pick.visible for pick in drawing.picks if (pick.kind, pick.name) == (spot.kind, spot.name)):
        return None
    usable = state.mode in (LOOK, spot.kind) and drawing.under_way is None
    return spot if there and usable else replace(spot, piece=spot.piece if points else None, vertex=None)
