"""Validation of what users pass in: numbers, points, picks and keywords."""

from collections.abc import Iterable

import numpy as np
from numpy.typing import ArrayLike

from seiswidgets.errors import PickError, SettingError, number_text
from seiswidgets.geology.clipping import onto_border
from seiswidgets.geology.picks import Fault, Horizon, Pick
from seiswidgets.geology.section import Section


def finite_number(name: str, value: object) -> float:
    """Validate a finite number; a SettingError names it."""
    try:
        number = float(value)  # type: ignore[arg-type]  # what cannot be converted raises
    except (TypeError, ValueError):
        number = np.nan
    if not np.isfinite(number):
        raise SettingError(f"{name} must be a finite number, but is {value!r}")
    return number


def whole_number(name: str, value: object, least: int) -> int:
    """Validate an integer >= ``least``; a SettingError names it."""
    if isinstance(value, bool) or not isinstance(value, int | np.integer) or value < least:
        raise SettingError(f"{name} must be a whole number of {least} or more, but is {value!r}")
    return int(value)


def as_points(rows: ArrayLike) -> np.ndarray:
    """Convert rows (x, z) to an array of shape (n, 2)."""
    try:
        array = np.asarray(rows, float)
    except (TypeError, ValueError):
        raise SettingError("points must be rows (x, z) of two numbers each") from None
    if array.shape[-1:] != (2,):
        raise SettingError(f"points must be rows (x, z), of shape (n, 2), but have shape {array.shape}")
    return array.reshape(-1, 2)


def held_point(value: ArrayLike) -> tuple[float, float]:
    """Validate a point (x, z) whose block is held."""
    try:
        point = np.asarray(value, float)
    except (TypeError, ValueError):
        point = np.full(2, np.nan)
    if point.shape != (2,) or not np.isfinite(point).all():
        raise PickError(f"fixed must be a point (x, z) of two finite numbers, but is {value!r}")
    return float(point[0]), float(point[1])


def held_points(name: str, points: Iterable[ArrayLike]) -> tuple[tuple[float, float], ...]:
    """Validate points (x, z) that are held; ``name`` is the keyword they were given by."""
    try:
        return tuple(held_point(point) for point in points)
    except (TypeError, PickError):
        raise PickError(f"{name} must be points (x, z) of two finite numbers each, but is {points!r}") from None


def named_picks(picks: Pick | Iterable[Pick], kind: type[Pick], word: str) -> dict[str, Pick]:
    """Faults or horizons by name, from one or several; a repeated name gets a number appended.

    Parameters
    ----------
    picks : Fault, Horizon, or several
    kind : type
        Fault or Horizon.
    word : str
        Name of the kind in errors.
    """
    if isinstance(picks, Fault | Horizon) or not isinstance(picks, Iterable):
        picks = [picks]
    named: dict[str, Pick] = {}
    for pick in picks:
        if not isinstance(pick, kind):
            raise PickError(
                f"expected a {word}, a seiswidgets.{kind.__name__}, but got a {type(pick).__name__}: {pick!r}"
            )
        name, count = pick.name, 2
        while name in named:
            name, count = f"{pick.name} ({count})", count + 1
        named[name] = pick
    return named


def point_in_section(section: Section, point: np.ndarray, what: str) -> np.ndarray:
    """Validate a point of the section, shape (2,), and convert it to metres of rock.

    Raises
    ------
    PickError
        If it lies outside by more than rounding; ``what`` names it.
    """
    clipped = onto_border(section, point)
    if not section.contains(clipped):
        x, z = point.tolist()
        raise PickError(
            f"{what} lies outside the section, at ({number_text(x)} {section.x_unit}, {number_text(z)} "
            f"{section.z_unit}); the section reaches from {section.reach}",
            kind="held outside",
            where=(x, z),
        )
    return section.to_rock(clipped)


def checked_kind(value: object, kind: type, name: str) -> None:
    """Raise a SettingError if an argument is not an instance of a class."""
    if not isinstance(value, kind):
        raise SettingError(f"{name} must be {_with_article(kind)}, but is {_with_article(type(value))}")


def _with_article(kind: type) -> str:
    return f"{'an' if kind.__name__[0] in 'AEIOUaeiou' else 'a'} {kind.__name__}"
