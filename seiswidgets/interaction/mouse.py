"""What a editor does when the pointer is pressed, moved or clicked twice."""

from dataclasses import replace
from functools import partial

import numpy as np

from seiswidgets.interaction.cutoff_handles import parted, slid, wall_of
from seiswidgets.interaction.drawing import FAULT, HORIZON, PickSelection
from seiswidgets.interaction.editor_state import BLOCK, LOOK, Drag
from seiswidgets.interaction.gestures import line_under, vertex_under

STILL = 3.0  # css pixels: a press that moves less is a click
CTRL = frozenset({"ctrl", "meta"})


def pressed(editor, event) -> bool:
    """Do what a press asks, and say whether it is consumed."""
    if event.button != 0 or not np.isfinite([*event.point, *event.pixel]).all():
        return False
    editor.change(cursor=None)
    mode, free = editor.state.mode, "shift" in event.modifiers
    if mode == BLOCK:
        _toggle_held(editor, event)
        return True
    if event.modifiers & CTRL:
        return _remove_under(editor, event) or mode != LOOK
    if not (free and mode != LOOK) and _take_hold(editor, event):
        return True
    if mode == LOOK:
        return _select_under(editor, event)
    editor.add(event.point, free=free)
    return True


def moved(editor, event) -> bool:
    """Drag what is held, if anything is, and say so."""
    drag = editor.state.drag
    if drag is None:
        return False
    far = np.hypot(*np.subtract(event.pixel, drag.pixel)) >= STILL
    if (far or drag.moves) and np.isfinite(event.point).all():
        drawing = _dragged(editor, drag, event)
        editor.change(drawing=drawing, selection=drag.target, drag=replace(drag, last=event.pixel, moves=True))
    return True


def released(editor, event) -> bool:
    """End a drag where the button goes up, which is farther on if moves were too quick; say whether there was one."""
    drag = editor.state.drag
    if not event.cancelled:
        if drag and event.pixel != drag.last:
            moved(editor, event)
        editor.settle()
    elif drag:
        editor.change(drawing=drag.before, selection=drag.selection, drag=None)
    elif editor.drawing is not editor.before_press:
        editor.undo()
    return drag is not None


def double_clicked(editor, event) -> bool:
    """Finish the line under way; say whether the double click is consumed."""
    if not np.isfinite([*event.point, *event.pixel]).all():
        return False
    mode = editor.state.mode
    if mode == BLOCK:
        editor.hold(event.point)
    elif mode != LOOK:
        editor.finish()
    return mode != LOOK or _piece_under(editor, event) is not None


def _dragged(editor, drag, event):
    free = "shift" in event.modifiers
    if drag.fault is not None and not free:
        return slid(drag.base, editor.view.section, drag.target, drag.fault, event.point)
    return drag.base.moved(drag.target, editor.placed(event.point, drag.target.kind, free=free))


def _toggle_held(editor, event):
    held = editor.drawing.fixed
    again = held is not None and vertex_under(event, [held], editor.projection.to_pixels)
    editor.hold(None if again else event.point)


def _remove_under(editor, event):
    target = _vertex_target(editor, event)
    if target is None:
        return False
    remove(editor, target)
    return True


def remove(editor, target) -> None:
    """Remove a vertex, and select the one before it; the only one of the line under way cancels that."""
    if target.name is None and len(editor.drawing.line(target)) == 1:
        editor.cancel()
        return
    drawing = editor.drawing.removed(target)
    editor.edit(drawing, replace(target, vertex=max(0, target.vertex - 1)))


def _take_hold(editor, event):
    """Take hold of a cut-off, a vertex, or a line, where a vertex is inserted; say whether there was one."""
    chosen = editor.state.selection
    vertex_first = editor.state.mode == LOOK and chosen is not None and chosen.kind == FAULT
    kinds = (_hold_vertex, _hold_cutoff) if vertex_first else (_hold_cutoff, _hold_vertex)
    return any(hold(editor, event) for hold in (*kinds, _hold_line))


def _hold_vertex(editor, event):
    target = _vertex_target(editor, event)
    if target is None:
        return False
    _hold(editor, event, target, editor.drawing)
    return True


def _hold_line(editor, event):
    if editor.drawing.draft:
        return False
    found = [
        (hit[2], replace(target, vertex=hit[0]), hit[1])
        for target, points in editor.editable()
        if (hit := line_under(event, points, editor.projection.to_pixels))
    ]
    if not found:
        return False
    _, target, point = min(found, key=lambda hit: hit[0])
    base = editor.drawing.inserted(target, point)
    _hold(editor, event, target, base)
    editor.change(drawing=base, selection=target)
    return True


def _hold_cutoff(editor, event):
    if editor.state.mode not in (LOOK, HORIZON) or editor.drawing.draft:
        return False
    mark = _cutoff_under(editor, event)
    if mark is None:
        return False
    base, target = parted(editor.drawing, editor.view.section, mark)
    _hold(editor, event, target, base, mark.fault)
    if [len(piece) for piece in base.pick(HORIZON, mark.horizon).pieces] != [
        len(piece) for piece in editor.drawing.pick(HORIZON, mark.horizon).pieces
    ]:  # until it moves, the piece has no vertex there
        editor.change(selection=PickSelection(HORIZON, mark.horizon))
    return True


def _hold(editor, event, target, base, fault=None):
    drag = Drag(target, editor.drawing, editor.state.selection, base, event.pixel, event.pixel, fault)
    editor.change(drag=drag, selection=target)


def _cutoff_under(editor, event):
    """The cut-off under a press; of the two at one place, that in the wall in which the pointer is."""
    marks = editor.cutoffs()
    away = [vertex_under(event, [mark.inside], editor.projection.to_pixels) for mark in marks]
    near = [(hit[1], mark) for hit, mark in zip(away, marks, strict=True) if hit]
    if not near:
        return None
    fault = min(near, key=lambda hit: hit[0])[1].fault
    wall = wall_of(editor.drawing, editor.view.section, fault, event.point)
    return min(near, key=lambda hit: (hit[1].fault != fault, hit[1].wall != wall, hit[0]))[1]


def _vertex_target(editor, event):
    """The nearest vertex that can be taken hold of, or None."""
    found = [
        (hit[1], replace(target, vertex=hit[0]))
        for target, points in editor.editable()
        if (hit := vertex_under(event, points, partial(editor.projection.vertex_pixels, is_fault=target.kind == FAULT)))
    ]
    return min(found, key=lambda hit: hit[0])[1] if found else None


def _select_under(editor, event):
    target = _piece_under(editor, event)
    if target:
        editor.change(selection=target)
    return target is not None


def _piece_under(editor, event):
    """The visible piece under a press, or None."""
    found = [
        (hit[2], PickSelection(pick.kind, pick.name, number))
        for pick in editor.drawing.picks
        if pick.visible
        for number, points in enumerate(pick.pieces)
        if (hit := line_under(event, points, editor.projection.to_pixels))
    ]
    return min(found, key=lambda hit: hit[0])[1] if found else None
