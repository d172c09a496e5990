"""Horizons and fault sticks in the IESX format of GeoFrame, as Petrel, OpendTect and others export them."""

import re
from collections.abc import Iterator
from pathlib import Path

from seiswidgets.errors import DataError
from seiswidgets.io.document import text_lines
from seiswidgets.io.picks.columns import map_point
from seiswidgets.io.picks.lines import FileLines
from seiswidgets.io.picks.map_points import LONGEST_ROW, ExportOptions, MapPoint, fault_lines, horizon_lines

SKIPPED = ("SNAPPING PARAMETERS", "EOD")
PROFILE = re.compile(r"PROFILE\s+(.*?)\s*TYPE\s.*?(?:\.ifdf\s+(m|ft)?\s*(ms|s|m|ft)?.*)?")
FIELDS = {"x": slice(0, 16), "y": slice(16, 32), "stick": slice(32, 35), "z": slice(38, 47)}
CROSSLINE, INLINE = slice(67, 72), re.compile(r"\sI\s*(-?\d+)(?:\s|$)")
WIDTH = 47  # characters of a row at least


def read_horizons(path: Path, text: str, options: ExportOptions) -> FileLines:
    """Read horizons: a row PROFILE with the name and the units, then rows with numbers in fixed columns.

    X is in columns 1 to 16, Y in 17 to 32, Z in 39 to 47, the crossline in 68 to 72, and the inline after the mark I.
    """
    return _with_units(text, horizon_lines(path, _points(path, text, needs_lines=True), options))


def read_faults(path: Path, text: str, options: ExportOptions) -> FileLines:
    """Read fault sticks: as for horizons, with the number of the stick in columns 33 to 35."""
    return _with_units(text, fault_lines(path, _points(path, text, needs_lines=False), options))


def _with_units(text: str, lines: tuple) -> FileLines:
    rows = (row[:LONGEST_ROW].strip() for row in text_lines(text))
    stated = [match for row in rows if (match := PROFILE.fullmatch(row))]
    return FileLines(lines, stated[0][2], stated[0][3]) if stated else FileLines(lines)


def _points(path: Path, text: str, needs_lines: bool) -> Iterator[MapPoint]:
    name = path.stem
    for count, full_row in enumerate(text_lines(text), 1):
        row = full_row[:LONGEST_ROW].rstrip().removeprefix("EOD")
        if match := PROFILE.fullmatch(row.strip()):
            name = match[1] or path.stem
        elif row.strip() and not row.strip().startswith(SKIPPED) and not _is_undefined(row):
            yield _point(path, f"row {count}", row, name, needs_lines)


def _is_undefined(row: str) -> bool:
    """Check for a Z that is wider than its column, as some programs write where there is none."""
    return row[FIELDS["z"].stop : FIELDS["z"].stop + 1].isdigit()


def _point(path: Path, location: str, row: str, name: str, needs_lines: bool) -> MapPoint:
    inline, crossline = INLINE.search(row), row[CROSSLINE].strip()
    if len(row) < WIDTH or (needs_lines and not (inline and crossline)):
        raise DataError(
            f"{path}: {location} must have X, Y and Z in columns 1 to 47{', and an inline' if needs_lines else ''}; "
            "export it again as IESX"
        )
    values = {role: row[part].strip() for role, part in FIELDS.items()} | {"horizon": name}
    if inline and crossline:
        values |= {"inline": inline[1], "crossline": crossline}
    return map_point(path, location, values)
