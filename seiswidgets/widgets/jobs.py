"""Background work: the newest job wins; progress, cancellation and errors are delivered.

Locking policy. Callbacks from the page and deliveries of jobs may run on different threads, and all canvases of a
kernel share one manager. Whoever changes the workspace or draws holds ``UI_LOCK``; computation never does. A job
computes on the thread of its runner. Its result, its error or the news that it has stopped is delivered with the lock
held, unless a newer job has been submitted since, so that nothing outdated is ever shown.
"""

import threading
import time
from collections.abc import Callable
from functools import partial
from typing import Any, Generic, TypeVar

from seiswidgets.errors import Cancelled

UI_LOCK = threading.RLock()

Result = TypeVar("Result")


class Job(Generic[Result]):
    """A job in the background.

    Parameters
    ----------
    work : callable(Job) -> result
        Runs on the runner's thread; it should check ``wanted`` often, and may raise `Cancelled` if that is False.
    done, failed, stopped : callable(result), callable(error), callable()
        Receive the outcome, with ``UI_LOCK`` held.
    """

    def __init__(
        self,
        work: Callable[["Job[Result]"], Result],
        done: Callable[[Result], None],
        failed: Callable[[Exception], None],
        stopped: Callable[[], None] = lambda: None,
    ):
        self._work, self._done, self._failed, self._stopped = work, done, failed, stopped
        self._is_newest, self._is_stopped = True, False

    @property
    def wanted(self) -> bool:
        """False once the job should stop."""
        return self._is_newest and not self._is_stopped

    def stop(self) -> None:
        """Ask the job to stop; ``stopped`` is called when it has."""
        self._is_stopped = True

    def drop(self) -> None:
        """Deliver nothing from now on."""
        self._is_newest = False

    def run(self) -> None:
        """Do the work, and deliver the outcome."""
        try:
            result = self._work(self)
            self._deliver(self._stopped if self._is_stopped else partial(self._done, result))
        except Cancelled:
            self._deliver(self._stopped)
        except Exception as error:  # noqa: BLE001 - on this thread, no one else would see it
            self._deliver(partial(self._failed, error))

    def _deliver(self, action: Callable[[], None]) -> None:
        if not self._is_newest:
            return
        with UI_LOCK:
            if self._is_newest:
                action()


class JobRunner:
    """Runs one job at a time on a thread, which lives as long as there is a job.

    A newer job drops the running and the waiting one.
    """

    def __init__(self) -> None:
        self._changed = threading.Condition()
        self._running: Job[Any] | None = None
        self._waiting: tuple[float, Job[Any]] | None = None
        self._thread: threading.Thread | None = None

    def submit(self, job: Job[Any], delay: float = 0.0) -> None:
        """Run a job after a delay in seconds, unless a newer one is submitted."""
        with self._changed:
            self._drop()
            self._waiting = time.monotonic() + delay, job
            if self._thread is None:
                self._thread = threading.Thread(target=self._work, name="seiswidgets job", daemon=True)
                self._thread.start()
            self._changed.notify_all()

    def stop(self) -> None:
        """Ask the running and the waiting job to stop; their ``stopped`` is called when they have."""
        with self._changed:
            for job in (self._running, self._waiting and self._waiting[1]):
                if job:
                    job.stop()

    def drop(self) -> None:
        """Cancel the running and the waiting job; nothing is delivered."""
        with self._changed:
            self._drop()
            self._changed.notify_all()

    def wait(self, timeout: float | None = None) -> bool:
        """Wait until there is no job; False after the timeout in seconds, or if called by a job."""
        with self._changed:
            if self._thread is threading.current_thread():
                return False
            return self._changed.wait_for(lambda: self._thread is None, timeout)

    def _drop(self) -> None:
        if self._running:
            self._running.drop()
        self._waiting = None

    def _work(self) -> None:
        while self._run_next():
            pass

    def _run_next(self) -> bool:
        """Run the next job; False if there is none. A function of its own, so that no finished job is kept alive."""
        job = self._next()
        if job is not None:
            job.run()
        return job is not None

    def _next(self) -> Job[Any] | None:
        """Wait for the next job that is due; None if there is none, and the thread is to end."""
        with self._changed:
            self._running = None
            while self._waiting and (left := self._waiting[0] - time.monotonic()) > 0:
                self._changed.wait(left)
            if self._waiting is None:
                self._thread = None
                self._changed.notify_all()
                return None
            (_, self._running), self._waiting = self._waiting, None
            return self._running
