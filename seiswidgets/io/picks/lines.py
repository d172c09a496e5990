"""Lines as read from a pick file, and the interpretation made from them."""

import warnings
from dataclasses import dataclass, replace
from math import nan
from pathlib import Path

import numpy as np

from seiswidgets.errors import DataError, Keyword, PickError, SettingError, Text
from seiswidgets.geology.bodies import BODY, SALT, Body
from seiswidgets.geology.picks import AUTO, CONSTRAIN, FAULT, HORIZON, Fault, Horizon, Interpretation
from seiswidgets.geology.section import METRES, SECONDS, Section
from seiswidgets.io.document import LARGEST_NUMBER, Points, shortened

UNDEFINED = 9_999_900  # and above: other programs write 9999900, 9999999 or 1e30 where there is no pick


@dataclass(frozen=True)
class PickLine:
    """A fault, a body, or a piece of a horizon, as points (x, z), with its location in the file, its use and its ends.

    The use of a body is its kind, "salt" or "no data".
    """

    kind: str
    name: str
    points: Points
    location: str
    use: str = CONSTRAIN
    ends: str = AUTO


@dataclass(frozen=True)
class FileLines:
    """Lines of a file, and their units where it states them."""

    lines: tuple[PickLine, ...]
    x_unit: str | None = None
    z_unit: str | None = None


def build_interpretation(path: Path, lines: tuple[PickLine, ...]) -> Interpretation:
    """Join lines of the same name into picks: a fault is one line, a horizon has all of its pieces.

    Raises
    ------
    DataError
        If a line cannot be a pick; it names the file, the location and the pick.
    """
    named: dict[tuple[str, str], list[PickLine]] = {}
    for line in lines:
        named.setdefault((line.kind, line.name), []).append(line)
    faults = [_fault(path, name, pieces) for (kind, name), pieces in named.items() if kind == FAULT]
    horizons = [_horizon(path, name, pieces) for (kind, name), pieces in named.items() if kind == HORIZON]
    bodies = [_body(path, name, pieces) for (kind, name), pieces in named.items() if kind == BODY]
    return Interpretation(tuple(faults), tuple(horizons), tuple(bodies))


def _check_single(path: Path, name: str, pieces: list[PickLine]) -> None:
    if len(pieces) > 1:
        kind = pieces[0].kind
        raise DataError(
            f"{path}: {pieces[1].location} is a second line of {kind} {shortened(repr(name))}, after "
            f"{pieces[0].location}; a {kind} is one line, so give each line a name of its own",
            pick=name,
        )


def _body(path: Path, name: str, pieces: list[PickLine]) -> Body:
    _check_single(path, name, pieces)
    try:
        return Body(np.array(pieces[0].points), SALT if pieces[0].use == CONSTRAIN else pieces[0].use, name)
    except (PickError, SettingError) as error:
        raise _located_error(path, pieces[0], error) from error


def _fault(path: Path, name: str, pieces: list[PickLine]) -> Fault:
    _check_single(path, name, pieces)
    try:
        first, _, last = pieces[0].ends.partition(" ")
        return Fault(np.array(pieces[0].points), name, (first, last or first), pieces[0].use)
    except (PickError, SettingError) as error:
        raise _located_error(path, pieces[0], error) from error


def _horizon(path: Path, name: str, pieces: list[PickLine]) -> Horizon:
    try:
        return Horizon(*(np.array(piece.points) for piece in pieces), name=name, use=pieces[0].use)
    except (PickError, SettingError) as error:
        raise _located_error(path, pieces[0], error) from error


def choices_of(pick: Fault | Horizon | Body) -> tuple[str, str]:
    """Use and ends of a pick, or a body's kind, as in a file: one word for the ends if both are the same."""
    use = pick.kind if isinstance(pick, Body) else pick.use
    return use, " ".join(dict.fromkeys(pick.ends if isinstance(pick, Fault) else (AUTO,)))


def _located_error(path: Path, line: PickLine, error: PickError | SettingError) -> DataError:
    message = shortened(error.text)
    text = error.text if message == error.text else Text(message)
    return DataError(f"{path}: {line.location}: ", text, pick=line.name, where=error.where)


def in_section_units(path: Path, file_lines: FileLines, section: Section) -> tuple[PickLine, ...]:
    """Convert lines to the units of a section; they are returned unchanged if the units agree."""
    x_factor = _factor(path, "x_unit", file_lines.x_unit, section.x_unit)
    z_factor = _factor(path, "z_unit", file_lines.z_unit, section.z_unit)
    if x_factor == z_factor == 1:
        return file_lines.lines
    return tuple(_scaled(line, x_factor, z_factor) for line in file_lines.lines)


def _scaled(line: PickLine, x_factor: float, z_factor: float) -> PickLine:
    return replace(line, points=tuple((x * x_factor, z * z_factor) for x, z in line.points))


def _factor(path: Path, axis: str, unit: str | None, section_unit: str) -> float:
    """The file's unit as a multiple of the section's."""
    known = METRES if axis == "x_unit" else METRES | SECONDS
    if unit is None:
        raise DataError(f"{path} does not state its {axis}; give ", Keyword(axis), f", one of {', '.join(known)}")
    if unit not in tuple(known):
        raise DataError(f"{path}: {axis} must be one of {', '.join(known)}, but is {shortened(repr(unit))}")
    if unit == section_unit:
        return 1
    family = METRES if unit in METRES else SECONDS
    if section_unit not in family:
        file_kind, section_kind = ("depth", "two-way time") if family is METRES else ("two-way time", "depth")
        raise DataError(
            f"{path} is in {file_kind} ({unit}) and the section in {section_kind} ({section_unit}); export the picks "
            f"in {section_kind}, or open a section in {file_kind}"
        )
    return family[unit] / family[section_unit]


def without_single_points(path: Path, lines: tuple[PickLine, ...]) -> tuple[PickLine, ...]:
    """Leave out lines of a single point, which exports contain beside faults, and warn about them."""
    single = [line.name for line in lines if len(line.points) < 2]
    if single:
        names = ", ".join(repr(name) for name in dict.fromkeys(single))
        points = f"{len(single)} single point{'s' if len(single) > 1 else ''}"
        message = f"{path}: left out {points} that cannot form a line, of {shortened(names)}"
        warnings.warn(message, stacklevel=4)  # points to the call of read_picks
    return tuple(line for line in lines if len(line.points) > 1)


def parse_number(path: Path, location: str, column: str, text: str) -> float:
    """Read a number; DataError if it is not finite or too large to compute with."""
    value = _float(text)
    if not abs(value) <= LARGEST_NUMBER:  # not >: NaN must be refused too
        raise DataError(
            f"{path}: {location}: {column} must be a number within ±{LARGEST_NUMBER:g}, but is {text[:60]!r}; correct "
            "or delete that row"
        )
    return value


def parse_depth(path: Path, location: str, text: str) -> float:
    """Read a depth or time; NaN where another program marks it as undefined."""
    undefined = text == "-" or abs(_float(text)) >= UNDEFINED
    return nan if undefined else parse_number(path, location, "Z", text)


def _float(text: str) -> float:
    try:
        return float(text)
    except ValueError:
        return nan
