"""Course of the section's line on the map: from its SEG-Y file, or through points that the user gives."""

from pathlib import Path
from typing import Any

import numpy as np

from seiswidgets.errors import DataError, SettingError
from seiswidgets.io.opening import kind_of
from seiswidgets.io.options import SEGY_OPTIONS
from seiswidgets.io.segy.reading import line_on_map
from seiswidgets.io.session.sources import FILE, SectionSource

EXAMPLE = "605000 6073000; 629000 6074000"


def segy_keywords(source: SectionSource | None) -> dict[str, Any] | None:
    """Keywords of `open_section` that select the section's line; None if it does not come from a SEG-Y file.

    Raises
    ------
    DataError
        If the section's file does not exist any more.
    """
    if source is None or source.kind != FILE or kind_of(source.name) != "SEG-Y":
        return None
    return {name: value for name, value in source.keywords.items() if name in SEGY_OPTIONS}


def segy_line(source: SectionSource | None) -> np.ndarray:
    """Map coordinates of the section's line from its SEG-Y file, shape (m, 2).

    Raises
    ------
    DataError
        If the section does not come from a SEG-Y file, or its positions were not used; and as for `segy_keywords`.
    """
    keywords = segy_keywords(source)
    if source is None or keywords is None:
        raise DataError("the section does not come from a SEG-Y file on the server's disk; give points of its line")
    if "dx" in source.choices:
        raise DataError(f"the positions in {source.name} were not used for the section; give points of its line")
    return line_on_map(Path(source.name), **keywords)


def points_of(text: str) -> list[tuple[float, float]]:
    """Parse points "X Y" separated by semicolons.

    Raises
    ------
    SettingError
        If there are not at least two points.
    """
    try:
        rows = [point.replace(",", " ").split() for point in text.split(";") if point.strip()]
        points = [(float(x), float(y)) for x, y in rows]
    except ValueError:
        points = []
    if len(points) < 2:
        raise SettingError(f"points of the line must be two or more X Y, as in {EXAMPLE}, but are {text!r}")
    return points
