"""Restoration of a workspace while it is edited, and display of the result."""

from dataclasses import replace

from ipywidgets import jsdlink
from traitlets import Bunch

from seiswidgets.errors import SeiswidgetsError
from seiswidgets.geology.checking import check
from seiswidgets.geology.findings import Finding
from seiswidgets.geology.restoration import Restoration
from seiswidgets.interaction.document import Document
from seiswidgets.interaction.hints import next_step
from seiswidgets.widgets.histogram import DeformationHistogram
from seiswidgets.widgets.linked_panes import UNFINISHED, LinkedPanes
from seiswidgets.widgets.messages import IN_THE_APP, in_words
from seiswidgets.widgets.picker import Picker
from seiswidgets.widgets.restorer import REST, Restorer
from seiswidgets.widgets.snapshot import Snapshot
from seiswidgets.widgets.status_bar import StatusBar
from seiswidgets.widgets.timeline import Timeline
from seiswidgets.widgets.verdict import INCOMPLETE, Verdict

NO_STEP = "Nothing is restored: the tab Steps has no step that is switched on and has something to work on."
REFUSED = "not restored"
OUTDATED = "The section has not been restored since the last change: press Restore."


class LiveRestoration:
    """Restores the workspace of a picker after each edit, and shows the result in panes, status bar and histogram.

    While something is dragged, it shows a preview on a coarse mesh; once the workspace is settled, it restores on the
    full mesh in the background. If the status bar is not set to live, only ``restore`` does.

    Parameters
    ----------
    picker : Picker
    panes : LinkedPanes
    status : StatusBar
    timeline : Timeline
    histogram : DeformationHistogram
    """

    def __init__(
        self,
        picker: Picker,
        panes: LinkedPanes,
        status: StatusBar,
        timeline: Timeline,
        histogram: DeformationHistogram,
    ):
        self._workspace = workspace = picker.workspace
        self._picker, self._panes, self._status = picker, panes, status
        self._timeline, self._histogram = timeline, histogram
        self._requested = False  # whether the user pressed Restore: only then is an error shown as an alert
        self._restorer = Restorer(self._draw, status.show_progress, self._fail)
        self._link = jsdlink((timeline.slider, "value"), (panes.picture, "frame"))
        workspace.observe(self._take_document, "document")
        workspace.observe(self._take_settled, "settled")
        workspace.observe(self._take_restoration, "restoration")
        status.observe(self._take_live, "live")
        timeline.observe(self._take_time, "time")

    def restore(self) -> None:
        """Restore on the full mesh now, in the background."""
        self._requested = True
        self._restore_now()

    def update(self) -> None:
        """Restore if live, with a preview first if there is an earlier restoration; otherwise show that one is due."""
        self._requested = False
        if not self._is_possible():
            return
        if not self._status.live:
            self._restorer.cancel()
            self._picker.show_findings(())
            self._show_outdated()
            return
        self._status.show_busy()
        has_earlier = bool(self._workspace.restoration.stages)
        if has_earlier:
            self._restorer.preview(self._workspace.job)
        self._restorer.restore(self._workspace.job, REST if has_earlier else 0.0)

    def cancel(self) -> None:
        """Cancel the restoration in progress; the earlier one stays."""
        self._restorer.cancel()
        self._show_outdated()

    def stop(self) -> None:
        """Cancel everything in progress, and show nothing more."""
        self._restorer.cancel()

    def wait(self, timeout: float | None = None) -> bool:
        """Wait until nothing is in progress; False after the timeout in seconds."""
        return self._restorer.wait(timeout)

    def _take_document(self, change: Bunch) -> None:
        old, new = change.old, change.new
        if old.section is not new.section:
            self._restorer.forget()
        if _needs_restoration(old, new):
            self.update()
        self._picker.redraw()

    def _take_settled(self, change: Bunch) -> None:
        if change.new and self._status.live:
            self._restore_now()

    def _take_live(self, change: Bunch) -> None:
        if self._status.comm is not None:  # else the app is closed
            self.update()

    def _take_time(self, change: Bunch) -> None:
        """Follow the time, which the browser shows by itself."""
        restoration = self._workspace.restoration
        if change.new <= len(restoration.stages):
            is_end = change.new == len(restoration.stages)
            with self._panes.restored.layer.hold_sync():
                if self._panes.show_moment(None if is_end else Snapshot(restoration.at(change.new))):
                    self._picker.redraw()
            self._histogram.show(self._panes.shown.ratio if restoration.stages else [])

    def _take_restoration(self, change: Bunch) -> None:
        """Show the workspace's restoration, unless it is drawn already."""
        restoration = change.new
        if self._panes.shown.restoration is not restoration:
            self._restorer.cancel()
            self._draw(Snapshot.of(restoration), restoration)
        self._panes.restoration = restoration
        self._timeline.ages = [stage.age for stage in restoration.stages]
        self._timeline.labels = [stage.kind for stage in restoration.stages]
        self._timeline.time = len(restoration.stages)

    def _restore_now(self) -> None:
        if self._is_possible():
            self._status.show_busy()
            self._restorer.restore(self._workspace.job)

    def _is_possible(self) -> bool:
        """Return whether the picks suffice for a restoration; if not, show what to draw and the present-day section."""
        interpretation = self._workspace.interpretation
        has_slip = any(step.slip for step in self._workspace.job.steps)
        lacks_horizon = bool(interpretation.faults) and not interpretation.horizons and not has_slip
        if self._workspace.job.steps and not lacks_horizon:
            return True
        self._restorer.cancel()
        restoration = Restoration(self._workspace.section)
        self._draw(Snapshot.of(restoration), restoration)
        self._status.hint(self._next_step() or NO_STEP)
        return False

    def _draw(self, snapshot: Snapshot, restoration: Restoration | None) -> None:
        """Draw a snapshot; a preview has no restoration on the full mesh."""
        verdict = snapshot.verdict
        with self._panes.picture.one_frame():
            self._panes.show(snapshot, follow=self._is_unedited)
            self._picker.redraw()
        self._picker.show_findings(_softened(verdict))
        self._show_verdict(verdict, is_preview=restoration is None)
        self._set_outdated(False)
        self._histogram.show(snapshot.ratio if snapshot.restoration.stages else [])
        if restoration is not None:
            self._workspace.restoration = restoration

    @property
    def _is_unedited(self) -> bool:
        """True before the first edit and after an undo: then the view may follow the rock."""
        history = self._workspace.history
        return history.next_undo is None or history.next_redo is not None

    def _show_verdict(self, verdict: Verdict | None, is_preview: bool) -> None:
        step = self._next_step() if verdict and verdict.is_incomplete else ""
        if step:
            self._status.hint(step)
        elif verdict is not None:
            self._status.judge(verdict)
        elif is_preview:
            self._status.show_busy()  # the full restoration follows
        else:
            self._status.hint("")

    def _fail(self, error: Exception) -> None:
        """Show an error: as an alert if the user pressed Restore, as a hint while picks are being drawn."""
        step = "" if self._requested else self._next_step()
        (self._status.alert if self._requested else self._status.hint)(step or in_words(error))
        self._picker.show_findings(self._check(error))
        self._set_outdated(True)
        self._panes.restored.badge.show("problem" if self._requested else "note", UNFINISHED if step else REFUSED)

    def _next_step(self) -> str:
        return next_step(self._workspace.interpretation, self._workspace.section)

    def _check(self, error: Exception) -> list[Finding]:
        """All findings about the picks, not only the first that has prevented a step; mere notes while drawing."""
        workspace = self._workspace
        if not isinstance(error, SeiswidgetsError):
            return []
        checked = check(workspace.section, workspace.interpretation, workspace.plan)
        findings = [replace(finding, text=IN_THE_APP.get(finding.kind, finding.text)) for finding in checked]
        if error.pick not in {finding.pick for finding in findings}:
            findings.append(Finding("problem", error.kind, in_words(error), error.pick, error.where))
        return findings if self._requested else [replace(finding, severity="note") for finding in findings]

    def _show_outdated(self) -> None:
        self._set_outdated(True)
        self._panes.restored.badge.show("note", "out of date")
        self._status.hint(OUTDATED)

    def _set_outdated(self, outdated: bool) -> None:
        change = self._panes.restored.add_class if outdated else self._panes.restored.remove_class
        change("seiswidgets-outdated")


def _needs_restoration(old: Document, new: Document) -> bool:
    """Return whether a document needs another restoration than an earlier one."""
    same_picks = old.section is new.section and old.drawing.interpretation is new.drawing.interpretation
    return not same_picks or old.plan != new.plan


def _softened(verdict: Verdict | None) -> list[Finding]:
    """Findings of a verdict; those about a drawing in progress are notes."""
    early = INCOMPLETE | ({"beyond"} if verdict and verdict.is_incomplete else set())
    return [
        replace(finding, severity="note") if finding.kind in early else finding
        for finding in (verdict.findings if verdict else ())
    ]
