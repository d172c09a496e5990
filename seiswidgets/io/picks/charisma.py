"""What Charisma exports as text, and Petrel under its name: 3-D interpretation lines and fault sticks."""

import re
from pathlib import Path

from seiswidgets.errors import DataError
from seiswidgets.io.document import read_text
from seiswidgets.io.picks.lines import FileLines, depth, number
from seiswidgets.io.picks.map_points import ExportOptions, Node, fault_lines, horizon_lines, rows

MARK = re.compile(r"\b(?:INLINE|XLINE)\s*[:-]?")  # before a line's number, with or without blanks around it
COLUMNS = ("inline", "crossline", "X", "Y")


def read_horizons(path: Path, choices: ExportOptions) -> FileLines:
    """Horizons as "Charisma 3D interpretation lines": INLINE : n XLINE : n X Y Z [name], between blanks.

    A horizon without a name is called as the file. It is cut along one inline or one crossline, ``line="inline 362"``
    or ``line="xline 800"``, which need not be given where the file holds only one. Z is undefined from 9,999,900 on;
    there, and where the other number jumps, a piece ends.
    """
    nodes = (_horizon_node(path, place, row) for place, row in rows(read_text(path)))
    return FileLines(horizon_lines(path, nodes, choices))


def _horizon_node(path, place, row):
    values = MARK.sub(" ", row).split()
    name = values[5:]
    if len(MARK.findall(row)) != 2 or len(values) < 5 or (name and _is_number(name[0])):
        raise DataError(
            f"{path}: {place} must be INLINE : number XLINE : number X Y Z, and a name or none; export it again in "
            "this format"
        )
    return _node(path, place, values, " ".join(name), "")


def read_faults(path: Path, choices: ExportOptions) -> FileLines:
    """Faults as "Charisma fault sticks": INLINE- inline crossline X Y Z [fault] stick, between blanks.

    The fault's name may have blanks in it; without one it is called as the file. Sticks are taken from one inline or
    crossline, as for horizons.
    """
    nodes = (_fault_node(path, place, row) for place, row in rows(read_text(path)))
    return FileLines(fault_lines(path, nodes, choices))


def _fault_node(path, place, row):
    values = MARK.sub(" ", row).split()
    if len(values) < 6 or not row.lstrip().startswith("INLINE") or not values[-1].isdecimal():
        raise DataError(
            f"{path}: {place} must be INLINE- inline crossline X Y Z, the fault's name or none, and the stick's "
            "number; export it again in this format"
        )
    return _node(path, place, values, " ".join(values[5:-1]), values[-1])


def _node(path, place, values, name, part):
    inline, crossline, x, y = (number(path, place, *pair) for pair in zip(COLUMNS, values, strict=False))
    lines = {f"inline {inline:.12g}": crossline, f"xline {crossline:.12g}": inline}  # with its number on each
    return Node(lines, name or path.stem, part, x, y, depth(path, place, values[4]), place)


def _is_number(text):
    return text[0] in "+-.0123456789"
