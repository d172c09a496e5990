"""A pane to draw faults and horizons in, with its tools and the list of picks."""

from collections.abc import Callable, Iterable
from functools import partial
from typing import Any

from ipywidgets import BoundedFloatText, Box, Button, Dropdown, HBox, Layout, ToggleButton, ToggleButtons, VBox
from traitlets import Any as AnyTrait
from traitlets import Bool, Bunch, Enum, Float, Instance, observe, validate

from seiswidgets.geology import validation
from seiswidgets.geology.bodies import BODY
from seiswidgets.geology.findings import Finding, worst_first
from seiswidgets.geology.picks import FAULT, HORIZON, Interpretation
from seiswidgets.geology.section import Section
from seiswidgets.interaction.click_hints import HELP
from seiswidgets.interaction.context_menu import menu_items
from seiswidgets.interaction.document import Document, Entry
from seiswidgets.interaction.drawing import Drawing, Point
from seiswidgets.interaction.editor import PickEditor
from seiswidgets.interaction.editor_state import BLOCK, LOOK, MODES, MOVE
from seiswidgets.interaction.gestures import Gesture, Move, Press
from seiswidgets.interaction.scene import Ghost, ghost_strokes, marks, rubber_band, strokes
from seiswidgets.interaction.snapping import EVENTS, follow_event, snap_to_event
from seiswidgets.widgets.binding import bind, bind_control
from seiswidgets.widgets.closing import WithParts
from seiswidgets.widgets.flags import flags
from seiswidgets.widgets.help import ClickLine, GestureHelp
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
    *"lfhsmbicjxreLFHSMBICJXRE",
    *ARROWS,
    *(f"Ctrl+{key}" for key in (*ARROWS, "z", "Z", "y", "Y")),
)
MODE_LABELS = {
    LOOK: ("Look", "Zoom and pan; click a line to select it (L)"),
    FAULT: ("Fault", "Click along a fault; double click or press Enter to finish it (F)"),
    HORIZON: ("Horizon", "Click along a horizon; double click or press Enter to finish a piece of it (H)"),
    BODY: ("Body", "Click around salt or an area without data; double click or press Enter to close it (S)"),
    MOVE: ("Move", "Drag a line, or its cut-off along the fault; Shift+click or a rectangle select several (M)"),
    BLOCK: (
        "Hold",
        "Click in the block to hold, or Shift+click a point to pin; click a pin to release it (B)",
    ),
}
ACTIONS = {  # icon, action, keys
    "undo": ("undo", "Undo", "Ctrl+Z"),
    "redo": ("repeat", "Redo", "Ctrl+Y"),
    "finish": ("check", "Finish the line", "Enter"),
    "new": ("plus", "Draw the next line as a new horizon", "Escape"),
    "help": ("question", "All gestures and keys", "?"),
}


class Picker(WithParts, VBox):
    """A section on which faults, horizons and bodies are drawn; every edit can be undone.

    In fault, horizon and body mode a click adds a vertex, a double click or Enter finishes the line, Escape drops it;
    vertices and cut-offs can be dragged, and a vertex is removed by Ctrl-click or Delete. All of this works with the
    keyboard too: L, F, H, S, M and B choose the mode, Enter shows a cursor, the arrows move it, and Space puts a vertex
    at it. "?" shows all gestures.

    Parameters
    ----------
    section : Section or SectionPane
        The section to draw on, or the pane that shows it.
    workspace : Workspace, optional
        The owner of the picks; a new one if left out.
    **settings
        Initial values of the attributes.

    Attributes
    ----------
    interpretation : Interpretation
        Picks that are finished and valid; may be set, as an edit that can be undone.
    fixed : (x, z) or None
        A point in the block that is held; may be set.
    mode : {"look", "fault", "horizon", "body", "move", "block"}
    snap : {"off", "peak", "trough", "zero-up", "zero-down"}
        The event that vertices of horizons snap to.
    window : float
        Number of samples that they may move.
    follow : bool
        True if the line between two clicks follows the event.
    dragging : bool
        True during a drag.
    selection : PickSelection or None
        The selected pick, to be observed.
    pane : SectionPane
    toolbar : Box
    help, click_line : GestureHelp, ClickLine
        All gestures and keys, shown on "?"; and what a click will do.
    list : PicksList
    editor : PickEditor

    Raises
    ------
    TypeError
        If a keyword does not exist.
    """

    interpretation = Instance(Interpretation)
    fixed = AnyTrait(None, allow_none=True)
    mode = Enum(MODES, LOOK)
    snap = Enum((OFF, *EVENTS), OFF)
    window = Float(5.0)
    follow = Bool(False)
    dragging = Bool(False)
    selection = AnyTrait(None, allow_none=True)

    def __init__(self, section: Section | SectionPane, *, workspace: Workspace | None = None, **settings: Any):
        self.check_settings(settings)
        self.pane = section if isinstance(section, SectionPane) else SectionPane(section)
        self.workspace = workspace or Workspace(self.pane.section)
        self.editor = PickEditor(self.workspace.history, self.pane.view)
        self._others: list[SectionPane] = []
        self._drawn: dict[SectionPane, tuple[object, ...]] = {}
        self._messages: dict[str, tuple[str, str]] = {}
        self._findings: tuple[Finding, ...] = ()
        self._ghosts: tuple[Ghost, ...] = ()
        self._finding_listeners: list[Callable[[Finding], None]] = []
        self._hover: Move | None = None  # the pointer's last move over a pane
        self.help, self.click_line = GestureHelp(), ClickLine(self._click_hint)
        self.list = PicksList(self.editor, self.refresh)
        self.buttons = {name: self._button(name) for name in ACTIONS}
        self.toolbar = self._make_toolbar()
        parts = [self.toolbar, self.help, self.pane, self.click_line, self.list]
        super().__init__([KeyGuard(self.hotkeys), *parts])
        self.add_class("seiswidgets-picker")
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
        """All picks with their looks, invalid ones included, and the draft line."""
        return self.workspace.drawing

    @property
    def hotkeys(self) -> dict[str, Callable[[], None]]:
        """Actions of the keys that undo, redo and show the help, wherever the focus is."""
        undo, redo = partial(self._act, "undo"), partial(self._act, "redo")
        return {"Ctrl+z": undo, "Ctrl+Z": redo, "Ctrl+y": redo, "Ctrl+Y": redo, "?": self.help.toggle}

    def attach(self, pane: SectionPane) -> None:
        """Draw in another pane too, by its own projection."""
        if pane is not self.pane:
            self._others.append(pane)
            self.borrowed += (pane,)
        pane.take_keys(KEYS)
        pane.on_gesture(lambda gesture: self.comm is not None and self._handle(gesture))
        pane.on_flag(partial(self._open_flag, pane))
        pane.offer_menu(self._menu)
        self.refresh()

    def show_findings(self, findings: Iterable[Finding]) -> None:
        """Show beside each pick the worst finding about it, and flags on the section, instead of earlier ones."""
        sorted_findings = worst_first(findings)
        self._findings = sorted_findings
        self._messages = {
            finding.pick: (finding.severity, finding.text)
            for finding in reversed(sorted_findings)
            if finding.pick is not None
        }
        self.list.update(self._all_messages())
        for pane in (self.pane, *self._others):
            self._draw(pane)

    def show_ghosts(self, ghosts: Iterable[Ghost]) -> None:
        """Show proposed pieces in all panes instead of earlier ones."""
        self._ghosts = tuple(ghosts)
        self.refresh()

    def on_finding(self, callback: Callable[[Finding], None]) -> None:
        """Call a function with a finding whose flag on the section is clicked."""
        self._finding_listeners.append(callback)

    def _open_flag(self, pane: SectionPane, index: int) -> None:
        """Select the pick that a flag is about."""
        shown = [finding for finding, _ in flags(self._findings, pane.line_projection())]
        if index >= len(shown):
            return  # a newer picture has other flags
        finding = shown[index]
        for pick in self.drawing.picks:
            if pick.name == finding.pick:
                self.editor.select(pick.kind, pick.name)
        self.refresh()
        for listen in self._finding_listeners:
            listen(finding)

    def refresh(self) -> None:
        """Show the editor's state in all panes, in the list and in the toolbar."""
        with UI_LOCK:
            self._show_state()
            self.redraw()

    def redraw(self) -> None:
        """Redraw the lines in the other panes, after their projections have changed."""
        for pane in self._others:
            self._draw(pane)

    def _bind(self) -> None:
        workspace, editor = self.workspace, self.editor
        workspace.observe(self._take_document, "document")
        bind(self, "interpretation", workspace, lambda document: document.drawing.interpretation, editor.load)
        bind(self, "fixed", workspace, lambda document: document.plan.fixed, editor.hold)
        self.pane.observe(lambda change: setattr(self.editor, "viewport", change.new), "view")
        self.observe(lambda change: self._enter(change.new), "mode")

    def _take_document(self, change: Bunch) -> None:
        if isinstance(change.old, Document) and change.old.section is not change.new.section:
            self.editor.reset()
            self._messages = {}
            self._set_snapping()
        self._show_state()  # the other panes follow with the restoration

    def _show_state(self) -> None:
        history, state = self.workspace.history, self.editor.state
        self._draw(self.pane)
        self.list.update(self._all_messages())
        self._show_history("undo", history.next_undo)
        self._show_history("redo", history.next_redo)
        self.buttons["finish"].disabled = state.drawing.draft is None
        self.mode, self.dragging, self.selection = state.mode, state.drag is not None, state.selection
        self.click_line.update()

    def _enter(self, mode: str) -> None:
        self.editor.enter(mode)
        self.refresh()

    def _draw(self, pane: SectionPane) -> None:
        state, projection = self.editor.state, pane.line_projection()
        shown = state, projection.view, projection.restoration, self._findings, self._ghosts
        if self._drawn.get(pane) == shown:
            return
        self._drawn[pane] = shown
        lines = [*strokes(state, projection), *ghost_strokes(self._ghosts, projection)]
        flagged = [flag for _, flag in flags(self._findings, projection)]
        with pane.layer.hold_sync():
            pane.draw_lines(lines, briefly=state.drag is not None)
            pane.draw_marks([*marks(state, projection, self.editor.cutoffs()), *flagged])
            pane.rubber = rubber_band(state, projection)

    def _show_history(self, name: str, entry: Entry | None) -> None:
        _, action, keys = ACTIONS[name]
        self.buttons[name].disabled = entry is None
        self.buttons[name].tooltip = f"{action}: {entry.label} ({keys})" if entry else f"{action} ({keys})"

    def _all_messages(self) -> dict[str, tuple[str, str]]:
        return {**self._messages, **{name: ("problem", text) for name, text in self.editor.problems}}

    def _handle(self, gesture: Gesture) -> bool:
        before = self.editor.state
        if isinstance(gesture, Move):
            self._hover = gesture
        consumed = self.editor.handle(gesture)
        if self.editor.state != before:
            self.refresh()
        elif isinstance(gesture, Move):
            self.click_line.update()
        return consumed

    def _menu(self, event: Press) -> list[tuple[str, Callable[[], object]]]:
        """Items of the context menu; each refreshes what is shown."""

        def act(action: Callable[[], object]) -> None:
            action()
            self.refresh()

        items = [(label, partial(act, action)) for label, action in menu_items(self.editor, event)]
        return [*items, ("All gestures and keys", self.help.toggle)]

    def _click_hint(self) -> str:
        return self.editor.click_hint(self._hover) if self._hover else f"{MODE_LABELS[self.mode][1]}. {HELP}."

    @validate("interpretation")
    def _valid_interpretation(self, proposal: Bunch) -> Interpretation:
        return self.workspace.as_drawn(proposal.value)

    @validate("fixed")
    def _valid_fixed(self, proposal: Bunch) -> Point | None:
        return None if proposal.value is None else validation.held_point(proposal.value)

    @observe("snap", "window", "follow")
    def _set_snapping(self, change: Bunch | None = None) -> None:
        section, event, window = self.workspace.section, self.snap, self.window
        self.editor.snap = self.editor.follow = None
        if event != OFF:
            self.editor.snap = lambda point: snap_to_event(section, point, event, window)
            if self.follow:
                self.editor.follow = lambda start, end: follow_event(section, start, end, event, max(20.0, 4 * window))

    def _make_toolbar(self) -> Box:
        modes = ToggleButtons(
            options=[(label, mode) for mode, (label, _) in MODE_LABELS.items()],
            tooltips=[tooltip for _, tooltip in MODE_LABELS.values()],
            style={"button_width": "auto"},
        )
        snap = Dropdown(
            options=[("no snapping", OFF), *((f"snap to {event}", event) for event in EVENTS)],
            tooltip="Event that the vertices of horizons snap to",
            layout=Layout(width="150px"),
        )
        follow = ToggleButton(
            description="Follow", tooltip="Follow the event between two clicks", layout=Layout(width="auto")
        )
        window = BoundedFloatText(
            min=0.5,
            max=100,
            step=0.5,
            description="± samples",
            tooltip="How far a vertex may move to snap",
            style={"description_width": "initial"},
            layout=Layout(width="116px"),
        )
        for widget, name in ((modes, "mode"), (snap, "snap"), (window, "window"), (follow, "follow")):
            bind_control(self, name, widget)
        tools = [modes, HBox(list(self.buttons.values())), HBox([snap, window, follow])]
        return Box(tools, layout=Layout(display="flex", flex_flow="row wrap", align_items="center", grid_gap="4px 6px"))

    def _begin_horizon(self) -> None:
        self.editor.enter(HORIZON)
        self.editor.deselect()

    def _button(self, name: str) -> Button:
        icon, action, keys = ACTIONS[name]
        button = Button(icon=icon, tooltip=f"{action} ({keys})", layout=Layout(width="36px"))
        button.on_click(lambda _: self._act(name))
        return button

    def _act(self, name: str) -> None:
        editor = self.editor
        actions = {"undo": editor.undo, "redo": editor.redo, "finish": editor.finish, "new": self._begin_horizon}
        actions["help"] = self.help.toggle
        with UI_LOCK:
            actions[name]()
            self.refresh()
