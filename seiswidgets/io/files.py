"""Paths as users give them, files written whole or not at all, and packages that only some files need."""

import contextlib
import os
from contextlib import contextmanager
from importlib import import_module
from os import PathLike
from pathlib import Path
from reprlib import repr as brief
from tempfile import mkdtemp

from seiswidgets.errors import DataError, SeiswidgetsError, SettingError


def user_path(path: str | PathLike) -> Path:
    """A path, with the home folder in the place of ~.

    Raises
    ------
    DataError
        If it is none, or there is no such home.
    """
    if not isinstance(path, str | PathLike) or path == "":
        raise DataError(f"a path must be a text or a Path that names a file, but is {brief(path)}")
    try:
        return Path(path).expanduser()
    except RuntimeError as error:
        raise DataError(f"{str(path)[:200]!r} cannot be the path of a file: {error} Correct it") from error


def existing_file(path: str | PathLike) -> Path:
    """The path of a file that is there.

    Raises
    ------
    DataError
        If there is none.
    """
    path = user_path(path)
    try:
        if not path.exists():
            raise DataError(f"{path} is not there; check its name and folder")
        if not path.is_file():
            raise DataError(f"{path} is {'a folder' if path.is_dir() else 'no file'}; give the path of a file")
    except (OSError, ValueError) as error:  # of names that cannot be a file's
        if isinstance(error, DataError):
            raise
        reason = getattr(error, "strerror", None) or error
        raise DataError(f"{str(path)[:200]!r} cannot be the path of a file: {reason}; correct it") from error
    return path


def checked_path(path, suffixes: tuple[str, ...]) -> Path:
    """The path of a file to write, by one of the endings that say its kind.

    Raises
    ------
    SettingError
        If it ends otherwise.
    DataError
        If it cannot be a path.
    """
    path = user_path(path)
    if path.suffix.lower() not in suffixes:
        raise SettingError(f"{path} must end in {' or '.join(suffixes)}, which says what kind of file it becomes")
    return path


@contextmanager
def written(path: Path):
    """A place to write a file's content to; what stood at the path is replaced only when all of it is on the disk.

    Where the path is a link, the file that it leads to is replaced.

    Raises
    ------
    DataError
        If the folder is missing, cannot be written to, or is full.
    """
    try:
        target = Path(os.path.realpath(path))
        folder = Path(mkdtemp(prefix=".", suffix=".part", dir=target.parent))
        draft = folder / target.name
        try:
            yield draft
            _settle(draft)
            os.replace(draft, target)
        finally:
            draft.unlink(missing_ok=True)
            folder.rmdir()
    except (OSError, ValueError) as error:  # ValueError: a name that cannot be a file's
        if isinstance(error, SeiswidgetsError):
            raise
        reason = getattr(error, "strerror", None) or error
        raise DataError(
            f"{path} cannot be written: {reason}; make room, or choose a folder that exists and that you may write to. "
            "What stood there is unchanged"
        ) from error
    with contextlib.suppress(OSError):
        _settle(target.parent)  # lets the move itself survive a power cut, where the system can do that


def write_whole(path: Path, content: bytes) -> None:
    """Write a file as `written` does."""
    with written(path) as draft:
        draft.write_bytes(content)


def _settle(path):
    """Wait until a file or folder is on the disk."""
    handle = os.open(path, os.O_RDONLY if path.is_dir() else os.O_RDWR)  # Windows settles no file that is only read
    try:
        os.fsync(handle)
    finally:
        os.close(handle)


def required(package: str, purpose: str):
    """A package of the extra ``files``, imported; ``purpose`` says for what it is needed, as "to read line.sgy".

    Raises
    ------
    DataError
        If it is not installed; the message says how to install it.
    """
    try:
        return import_module(package)
    except ModuleNotFoundError as error:
        raise DataError(
            f"{purpose} takes the package {package}, which is not installed: pip install {package}, "
            'or "seiswidgets[files]" for all that files may need'
        ) from error
