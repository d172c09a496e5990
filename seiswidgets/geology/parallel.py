"""Independent tasks on the workers of an executor: processes of this computer, or of a cluster.

A worker that is lost costs its tasks only, which are done again. Tasks in progress when a process of ours dies are then
run one at a time, until the one that kills its process is known and given up.
"""

import hashlib
import pickle
import zlib
from collections import deque
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import FIRST_COMPLETED, BrokenExecutor, CancelledError, Executor, Future, wait
from multiprocessing import active_children
from typing import Any, TypeVar

from loky import ProcessPoolExecutor, cpu_count

from seiswidgets.errors import SettingError
from seiswidgets.geology import validation

Result = TypeVar("Result")
Task = Callable[[Any, int], Result]

QUEUED = 4  # tasks for each worker that are handed over in advance
UNKNOWN = 64  # tasks that are handed over to an executor whose number of workers is unknown
ATTEMPTS = 3  # of a task whose worker is lost
HEARTBEAT = 0.1  # seconds
ONE_THREAD = {f"{name}_NUM_THREADS": "1" for name in ("OMP", "OPENBLAS", "MKL", "BLIS", "NUMEXPR")}

_content: tuple[str, Any] = ("", None)  # of a worker, by its hash: unpacked once for all its tasks


class Lost(Exception):
    """The worker of a task died each time it was tried."""


def run_tasks(
    task: Task[Result],
    content: Any,
    indices: Iterable[int],
    executor: Executor | None = None,
    workers: int | None = None,
) -> Iterator[tuple[int, Result | Lost] | None]:
    """Yield the results of ``task(content, index)`` as they arrive, and None while nothing does.

    Closing the iterator cancels what has not been done.

    Parameters
    ----------
    task : callable(content, index)
        A function of a module.
    content : object
        Sent to each worker once, or with each task of an executor that is given; small if possible.
    indices : iterable of int
    executor : concurrent.futures.Executor, optional
        By default processes of this computer, one for each core, that end with the iterator.
    workers : int, optional
        Number of those processes.

    Raises
    ------
    SettingError
        If the executor has been shut down, or is none.
    """
    if executor is not None and not isinstance(executor, Executor):
        raise SettingError(f"executor must be a concurrent.futures.Executor, but is a {type(executor).__name__}")
    data = zlib.compress(pickle.dumps(content), 1)
    crew = _Crew(executor, workers, (hashlib.sha256(data).hexdigest(), data))
    try:
        yield from _Run(crew, task, indices).results()
    finally:
        crew.end()


def _unpack(key: str, data: bytes) -> Any:
    """Unpack the content of a run, once on each worker."""
    global _content
    if _content[0] != key:
        _content = key, pickle.loads(zlib.decompress(data))
    return _content[1]


def _work(task: Task[Result], index: int, key: str, data: bytes = b"") -> Result:
    """Run a task on a worker, which has the content unless it comes along."""
    return task(_unpack(key, data), index)


class _Crew:
    """The executor that was given, or one of our own that is started again when it breaks."""

    def __init__(self, given: Executor | None, workers: int | None, content: tuple[str, bytes]):
        self._given, self._content = given, content
        self._workers = cpu_count() if workers is None else validation.whole_number("workers", workers, least=1)
        self._own: ProcessPoolExecutor | None = None

    @property
    def is_own(self) -> bool:
        return self._given is None

    @property
    def capacity(self) -> int:
        """Number of tasks to hand over at once."""
        if self._given is None:
            return QUEUED * self._workers
        known = getattr(self._given, "_max_workers", None)
        return QUEUED * known if isinstance(known, int) else UNKNOWN

    def submit(self, task: Task[Any], index: int) -> Future:
        try:
            if self._given is not None:
                key, data = self._content
                return self._given.submit(_work, task, index, key, data)
            if self._own is None:
                self._own = ProcessPoolExecutor(
                    self._workers, initializer=_unpack, initargs=self._content, env=ONE_THREAD
                )
            return self._own.submit(_work, task, index, self._content[0])
        except BrokenExecutor:
            raise
        except RuntimeError as error:
            text = f"the executor takes no tasks ({error}); give one that is running, or leave it out"
            raise SettingError(text) from error

    def restart(self) -> None:
        self.end()
        self._own = None

    def end(self) -> None:
        if self._own is not None:
            self._own.shutdown(wait=True, kill_workers=True)
            active_children()  # lets go of those that have died, which would each keep a pipe open


class _Run:
    """The tasks that wait, those that are handed over, and those that were in progress when a worker died."""

    def __init__(self, crew: _Crew, task: Task, indices: Iterable[int]):
        self._crew, self._task = crew, task
        self._waiting = deque(indices)
        self._pending: dict[Future, int] = {}
        self._suspects: set[int] = set()
        self._attempts: dict[int, int] = {}

    def results(self) -> Iterator[tuple[int, Any] | None]:
        try:
            while self._waiting or self._pending:
                self._hand_over()
                done, _ = wait(self._pending, HEARTBEAT, FIRST_COMPLETED)
                if not done:
                    yield None
                for future in done:
                    if future in self._pending:  # else it was dropped with a broken pool
                        yield from self._collect(future)
        finally:
            for future in () if self._crew.is_own else self._pending:  # our own processes are ended
                future.cancel()

    def _hand_over(self) -> None:
        while self._waiting and len(self._pending) < (1 if self._suspects else self._crew.capacity):
            index = self._waiting.popleft()
            try:
                self._pending[self._crew.submit(self._task, index)] = index
            except BrokenExecutor as error:
                self._waiting.appendleft(index)
                if not self._crew.is_own:
                    text = f"the executor has lost its processes ({error}); give another one, or leave it out"
                    raise SettingError(text) from error
                self._restart()

    def _collect(self, future: Future) -> Iterator[tuple[int, Any]]:
        index = self._pending[future]
        try:
            result = future.result()
        except (Exception, CancelledError) as error:  # noqa: BLE001 - tasks do not raise: a worker was lost
            if isinstance(error, BrokenExecutor) and self._crew.is_own:
                yield from self._after_a_death()
                return
            if not self._fails_again(index):
                self._waiting.appendleft(index)
                del self._pending[future]
                return
            result = Lost(f"its worker was lost {ATTEMPTS} times: {error}")
        del self._pending[future]
        self._suspects.discard(index)
        yield index, result

    def _fails_again(self, index: int) -> bool:
        """Count the failures of a task; True if they are too many."""
        self._attempts[index] = self._attempts.get(index, 0) + 1
        return self._attempts[index] >= ATTEMPTS

    def _after_a_death(self) -> Iterator[tuple[int, Lost]]:
        """Start again; a task that was alone each time when its process died is given up."""
        lost = list(self._pending.values())
        if self._suspects and len(lost) == 1 and self._fails_again(lost[0]):
            self._suspects.discard(lost[0])
            yield lost.pop(), Lost(f"its process died {ATTEMPTS} times, perhaps for want of memory")
        self._suspects.update(lost)
        self._waiting.extendleft(reversed(lost))
        self._restart()

    def _restart(self) -> None:
        self._pending.clear()
        self._crew.restart()
