"""Picks as CSV: a row a point."""

import csv
import io
import re
from pathlib import Path

from seiswidgets.errors import DataError
from seiswidgets.geology.picks import Interpretation
from seiswidgets.io.document import LARGEST_OURS, lines, read_text
from seiswidgets.io.picks.lines import FAULT, HORIZON, FileLines, PickLine, number

COLUMNS = ("kind", "name", "piece", "x", "z")


def read(path: Path) -> FileLines:
    """Lines of a CSV file whose first row names at least the columns kind, name, piece, x and z, in any order.

    The units stand behind x and z, as in ``x (m)``. Rows of the same kind, name and piece make a line, in their order.
    """
    rows = _rows(path)
    place, header = next(rows, (None, None))
    if header is None:
        raise DataError(f"{path} is empty; its first row must name the columns {', '.join(COLUMNS)}")
    columns, units = _columns(path, header)
    drawn: dict[tuple[str, str, str], tuple[str, list]] = {}
    for place, row in rows:
        if len(row) != len(header):
            raise DataError(
                f"{path}: {place} must have {len(header)} values as the first, but has {len(row)}; correct or delete "
                "that row"
            )
        kind, name, piece = (row[columns[column]] for column in COLUMNS[:3])
        if kind not in (FAULT, HORIZON):
            raise DataError(f"{path}: {place}: kind must be 'fault' or 'horizon', but is {kind[:60]!r}")
        point = tuple(number(path, place, column, row[columns[column]]) for column in ("x", "z"))
        drawn.setdefault((kind, name, piece), (place, []))[1].append(point)
    found = tuple(PickLine(kind, name, tuple(points), place) for (kind, name, _), (place, points) in drawn.items())
    return FileLines(found, units["x"], units["z"])


def _rows(path):
    reader = csv.reader(lines(read_text(path, LARGEST_OURS)), strict=True)
    try:
        for row in reader:
            if row:
                yield f"row {reader.line_num}", row
    except csv.Error as error:
        raise DataError(f"{path}: row {reader.line_num} is not CSV: {error}; save it again as CSV (UTF-8)") from None


def _columns(path, header):
    """Where the columns are, and the units of x and z."""
    named = [re.fullmatch(r"(\w+) ?(?:\((\w+)\))?", title.strip()) for title in header]
    titles = [match[1].lower() if match else "" for match in named]
    places = {title: place for place, title in enumerate(titles)}
    lacking = [column for column in COLUMNS if titles.count(column) != 1]
    if lacking:
        raise DataError(
            f"{path}: row 1 must name the columns {', '.join(COLUMNS)}, each once and separated by commas; missing or "
            f"doubled: {', '.join(lacking)}"
        )
    return places, {axis: named[places[axis]][2] for axis in ("x", "z")}


def text(interpretation: Interpretation, x_unit: str, z_unit: str) -> str:
    """The table for an interpretation; every number comes back as it was."""
    table = io.StringIO(newline="")
    writer = csv.writer(table)
    writer.writerow([*COLUMNS[:3], f"x ({x_unit})", f"z ({z_unit})"])
    for fault in interpretation.faults:
        writer.writerows([FAULT, fault.name, 1, x, z] for x, z in fault.points.tolist())
    for horizon in interpretation.horizons:
        for count, piece in enumerate(horizon.pieces, 1):
            writer.writerows([HORIZON, horizon.name, count, x, z] for x, z in piece.tolist())
    return table.getvalue()
