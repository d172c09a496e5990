"""Restoration while the user works: a preview on a coarse mesh at once, and the full mesh at rest."""

import math
import time
from collections.abc import Callable
from dataclasses import dataclass

from seiswidgets.errors import Cancelled, SeiswidgetsError
from seiswidgets.geology.plan import RestorationJob
from seiswidgets.widgets.jobs import UI_LOCK, Job, JobRunner
from seiswidgets.widgets.snapshot import Snapshot

BUDGET = 0.6  # seconds that a quick look may take; where it would take longer, there is none
REST = 0.3  # seconds without a change until the full restoration begins
BETWEEN = 0.08  # seconds between two messages of progress


@dataclass(frozen=True)
class Progress:
    """How far a restoration has come.

    Attributes
    ----------
    step, steps : int
        The number of the step under way, from 0, and how many there are.
    kind : str
        Of that step.
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
    """Carries out the newest of the restorations it is asked for.

    A preview is computed where it is asked for, so that nothing newer can be known meanwhile. The full restoration runs
    in the background, and is dropped as soon as something newer is asked for.

    Parameters
    ----------
    show : callable(Snapshot, Restoration or None)
        Draws a snapshot; the restoration is given if it is the full one.
    report : callable(Progress or None)
        Shows the progress of the full restoration; None when it has ended.
    fail : callable(Exception)
        Says why there is no restoration.

    All three are called with ``UI_LOCK`` held.
    """

    def __init__(self, show: Callable, report: Callable, fail: Callable):
        self._show, self._report, self._fail = show, report, fail
        self._runner = JobRunner()
        self._quick = self._full = None  # the newest (job, restoration) of either kind

    def preview(self, job: RestorationJob) -> None:
        """Compute a preview and draw it, if that can be done within the budget."""
        self._runner.drop()
        end = time.monotonic() + BUDGET
        try:
            coarse = job.coarse
            restoration = coarse.restored(self._quick or self._full, lambda *_: time.monotonic() < end)
            snapshot = Snapshot.of(restoration, moving=True)
        except Cancelled:
            return
        except SeiswidgetsError as error:
            with UI_LOCK:
                self._fail(error)
            return
        with UI_LOCK:
            self._quick = coarse, restoration
            self._show(snapshot, None)

    def restore(self, job: RestorationJob, delay: float = 0.0) -> None:
        """Restore in full, after a delay in seconds unless something newer comes."""
        self._runner.submit(Job(lambda own: self._restored(job, own), self._done, self._failed), delay)

    def cancel(self) -> None:
        """Drop the restoration in progress."""
        self._runner.drop()
        self._report(None)

    def forget(self) -> None:
        """Drop the restoration in progress, and start none from earlier ones, as for another section."""
        self.cancel()
        self._quick = self._full = None

    def wait(self, timeout: float | None = None) -> bool:
        """Wait until nothing is left to do; False after the timeout in seconds."""
        return self._runner.wait(timeout)

    def _restored(self, job, own):
        steps, last = job.steps, -math.inf

        def progress(step, iteration, energy):
            nonlocal last
            now = time.monotonic()
            if own.wanted and now - last > BETWEEN:
                last = now
                self._report(Progress(step, len(steps), steps[step].kind, iteration, energy))
            return own.wanted

        restoration = job.restored(self._full or self._quick, progress)
        return job, restoration, Snapshot.of(restoration)

    def _done(self, result):
        job, restoration, snapshot = result
        self._full, self._quick = (job, restoration), None
        self._report(None)
        self._show(snapshot, restoration)

    def _failed(self, error):
        self._report(None)
        self._fail(error)
