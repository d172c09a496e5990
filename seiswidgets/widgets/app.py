"""The restoration app: draw on a section, restore it, and inspect the result."""

from collections.abc import Callable, Sequence
from functools import cached_property, partial
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import traitlets
from ipywidgets import Box, Layout, Tab, VBox, Widget, jslink
from traitlets import Bool, Bunch, Instance, Tuple, dlink, link, validate

from seiswidgets.geology import validation
from seiswidgets.geology.findings import Finding
from seiswidgets.geology.hypothesis import Hypothesis
from seiswidgets.geology.picks import Interpretation
from seiswidgets.geology.plan import Plan
from seiswidgets.geology.restoration import Restoration
from seiswidgets.geology.section import Section
from seiswidgets.geology.weights import Weights
from seiswidgets.interaction.drawing import Drawing
from seiswidgets.interaction.gestures import Gesture, Key
from seiswidgets.io.session.sources import SectionSource
from seiswidgets.widgets.binding import bind
from seiswidgets.widgets.closing import WithParts, close_with_parts
from seiswidgets.widgets.files.file_panel import FilePanel
from seiswidgets.widgets.files.session_bar import SessionBar
from seiswidgets.widgets.files.start_page import StartPage
from seiswidgets.widgets.histogram import DeformationHistogram
from seiswidgets.widgets.ipykernel_compat import keep_order
from seiswidgets.widgets.key_guard import KeyGuard
from seiswidgets.widgets.layout import Divider, MaximiseButton
from seiswidgets.widgets.linked_panes import LinkedPanes, Reading
from seiswidgets.widgets.live_restoration import LiveRestoration
from seiswidgets.widgets.names import Names
from seiswidgets.widgets.offers import offers
from seiswidgets.widgets.panels.analysis import Analysis
from seiswidgets.widgets.panels.controls import DisplayControls, SolverControls
from seiswidgets.widgets.panels.reports import Reports
from seiswidgets.widgets.panels.step_list import StepList
from seiswidgets.widgets.panels.stratigraphy import StratigraphyPanel
from seiswidgets.widgets.panels.weight_sliders import WeightSliders
from seiswidgets.widgets.picker import Picker
from seiswidgets.widgets.stage_strip import StageStrip
from seiswidgets.widgets.status_bar import StatusBar
from seiswidgets.widgets.timeline import Timeline
from seiswidgets.widgets.workspace import Workspace

WORKING = ("match", "analysis", "files", "hypotheses_panel", "uncertainty_panel")  # pages that work in the background
if TYPE_CHECKING:
    from seiswidgets.widgets.match_panel import MatchPanel
    from seiswidgets.widgets.panels.hypotheses import HypothesesPanel
    from seiswidgets.widgets.panels.uncertainty import UncertaintyPanel

PATIENCE = 10.0  # seconds that a closing app waits for its threads to end


class RestorationApp(WithParts, VBox):
    """Draw faults and horizons on a section, restore it, and inspect the deformation.

    The present-day section is on the left, the restored one on the right; lines can be drawn in either. While something
    is dragged, the section is restored as it moves, on a coarse mesh; on the full mesh, once the mouse button is
    released. Set ``app.section`` to continue with another section, or ``app.session_path`` to save the work elsewhere.

    Parameters
    ----------
    section : Section, optional
        If left out, the app opens on a start page: open or drop a file, continue a session, or take a built-in section.
    interpretation : Interpretation, optional
        Picks to start with.
    fixed : (x, z), optional
        A point in the block that stays where it is.
    height : int, optional
        Height of each pane, in css pixels. If left out, the app is as high as most of the browser's window.
    session : path, optional
        A file ``folder/name.json`` to save the work in after each edit, as `Autosave` does; earlier work found there is
        offered. If left out, no file is written until one is chosen in the tab File.
    source : SectionSource, optional
        Origin of the section. If left out, a session saves the section beside its own file.
    **settings
        Initial values of the other attributes.

    Attributes
    ----------
    interpretation : Interpretation
    fixed : (x, z) or None
    weights : Weights
    steps : tuple of Step
        Steps of the restoration, in order.
    live : bool
        Whether the section is restored after each change; if not, press Restore.
    restoration : Restoration
        The newest restoration on the full mesh. All attributes may be set, and observed.
    start_page : StartPage or None
        None once a section is open.
    panes, picker, histogram, sliders : LinkedPanes, Picker, DeformationHistogram, WeightSliders
        Parts of the app.
    timeline, strip : Timeline, StageStrip
        Parts of the app.

    Raises
    ------
    SettingError
        If a setting is out of its range, or a restoration of another section is set.
    TypeError
        If a setting does not exist.
    DataError
        If the session's folder does not exist, or edits of an earlier section cannot be saved.
    """

    interpretation = Instance(Interpretation, ())
    fixed = traitlets.Any(None, allow_none=True)
    weights = Instance(Weights, ())
    steps = Tuple()
    live = Bool(True)
    restoration = Instance(Restoration)

    def __init__(
        self,
        section: Section | None = None,
        interpretation: Interpretation | None = None,
        *,
        fixed: tuple[float, float] | None = None,
        height: int | None = None,
        session: str | PathLike | None = None,
        source: SectionSource | None = None,
        **settings: Any,
    ):
        self.check_settings(settings)
        if source is not None:
            validation.checked_kind(source, SectionSource, "source")
        plan = Plan(fixed=fixed, **{name: settings.pop(name) for name in ("steps", "weights") if name in settings})
        drawing = Drawing().with_interpretation(interpretation or Interpretation())
        self.workspace = Workspace(section or Section(np.zeros((2, 2)), 1.0, 1.0, name="none"), drawing, plan, source)
        self._make_parts(height)
        self.start_page = None if section else StartPage(self.workspace, self.session_bar.keep_newest)
        start = [self.start_page, self.session_bar, Names(), KeyGuard()] if self.start_page else None
        super().__init__(start or self._arrange())
        self.add_class("seiswidgets-app")
        if height is None:
            self.add_class("seiswidgets-fills")
        keep_order(self)
        self._bind()
        for name, value in settings.items():
            setattr(self, name, value)
        self.restoring.update()
        self.session_path = session

    @property
    def section(self) -> Section:
        """The section to restore. If another is set, picks that lie on it too are kept; undo brings the first back."""
        return self.workspace.section

    @section.setter
    def section(self, section: Section) -> None:
        kept = self.workspace.drawing if self.workspace.picks_fit(section) else Drawing()
        self.workspace.open(section, kept)

    @property
    def source(self) -> SectionSource | None:
        """Origin of the section."""
        return self.workspace.source

    @property
    def session_path(self) -> Path | None:
        """Path under which the work is saved, None if it is not; may be set."""
        return self.workspace.session_path

    @session_path.setter
    def session_path(self, path: str | PathLike | None) -> None:
        self.session_bar.keep(path)

    @property
    def plan(self) -> Plan:
        """The steps and choices of the restoration."""
        return self.workspace.plan

    @cached_property
    def sliders(self) -> WeightSliders:
        """Page of the tab Weights, made when it is first opened."""
        sliders = WeightSliders()
        link((self, "weights"), (sliders, "weights"))
        return sliders

    @cached_property
    def step_list(self) -> StepList:
        """Page of the tab Steps, made when it is first opened."""
        step_list = StepList()
        dlink((self.workspace, "document"), (step_list, "z_unit"), lambda document: document.section.z_unit)
        link((self, "interpretation"), (step_list, "interpretation"))
        link((self, "steps"), (step_list, "steps"))
        return step_list

    @cached_property
    def analysis(self) -> Analysis:
        """Page of the tab Analysis, made when it is first opened."""
        return Analysis(self.workspace)

    @cached_property
    def match(self) -> "MatchPanel":
        """Page of the tab Match, made when it is first opened."""
        from seiswidgets.widgets.match_panel import MatchPanel  # imports scipy.signal

        return MatchPanel(self.picker)

    @cached_property
    def files(self) -> FilePanel:
        """Page of the tab File, made when it is first opened."""
        files = FilePanel(self.workspace, self.session_bar)
        dlink((self.panes, "span"), (files.results, "span"))
        return files

    @cached_property
    def hypotheses_panel(self) -> "HypothesesPanel":
        """Page of the tab Hypotheses, made when it is first opened."""
        from seiswidgets.widgets.panels.hypotheses import HypothesesPanel  # imports matplotlib's figures

        return HypothesesPanel(self.workspace)

    @cached_property
    def uncertainty_panel(self) -> "UncertaintyPanel":
        """Page of the tab Uncertainty, made when it is first opened."""
        from seiswidgets.widgets.panels.uncertainty import UncertaintyPanel  # imports what runs processes

        panel = UncertaintyPanel(self.workspace, self.panes)
        panel.observe(lambda change: self.reports.show_errors(change.new), "ensemble")
        return panel

    @property
    def hypotheses(self) -> tuple[Hypothesis, ...]:
        """All hypotheses, in their order; if others are set, the first of them is shown."""
        return self.workspace.hypotheses

    @hypotheses.setter
    def hypotheses(self, hypotheses: Sequence[Hypothesis]) -> None:
        self.workspace.load_hypotheses(hypotheses)

    @property
    def colours(self) -> dict[tuple[str, str], str]:
        """Colour of each pick, by its kind and name, for figures of `plot`."""
        return self.workspace.drawing.colours

    def restore(self) -> None:
        """Restore on the full mesh now, in the background; the verdict, or an error, appears above the panes."""
        self.restoring.restore()

    def cancel(self) -> None:
        """Cancel the restoration in progress; the earlier one stays."""
        self.restoring.cancel()

    def wait(self, timeout: float | None = None) -> bool:
        """Wait until all background work is done, as in a script; False after the timeout in seconds."""
        pages = self._working()  # what they open is restored, and what is restored is measured
        return all(part.wait(timeout) for part in (*pages, self.session_bar, self.restoring, *pages))

    def close(self) -> None:
        """Stop background work, save unsaved edits, remove the app from the page, and free its memory.

        Every part is closed, and the memory is freed as soon as nothing else refers to the app: in a notebook, that is
        your own variables and what IPython keeps of earlier outputs (``%reset -f out``). Running a cell again does not
        close the app that it showed before; close that one first.
        """
        if self.comm is None:  # closed already, or never opened
            return
        self.restoring.stop()
        for panel in self._working():
            panel.end()
        self.wait(PATIENCE)
        try:
            self.session_bar.end()
        finally:
            super().close()

    def _working(self) -> list[Any]:
        """The start page and the pages of tabs that work in the background, if they have been opened."""
        opened = [self.start_page] if self.start_page else []
        return opened + [getattr(self, name) for name in WORKING if name in vars(self)]

    def _make_parts(self, height: int | None) -> None:
        workspace = self.workspace
        self.panes = LinkedPanes(workspace.section, height=height, deformation=0.5)
        self.picker = Picker(self.panes.original, workspace=workspace)
        self.picker.attach(self.panes.restored)
        self.histogram = DeformationHistogram()
        self.solving = SolverControls(workspace)
        self.timeline, self.strip = Timeline(), StageStrip(self.panes.picture)
        self._strip_link = jslink((self.timeline.slider, "value"), (self.strip, "frame"))
        self.status = StatusBar(self.restore, self.cancel, partial(offers, workspace))
        self.reports = Reports()
        self.divider, self.maximise_button = Divider(), MaximiseButton()
        self.session_bar = SessionBar(workspace)
        self.restoring = LiveRestoration(self.picker, self.panes, self.status, self.timeline, self.histogram)
        self.tabs = LazyTabs(
            Picks=lambda: self.picker.list,
            Weights=lambda: self.sliders,
            Steps=lambda: self.step_list,
            Stratigraphy=lambda: StratigraphyPanel(workspace),
            Match=lambda: self.match,
            Solver=lambda: self.solving,
            Display=lambda: DisplayControls(self.panes),
            Report=lambda: self.reports,
            Analysis=lambda: self.analysis,
            Hypotheses=lambda: self.hypotheses_panel,
            Uncertainty=lambda: self.uncertainty_panel,
            File=lambda: self.files,
        )

    def _arrange(self) -> list[Widget]:
        below = Box([VBox([self.timeline, self.strip, self.histogram, self.session_bar.news]), self.tabs])
        below.add_class("seiswidgets-below")
        self.picker.toolbar.children += (self.status.buttons, self.maximise_button)
        self.panes.foot.children = (self.picker.click_line, self.panes.readout)
        above = [self.picker.toolbar, self.picker.help, self.status, self.session_bar]
        return [*above, self.panes, self.divider, below, Names(), KeyGuard(self._hotkeys)]

    @property
    def _hotkeys(self) -> dict[str, Callable[[], None]]:
        step = self.workspace.step_hypothesis
        return {**self.picker.hotkeys, "n": partial(step, 1), "N": partial(step, -1)}

    def _bind(self) -> None:
        workspace, editor = self.workspace, self.picker.editor
        bind(self, "interpretation", workspace, lambda document: document.drawing.interpretation, editor.load)
        bind(self, "fixed", workspace, lambda document: document.plan.fixed, editor.hold)
        bind(self, "weights", workspace, lambda document: document.plan.weights, self._change_weights)
        bind(self, "steps", workspace, lambda document: document.plan.steps, self._change_steps)
        link((workspace, "restoration"), (self, "restoration"))
        link((self, "live"), (self.status, "live"))
        for name in ("brush", "span"):
            link((self.histogram, name), (self.panes, name))
        workspace.observe(lambda change: self.reports.show(change.new), "restoration")
        workspace.observe(lambda change: self.strip.show(change.new), "restoration")
        workspace.observe(self._take_section, "document")
        self.panes.on_reading(self._mark)
        self.picker.on_finding(self._open_finding)
        for pane in (self.panes.original, self.panes.restored):
            pane.on_gesture(self._leave_full_window)

    @validate("interpretation")
    def _valid_interpretation(self, proposal: Bunch) -> Interpretation:
        return self.workspace.as_drawn(proposal.value)

    def _change_weights(self, weights: Weights) -> None:
        self.workspace.change_plan("weights", weights=weights)

    def _change_steps(self, steps: tuple) -> None:
        self.workspace.change_plan("steps", steps=steps)

    def _take_section(self, change: Bunch) -> None:
        """Bring another section into view, and leave the start page."""
        if change.old.section is change.new.section:
            return
        if self.start_page is not None:
            self.start_page.end()
            self.start_page, page = None, self.start_page
            self.children = self._arrange()
            close_with_parts(page)
            self.workspace.history.forget()  # there is nothing before the first section
            self.picker.refresh()
        self.panes.original.layer.send({"kind": "show"})

    def _leave_full_window(self, gesture: Gesture) -> bool:
        """Let Escape, where the picker has no use for it, bring the app back from the full window to the page."""
        if isinstance(gesture, Key) and gesture.name == "Escape":
            self.maximise_button.leave()
        return False

    def _open_finding(self, finding: Finding) -> None:
        """Show a finding in the status line, and its pick in the list."""
        self.status.tell(finding)
        self.tabs.selected_index = 0

    def _mark(self, reading: Reading | None) -> None:
        ratio = reading.ratio if reading else np.nan
        self.histogram.mark = float(ratio) if np.isfinite(ratio) else None

    def _repr_mimebundle_(self, **kwargs: Any) -> dict[str, Any]:
        """Add a picture of what the app shows, for readers without a kernel."""
        bundle = super()._repr_mimebundle_(**kwargs)
        return bundle and {**bundle, "image/png": self.panes.still()}


class LazyTabs(Tab):
    """Tabs whose pages are made when they are first opened, so that the app appears sooner.

    Parameters
    ----------
    **pages : callable() -> Widget
        Functions that make the pages, by the titles of the tabs.
    """

    def __init__(self, **pages: Callable[[], Widget]):
        self._make_page = list(pages.values())
        super().__init__([VBox() for _ in pages], titles=list(pages), layout=Layout(min_width="0"))
        self.add_class("seiswidgets-pages")
        self.observe(lambda change: self._open(change.new), "selected_index")
        self._open(0)

    def _open(self, index: int | None) -> None:
        if index is not None and not self.children[index].children:
            self.children[index].children = [self._make_page[index]()]
