"""What Charisma exports as text, and Petrel under its name: 3-D interpretation lines and fault sticks."""

from pathlib import Path

import numpy as np

from seiswidgets.errors import DataError
from seiswidgets.io.document import read_text
from seiswidgets.io.picks.exports import Choices, Node, fault_lines, horizon_lines, rows
from seiswidgets.io.picks.lines import Found
from seiswidgets.io.picks.numbers import number, undefined


def read_horizons(path: Path, choices: Choices) -> Found:
    """A horizon as "Charisma 3D interpretation lines": INLINE : n XLINE : n X Y Z, between blanks.

    The horizon is called as the file. It is cut along one inline or one crossline, ``line="inline 362"`` or
    ``line="xline 800"``, which need not be given where the file holds only one. Z is undefined from 1e29 on; there, and
    where the other number jumps, a piece ends.
    """
    nodes = (_horizon_node(path, place, row) for place, row in rows(read_text(path)))
    return Found(horizon_lines(path, nodes, choices))


def _horizon_node(path, place, row):
    values = row.replace(":", " ").split()
    if len(values) != 7 or (values[0], values[2]) != ("INLINE", "XLINE"):
        raise DataError(f"{path}: {place} must be INLINE : number XLINE : number X Y Z; export it again in this format")
    inline, crossline, x, y = (
        number(path, place, what, values[column]) for what, column in (("INLINE", 1), ("XLINE", 3), ("X", 4), ("Y", 5))
    )
    z = np.nan if undefined(values[6]) else number(path, place, "Z", values[6])
    return Node(_lines(inline, crossline), path.stem, "", x, y, z, place)


def _lines(inline, crossline):
    """The two seismic lines through a place, and its number on each."""
    return {f"inline {inline:.12g}": crossline, f"xline {crossline:.12g}": inline}


def read_faults(path: Path, choices: Choices) -> Found:
    """Faults as "Charisma fault sticks": INLINE- inline crossline X Y Z fault stick, between blanks.

    The fault's name may have blanks in it. Sticks are taken from one inline or crossline, as for horizons.
    """
    nodes = (_fault_node(path, place, row) for place, row in rows(read_text(path)))
    return Found(fault_lines(path, nodes, choices))


def _fault_node(path, place, row):
    values = row.split()
    if len(values) < 8 or values[0] != "INLINE-" or not values[-1].isdecimal():
        raise DataError(
            f"{path}: {place} must be INLINE- inline crossline X Y Z, the fault's name and the stick's number; export "
            "it again in this format"
        )
    inline, crossline, x, y, z = (
        number(path, place, what, values[column])
        for column, what in enumerate(("inline", "crossline", "X", "Y", "Z"), 1)
    )
    return Node(_lines(inline, crossline), " ".join(values[6:-1]), values[-1], x, y, z, place)
