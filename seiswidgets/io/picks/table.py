"""Picks as CSV: one row per point."""

import csv
import io
import re
from collections.abc import Iterator
from pathlib import Path

from seiswidgets.errors import DataError
from seiswidgets.geology.bodies import BODY, Body
from seiswidgets.geology.picks import AUTO, CONSTRAIN, FAULT, HORIZON, Fault, Horizon, Interpretation
from seiswidgets.io.document import MOST_JSON_BYTES, Point, read_text, text_lines
from seiswidgets.io.picks.lines import FileLines, PickLine, choices_of, parse_number

COLUMNS = ("kind", "name", "piece", "x", "z")
KINDS = {Fault: FAULT, Horizon: HORIZON, Body: BODY}
CHOICES = {"use": CONSTRAIN, "ends": AUTO}  # columns that may be left out, with the usual values
FORMULA = re.compile(r"'*[=+\-@\t\r\n＝＋－＠]")  # a spreadsheet would compute a name that begins like this


def read(path: Path) -> FileLines:
    """Read a CSV file whose first row names at least the columns kind, name, piece, x and z, in any order.

    The units follow x and z, as in ``x (m)``. Rows with the same kind, name and piece make a line, in their order. An
    apostrophe before a name that a spreadsheet would take for a formula is left out.
    """
    rows = _numbered_rows(path)
    _, header = next(rows, ("", []))
    if not header:
        raise DataError(f"{path} is empty; its first row must name the columns {', '.join(COLUMNS)}")
    columns, x_unit, z_unit = _columns_and_units(path, header)
    drawn: dict[tuple[str, str, str], tuple[str, list[Point], str, str]] = {}
    for location, row in rows:
        if len(row) != len(header):
            raise DataError(
                f"{path}: {location} must have {len(header)} values like the first row, but has {len(row)}; correct or "
                "delete that row"
            )
        kind, name, piece = (row[columns[column]] for column in COLUMNS[:3])
        if kind not in (FAULT, HORIZON, BODY):
            raise DataError(f"{path}: {location}: kind must be 'fault', 'horizon' or 'body', but is {kind[:60]!r}")
        x, z = (parse_number(path, location, column, row[columns[column]]) for column in ("x", "z"))
        name = name[1:] if name[:1] == "'" and FORMULA.match(name) else name
        choices = {title: row[columns[title]] for title in CHOICES if title in columns and row[columns[title]]}
        use, ends = (CHOICES | choices).values()
        drawn.setdefault((kind, name, piece), (location, [], use, ends))[1].append((x, z))
    lines = (
        PickLine(kind, name, tuple(points), start, use, ends)
        for (kind, name, _), (start, points, use, ends) in drawn.items()
    )
    return FileLines(tuple(lines), x_unit, z_unit)


def _numbered_rows(path: Path) -> Iterator[tuple[str, list[str]]]:
    """Location and values of each row that is not blank."""
    reader = csv.reader(text_lines(read_text(path, MOST_JSON_BYTES)), strict=True)
    try:
        for row in reader:
            if row:
                yield f"row {reader.line_num}", row
    except csv.Error as error:
        raise DataError(f"{path}: row {reader.line_num} is not CSV: {error}; save it again as CSV (UTF-8)") from None


def _columns_and_units(path: Path, header: list[str]) -> tuple[dict[str, int], str | None, str | None]:
    """Index of each column, and the units of x and z."""
    matches = [re.fullmatch(r"(\w+) ?(?:\((\w+)\))?", title.strip()) for title in header]
    titles = [match[1].lower() if match else "" for match in matches]
    wrong = [column for column in COLUMNS if titles.count(column) != 1]
    if wrong:
        raise DataError(
            f"{path}: row 1 must name the columns {', '.join(COLUMNS)}, each once and separated by commas; missing or "
            f"repeated: {', '.join(wrong)}"
        )
    units = {title: match[2] for title, match in zip(titles, matches, strict=True) if match}
    return {title: index for index, title in enumerate(titles)}, units["x"], units["z"]


def as_text(interpretation: Interpretation, x_unit: str, z_unit: str) -> str:
    """The CSV table of an interpretation, with exact numbers."""
    table = io.StringIO(newline="")
    writer = csv.writer(table)
    picks: list[Fault | Horizon | Body] = [*interpretation.faults, *interpretation.horizons, *interpretation.bodies]
    usual = all(choices_of(pick) == tuple(CHOICES.values()) for pick in picks)
    writer.writerow([*COLUMNS[:3], f"x ({x_unit})", f"z ({z_unit})", *([] if usual else CHOICES)])
    for pick in picks:
        kind = KINDS[type(pick)]
        pieces = pick.pieces if isinstance(pick, Horizon) else (pick.points,)
        choices = () if usual else choices_of(pick)
        for count, piece in enumerate(pieces, 1):
            writer.writerows([kind, guarded(pick.name), count, x, z, *choices] for x, z in piece.tolist())
    return table.getvalue()


def guarded(name: str) -> str:
    """A name that no spreadsheet takes for a formula; `read` removes the apostrophe."""
    return f"'{name}" if FORMULA.match(name) else name
