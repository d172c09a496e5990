"""What a picker does when a key is pressed; the table of keys is at the top of `picker`."""

from dataclasses import replace

import numpy as np

from seiswidgets.widgets.drawing import FAULT, HORIZON, Spot
from seiswidgets.widgets.mouse import CTRL, remove
from seiswidgets.widgets.pickerstate import BLOCK, LOOK

STRIDE = 8.0  # css pixels that the keyboard cursor moves at least
FAST = 10  # times as far with Shift
ARROWS = {"ArrowLeft": (-1, 0), "ArrowRight": (1, 0), "ArrowUp": (0, -1), "ArrowDown": (0, 1)}
MODE_KEYS = {"l": LOOK, "f": FAULT, "h": HORIZON, "b": BLOCK}


def key_pressed(picker, event) -> bool:
    """Do what a key asks, and say whether it is consumed."""
    if event.name == "Escape":
        return _escape(picker)
    picker.settle()
    if "alt" in event.modifiers:
        return False
    if event.name in ARROWS:
        return _arrow(picker, event)
    if event.modifiers & CTRL:
        return _history(picker, event)
    action = ACTIONS.get(event.name)
    if action:
        return action(picker)
    mode = MODE_KEYS.get(event.name.lower())
    if mode:
        picker.enter(mode)
    return mode is not None


def _history(picker, event):
    """Undo and redo; consumed even where there is nothing to, or the notebook would undo something of its own."""
    name = event.name.lower()
    if name == "y" or (name == "z" and "shift" in event.modifiers):
        picker.redo()
    elif name == "z":
        picker.undo()
    return name in ("y", "z")


def _escape(picker):
    state = picker.state
    if state.drag:
        picker.change(drawing=state.drag.before, selection=state.drag.selection, drag=None)
    elif state.drawing.under_way:
        picker.cancel()
    elif state.selection:
        picker.deselect()
    elif state.mode != LOOK:
        picker.enter(LOOK)
    else:
        return False
    return True


def _arrow(picker, event):
    spot, section = picker.state.selection, picker.view.section
    way, cell = np.array(ARROWS[event.name]), np.array([section.dx, section.dz])
    fast = FAST if "shift" in event.modifiers else 1
    if spot is not None and spot.vertex is not None:
        point = picker.drawing.line(spot)[spot.vertex]
        picker.edit(picker.drawing.moved(spot, picker.inside(point + way * cell * fast)), spot)
    elif picker.state.mode != LOOK:
        stride = 1 if event.modifiers & CTRL else fast * np.maximum(1, np.ceil(STRIDE * picker.view.pixel / cell))
        picker.change(cursor=picker.inside(_cursor(picker) + way * cell * stride))
    else:
        return False
    return True


def _cursor(picker):
    """Where the keyboard cursor is, or where it starts: the selected vertex, the last one, the window's middle."""
    state, section = picker.state, picker.view.section
    if state.cursor is not None:
        return state.cursor
    spot, line = state.selection, state.drawing.under_way
    if spot is not None and spot.vertex is not None:
        return state.drawing.line(spot)[spot.vertex]
    if line:
        return line.points[-1]
    origin, cell = (section.x0, section.z0), (section.dx, section.dz)
    middle = (picker.view.to_section(picker.view.size / 2) - origin) / cell
    return picker.inside(np.round(middle) * cell + origin)


def _enter(picker):
    state, line = picker.state, picker.drawing.under_way
    if state.mode == LOOK:
        return False
    if state.cursor is None and not line:
        chosen = state.selection and replace(state.selection, piece=None, vertex=None)
        picker.change(cursor=_cursor(picker), selection=chosen)
    elif line and state.cursor in (None, line.points[-1]):
        picker.finish()
    else:
        _put(picker)
    return True


def _space(picker):
    if picker.state.cursor is None:
        return False
    _put(picker)
    return True


def _put(picker):
    """Put a vertex, or the held point, at the keyboard cursor."""
    cursor = picker.state.cursor
    if picker.state.mode == BLOCK:
        picker.hold(None if picker.drawing.fixed == cursor else cursor)
        return
    picker.add(cursor, select=False)
    picker.change(cursor=picker.drawing.under_way.points[-1])


def _delete(picker):
    state = picker.state
    spot, line = state.selection, state.drawing.under_way
    if spot is not None and spot.vertex is not None:
        remove(picker, spot)
    elif line:
        remove(picker, Spot(line.kind, None, 0, len(line.points) - 1))
        if picker.drawing.under_way:
            picker.deselect()
    elif spot is not None and spot.piece is not None and state.mode in (LOOK, spot.kind):
        chosen = None if state.mode == LOOK else Spot(spot.kind, spot.name)
        picker.edit(state.drawing.with_line(spot, []), chosen)
    elif spot is not None and state.mode == LOOK:
        picker.delete(spot.kind, spot.name)
    elif state.mode == BLOCK and state.drawing.fixed is not None:
        picker.hold(None)
    else:
        return False
    return True


def _insert(picker):
    """Insert a vertex halfway from the selected one to the next; to the one before, if it is the last."""
    spot = picker.state.selection
    points = picker.drawing.line(spot) if spot is not None and spot.vertex is not None else ()
    if len(points) < 2:
        return False
    after = min(spot.vertex + 1, len(points) - 1)
    new = replace(spot, vertex=after)
    picker.edit(picker.drawing.inserted(new, np.mean(points[after - 1 : after + 1], axis=0)), new)
    return True


def _step(picker, way):
    """Select the vertex after or before the selected one, of all that can be changed now."""
    spots = [replace(spot, vertex=n) for spot, points in picker.editable() for n in range(len(points))]
    if not spots:
        return False
    chosen = picker.state.selection
    at = spots.index(chosen) + way if chosen in spots else (0 if way > 0 else -1)
    picker.change(selection=spots[at % len(spots)], cursor=None)
    return True


ACTIONS = {
    "Enter": _enter,
    " ": _space,
    "Delete": _delete,
    "Backspace": _delete,
    "Insert": _insert,
    "i": _insert,
    "I": _insert,
    "PageDown": lambda picker: _step(picker, 1),
    "PageUp": lambda picker: _step(picker, -1),
}
