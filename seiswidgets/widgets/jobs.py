"""Background work: the newest job wins; progress, cancellation and errors are delivered.

Locking policy. Callbacks from the page and deliveries of jobs may run on different threads, and all canvases of a
kernel share one manager. Whoever changes the workspace or draws holds ``UI_LOCK``; computation never does. A job
computes on the thread of its runner. Its result, its error or the news that it has stopped is delivered with the lock
held, unless a newer job has been submitted since: what is shown is never stale.
"""

import threading
import time
from collections.abc import Callable
from functools import partial
from typing import Generic, TypeVar

from seiswidgets.errors import Cancelled

UI_LOCK = threading.RLock()

Result = TypeVar("Result")


class Job(Generic[Result]):
    """A job, as its own work sees it.

    Parameters
    ----------
    work : callable(Job) -> result
        Runs on the runner's thread; it should ask ``wanted`` often, and may raise `Cancelled` if it is not.
    done, failed, stopped : callable(result), callable(error), callable()
        Receive what came of it, with ``UI_LOCK`` held.
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
        """Whether the job should go on."""
        return self._is_newest and not self._is_stopped

    def stop(self) -> None:
        """Ask the job to stop; ``stopped`` is called when it has."""
        self._is_stopped = True

    def drop(self) -> None:
        """Deliver nothing any more."""
        self._is_newest = False

    def run(self) -> None:
        """Do the work, and deliver what came of it."""
        try:
            result = self._work(self)
            self._deliver(self._stopped if self._is_stopped else partial(self._done, result))
        except Cancelled:
            self._deliver(self._stopped)
        except Exception as error:  # noqa: BLE001 - nobody else would hear of it on this thread
            self._deliver(partial(self._failed, error))

    def _deliver(self, action):
        if not self._is_newest:
            return
        with UI_LOCK:
            if self._is_newest:
                action()


class JobRunner:
    """Runs one job at a time on a thread, which lives as long as there is something to do.

    A newer job drops the one in progress and one that waits.
    """

    def __init__(self):
        self._changed = threading.Condition()
        self._running: Job | None = None
        self._waiting: tuple[float, Job] | None = None
        self._thread: threading.Thread | None = None

    def submit(self, job: Job, delay: float = 0.0) -> None:
        """Run a job after a delay in seconds, unless a newer one comes."""
        with self._changed:
            self._drop()
            self._waiting = time.monotonic() + delay, job
            if self._thread is None:
                self._thread = threading.Thread(target=self._work, name="seiswidgets job", daemon=True)
                self._thread.start()
            self._changed.notify_all()

    def stop(self) -> None:
        """Ask the job in progress to stop, and tell it when it has."""
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
        """Wait until there is nothing left to do; False after the timeout in seconds, or if a job itself asks."""
        with self._changed:
            if self._thread is threading.current_thread():
                return False
            return self._changed.wait_for(lambda: self._thread is None, timeout)

    def _drop(self):
        if self._running:
            self._running.drop()
        self._waiting = None

    def _work(self):
        while self._run_next():
            pass

    def _run_next(self):
        """Run the next job; False if there is none. In a frame of its own, so that no job is held after its end."""
        job = self._next()
        if job is not None:
            job.run()
        return job is not None

    def _next(self):
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
