"""What users ask a restoration for, checked at the door: numbers, points and picks."""

import numpy as np

from seiswidgets.errors import PickError, SettingError
from seiswidgets.geology.picks import Fault, Horizon
from seiswidgets.geology.section import Section

ROUNDING = 1e-6  # of a trace or a sample


def finite_number(name: str, value) -> float:
    """A finite number, or a SettingError that names it."""
    try:
        asked = float(value)
    except (TypeError, ValueError):
        asked = np.nan
    if not np.isfinite(asked):
        raise SettingError(f"{name} must be a finite number, but is {value!r}")
    return asked


def whole_number(name: str, value, least: int) -> int:
    """A whole number of so much at least, or a SettingError that names it."""
    if isinstance(value, bool) or not isinstance(value, int | np.integer) or value < least:
        raise SettingError(f"{name} must be a whole number of {least} or more, but is {value!r}")
    return int(value)


def as_points(rows) -> np.ndarray:
    """Points as an array of shape (n, 2)."""
    try:
        array = np.asarray(rows, float)
    except (TypeError, ValueError):
        raise SettingError("points must be rows (x, z) of two numbers each") from None
    if array.shape[-1:] != (2,):
        raise SettingError(f"points must be rows (x, z), of shape (n, 2), but have shape {array.shape}")
    return array.reshape(-1, 2)


def held_point(value) -> tuple[float, float]:
    """Validate a point (x, z) whose block is held."""
    try:
        point = np.asarray(value, float)
    except (TypeError, ValueError):
        point = np.full(2, np.nan)
    if point.shape != (2,) or not np.isfinite(point).all():
        raise PickError(f"fixed must be a point (x, z) of two finite numbers, but is {value!r}")
    return float(point[0]), float(point[1])


def named_picks(given, kind: type, word: str) -> dict:
    """Faults or horizons by name, from one or several; a name that comes again gets a number behind it."""
    given = [given] if isinstance(given, Fault | Horizon) else given
    try:
        given = list(given)
    except TypeError:
        given = [given]
    named = {}
    for pick in given:
        if not isinstance(pick, kind):
            raise PickError(
                f"a {word} is asked for, a seiswidgets.{kind.__name__}, but got a {type(pick).__name__}: {pick!r}"
            )
        name, count = pick.name, 2
        while name in named:
            name, count = f"{pick.name} ({count})", count + 1
        named[name] = pick
    return named


def rock_points(section: Section, drawn, what: str) -> np.ndarray:
    """Points of a section in metres of rock; what lies outside by no more than rounding is put on the border.

    Raises
    ------
    PickError
        If a point lies outside; it says which, where, and how far the section reaches.
    """
    x_min, x_max, z_min, z_max = section.extent
    clipped = np.clip(drawn, (x_min, z_min), (x_max, z_max))
    outside = ~(np.abs(drawn - clipped) <= ROUNDING * np.array([section.dx, section.dz])).all(axis=1)
    if outside.any():
        bad = int(np.argmax(outside))
        which = what if len(drawn) == 1 else f"point {bad + 1} of {what}"
        raise PickError(
            f"{which} lies outside the section, at ({drawn[bad, 0]:.6g} {section.x_unit}, "
            f"{drawn[bad, 1]:.6g} {section.z_unit}); the section reaches from x={x_min:g} to {x_max:g} "
            f"{section.x_unit} and from z={z_min:g} to {z_max:g} {section.z_unit}"
        )
    return section.to_rock(clipped)


def checked_kind(value, kind: type, name: str):
    """SettingError if an argument is not of the class that it must be of."""
    if not isinstance(value, kind):
        raise SettingError(f"{name} must be {_a(kind)}, but is {_a(type(value))}")


def _a(kind):
    return f"{'an' if kind.__name__[0] in 'AEIOUaeiou' else 'a'} {kind.__name__}"
