"""Text and JSON from files that others may have written: read within a limit, with errors that name file and place."""

import json
import re
import reprlib
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from seiswidgets.errors import DataError

LARGEST_TEXT = 64 * 2**20  # bytes; a horizon of a 3-D survey, exported, is of that order
LARGEST_OURS = 8 * 2**20  # about 200,000 points; as Python values the worst takes 25 times as much
MOST_POINTS = 300_000  # of an export, on one line: many horizons of many traces
LARGEST_NUMBER = 1e12  # beyond any coordinate, and far enough from overflow to compute with
POINT = re.compile(r"\[\n\s*([-+.\deE]+),\n\s*([-+.\deE]+)\n\s*\]")  # no text holds a line end: JSON escapes it
LINE = re.compile(r"[^\r\n]*(?:\r\n|\r|\n|\Z)")
REMEDY = "mend that in a text editor, or go back to an earlier copy"


def read_text(path: Path, largest: int = LARGEST_TEXT) -> str:
    """A file's text, which must be UTF-8; line ends are left as they are.

    Raises
    ------
    DataError
        If there is no such file, or it cannot be read, is larger than so many bytes, or is not UTF-8.
    """
    try:
        if not path.is_file():
            raise DataError(f"there is no file {path}; check its name and folder")
        if path.stat().st_size > largest:
            raise DataError(
                f"{path} holds {path.stat().st_size / 2**20:.0f} MiB, and picks of one section fit in "
                f"{largest / 2**20:.0f}; export that section's picks alone, if it is a file of picks at all"
            )
        with path.open("rb") as file:
            return file.read(largest).decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise DataError(
            f"{path} is not UTF-8 text: byte 0x{error.object[error.start]:02x} at {error.start}; save it again as "
            "UTF-8, if it is text at all"
        ) from None
    except DataError:
        raise
    except (OSError, ValueError) as error:  # ValueError: a name that cannot be a file's
        raise DataError(f"{path} cannot be read: {error}; check its name and permissions") from error


def lines(text: str) -> Iterator[str]:
    """The lines of a text, with their ends, one after the other: as editors count them, unlike ``splitlines``."""
    return (match[0] for match in LINE.finditer(text) if match[0])


def read_json(path: Path) -> "Entry":
    """What a JSON file holds.

    Raises
    ------
    DataError
        As for `read_text` and `parse_json`.
    """
    return parse_json(read_text(path, LARGEST_OURS), path)


def parse_json(text: str, path: Path) -> "Entry":
    """What a JSON text holds; errors name the path as the place that it comes from.

    Raises
    ------
    DataError
        If it is not JSON; NaN and Infinity are not.
    """
    try:
        return Entry(json.loads(text, parse_constant=_refused), path)
    except RecursionError:
        raise DataError(f"{path} is nested more deeply than any file of ours; {REMEDY}") from None
    except ValueError as error:
        raise DataError(f"{path} is not valid JSON: {error}; {REMEDY}") from None


def check_size(path: Path, content: bytes, largest: int) -> None:
    """Refuse, with a DataError, to write what could not be read again."""
    if len(content) > largest:
        raise DataError(
            f"{path} would hold {len(content) / 2**20:.0f} MiB, and only {largest / 2**20:.0f} could be read again; "
            "keep fewer points in the lines, or fewer picks"
        )


def shortened(text: str, most: int = 600) -> str:
    """A message without the middle of an endless name in it."""
    return text if len(text) <= most else f"{text[: most // 2]} ... {text[-most // 2 :]}"


def json_text(value) -> str:
    """A value as JSON that a person can read: a point a line, and every number as exact as it is."""
    text = json.dumps(value, indent=1, allow_nan=False, default=_plain_number)
    return POINT.sub(r"[\1, \2]", text) + "\n"


def _plain_number(value):
    if isinstance(value, np.generic):
        return value.item()
    raise TypeError(f"{value!r} is no number, text or list")


def _refused(constant):
    raise ValueError(f"{constant} is no number in JSON")


@dataclass(frozen=True)
class Entry:
    """A value in a JSON file, which knows its place there.

    Every method raises a DataError that names both if the value is not what the method asks for.
    """

    value: object
    path: Path
    place: str = ""

    def error(self, must: str) -> DataError:
        """What to raise if this value is not what it must be."""
        where = f": {self.place}" if self.place else ""
        return DataError(f"{self.path}{where} must be {must}, but is {_short(self.value)}; {REMEDY}")

    def __getitem__(self, key: str) -> "Entry":
        return Entry(self.members()[key], self.path, self._place_of(key)) if key in self.members() else self._lacks(key)

    def _lacks(self, key):
        where = f": {self.place}" if self.place else ""
        raise DataError(f"{self.path}{where} lacks {key!r}; {REMEDY}")

    def _place_of(self, key):
        return f"{self.place}.{key}" if self.place else key

    def optional(self, key: str, read: Callable[["Entry"], object], default=None):
        """A member read by one of these methods, or the default if it is null or not there."""
        value = self.members().get(key)
        return default if value is None else read(Entry(value, self.path, self._place_of(key)))

    def members(self) -> dict:
        """The value as a dict."""
        if not isinstance(self.value, dict):
            raise self.error("an object {...}")
        return self.value

    def items(self) -> Iterator["Entry"]:
        """The values of a list, one after the other: millions at once would take much memory."""
        if not isinstance(self.value, list):
            raise self.error("a list [...]")
        return (Entry(value, self.path, f"{self.place}[{number}]") for number, value in enumerate(self.value))

    def text(self) -> str:
        """The value as text, of whole characters."""
        if not isinstance(self.value, str) or any("\ud800" <= letter <= "\udfff" for letter in self.value):
            raise self.error("text")
        return self.value

    def flag(self) -> bool:
        """The value as true or false."""
        if not isinstance(self.value, bool):
            raise self.error("true or false")
        return self.value

    def number(self) -> float:
        """The value as a number that can be computed with."""
        if not _is_number(self.value):
            raise self.error(f"a number within ±{LARGEST_NUMBER:g}")
        return float(self.value)

    def point(self) -> tuple[float, float]:
        """The value as (x, z)."""
        if not _is_point(self.value):
            raise self.error(f"a point [x, z], of two numbers within ±{LARGEST_NUMBER:g}")
        return float(self.value[0]), float(self.value[1])

    def points(self) -> tuple[tuple[float, float], ...]:
        """The value as a line of points (x, z)."""
        if not isinstance(self.value, list):
            raise self.error("a list of points [x, z]")
        for number, value in enumerate(self.value):
            if not _is_point(value):
                Entry(value, self.path, f"{self.place}[{number}]").point()
        return tuple((float(x), float(z)) for x, z in self.value)


def _is_number(value):
    return type(value) in (int, float) and abs(value) <= LARGEST_NUMBER


def _is_point(value):
    return type(value) is list and len(value) == 2 and _is_number(value[0]) and _is_number(value[1])


def _short(value):
    """A value in an error: no longer than a line, however large it is."""
    if isinstance(value, dict | list):
        return f"{'an object' if isinstance(value, dict) else 'a list'} of {len(value)}"
    if isinstance(value, int) and abs(value) > LARGEST_NUMBER:
        return f"a whole number of {value.bit_length()} bits"
    return json.dumps(value) if value is None or isinstance(value, bool) else reprlib.repr(value)
