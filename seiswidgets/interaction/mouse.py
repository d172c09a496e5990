"""Transitions of the editor for presses, moves, releases and double clicks.

Each function returns the new state, or None if the gesture means nothing here, so that the pane may pan or zoom.
"""

from dataclasses import replace
from functools import partial

import numpy as np

from seiswidgets.geology.bodies import BODY
from seiswidgets.geology.picks import FAULT, HORIZON
from seiswidgets.geology.section import Section
from seiswidgets.interaction.cutoff_handles import (
    CutOffHandle,
    cutoff_handles,
    slide_along_fault,
    split_at_cutoff,
    wall_of,
)
from seiswidgets.interaction.drawing import Drawing, PickSelection, Points, closed
from seiswidgets.interaction.editor_state import BLOCK, LOOK, MOVE, Drag, EditorState, Tools
from seiswidgets.interaction.gestures import DoubleClick, Move, Press, Release, line_under, vertex_under
from seiswidgets.interaction.piece_moves import (
    begin_rectangle,
    choose_in_rectangle,
    grab_cutoff_piece,
    grab_piece,
    move_pieces,
    toggle_piece,
    visible_pieces,
)
from seiswidgets.interaction.projection import side_of

CLICK_RADIUS = 3.0  # css pixels: a press that moves less is a click
CTRL = frozenset({"ctrl", "meta"})


def press(state: EditorState, event: Press, tools: Tools) -> EditorState | None:
    """Add, select, remove or grab something under the pointer."""
    if event.button != 0 or not np.isfinite(event.pixel).all():
        return None
    state = state.change(cursor=None)
    mode, free = state.mode, "shift" in event.modifiers
    if mode == MOVE or (mode != BLOCK and "alt" in event.modifiers and not state.drawing.draft):
        return _grab_whole(state, event, tools)
    if not np.isfinite(event.point).all():
        return None
    if mode == BLOCK:
        return _toggle_held(state, event, tools)
    if event.modifiers & CTRL:
        return _remove_under(state, event) or (None if mode == LOOK else state)
    if not (free and mode != LOOK) and (grabbed := _grab_under(state, event, tools)):
        return grabbed
    if mode == LOOK:
        return _select_under(state, event, besides=free)
    return state.add(event.point, tools, event.projection, free=free)


def move(state: EditorState, event: Move | Release, tools: Tools) -> EditorState | None:
    """Continue a drag."""
    drag = state.drag
    if drag is None:
        return None
    far = np.hypot(*np.subtract(event.pixel, drag.pixel)) >= CLICK_RADIUS
    by_pixels = drag.target is None or (drag.pieces and drag.fault is None)
    if not ((far or drag.moves) and (by_pixels or np.isfinite(event.point).all())):
        return state
    if drag.target is None:
        moved = choose_in_rectangle(state, event)
    elif drag.pieces:
        moved = state.edit(move_pieces(drag, event, tools)).choose(drag.pieces)
    else:
        moved = state.draw(_dragged(drag, drag.target, event, tools), drag.target)
    return moved.change(drag=replace(drag, last=event.pixel, moves=True))


def release(state: EditorState, event: Release, tools: Tools) -> EditorState | None:
    """End a drag where the button goes up, which is farther on if the last moves were not reported."""
    drag = state.drag
    if drag is None:
        return None
    if event.cancelled:
        return abandon_drag(state)
    moved = move(state, event, tools) if event.pixel != drag.last else None
    return (moved or state).settle()


def abandon_drag(state: EditorState) -> EditorState:
    """Go back to the state before a drag."""
    drag = state.drag
    return state.draw(drag.before, drag.selection).change(drag=None) if drag else state


def double_click(state: EditorState, event: DoubleClick, tools: Tools) -> EditorState | None:
    """Finish the draft line, or hold a block."""
    if not np.isfinite([*event.point, *event.pixel]).all():
        return None
    if state.mode in (LOOK, MOVE):
        return None if _piece_under(state, event) is None else state
    return state.hold(tools.inside(event.point)) if state.mode == BLOCK else state.finish(tools)


def _dragged(drag: Drag, target: PickSelection, event: Move | Release, tools: Tools) -> Drawing:
    free = "shift" in event.modifiers
    if drag.fault is not None and not free:
        return slide_along_fault(drag.base, tools.viewport.section, target, drag.fault, event.point)
    point = tools.place_vertex(event.point, target.kind, free=free)
    is_end = target.vertex in (0, len(drag.base.line(target)) - 1)
    if target.kind == FAULT and target.name is not None and is_end and not free:
        point = tools.snap_end(point, drag.base, target.name)
    return drag.base.with_vertex_moved(target, point)


def _toggle_held(state: EditorState, event: Press, tools: Tools) -> EditorState:
    """Hold the block under the pointer, with Shift the point there; or release what is held there."""
    held = state.fixed
    hit = next((pin for pin in state.pins if vertex_under(event, [pin], event.projection.to_pixels)), None)
    if hit or "shift" in event.modifiers:
        return state.toggle_pin(hit or tools.inside(event.point))
    is_hit = held is not None and vertex_under(event, [held], event.projection.to_pixels)
    return state.hold(None if is_hit else tools.inside(event.point))


def _remove_under(state: EditorState, event: Press) -> EditorState | None:
    target = _vertex_under(state, event)
    return None if target is None else state.remove_vertex(target)


def _grab_whole(state: EditorState, event: Press, tools: Tools) -> EditorState | None:
    """Grab whole pieces: at a cut-off one to slide, else what is under the pointer; a rectangle where there is none."""
    at_cutoff = not event.modifiers & {"shift", *CTRL} and np.isfinite(event.point).all()
    handle = _cutoff_under(state, event, tools.viewport.section) if at_cutoff else None
    if handle is not None:
        return grab_cutoff_piece(state, event, tools, handle)
    target = _piece_under(state, event)
    if target is not None:
        return grab_piece(state, event, target)
    return begin_rectangle(state, event) if state.mode == MOVE else None


def _grab_under(state: EditorState, event: Press, tools: Tools) -> EditorState | None:
    """Grab a cut-off, a vertex, or a line, into which a vertex is inserted; None if there is none."""
    chosen = state.selection
    vertex_first = state.mode == LOOK and chosen is not None and chosen.kind == FAULT
    order = (_grab_vertex, _grab_cutoff) if vertex_first else (_grab_cutoff, _grab_vertex)
    return next((grabbed for grab in (*order, _grab_line) if (grabbed := grab(state, event, tools))), None)


def _grab_vertex(state: EditorState, event: Press, tools: Tools) -> EditorState | None:
    target = _vertex_under(state, event)
    return None if target is None else _grab(state, event, target, state.drawing)


def _grab_line(state: EditorState, event: Press, tools: Tools) -> EditorState | None:
    if state.drawing.draft:
        return None
    hits = [
        (hit[2], replace(target, vertex=hit[0]), hit[1])
        for target, points in state.editable_lines()
        if (hit := line_under(event, _border(target.kind, points), event.projection.to_pixels))
    ]
    if not hits:
        return None
    _, target, point = min(hits, key=lambda hit: hit[0])
    base = state.drawing.with_vertex_inserted(target, point)
    return _grab(state, event, target, base).draw(base, target)


def _grab_cutoff(state: EditorState, event: Press, tools: Tools) -> EditorState | None:
    if state.mode not in (LOOK, HORIZON) or state.drawing.draft:
        return None
    section = tools.viewport.section
    handle = _cutoff_under(state, event, section)
    if handle is None:
        return None
    base, target = split_at_cutoff(state.drawing, section, handle)
    grabbed = _grab(state, event, target, base, handle.fault)
    before, after = (drawing.pick(HORIZON, handle.horizon).pieces for drawing in (state.drawing, base))
    if list(map(len, before)) != list(map(len, after)):  # until it moves, the piece has no vertex there
        return grabbed.change(selection=PickSelection(HORIZON, handle.horizon))
    return grabbed


def _grab(
    state: EditorState, event: Press, target: PickSelection, base: Drawing, fault: str | None = None
) -> EditorState:
    drag = Drag(target, state.drawing, state.selection, base, event.pixel, event.pixel, fault)
    return state.change(drag=drag, selection=target)


def _cutoff_under(state: EditorState, event: Press, section: Section) -> CutOffHandle | None:
    """Return the cut-off under a press; of two at one point, the one in the wall that the pointer is in."""
    handles = cutoff_handles(state.drawing, section)
    hits = [(vertex_under(event, [handle.inside], event.projection.to_pixels), handle) for handle in handles]
    near = [(hit[1], handle) for hit, handle in hits if hit]
    if not near:
        return None
    fault = min(near, key=lambda hit: hit[0])[1].fault
    wall = wall_of(state.drawing, section, fault, event.point)
    return min(near, key=lambda hit: (hit[1].fault != fault, hit[1].wall != wall, hit[0]))[1]


def _vertex_under(state: EditorState, event: Press) -> PickSelection | None:
    """Return the nearest vertex that can be dragged, or None."""
    hits = [
        (hit[1], replace(target, vertex=hit[0]))
        for target, points in state.editable_lines()
        if (
            hit := vertex_under(
                event, points, partial(event.projection.vertex_pixels, side=side_of(target.kind, points))
            )
        )
    ]
    return min(hits, key=lambda hit: hit[0])[1] if hits else None


def _border(kind: str, points: Points) -> Points:
    """The points of a pick's line, closed if it is a body."""
    return closed(points) if kind == BODY else points


def _select_under(state: EditorState, event: Press, *, besides: bool) -> EditorState | None:
    """Select the piece under a press; ``besides`` what is selected, or take it away from that."""
    target = _piece_under(state, event)
    if target is None:
        return None
    return toggle_piece(state, target) if besides else state.change(selection=target)


def _piece_under(state: EditorState, event: Press | DoubleClick) -> PickSelection | None:
    """Return the visible piece under a press, or None."""
    hits = [
        (hit[2], target)
        for target, points in visible_pieces(state)
        if (hit := line_under(event, _border(target.kind, points), event.projection.to_pixels))
    ]
    return min(hits, key=lambda hit: hit[0])[1] if hits else None
