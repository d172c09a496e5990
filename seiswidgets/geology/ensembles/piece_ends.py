"""Ends of horizons at faults: pieces that were drawn to a fault end there, wherever their errors move both."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
import shapely
from shapely import LineString, Point
from shapely.ops import substring

from seiswidgets.geology.fault_lines import NEAR

REACH = 20.0  # traces and samples by which a piece is lengthened or cut, at most
BASELINE = 10.0  # traces and samples over which the direction of its end is taken


@dataclass(frozen=True, eq=False)
class PieceEnd:
    """An end of a piece that lies at a fault.

    Attributes
    ----------
    which : 0 or -1
        The first or the last point of the piece.
    fault : int
        Index of the fault, among those that are not ignored.
    heading : array, shape (2,)
        Unit vector in which the piece goes on there as it was drawn, in traces and samples.
    """

    which: int
    fault: int
    heading: np.ndarray


def piece_ends(piece: np.ndarray, faults: Sequence[np.ndarray], cell: np.ndarray) -> Iterator[PieceEnd]:
    """Find the ends of a piece that lie within three traces and samples of a fault."""
    line = LineString(piece / cell)
    for which in (0, -1):
        tip = Point(line.coords[which])
        distances = [LineString(fault / cell).distance(tip) for fault in faults]
        if distances and min(distances) <= NEAR:
            stretch = min(BASELINE, line.length / 2)
            inner = line.interpolate(stretch if which == 0 else line.length - stretch)
            arm = np.subtract(tip.coords[0], inner.coords[0])
            yield PieceEnd(which, int(np.argmin(distances)), arm / np.hypot(*arm))


def brought_to_faults(
    piece: np.ndarray, ends: Sequence[PieceEnd], faults: Sequence[np.ndarray], cell: np.ndarray
) -> np.ndarray:
    """Lengthen or cut a piece at some of its ends so that it ends at its faults; an end out of reach stays."""
    for end in ends:
        backwards = end.which == 0
        points = piece[::-1] if backwards else piece
        points = _end_at(points / cell, faults[end.fault] / cell, end.heading) * cell
        piece = points[::-1] if backwards else points
    return piece


def _end_at(points: np.ndarray, fault: np.ndarray, heading: np.ndarray) -> np.ndarray:
    """Let a line end at its crossing with a fault that is nearest to its last point, all in traces and samples."""
    tip = LineString(points).length
    longer = LineString([*points, points[-1] + REACH * heading])
    crossings = shapely.get_parts(longer.intersection(LineString(fault)))
    stops = [longer.project(crossing.centroid) for crossing in crossings if not crossing.is_empty]
    stop = min(stops, key=lambda at: abs(at - tip), default=tip)
    if abs(stop - tip) > REACH or stop <= 0:
        return points
    return shapely.get_coordinates(substring(longer, 0, stop))
