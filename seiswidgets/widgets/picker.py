"""Draw faults and horizons on a section: a pane, its tools, and the list of what is picked."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np
from ipywidgets import BoundedFloatText, Box, Button, Dropdown, HBox, Layout, ToggleButton, ToggleButtons, VBox
from traitlets import Any, Bool, Enum, Float, Instance, observe, validate

from seiswidgets.errors import SettingError
from seiswidgets.geology.picks import Interpretation
from seiswidgets.geology.section import Section
from seiswidgets.interaction.drawing import HORIZON, Drawing
from seiswidgets.interaction.editor import PickEditor
from seiswidgets.interaction.editor_state import BLOCK, LOOK, MODES
from seiswidgets.interaction.gestures import Gesture, Key, Press, Release
from seiswidgets.interaction.projection import PaneProjection
from seiswidgets.interaction.scene import marks, rubber, strokes
from seiswidgets.interaction.snapping import EVENTS, followed, snapped
from seiswidgets.widgets.order import keep_order
from seiswidgets.widgets.panels.picks_list import PicksList
from seiswidgets.widgets.section_view.canvas import LOCK
from seiswidgets.widgets.section_view.pane import SectionPane
from seiswidgets.widgets.ties import tie

OFF = "off"
ARROWS = ("ArrowLeft", "ArrowRight", "ArrowUp", "ArrowDown")
KEYS = (
    *("Enter", "Escape", "Delete", "Backspace", "Insert", "PageUp", "PageDown", " "),
    *"lfhbiLFHBI",
    *ARROWS,
    *(f"Ctrl+{key}" for key in (*ARROWS, "z", "Z", "y", "Y")),
)
MODE_NAMES = {
    LOOK: ("Look", "look, zoom and pan; select a line by clicking on it (L)"),
    "fault": ("Fault", "click along a fault; double click or Enter finishes it (F)"),
    HORIZON: ("Horizon", "click along a horizon; double click or Enter finishes a piece of it (H)"),
    BLOCK: ("Hold", "click into the block that must stay where it is; again to let it go (B)"),
}


class Picker(VBox):
    """A section on which faults and horizons are drawn; every edit can be undone.

    The modes are look, fault, horizon, and hold. In fault and horizon mode a click adds a vertex, a double click or
    Enter finishes the line, Escape drops it; a vertex or a cut-off is dragged, and removed by Ctrl-click or Delete.
    The whole can be done by keyboard: L, F, H, B choose the mode, Enter shows a cursor which the arrows move, Space
    puts a vertex there. The module `seiswidgets.interaction.editor` has the table of all gestures.

    Parameters
    ----------
    section : Section or SectionPane
        What is drawn on, or the pane that shows it.
    **settings
        Initial values of the attributes.

    Attributes
    ----------
    interpretation : Interpretation
        What is drawn; may be set, which can be undone.
    fixed : (x, z) or None
        A point in the block that is held.
    mode : {"look", "fault", "horizon", "block"}
    snap : {"off", "peak", "trough", "zero-up", "zero-down"}
        The event that a horizon's vertices snap to.
    window : float
        How many samples they may move.
    follow : bool
        Whether the line between two clicks follows the event.
    dragging : bool
        Whether something is being dragged.
    drawing : Drawing
        All that is drawn, with its looks, even what is not valid; it follows, but for a drag, which it waits for.
    """

    interpretation = Instance(Interpretation, ())
    fixed = Any(None, allow_none=True)
    mode = Enum(MODES, LOOK)
    snap = Enum((OFF, *EVENTS), OFF)
    window = Float(5.0)
    follow = Bool(False)
    dragging = Bool(False)
    drawing = Instance(Drawing, ())

    def __init__(self, section: Section | SectionPane, **settings):
        self.pane = section if isinstance(section, SectionPane) else SectionPane(section)
        self.editor = PickEditor(self.pane.view)
        self._panes, self._grip, self._complaints, self._quiet = [], None, {}, False
        self._told = self.editor.interpretation
        self.list = PicksList(self.editor, self.refresh)
        self.toolbar = self._made_toolbar()
        super().__init__([self.toolbar, self.pane, self.list])
        keep_order(self)
        self.pane.observe(self._take_view, "view")
        self.attach(self.pane, lambda: PaneProjection(self.pane.view))
        for name, value in settings.items():
            setattr(self, name, value)
        self.editor.forget()
        self.refresh()

    def attach(self, pane: SectionPane, projection: Callable[[], PaneProjection]) -> None:
        """Draw in a further pane too, which shows the section in a way of its own."""
        self._panes.append((pane, projection))
        pane.take_keys(KEYS)
        pane.on_gesture(lambda gesture: self._handle(gesture, projection))
        self.refresh()

    def begin(self, drawing: Drawing) -> None:
        """Start anew with other picks, on the section that the pane shows now; there is nothing to undo then."""
        self.editor.begin(drawing)
        self._grip, self._complaints = None, {}
        self._set_snapping()
        self.refresh()

    def take(self, drawing: Drawing) -> None:
        """Take other picks, with their looks; that can be undone."""
        self.editor.edit(drawing)
        self.refresh()

    def complain(self, text: str) -> None:
        """Say beside a pick what is wrong: the first that the text names is the one that it is about."""
        places = {pick.name: text.find(repr(pick.name)) for pick in self.drawing.picks}
        named = sorted((place, name) for name, place in places.items() if place >= 0)
        self._complaints = {name: text for _, name in named[:1]}
        self.list.update(self._wrong())

    def refresh(self) -> None:
        """Show the editor's state everywhere, first on the present-day section."""
        with LOCK:
            cutoffs = self.editor.cutoffs()
            self._draw(self._panes[:1], cutoffs)
            self.list.update(self._wrong())
            self._undo.disabled, self._redo.disabled = not self.editor.can_undo, not self.editor.can_redo
            self._finish.disabled = self.editor.drawing.draft is None
            self._tell()
            self._draw(self._panes[1:], cutoffs)

    def redraw(self) -> None:
        """Draw the lines anew in the panes that show the section in a way of their own, as that has changed."""
        if not self._quiet:  # else they are drawn in a moment anyway
            self._draw(self._panes[1:], self.editor.cutoffs())

    def _draw(self, panes, cutoffs):
        for pane, projection in panes:
            seen = projection()
            pane.draw_lines(strokes(self.editor, seen))
            pane.draw_marks(marks(self.editor, seen, cutoffs))
            pane.rubber = rubber(self.editor, seen)

    def _tell(self):
        """Let the traits follow the editor."""
        self._quiet = True
        try:
            self.mode, self.dragging = self.editor.state.mode, self.editor.state.drag is not None
            self.fixed = self.editor.drawing.fixed
            if not self.dragging:
                self.drawing = self.editor.drawing
            if self.editor.interpretation is not self._told:
                self.interpretation = self._told = self.editor.interpretation
        finally:
            self._quiet = False

    def _wrong(self):
        return {**self._complaints, **dict(self.editor.problems)}

    def _handle(self, gesture: Gesture, projection):
        """Let the editor do what a gesture asks; during a drag, as the pane was when it began."""
        seen = self._grip or projection()
        if not isinstance(gesture, Key):
            gesture = replace(gesture, point=seen.to_original(gesture.point))
        before = self.editor.state
        used = self.editor.handle(gesture, seen)
        if isinstance(gesture, Press):
            self._grip = seen if self.editor.state.drag else None
        elif isinstance(gesture, Release):
            self._grip = None
        if self.editor.state != before:
            self.refresh()
        return used

    def _take_view(self, change):
        self.editor.view = self.pane.view

    @validate("fixed")
    def _valid_fixed(self, proposal):
        if proposal.value is None:
            return None
        point = np.asarray(proposal.value, float)
        if point.shape != (2,) or not np.isfinite(point).all():
            raise SettingError(f"fixed must be a point (x, z) or None, but is {proposal.value!r}")
        return tuple(point.tolist())

    @observe("interpretation", "fixed", "mode")
    def _take(self, change):
        if self._quiet:
            return
        if change.name == "interpretation":
            self.editor.load(change.new)
            self._told = self.editor.interpretation  # the same as what was set, so that nobody is told twice
        elif change.name == "fixed":
            self.editor.hold(change.new)
        else:
            self.editor.enter(change.new)
        self.refresh()

    @observe("snap", "window", "follow")
    def _set_snapping(self, change=None):
        section, event, window = self.pane.section, self.snap, self.window
        self.editor.snap = self.editor.follow = None
        if event != OFF:
            self.editor.snap = lambda point: snapped(section, point, event, window)
            if self.follow:
                self.editor.follow = lambda start, end: followed(section, start, end, event, max(20.0, 4 * window))

    def _made_toolbar(self):
        modes = ToggleButtons(
            options=[(name, mode) for mode, (name, _) in MODE_NAMES.items()],
            tooltips=[text for _, text in MODE_NAMES.values()],
            style={"button_width": "auto"},
        )
        self._undo = _button("undo", "undo (Ctrl+Z)", self.editor.undo, self.refresh)
        self._redo = _button("repeat", "do again (Ctrl+Y)", self.editor.redo, self.refresh)
        self._finish = _button("check", "finish the line (Enter)", self.editor.finish, self.refresh)
        new = _button("plus", "the next line is a horizon of its own (Escape)", self._begin_horizon, self.refresh)
        snap = Dropdown(
            options=[("no snapping", OFF), *((f"snap to {event}", event) for event in EVENTS)],
            tooltip="what the vertices of horizons snap to",
            layout=Layout(width="150px"),
        )
        follow = ToggleButton(
            description="Follow", tooltip="lines between two clicks follow the event", layout=Layout(width="auto")
        )
        window = BoundedFloatText(
            min=0.5,
            max=100,
            step=0.5,
            description="± samples",
            tooltip="how far a vertex may move to snap",
            style={"description_width": "initial"},
            layout=Layout(width="132px"),
        )
        for widget, name in ((modes, "mode"), (snap, "snap"), (window, "window"), (follow, "follow")):
            tie(self, name, widget)
        tools = [modes, HBox([self._undo, self._redo, self._finish, new]), HBox([snap, window, follow])]
        return Box(
            tools, layout=Layout(display="flex", flex_flow="row wrap", align_items="center", grid_gap="4px 10px")
        )

    def _begin_horizon(self):
        self.editor.enter(HORIZON)
        self.editor.deselect()


def _button(icon, tooltip, action, after):
    def act(_):
        with LOCK:
            action()
            after()

    button = Button(icon=icon, tooltip=tooltip, layout=Layout(width="36px"))
    button.on_click(act)
    return button
