"""Exports whose columns are named in a header: Kingdom, GeoGraphix, EarthVision, DUG Insight and others."""

import re
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

from seiswidgets.errors import DataError
from seiswidgets.io.document import text_lines
from seiswidgets.io.picks.columns import Columns, header_columns, map_point, refuse_areas, split_row
from seiswidgets.io.picks.lines import FileLines
from seiswidgets.io.picks.map_points import ExportOptions, MapPoint, data_rows, fault_lines, horizon_lines

DUG_COLUMNS = {".xyt": "x y z", ".xyz": "x y z", ".ilclt": "inline crossline z", ".ilclz": "inline crossline z"}
DUG_UNIT = re.compile(r"^# *vertical_unit=(\w+)", re.MULTILINE)
HEADER_NEEDED = (
    "its first row must name the columns, such as Horizon, Line, Trace, X, Y and Time (ms), or Fault, Stick, X, Y and "
    "Time; export it again with column names, or add such a row"
)


def read_horizons(path: Path, text: str, options: ExportOptions) -> FileLines:
    """Read horizons: X, Y and Z, a name, and the number of the line and trace, or of inline and crossline."""
    columns = _columns(path, text)
    points = refuse_areas(path, _points(path, text, columns))
    return FileLines(horizon_lines(path, points, options), z_unit=columns.z_unit)


def read_faults(path: Path, text: str, options: ExportOptions) -> FileLines:
    """Read faults: X, Y and Z, a name, and the number of the stick or segment."""
    columns = _columns(path, text)
    if "stick" not in columns.roles:
        raise DataError(f"{path} has no column for the number of the stick or segment; {HEADER_NEEDED}")
    return FileLines(fault_lines(path, _points(path, text, columns), options), z_unit=columns.z_unit)


def _columns(path: Path, text: str) -> Columns:
    columns = header_columns(text)
    if columns is None or not ({"x", "y"} <= set(columns.roles) or columns.is_grid):
        raise DataError(f"{path} does not say what its columns are: {HEADER_NEEDED}")
    return columns


def _points(path: Path, text: str, columns: Columns) -> Iterator[MapPoint]:
    for location, row in data_rows(text):
        if not _is_header(row):
            yield map_point(path, location, columns.values(path, location, row))


def _is_header(row: str) -> bool:
    return "z" in (header_columns(row) or Columns(())).roles


def read_dug_horizons(path: Path, text: str, options: ExportOptions) -> FileLines:
    """Read a horizon of DUG Insight: X, Y and Z (.xyt, .xyz), or inline, crossline and Z (.ilclt, .ilclz)."""
    roles = DUG_COLUMNS.get(path.suffix.lower(), "inline crossline z" if "subgrid=il" in text[:500] else "x y z")
    unit = DUG_UNIT.search(text)
    points = refuse_areas(path, _points(path, text, Columns(tuple(roles.split()))))
    lines = horizon_lines(path, points, options)
    return FileLines(lines, z_unit=unit and unit[1])


def read_dug_faults(path: Path, text: str, options: ExportOptions) -> FileLines:
    """Read a fault of DUG Insight (.dufault): X, Y and Z, with a blank row before each further stick."""
    return FileLines(fault_lines(path, _sticks(path, text), options))


def _sticks(path: Path, text: str) -> Iterator[MapPoint]:
    columns, stick = Columns(("x", "y", "z")), 1
    for count, row in enumerate(text_lines(text), 1):
        if not row.strip():
            stick += 1
        elif not row.lstrip().startswith("#"):
            location = f"row {count}"
            yield replace(map_point(path, location, columns.values(path, location, row)), part=str(stick))


def read_petrel_points(path: Path, text: str, options: ExportOptions) -> FileLines:
    """Read Petrel's points with attributes: a header that names the attributes, then X, Y, Z and the attributes.

    Attributes called kind, name and piece say to which line of which pick a point belongs; without them all points are
    one horizon with the file's name.
    """
    names, start = _attributes(path, text)
    roles = {"name": "horizon", "piece": "stick", "x": "x", "y": "y", "z": "z", "kind": "kind"}
    columns = Columns(tuple(roles.get(name.lower(), "") for name in names))
    faults: list[MapPoint] = []
    horizons: list[MapPoint] = []
    for count, row in enumerate(text_lines(text), 1):
        if count > start and split_row(row):
            values = columns.values(path, f"row {count}", row)
            kind = faults if values.get("kind", "").lower() == "fault" else horizons
            kind.append(map_point(path, f"row {count}", values))
    lines = (fault_lines(path, faults, options) if faults else ()) + (
        horizon_lines(path, refuse_areas(path, horizons), options) if horizons or not faults else ()
    )
    units = [re.search(rf"^# *Unit in {axis}: *(\w+)", text, re.MULTILINE) for axis in ("X and Y direction", "depth")]
    x_unit, z_unit = (unit and unit[1] for unit in units)
    return FileLines(lines, x_unit, z_unit)


def _attributes(path: Path, text: str) -> tuple[list[str], int]:
    """Names of the columns, and the number of the header's last row."""
    rows = [row.strip() for row in text_lines(text)]
    try:
        first, last = rows.index("BEGIN HEADER"), rows.index("END HEADER")
    except ValueError:
        raise DataError(f"{path} must have a header from BEGIN HEADER to END HEADER; export it again") from None
    names = [re.sub(r"^[A-Z]+[, ]\s*", "", row).strip('"') for row in rows[first + 1 : last]]
    return names, last + 1
