"""What OpendTect exports as text: 2-D horizons, faults and fault stick sets."""

import re
from pathlib import Path

import numpy as np

from seiswidgets.errors import DataError
from seiswidgets.io.document import read_text
from seiswidgets.io.picks.lines import FileLines, depth, number
from seiswidgets.io.picks.map_points import ExportOptions, Node, fault_lines, horizon_lines, rows

HEADER = 4000  # characters, in which a header is looked for
QUOTED = re.compile(r'\s*"([^"]*)"')


def read_horizons(path: Path, choices: ExportOptions) -> FileLines:
    """2-D horizons (Export > Horizons > ASCII 2D): ["horizon"] ["line"] X Y trace shot-point Z, between blanks.

    Names stand in double quotes. With both it is horizon, then line; with one it is the line, unless the header names
    the horizon's column alone. A horizon without a name is called as the file. Z is undefined from 9,999,900 on, or
    if it is "-"; there, and where trace numbers jump, a piece ends. The header, if there is one, states the unit of z.
    """
    text = read_text(path)
    header = " ".join(row for row in text[:HEADER].splitlines() if row.lstrip().startswith("#"))
    horizon_alone = "Horizon Name" in header and not re.search("PickLine name", header, re.IGNORECASE)
    nodes = (_horizon_node(path, place, row, horizon_alone) for place, row in rows(text))
    unit = re.search(r"\bZ \((\w+)\)", header)
    return FileLines(horizon_lines(path, nodes, choices), z_unit=unit and unit[1])


def _horizon_node(path, place, row, horizon_alone):
    names, row = _names(row)
    if len(names) == 1:
        names = [*names, ""] if horizon_alone else [path.stem, *names]
    values = row.split()
    if len(values) != 5 or len(names) > 2:
        raise DataError(
            f"{path}: {place} must be names in quotes (horizon, line), then X, Y, trace, shot point and Z, but has "
            f"{len(names)} names and {len(values)} values; export it again, with Z"
        )
    horizon, line = names or (path.stem, "")
    x, y, trace = (number(path, place, what, text) for what, text in zip(("X", "Y", "trace"), values, strict=False))
    return Node({line: trace}, horizon, "", x, y, depth(path, place, values[4]), place)


def _names(row):
    """The names in quotes that a row begins with, and the rest of it."""
    names, end = [], 0
    while match := QUOTED.match(row, end):
        names.append(match[1])
        end = match.end()
    return names, row[end:]


def read_faults(path: Path, choices: ExportOptions) -> FileLines:
    """Faults and fault stick sets (Export > Faults): ["fault"] X Y Z stick node [line], between tabs.

    Stick and node index must have been chosen for the export, and X/Y rather than inline and crossline, unless
    ``along`` is "x" or "y" for these. A fault without a name is called as the file.
    """
    nodes = (_fault_node(path, place, row) for place, row in rows(read_text(path)))
    return FileLines(fault_lines(path, nodes, choices))


def _fault_node(path, place, row):
    names, row = _names(row)
    values = row.strip().split("\t") if "\t" in row.strip() else row.split(maxsplit=5)
    if len(values) not in (5, 6) or len(names) > 1 or not all(value.strip().isdecimal() for value in values[3:5]):
        raise DataError(
            f"{path}: {place} must be the fault's name in quotes or none, then X, Y, Z, stick index, node index and "
            "the line's name or none; export it again, with both indices"
        )
    x, y = (number(path, place, what, text) for what, text in zip("XY", values, strict=False))
    line = values[5].strip() if len(values) == 6 else ""
    z = depth(path, place, values[2].strip())
    return Node({line: np.nan}, (names or [path.stem])[0], values[3].strip(), x, y, z, place)
