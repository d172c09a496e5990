"""Commands on selected pieces, for keys and the context menu: each a transition of the editor's state."""

from collections.abc import Callable
from dataclasses import replace

from seiswidgets.errors import PickError
from seiswidgets.geology.bodies import BODY
from seiswidgets.geology.picks import HORIZON
from seiswidgets.interaction.drawing import Drawing, PickSelection
from seiswidgets.interaction.editor_state import MOVE, EditorState, Tools
from seiswidgets.interaction.piece_ends import ENDS
from seiswidgets.interaction.piece_moves import name_pieces, remove_chosen
from seiswidgets.interaction.pieces import (
    copy_horizon,
    extend_piece,
    join_pieces,
    reverse_piece,
    split_piece,
)

COPY_STEP = 40.0  # css pixels from a horizon to its copy

Command = Callable[[EditorState, Tools], EditorState]


def begin_move(state: EditorState, tools: Tools) -> EditorState:
    """Change to the mode Move, with the same selection."""
    return state.enter(MOVE, tools).change(selection=state.selection)


def delete(state: EditorState, tools: Tools) -> EditorState:
    """Delete the selected pieces."""
    return remove_chosen(state) or state


def copy_up(state: EditorState, tools: Tools) -> EditorState:
    """Copy the selected horizon upwards, and select the copy, ready to be moved."""
    return _copy(state, tools, -1)


def copy_down(state: EditorState, tools: Tools) -> EditorState:
    """Copy the selected horizon downwards, and select the copy, ready to be moved."""
    return _copy(state, tools, 1)


def _copy(state: EditorState, tools: Tools, sign: int) -> EditorState:
    target = state.selection
    if target is None or target.kind != HORIZON or target.name is None:
        raise PickError("select a horizon to copy it")
    step = sign * COPY_STEP * float(tools.viewport.pixel[1])
    drawing, new = copy_horizon(state.drawing, tools.viewport.section, target.name, step)
    action = f"copy {target.name} {'down' if sign > 0 else 'up'}"
    return state.enter(MOVE, tools).draw(drawing, PickSelection(HORIZON, new), action)


def join(state: EditorState, tools: Tools) -> EditorState:
    """Join the selected pieces; a single piece of a horizon to the nearest other one."""
    pieces = state.chosen_pieces
    drawing, joined = join_pieces(state.drawing, tools.viewport.section, pieces)
    return state.draw(drawing, joined, f"join pieces of {joined.name}")


def split(state: EditorState, tools: Tools) -> EditorState:
    """Split a line at the selected vertex."""
    target = state.selection
    if target is None or target.vertex is None or target.name is None:
        raise PickError("select a vertex between the ends of a line to split it there")
    drawing, part = split_piece(state.drawing, target)
    return state.draw(drawing, part, f"split {target.name}")


def reverse(state: EditorState, tools: Tools) -> EditorState:
    """Turn the selected lines round."""
    return _for_each(state, "reverse", reverse_piece)


def extend(state: EditorState, tools: Tools) -> EditorState:
    """Extend the selected lines, or the selected end of one, to the first fault or the border ahead."""
    met: list[str] = []
    target = state.selection
    last = len(state.drawing.line(target)) - 1 if target else -1
    ends = {0: (0,), last: (-1,)}.get(target.vertex, ENDS) if target and target.vertex is not None else ENDS

    def extended(drawing: Drawing, piece: PickSelection) -> Drawing:
        if piece.kind == BODY:
            return drawing
        drawing, names = extend_piece(drawing, tools.viewport.section, piece, ends)
        met.extend(names)
        return drawing

    after = _for_each(state, "extend", extended)
    if not met:
        raise PickError("the selected ends lie on faults or on the border already")
    return after.change(action=f"{after.action} to {', '.join(dict.fromkeys(met))}")


def _for_each(state: EditorState, verb: str, edit: Callable[[Drawing, PickSelection], Drawing]) -> EditorState:
    """Edit each of the selected pieces, none of which goes; the selection stays, without its vertex."""
    pieces, drawing = state.chosen_pieces, state.drawing
    if not pieces:
        raise PickError(f"select a line to {verb} it")
    for piece in pieces:
        drawing = edit(drawing, piece)
    selection = state.selection and replace(state.selection, vertex=None)
    action = f"{verb} {name_pieces(state.drawing, pieces)}"
    return state.draw(drawing, selection, action).change(others=state.others, action=action)


COMMAND_KEYS: dict[str, Command] = {
    "c": copy_down,
    "C": copy_up,
    "j": join,
    "x": split,
    "r": reverse,
    "e": extend,
}
