"""Paths given by users, atomic writing, and packages that only some files need."""

import contextlib
import os
import re
from collections.abc import Iterator
from contextlib import contextmanager
from importlib import import_module
from os import PathLike
from pathlib import Path, PureWindowsPath
from reprlib import repr as brief
from tempfile import mkdtemp
from types import ModuleType

from seiswidgets.errors import DataError, SeiswidgetsError, SettingError


def user_path(path: str | PathLike) -> Path:
    """Expand ``~`` to the home folder.

    Raises
    ------
    DataError
        If it is not a path, or there is no such home folder.
    """
    if not isinstance(path, str | PathLike) or path == "":
        raise DataError(f"a path must be a string or a Path that names a file, but is {brief(path)}")
    try:
        return Path(path).expanduser()
    except RuntimeError as error:
        raise DataError(f"{str(path)[:200]!r} cannot be the path of a file: {error} Correct it") from error


def existing_file(path: str | PathLike) -> Path:
    """Path of an existing file.

    Raises
    ------
    DataError
        If there is no such file.
    """
    path = user_path(path)
    try:
        if not path.exists():
            raise DataError(_missing(path))
        if path.is_dir():
            raise DataError(f"{path} is a folder; give the path of a file")
        if not path.is_file():
            raise DataError(f"{path} is not a regular file; give the path of a file")
    except (OSError, ValueError) as error:  # names that the system does not allow
        if isinstance(error, DataError):
            raise
        raise DataError(f"{str(path)[:200]!r} cannot be the path of a file: {_reason(error)}; correct it") from error
    return path


def _missing(path: Path) -> str:
    """The message about a missing file; it says if the path comes from another operating system."""
    foreign = re.search(r"(?:^|/)((?:[A-Za-z]:[\\/]|\\\\).*)", str(path)) if os.name == "posix" else None
    if foreign is None:
        return f"{path} does not exist; check its name and folder"
    name = PureWindowsPath(foreign[1]).name
    return (
        f"{foreign[1]} is a path of Windows, which this system does not have; copy {name} to this system and give its "
        "path here. A session finds it in its own folder"
    )


def output_path(path: str | PathLike, suffixes: tuple[str, ...]) -> Path:
    """Path of a file to write, whose suffix selects the format.

    Raises
    ------
    SettingError
        If the suffix is not one of these.
    DataError
        If it cannot be a path.
    """
    path = user_path(path)
    if path.suffix.lower() not in suffixes:
        raise SettingError(f"{path} must end in {' or '.join(suffixes)}, which selects the file format")
    return path


def make_folder(folder: Path) -> None:
    """Make a folder, and those that it lies in; DataError if that fails."""
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except (OSError, ValueError) as error:
        raise DataError(f"the folder {folder} cannot be made: {_reason(error)}; choose another") from error


@contextmanager
def atomic_write(path: Path) -> Iterator[Path]:
    """Yield a temporary path to write to, which replaces the file only once it is completely on disk.

    If the path is a link, the file that it leads to is replaced.

    Raises
    ------
    DataError
        If the folder is missing, not writable, or full.
    """
    try:
        target = Path(os.path.realpath(path))
        folder = Path(mkdtemp(prefix=".", suffix=".part", dir=target.parent))
        draft = folder / target.name
        try:
            yield draft
            _sync(draft)
            os.replace(draft, target)
        finally:
            draft.unlink(missing_ok=True)
            folder.rmdir()
    except (OSError, ValueError) as error:  # ValueError: a name that the system does not allow
        if isinstance(error, SeiswidgetsError):
            raise
        raise DataError(
            f"{path} cannot be written: {_reason(error)}; free some space, or choose an existing folder that you may "
            "write to. Any older file of that name is unchanged"
        ) from error
    with contextlib.suppress(OSError):
        _sync(target.parent)  # lets the move itself survive a power cut, where the system supports that


def write_file(path: Path, content: bytes) -> None:
    """Write a file with `atomic_write`."""
    with atomic_write(path) as draft:
        draft.write_bytes(content)


def _reason(error: Exception) -> object:
    return getattr(error, "strerror", None) or error


def _sync(path: Path) -> None:
    """Wait until a file or folder is on disk."""
    handle = os.open(path, os.O_RDONLY if path.is_dir() else os.O_RDWR)  # Windows does not sync read-only files
    try:
        os.fsync(handle)
    finally:
        os.close(handle)


def import_optional(package: str, purpose: str, extra: str = "files") -> ModuleType:
    """Import a package of an extra; ``purpose`` says what it is needed for, e.g. "to read line.sgy".

    Raises
    ------
    DataError
        If it is not installed; the message says how to install it.
    """
    try:
        return import_module(package)
    except ModuleNotFoundError as error:
        raise DataError(
            f"{purpose} requires the package {package}, which is not installed: pip install {package}, "
            f'or "seiswidgets[{extra}]" for everything that {"clusters" if extra == "cluster" else extra} may need'
        ) from error
