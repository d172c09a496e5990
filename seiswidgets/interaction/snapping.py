"""Snapping of the ends of faults to what they nearly reach, and of horizons to events, also between two clicks.

Events are peaks, troughs and zero crossings.
Between two traces amplitudes are interpolated linearly, so that a point keeps its x and moves along z only. Extrema
are refined by a parabola through three samples, zero crossings by a straight line through two.
"""

from collections.abc import Iterable

import numpy as np
import shapely
from numpy.typing import ArrayLike
from scipy.ndimage import map_coordinates

from seiswidgets.errors import SettingError
from seiswidgets.geology.section import Section
from seiswidgets.interaction.drawing import Point

EVENTS = ("peak", "trough", "zero-up", "zero-down")
PROMINENCE = 0.05  # least prominence of an extremum, as a share of the range of amplitudes in the window
ROUTE_WINDOW = 2.0  # samples within which the exact event is sought about the route
TOLERANCE = 0.25  # samples that a simplified line may be off the event
END_REACH = 10.0  # css pixels within which the end of a fault snaps
NO_DATA = 25.0  # cost of a sample without data, where others cost 0.02 to 1


def snap_to_event(section: Section, point: Point, event: str = "peak", window: float = 5.0) -> Point:
    """The nearest event straight above or below a point.

    Parameters
    ----------
    section : Section
    point : (x, z)
    event : {"peak", "trough", "zero-up", "zero-down"}
        Zero crossings up go from negative to positive with increasing z.
    window : float
        Number of samples that the point may move up or down.

    Returns
    -------
    point : (x, z)
        Accurate to a tenth of a sample; the point as given if the window holds no such event, or no data.

    Raises
    ------
    SettingError
        If the event is not one of these, or the window is not above 0.
    """
    _check(event, window)
    x, z = (float(value) for value in point)
    column, row = (x - section.x0) / section.dx, (z - section.z0) / section.dz
    sample = _nearest_event(_trace(section, column), row, event, window)
    return (x, z) if sample is None else (x, section.z0 + sample * section.dz)


def follow_event(
    section: Section, start: Point, end: Point, event: str = "peak", window: float = 20.0, tolerance: float = TOLERANCE
) -> np.ndarray:
    """The line along an event from one point to another.

    A route of least cost (`skimage.graph.route_through_array`) through the amplitudes near the straight line is refined
    at each trace, and simplified.

    Parameters
    ----------
    section : Section
    start, end : (x, z)
        Ends of the line, which do not move.
    event : {"peak", "trough", "zero-up", "zero-down"}
    window : float
        Number of samples that the line may lie above or below the straight one.
    tolerance : float
        Number of samples that it may lie above or below the event, to save points.

    Returns
    -------
    line : array, shape (n, 2), n >= 2
        Straight if an end lies outside the section.

    Raises
    ------
    SettingError
        If the event is not one of these, or the window is not above 0.
    """
    _check(event, window)
    ends = np.array([start, end], float)
    steps = np.array([section.dx, section.dz])
    cells = (ends - (section.x0, section.z0)) / steps
    if not (np.isfinite(cells).all() and section.contains(ends).all()):
        return ends
    (first, _), (last, _) = cells[np.argsort(cells[:, 0])]
    columns = np.arange(np.floor(first) + 1, np.ceil(last))
    if len(columns) == 0:
        return ends
    straight = np.interp(columns, *cells[np.argsort(cells[:, 0])].T)
    rows = _route(section, columns, straight, event, window)
    inner = np.column_stack([columns, rows])[:: 1 if cells[0, 0] < cells[1, 0] else -1]
    kept = _simplified(np.vstack([cells[:1], inner, cells[1:]]), tolerance) * steps + (section.x0, section.z0)
    return np.vstack([ends[:1], kept[1:-1], ends[1:]])


def snap_to_lines(point: Point, lines: Iterable[ArrayLike], pixel: ArrayLike) -> Point:
    """The nearest point of some lines, if one lies within ten css pixels; else the point itself.

    Parameters
    ----------
    point : (x, z)
    lines : iterable of arrays, each of shape (n, 2), n >= 2
    pixel : array, shape (2,)
        Width and height of a css pixel, in the section's units.
    """
    tip = shapely.Point(np.divide(point, pixel))
    scaled = [shapely.LineString(np.divide(line, pixel)) for line in lines]
    nearest = min(scaled, key=tip.distance, default=None)
    if nearest is None or tip.distance(nearest) > END_REACH:
        return point
    x, z = np.multiply(nearest.interpolate(nearest.project(tip)).coords[0], pixel).tolist()
    return x, z


def _check(event: str, window: float) -> None:
    if event not in EVENTS:
        raise SettingError(f"event must be one of {', '.join(EVENTS)}, but is {event!r}")
    if not (np.isfinite(window) and window > 0):
        raise SettingError(f"window must be a number of samples above 0, but is {window!r}")


def _trace(section: Section, column: float) -> np.ndarray:
    """Amplitudes at a fractional column, shape (nz,); empty outside the section."""
    if not 0 <= column <= section.shape[1] - 1:
        return np.empty(0)
    left, share = int(column), column - int(column)
    trace = section.amplitude[:, left].astype(float)
    return trace if share == 0 else (1 - share) * trace + share * section.amplitude[:, left + 1]


def _nearest_event(trace: np.ndarray, row: float, event: str, window: float) -> float | None:
    """Fractional sample of the event nearest to a fractional sample; None if the window holds no event."""
    if len(trace) < 3 or not np.isfinite(row):
        return None
    low, high = max(0, int(np.floor(row - window)) - 1), min(len(trace), int(np.ceil(row + window)) + 2)
    if high - low < 2:
        return None
    if event in ("peak", "trough"):
        part = trace[low:high]
        prominence = PROMINENCE * np.ptp(part[np.isfinite(part)]) if np.isfinite(part).any() else 0.0
        events = _peaks(trace if event == "peak" else -trace, prominence)
    else:
        events = low + _crossings(trace[low:high] if event == "zero-up" else -trace[low:high])
    events = events[abs(events - row) <= window + 1e-9]
    return None if len(events) == 0 else float(events[np.argmin(abs(events - row))])


def _peaks(trace: np.ndarray, prominence: float) -> np.ndarray:
    """Fractional samples of the peaks of some prominence; the middles of clipped ones."""
    from scipy.signal import find_peaks  # takes half a second to load, which only an app that snaps needs

    peaks, properties = find_peaks(trace, prominence=prominence, plateau_size=1)
    before, top, after = trace[peaks - 1], trace[peaks], trace[np.minimum(peaks + 1, len(trace) - 1)]
    middle = (properties["left_edges"] + properties["right_edges"]) / 2
    curvature = 2 * top - before - after
    is_sharp = (properties["plateau_sizes"] == 1) & (curvature > 0)
    return np.where(is_sharp, peaks + (after - before) / (2 * np.where(is_sharp, curvature, 1.0)), middle)


def _crossings(trace: np.ndarray) -> np.ndarray:
    """Fractional samples at which a trace rises from below zero to zero or above."""
    before, after = trace[:-1], trace[1:]
    index = np.flatnonzero((before < 0) & (after >= 0))
    return index - before[index] / (after[index] - before[index])


def _route(section: Section, columns: np.ndarray, rows: np.ndarray, event: str, window: float) -> list[float]:
    """Fractional sample of an event at each column, along the cheapest route near some rows."""
    refined = []
    for column, row in zip(columns, rows + _route_offsets(section, columns, rows, event, window), strict=True):
        sample = _nearest_event(_trace(section, column), row, event, ROUTE_WINDOW)
        refined.append(float(row) if sample is None else sample)
    return refined


def _route_offsets(section: Section, columns: np.ndarray, rows: np.ndarray, event: str, window: float) -> np.ndarray:
    """Whole samples that the cheapest route lies below some rows, for each column."""
    from skimage.graph import route_through_array  # slow to load, too

    cost = _cost(_strip(section, columns, rows, window), event)
    middle = len(cost) // 2
    ends = (middle, 0), (middle, cost.shape[1] - 1)
    route, _ = route_through_array(cost, *ends, fully_connected=True)  # type: ignore[no-untyped-call] # not annotated
    best: dict[int, int] = {}
    for offset, column in route:
        if column not in best or cost[offset, column] < cost[best[column], column]:
            best[column] = offset
    return np.array([best.get(index + 1, middle) - middle for index in range(len(columns))])


def _strip(section: Section, columns: np.ndarray, rows: np.ndarray, window: float) -> np.ndarray:
    """Amplitudes about a straight line, which is the middle row; NaN outside the section."""
    reach = int(np.ceil(window))
    offsets = np.arange(-reach, reach + 1)[:, None]
    at = np.broadcast_to(columns, (len(offsets), len(columns)))
    return map_coordinates(section.amplitude, [rows + offsets, at], order=1, cval=np.nan, output=float)


def _cost(strip: np.ndarray, event: str) -> np.ndarray:
    """Cost of each sample of a strip for a route along an event, with a column added on both sides for its ends."""
    signal = strip if event in ("peak", "trough") else np.gradient(strip, axis=0)
    signal = -signal if event in ("trough", "zero-down") else signal
    deviation = np.nanstd(signal) if np.isfinite(signal).any() else 0.0
    cost = 0.02 + 1 / (1 + np.exp(np.clip(3 * signal / (deviation or 1.0), -30, 30)))
    cost = np.where(np.isfinite(cost), cost, NO_DATA)
    return np.pad(cost, ((0, 0), (1, 1)), constant_values=1.0)


def _simplified(line: np.ndarray, tolerance: float) -> np.ndarray:
    """Leave out points of a line, moving it by no more than ``tolerance`` samples along z."""
    flat = line * (1e4, 1.0)  # makes distances from the line those along z
    return np.array(shapely.LineString(flat).simplify(tolerance, preserve_topology=False).coords) / (1e4, 1.0)
