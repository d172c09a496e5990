"""Draw faults and horizons on a section: a pane, its tools, and the list of picks."""

from collections.abc import Callable, Iterable

from ipywidgets import BoundedFloatText, Box, Button, Dropdown, HBox, Layout, ToggleButton, ToggleButtons, VBox
from traitlets import Any, Bool, Enum, Float, Instance, observe, validate

from seiswidgets.geology import validation
from seiswidgets.geology.findings import Finding, worst_first
from seiswidgets.geology.picks import HORIZON, Interpretation
from seiswidgets.geology.section import Section
from seiswidgets.interaction.document import Document
from seiswidgets.interaction.drawing import Drawing
from seiswidgets.interaction.editor import PickEditor
from seiswidgets.interaction.editor_state import BLOCK, LOOK, MODES
from seiswidgets.interaction.gestures import Gesture
from seiswidgets.interaction.scene import marks, rubber_band, strokes
from seiswidgets.interaction.snapping import EVENTS, follow_event, snap_to_event
from seiswidgets.widgets.binding import bind, bind_control
from seiswidgets.widgets.closing import WithParts
from seiswidgets.widgets.ipykernel_compat import keep_order
from seiswidgets.widgets.jobs import UI_LOCK
from seiswidgets.widgets.key_guard import KeyGuard
from seiswidgets.widgets.panels.picks_list import PicksList
from seiswidgets.widgets.section_view.pane import SectionPane
from seiswidgets.widgets.workspace import Workspace

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


class Picker(WithParts, VBox):
    """A section on which faults and horizons are drawn; every edit can be undone.

    The modes are look, fault, horizon, and hold. In fault and horizon mode a click adds a vertex, a double click or
    Enter finishes the line, Escape drops it; a vertex or a cut-off is dragged, and removed by Ctrl-click or Delete.
    Everything can be done by keyboard: L, F, H, B choose the mode, Enter shows a cursor which the arrows move, Space
    puts a vertex there. The module `seiswidgets.interaction.editor` has the table of all gestures.

    Parameters
    ----------
    section : Section or SectionPane
        The section to draw on, or the pane that shows it.
    workspace : Workspace, optional
        The owner of what is drawn; one of its own if left out.
    **settings
        Initial values of the attributes.

    Attributes
    ----------
    interpretation : Interpretation
        Picks that are finished and valid; may be set, which can be undone.
    fixed : (x, z) or None
        A point in the block that is held.
    mode : {"look", "fault", "horizon", "block"}
    snap : {"off", "peak", "trough", "zero-up", "zero-down"}
        The event that a horizon's vertices snap to.
    window : float
        Number of samples that they may move.
    follow : bool
        Whether the line between two clicks follows the event.
    dragging : bool
        Whether something is being dragged.
    """

    interpretation = Instance(Interpretation)
    fixed = Any(None, allow_none=True)
    mode = Enum(MODES, LOOK)
    snap = Enum((OFF, *EVENTS), OFF)
    window = Float(5.0)
    follow = Bool(False)
    dragging = Bool(False)

    def __init__(self, section: Section | SectionPane, *, workspace: Workspace | None = None, **settings):
        self.pane = section if isinstance(section, SectionPane) else SectionPane(section)
        self.workspace = workspace or Workspace(self.pane.section)
        self.editor = PickEditor(self.workspace.history, self.pane.view)
        self._others: list[SectionPane] = []
        self._drawn: dict[SectionPane, tuple] = {}
        self._complaints: dict[str, tuple[str, str]] = {}
        self.list = PicksList(self.editor, self.refresh)
        self.toolbar = self._made_toolbar()
        super().__init__([KeyGuard(), self.toolbar, self.pane, self.list])
        keep_order(self)
        self._bind()
        self.attach(self.pane)
        self.borrowed = (section,) if isinstance(section, SectionPane) else ()
        for name, value in settings.items():
            setattr(self, name, value)
        self.workspace.history.forget()
        self.refresh()

    @property
    def drawing(self) -> Drawing:
        """All picks with their looks, even those that cannot be used, and the draft line."""
        return self.workspace.drawing

    def attach(self, pane: SectionPane) -> None:
        """Draw in a further pane too, by its own projection."""
        if pane is not self.pane:
            self._others.append(pane)
            self.borrowed += (pane,)
        pane.take_keys(KEYS)
        pane.on_gesture(lambda gesture: self.comm is not None and self._handle(gesture))
        self.refresh()

    def complain(self, error: Exception, severity: str = "problem") -> None:
        """Show an error beside the pick that it is about, instead of earlier findings and complaints."""
        pick = getattr(error, "pick", None)
        self._complain_about({pick: (severity, str(error))} if pick else {})

    def show_findings(self, findings: Iterable[Finding]) -> None:
        """Show beside each pick the worst finding about it, instead of earlier ones and complaints."""
        about = [finding for finding in worst_first(findings) if finding.pick is not None]
        self._complain_about({finding.pick: (finding.severity, finding.text) for finding in reversed(about)})

    def _complain_about(self, complaints):
        self._complaints = complaints
        self.list.update(self._wrong())

    def refresh(self) -> None:
        """Show the editor's state in all panes, in the list and in the toolbar."""
        with UI_LOCK:
            self._show_state()
            self.redraw()

    def redraw(self) -> None:
        """Draw the lines anew in the other panes, whose projections have changed."""
        for pane in self._others:
            self._draw(pane)

    def _bind(self):
        workspace, editor = self.workspace, self.editor
        workspace.observe(self._take_document, "document")
        bind(self, "interpretation", workspace, lambda document: document.drawing.interpretation, editor.load)
        bind(self, "fixed", workspace, lambda document: document.plan.fixed, editor.hold)
        self.pane.observe(lambda change: setattr(self.editor, "viewport", change.new), "view")
        self.observe(lambda change: self._enter(change.new), "mode")

    def _take_document(self, change):
        if isinstance(change.old, Document) and change.old.section is not change.new.section:
            self.editor.reset()
            self._complaints = {}
            self._set_snapping()
        self._show_state()  # other panes follow once the restoration does

    def _show_state(self):
        history, state = self.workspace.history, self.editor.state
        self._draw(self.pane)
        self.list.update(self._wrong())
        self._show_history(self._undo, "undo", history.next_undo, "Ctrl+Z")
        self._show_history(self._redo, "do again", history.next_redo, "Ctrl+Y")
        self._finish.disabled = state.drawing.draft is None
        self.mode, self.dragging = state.mode, state.drag is not None

    def _enter(self, mode):
        self.editor.enter(mode)
        self.refresh()

    def _draw(self, pane):
        state, projection = self.editor.state, pane.projection()
        shown = state, projection.view, projection.restoration
        if self._drawn.get(pane) == shown:
            return
        self._drawn[pane] = shown
        pane.draw_lines(strokes(state, projection))
        pane.draw_marks(marks(state, projection, self.editor.cutoffs()))
        pane.rubber = rubber_band(state, projection)

    def _show_history(self, button, action, entry, keys):
        button.disabled = entry is None
        button.tooltip = f"{action}: {entry.label} ({keys})" if entry else f"{action} ({keys})"

    def _wrong(self):
        return {**self._complaints, **{name: ("problem", text) for name, text in dict(self.editor.problems).items()}}

    def _handle(self, gesture: Gesture) -> bool:
        before = self.editor.state
        consumed = self.editor.handle(gesture)
        if self.editor.state != before:
            self.refresh()
        return consumed

    @validate("interpretation")
    def _valid_interpretation(self, proposal):
        return self.workspace.as_drawn(proposal.value)

    @validate("fixed")
    def _valid_fixed(self, proposal):
        return None if proposal.value is None else validation.held_point(proposal.value)

    @observe("snap", "window", "follow")
    def _set_snapping(self, change=None):
        section, event, window = self.workspace.section, self.snap, self.window
        self.editor.snap = self.editor.follow = None
        if event != OFF:
            self.editor.snap = lambda point: snap_to_event(section, point, event, window)
            if self.follow:
                self.editor.follow = lambda start, end: follow_event(section, start, end, event, max(20.0, 4 * window))

    def _made_toolbar(self):
        modes = ToggleButtons(
            options=[(name, mode) for mode, (name, _) in MODE_NAMES.items()],
            tooltips=[text for _, text in MODE_NAMES.values()],
            style={"button_width": "auto"},
        )
        self._undo = self._button("undo", "undo (Ctrl+Z)", self.editor.undo)
        self._redo = self._button("repeat", "do again (Ctrl+Y)", self.editor.redo)
        self._finish = self._button("check", "finish the line (Enter)", self.editor.finish)
        new = self._button("plus", "the next line is a horizon of its own (Escape)", self._begin_horizon)
        snap = Dropdown(
            options=[("no snapping", OFF), *((f"snap to {event}", event) for event in EVENTS)],
            tooltip="the event that the vertices of horizons snap to",
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
            bind_control(self, name, widget)
        tools = [modes, HBox([self._undo, self._redo, self._finish, new]), HBox([snap, window, follow])]
        return Box(
            tools, layout=Layout(display="flex", flex_flow="row wrap", align_items="center", grid_gap="4px 10px")
        )

    def _begin_horizon(self):
        self.editor.enter(HORIZON)
        self.editor.deselect()

    def _button(self, icon, tooltip, action: Callable[[], object]):
        def act(_):
            with UI_LOCK:
                action()
                self.refresh()

        button = Button(icon=icon, tooltip=tooltip, layout=Layout(width="36px"))
        button.on_click(act)
        return button
