"""Files out, whole or not at all."""

import os
from contextlib import contextmanager
from pathlib import Path
from tempfile import mkdtemp

from seiswidgets.errors import DataError, SettingError


def checked_path(path, suffixes: tuple[str, ...]) -> Path:
    """The path of a file to write, by one of the endings that say its kind.

    Raises
    ------
    SettingError
        If it ends otherwise.
    """
    path = Path(path).expanduser()
    if path.suffix.lower() not in suffixes:
        raise SettingError(f"{path} must end in {' or '.join(suffixes)}, which says what kind of file it becomes")
    return path


@contextmanager
def written(path: Path):
    """A place to write a file's content to; what stood at the path is replaced only when all of it is there.

    Raises
    ------
    DataError
        If the folder is missing, cannot be written to, or is full.
    """
    try:
        folder = Path(mkdtemp(prefix=".", suffix=".part", dir=path.parent))
        draft = folder / path.name
        try:
            yield draft
            os.replace(draft, path)
        finally:
            draft.unlink(missing_ok=True)
            folder.rmdir()
    except OSError as error:
        if isinstance(error, DataError):
            raise
        raise DataError(
            f"{path} cannot be written: {error.strerror or error}; choose a folder that exists, with room, and of "
            "your own. What stood there is unchanged"
        ) from error
