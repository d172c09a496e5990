"""What a pen does when the pointer is pressed, moved or clicked twice."""

from dataclasses import replace
from functools import partial

import numpy as np

from seiswidgets.widgets.panes.gestures import line_under, vertex_under
from seiswidgets.widgets.picking.cutoffmarks import parted, slid, wall_of
from seiswidgets.widgets.picking.drawing import FAULT, HORIZON, Spot
from seiswidgets.widgets.picking.penstate import BLOCK, LOOK, Drag

STILL = 3.0  # css pixels: a press that moves less is a click
CTRL = frozenset({"ctrl", "meta"})


def pressed(pen, event) -> bool:
    """Do what a press asks, and say whether it is consumed."""
    if event.button != 0 or not np.isfinite([*event.point, *event.pixel]).all():
        return False
    pen.change(cursor=None)
    mode, free = pen.state.mode, "shift" in event.modifiers
    if mode == BLOCK:
        _toggle_held(pen, event)
        return True
    if event.modifiers & CTRL:
        return _remove_under(pen, event) or mode != LOOK
    if not (free and mode != LOOK) and _take_hold(pen, event):
        return True
    if mode == LOOK:
        return _select_under(pen, event)
    pen.add(event.point, free=free)
    return True


def moved(pen, event) -> bool:
    """Drag what is held, if anything is, and say so."""
    drag = pen.state.drag
    if drag is None:
        return False
    far = np.hypot(*np.subtract(event.pixel, drag.pixel)) >= STILL
    if (far or drag.moves) and np.isfinite(event.point).all():
        drawing = _dragged(pen, drag, event)
        pen.change(drawing=drawing, selection=drag.spot, drag=replace(drag, last=event.pixel, moves=True))
    return True


def released(pen, event) -> bool:
    """End a drag where the button goes up, which is farther on if moves were too quick; say whether there was one."""
    drag = pen.state.drag
    if not event.cancelled:
        if drag and event.pixel != drag.last:
            moved(pen, event)
        pen.settle()
    elif drag:
        pen.change(drawing=drag.before, selection=drag.selection, drag=None)
    elif pen.drawing is not pen.before_press:
        pen.undo()
    return drag is not None


def double_clicked(pen, event) -> bool:
    """Finish the line under way; say whether the double click is consumed."""
    if not np.isfinite([*event.point, *event.pixel]).all():
        return False
    mode = pen.state.mode
    if mode == BLOCK:
        pen.hold(event.point)
    elif mode != LOOK:
        pen.finish()
    return mode != LOOK or _piece_under(pen, event) is not None


def _dragged(pen, drag, event):
    free = "shift" in event.modifiers
    if drag.fault is not None and not free:
        return slid(drag.base, pen.view.section, drag.spot, drag.fault, event.point)
    return drag.base.moved(drag.spot, pen.placed(event.point, drag.spot.kind, free=free))


def _toggle_held(pen, event):
    held = pen.drawing.fixed
    again = held is not None and vertex_under(event, [held], pen.sight.to_pixels)
    pen.hold(None if again else event.point)


def _remove_under(pen, event):
    spot = _vertex_spot(pen, event)
    if spot is None:
        return False
    remove(pen, spot)
    return True


def remove(pen, spot) -> None:
    """Remove a vertex, and select the one before it; the only one of the line under way cancels that."""
    if spot.name is None and len(pen.drawing.line(spot)) == 1:
        pen.cancel()
        return
    drawing = pen.drawing.removed(spot)
    pen.edit(drawing, replace(spot, vertex=max(0, spot.vertex - 1)))


def _take_hold(pen, event):
    """Take hold of a cut-off, a vertex, or a line, where a vertex is inserted; say whether there was one."""
    chosen = pen.state.selection
    vertex_first = pen.state.mode == LOOK and chosen is not None and chosen.kind == FAULT
    kinds = (_hold_vertex, _hold_cutoff) if vertex_first else (_hold_cutoff, _hold_vertex)
    return any(hold(pen, event) for hold in (*kinds, _hold_line))


def _hold_vertex(pen, event):
    spot = _vertex_spot(pen, event)
    if spot is None:
        return False
    _hold(pen, event, spot, pen.drawing)
    return True


def _hold_line(pen, event):
    if pen.drawing.under_way:
        return False
    found = [
        (hit[2], replace(spot, vertex=hit[0]), hit[1])
        for spot, points in pen.editable()
        if (hit := line_under(event, points, pen.sight.to_pixels))
    ]
    if not found:
        return False
    _, spot, point = min(found, key=lambda hit: hit[0])
    base = pen.drawing.inserted(spot, point)
    _hold(pen, event, spot, base)
    pen.change(drawing=base, selection=spot)
    return True


def _hold_cutoff(pen, event):
    if pen.state.mode not in (LOOK, HORIZON) or pen.drawing.under_way:
        return False
    mark = _cutoff_under(pen, event)
    if mark is None:
        return False
    base, spot = parted(pen.drawing, pen.view.section, mark)
    _hold(pen, event, spot, base, mark.fault)
    if [len(piece) for piece in base.pick(HORIZON, mark.horizon).pieces] != [
        len(piece) for piece in pen.drawing.pick(HORIZON, mark.horizon).pieces
    ]:  # until it moves, the piece has no vertex there
        pen.change(selection=Spot(HORIZON, mark.horizon))
    return True


def _hold(pen, event, spot, base, fault=None):
    drag = Drag(spot, pen.drawing, pen.state.selection, base, event.pixel, event.pixel, fault)
    pen.change(drag=drag, selection=spot)


def _cutoff_under(pen, event):
    """The cut-off under a press; of the two at one place, that in the wall in which the pointer is."""
    marks = pen.cutoffs()
    away = [vertex_under(event, [mark.inside], pen.sight.to_pixels) for mark in marks]
    near = [(hit[1], mark) for hit, mark in zip(away, marks, strict=True) if hit]
    if not near:
        return None
    fault = min(near, key=lambda hit: hit[0])[1].fault
    wall = wall_of(pen.drawing, pen.view.section, fault, event.point)
    return min(near, key=lambda hit: (hit[1].fault != fault, hit[1].wall != wall, hit[0]))[1]


def _vertex_spot(pen, event):
    """The nearest vertex that can be taken hold of, or None."""
    found = [
        (hit[1], replace(spot, vertex=hit[0]))
        for spot, points in pen.editable()
        if (hit := vertex_under(event, points, partial(pen.sight.vertex_pixels, is_fault=spot.kind == FAULT)))
    ]
    return min(found, key=lambda hit: hit[0])[1] if found else None


def _select_under(pen, event):
    spot = _piece_under(pen, event)
    if spot:
        pen.change(selection=spot)
    return spot is not None


def _piece_under(pen, event):
    """The visible piece under a press, or None."""
    found = [
        (hit[2], Spot(pick.kind, pick.name, number))
        for pick in pen.drawing.picks
        if pick.visible
        for number, points in enumerate(pick.pieces)
        if (hit := line_under(event, points, pen.sight.to_pixels))
    ]
    return min(found, key=lambda hit: hit[0])[1] if found else None
