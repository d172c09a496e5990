"""The match of the two sides of a fault: try slips on a curve, and let the app suggest them."""

from collections.abc import Sequence
from functools import partial
from html import escape

import numpy as np
from ipywidgets import HTML, Box, Button, Dropdown, FloatProgress, HBox, Label, Layout, VBox
from traitlets import Bunch

from seiswidgets.errors import PickError, SeiswidgetsError
from seiswidgets.geology.fault_traces import fault_traces
from seiswidgets.geology.picks import CONSTRAIN, FAULT, HORIZON, Fault
from seiswidgets.geology.present_match import deformation, present_profile
from seiswidgets.geology.proposals import Proposal
from seiswidgets.geology.scan import Scan, scan
from seiswidgets.geology.section import Section
from seiswidgets.geology.slip_profile import SlipProfile
from seiswidgets.interaction.scene import Ghost
from seiswidgets.widgets.closing import WithParts
from seiswidgets.widgets.jobs import UI_LOCK, Job, JobRunner
from seiswidgets.widgets.key_guard import KeyGuard
from seiswidgets.widgets.match_chart import MatchChart
from seiswidgets.widgets.messages import in_words
from seiswidgets.widgets.picker import Picker
from seiswidgets.widgets.severity import label

REST = 0.3  # seconds without a change until a fault is scanned
STRAINS = 9  # slips for which the deformation is shown
NO_FAULT = "Draw a fault to match its two sides."
SCANNING = "Comparing the two sides…"


class MatchPanel(WithParts, VBox):
    """Match the two sides of a fault: a curve of correlation against slip, and proposals.

    Dragging on the curve prescribes the slip of the fault in the plan, and the section is restored by it as it moves. A
    slip that is prescribed outweighs the horizons at that fault, until "Match horizons" is pressed.

    Parameters
    ----------
    picker : Picker

    Attributes
    ----------
    fault : Dropdown
        The fault, which follows the selection in the panes.
    chart : MatchChart
    suggest, suggest_all, by_horizons, cancel : Button
    message : HTML
        What is doubtful about the match.
    scan : Scan or None
        The newest scan of the fault.
    proposals : tuple of Proposal
        Counterparts of horizons, to be accepted or dismissed.
    """

    def __init__(self, picker: Picker):
        self._picker, self._workspace = picker, picker.workspace
        self.borrowed = (picker,)
        self._scanning, self._straining = JobRunner(), JobRunner()
        self.scan: Scan | None = None
        self._scanned: tuple[Section, bytes] | None = None
        self.proposals: tuple[Proposal, ...] = ()
        self.fault = Dropdown(description="fault", style={"description_width": "40px"}, layout=Layout(width="150px"))
        self.suggest = _button("Suggest", "magic", "Propose the slip of this fault, and counterparts of its horizons")
        self.suggest_all = _button("Suggest all", "magic", "The same for all faults")
        self.by_horizons = _button("Match horizons", "link", "Prescribe no slip: match horizons across the fault again")
        self.cancel = _button("Cancel", "stop", "Cancel the comparison in progress")
        self._bar = FloatProgress(min=0, max=1, layout=Layout(width="80px"))
        self.progress = HBox([self._bar, self.cancel], layout=Layout(display="none"))
        self.message = HTML(NO_FAULT, layout=Layout(min_width="0"))
        self.chart = MatchChart()
        self._rows = VBox()
        tools = Box(
            [self.fault, self.suggest, self.suggest_all, self.by_horizons, self.progress],
            layout=Layout(flex_flow="row wrap", align_items="center"),
        )
        super().__init__([KeyGuard(), tools, self.message, self.chart, self._rows])
        self._bind()
        self._take_document()

    def wait(self, timeout: float | None = None) -> bool:
        """Wait until no comparison is in progress; False after the timeout in seconds."""
        return self._scanning.wait(timeout) and self._straining.wait(timeout)

    def end(self) -> None:
        """Drop what is in progress."""
        self._scanning.drop()
        self._straining.drop()

    def _bind(self) -> None:
        self._workspace.observe(self._take_document, "document")
        self._picker.observe(self._take_selection, "selection")
        self._picker.pane.observe(self._take_view, "view")
        self.fault.observe(lambda change: self._take_document(), "value")
        self.chart.on_slide(self._slide)
        self.suggest.on_click(lambda _: self.propose([self._fault]))
        self.suggest_all.on_click(lambda _: self.propose(self._faults))
        self.by_horizons.on_click(lambda _: self._prescribe(None, "match horizons at"))
        self.cancel.on_click(lambda _: self._scanning.stop())
        self._take_view()

    @property
    def _faults(self) -> list[Fault]:
        return [fault for fault in self._workspace.interpretation.faults if fault.use == CONSTRAIN]

    @property
    def _fault(self) -> Fault | None:
        return next((fault for fault in self._faults if fault.name == self.fault.value), None)

    def propose(self, faults: Sequence[Fault | None]) -> None:
        """Scan faults in the background, and show counterparts of their horizons as ghost lines."""
        section, horizons = self._workspace.section, self._workspace.interpretation.horizons
        chosen = [fault for fault in faults if fault is not None]

        def work(job: Job[list[Scan | SeiswidgetsError]]) -> list[Scan | SeiswidgetsError]:
            found: list[Scan | SeiswidgetsError] = []
            for index, fault in enumerate(chosen):
                report = partial(self._report, job, index, len(chosen))
                try:
                    found.append(scan(section, fault, horizons, progress=report))
                except PickError as error:
                    found.append(error)
            return found

        self._begin(Job(work, self._take_scans, self._fail, self._stop))

    def accept(self, proposal: Proposal) -> None:
        """Make a proposal a piece of its horizon."""
        drawing = self._workspace.drawing
        pieces = [*drawing.pick(HORIZON, proposal.horizon).pieces, proposal.points.tolist()]
        self.dismiss(proposal)
        changed = drawing.with_pieces(HORIZON, proposal.horizon, pieces)
        self._workspace.edit(f"accept {proposal.horizon} at {proposal.fault}", drawing=changed)
        self._picker.refresh()

    def dismiss(self, proposal: Proposal) -> None:
        """Drop a proposal."""
        self._show_proposals([one for one in self.proposals if one is not proposal])

    def _begin(self, job: Job, delay: float = 0.0) -> None:
        self._bar.value, self.progress.layout.display = 0.0, ""
        self._scanning.submit(job, delay)

    def _report(self, job: Job, index: int, count: int, share: float) -> bool:
        if job.wanted:
            self._bar.value = (index + share) / count
        return job.wanted

    def _take_scans(self, scans: list[Scan | SeiswidgetsError]) -> None:
        self._stop()
        found = [one for one in scans if isinstance(one, Scan)]
        self._show_proposals([proposal for one in found for proposal in one.proposals])
        for one in scans:
            if isinstance(one, Scan) and one.fault == self.fault.value:
                self._take_scan(one)
            elif isinstance(one, SeiswidgetsError) and one.pick == self.fault.value:
                self._fail(one)

    def _take_scan(self, found: Scan) -> None:
        self.scan = found
        self._stop()
        self.chart.show(found)
        doubts = [f"{label(doubt.severity, 'undecided')} {escape(doubt.text)}" for doubt in found.findings]
        self.message.value = "".join(f'<div role="status" style="line-height: 1.3">{doubt}</div>' for doubt in doubts)
        self._show_match()
        self._strain(found)

    def _stop(self) -> None:
        self.progress.layout.display = "none"

    def _fail(self, error: Exception) -> None:
        self._stop()
        self.scan = None
        self.chart.show(None)
        self.message.value = f'<div role="status" style="line-height: 1.3">{escape(in_words(error))}</div>'

    def _strain(self, found: Scan) -> None:
        """Compute the deformation for some slips, in the background."""
        job = self._workspace.job
        slips = np.linspace(found.slip[0], found.slip[-1], STRAINS + 2)[1:-1].tolist()
        profiles = [found.profile_through(slip) for slip in slips]

        def work(background: Job[list[float]]) -> list[float]:
            return deformation(job, found.fault, profiles, lambda: background.wanted)

        def show(percents: list[float]) -> None:
            if self.scan is found:
                self.chart.show(found, list(zip(slips, percents, strict=True)))

        self._straining.submit(Job(work, show, lambda error: None), 2 * REST)

    def _take_selection(self, change: Bunch) -> None:
        if change.new is not None and change.new.kind == FAULT and change.new.name in self.fault.options:
            self.fault.value = change.new.name

    def _take_view(self, change: Bunch | None = None) -> None:
        self.chart.span = list(map(float, self._picker.pane.view.window[2:]))

    def _take_document(self, change: Bunch | None = None) -> None:
        """Follow the edits: offer the faults, scan again if the fault has changed, and show the present match."""
        names = tuple(fault.name for fault in self._faults)
        if self.fault.options != names:
            kept = self.fault.value if self.fault.value in names else next(iter(names), None)
            with self.hold_trait_notifications():
                self.fault.options = names
                self.fault.value = kept
        fault = self._fault
        for button in (self.suggest, self.suggest_all):
            button.disabled = fault is None
        asked = None if fault is None else (self._workspace.section, fault.points.tobytes())
        if asked != self._scanned:
            self._scanned, self.scan = asked, None
            self.end()
            self._stop()
            self.chart.show(None)
            self._show_proposals([])
            self.message.value = "" if fault else NO_FAULT
            if fault is not None:
                self._look(fault)
        self._show_match()

    def _look(self, fault: Fault) -> None:
        """Scan a fault soon, in the background."""
        section = self._workspace.section
        self.chart.summary = SCANNING

        def work(job: Job[Scan]) -> Scan:
            return scan(section, fault, progress=partial(self._report, job, 0, 1))

        self._begin(Job(work, self._take_scan, self._fail, self._stop), REST)

    def _show_match(self) -> None:
        """Show the slip of the plan, or of the picks, and the profiles that belong to it."""
        fault, found = self._fault, self.scan
        prescribed = None if fault is None else self._workspace.plan.slip_of(fault.name)
        self.by_horizons.disabled = prescribed is None
        if fault is None or found is None:
            self.chart.slip = None
            self.chart.show_profile(None, None)
            return
        traces = fault_traces(self._workspace.section, fault)
        present = present_profile(traces, fault, self._workspace.interpretation, self._workspace.plan)
        shown = present or found.profile
        try:
            self.chart.show_profile(traces, shown)
        except PickError:  # a slip that leaves too little to compare
            self.chart.show_profile(None, None)
        self.chart.slip = None if present is None else float(present.at(traces.length / 2))
        how = "prescribed" if prescribed else "picked" if present else "suggested"
        throw = float(traces.offsets(traces.length / 2, shown)[0, 1])
        unit = self._workspace.section.z_unit
        self.chart.summary = (
            f"{fault.name}: {how} slip of {shown.at(traces.length / 2):.0f} m at the middle, throw {throw:.3g} {unit}; "
            f"best: {found.peaks[0].slip:.0f} m, {found.best.kind}, correlation {found.peaks[0].correlation:.2f}"
        )

    def _slide(self, slip: float, settled: bool) -> None:
        """Prescribe a slip that the user drags or chooses."""
        if self.scan is None or self._fault is None:
            return
        profile = next((peak.profile for peak in self.scan.peaks if peak.slip == slip), self.scan.profile_through(slip))
        self._prescribe(profile, "slip of" if settled else None)

    def _prescribe(self, profile: SlipProfile | None, verb: str | None) -> None:
        """Write a slip to the plan; without a verb, the edit is not finished yet."""
        fault = self._fault
        if fault is None:
            return
        with UI_LOCK:
            history = self._workspace.history
            history.amend(plan=self._workspace.plan.with_slip(fault.name, profile))
            if verb is not None:
                history.commit(f"{verb} {fault.name}")

    def _show_proposals(self, proposals: Sequence[Proposal]) -> None:
        self.proposals = tuple(proposals)
        self._rows.children = [self._row(proposal) for proposal in self.proposals]
        colours = {pick.name: pick.colour for pick in self._workspace.drawing.picks if pick.kind == HORIZON}
        self._picker.show_ghosts(
            Ghost(
                tuple(map(tuple, proposal.points.tolist())),
                colours.get(proposal.horizon, "#d81b60"),
                f"{proposal.horizon}? {proposal.confidence:.0%}",
            )
            for proposal in self.proposals
        )

    def _row(self, proposal: Proposal) -> HBox:
        unit = self._workspace.section.z_unit
        text = (
            f"{proposal.horizon} in the {proposal.wall} of {proposal.fault}: throw {proposal.throw:.3g} {unit}, "
            f"confidence {proposal.confidence:.0%}"
        )
        accept = _button("Accept", "check", f"Draw this piece of {proposal.horizon}")
        dismiss = _button("Dismiss", "times", f"Drop this proposal for {proposal.horizon}")
        accept.on_click(lambda _: self.accept(proposal))
        dismiss.on_click(lambda _: self.dismiss(proposal))
        return HBox([accept, dismiss, Label(text)])


def _button(description: str, icon: str, tooltip: str) -> Button:
    return Button(description=description, icon=icon, tooltip=tooltip, layout=Layout(width="auto"))
