"""What gestures mean: a plain state machine, points in and edits out, with unlimited undo. It knows no Jupyter.

Modes are look, fault, horizon and block. In fault and horizon mode, picks of that kind can be changed; in look mode,
the one that is selected.

=====================  ==============================================================================================
Click                  fault, horizon: adds a vertex to the line under way, or begins one. Begun while a horizon is
                       selected, it becomes a further piece of that one. Look: selects. Block: sets the held point;
                       on the point, removes it
Click on a line        inserts a vertex, if no line is under way
Drag                   moves a vertex; of a cut-off, the end of the piece along the fault. Horizon vertices snap
Shift                  while clicking: begins a line whatever lies there. While dragging: no snapping, and off the fault
Ctrl-click             removes a vertex
Double-click           finishes the line under way
Enter                  at the keyboard cursor: puts a vertex; on the last vertex, or without cursor: finishes. With no
                       line under way and no cursor: shows the cursor
Space                  puts a vertex at the keyboard cursor (without one, it is left to the pane, which pans)
Arrows                 nudge the selected vertex by a trace or sample, Shift: by ten. With none selected, they move the
                       keyboard cursor by some pixels, Shift: ten times as far, Ctrl: by one trace or sample
Page Up, Page Down     select the vertex before, after
Insert, I              insert a vertex after the selected one
Delete, Backspace      remove the selected vertex; else the last one of the line under way; else the selected piece (the
                       one clicked, or drawn last); else, in look mode, the selected pick; in block mode, the held point
Escape                 cancels a drag; else the line under way; else the selection; else goes back to look mode
L, F, H, B             modes
Ctrl+Z                 undo; Ctrl+Shift+Z, Ctrl+Y: redo
=====================  ==============================================================================================

Tab is never consumed, so that it leaves the canvas.
"""

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from seiswidgets.errors import SettingError
from seiswidgets.geology.picks import Interpretation
from seiswidgets.interaction.cutoff_handles import CutOffHandle, cut_offs
from seiswidgets.interaction.drawing import HORIZON, Drawing, PickSelection, Point, Points
from seiswidgets.interaction.editor_state import LOOK, MODES, EditorState, known
from seiswidgets.interaction.gestures import DoubleClick, Gesture, Key, Move, Press, Release
from seiswidgets.interaction.keyboard import key_pressed
from seiswidgets.interaction.mouse import double_clicked, moved, pressed, released
from seiswidgets.interaction.projection import PaneProjection
from seiswidgets.interaction.viewport import Viewport


class PickEditor:
    """The state machine: ``handle`` gestures, read ``state``.

    Parameters
    ----------
    view : Viewport
        Of the original section; set it anew when it changes.
    drawing : Drawing, optional
    snap : callable(point) -> point, optional
        Where a horizon's vertex goes.
    follow : callable(start, end) -> points, optional
        The line between two vertices of a horizon, both included.
    """

    def __init__(
        self,
        view: Viewport,
        drawing: Drawing | None = None,
        *,
        snap: Callable[[Point], Point] | None = None,
        follow: Callable[[Point, Point], np.ndarray] | None = None,
    ):
        self.view, self.snap, self.follow = view, snap, follow
        self.state = EditorState(drawing=drawing or Drawing())
        self._past, self._future = [], []
        self.before_press = self.drawing
        self.projection = PaneProjection(view)

    @property
    def drawing(self) -> Drawing:
        """All that is picked, the line under way included."""
        return self.state.drawing

    @property
    def interpretation(self) -> Interpretation:
        """What is finished and valid; the same object as long as the picks do not change."""
        return self.drawing.interpretation

    @property
    def problems(self) -> list[tuple[str, str]]:
        """Name and message, for each line that is kept but cannot be used."""
        return self.drawing.problems

    @property
    def rubber_band(self) -> Point | None:
        """Where the line to the pointer starts; None if no line is under way."""
        line = self.drawing.draft
        return line.points[-1] if line else None

    def cutoffs(self) -> tuple[CutOffHandle, ...]:
        """The cut-offs of visible horizons at visible faults."""
        return cut_offs(self.drawing, self.view.section)

    def handle(self, gesture: Gesture, projection: PaneProjection | None = None) -> bool:
        """Do what a gesture asks, and say whether it is consumed; if not, the pane may pan, fit, or let it pass.

        ``projection`` is that of the pane it was made in; by default, the original's. Points are those of the original.
        """
        self.projection = projection or PaneProjection(self.view)
        match gesture:
            case Key():
                return key_pressed(self, gesture)
            case Move():
                return moved(self, gesture)
            case Press():
                self.settle()
                self.before_press = self.drawing
                return pressed(self, gesture)
            case DoubleClick():
                self.settle()
                return double_clicked(self, gesture)
            case Release():
                return released(self, gesture)

    def enter(self, mode: str) -> None:
        """Change the mode; a line under way is finished, or dropped (undo brings it back) if it is but one point."""
        if mode not in MODES:
            raise SettingError(f"mode must be one of {', '.join(MODES)}, but is {mode!r}")
        self.settle()
        if mode == self.state.mode:
            return
        self.finish()
        if self.drawing.draft:
            self.cancel()
        self.change(mode=mode, cursor=None)

    def edit(self, drawing: Drawing, selection: PickSelection | None = None) -> None:
        """Make an edit that can be undone, and select something."""
        self.settle()
        self._record(self.drawing, self.state.selection, drawing)
        self.change(drawing=drawing, selection=selection)

    def undo(self) -> bool:
        """Take back the last edit; False if there is none."""
        return self._travel(self._past, self._future)

    def redo(self) -> bool:
        """Make the edit again that was taken back last; False if there is none."""
        return self._travel(self._future, self._past)

    @property
    def can_undo(self) -> bool:
        """Whether there is an edit to take back."""
        return bool(self._past)

    @property
    def can_redo(self) -> bool:
        """Whether there is an edit to make again."""
        return bool(self._future)

    def forget(self) -> None:
        """Let what has been done so far be the beginning, which cannot be undone."""
        self._past.clear()
        self._future.clear()

    def add(self, point: Point, *, free: bool = False, select: bool = True) -> None:
        """Add a vertex to the line under way, or begin one; ``free`` of snapping and following."""
        mode, line = self.state.mode, self.drawing.draft
        point = self.placed(point, mode, free=free)
        if line is None:
            chosen = self.state.selection
            name = chosen.name if mode == HORIZON and chosen and chosen.kind == HORIZON else None
            drawing = self.drawing.begun(mode, point, name)
        elif point == line.points[-1]:
            return
        elif mode == HORIZON and self.follow and not free:
            drawing = self.drawing.extended(self.follow(line.points[-1], point)[1:])
        else:
            drawing = self.drawing.continued(self.projection.path(line.points[-1], point))
        last = len(drawing.draft.points) - 1
        self.edit(drawing, PickSelection(mode, None, 0, last) if select else None)

    def finish(self) -> None:
        """Make the line under way a pick, or a piece of one, which is then selected; a single point stays under way."""
        line = self.drawing.draft
        drawing, name = self.drawing.finished()
        if name is not None:
            self.edit(drawing, PickSelection(line.kind, name, len(drawing.pick(line.kind, name).pieces) - 1))

    def cancel(self) -> None:
        """Drop the line under way; undo brings it back."""
        line = self.drawing.draft
        known = line is not None and line.name in self.drawing.names(line.kind)
        self.edit(replace(self.drawing, draft=None), PickSelection(line.kind, line.name) if known else None)

    def select(self, kind: str, name: str) -> None:
        """Select a pick; PickError if there is none of that name."""
        self.settle()
        self.drawing.pick(kind, name)
        self.change(selection=PickSelection(kind, name))

    def deselect(self) -> None:
        """Select nothing: the next line begun in horizon mode is a new horizon."""
        self.settle()
        self.change(selection=None)

    def rename(self, kind: str, name: str, new: str) -> None:
        """Rename a pick; a horizon given the name of another becomes pieces of it. PickError if that cannot be."""
        self.settle()
        self.edit(self.drawing.renamed(kind, name, new), PickSelection(kind, str(new).strip()))

    def recolour(self, kind: str, name: str, colour: str) -> None:
        """Give a pick a colour, "#rrggbb" or a name."""
        self.settle()
        self.edit(self.drawing.recoloured(kind, name, colour), self.state.selection)

    def show(self, kind: str, name: str, visible: bool = True) -> None:
        """Show a pick, or hide it."""
        self.settle()
        self.edit(self.drawing.shown(kind, name, visible), self.state.selection)

    def delete(self, kind: str, name: str) -> None:
        """Delete a pick; undo brings it back."""
        self.settle()
        self.edit(self.drawing.deleted(kind, name), self.state.selection)

    def hold(self, point: Point | None) -> None:
        """Hold the block that a point lies in, or none."""
        self.settle()
        self.edit(self.drawing.held(None if point is None else self.inside(point)), self.state.selection)

    def load(self, interpretation: Interpretation) -> None:
        """Take the picks of an interpretation instead of what is finished; the one shown already changes nothing."""
        self.settle()
        if interpretation is not self.interpretation:
            self.edit(self.drawing.with_interpretation(interpretation), self.state.selection)

    def begin(self, drawing: Drawing) -> None:
        """Start anew with other picks: nothing is under way, selected, or there to be undone."""
        self._past.clear()
        self._future.clear()
        self.state, self.projection = EditorState(self.state.mode, drawing), PaneProjection(self.view)

    def change(self, **changes) -> None:
        """Change the state, and what must go with it; not an edit by itself."""
        state = replace(self.state, **changes)
        line = state.drawing.draft
        mode = line.kind if line else state.mode
        cursor = None if mode == LOOK else state.cursor
        state = replace(state, mode=mode, cursor=cursor)
        self.state = replace(state, selection=known(state))

    def settle(self) -> None:
        """End a drag, which becomes an edit."""
        drag = self.state.drag
        if drag:
            self._record(drag.before, drag.selection, self.drawing)
            self.change(drag=None)

    def placed(self, point: Point, kind: str, *, free: bool = False) -> Point:
        """Where a vertex goes: on the section, and a horizon's to its event."""
        point = self.inside(point)
        return self.inside(self.snap(point)) if kind == HORIZON and self.snap and not free else point

    def inside(self, point: Point) -> Point:
        """The place of the section nearest to a point."""
        x_min, x_max, z_min, z_max = self.view.section.extent
        x, z = np.clip(point, (x_min, z_min), (x_max, z_max)).tolist()
        return x, z

    def editable(self) -> list[tuple[PickSelection, Points]]:
        """The lines whose vertices can be taken hold of now."""
        state, line = self.state, self.drawing.draft
        if line:
            return [(PickSelection(line.kind, None, 0), line.points)]
        chosen = state.selection if state.mode == LOOK else None
        return [
            (PickSelection(pick.kind, pick.name, piece), points)
            for pick in self.drawing.picks
            if pick.visible
            and (pick.kind == state.mode or (chosen and (pick.kind, pick.name) == (chosen.kind, chosen.name)))
            for piece, points in enumerate(pick.pieces)
        ]

    def _record(self, before, selection, after):
        if before != after:
            self._past.append((before, selection))
            self._future.clear()

    def _travel(self, source, target):
        self.settle()
        if not source:
            return False
        target.append((self.drawing, self.state.selection))
        drawing, selection = source.pop()
        self.change(drawing=drawing, selection=selection)
        return True
