"""Numbers in text files of picks."""

from math import nan
from pathlib import Path

from seiswidgets.errors import DataError
from seiswidgets.io.document import LARGEST_NUMBER

UNDEFINED = 9_999_900  # and more: other programs write 9999900, 9999999 or 1e30 where there is no pick


def number(path: Path, place: str, what: str, text: str) -> float:
    """A number that can be computed with, or a DataError that names file, place and column."""
    value = _float(text)
    if not abs(value) <= LARGEST_NUMBER:  # not: so that NaN is refused
        raise DataError(
            f"{path}: {place}: {what} must be a number within ±{LARGEST_NUMBER:g}, but is {text[:60]!r}; correct or "
            "delete that row"
        )
    return value


def depth(path: Path, place: str, text: str) -> float:
    """A depth or time as `number` has it, or NaN for another program's way to say that there is no pick."""
    undefined = text == "-" or abs(_float(text)) >= UNDEFINED
    return nan if undefined else number(path, place, "Z", text)


def _float(text):
    try:
        return float(text)
    except ValueError:
        return nan
