"""Text exports of OpendTect: 2-D horizons, faults and fault stick sets."""

import re
from pathlib import Path

import numpy as np

from seiswidgets.errors import DataError
from seiswidgets.io.document import read_text
from seiswidgets.io.picks.lines import FileLines, parse_depth, parse_number
from seiswidgets.io.picks.map_points import ExportOptions, MapPoint, data_rows, fault_lines, horizon_lines

HEADER_CHARACTERS = 4000  # searched for a header
QUOTED = re.compile(r'\s*"([^"]*)"')


def read_horizons(path: Path, options: ExportOptions) -> FileLines:
    """Read 2-D horizons (Export > Horizons > ASCII 2D): ["horizon"] ["line"] X Y trace shot-point Z, between spaces.

    Names are in double quotes. Two names are horizon and line; a single one is the line, unless the header has a column
    for the horizon only. A horizon without a name takes the file's name. Z is undefined from 9,999,900 on, or if it is
    "-". Pieces end there, and where trace numbers jump. The header, if there is one, states the unit of z.
    """
    text = read_text(path)
    header = " ".join(row for row in text[:HEADER_CHARACTERS].splitlines() if row.lstrip().startswith("#"))
    horizon_only = "Horizon Name" in header and not re.search("Line name", header, re.IGNORECASE)
    points = (_horizon_point(path, location, row, horizon_only) for location, row in data_rows(text))
    unit = re.search(r"\bZ \((\w+)\)", header)
    return FileLines(horizon_lines(path, points, options), z_unit=unit and unit[1])


def _horizon_point(path: Path, location: str, row: str, horizon_only: bool) -> MapPoint:
    names, rest = _split_names(row)
    if len(names) == 1:
        names = [*names, ""] if horizon_only else [path.stem, *names]
    values = rest.split()
    if len(values) != 5 or len(names) > 2:
        raise DataError(
            f"{path}: {location} must be names in quotes (horizon, line), then X, Y, trace, shot point and Z, but has "
            f"{len(names)} names and {len(values)} values; export it again, with Z"
        )
    horizon, line = names or (path.stem, "")
    columns = zip(("X", "Y", "trace"), values, strict=False)
    x, y, trace = (parse_number(path, location, column, text) for column, text in columns)
    return MapPoint({line: trace}, horizon, "", x, y, parse_depth(path, location, values[4]), location)


def _split_names(row: str) -> tuple[list[str], str]:
    """The quoted names at the beginning of a row, and the rest of it."""
    names, end = [], 0
    while match := QUOTED.match(row, end):
        names.append(match[1])
        end = match.end()
    return names, row[end:]


def read_faults(path: Path, options: ExportOptions) -> FileLines:
    """Read faults and fault stick sets (Export > Faults): ["fault"] X Y Z stick node [line], separated by tabs.

    The export must contain stick and node index, and X/Y rather than inline and crossline, unless ``along`` is "x" or
    "y" to take one of these. A fault without a name takes the file's name.
    """
    points = (_fault_point(path, location, row) for location, row in data_rows(read_text(path)))
    return FileLines(fault_lines(path, points, options))


def _fault_point(path: Path, location: str, row: str) -> MapPoint:
    names, rest = _split_names(row)
    values = rest.strip().split("\t") if "\t" in rest.strip() else rest.split(maxsplit=5)
    if len(values) not in (5, 6) or len(names) > 1 or not all(value.strip().isdecimal() for value in values[3:5]):
        raise DataError(
            f"{path}: {location} must be an optional fault name in quotes, then X, Y, Z, stick index, node index and "
            "an optional line name; export it again, with both indices"
        )
    x, y = (parse_number(path, location, column, text) for column, text in zip("XY", values, strict=False))
    line = values[5].strip() if len(values) == 6 else ""
    z = parse_depth(path, location, values[2].strip())
    return MapPoint({line: np.nan}, (names or [path.stem])[0], values[3].strip(), x, y, z, location)
