"""The ends of lines at faults: extended straight ahead, and kept there while a piece moves."""

from collections.abc import Sequence

import numpy as np
import shapely
from numpy.typing import ArrayLike
from shapely import LineString, Point
from shapely.ops import substring

from seiswidgets.geology.section import Section
from seiswidgets.geology.segments import nearest_fault_ahead

ENDS = (0, -1)  # indices of a line's first and last point
AT_WALL = 1.0  # traces or samples within which a line ends at a fault


def extend_end(
    points: np.ndarray, which: int, walls: Sequence[ArrayLike], section: Section, reach: float | None = None
) -> tuple[np.ndarray, int | None]:
    """Extend an end (0 or -1) of a line straight ahead to the first of some walls.

    Parameters
    ----------
    points : array, shape (n, 2)
    walls : sequence of arrays, each of shape (m, 2)
    section : Section
    reach : float, optional
        Greatest length, in metres of rock; as for a horizon in a restoration if left out.

    Returns
    -------
    points : array, shape (n or n + 1, 2)
    wall : int or None
        Index of the wall that is reached; None if the line is not extended.
    """
    lines, cell = [LineString(section.to_rock(wall)) for wall in walls], section.metres * (section.dx, section.dz)
    far = float(np.hypot(*(cell * section.shape[::-1])))
    line = LineString(section.to_rock(points))
    end = nearest_fault_ahead(line, which, lines, cell, reach and min(reach, far)) if lines else None
    if end is None or end.gap == 0:
        return points, None
    return np.insert(points, 0 if which == 0 else len(points), section.from_rock(end.point), axis=0), end.fault


def fit_ends(points: np.ndarray, before: ArrayLike, walls: Sequence[ArrayLike], section: Section) -> np.ndarray:
    """Bring the ends of a line that has moved to the walls that it ended at before, by trimming or extending it.

    An end is trimmed by less than half of the line, and extended as far as a restoration would, without a new vertex.
    """
    for which in ENDS:
        for wall in walls:
            if len(points) > 1 and ends_at(before, wall, section, [which]):
                points = _trimmed(points, which, LineString(section.to_rock(wall)), section)
                extended, reached = extend_end(points, which, [wall], section)
                points = points if reached is None else np.delete(extended, 1 if which == 0 else -2, axis=0)
    return points


def ends_at(points: ArrayLike, wall: ArrayLike, section: Section, ends: Sequence[int] = ENDS) -> bool:
    """Return whether one of the ends of a line lies at a wall."""
    line, near = LineString(section.to_rock(wall)), AT_WALL * float(min(section.metres * (section.dx, section.dz)))
    return any(line.distance(Point(section.to_rock(np.asarray(points)[which]))) <= near for which in ends)


def _trimmed(points: np.ndarray, which: int, wall: LineString, section: Section) -> np.ndarray:
    """Cut off the end of a line beyond the crossing with a wall that is nearest to it."""
    line = LineString(section.to_rock(points))
    overshoots = [
        at if which == 0 else line.length - at
        for at in (line.project(part.centroid) for part in shapely.get_parts(line.intersection(wall)))
    ]
    overshoot = min(overshoots, default=0.0)
    if not 0 < overshoot < line.length / 2:
        return points
    kept = (overshoot, line.length) if which == 0 else (0.0, line.length - overshoot)
    return np.asarray(section.from_rock(shapely.get_coordinates(substring(line, *kept))))
