"""A thread that does the newest job only."""

import threading
import time
from collections.abc import Callable

Job = Callable[[Callable[[], bool]], None]


class Worker:
    """Does one job at a time, on a thread that lives as long as there is something to do.

    A job is a function; it is given another that says whether it is still wanted. When a newer job is asked for, the
    one under way is wanted no more and one that waits is dropped.
    """

    def __init__(self):
        self._changed = threading.Condition()
        self._waiting = None  # when it is due, its number, and the job
        self._number = 0
        self._thread = None

    def ask(self, job: Job, delay: float = 0.0) -> None:
        """Have a job done, after so many seconds unless a newer one comes."""
        with self._changed:
            self._number += 1
            self._waiting = time.monotonic() + delay, self._number, job
            if self._thread is None:
                self._thread = threading.Thread(target=self._work, name="seiswidgets restoring", daemon=True)
                self._thread.start()
            self._changed.notify_all()

    def cancel(self) -> None:
        """Want nothing any more."""
        with self._changed:
            self._number += 1
            self._waiting = None
            self._changed.notify_all()

    def wait(self, timeout: float | None = None) -> bool:
        """Wait until nothing is left to do; False if that took too long."""
        with self._changed:
            return self._changed.wait_for(lambda: self._thread is None, timeout)

    def _work(self):
        while (taken := self._next()) is not None:
            number, job = taken
            job(lambda number=number: number == self._number)

    def _next(self):
        with self._changed:
            while self._waiting and (left := self._waiting[0] - time.monotonic()) > 0:
                self._changed.wait(left)
            if self._waiting is None:
                self._thread = None
                self._changed.notify_all()
                return None
            _, *taken = self._waiting
            self._waiting = None
            return taken
