"""The effect of a click or a drag at the pointer, in words: the editor's own transition, described."""

import numpy as np

from seiswidgets.geology.bodies import BODY
from seiswidgets.geology.picks import FAULT, HORIZON
from seiswidgets.interaction.drawing import PickSelection
from seiswidgets.interaction.editor_state import BLOCK, LOOK, MOVE, EditorState, Tools
from seiswidgets.interaction.gestures import Move, Press
from seiswidgets.interaction.mouse import press
from seiswidgets.interaction.piece_moves import name_pieces

PAN = "Drag to pan, turn the wheel to zoom"
HELP = "? shows all gestures and keys"


def click_hint(state: EditorState, pointer: Move, tools: Tools) -> str:
    """Describe what a click, or a drag from here, does; "" during a drag."""
    if state.drag:
        return ""
    event = Press(pointer.point, pointer.pixel, pointer.projection, modifiers=pointer.modifiers)
    if not np.isfinite(pointer.point).all() and state.mode != MOVE:
        return f"No rock here. {PAN}."
    after = press(state, event, tools)
    return f"{_effect(state, after)}. {HELP}." if after is not None else f"{PAN}. {HELP}."


def _effect(before: EditorState, after: EditorState) -> str:
    if after.drag:
        return _grabbed(before, after)
    if before.mode == BLOCK and after.pins != before.pins:
        return "Click to pin this point" if len(after.pins) > len(before.pins) else "Click to release this pin"
    if before.mode == BLOCK:
        return "Click to release the block" if after.fixed is None else "Click to hold this block where it is"
    if before.mode in (LOOK, MOVE):
        return f"Click to select {after.selection.name}" if after.selection else PAN
    return _drawn(before, after)


def _grabbed(before: EditorState, after: EditorState) -> str:
    """Describe the vertex, cut-off or line that a press takes hold of."""
    drag = after.drag
    if drag is None:
        return PAN
    if drag.target is None:
        return "Drag a rectangle around pieces to select them; drag a piece to move it, its cut-off to slide it"
    name = _name(drag.target)
    if drag.pieces and drag.fault is not None:
        return f"Drag to slide this piece of {name} along {drag.fault}"
    if drag.pieces:
        return f"Drag to move {name_pieces(after.drawing, drag.pieces)}; Shift+click selects several"
    if drag.fault is not None:
        return f"Drag to move the cut-off of {name} along {drag.fault}"
    if drag.base != before.drawing:
        return f"Click to insert a vertex into {name}, drag to place it"
    return f"Drag to move this vertex of {name}; Ctrl+click removes it"


def _drawn(before: EditorState, after: EditorState) -> str:
    """Describe what a press in fault, horizon or body mode draws or removes."""
    draft = after.drawing.draft
    if before.drawing.draft and draft:
        return "Click to add a vertex; double click or Enter finishes the line"
    if draft and draft.name:
        return f"Click to begin another piece of {draft.name}"
    if draft:
        return f"Click to begin a {draft.kind}"
    return "Click to remove this vertex" if after.drawing != before.drawing else PAN


def _name(target: PickSelection) -> str:
    return target.name or {FAULT: "the new fault", HORIZON: "the new horizon", BODY: "the new body"}[target.kind]
