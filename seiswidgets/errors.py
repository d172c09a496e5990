"""Errors for the person at the keyboard: each carries what it is about in fields, and renders its text from them."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any


@dataclass(frozen=True)
class Keyword:
    """A keyword argument named in a message, which every front end shows in its own terms.

    Code sees ``dx=`` or ``z_unit="m"``, the app the label of the field, the command line its option.

    Parameters
    ----------
    name : str
    value : object, optional
        The value that is advised.
    """

    name: str
    value: object = None

    def __str__(self) -> str:
        return f"{self.name}=" if self.value is None else f"{self.name}={self.value!r}"


def number_text(value: float) -> str:
    """Text for a coordinate: six digits, and never an exponent where it is large."""
    text = f"{value:.6g}" if abs(value) < 1e6 else f"{value:.1f}".removesuffix(".0")
    return "0" if abs(value) < 1e-9 else text


class Text(str):
    """A message that knows the keywords it names.

    It is an ordinary string in the terms of a Python caller; ``rendered`` puts it in the terms of a front end.

    Parameters
    ----------
    *parts : str or Keyword
        Joined without blanks between them.
    """

    parts: tuple[str | Keyword, ...]

    def __new__(cls, *parts: str | Keyword) -> "Text":
        """Join the parts."""
        text = super().__new__(cls, "".join(map(str, parts)))
        text.parts = tuple(inner for part in parts for inner in (part.parts if isinstance(part, Text) else (part,)))
        return text

    def rendered(self, labels: Mapping[str, str]) -> str:
        """Render the message with a label in place of each keyword that has one."""
        return "".join(_labelled(part, labels) if isinstance(part, Keyword) else part for part in self.parts)


def _labelled(keyword: Keyword, labels: Mapping[str, str]) -> str:
    if keyword.name not in labels:
        return str(keyword)
    label = labels[keyword.name]
    return label if keyword.value in (None, True) else f"{label} {keyword.value}"


class SeiswidgetsError(Exception):
    """Base class of every error that seiswidgets raises on purpose.

    Parameters
    ----------
    *parts : str or Keyword
        The message: what must hold, what was found, and a way out.
    kind : str
        A short key for programs; "" if none.
    pick : str, optional
        Name of the fault or horizon concerned.
    where : (x, z), optional
        Position in the section's units.
    """

    def __init__(
        self,
        *parts: str | Keyword,
        kind: str = "",
        pick: str | None = None,
        where: tuple[float, float] | None = None,
    ):
        self.text = Text(*parts)
        self.kind, self.pick, self.where = kind, pick, where
        super().__init__(self.text)


class SectionError(SeiswidgetsError, ValueError):
    """Amplitudes, spacing or units that do not make a section."""


class PickError(SeiswidgetsError, ValueError):
    """A fault, a horizon or a held point that cannot be used as it was drawn."""


class SettingError(SeiswidgetsError, ValueError):
    """A weight, a spacing, a datum or another choice that is out of its range."""


class DataError(SeiswidgetsError, OSError):
    """A data file that is missing, damaged or out of reach."""


class FlippedError(SeiswidgetsError):
    """A solution that would turn triangles over, so that it maps two points onto one.

    Attributes
    ----------
    count : int
        Number of triangles turned over.
    """

    def __init__(self, *parts: str | Keyword, count: int = 0, **fields: Any):
        super().__init__(*parts, **fields)
        self.count = count


class Cancelled(SeiswidgetsError):
    """A progress callback returned False; the restoration it was called on is unchanged."""
