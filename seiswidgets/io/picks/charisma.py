"""Text exports of Charisma (offered by Petrel too): 3-D interpretation lines and fault sticks."""

import re
from pathlib import Path

from seiswidgets.errors import DataError
from seiswidgets.io.picks.columns import map_point
from seiswidgets.io.picks.lines import FileLines
from seiswidgets.io.picks.map_points import ExportOptions, MapPoint, data_rows, fault_lines, horizon_lines

ROW = re.compile(  # marks before the numbers of the lines may be joined to them, and have ":", "-" or neither
    r'\s*(?:"(?P<quoted>[^"]*)"|(?P<name>\S+))?\s*\bINLINE\s*[:-]?\s*(?P<inline>[-+]?\d\S*?)\s*'
    r"(?:(?P<mark>X(?:ROSS)?LINE)\s*[:-]?|\s)\s*(?P<crossline>[-+]?\d\S*)\s+(?P<rest>.*)",
    re.IGNORECASE,
)
HEADER = re.compile(r"\s*(INLINE|IL)\s+(XLINE|CROSSLINE|XL)\s+X\s+Y\s", re.IGNORECASE)


def read_horizons(path: Path, text: str, options: ExportOptions) -> FileLines:
    """Read "Charisma 3D interpretation lines": [name] INLINE : n XLINE : n X Y Z [name], separated by white space.

    A horizon without a name takes the file's name. Picks are taken along one inline or crossline, ``line="inline 362"``
    or ``line="xline 800"``, which may be left out if the file holds only one. Z is undefined from 9,999,900 on. Pieces
    end there, and where trace numbers jump.
    """
    points = (_horizon_point(path, location, row) for location, row in data_rows(text) if not HEADER.match(row))
    return FileLines(horizon_lines(path, points, options))


def _horizon_point(path: Path, location: str, row: str) -> MapPoint:
    match = ROW.fullmatch(row.strip())
    values = match["rest"].split() if match else []
    name = " ".join(values[3:]).strip('"')
    if match is None or len(values) < 3 or (name and name[0] in "+-.0123456789"):
        raise DataError(
            f"{path}: {location} must be INLINE : number XLINE : number X Y Z and an optional name; export it again "
            "in this format"
        )
    return _point(path, location, match, values, name, "")


def read_faults(path: Path, text: str, options: ExportOptions) -> FileLines:
    """Read "Charisma fault sticks": INLINE- inline crossline X Y Z [fault] stick, separated by white space.

    The fault's name may contain spaces; a fault without a name takes the file's name. Sticks are taken from one inline
    or crossline, as for horizons.
    """
    points = (_fault_point(path, location, row) for location, row in data_rows(text) if not HEADER.match(row))
    return FileLines(fault_lines(path, points, options))


def _fault_point(path: Path, location: str, row: str) -> MapPoint:
    match = ROW.fullmatch(row.strip())
    values = match["rest"].split() if match else []
    if match is None or len(values) < 4 or not values[-1].isdecimal():
        raise DataError(
            f"{path}: {location} must be INLINE- inline crossline X Y Z, an optional fault name, and the number of "
            "the stick; export it again in this format"
        )
    return _point(path, location, match, values, " ".join(values[3:-1]).strip('"'), values[-1])


def _point(path: Path, location: str, match: re.Match, values: list[str], name: str, part: str) -> MapPoint:
    named = name or match["quoted"] or match["name"] or ""
    numbers = dict(zip(("x", "y", "z"), values, strict=False)) | {"horizon": named, "stick": part}
    return map_point(path, location, numbers | {"inline": match["inline"], "crossline": match["crossline"]})
