"""Restoration while the user works: a preview on a coarse mesh at once, and the full mesh at rest."""

import math
import time
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

from seiswidgets.errors import Cancelled, SeiswidgetsError
from seiswidgets.geology.plan import RestorationJob
from seiswidgets.geology.restoration import Restoration
from seiswidgets.widgets.jobs import UI_LOCK, Job, JobRunner
from seiswidgets.widgets.snapshot import Snapshot

Computed = tuple[RestorationJob, Restoration]
Result = tuple[RestorationJob, Restoration, Snapshot]

BUDGET = 0.6  # seconds that a preview may take before it is given up
REST = 0.3  # seconds without a change until the full restoration begins
REPORT_INTERVAL = 0.08  # least seconds between two messages of progress


@dataclass(frozen=True)
class Progress:
    """The progress of a restoration.

    Attributes
    ----------
    step, steps : int
        Index of the step in progress, and number of steps.
    kind : str
        Kind of that step.
    iteration : int
    energy : float
        In square metres.
    """

    step: int
    steps: int
    kind: str
    iteration: int
    energy: float


class Restorer:
    """Computes the newest restoration requested.

    A preview is computed on the thread that requests it, so that no newer request can arrive meanwhile. The full
    restoration runs in the background, and is dropped on a newer request.

    Parameters
    ----------
    show : callable(Snapshot, Restoration or None)
        Draws a snapshot; the restoration is given unless it is a preview.
    report : callable(Progress or None)
        Shows the progress of the full restoration; None when it has ended.
    fail : callable(Exception)
        Shows why there is no restoration.

    All three are called with ``UI_LOCK`` held.
    """

    def __init__(
        self,
        show: Callable[[Snapshot, Restoration | None], None],
        report: Callable[[Progress | None], None],
        fail: Callable[[Exception], None],
    ):
        self._show, self._report, self._fail = show, report, fail
        self._runner = JobRunner()
        self._preview: Computed | None = None
        self._full: Computed | None = None

    def preview(self, job: RestorationJob) -> None:
        """Compute and draw a preview, unless that takes longer than the budget."""
        self._runner.drop()
        end = time.monotonic() + BUDGET
        try:
            coarse = job.coarse
            restoration = coarse.restored(self._preview or self._full, lambda *_: time.monotonic() < end)
            snapshot = Snapshot.of(restoration)
        except Cancelled:
            return
        except SeiswidgetsError as error:
            with UI_LOCK:
                self._fail(error)
            return
        with UI_LOCK:
            self._preview = coarse, restoration
            self._show(snapshot, None)

    def restore(self, job: RestorationJob, delay: float = 0.0) -> None:
        """Restore on the full mesh, after a delay in seconds, unless a newer request arrives."""
        self._runner.submit(Job(partial(self._restored, job), self._done, self._failed), delay)

    def cancel(self) -> None:
        """Drop the restoration in progress."""
        self._runner.drop()
        self._report(None)

    def forget(self) -> None:
        """Drop the restoration in progress and all earlier ones, as when another section is opened."""
        self.cancel()
        self._preview = self._full = None

    def wait(self, timeout: float | None = None) -> bool:
        """Wait until nothing is in progress; False after the timeout in seconds."""
        return self._runner.wait(timeout)

    def _restored(self, job: RestorationJob, background_job: Job[Result]) -> Result:
        steps, last_report = job.steps, -math.inf

        def progress(step: int, iteration: int, energy: float) -> bool:
            nonlocal last_report
            now = time.monotonic()
            if background_job.wanted and now - last_report > REPORT_INTERVAL:
                last_report = now
                self._report(Progress(step, len(steps), steps[step].kind, iteration, energy))
            return background_job.wanted

        restoration = job.restored(self._full or self._preview, progress)
        return job, restoration, Snapshot.of(restoration)

    def _done(self, result: Result) -> None:
        job, restoration, snapshot = result
        self._full, self._preview = (job, restoration), None
        self._report(None)
        self._show(snapshot, restoration)

    def _failed(self, error: Exception) -> None:
        self._report(None)
        self._fail(error)
