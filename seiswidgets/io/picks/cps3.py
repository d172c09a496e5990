"""Lines in the CPS-3 format, as Petrel and others export them."""

from pathlib import Path

import numpy as np

from seiswidgets.errors import DataError
from seiswidgets.io.document import read_text
from seiswidgets.io.picks.lines import FileLines, depth, number
from seiswidgets.io.picks.map_points import ExportOptions, Node, fault_lines, horizon_lines, rows

HEADER = ("FF", "FS")  # FFASCI, FFATTR, ...: how the file was written, nothing that places a pick


def read_horizons(path: Path, choices: ExportOptions) -> FileLines:
    """A horizon as "CPS-3 lines": a row ``->`` before each piece, then a row X Y Z a point.

    Rows of a header begin with FF or FS. The horizon is called as the file; what stands behind the arrow is not used.
    """
    return FileLines(horizon_lines(path, _nodes(path), choices))


def read_faults(path: Path, choices: ExportOptions) -> FileLines:
    """Faults as "CPS-3 lines": as for horizons, each piece a fault, called as the file, with a number if several."""
    return FileLines(fault_lines(path, _nodes(path), choices))


def _nodes(path):
    block = 0
    for place, row in rows(read_text(path)):
        if row.lstrip().startswith("->"):
            block += 1
        elif not row.lstrip().startswith(HEADER):
            yield _node(path, place, row, block)


def _node(path, place, row, block):
    values = row.split()
    if len(values) != 3:
        raise DataError(f"{path}: {place} must be X, Y and Z, but has {len(values)} values; export it again with Z")
    x, y = (number(path, place, what, text) for what, text in zip("XY", values, strict=False))
    return Node({"": np.nan}, path.stem, str(block), x, y, depth(path, place, values[2]), place)
