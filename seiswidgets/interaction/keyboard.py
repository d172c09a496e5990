"""What a editor does when a key is pressed; the table of keys is at the top of `editor`."""

from dataclasses import replace

import numpy as np

from seiswidgets.interaction.drawing import FAULT, HORIZON, PickSelection
from seiswidgets.interaction.editor_state import BLOCK, LOOK
from seiswidgets.interaction.mouse import CTRL, remove

STRIDE = 8.0  # css pixels that the keyboard cursor moves at least
FAST = 10  # times as far with Shift
ARROWS = {"ArrowLeft": (-1, 0), "ArrowRight": (1, 0), "ArrowUp": (0, -1), "ArrowDown": (0, 1)}
MODE_KEYS = {"l": LOOK, "f": FAULT, "h": HORIZON, "b": BLOCK}


def key_pressed(editor, event) -> bool:
    """Do what a key asks, and say whether it is consumed."""
    if event.name == "Escape":
        return _escape(editor)
    editor.settle()
    if "alt" in event.modifiers:
        return False
    if event.name in ARROWS:
        return _arrow(editor, event)
    if event.modifiers & CTRL:
        return _history(editor, event)
    action = ACTIONS.get(event.name)
    if action:
        return action(editor)
    mode = MODE_KEYS.get(event.name.lower())
    if mode:
        editor.enter(mode)
    return mode is not None


def _history(editor, event):
    """Undo and redo; consumed even where there is nothing to, or the notebook would undo something of its own."""
    name = event.name.lower()
    if name == "y" or (name == "z" and "shift" in event.modifiers):
        editor.redo()
    elif name == "z":
        editor.undo()
    return name in ("y", "z")


def _escape(editor):
    state = editor.state
    if state.drag:
        editor.change(drawing=state.drag.before, selection=state.drag.selection, drag=None)
    elif state.drawing.draft:
        editor.cancel()
    elif state.selection:
        editor.deselect()
    elif state.mode != LOOK:
        editor.enter(LOOK)
    else:
        return False
    return True


def _arrow(editor, event):
    target, section = editor.state.selection, editor.view.section
    way, cell = np.array(ARROWS[event.name]), np.array([section.dx, section.dz])
    fast = FAST if "shift" in event.modifiers else 1
    if target is not None and target.vertex is not None:
        point = editor.drawing.line(target)[target.vertex]
        editor.edit(editor.drawing.moved(target, editor.inside(point + way * cell * fast)), target)
    elif editor.state.mode != LOOK:
        stride = 1 if event.modifiers & CTRL else fast * np.maximum(1, np.ceil(STRIDE * editor.view.pixel / cell))
        editor.change(cursor=editor.inside(_cursor(editor) + way * cell * stride))
    else:
        return False
    return True


def _cursor(editor):
    """Where the keyboard cursor is, or where it starts: the selected vertex, the last one, the window's middle."""
    state, section = editor.state, editor.view.section
    if state.cursor is not None:
        return state.cursor
    target, line = state.selection, state.drawing.draft
    if target is not None and target.vertex is not None:
        return state.drawing.line(target)[target.vertex]
    if line:
        return line.points[-1]
    origin, cell = (section.x0, section.z0), (section.dx, section.dz)
    middle = (editor.view.to_section(editor.view.size / 2) - origin) / cell
    return editor.inside(np.round(middle) * cell + origin)


def _enter(editor):
    state, line = editor.state, editor.drawing.draft
    if state.mode == LOOK:
        return False
    if state.cursor is None and not line:
        chosen = state.selection and replace(state.selection, piece=None, vertex=None)
        editor.change(cursor=_cursor(editor), selection=chosen)
    elif line and state.cursor in (None, line.points[-1]):
        editor.finish()
    else:
        _put(editor)
    return True


def _space(editor):
    if editor.state.cursor is None:
        return False
    _put(editor)
    return True


def _put(editor):
    """Put a vertex, or the held point, at the keyboard cursor."""
    cursor = editor.state.cursor
    if editor.state.mode == BLOCK:
        editor.hold(None if editor.drawing.fixed == cursor else cursor)
        return
    editor.add(cursor, select=False)
    editor.change(cursor=editor.drawing.draft.points[-1])


def _delete(editor):
    state = editor.state
    target, line = state.selection, state.drawing.draft
    if target is not None and target.vertex is not None:
        remove(editor, target)
    elif line:
        remove(editor, PickSelection(line.kind, None, 0, len(line.points) - 1))
        if editor.drawing.draft:
            editor.deselect()
    elif target is not None and target.piece is not None and state.mode in (LOOK, target.kind):
        chosen = None if state.mode == LOOK else PickSelection(target.kind, target.name)
        editor.edit(state.drawing.with_line(target, []), chosen)
    elif target is not None and state.mode == LOOK:
        editor.delete(target.kind, target.name)
    elif state.mode == BLOCK and state.drawing.fixed is not None:
        editor.hold(None)
    else:
        return False
    return True


def _insert(editor):
    """Insert a vertex halfway from the selected one to the next; to the one before, if it is the last."""
    target = editor.state.selection
    points = editor.drawing.line(target) if target is not None and target.vertex is not None else ()
    if len(points) < 2:
        return False
    after = min(target.vertex + 1, len(points) - 1)
    new = replace(target, vertex=after)
    editor.edit(editor.drawing.inserted(new, np.mean(points[after - 1 : after + 1], axis=0)), new)
    return True


def _step(editor, way):
    """Select the vertex after or before the selected one, of all that can be changed now."""
    targets = [replace(target, vertex=n) for target, points in editor.editable() for n in range(len(points))]
    if not targets:
        return False
    chosen = editor.state.selection
    at = targets.index(chosen) + way if chosen in targets else (0 if way > 0 else -1)
    editor.change(selection=targets[at % len(targets)], cursor=None)
    return True


ACTIONS = {
    "Enter": _enter,
    " ": _space,
    "Delete": _delete,
    "Backspace": _delete,
    "Insert": _insert,
    "i": _insert,
    "I": _insert,
    "PageDown": lambda editor: _step(editor, 1),
    "PageUp": lambda editor: _step(editor, -1),
}
