"""The menu at a point of a pane: everything that can be done there, without a mode or a key."""

from collections.abc import Callable
from dataclasses import replace
from functools import partial

import numpy as np

from seiswidgets.geology.bodies import BODY
from seiswidgets.geology.picks import AUTO, CARRY, CONSTRAIN, EXTEND, FAULT, HORIZON, TIP
from seiswidgets.interaction.drawing import Drawing, Pick, PickSelection, Point
from seiswidgets.interaction.editor import PickEditor
from seiswidgets.interaction.editor_state import EditorState, Tools
from seiswidgets.interaction.gestures import Press, line_under, vertex_under
from seiswidgets.interaction.piece_commands import (
    Command,
    begin_move,
    copy_down,
    copy_up,
    delete,
    extend,
    join,
    reverse,
    split,
)

Item = tuple[str, Callable[[], object]]
END_LABELS = {
    TIP: "This end dies out here",
    EXTEND: "This end reaches what lies ahead",
    AUTO: "Judge this end by its distance",
}


def menu_items(editor: PickEditor, event: Press) -> list[Item]:
    """Labels and actions for a point: of the line that is being drawn, else of the pick there, else of the rock."""
    editor.settle()
    state = editor.state
    rock = [] if not np.isfinite(event.point).all() else _rock_items(editor, event.point)
    if state.drawing.draft:
        items = [("Finish the line", editor.finish), *_last_vertex_item(editor)]
    else:
        hit = _pick_under(state, event)
        items = rock if hit is None else _pick_items(editor, event, *hit)
        items += _selection_items(editor)
    entry = editor.history.next_undo
    return [*items, *([(f"Undo: {entry.label}", editor.undo)] if entry else [])]


def _last_vertex_item(editor: PickEditor) -> list[Item]:
    end = editor.drawing.draft_end
    drop = ("Drop the line", lambda: editor.change(lambda state: state.cancel()))
    if end is None:
        return [drop]
    return [("Remove its last vertex", lambda: editor.change(lambda state: state.remove_vertex(end))), drop]


def _pick_items(editor: PickEditor, event: Press, pick: Pick, target: PickSelection, point: Point) -> list[Item]:
    """Actions on the pick, the piece and the vertex at a point."""
    kind, name = pick.kind, pick.name
    vertex = vertex_under(event, pick.pieces[target.piece or 0], event.projection.to_pixels)
    inserted = editor.drawing.with_vertex_inserted(target, point)
    items: list[Item] = [(f"Select {name}", partial(editor.select, kind, name))]
    if vertex:
        hit = replace(target, vertex=vertex[0])
        items.append(("Remove this vertex", lambda: editor.change(lambda state: state.remove_vertex(hit))))
    else:
        items.append(("Insert a vertex here", lambda: editor.change(lambda state: state.draw(inserted, target))))
    items += _piece_items(editor, pick, target, inserted, vertex[0] if vertex else None)
    items += _end_items(editor, pick, vertex[0] if vertex else None)
    if kind == HORIZON and len(pick.pieces) > 1:
        rest = editor.drawing.with_line(replace(target, vertex=None), [])
        items.append(("Delete this piece", lambda: editor.change(lambda state: state.draw(rest))))
    use = (f"Only carry {name}", CARRY) if pick.use == CONSTRAIN else (f"Let {name} constrain", CONSTRAIN)
    items.append((use[0], partial(editor.use, kind, name, use[1])))
    return [
        *items,
        (f"Hide {name}", partial(editor.show, kind, name, False)),
        (f"Delete {name}", partial(editor.delete, kind, name)),
    ]


def _piece_items(
    editor: PickEditor, pick: Pick, target: PickSelection, inserted: Drawing, vertex: int | None
) -> list[Item]:
    """Actions on a whole line; ``inserted`` is the drawing with a vertex at the point, ``vertex`` one that is there."""
    piece, whole = replace(target, vertex=None), PickSelection(pick.kind, pick.name)

    def split_here(state: EditorState, tools: Tools) -> EditorState:
        base = state.edit(inserted) if vertex is None else state
        return split(base.change(selection=target if vertex is None else replace(target, vertex=vertex)), tools)

    def command(label: str, command: Command, on: PickSelection = piece) -> Item:
        return label, partial(editor.command, command, on)

    items = [command(f"Move {pick.name}", begin_move, whole)]
    if len(pick.pieces) > 1:
        items = [command("Move this piece", begin_move), *items, command("Join to the nearest piece", join)]
    if pick.kind == HORIZON:
        copies = (f"Copy {pick.name} up", copy_up), (f"Copy {pick.name} down", copy_down)
        items += [command(*copy, whole) for copy in copies]
    if pick.kind == BODY:
        return items
    if vertex in (0, len(pick.pieces[target.piece or 0]) - 1):
        longer = command("Extend this end to fault or border", extend, replace(target, vertex=vertex))
    else:
        items.append(command("Split here", split_here, target))
        longer = command("Extend to fault or border", extend)
    return [*items, longer, command("Reverse the line", reverse)]


def _end_items(editor: PickEditor, pick: Pick, vertex: int | None) -> list[Item]:
    """Choices for the end of a fault at a vertex; the present one is ticked."""
    if pick.kind != FAULT or vertex not in (0, len(pick.pieces[0]) - 1):
        return []
    first, last = pick.ends
    present = last if vertex else first

    def choose(end: str) -> Item:
        ends = (first, end) if vertex else (end, last)
        return f"{'✓ ' if end == present else ''}{END_LABELS[end]}", partial(editor.ends, pick.name, ends)

    return [choose(end) for end in END_LABELS]


def _selection_items(editor: PickEditor) -> list[Item]:
    """Actions on several pieces that are selected."""
    count = len(editor.state.chosen_pieces)
    if not editor.state.others:
        return []
    commands = (f"Delete the {count} selected pieces", delete), (f"Join the {count} selected pieces", join)
    return [(label, partial(editor.command, command)) for label, command in commands]


def _rock_items(editor: PickEditor, point: Point) -> list[Item]:
    """Actions where there is no pick."""

    def begin(kind: str) -> None:
        editor.enter(kind)
        editor.deselect()
        editor.add(point)

    held = editor.state.fixed
    hold = ("Release the held block", partial(editor.hold, None))
    pin = ("Pin this point", lambda: editor.change(lambda state: state.toggle_pin(point)))
    level = ("Keep this level (regional)", lambda: editor.change(lambda state: state.keep_level(float(point[1]))))
    let_go = ("Release the regional level", lambda: editor.change(lambda state: state.keep_level(None)))
    return [
        ("Begin a fault here", partial(begin, FAULT)),
        ("Begin a horizon here", partial(begin, HORIZON)),
        ("Hold this block", partial(editor.hold, point)),
        *([hold] if held else []),
        pin,
        level,
        *([let_go] if editor.state.document.plan.regional is not None else []),
    ]


def _pick_under(state: EditorState, event: Press) -> tuple[Pick, PickSelection, Point] | None:
    """Nearest visible pick under a press, its piece with the vertex that follows, and the point on it."""
    hits = [
        (hit[2], pick, PickSelection(pick.kind, pick.name, piece, hit[0]), hit[1])
        for pick in state.drawing.picks
        if pick.visible
        for piece, points in enumerate(pick.pieces)
        if (hit := line_under(event, points, event.projection.to_pixels))
    ]
    return min(hits, key=lambda hit: hit[0])[1:] if hits else None
