"""The restoration app: draw, restore, look."""

from os import PathLike

import numpy as np
from ipywidgets import GridBox, Layout, VBox
from traitlets import Any, Bool, Instance, Tuple, link, observe, validate

from seiswidgets.errors import SettingError
from seiswidgets.geology.picks import Interpretation
from seiswidgets.geology.plan import Plan, RestorationJob
from seiswidgets.geology.restoration import Restoration
from seiswidgets.geology.section import Section
from seiswidgets.geology.validation import checked_kind
from seiswidgets.geology.weights import Weights
from seiswidgets.io.session.sources import SectionSource
from seiswidgets.widgets.files.session_bar import SessionBar
from seiswidgets.widgets.files.tabbed import Tabbed
from seiswidgets.widgets.files.turning import Turning
from seiswidgets.widgets.histogram import DeformationHistogram
from seiswidgets.widgets.linked_panes import LinkedPanes
from seiswidgets.widgets.messages import in_words
from seiswidgets.widgets.names import Names
from seiswidgets.widgets.order import keep_order
from seiswidgets.widgets.panels.controls import SolverControls
from seiswidgets.widgets.panels.reports import Reports
from seiswidgets.widgets.picker import Picker
from seiswidgets.widgets.restorer import REST, Restorer
from seiswidgets.widgets.snapshot import Snapshot
from seiswidgets.widgets.status_bar import StatusBar
from seiswidgets.widgets.timeline import Timeline
from seiswidgets.widgets.timeline_player import TimelinePlayer

FIRST = "Draw a fault: choose Fault, click along it, double click to finish. Then draw a horizon on both sides of it."
THEN = "Now choose Horizon and draw one on both sides of the fault; a double click finishes each piece."
CHANGED = "Something has changed since: press Restore."
SIDE_BY_SIDE = "repeat(auto-fit, minmax(min(100%, 400px), 1fr))"


class RestorationApp(Tabbed, Turning, VBox):
    """Draw faults and horizons on a section, restore it, and look at what that took.

    On the left is the section of today, on the right the restored one; lines can be drawn in either. While something
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
        settings = {"steps": Plan().steps, "restoration": Restoration(section), **settings}
        picks = {"interpretation": interpretation or Interpretation(), "fixed": fixed}
        self._ready = self._pressed = False
        if source is not None:
            checked_kind(source, SectionSource, "source")
        self.source = source
        self._make_parts(section, picks, height)
        self._restorer = Restorer(self._draw, self.status.tell, self._fail)
        self._player = TimelinePlayer(self.panes, self.picker.redraw)
        super().__init__(self._placed(), **picks, **settings)
        self.add_class("seiswidgets-app")
        keep_order(self)
        self._tie_parts()
        self._ready = True
        self._restore_soon()
        self.session_path = session

    @property
    def plan(self) -> Plan:
        """What is done, and with which choices."""
        return Plan(self.steps, self.weights, self.solving.solver, self.solving.spacing)

    def restore(self) -> None:
        """Restore on the full mesh now, in the background; what is wrong is said below the panes."""
        self._pressed = True
        if self._is_possible():
            self._restorer.restore(self._task())

    def cancel(self) -> None:
        """Give up the restoration that is under way; all that was there before stays."""
        self._restorer.cancel()
        self._set_outdated(True)

    def wait(self, timeout: float | None = None) -> bool:
        """Wait until all that is under way is done, as a script may want; False if that took too long."""
        return all(part.wait(timeout) for part in (*self._made_files, self.keeper, self._restorer, self._player))

    def close(self) -> None:
        """Stop what is under way, save what is not saved yet, and take the app off the screen."""
        if self.comm is None:  # closed before, or never made
            return
        self._restorer.cancel()
        self._player.cancel()
        for panel in self._made_files:
            panel.end()
        try:
            self.keeper.end()
        finally:
            super().close()

    def _make_parts(self, section, picks, height):
        self.panes = LinkedPanes(section, height=height, deformation=0.5)
        self.picker = Picker(self.panes.original, **picks)
        self.picker.attach(self.panes.restored, self.panes.projection)
        self.histogram = DeformationHistogram()
        self.solving = SolverControls(section)
        self.timeline = Timeline()
        self.status = StatusBar(self.restore, self.cancel)
        self.reports = Reports()
        self.keeper = SessionBar(self)

    def _placed(self):
        """The parts in their places."""
        below = GridBox(
            [VBox([self.timeline, self.histogram], layout=Layout(min_width="0")), self._tabs()],
            layout=Layout(grid_template_columns=SIDE_BY_SIDE, grid_gap="8px", width="100%"),
        )
        self.picker.toolbar.children = (*self.picker.toolbar.children, self.status.buttons)
        return [self.picker.toolbar, self.status, self.keeper, self.panes, self.keeper.news, below, Names()]

    def _tie_parts(self):
        for name in ("interpretation", "fixed"):
            link((self, name), (self.picker, name))
        link((self, "live"), (self.status, "live"))
        link((self.histogram, "brush"), (self.panes, "brush"))
        self.solving.observe(self._take_change, ("spacing", "solver"))
        self.picker.observe(self._take_rest, "dragging")
        self.timeline.observe(lambda change: self._player.show(self.restoration, change.new), "time")
        self.panes.on_reading(self._mark)

    def _task(self):
        return RestorationJob(self.section, self.interpretation, self.fixed, self.plan)

    @observe("interpretation", "fixed", "weights", "steps", "live")
    def _take_change(self, change):
        if self._ready:
            self._restore_soon()

    def _take_rest(self, change):
        if self._ready and not change.new and self.live and self._is_possible():
            self._restorer.restore(self._task())

    def _restore_soon(self):
        """Restore, if changes do so by themselves: a quick look at once, the whole when things have come to rest."""
        self._pressed = False
        if not self._is_possible():
            return
        if not self.live:
            self._restorer.cancel()
            self._set_outdated(True)
            self.status.hint(CHANGED)
            return
        if self.restoration.stages:
            self._restorer.preview(self._task())
        self._restorer.restore(self._task(), REST if self.restoration.stages else 0.0)

    def _is_possible(self):
        """Whether there is something to restore with; if not, say what to do, and show the section as it is."""
        drawn = self.interpretation
        waits = drawn.faults and not drawn.horizons
        if self._task().steps and not waits:
            return True
        self._restorer.cancel()
        restoration = Restoration(self.section)
        self._draw(Snapshot.of(restoration), restoration)
        self.status.hint(THEN if waits else FIRST)
        return False

    def _draw(self, frame, restoration):
        """Draw a restoration; without it a frame is but a quick look."""
        self._player.cancel()
        if restoration is None:
            self.panes.show(frame)
        else:
            self._show_whole(frame, restoration)
        self.picker.complain("")
        self.picker.redraw()
        self.status.hint("")
        self._set_outdated(False)
        self.histogram.show(frame.ratio_before.ratio.ravel() if frame.restoration.stages else [])

    def _show_whole(self, frame, restoration):
        self.panes.show(frame)
        self.panes.restoration = restoration
        self.restoration = restoration
        self.timeline.labels = [stage.kind for stage in restoration.stages]
        self.timeline.time = len(restoration.stages)
        self.reports.show(restoration)

    @observe("restoration")
    def _take_restoration(self, change):
        if not self._ready or self.panes.restoration is change.new:
            return
        self._restorer.cancel()
        self._draw(Snapshot.of(change.new), change.new)

    @validate("restoration")
    def _valid_restoration(self, proposal):
        if proposal.value.original is not self.section:
            raise SettingError("the restoration is of another section; make an app of that one")
        return proposal.value

    def _fail(self, error):
        """Say what is wrong: loudly, if it was asked for; as a hint, while picks are still being made."""
        text = in_words(error)
        (self.status.alert if self._pressed else self.status.hint)(text)
        self.picker.complain(text)
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
