"""Text exports of Charisma (offered by Petrel too): 3-D interpretation lines and fault sticks."""

import re
from pathlib import Path

from seiswidgets.errors import DataError
from seiswidgets.io.document import read_text
from seiswidgets.io.picks.lines import FileLines, parse_depth, parse_number
from seiswidgets.io.picks.map_points import ExportOptions, MapPoint, data_rows, fault_lines, horizon_lines

MARK = re.compile(r"\b(?:INLINE|XLINE)\s*[:-]?")  # before a line's number, with or without spaces around it
COLUMNS = ("inline", "crossline", "X", "Y")


def read_horizons(path: Path, options: ExportOptions) -> FileLines:
    """Read "Charisma 3D interpretation lines": INLINE : n XLINE : n X Y Z [name], separated by spaces.

    A horizon without a name takes the file's name. Picks are taken along one inline or crossline, ``line="inline 362"``
    or ``line="xline 800"``, which may be left out if the file holds only one. Z is undefined from 9,999,900 on. Pieces
    end there, and where trace numbers jump.
    """
    points = (_horizon_point(path, location, row) for location, row in data_rows(read_text(path)))
    return FileLines(horizon_lines(path, points, options))


def _horizon_point(path: Path, location: str, row: str) -> MapPoint:
    values = MARK.sub(" ", row).split()
    name = values[5:]
    if len(MARK.findall(row)) != 2 or len(values) < 5 or (name and name[0][0] in "+-.0123456789"):
        raise DataError(
            f"{path}: {location} must be INLINE : number XLINE : number X Y Z and an optional name; export it again "
            "in this format"
        )
    return _map_point(path, location, values, " ".join(name), "")


def read_faults(path: Path, options: ExportOptions) -> FileLines:
    """Read "Charisma fault sticks": INLINE- inline crossline X Y Z [fault] stick, separated by spaces.

    The fault's name may contain spaces; a fault without a name takes the file's name. Sticks are taken from one inline
    or crossline, as for horizons.
    """
    points = (_fault_point(path, location, row) for location, row in data_rows(read_text(path)))
    return FileLines(fault_lines(path, points, options))


def _fault_point(path: Path, location: str, row: str) -> MapPoint:
    values = MARK.sub(" ", row).split()
    if len(values) < 6 or not row.lstrip().startswith("INLINE") or not values[-1].isdecimal():
        raise DataError(
            f"{path}: {location} must be INLINE- inline crossline X Y Z, an optional fault name, and the number of "
            "the stick; export it again in this format"
        )
    return _map_point(path, location, values, " ".join(values[5:-1]), values[-1])


def _map_point(path: Path, location: str, values: list[str], name: str, part: str) -> MapPoint:
    inline, crossline, x, y = (parse_number(path, location, *pair) for pair in zip(COLUMNS, values, strict=False))
    traces = {f"inline {inline:.12g}": crossline, f"xline {crossline:.12g}": inline}
    return MapPoint(traces, name or path.stem, part, x, y, parse_depth(path, location, values[4]), location)
