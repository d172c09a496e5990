"""What a pen does when a key is pressed; the table of keys is at the top of `pen`."""

from dataclasses import replace

import numpy as np

from seiswidgets.widgets.picking.drawing import FAULT, HORIZON, Spot
from seiswidgets.widgets.picking.mouse import CTRL, remove
from seiswidgets.widgets.picking.penstate import BLOCK, LOOK

STRIDE = 8.0  # css pixels that the keyboard cursor moves at least
FAST = 10  # times as far with Shift
ARROWS = {"ArrowLeft": (-1, 0), "ArrowRight": (1, 0), "ArrowUp": (0, -1), "ArrowDown": (0, 1)}
MODE_KEYS = {"l": LOOK, "f": FAULT, "h": HORIZON, "b": BLOCK}


def key_pressed(pen, event) -> bool:
    """Do what a key asks, and say whether it is consumed."""
    if event.name == "Escape":
        return _escape(pen)
    pen.settle()
    if "alt" in event.modifiers:
        return False
    if event.name in ARROWS:
        return _arrow(pen, event)
    if event.modifiers & CTRL:
        return _history(pen, event)
    action = ACTIONS.get(event.name)
    if action:
        return action(pen)
    mode = MODE_KEYS.get(event.name.lower())
    if mode:
        pen.enter(mode)
    return mode is not None


def _history(pen, event):
    """Undo and redo; consumed even where there is nothing to, or the notebook would undo something of its own."""
    name = event.name.lower()
    if name == "y" or (name == "z" and "shift" in event.modifiers):
        pen.redo()
    elif name == "z":
        pen.undo()
    return name in ("y", "z")


def _escape(pen):
    state = pen.state
    if state.drag:
        pen.change(drawing=state.drag.before, selection=state.drag.selection, drag=None)
    elif state.drawing.under_way:
        pen.cancel()
    elif state.selection:
        pen.deselect()
    elif state.mode != LOOK:
        pen.enter(LOOK)
    else:
        return False
    return True


def _arrow(pen, event):
    spot, section = pen.state.selection, pen.view.section
    way, cell = np.array(ARROWS[event.name]), np.array([section.dx, section.dz])
    fast = FAST if "shift" in event.modifiers else 1
    if spot is not None and spot.vertex is not None:
        point = pen.drawing.line(spot)[spot.vertex]
        pen.edit(pen.drawing.moved(spot, pen.inside(point + way * cell * fast)), spot)
    elif pen.state.mode != LOOK:
        stride = 1 if event.modifiers & CTRL else fast * np.maximum(1, np.ceil(STRIDE * pen.view.pixel / cell))
        pen.change(cursor=pen.inside(_cursor(pen) + way * cell * stride))
    else:
        return False
    return True


def _cursor(pen):
    """Where the keyboard cursor is, or where it starts: the selected vertex, the last one, the window's middle."""
    state, section = pen.state, pen.view.section
    if state.cursor is not None:
        return state.cursor
    spot, line = state.selection, state.drawing.under_way
    if spot is not None and spot.vertex is not None:
        return state.drawing.line(spot)[spot.vertex]
    if line:
        return line.points[-1]
    origin, cell = (section.x0, section.z0), (section.dx, section.dz)
    middle = (pen.view.to_section(pen.view.size / 2) - origin) / cell
    return pen.inside(np.round(middle) * cell + origin)


def _enter(pen):
    state, line = pen.state, pen.drawing.under_way
    if state.mode == LOOK:
        return False
    if state.cursor is None and not line:
        chosen = state.selection and replace(state.selection, piece=None, vertex=None)
        pen.change(cursor=_cursor(pen), selection=chosen)
    elif line and state.cursor in (None, line.points[-1]):
        pen.finish()
    else:
        _put(pen)
    return True


def _space(pen):
    if pen.state.cursor is None:
        return False
    _put(pen)
    return True


def _put(pen):
    """Put a vertex, or the held point, at the keyboard cursor."""
    cursor = pen.state.cursor
    if pen.state.mode == BLOCK:
        pen.hold(None if pen.drawing.fixed == cursor else cursor)
        return
    pen.add(cursor, select=False)
    pen.change(cursor=pen.drawing.under_way.points[-1])


def _delete(pen):
    state = pen.state
    spot, line = state.selection, state.drawing.under_way
    if spot is not None and spot.vertex is not None:
        remove(pen, spot)
    elif line:
        remove(pen, Spot(line.kind, None, 0, len(line.points) - 1))
        if pen.drawing.under_way:
            pen.deselect()
    elif spot is not None and spot.piece is not None and state.mode in (LOOK, spot.kind):
        chosen = None if state.mode == LOOK else Spot(spot.kind, spot.name)
        pen.edit(state.drawing.with_line(spot, []), chosen)
    elif spot is not None and state.mode == LOOK:
        pen.delete(spot.kind, spot.name)
    elif state.mode == BLOCK and state.drawing.fixed is not None:
        pen.hold(None)
    else:
        return False
    return True


def _insert(pen):
    """Insert a vertex halfway from the selected one to the next; to the one before, if it is the last."""
    spot = pen.state.selection
    points = pen.drawing.line(spot) if spot is not None and spot.vertex is not None else ()
    if len(points) < 2:
        return False
    after = min(spot.vertex + 1, len(points) - 1)
    new = replace(spot, vertex=after)
    pen.edit(pen.drawing.inserted(new, np.mean(points[after - 1 : after + 1], axis=0)), new)
    return True


def _step(pen, way):
    """Select the vertex after or before the selected one, of all that can be changed now."""
    spots = [replace(spot, vertex=n) for spot, points in pen.editable() for n in range(len(points))]
    if not spots:
        return False
    chosen = pen.state.selection
    at = spots.index(chosen) + way if chosen in spots else (0 if way > 0 else -1)
    pen.change(selection=spots[at % len(spots)], cursor=None)
    return True


ACTIONS = {
    "Enter": _enter,
    " ": _space,
    "Delete": _delete,
    "Backspace": _delete,
    "Insert": _insert,
    "i": _insert,
    "I": _insert,
    "PageDown": lambda pen: _step(pen, 1),
    "PageUp": lambda pen: _step(pen, -1),
}
