"""Text and JSON files that others may have written, read within limits; errors name the file and the location in it."""

import json
import re
import reprlib
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NoReturn, ParamSpec, TypeVar

import numpy as np

from seiswidgets.errors import DataError, SeiswidgetsError, Text

MOST_TEXT_BYTES = 64 * 2**20  # the order of magnitude of an exported horizon of a 3-D survey
MOST_JSON_BYTES = 8 * 2**20  # about 200,000 points; as Python values they may take 25 times as much memory
MOST_POINTS = 300_000  # in an export, on one line: many horizons with many traces
LARGEST_NUMBER = 1e12  # beyond any coordinate, and far enough from overflow to compute with
POINT = re.compile(r"\[\n\s*([-+.\deE]+),\n\s*([-+.\deE]+)\n\s*\]")  # no string contains a line end: JSON escapes it
LINE = re.compile(r"[^\r\n]*(?:\r\n|\r|\n|\Z)")
REMEDY = "correct it in a text editor, or go back to an earlier copy"

Point = tuple[float, float]
Points = tuple[Point, ...]
Arguments = ParamSpec("Arguments")
Value = TypeVar("Value")
Default = TypeVar("Default")


def read_text(path: Path, most: int = MOST_TEXT_BYTES) -> str:
    """Read a UTF-8 text file, leaving line ends as they are.

    Raises
    ------
    DataError
        If there is no such file, or it cannot be read, is larger than ``most`` bytes, or is not UTF-8.
    """
    try:
        if not path.is_file():
            raise DataError(f"there is no file {path}; check its name and folder")
        if path.stat().st_size > most:
            raise DataError(
                f"{path} holds {path.stat().st_size / 2**20:.0f} MiB, but the limit for the picks of one section is "
                f"{most / 2**20:.0f} MiB; export the picks of that section alone, if this is a file of picks at all"
            )
        with path.open("rb") as file:
            return file.read(most).decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise DataError(
            f"{path} is not UTF-8 text: byte 0x{error.object[error.start]:02x} at {error.start}; save it again as "
            "UTF-8, if it is text at all"
        ) from None
    except DataError:
        raise
    except (OSError, ValueError) as error:  # ValueError: a name that the system does not allow
        raise DataError(f"{path} cannot be read: {error}; check its name and permissions") from error


def text_lines(text: str) -> Iterator[str]:
    """Iterate over a text's lines, with their ends, as text editors count them (unlike ``str.splitlines``)."""
    return (match[0] for match in LINE.finditer(text) if match[0])


def read_json(path: Path) -> "Entry":
    """Read a JSON file.

    Raises
    ------
    DataError
        As for `read_text` and `parse_json`.
    """
    return parse_json(read_text(path, MOST_JSON_BYTES), path)


def parse_json(text: str, path: Path) -> "Entry":
    """Parse a JSON text; errors name the path as its origin.

    Raises
    ------
    DataError
        If it is not valid JSON; NaN and Infinity are not.
    """
    try:
        return Entry(json.loads(text, parse_constant=_refuse_constant), path)
    except RecursionError:
        raise DataError(f"{path} is nested more deeply than any file of seiswidgets; {REMEDY}") from None
    except ValueError as error:
        raise DataError(f"{path} is not valid JSON: {error}; {REMEDY}") from None


def check_file_size(path: Path, content: bytes, most: int = MOST_JSON_BYTES) -> None:
    """Raise DataError for content that would be too large to be read again."""
    if len(content) > most:
        raise DataError(
            f"{path} would hold {len(content) / 2**20:.0f} MiB, more than the {most / 2**20:.0f} MiB that can be read "
            "again; keep fewer points in the lines, or fewer picks"
        )


def shortened(text: str, most: int = 600) -> str:
    """A text without its middle part, if it is longer than ``most`` characters."""
    return text if len(text) <= most else f"{text[: most // 2]} ... {text[-most // 2 :]}"


def json_text(value: object) -> str:
    """Readable JSON with one point per line and exact numbers."""
    text = json.dumps(value, indent=1, allow_nan=False, default=_python_number)
    return POINT.sub(r"[\1, \2]", text) + "\n"


def _python_number(value: object) -> Any:
    if isinstance(value, np.generic):
        return value.item()
    raise TypeError(f"{value!r} is not a number, a string or a list")


def _refuse_constant(constant: str) -> NoReturn:
    raise ValueError(f"{constant} is not a number in JSON")


@dataclass(frozen=True)
class Entry:
    """A value in a JSON file, with its location there.

    Every method raises a DataError that names file and location if the value is not what the method returns.
    """

    value: Any
    path: Path
    location: str = ""

    @property
    def full_location(self) -> str:
        """The file, and the location in it."""
        return f"{self.path}: {self.location}" if self.location else str(self.path)

    def error(self, must: str) -> DataError:
        """Make the error for a value that is not what it must be."""
        return DataError(f"{self.full_location} must be {must}, but is {_brief(self.value)}; {REMEDY}")

    def __getitem__(self, key: str) -> "Entry":
        if key not in self.members():
            raise DataError(f"{self.full_location} lacks {key!r}; {REMEDY}")
        return Entry(self.value[key], self.path, f"{self.location}.{key}" if self.location else key)

    def optional(self, key: str, read: Callable[["Entry"], Value], default: Default) -> Value | Default:
        """Read a member, or return the default if it is null or missing."""
        return default if self.members().get(key) is None else read(self[key])

    def build(
        self, make: Callable[Arguments, Value], *arguments: Arguments.args, **keywords: Arguments.kwargs
    ) -> Value:
        """Call a constructor; its errors are given the file's name and the location."""
        try:
            return make(*arguments, **keywords)
        except SeiswidgetsError as error:
            message = shortened(error.text)
            text = error.text if message == error.text else Text(message)
            raise DataError(f"{self.full_location}: ", text, kind=error.kind, pick=error.pick) from error

    def members(self) -> dict[str, Any]:
        """The value as a dict."""
        if not isinstance(self.value, dict):
            raise self.error("an object {...}")
        return self.value

    def items(self) -> Iterator["Entry"]:
        """Iterate over the values of a list, made one by one: millions at once would take much memory."""
        if not isinstance(self.value, list):
            raise self.error("a list [...]")
        return (Entry(value, self.path, f"{self.location}[{index}]") for index, value in enumerate(self.value))

    def text(self) -> str:
        """The value as a string without unpaired surrogates."""
        if not isinstance(self.value, str) or any("\ud800" <= letter <= "\udfff" for letter in self.value):
            raise self.error("text")
        return self.value

    def flag(self) -> bool:
        """The value as true or false."""
        if not isinstance(self.value, bool):
            raise self.error("true or false")
        return self.value

    def number(self) -> float:
        """The value as a number small enough to compute with."""
        if not _is_number(self.value):
            raise self.error(f"a number within ±{LARGEST_NUMBER:g}")
        return float(self.value)

    def point(self) -> Point:
        """The value as (x, z)."""
        if not _is_point(self.value):
            raise self.error(f"a point [x, z] of two numbers within ±{LARGEST_NUMBER:g}")
        return float(self.value[0]), float(self.value[1])

    def points(self) -> Points:
        """The value as a line of points (x, z)."""
        if not isinstance(self.value, list):
            raise self.error("a list of points [x, z]")
        for index, value in enumerate(self.value):
            if not _is_point(value):
                Entry(value, self.path, f"{self.location}[{index}]").point()
        return tuple((float(x), float(z)) for x, z in self.value)


def _is_number(value: object) -> bool:
    return type(value) in (int, float) and abs(value) <= LARGEST_NUMBER  # type: ignore[arg-type]  # a number by now


def _is_point(value: object) -> bool:
    return type(value) is list and len(value) == 2 and _is_number(value[0]) and _is_number(value[1])


def _brief(value: object) -> str:
    """A value as shown in an error: at most a line, however large it is."""
    if isinstance(value, dict | list):
        return f"{'an object' if isinstance(value, dict) else 'a list'} of {len(value)}"
    if isinstance(value, int) and abs(value) > LARGEST_NUMBER:
        return f"a whole number of {value.bit_length()} bits"
    return json.dumps(value) if value is None or isinstance(value, bool) else reprlib.repr(value)
