"""Lines in the CPS-3 format, as Petrel and others export them."""

from collections.abc import Iterator
from pathlib import Path

import numpy as np

from seiswidgets.errors import DataError
from seiswidgets.io.picks.lines import FileLines, parse_depth, parse_number
from seiswidgets.io.picks.map_points import ExportOptions, MapPoint, data_rows, fault_lines, horizon_lines

HEADER = ("FF", "FS")  # FFASCI, FFATTR, ...: how the file was written; nothing about positions


def read_horizons(path: Path, text: str, options: ExportOptions) -> FileLines:
    """Read a horizon from "CPS-3 lines": a row ``->`` before each piece, then one row X Y Z per point.

    Rows that begin with FF or FS are headers. The horizon takes the file's name; text after the arrow is ignored.
    """
    return FileLines(horizon_lines(path, _map_points(path, text), options))


def read_faults(path: Path, text: str, options: ExportOptions) -> FileLines:
    """Read faults from "CPS-3 lines": each piece is a fault with the file's name, numbered if there are several."""
    return FileLines(fault_lines(path, _map_points(path, text), options))


def _map_points(path: Path, text: str) -> Iterator[MapPoint]:
    piece = 0
    for location, row in data_rows(text):
        if row.lstrip().startswith("->"):
            piece += 1
        elif not row.lstrip().startswith(HEADER):
            yield _map_point(path, location, row, piece)


def _map_point(path: Path, location: str, row: str, piece: int) -> MapPoint:
    values = row.split()
    if len(values) != 3:
        raise DataError(f"{path}: {location} must be X, Y and Z, but has {len(values)} values; export it again with Z")
    x, y = (parse_number(path, location, column, text) for column, text in zip("XY", values, strict=False))
    return MapPoint({"": np.nan}, path.stem, str(piece), x, y, parse_depth(path, location, values[2]), location)
