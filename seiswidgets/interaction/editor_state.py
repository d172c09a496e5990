"""The state of the pick editor as a frozen value, and the transitions that mouse and keyboard share."""

from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from seiswidgets.geology.bodies import BODY
from seiswidgets.geology.picks import FAULT, HORIZON
from seiswidgets.interaction.document import Document
from seiswidgets.interaction.drawing import Drawing, PickSelection, Point, Points
from seiswidgets.interaction.projection import PaneProjection
from seiswidgets.interaction.snapping import END_REACH, snap_to_lines
from seiswidgets.interaction.viewport import Viewport

LOOK, MOVE, BLOCK = "look", "move", "block"
MODES = (LOOK, FAULT, HORIZON, BODY, MOVE, BLOCK)


@dataclass(frozen=True)
class Drag:
    """A vertex or whole pieces held by the pointer, or a rectangle that selects pieces.

    Attributes
    ----------
    target : PickSelection or None
        The vertex or the piece that was grabbed, in ``base``; None for a rectangle.
    before : Drawing
    selection : PickSelection or None
        The drawing and the selection before the drag, for Escape and undo.
    base : Drawing
        The drawing in which it moves: with the vertex inserted, or the piece cut at its fault.
    pixel, last : tuple
        Pointer positions at the start of the drag and at its latest move.
    fault : str or None
        Name of the fault that a cut-off slides along.
    moves : bool
        True once the pointer has left its starting position; a click does not move anything.
    pieces : tuple of PickSelection
        Pieces that move as a whole, in ``base``; for a rectangle, those that stay selected whatever it holds.
    is_restored : bool
        True if the rectangle is drawn in the pane of the restored section.
    action : str
        Name of the edit; "" derives it.
    """

    target: PickSelection | None
    before: Drawing
    selection: PickSelection | None
    base: Drawing
    pixel: Point
    last: Point
    fault: str | None = None
    moves: bool = False
    pieces: tuple[PickSelection, ...] = ()
    is_restored: bool = False
    action: str = ""


@dataclass(frozen=True)
class Tools:
    """Placement of vertices: the view of the present-day section, snapping, and following.

    Attributes
    ----------
    viewport : Viewport
        Of the present-day section.
    snap : callable(point) -> point, optional
        Moves a horizon's vertex to the event that it snaps to.
    follow : callable(start, end) -> points, optional
        The line along an event between two vertices of a horizon, both included.
    """

    viewport: Viewport
    snap: Callable[[Point], Point] | None = None
    follow: Callable[[Point, Point], np.ndarray] | None = None

    def place_vertex(self, point: Point, kind: str, *, free: bool = False) -> Point:
        """Return the position of a new vertex: inside the section, and for a horizon on its event unless ``free``."""
        point = self.inside(point)
        return self.inside(self.snap(point)) if kind == HORIZON and self.snap and not free else point

    def snap_end(self, point: Point, drawing: Drawing, name: str | None) -> Point:
        """Return the position of a fault's end: on the border, or on another fault, if that is near."""
        x_min, x_max, z_min, z_max = self.viewport.section.extent
        border = [(x_min, z_min), (x_max, z_min), (x_max, z_max), (x_min, z_max), (x_min, z_min)]
        others = [pick.pieces[0] for pick in drawing.picks if pick.kind == FAULT and pick.visible and pick.name != name]
        return self.inside(snap_to_lines(point, [border, *others], self.viewport.pixel))

    def inside(self, point: ArrayLike) -> Point:
        """Return the nearest point of the section."""
        x_min, x_max, z_min, z_max = self.viewport.section.extent
        x, z = np.clip(point, (x_min, z_min), (x_max, z_max)).tolist()
        return x, z


@dataclass(frozen=True)
class EditorState:
    """Everything that the editor shows. Transitions return a new state.

    Attributes
    ----------
    document : Document
    mode : {"look", "fault", "horizon", "body", "move", "block"}
        If there is a draft line, its kind.
    selection : PickSelection or None
        A pick, a piece of it, or one vertex of that or of the draft line.
    cursor : (x, z) or None
        The keyboard cursor; None in the modes look and move.
    drag : Drag or None
    others : tuple of PickSelection
        Further picks and pieces that are selected.
    action : str
        Name of the edit that led here; "" derives it.
    preview : tuple of points (x, z)
        Line along an event that a click at the pointer, or a vertex at the keyboard cursor, would add; empty if it is
        straight.
    """

    document: Document
    mode: str = LOOK
    selection: PickSelection | None = None
    cursor: Point | None = None
    drag: Drag | None = None
    others: tuple[PickSelection, ...] = ()
    action: str = ""
    preview: Points = ()

    @property
    def drawing(self) -> Drawing:
        """All picks, the draft line included."""
        return self.document.drawing

    @property
    def fixed(self) -> Point | None:
        """The held point."""
        return self.document.plan.fixed

    @property
    def pins(self) -> tuple[Point, ...]:
        """Further points that stay where they are."""
        return self.document.plan.pins

    def change(self, **changes: Any) -> "EditorState":
        """Change fields, then make the mode that of the draft line, and reduce the selection to what exists.

        A new selection drops ``others`` unless they are given too.
        """
        others = () if "selection" in changes else self.others
        state = replace(self, **{"others": others, "action": "", "preview": (), **changes})
        draft = state.drawing.draft
        mode = draft.kind if draft else state.mode
        state = replace(state, mode=mode, cursor=None if mode in (LOOK, MOVE) else state.cursor)
        kept = (_existing(state, target) for target in state.others)
        return replace(state, selection=_existing(state, state.selection), others=tuple(filter(None, kept)))

    @property
    def chosen_pieces(self) -> tuple[PickSelection, ...]:
        """The pieces that are selected, those of whole picks included, in the order of the drawing."""
        chosen = {(one.kind, one.name, one.piece) for one in (self.selection, *self.others) if one is not None}
        return tuple(
            PickSelection(pick.kind, pick.name, piece)
            for pick in self.drawing.picks
            for piece in range(len(pick.pieces))
            if chosen & {(pick.kind, pick.name, piece), (pick.kind, pick.name, None)}
        )

    def choose(self, pieces: Iterable[PickSelection]) -> "EditorState":
        """Select pieces and nothing else."""
        chosen = tuple(pieces)
        return self.change(selection=chosen[0] if chosen else None, others=chosen[1:])

    def draw(self, drawing: Drawing, selection: PickSelection | None = None, action: str = "") -> "EditorState":
        """Replace the drawing, and select something in it; ``action`` names the edit."""
        return self.change(document=replace(self.document, drawing=drawing), selection=selection, action=action)

    def edit(self, drawing: Drawing, action: str = "") -> "EditorState":
        """Replace the drawing, and keep what is selected."""
        return self.change(document=replace(self.document, drawing=drawing), action=action)

    def hold(self, point: Point | None) -> "EditorState":
        """Hold the block that a point lies in; with None, hold no block."""
        return self.change(document=replace(self.document, plan=replace(self.document.plan, fixed=point)))

    def keep_level(self, level: float | None) -> "EditorState":
        """Keep the depth of a level while faults are restored; with None, of none."""
        return self.change(document=replace(self.document, plan=replace(self.document.plan, regional=level)))

    def toggle_pin(self, point: Point) -> "EditorState":
        """Hold a point, or release it if it is held."""
        plan = self.document.plan
        pins = tuple(pin for pin in plan.pins if pin != point)
        plan = replace(plan, pins=pins if point in plan.pins else (*pins, point))
        return self.change(document=replace(self.document, plan=plan))

    def settle(self) -> "EditorState":
        """End a drag where it is."""
        return self.change(drag=None, action=self.drag.action if self.drag else "")

    def enter(self, mode: str, tools: Tools) -> "EditorState":
        """Change the mode; a draft line is finished, or dropped if it is a single point."""
        state = self.settle()
        if mode == state.mode:
            return state
        state = state.finish(tools)
        return (state.cancel() if state.drawing.draft else state).change(mode=mode, cursor=None)

    def add(
        self, point: Point, tools: Tools, projection: PaneProjection, *, free: bool = False, select: bool = True
    ) -> "EditorState":
        """Add a vertex to the draft line, or begin one; ``free`` of snapping and following."""
        draft = self.drawing.draft
        point = tools.place_vertex(point, self.mode, free=free)
        if draft is None:
            chosen = self.selection
            name = chosen.name if self.mode == HORIZON and chosen and chosen.kind == HORIZON else None
            drawing = self.drawing.with_draft_begun(self.mode, point, name)
        elif point == draft.points[-1]:
            return self
        elif self.mode == HORIZON and tools.follow and not free:
            drawing = self.drawing.with_draft_extended(tools.follow(draft.points[-1], point)[1:])
        else:
            drawing = self.drawing.with_draft_continued(projection.path(draft.points[-1], point))
        return self.draw(drawing, drawing.draft_end if select else None)

    def with_preview(self, point: Point, tools: Tools, *, free: bool = False) -> "EditorState":
        """Show the line along an event that ``add`` would add."""
        draft = self.drawing.draft
        if draft is None or draft.kind != HORIZON or tools.follow is None or free or not np.isfinite(point).all():
            return self.change(preview=()) if self.preview else self
        path = tools.follow(draft.points[-1], tools.place_vertex(point, HORIZON))
        return self.change(preview=tuple((x, z) for x, z in path.tolist()))

    def finish(self, tools: Tools | None = None) -> "EditorState":
        """Turn the draft line into a pick, or a piece of one, and select it; a single point stays a draft.

        With tools, the ends of a fault snap.
        """
        draft = self.drawing.draft
        drawing, name = (self._with_ends_snapped(tools) if tools else self.drawing).with_draft_finished()
        if draft is None or name is None:
            return self
        return self.draw(drawing, PickSelection(draft.kind, name, len(drawing.pick(draft.kind, name).pieces) - 1))

    def _with_ends_snapped(self, tools: Tools) -> Drawing:
        """Snap the ends of a draft fault, unless it is too short for that."""
        draft, target = self.drawing.draft, self.drawing.draft_end
        if draft is None or target is None or draft.kind != FAULT:
            return self.drawing
        steps = np.diff(draft.points, axis=0) / tools.viewport.pixel
        if np.hypot(*steps.T).sum() < 3 * END_REACH:
            return self.drawing
        first, last = (tools.snap_end(draft.points[which], self.drawing, None) for which in (0, -1))
        return self.drawing.with_line(target, [first, *draft.points[1:-1], last])

    def cancel(self) -> "EditorState":
        """Drop the draft line."""
        draft = self.drawing.draft
        exists = draft is not None and draft.name in self.drawing.names(draft.kind)
        selection = PickSelection(draft.kind, draft.name) if draft and exists else None
        return self.draw(replace(self.drawing, draft=None), selection)

    def remove_vertex(self, target: PickSelection) -> "EditorState":
        """Remove a vertex and select the one before it; the only vertex of the draft line cancels that line."""
        if target.name is None and len(self.drawing.line(target)) == 1:
            return self.cancel()
        return self.draw(
            self.drawing.with_vertex_removed(target), replace(target, vertex=max(0, (target.vertex or 0) - 1))
        )

    def editable_lines(self) -> list[tuple[PickSelection, Points]]:
        """Return the lines whose vertices can be dragged in the present mode."""
        draft = self.drawing.draft
        if draft:
            return [(PickSelection(draft.kind, None, 0), draft.points)]
        chosen = self.selection if self.mode == LOOK else None
        return [
            (PickSelection(pick.kind, pick.name, piece), points)
            for pick in self.drawing.picks
            if pick.visible
            and (pick.kind == self.mode or (chosen and (pick.kind, pick.name) == (chosen.kind, chosen.name)))
            for piece, points in enumerate(pick.pieces)
        ]


def _existing(state: EditorState, target: PickSelection | None) -> PickSelection | None:
    """Reduce a selection to what exists: to a piece or pick where its vertex cannot be changed now, or to None."""
    drawing = state.drawing
    if target is None:
        return None
    points = drawing.line(target)
    has_vertex = target.vertex is not None and target.vertex < len(points)
    if target.name is None:
        return target if has_vertex else None
    if not any(pick.visible for pick in drawing.picks if (pick.kind, pick.name) == (target.kind, target.name)):
        return None
    usable = state.mode in (LOOK, MOVE, target.kind) and drawing.draft is None
    return target if has_vertex and usable else replace(target, piece=target.piece if points else None, vertex=None)
