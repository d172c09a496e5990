"""Numbers as students write them: with units, decimal commas and fractions, as shares or percents."""

import math
import re
from dataclasses import dataclass


@dataclass(frozen=True)
class Kind:
    """A kind of quantity: its name, the value of each spelling of a unit, and what a bare number may mean too."""

    name: str
    units: dict[str, float]
    bare: tuple[tuple[float, str], ...] = ()  # factor, and how it is called


TURN = 180 / math.pi
LENGTHS = {"m": 1.0, "metre": 1.0, "meter": 1.0, "km": 1e3, "kilometre": 1e3, "kilometer": 1e3}
LENGTHS |= {"cm": 0.01, "mm": 1e-3, "ft": 0.3048, "foot": 0.3048, "feet": 0.3048}
TIMES = {"ms": 1.0, "msec": 1.0, "millisecond": 1.0, "s": 1e3, "sec": 1e3, "second": 1e3}
ANGLES = {"°": 1.0, "deg": 1.0, "degree": 1.0, "rad": TURN, "radian": TURN}
KINDS = {  # by the unit that is asked for
    "m": Kind("a length", LENGTHS, ((1e3, "kilometres"),)),
    "ms": Kind("a time", TIMES, ((1e3, "seconds"),)),
    "°": Kind("an angle", ANGLES, ((TURN, "radians"),)),
    "%": Kind("a share", {"%": 1.0, "percent": 1.0, "x": 100.0, "×": 100.0, "time": 100.0}, ((100.0, "a share of 1"),)),
    "": Kind("a plain number", {"x": 1.0, "×": 1.0, "time": 1.0, "%": 0.01, "percent": 0.01}, ((0.01, "percent"),)),
}
SIGNS = str.maketrans("−–‐‑－,", "-----.")  # characters that look like a minus, and a decimal comma
NUMBER = re.compile(r"[~≈=]?([-+]?[\d.]+(?:e[-+]?\d+)?)(?:/([\d.]+))?([^\d.]*)")


@dataclass(frozen=True)
class Quantity:
    """A value in the unit that is asked for, and a note on how it was read, which may be empty."""

    value: float
    note: str = ""


def describe(value: float, unit: str) -> str:
    """A value with its unit, as in prose."""
    return f"{value:.4g}{unit if unit in ('', '°') else f' {unit}'}"


def read_quantity(given: object, unit: str) -> list[Quantity] | str:
    """Readings of a number in a unit, the plainest first, or else a sentence on why it is none."""
    text = str(given).strip()
    found = NUMBER.fullmatch(re.sub(r"\s", "", text).lower().translate(SIGNS))
    value = _value(*found.groups()[:2]) if found else None
    if value is None:
        asked = f", in {unit}" if unit else ""
        start = f"{text[:40]!r} is not a number. Give one" if text else "Give a number"
        return f"{start}{asked}, such as 12.5."
    spelt, kind = found[3], KINDS[unit]
    if not spelt:
        rescaled = [Quantity(value * factor, _note(value * factor, unit, name)) for factor, name in kind.bare]
        return [Quantity(value), *(rescaled if value else [])]
    factor = _factor(spelt, kind)
    if factor is not None:
        scaled = value * factor
        return [Quantity(scaled, "" if factor == 1 else f"That is {describe(scaled, unit)}. ")]
    asked = f"{kind.name}{f', in {unit}' if unit else ''}"
    other = next((one.name for one in KINDS.values() if _factor(spelt, one) is not None), None)
    return f"{text} is {other}; asked is {asked}." if other else f"The unit of {text!r} is unknown; asked is {asked}."


def _note(value, unit, name):
    return f"Read as {name}, that is {describe(value, unit)}. "


def _factor(spelt, kind):
    """The value of a unit, in the singular or the plural, or None."""
    singular = spelt.removesuffix("s") if len(spelt) > 3 else spelt  # "ms" are no metres
    return kind.units.get(spelt, kind.units.get(singular))


def _value(number, divisor):
    try:
        value = float(number) / float(divisor or 1)
    except (ValueError, ZeroDivisionError):
        return None
    return value if math.isfinite(value) else None
