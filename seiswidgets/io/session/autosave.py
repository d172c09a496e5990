"""Sessions that save themselves: in a thread, a moment behind, the last few versions kept."""

import atexit
import contextlib
import logging
import os
import re
import threading
from collections.abc import Callable
from dataclasses import dataclass
from datetime import datetime
from pathlib import Path

from seiswidgets.errors import DataError
from seiswidgets.io.files import user_path, write_whole
from seiswidgets.io.session.session import Session, open_session

KEEP = 10
BEHIND = 0.5  # s: edits that come so close together are saved at once
AGAIN = 2.0  # s between two tries, while saving fails


@dataclass(frozen=True)
class Version:
    """A version of a session that was saved by itself.

    Attributes
    ----------
    path : Path
    saved : datetime
    session : Session
    """

    path: Path
    saved: datetime
    session: Session


class Autosave:
    """Saves sessions as numbered files, ``<stem>.000001.json`` and on, and deletes all but the last few.

    Each is complete or not there at all. Use it in a ``with`` statement, or close it.

    Parameters
    ----------
    path : path
        ``folder/name.json``; its folder must be there.
    keep : int
        How many versions stay.
    report : callable(DataError or None), optional
        Called from the thread with the error when saving fails, once for each message, and with None when it works
        again.
    behind, again : float
        Seconds from the first edit to its saving, and between two tries while saving fails.
    """

    def __init__(
        self,
        path,
        keep: int = KEEP,
        report: Callable[[DataError | None], None] | None = None,
        behind: float = BEHIND,
        again: float = AGAIN,
    ):
        self.path, self.keep = user_path(path), keep
        self._report, self._behind, self._again = report or (lambda error: None), behind, again
        self._change = threading.Condition()
        self._pending: Session | None = None
        self._saved: Session | None = None
        self._closing, self._failure = False, None
        self._thread = threading.Thread(target=self._work, name=f"autosave {self.path.name}", daemon=True)
        self._thread.start()
        atexit.register(self.close)

    @property
    def pending(self) -> Session | None:
        """What is not saved yet."""
        return self._pending

    def save(self, session: Session) -> None:
        """Have a session saved soon, instead of any that is still waiting; returns at once."""
        with self._change:
            if self._closing:
                raise DataError(f"{self.path} is closed and saves no more; make a new Autosave")
            self._pending = session
            self._change.notify_all()

    def close(self) -> None:
        """Save what is waiting, and end the thread.

        Raises
        ------
        DataError
            If that cannot be saved; it stays in ``pending``.
        """
        with self._change:
            self._closing = True
            self._change.notify_all()
        self._thread.join()
        atexit.unregister(self.close)
        if self._pending is not None:
            raise self._failure

    def __enter__(self):
        return self

    def __exit__(self, *error):
        self.close()

    def _work(self):
        while True:
            with self._change:
                self._change.wait_for(lambda: self._pending is not None or self._closing)
                if self._pending is None:
                    return
                self._change.wait_for(lambda: self._closing, self._behind if self._failure is None else self._again)
                session, closing = self._pending, self._closing
            self._try(session)
            if closing and self._failure is not None:
                return

    def _try(self, session):
        failure = self._written(session)
        with self._change:
            if failure is None and self._pending is session:
                self._pending = None
        told, self._failure = self._failure, failure
        if str(failure) != str(told):
            self._tell(failure)

    def _tell(self, failure):
        try:
            self._report(failure)
        except Exception:
            logging.getLogger(__name__).exception("the function that autosave reports to failed")

    def _written(self, session):
        """The error that kept a session from being written, if any."""
        if session == self._saved:
            return None
        try:
            older = numbered(self.path)
            number = max(older, default=0) + 1
            session.save(self.path.with_name(f"{self.path.stem}.{number:06d}{self.path.suffix}"))
        except DataError as error:
            return error
        except Exception as error:  # noqa: BLE001 - a thread that ends in silence would lose all later work
            return DataError(f"{self.path} cannot be saved: {error}")
        self._saved = session
        for old in sorted(older)[: max(0, len(older) + 1 - self.keep)]:
            with contextlib.suppress(OSError):  # an old version that stays does no harm
                older[old].unlink()
        return None


def found(path: str | os.PathLike) -> list[Version]:
    """The versions that an `Autosave` of that path has left and that can be opened, the newest first.

    A session that was saved under the path itself is the last of them.
    """
    path, versions = user_path(path), []
    for saved in [*(file for _, file in sorted(numbered(path).items(), reverse=True)), path]:
        try:
            session = open_session(saved, allow_outside=True)  # the section's file is not opened yet
            versions.append(Version(saved, datetime.fromtimestamp(saved.stat().st_mtime).astimezone(), session))
        except OSError:  # DataError is one; or another process deleted it just now
            continue
    return versions


def set_aside(path: str | os.PathLike) -> Path | None:
    """A copy of the newest version, ``<stem>.before-000012.json``, that stays however much is saved; None if none is.

    Raises
    ------
    DataError
        If it cannot be copied.
    """
    path = user_path(path)
    versions = numbered(path)
    if not versions:
        return None
    newest = max(versions)
    copy = path.with_name(f"{path.stem}.before-{newest:06d}{path.suffix}")
    try:
        write_whole(copy, versions[newest].read_bytes())
    except OSError as error:
        raise DataError(f"{versions[newest]} cannot be set aside: {error}") from error
    return copy


def numbered(path: Path) -> dict[int, Path]:
    """The files of the versions of a path, by their numbers."""
    name = re.compile(re.escape(path.stem) + r"\.(\d{6,12})" + re.escape(path.suffix))
    try:
        matches = [(name.fullmatch(file.name), file) for file in path.parent.iterdir()]
    except OSError:
        return {}
    return {int(match[1]): file for match, file in matches if match}
