"""Uncertainty in the app: how far the picks may be wrong, and what that does to the results."""

import time
from dataclasses import replace
from functools import partial
from html import escape

import matplotlib as mpl
import numpy as np
from ipywidgets import (
    HTML,
    BoundedIntText,
    Button,
    Checkbox,
    FloatLogSlider,
    FloatProgress,
    FloatSlider,
    HBox,
    Layout,
    VBox,
)
from loky import cpu_count
from traitlets import Bunch, Instance, observe

from seiswidgets.errors import Cancelled
from seiswidgets.geology.ensembles.ensemble import Ensemble
from seiswidgets.geology.ensembles.member import Member, Study
from seiswidgets.geology.ensembles.running import iterate_members
from seiswidgets.geology.ensembles.uncertainty import Uncertainty
from seiswidgets.geology.hypothesis import Hypothesis
from seiswidgets.geology.picks import HORIZON, Fault
from seiswidgets.geology.scan import scan
from seiswidgets.interaction.overlay import Overlay, Stroke
from seiswidgets.interaction.viewport import Viewport
from seiswidgets.widgets.jobs import UI_LOCK, Job, JobRunner
from seiswidgets.widgets.linked_panes import LinkedPanes
from seiswidgets.widgets.messages import HINT, TROUBLE, in_words
from seiswidgets.widgets.workspace import Workspace

REFRESH = 0.5  # seconds between two pictures of an ensemble that grows
BAND = 2.0  # standard deviations to either side of a restored horizon
BAND_DASH = (6.0, 4.0)
PALETTE = "viridis"
OPACITY = 0.6
EXPLAINED = (
    "How far may the picks be wrong? Many restorations with errors drawn at random say how far the results may be. "
    "Dashed lines in the restored section lie two standard deviations from the mean of each horizon."
)
OUTDATED = "The picks or the plan have changed since: run it again."
STYLE = {"description_width": "150px"}
WIDE = {"width": "100%", "max_width": "460px"}


class UncertaintyPanel(VBox):
    """Sliders for the errors of picks, an ensemble that grows in the background, and its error bars.

    Parameters
    ----------
    workspace : Workspace
    panes : LinkedPanes
        Show bands around restored horizons, and a map of the spread.

    Attributes
    ----------
    ensemble : Ensemble or None
        The members so far; None before the first, and after a change of the picks or the plan.
    sliders : dict of str to FloatSlider
        By the fields of `Uncertainty`; velocity in percent.
    match_box : Checkbox
        Whether the choice of match is uncertain: each member takes one of the peaks of each fault's scan.
    members : BoundedIntText
    run_button, cancel_button : Button
    map_box : Checkbox
        Whether the present-day section shows the spread of the area ratio.
    """

    ensemble = Instance(Ensemble, allow_none=True)

    def __init__(self, workspace: Workspace, panes: LinkedPanes):
        self._workspace, self._panes, self._runner = workspace, panes, JobRunner()
        self.sliders = _sliders()
        self.match_box = Checkbox(
            description="draw each fault's slip from the peaks of its scan", indent=False, layout=Layout(**WIDE)
        )
        self.members = BoundedIntText(200, min=2, max=10_000, description="members", style=STYLE, layout=Layout(**WIDE))
        self.run_button = Button(description="Run", icon="play", tooltip="Restore with errors drawn at random")
        self.cancel_button = Button(description="Cancel", icon="stop", disabled=True)
        self.progress = FloatProgress(min=0, max=1, layout=Layout(width="160px", visibility="hidden"))
        self.map_box = Checkbox(
            description="map of the spread, on the present-day section", indent=False, layout=Layout(**WIDE)
        )
        self.message, self.table = HTML(HINT.format(EXPLAINED)), HTML()
        row = HBox([self.run_button, self.cancel_button, self.progress], layout=Layout(flex_flow="row wrap"))
        super().__init__(
            [*self.sliders.values(), self.match_box, self.members, row, self.map_box, self.message, self.table]
        )
        self.run_button.on_click(lambda _: self.run())
        self.cancel_button.on_click(lambda _: self._runner.stop())
        self.map_box.observe(lambda change: self._draw(), "value")
        workspace.observe(self._take_document, "document")

    @property
    def uncertainty(self) -> Uncertainty:
        """The deviations that the sliders show."""
        values = {name: slider.value for name, slider in self.sliders.items()}
        return Uncertainty(**{**values, "velocity": values["velocity"] / 100})

    def run(self) -> None:
        """Compute an ensemble in the background, with one process less than there are cores, but one at least."""
        workspace = self._workspace
        drawn = Hypothesis(workspace.section, workspace.interpretation, workspace.plan)
        self._set_running(True)
        self.message.value = HINT.format("Starting ...")
        faults = [fault for fault in drawn.interpretation.faults if fault.constrains and self.match_box.value]
        work = partial(self._compute, drawn, self.uncertainty, faults, int(self.members.value))
        self._runner.submit(Job(work, self._end, self._fail, self._stopped))

    def wait(self, timeout: float | None = None) -> bool:
        """Wait until nothing is in progress; False after the timeout in seconds."""
        return self._runner.wait(timeout)

    def end(self) -> None:
        """Cancel what is in progress."""
        self._runner.drop()

    def _compute(
        self, drawn: Hypothesis, uncertainty: Uncertainty, faults: list[Fault], count: int, job: Job
    ) -> Ensemble:
        """Scan some faults, compute members, and show them now and then; on the runner's thread."""
        scans = {fault.name: scan(drawn.section, fault, progress=lambda share: job.wanted) for fault in faults}
        study, members = Study(drawn, replace(uncertainty, matches=scans)), list[Member]()
        last_shown = time.monotonic()
        for arrived in iterate_members(study, range(count), workers=max(1, cpu_count() - 1)):
            members += [arrived] if arrived is not None else []
            if not job.wanted:
                raise Cancelled("the ensemble was cancelled")
            if members and time.monotonic() - last_shown > REFRESH:
                last_shown = time.monotonic()
                with UI_LOCK:
                    if job.wanted:
                        self.progress.value = len(members) / count
                        self.ensemble = Ensemble.of(study, study.frame, members)
        return Ensemble.of(study, study.frame, members)

    def _end(self, ensemble: Ensemble) -> None:
        self._set_running(False)
        self.ensemble = ensemble

    def _stopped(self) -> None:
        self._set_running(False)
        self.message.value = HINT.format("Cancelled; what was done before is shown." if self.ensemble else "Cancelled.")

    def _fail(self, error: Exception) -> None:
        self._set_running(False)
        self.message.value = TROUBLE.format(escape(in_words(error)))

    def _set_running(self, running: bool) -> None:
        self.cancel_button.disabled, self.run_button.disabled = not running, running
        self.progress.value = 0
        self.progress.layout.visibility = "visible" if running else "hidden"

    def _take_document(self, change: Bunch) -> None:
        """Forget the ensemble when what it was made from changes."""
        old, new = change.old, change.new
        same_picks = old.section is new.section and old.drawing.interpretation is new.drawing.interpretation
        if same_picks and old.plan == new.plan:
            return
        self._runner.drop()
        self._set_running(False)
        if self.ensemble is not None:
            self.ensemble = None
            self.message.value = HINT.format(OUTDATED)

    @observe("ensemble")
    def _show(self, change: Bunch) -> None:
        ensemble = change.new
        self.table.value = "" if ensemble is None else ensemble._repr_html_()
        if ensemble is not None:
            self.message.value = HINT.format(EXPLAINED)
        self._draw()

    def _draw(self) -> None:
        """Show bands around the restored horizons, and the map of the spread if it is wanted."""
        ensemble, panes = self.ensemble, self._panes
        shown = ensemble if ensemble is not None and len(ensemble.members) > 1 else None
        panes.restored.draw_bands(bands(shown, self._workspace.drawing.colours) if shown else [])
        panes.original.overlay_opacity = OPACITY
        has_map = shown is not None and self.map_box.value and shown.frame.nodes.size > 0
        panes.original.overlay = spread_map(shown) if shown and has_map else None


def _sliders() -> dict[str, FloatSlider]:
    look = {"style": STYLE, "layout": WIDE}
    sliders = {
        "horizon": FloatSlider(1, min=0, max=10, step=0.25, description="horizons (± samples)", **look),
        "fault": FloatSlider(1, min=0, max=10, step=0.25, description="faults (± traces)", **look),
        "correlation_length": FloatLogSlider(500, min=1.5, max=4, description="alike over (m)", **look),
        "dip": FloatSlider(0, min=0, max=15, step=0.5, description="dip of faults (± °)", **look),
        "velocity": FloatSlider(0, min=0, max=20, step=0.5, description="velocity (± %)", **look),
    }
    sliders["correlation_length"].readout_format = ".0f"
    return sliders


def bands(ensemble: Ensemble, colours: dict[tuple[str, str], str]) -> list[Stroke]:
    """Two lines along each restored horizon, two standard deviations from its mean."""
    mean, spread, x = ensemble.horizon_mean, ensemble.horizon_spread, ensemble.frame.x
    return [
        Stroke(np.column_stack([x, mean[index] + side * BAND * spread[index]]), colour, 1.5, dash=BAND_DASH)
        for index, name in enumerate(ensemble.frame.horizons)
        for side in (-1, 1)
        if (colour := colours.get((HORIZON, name))) and np.isfinite(spread[index]).any()
    ]


def spread_map(ensemble: Ensemble) -> Overlay:
    """The standard deviation of the area ratio, up to its 99th percentile."""
    spread = ensemble.ratio_spread
    highest = float(np.nanpercentile(spread, 99)) if np.isfinite(spread).any() else 1.0
    levels = np.where(np.isfinite(spread), 1 + np.clip(254 * spread / max(highest, 1e-12), 0, 254), 0)
    palette = np.vstack([np.zeros(4), mpl.colormaps[PALETTE](np.linspace(0, 1, 255))])
    window = Viewport(ensemble.study.drawn.section).whole
    return Overlay(levels.astype(np.uint8), np.rint(255 * palette).astype(np.uint8), window)
