"""Files out, whole or not at all."""

import contextlib
import os
from contextlib import contextmanager
from pathlib import Path
from tempfile import mkdtemp

from seiswidgets.errors import DataError, SeiswidgetsError, SettingError
from seiswidgets.io.paths import user_path


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
