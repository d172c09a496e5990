"""Sliding a piece along a fault: its cut-off stays on the fault, and the rest of it moves with the cut-off."""

import numpy as np
import shapely
from numpy.typing import ArrayLike
from shapely import LineString

from seiswidgets.geology.section import Section


def slide_piece(piece: ArrayLike, fault: ArrayLike, slip: float, section: Section) -> np.ndarray:
    """Move a piece by a slip along the fault that it ends at.

    Parameters
    ----------
    piece, fault : array, shape (n, 2)
        Their points, in the section's units. The end of the piece that is nearest to the fault is its cut-off.
    slip : float
        Metres of rock along the fault, positive downwards; limited so that the cut-off stays on the fault.
    section : Section

    Returns
    -------
    piece : array, shape (m, 2)
        The piece, moved without a change of shape; what leaves the section is cut off.
    """
    points, line = section.to_rock(piece), _downward(fault, section)
    start = line.project(shapely.Point(points[nearest_end(points, line)]))
    before, after = shapely.get_coordinates(line.interpolate([start, np.clip(start + slip, 0.0, line.length)]))
    return within_section(section.from_rock(points + after - before), section)


def within_section(piece: ArrayLike, section: Section) -> np.ndarray:
    """The longest part of a line that lies in a section, shape (n, 2); empty if it lies outside."""
    points = np.reshape(np.asarray(piece, float), (-1, 2))
    if section.contains(points).all():
        return points
    x_min, x_max, z_min, z_max = section.extent
    parts = shapely.get_parts(shapely.intersection(LineString(points), shapely.box(x_min, z_min, x_max, z_max)))
    longest = max(parts, key=lambda part: float(part.length), default=LineString())
    return np.clip(shapely.get_coordinates(longest), (x_min, z_min), (x_max, z_max))


def slip_to(piece: ArrayLike, fault: ArrayLike, point: ArrayLike, section: Section) -> float:
    """Slip that brings the cut-off of a piece to the point of a fault that is nearest to a point; see `slide_piece`."""
    points, line = section.to_rock(piece), _downward(fault, section)
    start, stop = (
        line.project(shapely.Point(one)) for one in (points[nearest_end(points, line)], section.to_rock(point))
    )
    return float(stop - start)


def nearest_end(points: np.ndarray, line: LineString) -> int:
    """The end, 0 or -1, of a piece that is nearest to a line."""
    first, last = shapely.distance(line, shapely.points(points[[0, -1]]))
    return 0 if first <= last else -1


def _downward(fault: ArrayLike, section: Section) -> LineString:
    """A fault in metres of rock, from its upper end to its lower one, or from left to right."""
    points = section.to_rock(fault)
    is_downward = tuple(points[0, ::-1]) <= tuple(points[-1, ::-1])
    return LineString(points if is_downward else points[::-1])
