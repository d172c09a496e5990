"""Transitions of the editor that select and move whole pieces, by mouse and keyboard.

In the mode Move, and with Alt in the others, a press grabs pieces instead of vertices.
"""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from seiswidgets.geology.picks import FAULT, HORIZON
from seiswidgets.geology.section import Section
from seiswidgets.interaction.cutoff_handles import CutOffHandle, cutoff_handles, split_at_cutoff
from seiswidgets.interaction.drawing import Drawing, PickSelection
from seiswidgets.interaction.editor_state import Drag, EditorState, Tools
from seiswidgets.interaction.gestures import Move, Press, Release
from seiswidgets.interaction.piece_ends import ends_at
from seiswidgets.interaction.pieces import delete_pieces, slide_to, transform_pieces
from seiswidgets.interaction.projection import side_of
from seiswidgets.interaction.sliding import slide_piece


def grab_cutoff_piece(state: EditorState, event: Press, tools: Tools, handle: CutOffHandle) -> EditorState:
    """Grab the piece that ends at a cut-off, to slide it along the fault, with those selected that end there too."""
    section = tools.viewport.section
    base, target = split_at_cutoff(state.drawing, section, handle)
    piece, pick = replace(target, vertex=None), PickSelection(HORIZON, handle.horizon)
    is_split = len(base.pick(HORIZON, handle.horizon).pieces) != len(state.drawing.pick(HORIZON, handle.horizon).pieces)
    chosen = state.chosen_pieces if not is_split and piece in state.chosen_pieces else ()
    wall = base.pick(FAULT, handle.fault).pieces[0]
    along = [one for one in chosen if one.kind == HORIZON and one != piece and ends_at(base.line(one), wall, section)]
    action = f"slide {name_pieces(base, [piece, *along]) if along else handle.horizon} along {handle.fault}"
    drag = _drag(state, event, piece, base, (piece, *along), action)
    state = state.change(selection=pick) if is_split else state.choose(drag.pieces)
    return state.change(drag=replace(drag, fault=handle.fault))


def grab_piece(state: EditorState, event: Press, target: PickSelection) -> EditorState:
    """Grab a piece, with the others that are selected if it is one of them, with Ctrl all pieces of its pick.

    With Shift, add it to the selection or take it away instead.
    """
    chosen = state.chosen_pieces
    if "shift" in event.modifiers:
        return toggle_piece(state, target)
    if event.modifiers & {"ctrl", "meta"}:
        state = state.change(selection=replace(target, piece=None))
    elif target not in chosen:
        state = state.change(selection=target)
    pieces = state.chosen_pieces
    action = f"move {name_pieces(state.drawing, pieces)}"
    return state.change(drag=_drag(state, event, target, state.drawing, pieces, action))


def toggle_piece(state: EditorState, target: PickSelection) -> EditorState:
    """Add a piece to the selection, or take it away."""
    chosen = state.chosen_pieces
    return state.choose(piece for piece in (*chosen, target) if (piece in chosen) != (piece == target))


def begin_rectangle(state: EditorState, event: Press) -> EditorState:
    """Begin a rectangle, which selects what it holds; with Shift, besides what is selected."""
    kept = state.chosen_pieces if "shift" in event.modifiers else ()
    return state.choose(kept).change(drag=_drag(state, event, None, state.drawing, kept))


def move_pieces(drag: Drag, event: Move | Release, tools: Tools) -> Drawing:
    """Move the grabbed pieces to the pointer, or slide the one that is grabbed at its cut-off."""
    section = tools.viewport.section
    if drag.fault is not None:
        return slide_to(drag.base, section, drag.pieces, drag.fault, event.point)
    shift = np.subtract(event.pixel, drag.pixel)

    def moved(target: PickSelection, points: Sequence[tuple[float, float]]) -> np.ndarray:
        return event.projection.moved(points, side_of(target.kind, points), shift)

    return transform_pieces(drag.base, section, drag.pieces, moved)


def choose_in_rectangle(state: EditorState, event: Move | Release) -> EditorState:
    """Select the visible pieces that the rectangle from the start of a drag to the pointer holds whole."""
    drag = state.drag
    if drag is None:
        return state
    low, high = np.sort([drag.pixel, event.pixel], axis=0)
    held = [
        target
        for target, points in visible_pieces(state)
        if ((pixels := event.projection.to_pixels(points)) >= low).all() and (pixels <= high).all()
    ]
    return state.choose(dict.fromkeys([*drag.pieces, *held]))


def nudge_pieces(state: EditorState, direction: np.ndarray, section: Section) -> EditorState | None:
    """Move the selected pieces by a step in the section's units."""
    pieces = state.chosen_pieces
    if not pieces:
        return None
    moved = transform_pieces(state.drawing, section, pieces, lambda _, points: np.add(points, direction))
    return state.edit(moved, f"move {name_pieces(state.drawing, pieces)}")


def slide_chosen(state: EditorState, samples: int, section: Section) -> EditorState | None:
    """Slide the selected piece of a horizon down its fault, the nearest one that it ends at, by the height of samples.

    With several selected, the first one.
    """
    piece = next((piece for piece in state.chosen_pieces if piece.kind == HORIZON), None)
    handles = [handle for handle in cutoff_handles(state.drawing, section) if piece and handle.horizon == piece.name]
    ends = [(split_at_cutoff(state.drawing, section, handle), handle.fault) for handle in handles]
    count = len(state.drawing.pick(HORIZON, piece.name or "").pieces) if piece else 0
    mine = [
        (base, fault)
        for (base, target), fault in ends
        if piece and target.piece == piece.piece and len(base.pick(HORIZON, piece.name or "").pieces) == count
    ]
    if piece is None or not mine:
        return None
    base, fault = mine[0]
    line, slip = base.pick(FAULT, fault).pieces[0], float(samples * section.dz * section.metres[1])
    slid = transform_pieces(base, section, [piece], lambda _, points: slide_piece(points, line, slip, section))
    return state.draw(slid, piece, f"slide {piece.name} along {fault}")


def remove_chosen(state: EditorState) -> EditorState | None:
    """Delete the selected pieces."""
    pieces = state.chosen_pieces
    if not pieces:
        return None
    label = f"delete {name_pieces(state.drawing, pieces)}"
    return state.draw(delete_pieces(state.drawing, pieces), None, label)


def visible_pieces(state: EditorState) -> list[tuple[PickSelection, tuple[tuple[float, float], ...]]]:
    """All pieces of visible picks, with their points."""
    return [
        (PickSelection(pick.kind, pick.name, piece), points)
        for pick in state.drawing.picks
        if pick.visible
        for piece, points in enumerate(pick.pieces)
    ]


def name_pieces(drawing: Drawing, pieces: Sequence[PickSelection]) -> str:
    """Name pieces for an edit: "H1", "a piece of H1", or "3 pieces"."""
    picks = {(piece.kind, piece.name) for piece in pieces}
    if len(picks) > 1:
        return f"{len(pieces)} pieces"
    ((kind, name),) = picks
    is_whole = len(drawing.pick(kind, name or "").pieces) == len(pieces)
    return name or "" if is_whole else f"a piece of {name}" if len(pieces) == 1 else f"{len(pieces)} pieces of {name}"


def _drag(
    state: EditorState,
    event: Press,
    target: PickSelection | None,
    base: Drawing,
    pieces: tuple[PickSelection, ...],
    action: str = "",
) -> Drag:
    is_restored = event.projection.restoration is not None
    held = Drag(target, state.drawing, state.selection, base, event.pixel, event.pixel)
    return replace(held, pieces=pieces, is_restored=is_restored, action=action)
