"""Numbers in text files of picks."""

from pathlib import Path

from seiswidgets.errors import DataError
from seiswidgets.io.document import LARGEST_NUMBER

UNDEFINED = 1e29  # other programs write 1e30 where there is no pick


def number(path: Path, place: str, what: str, text: str) -> float:
    """A number that can be computed with, or a DataError that names file, place and column."""
    value = _float(text)
    if not abs(value) <= LARGEST_NUMBER:  # not: so that NaN is refused
        raise DataError(
            f"{path}: {place}: {what} must be a number within ±{LARGEST_NUMBER:g}, but is {text[:60]!r}; correct or "
            "delete that row"
        )
    return value


def undefined(text: str) -> bool:
    """Whether another program's way to say that there is no pick."""
    return text == "-" or abs(_float(text)) >= UNDEFINED


def _float(text):
    try:
        return float(text)
    except ValueError:
        return float("nan")
