"""Transitions of the editor for keys; the table of keys is at the top of `editor`.

Each function returns the new state, or None if the editor has no use for the key, so that the pane may use it.
"""

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from seiswidgets.geology.bodies import BODY
from seiswidgets.geology.picks import FAULT, HORIZON
from seiswidgets.interaction.drawing import PickSelection, Point
from seiswidgets.interaction.editor_state import BLOCK, LOOK, MOVE, EditorState, Tools
from seiswidgets.interaction.gestures import Key
from seiswidgets.interaction.mouse import CTRL, abandon_drag
from seiswidgets.interaction.piece_commands import COMMAND_KEYS
from seiswidgets.interaction.piece_moves import nudge_pieces, remove_chosen, slide_chosen, visible_pieces

STRIDE = 8.0  # css pixels that the keyboard cursor moves at least
FAST = 10  # factor on that with Shift
ARROWS = {"ArrowLeft": (-1, 0), "ArrowRight": (1, 0), "ArrowUp": (0, -1), "ArrowDown": (0, 1)}
MODE_KEYS = {"l": LOOK, "f": FAULT, "h": HORIZON, "s": BODY, "m": MOVE, "b": BLOCK}


def press_key(state: EditorState, event: Key, tools: Tools) -> EditorState | None:
    """Handle a key."""
    if event.name == "Escape":
        return _escape(state, tools)
    if "alt" in event.modifiers:
        return None
    if event.name in ARROWS:
        return (_move_chosen if state.mode == MOVE else _arrow)(state, event, tools)
    if event.modifiers & CTRL:
        return None
    if event.name in ACTIONS:
        return ACTIONS[event.name](state, event, tools)
    command = COMMAND_KEYS.get(event.name) or COMMAND_KEYS.get(event.name.lower())
    if command is not None:
        return None if state.selection is None or state.drawing.draft else command(state, tools)
    mode = MODE_KEYS.get(event.name.lower())
    return None if mode is None else state.enter(mode, tools)


def _escape(state: EditorState, tools: Tools) -> EditorState | None:
    if state.drag:
        return abandon_drag(state)
    if state.drawing.draft:
        return state.cancel()
    if state.selection:
        return state.change(selection=None)
    return state.enter(LOOK, tools) if state.mode != LOOK else None


def _arrow(state: EditorState, event: Key, tools: Tools) -> EditorState | None:
    """Nudge the selected vertex, or move the keyboard cursor."""
    target, viewport = _selected_vertex(state), tools.viewport
    direction = np.array(ARROWS[event.name])
    cell = np.array([viewport.section.dx, viewport.section.dz])
    fast = FAST if "shift" in event.modifiers else 1
    if target is not None:
        point = tools.inside(_vertex_point(state, target) + direction * cell * fast)
        return state.draw(state.drawing.with_vertex_moved(target, point), target)
    if state.mode == LOOK:
        return None
    stride = 1 if event.modifiers & CTRL else fast * np.maximum(1, np.ceil(STRIDE * viewport.pixel / cell))
    cursor = tools.inside(_cursor(state, tools) + direction * cell * stride)
    return state.change(cursor=cursor).with_preview(cursor, tools)


def _move_chosen(state: EditorState, event: Key, tools: Tools) -> EditorState | None:
    """Move the selected pieces by a trace or sample; with Ctrl, slide one along its fault, up or down."""
    direction, section = np.array(ARROWS[event.name]), tools.viewport.section
    fast = FAST if "shift" in event.modifiers else 1
    if event.modifiers & CTRL:
        return slide_chosen(state, fast * int(direction[1]), section)
    return nudge_pieces(state, fast * direction * (section.dx, section.dz), section)


def _cursor(state: EditorState, tools: Tools) -> Point:
    """Position of the keyboard cursor; at first the selected vertex, the draft's last one, or the window's middle."""
    section, target, draft = tools.viewport.section, _selected_vertex(state), state.drawing.draft
    if state.cursor is not None:
        return state.cursor
    if target is not None:
        return _vertex_point(state, target)
    if draft:
        return draft.points[-1]
    origin, cell = (section.x0, section.z0), (section.dx, section.dz)
    middle = (tools.viewport.to_section(tools.viewport.size / 2) - origin) / cell
    return tools.inside(np.round(middle) * cell + origin)


def _enter(state: EditorState, event: Key, tools: Tools) -> EditorState | None:
    """Show the cursor, put a vertex at it, or finish the draft line."""
    draft = state.drawing.draft
    if state.mode in (LOOK, MOVE):
        return None
    if state.cursor is None and not draft:
        chosen = state.selection and replace(state.selection, piece=None, vertex=None)
        return state.change(cursor=_cursor(state, tools), selection=chosen)
    if draft and state.cursor in (None, draft.points[-1]):
        return state.finish(tools)
    return _put(state, event, tools)


def _space(state: EditorState, event: Key, tools: Tools) -> EditorState | None:
    return None if state.cursor is None else _put(state, event, tools)


def _put(state: EditorState, event: Key, tools: Tools) -> EditorState:
    """Put a vertex, or the held point, with Shift a pin, at the keyboard cursor."""
    cursor = _cursor(state, tools)
    if state.mode == BLOCK and ("shift" in event.modifiers or cursor in state.pins):
        return state.toggle_pin(cursor)
    if state.mode == BLOCK:
        return state.hold(None if state.fixed == cursor else cursor)
    added = state.add(cursor, tools, event.projection, select=False)
    return added.change(cursor=added.drawing.draft.points[-1] if added.drawing.draft else cursor)


def _delete(state: EditorState, event: Key, tools: Tools) -> EditorState | None:
    vertex, draft_end = _selected_vertex(state), state.drawing.draft_end
    if state.mode == MOVE or state.others:
        return remove_chosen(state)
    if vertex is not None:
        return state.remove_vertex(vertex)
    if draft_end is not None:
        removed = state.remove_vertex(draft_end)
        return removed.change(selection=None) if removed.drawing.draft else removed
    if state.mode == BLOCK and state.fixed is not None:
        return state.hold(None)
    return _delete_selected(state)


def _delete_selected(state: EditorState) -> EditorState | None:
    """Delete the selected piece, or in look mode the selected pick."""
    target = state.selection
    if target is None or target.name is None or state.mode not in (LOOK, target.kind):
        return None
    if target.piece is not None:
        chosen = None if state.mode == LOOK else PickSelection(target.kind, target.name)
        return state.draw(state.drawing.with_line(target, []), chosen)
    return state.draw(state.drawing.without_pick(target.kind, target.name)) if state.mode == LOOK else None


def _insert(state: EditorState, event: Key, tools: Tools) -> EditorState | None:
    """Insert a vertex halfway from the selected one to the next, or to the one before if it is the last."""
    target = _selected_vertex(state)
    points = state.drawing.line(target) if target is not None else ()
    if target is None or len(points) < 2:
        return None
    after = min((target.vertex or 0) + 1, len(points) - 1)
    new = replace(target, vertex=after)
    return state.draw(state.drawing.with_vertex_inserted(new, np.mean(points[after - 1 : after + 1], axis=0)), new)


def _selected_vertex(state: EditorState) -> PickSelection | None:
    """Return the selection if it is a vertex."""
    return state.selection if state.selection is not None and state.selection.vertex is not None else None


def _vertex_point(state: EditorState, target: PickSelection) -> Point:
    return state.drawing.line(target)[target.vertex or 0]


def _select_vertex(state: EditorState, step: int) -> EditorState | None:
    """Select the next (``step`` 1) or previous (-1) of the vertices that can be changed now, or of the pieces."""
    targets = [
        replace(target, vertex=vertex) for target, points in state.editable_lines() for vertex in range(len(points))
    ]
    if state.mode == MOVE:
        targets = [target for target, _ in visible_pieces(state)]
    if not targets:
        return None
    chosen = state.selection
    index = targets.index(chosen) + step if chosen in targets else (0 if step > 0 else -1)
    return state.change(selection=targets[index % len(targets)], cursor=None)


ACTIONS: dict[str, Callable[[EditorState, Key, Tools], EditorState | None]] = {
    "Enter": _enter,
    " ": _space,
    "Delete": _delete,
    "Backspace": _delete,
    "Insert": _insert,
    "i": _insert,
    "I": _insert,
    "PageDown": lambda state, event, tools: _select_vertex(state, 1),
    "PageUp": lambda state, event, tools: _select_vertex(state, -1),
}
