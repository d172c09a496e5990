"""What a picker does when the pointer is pressed, moved or clicked twice."""

from dataclasses import replace

import numpy as np

from seiswidgets.widgets.cutoffmarks import parted, slid, wall_of
from seiswidgets.widgets.drawing import FAULT, HORIZON, Spot
from seiswidgets.widgets.gestures import line_under, vertex_under
from seiswidgets.widgets.pickerstate import BLOCK, LOOK, Drag

STILL = 3.0  # css pixels: a press that moves less is a click
CTRL = frozenset({"ctrl", "meta"})


def pressed(picker, event) -> bool:
    """Do what a press asks, and say whether it is consumed."""
    if event.button != 0 or not np.isfinite([*event.point, *event.pixel]).all():
        return False
    picker.change(cursor=None)
    mode, free = picker.state.mode, "shift" in event.modifiers
    if mode == BLOCK:
        _toggle_held(picker, event)
        return True
    if event.modifiers & CTRL:
        return _remove_under(picker, event) or mode != LOOK
    if not (free and mode != LOOK) and _take_hold(picker, event):
        return True
    if mode == LOOK:
        return _select_under(picker, event)
    picker.add(event.point, free=free)
    return True


def moved(picker, event) -> bool:
    """Drag what is held, if anything is, and say so."""
    drag = picker.state.drag
    if drag is None:
        return False
    far = np.hypot(*np.subtract(event.pixel, drag.pixel)) >= STILL
    if (far or drag.moves) and np.isfinite(event.point).all():
        drawing = _dragged(picker, drag, event)
        picker.change(drawing=drawing, selection=drag.spot, drag=replace(drag, moves=True))
    return True


def double_clicked(picker, event) -> bool:
    """Finish the line under way; say whether the double click is consumed."""
    if not np.isfinite([*event.point, *event.pixel]).all():
        return False
    mode = picker.state.mode
    if mode == BLOCK:
        picker.hold(event.point)
    elif mode != LOOK:
        picker.finish()
    return mode != LOOK or _piece_under(picker, event) is not None


def _dragged(picker, drag, event):
    free = "shift" in event.modifiers
    if drag.fault is not None and not free:
        return slid(drag.base, picker.view.section, drag.spot, drag.fault, event.point)
    return drag.base.moved(drag.spot, picker.placed(event.point, drag.spot.kind, free=free))


def _toggle_held(picker, event):
    held = picker.drawing.fixed
    again = held is not None and vertex_under(event, [held], picker.to_pixels)
    picker.hold(None if again else event.point)


def _remove_under(picker, event):
    spot = _vertex_spot(picker, event)
    if spot is None:
        return False
    remove(picker, spot)
    return True


def remove(picker, spot) -> None:
    """Remove a vertex, and select the one before it; the only one of the line under way cancels that."""
    if spot.name is None and len(picker.drawing.line(spot)) == 1:
        picker.cancel()
        return
    drawing = picker.drawing.removed(spot)
    picker.edit(drawing, replace(spot, vertex=max(0, spot.vertex - 1)))


def _take_hold(picker, event):
    """Take hold of a cut-off, a vertex, or a line, where a vertex is inserted; say whether there was one."""
    chosen = picker.state.selection
    vertex_first = picker.state.mode == LOOK and chosen is not None and chosen.kind == FAULT
    kinds = (_hold_vertex, _hold_cutoff) if vertex_first else (_hold_cutoff, _hold_vertex)
    return any(hold(picker, event) for hold in (*kinds, _hold_line))


def _hold_vertex(picker, event):
    spot = _vertex_spot(picker, event)
    if spot is None:
        return False
    _hold(picker, event, spot, picker.drawing)
    return True


def _hold_line(picker, event):
    if picker.drawing.under_way:
        return False
    found = [
        (hit[2], replace(spot, vertex=hit[0]), hit[1])
        for spot, points in picker.editable()
        if (hit := line_under(event, points, picker.to_pixels))
    ]
    if not found:
        return False
    _, spot, point = min(found, key=lambda hit: hit[0])
    base = picker.drawing.inserted(spot, point)
    _hold(picker, event, spot, base)
    picker.change(drawing=base, selection=spot)
    return True


def _hold_cutoff(picker, event):
    if picker.state.mode not in (LOOK, HORIZON) or picker.drawing.under_way:
        return False
    mark = _cutoff_under(picker, event)
    if mark is None:
        return False
    base, spot = parted(picker.drawing, picker.view.section, mark)
    _hold(picker, event, spot, base, mark.fault)
    if [len(piece) for piece in base.pick(HORIZON, mark.horizon).pieces] != [
        len(piece) for piece in picker.drawing.pick(HORIZON, mark.horizon).pieces
    ]:  # until it moves, the piece has no vertex there
        picker.change(selection=Spot(HORIZON, mark.horizon))
    return True


def _hold(picker, event, spot, base, fault=None):
    drag = Drag(spot, picker.drawing, picker.state.selection, base, event.pixel, fault)
    picker.change(drag=drag, selection=spot)


def _cutoff_under(picker, event):
    """The cut-off under a press; of the two at one place, that in the wall in which the pointer is."""
    marks = picker.cutoffs()
    away = [vertex_under(event, [mark.point], picker.to_pixels) for mark in marks]
    near = [(hit[1], mark) for hit, mark in zip(away, marks, strict=True) if hit]
    if not near:
        return None
    fault = min(near, key=lambda hit: hit[0])[1].fault
    wall = wall_of(picker.drawing, picker.view.section, fault, event.point)
    return min(near, key=lambda hit: (hit[1].fault != fault, hit[1].wall != wall, hit[0]))[1]


def _vertex_spot(picker, event):
    """The nearest vertex that can be taken hold of, or None."""
    found = [
        (hit[1], replace(spot, vertex=hit[0]))
        for spot, points in picker.editable()
        if (hit := vertex_under(event, points, picker.to_pixels))
    ]
    return min(found, key=lambda hit: hit[0])[1] if found else None


def _select_under(picker, event):
    spot = _piece_under(picker, event)
    if spot:
        picker.change(selection=spot)
    return spot is not None


def _piece_under(picker, event):
    """The visible piece under a press, or None."""
    found = [
        (hit[2], Spot(pick.kind, pick.name, number))
        for pick in picker.drawing.picks
        if pick.visible
        for number, points in enumerate(pick.pieces)
        if (hit := line_under(event, points, picker.to_pixels))
    ]
    return min(found, key=lambda hit: hit[0])[1] if found else None
