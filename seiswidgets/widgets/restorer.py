"""Restores while the user works: at once on a coarse mesh, and on the full one when things have come to rest."""

import math
import time
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

from seiswidgets.errors import Cancelled, SeiswidgetsError
from seiswidgets.geology.plan import RestorationJob
from seiswidgets.widgets.jobs import Worker
from seiswidgets.widgets.section_view.canvas import LOCK
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
    """Carries out the newest of the tasks it is given.

    The quick look is made where it is asked for, so that nothing newer can be known while it is made: what is drawn
    is never stale. The full restoration is made on a thread, and given up as soon as something newer is asked for.

    Parameters
    ----------
    show : callable(Snapshot, Restoration or None)
        Draws a frame; with the restoration if it is the full one.
    tell : callable(Progress or None)
        Says how far the full restoration is; None when it has ended.
    fail : callable(Exception)
        Says why there is no restoration.

    All three are called with the lock of the canvases held, but for ``tell``.
    """

    def __init__(self, show: Callable, tell: Callable, fail: Callable):
        self._show, self._tell, self._fail = show, tell, fail
        self._worker = Worker()
        self._quick = self._full = None  # the newest (task, restoration) of either kind

    def preview(self, task: RestorationJob) -> None:
        """Make a quick look of a task and draw it, if that can be done at once."""
        self._worker.cancel()
        end = time.monotonic() + BUDGET
        try:
            coarse = task.coarse
            restoration = coarse.restored(self._quick or self._full, lambda *_: time.monotonic() < end)
            frame = Snapshot.of(restoration, moving=True)
        except Cancelled:
            return
        except SeiswidgetsError as error:
            with LOCK:
                self._fail(error)
            return
        with LOCK:
            self._quick = coarse, restoration
            self._show(frame, None)

    def restore(self, task: RestorationJob, delay: float = 0.0) -> None:
        """Carry a task out in full, after so many seconds unless something newer comes."""
        self._worker.ask(lambda wanted: self._carry_out(task, wanted), delay)

    def cancel(self) -> None:
        """Give up what is under way."""
        self._worker.cancel()
        self._tell(None)

    def forget(self) -> None:
        """Give up what is under way, and start nothing from what has been: it was of another section."""
        self.cancel()
        self._quick = self._full = None

    def wait(self, timeout: float | None = None) -> bool:
        """Wait until all is done; False if that took too long."""
        return self._worker.wait(timeout)

    def _carry_out(self, task, wanted):
        steps, last = task.steps, -math.inf

        def progress(step, iteration, energy):
            nonlocal last
            now = time.monotonic()
            if wanted() and now - last > BETWEEN:
                last = now
                self._tell(Progress(step, len(steps), steps[step].kind, iteration, energy))
            return wanted()

        try:
            restoration = task.restored(self._full or self._quick, progress)
            frame = Snapshot.of(restoration)
        except Cancelled:
            return
        except Exception as error:  # noqa: BLE001 - nobody else would hear of it on this thread
            self._end(wanted, partial(self._fail, error))
            return
        self._end(wanted, lambda: self._done(task, restoration, frame))

    def _end(self, wanted, action):
        with LOCK:
            if wanted():
                self._tell(None)
                action()

    def _done(self, task, restoration, frame):
        self._full, self._quick = (task, restoration), None
        self._show(frame, restoration)
