"""Lines as a file of picks has them, and the interpretation that they make."""

import warnings
from dataclasses import dataclass
from math import nan
from pathlib import Path

from seiswidgets.errors import DataError, PickError
from seiswidgets.geology.picks import FAULT, HORIZON, Fault, Horizon, Interpretation
from seiswidgets.geology.section import METRES, SECONDS, Section
from seiswidgets.io.document import LARGEST_NUMBER, shortened

Points = tuple[tuple[float, float], ...]
UNDEFINED = 9_999_900  # and more: other programs write 9999900, 9999999 or 1e30 where there is no pick


@dataclass(frozen=True)
class PickLine:
    """A fault, or a piece of a horizon, as points (x, z); and where in the file it is."""

    kind: str
    name: str
    points: Points
    place: str


@dataclass(frozen=True)
class FileLines:
    """The lines of a file, and their units where it states them."""

    lines: tuple[PickLine, ...]
    x_unit: str | None = None
    z_unit: str | None = None


def interpretation(path: Path, lines: tuple[PickLine, ...]) -> Interpretation:
    """The picks that lines make: one of each name, horizons with all of their pieces.

    Raises
    ------
    DataError
        If a line cannot be a pick; it names the file, the place and the pick.
    """
    named: dict[tuple[str, str], list[PickLine]] = {}
    for line in lines:
        named.setdefault((line.kind, line.name), []).append(line)
    made = {FAULT: [], HORIZON: []}
    for (kind, name), pieces in named.items():
        made[kind].append(_pick(path, kind, name, pieces))
    return Interpretation(tuple(made[FAULT]), tuple(made[HORIZON]))


def _pick(path, kind, name, pieces):
    if kind == FAULT and len(pieces) > 1:
        raise DataError(
            f"{path}: {pieces[1].place} is a second line of fault {shortened(repr(name))}, after {pieces[0].place}; a "
            "fault is one line, so give each a name of its own"
        )
    points = [piece.points for piece in pieces]
    try:
        return Fault(points[0], name) if kind == FAULT else Horizon(*points, name=name)
    except PickError as error:
        raise DataError(f"{path}: {pieces[0].place}: {shortened(str(error))}") from error


def in_section_units(path: Path, found: FileLines, section: Section) -> tuple[PickLine, ...]:
    """The lines in the units of a section; untouched where these are the file's own."""
    scale = tuple(
        _factor(path, axis, getattr(found, axis), getattr(section, axis), section) for axis in ("x_unit", "z_unit")
    )
    return found.lines if scale == (1, 1) else tuple(_scaled(line, scale) for line in found.lines)


def _scaled(line, scale):
    return PickLine(line.kind, line.name, tuple((x * scale[0], z * scale[1]) for x, z in line.points), line.place)


def _factor(path, axis, unit, wanted, section):
    """How many of the section's units one of the file's is."""
    known = METRES if axis == "x_unit" else METRES | SECONDS
    if unit is None:
        raise DataError(f"{path} does not say its {axis}; give {axis}=, one of {', '.join(known)}")
    if unit not in tuple(known):
        raise DataError(f"{path}: {axis} must be one of {', '.join(known)}, but is {shortened(repr(unit))}")
    if unit == wanted:
        return 1
    family = METRES if unit in METRES else SECONDS
    if wanted not in family:
        kinds = ("depth", "two-way time") if family is METRES else ("two-way time", "depth")
        raise DataError(
            f"{path} is in {kinds[0]} ({unit}) and the section in {kinds[1]} ({wanted}); export the picks in "
            f"{kinds[1]}, or open a section in {kinds[0]}"
        )
    return family[unit] / family[wanted]


def without_single_points(path: Path, lines: tuple[PickLine, ...]) -> tuple[PickLine, ...]:
    """The lines of two points or more; a warning tells of the others, which exports have beside faults."""
    alone = [line.name for line in lines if len(line.points) < 2]
    if alone:
        names = ", ".join(repr(name) for name in dict.fromkeys(alone))
        message = f"{path}: left out {len(alone)} points that stand alone and make no line, of {shortened(names)}"
        warnings.warn(message, stacklevel=3)  # where read_picks was called
    return tuple(line for line in lines if len(line.points) > 1)


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
