"""The restoration app: draw, restore, look."""

from functools import cached_property
from os import PathLike
from pathlib import Path

import numpy as np
from ipywidgets import GridBox, Layout, VBox
from traitlets import Any, Bool, Instance, Tuple, dlink, link, observe, validate

from seiswidgets.geology import validation
from seiswidgets.geology.picks import Interpretation
from seiswidgets.geology.plan import Plan
from seiswidgets.geology.restoration import Restoration
from seiswidgets.geology.section import Section
from seiswidgets.geology.weights import Weights
from seiswidgets.interaction.document import Document
from seiswidgets.interaction.drawing import Drawing
from seiswidgets.io.session.sources import SectionSource
from seiswidgets.widgets.binding import bind
from seiswidgets.widgets.closing import WithParts
from seiswidgets.widgets.files.file_panel import FilePanel
from seiswidgets.widgets.files.session_bar import SessionBar
from seiswidgets.widgets.histogram import DeformationHistogram
from seiswidgets.widgets.ipykernel_compat import keep_order
from seiswidgets.widgets.key_guard import KeyGuard
from seiswidgets.widgets.linked_panes import LinkedPanes
from seiswidgets.widgets.messages import in_words
from seiswidgets.widgets.names import Names
from seiswidgets.widgets.panels.controls import DisplayControls, SolverControls
from seiswidgets.widgets.panels.pages import Pages
from seiswidgets.widgets.panels.reports import Reports
from seiswidgets.widgets.panels.step_list import StepList
from seiswidgets.widgets.panels.weight_sliders import WeightSliders
from seiswidgets.widgets.picker import Picker
from seiswidgets.widgets.restorer import REST, Restorer
from seiswidgets.widgets.snapshot import Snapshot
from seiswidgets.widgets.status_bar import StatusBar
from seiswidgets.widgets.timeline import Timeline
from seiswidgets.widgets.timeline_player import TimelinePlayer
from seiswidgets.widgets.workspace import Workspace

FIRST = "Draw a fault: choose Fault, click along it, double click to finish. Then draw a horizon on both sides of it."
THEN = "Now choose Horizon and draw one on both sides of the fault; a double click finishes each piece."
CHANGED = "Something has changed since: press Restore."
PATIENCE = 10.0  # seconds that a closing app gives its threads to end
SIDE_BY_SIDE = "repeat(auto-fit, minmax(min(100%, 400px), 1fr))"


class RestorationApp(WithParts, VBox):
    """Draw faults and horizons on a section, restore it, and look at what that took.

    On the left is the present-day section, on the right the restored one; lines can be drawn in either. While something
    is dragged the section is restored as it moves, on a coarse mesh, and on the full mesh when it comes to rest.
    ``app.section`` and ``app.session_path`` may be set to go on with another section, or to keep the work elsewhere.

    Parameters
    ----------
    section : Section
    interpretation : Interpretation, optional
        Picks to start with.
    fixed : (x, z), optional
        A point in the block that stays where it is.
    height : int
        Of each pane, in css pixels.
    session : path, optional
        A file ``folder/name.json`` to keep the work in: it is saved there after every edit (as `Autosave` does), and
        earlier work that is found there is offered. If left out, no file is written until one is chosen in the tab
        File.
    source : SectionSource, optional
        Where the section comes from. If left out, a session keeps the section beside it.
    **settings
        Initial values of the other attributes.

    Attributes
    ----------
    interpretation : Interpretation
    fixed : (x, z) or None
    weights : Weights
    steps : tuple of Step
        What is done in which order.
    live : bool
        Whether every change restores by itself; if not, the button does.
    restoration : Restoration
        The newest on the full mesh. All may be set, and observed.
    panes, picker, histogram, sliders, timeline : LinkedPanes, Picker, DeformationHistogram, WeightSliders, Timeline
        The parts.

    Raises
    ------
    SettingError
        If a setting is out of its range, or a restoration of another section is set.
    DataError
        If the session's folder is not there, or what was drawn on an earlier section cannot be saved.
    """

    interpretation = Instance(Interpretation, ())
    fixed = Any(None, allow_none=True)
    weights = Instance(Weights, ())
    steps = Tuple()
    live = Bool(True)
    restoration = Instance(Restoration)

    def __init__(
        self,
        section: Section,
        interpretation: Interpretation | None = None,
        *,
        fixed: tuple[float, float] | None = None,
        height: int = 400,
        session: str | PathLike | None = None,
        source: SectionSource | None = None,
        **settings,
    ):
        validation.check_keywords("RestorationApp", settings, SETTINGS)
        if source is not None:
            validation.checked_kind(source, SectionSource, "source")
        plan = Plan(fixed=fixed, **{name: settings.pop(name) for name in ("steps", "weights") if name in settings})
        drawing = Drawing().with_interpretation(interpretation or Interpretation())
        self.workspace = Workspace(section, drawing, plan, source)
        self._pressed = False
        self._make_parts(height)
        super().__init__(self._placed())
        self.add_class("seiswidgets-app")
        keep_order(self)
        self._bind()
        for name, value in settings.items():
            setattr(self, name, value)
        self._restore_soon()
        self.session_path = session

    @property
    def section(self) -> Section:
        """The section that is restored. If another is set, picks that lie on it too are kept; undo brings all back."""
        return self.workspace.section

    @section.setter
    def section(self, section: Section):
        kept = self.workspace.drawing if self.workspace.picks_fit(section) else Drawing()
        self.workspace.open(section, kept)

    @property
    def source(self) -> SectionSource | None:
        """Where the section comes from."""
        return self.workspace.source

    @property
    def session_path(self) -> Path | None:
        """Where the work is kept, None if nowhere; may be set."""
        return self.workspace.session_path

    @session_path.setter
    def session_path(self, path: str | PathLike | None):
        self.keeper.keep(path)

    @property
    def plan(self) -> Plan:
        """The steps and choices of the restoration."""
        return self.workspace.plan

    @cached_property
    def sliders(self) -> WeightSliders:
        """The tab Weights, made when it is first opened."""
        sliders = WeightSliders()
        link((self, "weights"), (sliders, "weights"))
        return sliders

    @cached_property
    def step_list(self) -> StepList:
        """The tab Steps, made when it is first opened."""
        step_list = StepList()
        dlink((self.workspace, "document"), (step_list, "z_unit"), lambda document: document.section.z_unit)
        link((self, "interpretation"), (step_list, "interpretation"))
        link((self, "steps"), (step_list, "steps"))
        return step_list

    @cached_property
    def files(self) -> FilePanel:
        """The tab File, made when it is first opened."""
        return FilePanel(self.workspace, self.keeper)

    def restore(self) -> None:
        """Restore on the full mesh now, in the background; the verdict, or what is wrong, is said above the panes."""
        self._pressed = True
        if self._is_possible():
            self.status.show_busy()
            self._restorer.restore(self.workspace.job)

    def cancel(self) -> None:
        """Cancel the restoration in progress; everything stays as it was before."""
        self._restorer.cancel()
        self._set_outdated(True)
        self.status.hint(CHANGED)

    def wait(self, timeout: float | None = None) -> bool:
        """Wait until everything in progress is done, as a script may want; False after the timeout in seconds."""
        return all(part.wait(timeout) for part in (*self._made_files, self.keeper, self._restorer, self._player))

    def close(self) -> None:
        """Stop what is in progress, save what is not saved yet, take the app off the screen, and free its memory.

        Every part is closed, and the memory is freed as soon as nothing else refers to the app: in a notebook, that is
        your own variables and what IPython keeps of earlier outputs (``%reset -f out``). An app whose cell is run again
        is not closed by that; close it first.
        """
        if self.comm is None:  # closed before, or never made
            return
        self._restorer.cancel()
        self._player.cancel()
        for panel in self._made_files:
            panel.end()
        self.wait(PATIENCE)
        try:
            self.keeper.end()
        finally:
            super().close()

    @property
    def _made_files(self):
        """The tab File, if it has been opened."""
        return [self.files] if "files" in vars(self) else []

    def _make_parts(self, height):
        workspace = self.workspace
        self.panes = LinkedPanes(workspace.section, height=height, deformation=0.5)
        self.picker = Picker(self.panes.original, workspace=workspace)
        self.picker.attach(self.panes.restored)
        self.histogram = DeformationHistogram()
        self.solving = SolverControls(workspace)
        self.timeline = Timeline()
        self.status = StatusBar(self.restore, self.cancel)
        self.reports = Reports()
        self.keeper = SessionBar(workspace)
        self._restorer = Restorer(self._draw, self.status.tell, self._fail)
        self._player = TimelinePlayer(self.panes, self.picker.redraw)

    def _placed(self):
        """The parts in their places."""
        below = GridBox(
            [VBox([self.timeline, self.histogram], layout=Layout(min_width="0")), self._tabs()],
            layout=Layout(grid_template_columns=SIDE_BY_SIDE, grid_gap="8px", width="100%"),
        )
        self.picker.toolbar.children = (*self.picker.toolbar.children, self.status.buttons)
        parts = [self.picker.toolbar, self.status, self.keeper, self.panes, self.keeper.news, below]
        return [*parts, Names(), KeyGuard()]

    def _tabs(self):
        return Pages(
            Picks=lambda: self.picker.list,
            Weights=lambda: self.sliders,
            Steps=lambda: self.step_list,
            Solver=lambda: self.solving,
            Display=lambda: DisplayControls(self.panes),
            Report=lambda: self.reports,
            File=lambda: self.files,
        )

    def _bind(self):
        workspace, editor = self.workspace, self.picker.editor
        bind(self, "interpretation", workspace, lambda document: document.drawing.interpretation, editor.load)
        bind(self, "fixed", workspace, lambda document: document.plan.fixed, editor.hold)
        for name in ("weights", "steps"):
            bind(self, name, workspace, _of_plan(name), self._change_of_plan(name))
        link((workspace, "restoration"), (self, "restoration"))
        link((self, "live"), (self.status, "live"))
        link((self.histogram, "brush"), (self.panes, "brush"))
        workspace.observe(self._take_document, "document")
        workspace.observe(self._take_settled, "settled")
        workspace.observe(lambda change: self._take_restoration(), "restoration")
        self.timeline.observe(lambda change: self._player.show(self.restoration, change.new), "time")
        self.panes.on_reading(self._mark)

    @validate("interpretation")
    def _valid_interpretation(self, proposal):
        return self.workspace.as_drawn(proposal.value)

    def _change_of_plan(self, name):
        return lambda value: self.workspace.change_plan(name, **{name: value})

    def _take_document(self, change):
        old, new = change.old, change.new
        if old.section is not new.section:
            self._restorer.forget()
        if _restores_otherwise(old, new):
            self._restore_soon()
        self.picker.redraw()

    @observe("live")
    def _take_live(self, change):
        if self.comm is not None and change.old is not change.new:
            self._restore_soon()

    def _take_settled(self, change):
        if change.new and self.live and self._is_possible():
            self.status.show_busy()
            self._restorer.restore(self.workspace.job)

    def _restore_soon(self):
        """Restore, if changes do so by themselves: a preview at once, the full mesh once nothing changes any more."""
        self._pressed = False
        if not self._is_possible():
            return
        if not self.live:
            self._restorer.cancel()
            self._set_outdated(True)
            self.picker.show_findings(())
            self.status.hint(CHANGED)
            return
        self.status.show_busy()
        if self.restoration.stages:
            self._restorer.preview(self.workspace.job)
        self._restorer.restore(self.workspace.job, REST if self.restoration.stages else 0.0)

    def _is_possible(self):
        """Whether there is something to restore with; if not, say what to do, and show the section as it is."""
        drawn = self.workspace.interpretation
        waits = drawn.faults and not drawn.horizons
        if self.workspace.job.steps and not waits:
            return True
        self._restorer.cancel()
        restoration = Restoration(self.section)
        self._draw(Snapshot.of(restoration), restoration)
        self.status.hint(THEN if waits else FIRST)
        return False

    def _draw(self, snapshot, restoration):
        """Draw a snapshot; without a restoration it is only a preview."""
        self._player.cancel()
        self.panes.show(snapshot)
        if restoration is not None:
            self.workspace.restoration = restoration
        self.picker.show_findings(snapshot.verdict.findings if snapshot.verdict else ())
        self.picker.redraw()
        self._show_verdict(snapshot.verdict, restoration)
        self._set_outdated(False)
        self.histogram.show(snapshot.ratio_before.ratio.ravel() if snapshot.restoration.stages else [])

    def _show_verdict(self, verdict, restoration):
        if verdict is not None:
            self.status.judge(verdict)
        elif restoration is None:
            self.status.show_busy()  # a preview: the full restoration follows
        else:
            self.status.hint("")

    def _take_restoration(self):
        """Show the workspace's restoration, which is drawn already unless it was set from outside."""
        restoration = self.workspace.restoration
        if self.panes.shown.restoration is not restoration:
            self._restorer.cancel()
            self._draw(Snapshot.of(restoration), restoration)
        self.panes.restoration = restoration
        self.timeline.labels = [stage.kind for stage in restoration.stages]
        self.timeline.time = len(restoration.stages)
        self.reports.show(restoration)

    def _fail(self, error):
        """Show an error: as an alert if the user asked for a restoration, as a hint while picks are being drawn."""
        text = in_words(error)
        (self.status.alert if self._pressed else self.status.hint)(text)
        self.picker.complain(error, "problem" if self._pressed else "note")
        self._set_outdated(True)

    def _set_outdated(self, outdated):
        change = self.panes.restored.add_class if outdated else self.panes.restored.remove_class
        change("seiswidgets-outdated")

    def _mark(self, reading):
        ratio = reading.ratio if reading else np.nan
        self.histogram.mark = float(ratio) if np.isfinite(ratio) else None

    def _repr_mimebundle_(self, **kwargs):
        """Beside the app itself a picture of what it shows, for readers without a kernel."""
        bundle = super()._repr_mimebundle_(**kwargs)
        return bundle and {**bundle, "image/png": self.panes.still()}


SETTINGS = ("weights", "steps", "live", "restoration", "layout")


def _of_plan(name):
    return lambda document: getattr(document.plan, name)


def _restores_otherwise(old: Document, new: Document) -> bool:
    """Whether two documents ask for different restorations."""
    one, other = ((document.section, document.drawing.interpretation) for document in (old, new))
    return any(a is not b for a, b in zip(one, other, strict=True)) or old.plan != new.plan
