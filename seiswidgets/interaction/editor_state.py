"""All that a editor shows, as one frozen value."""

from dataclasses import dataclass, field, replace

from seiswidgets.interaction.drawing import FAULT, HORIZON, Drawing, PickSelection, Point

LOOK, BLOCK = "look", "block"
MODES = (LOOK, FAULT, HORIZON, BLOCK)


@dataclass(frozen=True)
class Drag:
    """A vertex held by the pointer.

    Attributes
    ----------
    target : PickSelection
        The vertex, in ``base``.
    before : Drawing
    selection : PickSelection or None
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

    target: PickSelection
    before: Drawing
    selection: PickSelection | None
    base: Drawing
    pixel: tuple[float, float]
    last: tuple[float, float]
    fault: str | None = None
    moves: bool = False


@dataclass(frozen=True)
class EditorState:
    """All that a editor shows.

    Attributes
    ----------
    mode : {"look", "fault", "horizon", "block"}
        That of the line under way, if there is one.
    drawing : Drawing
    selection : PickSelection or None
        A pick, a piece of it, or one vertex of that or of the line under way.
    cursor : (x, z) or None
        The keyboard's; none in look mode.
    drag : Drag or None
    """

    mode: str = LOOK
    drawing: Drawing = field(default_factory=Drawing)
    selection: PickSelection | None = None
    cursor: Point | None = None
    drag: Drag | None = None


def known(state: EditorState) -> PickSelection | None:
    """What is selected and there: the piece or pick where the vertex cannot be changed now, None where all is gone."""
    target, drawing = state.selection, state.drawing
    if target is None:
        return None
    points = drawing.line(target)
    there = target.vertex is not None and target.vertex < len(points)
    if target.name is None:
        return target if there else None
    if not any(pick.visible for pick in drawing.picks if (pick.kind, pick.name) == (target.kind, target.name)):
        return None
    usable = state.mode in (LOOK, target.kind) and drawing.draft is None
    return target if there and usable else replace(target, piece=target.piece if points else None, vertex=None)
