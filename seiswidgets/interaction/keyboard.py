"""Transitions of the editor for keys; the table of keys is at the top of `editor`.

Each function returns the new state, or None if the key means nothing to the editor, so that the pane may use it.
"""

from dataclasses import replace

import numpy as np

from seiswidgets.interaction.drawing import FAULT, HORIZON, PickSelection
from seiswidgets.interaction.editor_state import BLOCK, LOOK, EditorState, Tools
from seiswidgets.interaction.gestures import Key
from seiswidgets.interaction.mouse import CTRL, abandon_drag

STRIDE = 8.0  # css pixels that the keyboard cursor moves at least
FAST = 10  # times as far with Shift
ARROWS = {"ArrowLeft": (-1, 0), "ArrowRight": (1, 0), "ArrowUp": (0, -1), "ArrowDown": (0, 1)}
MODE_KEYS = {"l": LOOK, "f": FAULT, "h": HORIZON, "b": BLOCK}


def press_key(state: EditorState, event: Key, tools: Tools) -> EditorState | None:
    """Do what a key asks."""
    if event.name == "Escape":
        return _escape(state)
    if "alt" in event.modifiers:
        return None
    if event.name in ARROWS:
        return _arrow(state, event, tools)
    if event.modifiers & CTRL:
        return None
    if event.name in ACTIONS:
        return ACTIONS[event.name](state, event, tools)
    mode = MODE_KEYS.get(event.name.lower())
    return None if mode is None else state.enter(mode)


def _escape(state):
    if state.drag:
        return abandon_drag(state)
    if state.drawing.draft:
        return state.cancel()
    if state.selection:
        return state.change(selection=None)
    return state.enter(LOOK) if state.mode != LOOK else None


def _arrow(state, event, tools):
    """Nudge the selected vertex, or move the keyboard cursor."""
    target, viewport = state.selection, tools.viewport
    direction = np.array(ARROWS[event.name])
    cell = np.array([viewport.section.dx, viewport.section.dz])
    fast = FAST if "shift" in event.modifiers else 1
    if target is not None and target.vertex is not None:
        point = tools.inside(state.drawing.line(target)[target.vertex] + direction * cell * fast)
        return state.draw(state.drawing.moved(target, point), target)
    if state.mode == LOOK:
        return None
    stride = 1 if event.modifiers & CTRL else fast * np.maximum(1, np.ceil(STRIDE * viewport.pixel / cell))
    return state.change(cursor=tools.inside(_cursor(state, tools) + direction * cell * stride))


def _cursor(state, tools):
    """Position of the keyboard cursor, or where it starts: the selected vertex, the last one, the window's middle."""
    section, target, draft = tools.viewport.section, state.selection, state.drawing.draft
    if state.cursor is not None:
        return state.cursor
    if target is not None and target.vertex is not None:
        return state.drawing.line(target)[target.vertex]
    if draft:
        return draft.points[-1]
    origin, cell = (section.x0, section.z0), (section.dx, section.dz)
    middle = (tools.viewport.to_section(tools.viewport.size / 2) - origin) / cell
    return tools.inside(np.round(middle) * cell + origin)


def _enter(state, event, tools):
    """Show the cursor, put a vertex at it, or finish the draft line."""
    draft = state.drawing.draft
    if state.mode == LOOK:
        return None
    if state.cursor is None and not draft:
        chosen = state.selection and replace(state.selection, piece=None, vertex=None)
        return state.change(cursor=_cursor(state, tools), selection=chosen)
    if draft and state.cursor in (None, draft.points[-1]):
        return state.finish()
    return _put(state, event, tools)


def _space(state, event, tools):
    return None if state.cursor is None else _put(state, event, tools)


def _put(state, event, tools):
    """Put a vertex, or the held point, at the keyboard cursor."""
    if state.mode == BLOCK:
        return state.hold(None if state.fixed == state.cursor else state.cursor)
    added = state.add(state.cursor, tools, event.projection, select=False)
    return added.change(cursor=added.drawing.draft.points[-1])


def _delete(state, event, tools):
    target, draft = state.selection, state.drawing.draft
    if target is not None and target.vertex is not None:
        return state.remove_vertex(target)
    if draft:
        removed = state.remove_vertex(PickSelection(draft.kind, None, 0, len(draft.points) - 1))
        return removed.change(selection=None) if removed.drawing.draft else removed
    if target is not None and target.piece is not None and state.mode in (LOOK, target.kind):
        chosen = None if state.mode == LOOK else PickSelection(target.kind, target.name)
        return state.draw(state.drawing.with_line(target, []), chosen)
    if target is not None and state.mode == LOOK:
        return state.draw(state.drawing.deleted(target.kind, target.name), target)
    return state.hold(None) if state.mode == BLOCK and state.fixed is not None else None


def _insert(state, event, tools):
    """Insert a vertex halfway from the selected one to the next, or to the one before if it is the last."""
    target = state.selection
    points = state.drawing.line(target) if target is not None and target.vertex is not None else ()
    if len(points) < 2:
        return None
    after = min(target.vertex + 1, len(points) - 1)
    new = replace(target, vertex=after)
    return state.draw(state.drawing.inserted(new, np.mean(points[after - 1 : after + 1], axis=0)), new)


def _select_vertex(state, step):
    """Select the vertex after (1) or before (-1) the selected one, of all that can be changed now."""
    targets = [
        replace(target, vertex=vertex) for target, points in state.editable_lines() for vertex in range(len(points))
    ]
    if not targets:
        return None
    chosen = state.selection
    index = targets.index(chosen) + step if chosen in targets else (0 if step > 0 else -1)
    return state.change(selection=targets[index % len(targets)], cursor=None)


ACTIONS = {
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
