"""Automatic saving of sessions on a thread, keeping the last few versions."""

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
from typing import Protocol, Self

from seiswidgets.errors import DataError
from seiswidgets.io.files import user_path, write_file
from seiswidgets.io.session.session import Session, open_session

KEEP = 10
BEHIND = 0.5  # s: edits closer together than this are saved together
AGAIN = 2.0  # s between two attempts, while saving fails


class Saveable(Protocol):
    """A `Session` or a `SessionWithSection`."""

    def save(self, path: Path) -> None:
        """Write it to a file; DataError if that fails."""


@dataclass(frozen=True)
class Version:
    """An automatically saved version of a session.

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
    """Save sessions as numbered files, ``<stem>.000001.json`` and so on, and delete all but the last few.

    Each file is complete or does not exist. Files that another kernel saves meanwhile are not deleted. Use it in a
    ``with`` statement, or close it.

    Parameters
    ----------
    path : path
        ``folder/name.json``; the folder must exist.
    keep : int
        Number of versions to keep.
    report : callable(DataError or None), optional
        Called on the thread with the error when saving fails, once for each message, and with None when it works
        again.
    behind, again : float
        Seconds from the first edit to saving it, and between two attempts while saving fails.

    Attributes
    ----------
    newest : Path or None
        The version written last.
    """

    def __init__(
        self,
        path: str | os.PathLike,
        keep: int = KEEP,
        report: Callable[[DataError | None], None] | None = None,
        behind: float = BEHIND,
        again: float = AGAIN,
    ):
        self.path, self.keep = user_path(path), keep
        self._report, self._behind, self._again = report, behind, again
        self._numbers = sorted(numbered_files(self.path))  # that may be deleted, except the last: others' work
        self._kept = set(self._numbers[-1:])
        self.newest: Path | None = None
        self._change = threading.Condition()
        self._pending: Saveable | None = None
        self._saved: Saveable | None = None
        self._closing = False
        self._failure: DataError | None = None
        self._thread = threading.Thread(target=self._run, name=f"autosave {self.path.name}", daemon=True)
        self._thread.start()
        atexit.register(self.close)

    @property
    def pending(self) -> Saveable | None:
        """The session that is not saved yet, if any."""
        return self._pending

    def save(self, session: Saveable) -> None:
        """Save a session soon, in place of any that is still waiting; return at once."""
        with self._change:
            if self._closing:
                raise DataError(f"the Autosave of {self.path} is closed and saves no more; make a new one")
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
        if self._pending is not None and self._failure is not None:
            raise self._failure

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *error: object) -> None:
        self.close()

    def _run(self) -> None:
        while True:
            with self._change:
                self._change.wait_for(lambda: self._pending is not None or self._closing)
                if self._pending is None:
                    return
                self._change.wait_for(lambda: self._closing, self._behind if self._failure is None else self._again)
                session, closing = self._pending, self._closing
            self._attempt(session)
            if closing and self._failure is not None:
                return

    def _attempt(self, session: Saveable) -> None:
        failure = self._write(session)
        with self._change:
            if failure is None and self._pending is session:
                self._pending = None
        earlier, self._failure = self._failure, failure
        if str(failure) != str(earlier):
            self._call_report(failure)

    def _call_report(self, failure: DataError | None) -> None:
        try:
            if self._report is not None:
                self._report(failure)
        except Exception:
            logging.getLogger(__name__).exception("the function given as report= to Autosave failed")

    def _write(self, session: Saveable) -> DataError | None:
        """Write a session and delete old versions; return the error that prevented it, if any."""
        if session == self._saved:
            return None
        try:
            present, file = numbered_files(self.path), next_version(self.path)
            session.save(file)
        except DataError as error:
            return error
        except Exception as error:  # noqa: BLE001 - a thread that ends in silence would lose all later work
            return DataError(f"{self.path} cannot be saved: {error}")
        self._saved, self.newest = session, file
        number = max(present, default=0) + 1
        self._numbers = [*(old for old in self._numbers if old in present), number]
        expendable = [old for old in self._numbers[:-1] if old not in self._kept]
        for old in expendable[: max(0, len(self._numbers) - self.keep)]:
            with contextlib.suppress(OSError):  # an old version that cannot be deleted does no harm
                present[old].unlink()
        return None


def find_versions(path: str | os.PathLike) -> list[Version]:
    """Find the versions that an `Autosave` has left and that can be opened, newest first.

    A session that was saved under the path itself is the last one.
    """
    path, versions = user_path(path), []
    for file in [*(file for _, file in sorted(numbered_files(path).items(), reverse=True)), path]:
        try:
            session = open_session(file, allow_outside=True)  # does not open the section's file
            versions.append(Version(file, datetime.fromtimestamp(file.stat().st_mtime).astimezone(), session))
        except OSError:  # a DataError, or another process has just deleted it
            continue
    return versions


def set_aside(path: str | os.PathLike) -> Path | None:
    """Copy the newest version to ``<stem>.before-000012.json``, which is never deleted; None if there is no version.

    Raises
    ------
    DataError
        If it cannot be copied.
    """
    path = user_path(path)
    versions = numbered_files(path)
    if not versions:
        return None
    newest = max(versions)
    copy = path.with_name(f"{path.stem}.before-{newest:06d}{path.suffix}")
    try:
        write_file(copy, versions[newest].read_bytes())
    except OSError as error:
        raise DataError(f"{versions[newest]} cannot be copied to {copy.name}: {error}") from error
    return copy


def next_version(path: Path) -> Path:
    """File that the next version of a path is written to."""
    return path.with_name(f"{path.stem}.{max(numbered_files(path), default=0) + 1:06d}{path.suffix}")


def find_sessions(folder: Path) -> list[Path]:
    """Paths of the sessions that were saved automatically in a folder or its subfolders, newest first."""
    newest: dict[Path, float] = {}
    for pattern in ("*.json", "*/*.json"):
        for file in folder.glob(pattern):
            name = re.fullmatch(r"(.+)\.\d{6,12}\.json", file.name)
            if name:
                path = file.with_name(f"{name[1]}.json")
                with contextlib.suppress(OSError):  # deleted meanwhile
                    newest[path] = max(newest.get(path, 0.0), file.stat().st_mtime)
    return sorted(newest, key=lambda path: -newest[path])


def numbered_files(path: Path) -> dict[int, Path]:
    """Files of the versions of a path, by number."""
    name = re.compile(re.escape(path.stem) + r"\.(\d{6,12})" + re.escape(path.suffix))
    try:
        matches = [(name.fullmatch(file.name), file) for file in path.parent.iterdir()]
    except OSError:
        return {}
    return {int(match[1]): file for match, file in matches if match}
