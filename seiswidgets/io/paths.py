"""Paths as users give them."""

from os import PathLike
from pathlib import Path
from reprlib import repr as brief

from seiswidgets.errors import DataError


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
