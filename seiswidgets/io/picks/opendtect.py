"""Text exports of OpendTect: 2-D and 3-D horizons, faults and fault stick sets."""

import re
from collections.abc import Iterable, Iterator
from pathlib import Path

import numpy as np

from seiswidgets.errors import DataError, Keyword
from seiswidgets.io.picks.columns import Columns, header_columns, map_point, refuse_areas
from seiswidgets.io.picks.lines import FileLines, parse_depth, parse_number
from seiswidgets.io.picks.map_points import ExportOptions, MapPoint, data_rows, fault_lines, horizon_lines

QUOTED = re.compile(r'\s*"([^"]*)"')
LINE, GRID = ("x", "y", "trace", "shot", "z"), ("x", "y", "inline", "crossline", "z")  # columns without a header
OLD_LINE = ("x", "y", "trace", "z")
ROWS_SEEN = 2000  # of a file without a header, to tell lines from grids


def read_horizons(path: Path, text: str, options: ExportOptions) -> FileLines:
    """Read 2-D horizons (Export > Horizons > ASCII 2D) or 3-D horizons, with or without a header.

    2-D: ["horizon"] ["line"] X Y trace [shot point] Z. Names may be in double quotes; two names are horizon and line,
    a single one is the line, unless the header has a column for the horizon only. 3-D: ["horizon"] [X Y] [inline
    crossline] Z. A horizon without a name takes the file's name. Z is undefined from 9,999,900 on, or if it is "-".
    Pieces end there, and where trace numbers jump. The header states the unit of z.
    """
    columns = header_columns(text)
    if columns is None:
        points, z_unit = _points_without_header(path, text), None
    else:
        _refuse_faults(path, columns)
        points, z_unit = _points(path, text, columns), columns.z_unit
    return FileLines(horizon_lines(path, refuse_areas(path, points), options), z_unit=z_unit)


def _points(path: Path, text: str, columns: Columns) -> Iterator[MapPoint]:
    for location, row in data_rows(text):
        if not row.startswith("#"):
            yield map_point(path, location, columns.values(path, location, row))


def _refuse_faults(path: Path, columns: Columns) -> None:
    if "stick" in columns.roles:
        raise DataError(f"{path} holds sticks of faults, not horizons; give ", Keyword("format", "opendtect-faults"))


def _points_without_header(path: Path, text: str) -> Iterator[MapPoint]:
    is_grid, could_be_faults = _kind_of_rows(text)
    if could_be_faults:
        raise DataError(
            f"{path} holds X, Y, Z, stick and node index of faults, not horizons; give ",
            Keyword("format", "opendtect-faults"),
        )
    for location, row in data_rows(text):
        names, values = _split(row)
        by_length = {5: GRID if is_grid else LINE, 4: OLD_LINE if names else None}
        roles = by_length.get(len(values))
        if roles is None or len(names) > 2:
            raise DataError(
                f"{path}: {location} must be names in quotes (horizon, line), then X, Y, trace, shot point and Z, but "
                f"has {len(names)} names and {len(values)} values; export it again, with Z and a header"
            )
        named = dict(zip(("horizon", "line") if is_grid or len(names) == 2 else ("line",), names, strict=False))
        yield map_point(path, location, named | dict(zip(roles, values, strict=True)))


def _kind_of_rows(text: str) -> tuple[bool, bool]:
    """Check whether rows of five values without a header are of a 3-D horizon, and whether they are of faults.

    The trace number of a 2-D horizon changes from row to row, an inline or crossline does not; the last column of
    faults counts the nodes of a stick from 0.
    """
    rows = [_split(row) for (_, row), _ in zip(data_rows(text), range(ROWS_SEEN), strict=False)]
    if len(rows) < 2 or any(len(values) != 5 for _, values in rows):
        return False, False
    columns = list(zip(*(values for _, values in rows), strict=True))
    counts = [value.strip() for value in columns[4]]
    if all(value.isdecimal() for value in (*counts, *columns[3])) and counts[0] == "0" and "1" in counts[:2]:
        return False, True
    is_named = any(len(names) == 2 for names, _ in rows)
    whole = all(re.fullmatch(r"-?\d+", value) for value in (*columns[2], *columns[3]))
    return whole and not is_named and any(len(set(column)) < len(rows) for column in columns[2:4]), False


def _split(row: str) -> tuple[list[str], list[str]]:
    """Names at the beginning of a row, quoted or a single one without quotes, and the values after them."""
    names, end = [], 0
    while match := QUOTED.match(row, end):
        names.append(match[1])
        end = match.end()
    values = row[end:].split()
    if not names and len(values) in (5, 6) and not _is_number(values[0]):
        return values[:1], values[1:]
    return names, values


def _is_number(text: str) -> bool:
    try:
        float(text)
    except ValueError:
        return False
    return True


def read_faults(path: Path, text: str, options: ExportOptions) -> FileLines:
    """Read faults and fault stick sets (Export > Faults): ["fault"] X Y Z stick node [line], separated by tabs.

    The export must contain stick and node index, and X/Y rather than inline and crossline, unless ``along`` is "x" or
    "y" to take one of these. A fault without a name takes the file's name.
    """
    points = (_fault_point(path, location, row) for location, row in data_rows(text))
    return FileLines(fault_lines(path, _counted(path, points), options))


def _fault_point(path: Path, location: str, row: str) -> tuple[int, MapPoint]:
    match = QUOTED.match(row)
    rest = row[match.end() :] if match else row
    values = rest.strip().split("\t") if "\t" in rest.strip() else rest.split(maxsplit=5)
    if len(values) not in (5, 6) or not all(value.strip().isdecimal() for value in values[3:5]):
        raise DataError(
            f"{path}: {location} must be an optional fault name in quotes, then X, Y, Z, stick index, node index and "
            "an optional line name; export it again, with both indices"
        )
    x, y = (parse_number(path, location, column, text) for column, text in zip("XY", values, strict=False))
    line = values[5].strip().strip('"') if len(values) == 6 else ""
    z = parse_depth(path, location, values[2].strip())
    point = MapPoint({line: np.nan}, match[1] if match else path.stem, values[3].strip(), x, y, z, location)
    return int(values[4]), point


def _counted(path: Path, points: Iterable[tuple[int, MapPoint]]) -> Iterator[MapPoint]:
    """Points whose node index counts up along each stick; a column that does not count has another meaning."""
    stick, last = None, -1
    for node, point in points:
        same = stick == (point.name, point.part, *point.traces)
        if node != (last + 1 if same else 0) and not (same and node > last):
            raise DataError(
                f"{path}: {point.location}: the node index must count up from 0 along a stick, but is {node}; is it a "
                "horizon? Give ",
                Keyword("format", "opendtect-horizons"),
            )
        stick, last = (point.name, point.part, *point.traces), node
        yield point
