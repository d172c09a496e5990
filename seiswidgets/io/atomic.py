"""Files that are there as a whole or not at all, whatever happens while they are written."""

import contextlib
import os
import uuid
from pathlib import Path

from seiswidgets.errors import DataError


def write_atomically(path: Path, content: bytes) -> None:
    """Write a file beside its place, then move it there; an older file of that name stays until then.

    Raises
    ------
    DataError
        If it cannot be written: the disk is full or read-only, or its folder is gone.
    """
    beside = path.with_name(f".{path.name[:100]}.{uuid.uuid4().hex}.tmp")
    try:
        with beside.open("xb") as file:
            file.write(content)
            file.flush()
            os.fsync(file.fileno())
        os.replace(beside, path)
    except (OSError, ValueError) as error:  # ValueError: a name that cannot be a file's
        with contextlib.suppress(OSError, ValueError):
            beside.unlink()
        reason = error.strerror if isinstance(error, OSError) and error.strerror else error
        raise DataError(
            f"{path} cannot be written: {reason}; make room, or choose a folder that you may write to"
        ) from error
    _sync_folder(path.parent)


def _sync_folder(folder):
    """Let the move itself survive a power cut, where the system can do that."""
    with contextlib.suppress(OSError):
        handle = os.open(folder, os.O_RDONLY)
        try:
            os.fsync(handle)
        finally:
            os.close(handle)
