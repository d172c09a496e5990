"""Exports as tables: columns recognised by the names in their header, and points made from their rows."""

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise
from math import hypot, nan
from pathlib import Path

from seiswidgets.errors import DataError
from seiswidgets.io.document import text_lines
from seiswidgets.io.picks.lines import parse_depth, parse_number
from seiswidgets.io.picks.map_points import LONGEST_ROW, MapPoint

HEADER_ROWS = 60  # searched for names of columns
TOKEN = re.compile(r'"([^"]*)"|([^\s,;]+)')
NUMBERED = re.compile(r"#\s*(?:Field:\s*)?\d+\s*:?\s+(.+)")  # of OpendTect and EarthVision: a row for each column
UNIT = re.compile(r"(.*?)\s*(?:\((\w+)\)|\[(\w+)\]|\s(ms|s|m|ft|meters|metres|feet))?")
UNITS = {"msec": "ms", "milliseconds": "ms", "sec": "s", "seconds": "s", "meters": "m", "metres": "m", "feet": "ft"}
ROLES = {  # names of columns, in lower case, without blanks and punctuation
    "horizon": ("horizon", "horizonname", "surface", "surfacename", "event"),
    "fault": ("fault", "faultname"),
    "line": ("line", "linename", "seismicline", "linenumber"),
    "inline": ("inline", "inlinenumber", "iline", "inl", "il"),
    "crossline": ("crossline", "crosslinenumber", "xline", "crl", "xl"),
    "column": ("column", "col"),
    "row": ("row",),
    "trace": ("trace", "tracenr", "tracenumber", "trcnr", "cdp", "cmp"),
    "shot": ("shotpoint", "shotpointnr", "shotpointnumber", "shot", "sp"),
    "x": ("x", "xcoord", "xcoordinate", "mapx", "utmx", "easting"),
    "y": ("y", "ycoord", "ycoordinate", "mapy", "utmy", "northing"),
    "z": ("z", "zvalue", "time", "twt", "depth", "tvd", "tvdss"),
    "stick": ("stick", "stickindex", "sticknumber", "segment", "segmentid"),
    "node": ("node", "nodeindex"),
}
ROLE_OF = {name: role for role, names in ROLES.items() for name in names}
GRIDS = (("inline", "xline"), ("inline", "crossline"), ("column", "row"))
AREAL = 3  # diagonals: length of a course from point to point that crosses an area to and fro
NUMBERS_NEEDED = "export it with inline and crossline numbers"


@dataclass(frozen=True)
class Columns:
    """Meaning of the columns of an export.

    Attributes
    ----------
    roles : tuple of str
        A key of ``ROLES`` for each column, or "" if it has no meaning here.
    z_unit : str or None
    """

    roles: tuple[str, ...]
    z_unit: str | None = None

    @property
    def is_grid(self) -> bool:
        """True for a 3-D horizon: its points have two line numbers."""
        return {"inline", "crossline"} <= set(self.roles) or {"column", "row"} <= set(self.roles)

    def values(self, path: Path, location: str, row: str) -> dict[str, str]:
        """Values of a row by role; a quoted name may precede the columns of the header."""
        tokens = split_row(row)
        roles = self.roles
        if len(tokens) == len(roles) + 1 and row.lstrip().startswith('"'):
            roles = ("horizon" if "horizon" not in roles else "fault", *roles)
        if len(tokens) != len(roles):
            raise DataError(
                f"{path}: {location} must have {len(roles)} values ({', '.join(role or '...' for role in roles)}), but "
                f"has {len(tokens)}; export it again"
            )
        return {role: token for role, token in zip(roles, tokens, strict=True) if role}


def split_row(row: str) -> list[str]:
    """Values of a row, which tabs, commas, semicolons or blanks separate; double quotes hold names together."""
    for mark in ("\t", ";", ","):
        if mark in row:
            values = [value.strip().strip('"') for value in row.strip().split(mark)]
            return [value for value in values if value or mark != "\t"]
    return [quoted or plain for quoted, plain in TOKEN.findall(row)]


def header_columns(text: str) -> Columns | None:
    """Columns named in a header, in one row or in a row for each; None if there is no header."""
    numbered: list[str] = []
    for count, row in enumerate(text_lines(text)):
        if count >= HEADER_ROWS:
            break
        row = row[:LONGEST_ROW]
        if match := NUMBERED.fullmatch(row.strip()):
            numbered.append(match[1])
            continue
        columns = _named(split_row(row.strip().lstrip("#!").strip()))
        if {"z"} < set(columns.roles) and len(set(columns.roles) - {""}) > 2:
            return columns
    columns = _named(numbered)
    return columns if "z" in columns.roles else None


def _named(names: Iterable[str]) -> Columns:
    """Roles of columns by their names, and the unit of z."""
    roles, z_unit = [], None
    for name in names:
        match = UNIT.fullmatch(name.strip().strip('"'))
        words = re.sub(r"[\W_]", "", match[1]).lower() if match else ""
        roles.append(ROLE_OF.get(words, ""))
        if match and roles[-1] == "z":
            unit = match[2] or match[3] or match[4]
            z_unit = UNITS.get(unit.lower(), unit.lower()) if unit else None
    return Columns(tuple(roles), z_unit)


def map_point(path: Path, location: str, values: Mapping[str, str]) -> MapPoint:
    """Make a point from the values of a row, by role; without X and Y they are NaN."""
    x, y = (parse_number(path, location, role, values[role]) if role in values else nan for role in ("x", "y"))
    name = values.get("horizon") or values.get("fault") or path.stem
    z = parse_depth(path, location, values["z"])
    return MapPoint(_traces(path, location, values), name, values.get("stick", ""), x, y, z, location)


def _traces(path: Path, location: str, values: Mapping[str, str]) -> dict[str, float]:
    """Trace numbers by seismic line: two lines for a point of a grid, one line for others."""
    line, trace = values.get("line", ""), values.get("trace") or values.get("shot")
    if line and trace and _is_number(line) and "inline" not in values:  # a grid's inline and crossline
        values = {"inline": line, "crossline": trace}
    for one, other in (("inline", "crossline"), ("column", "row")):
        if one in values and other in values:
            a, b = (parse_number(path, location, role, values[role]) for role in (one, other))
            name = "xline" if other == "crossline" else other
            return {f"{one} {a:.12g}": b, f"{name} {b:.12g}": a}
    return {line: nan if trace is None else parse_number(path, location, "trace", trace)}


def _is_number(text: str) -> bool:
    return re.fullmatch(r"[-+]?\d+(\.0*)?", text) is not None


def refuse_areas(path: Path, points: Iterable[MapPoint]) -> Iterator[MapPoint]:
    """Iterate over points; DataError at the end if they cover an area and have no line numbers to choose a line by."""
    kept: list[tuple[float, float]] = []
    for point in points:
        if point.traces.keys() == {""} and point.x == point.x:
            kept.append((point.x, point.y))
        yield point
    if _crosses_an_area(kept):
        raise DataError(
            f"{path} holds a 3-D horizon without line numbers, of which no line can be taken; {NUMBERS_NEEDED}"
        )


def _crosses_an_area(points: Sequence[tuple[float, float]]) -> bool:
    if len(points) < 9:
        return False
    x, y = zip(*points, strict=True)
    course = sum(hypot(b[0] - a[0], b[1] - a[1]) for a, b in pairwise(points))
    return course > AREAL * hypot(max(x) - min(x), max(y) - min(y))
