"""The pick editor: a state machine that turns gestures into edits, with unlimited undo. It knows no Jupyter.

Modes are look, fault, horizon, body, move and block. In fault, horizon and body mode, picks of that kind can be
changed; in look mode, the one that is selected; in move mode, whole pieces are selected and moved.

`gesture_table` lists what each gesture and key does. Tab is never consumed, so that it leaves the canvas.
"""

from collections.abc import Callable

import numpy as np

from seiswidgets.errors import SettingError
from seiswidgets.geology.picks import Ends, Interpretation
from seiswidgets.interaction.click_hints import click_hint
from seiswidgets.interaction.cutoff_handles import CutOffHandle
from seiswidgets.interaction.document import Document, EditHistory, Entry
from seiswidgets.interaction.drawing import Drawing, PickSelection, Point
from seiswidgets.interaction.editor_state import MODES, EditorState, Tools
from seiswidgets.interaction.gestures import DoubleClick, Gesture, Key, Move, Press, Release
from seiswidgets.interaction.keyboard import press_key
from seiswidgets.interaction.mouse import CTRL, double_click, move, press, release
from seiswidgets.interaction.piece_commands import Command
from seiswidgets.interaction.projection import PaneProjection
from seiswidgets.interaction.viewport import Viewport


class PickEditor:
    """The state machine: ``handle`` gestures, read ``state``.

    The document belongs to the history; the editor adds the mode, the selection, the keyboard cursor and the drag.

    Parameters
    ----------
    history : EditHistory
    viewport : Viewport
        View of the present-day section; set it whenever it changes.
    snap, follow : optional
        As for `Tools`; may be set.
    """

    def __init__(
        self,
        history: EditHistory,
        viewport: Viewport,
        *,
        snap: Callable[[Point], Point] | None = None,
        follow: Callable[[Point, Point], np.ndarray] | None = None,
    ):
        self.history, self.viewport, self.snap, self.follow = history, viewport, snap, follow
        self._state = EditorState(history.document)
        self._before_press = history.document

    @property
    def state(self) -> EditorState:
        """The present document with the mode, the selection, the cursor and the drag."""
        document = self.history.document
        return self._state if document is self._state.document else self._state.change(document=document)

    @property
    def drawing(self) -> Drawing:
        """All picks, the draft line included."""
        return self.history.document.drawing

    @property
    def interpretation(self) -> Interpretation:
        """Picks that are finished and valid; the same object as long as the picks do not change."""
        return self.drawing.interpretation

    @property
    def problems(self) -> list[tuple[str, str]]:
        """Name and message for each line that is kept but cannot be used."""
        return self.drawing.problems

    @property
    def rubber_band(self) -> Point | None:
        """Start of the line to the pointer; None if there is no draft line."""
        draft = self.drawing.draft
        return draft.points[-1] if draft else None

    def cutoffs(self) -> tuple[CutOffHandle, ...]:
        """Cut-offs of visible horizons at visible faults."""
        return self.history.document.cutoffs

    def handle(self, gesture: Gesture) -> bool:
        """Handle a gesture; return False if it was not consumed, so that the pane may pan, fit, or pass it on."""
        match gesture:
            case Key():
                return self._handle_key(gesture)
            case Move() if self.state.drag is None:
                free = "shift" in gesture.modifiers
                self._state = self.state.with_preview(gesture.point, self._tools, free=free)
                return False
            case Move():
                return self._become(move(self.state, gesture, self._tools))
            case Press():
                self.settle()
                self._before_press = self.history.document
                return self._become(press(self.state, gesture, self._tools))
            case DoubleClick():
                self.settle()
                return self._become(double_click(self.state, gesture, self._tools))
            case Release():
                return self._handle_release(gesture)

    def change(self, transition: Callable[[EditorState], EditorState]) -> None:
        """Change to another state as one edit."""
        self.settle()
        self._become(transition(self.state))

    def command(self, command: Command, target: PickSelection | None = None) -> None:
        """Carry out a command on what is selected, or on a target, as one edit; PickError if it cannot be."""
        self.settle()
        state = self.state if target is None else self.state.change(selection=target)
        self._become(command(state, self._tools))

    def click_hint(self, pointer: Move) -> str:
        """Describe the effect of a click at the pointer."""
        return click_hint(self.state, pointer, self._tools)

    def enter(self, mode: str) -> None:
        """Change the mode; a draft line is finished, or dropped (undo brings it back) if it is a single point."""
        if mode not in MODES:
            raise SettingError(f"mode must be one of {', '.join(MODES)}, but is {mode!r}")
        self.settle()
        self._become(self.state.enter(mode, self._tools))

    def undo(self) -> bool:
        """Undo the last edit; False if there is none."""
        return self._travel(self.history.undo)

    def redo(self) -> bool:
        """Redo the edit that was undone last; False if there is none."""
        return self._travel(self.history.redo)

    def add(self, point: Point) -> None:
        """Add a vertex to the draft line, or begin one."""
        self.settle()
        self._become(self.state.add(point, self._tools, PaneProjection(self.viewport)))

    def finish(self) -> None:
        """Turn the draft line into a pick, or a piece of one, and select it; a single point stays a draft."""
        self._become(self.state.finish(self._tools))

    def select(self, kind: str, name: str) -> None:
        """Select a pick; PickError if there is none of that name."""
        self.settle()
        self.drawing.pick(kind, name)
        self._become(self.state.change(selection=PickSelection(kind, name)))

    def deselect(self) -> None:
        """Select nothing: the next line begun in horizon mode is a new horizon."""
        self.settle()
        self._become(self.state.change(selection=None))

    def rename(self, kind: str, name: str, new: str) -> None:
        """Rename a pick; a horizon given the name of another becomes pieces of it. PickError if that fails."""
        self._draw(f"rename {name}", self.drawing.with_name(kind, name, new), PickSelection(kind, str(new).strip()))

    def recolour(self, kind: str, name: str, colour: str) -> None:
        """Give a pick a colour, "#rrggbb" or the name of one."""
        self._draw(f"colour of {name}", self.drawing.with_colour(kind, name, colour))

    def show(self, kind: str, name: str, visible: bool = True) -> None:
        """Show or hide a pick."""
        self._draw(f"{'show' if visible else 'hide'} {name}", self.drawing.with_visibility(kind, name, visible))

    def use(self, kind: str, name: str, use: str) -> None:
        """Let a pick constrain the restoration, only carry it along, or ignore it."""
        self._draw(f"{use} {name}", self.drawing.with_use(kind, name, use))

    def ends(self, name: str, ends: Ends) -> None:
        """Say of each end of a fault whether it dies out, reaches on, or is judged by its distance."""
        self._draw(f"ends of {name}", self.drawing.with_ends(name, ends))

    def body_kind(self, kind: str, name: str, body: str) -> None:
        """Say whether a body is salt or an area without data."""
        self._draw(f"{body} in {name}", self.drawing.with_body_kind(name, body))

    def delete(self, kind: str, name: str) -> None:
        """Delete a pick; undo brings it back."""
        self._draw(f"delete {name}", self.drawing.without_pick(kind, name))

    def load(self, interpretation: Interpretation) -> None:
        """Replace the finished picks by those of an interpretation, unless it is shown already."""
        if interpretation is not self.interpretation:
            self.settle()
            self._draw("new picks", self.drawing.with_interpretation(interpretation))

    def hold(self, point: Point | None) -> None:
        """Hold the block that a point lies in; with None, hold no block."""
        if point != self.state.fixed:
            self.settle()
            self._become(self.state.hold(None if point is None else self._tools.inside(point)), "held point")

    def reset(self) -> None:
        """Drop the selection, the cursor and the drag, as when another document is opened."""
        self._state = EditorState(self.history.document, self._state.mode).change()

    def settle(self) -> None:
        """End a drag, which becomes an edit."""
        if self.state.drag:
            self._become(self.state.settle())

    @property
    def _tools(self) -> Tools:
        return Tools(self.viewport, self.snap, self.follow)

    def _handle_key(self, gesture: Key) -> bool:
        name, modifiers = gesture.name.lower(), gesture.modifiers
        if gesture.name != "Escape":
            self.settle()
        if modifiers & CTRL and "alt" not in modifiers and name in ("y", "z"):
            (self.redo if name == "y" or "shift" in modifiers else self.undo)()
            return True  # even where there is nothing to undo, or the notebook would undo something of its own
        return self._become(press_key(self.state, gesture, self._tools))

    def _handle_release(self, gesture: Release) -> bool:
        consumed = self._become(release(self.state, gesture, self._tools))
        if gesture.cancelled and not consumed and self.history.document is not self._before_press:
            self.undo()
        return consumed

    def _draw(self, label: str, drawing: Drawing, selection: PickSelection | None = None) -> None:
        self.settle()
        self._become(self.state.draw(drawing, selection or self.state.selection), label)

    def _become(self, state: EditorState | None, label: str = "") -> bool:
        """Change to a state, and record an edit unless a drag is in progress; False if there is no new state."""
        if state is None:
            return False
        before = self.state
        selection = before.drag.selection if before.drag else before.selection
        self._state = state
        changes = {"drawing": state.document.drawing, "plan": state.document.plan}
        if state.drag:
            self.history.amend(**changes)
        else:
            self.history.edit(label or state.action, selection, **changes)
            if before.drawing.draft and not state.drawing.draft and state.drawing == before.finish(self._tools).drawing:
                self.history.close_draft(_closed)
        return True

    def _travel(self, travel: Callable[[PickSelection | None], Entry | None]) -> bool:
        self.settle()
        entry = travel(self.state.selection)
        if entry is None:
            return False
        self._state = self._state.change(document=entry.document, selection=entry.selection)
        return True


def _closed(document: Document) -> tuple[Document, PickSelection | None]:
    """Finish the draft line of a document, or drop it if it is a single point; select its pick."""
    state = EditorState(document).finish()
    state = state.cancel() if state.drawing.draft else state
    return state.document, state.selection
