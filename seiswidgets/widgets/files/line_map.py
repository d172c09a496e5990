"""Where the section's line runs on the map: as its SEG-Y file has it, or through points that a user gives."""

from pathlib import Path

import numpy as np

from seiswidgets.errors import DataError, SettingError
from seiswidgets.io.opening import kind_of
from seiswidgets.io.options import SEGY_OPTIONS
from seiswidgets.io.segy.reading import line_on_map
from seiswidgets.io.session.sources import FILE, SectionSource

EXAMPLE = "605000 6073000; 629000 6074000"


def of_segy(source: SectionSource | None) -> dict | None:
    """Which line of the SEG-Y file the section is, as `open_section` takes it; None if it comes from no such file.

    Raises
    ------
    DataError
        If the section's file is there no more.
    """
    if source is None or source.kind != FILE or kind_of(source.name) != "SEG-Y":
        return None
    return {name: value for name, value in source.keywords.items() if name in SEGY_OPTIONS}


def segy_line(source: SectionSource | None) -> np.ndarray:
    """Map coordinates of the section's line from its SEG-Y file, shape (m, 2).

    Raises
    ------
    DataError
        If the section comes from no SEG-Y file, or one whose positions were not used; and as for `of_segy`.
    """
    line = of_segy(source)
    if line is None:
        raise DataError("the section does not come from a SEG-Y file on the server's disk; give points of its line")
    if "dx" in source.choices:
        raise DataError(f"the positions in {source.name} were not used for the section; give points of its line")
    return line_on_map(Path(source.name), **line)


def points_of(text: str) -> list[tuple[float, float]]:
    """Points X Y, parted by semicolons, as a user enters them.

    Raises
    ------
    SettingError
        If they are not two points or more.
    """
    try:
        points = [tuple(map(float, point.replace(",", " ").split())) for point in text.split(";") if point.strip()]
    except ValueError:
        points = []
    if len(points) < 2 or any(len(point) != 2 for point in points):
        raise SettingError(f"points of the line must be two or more X Y, as in {EXAMPLE}, but are {text!r}")
    return points
