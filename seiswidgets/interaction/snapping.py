"""Horizons snap to what is seen: the nearest peak, trough or zero crossing, and lines that follow it between clicks.

Between two traces the amplitudes are interpolated linearly, so that a point keeps its x and moves along z only.
Extrema are refined by the parabola through three samples, zero crossings by the straight line through two.
"""

import numpy as np
import shapely
from scipy.ndimage import map_coordinates

from seiswidgets.errors import SettingError
from seiswidgets.geology.section import Section

EVENTS = ("peak", "trough", "zero-up", "zero-down")
WIGGLE = 0.05  # of the amplitudes within the window: extrema that stand out less are noise
NEAR = 2.0  # samples: how far from the route along an event its exact place may be
COARSE = 0.25  # samples: how far a line that follows an event may leave it where points are left out
NO_DATA = 25.0  # what crossing a sample without data costs, where an ordinary one costs 0.02 to 1

Point = tuple[float, float]


def snapped(section: Section, point: Point, event: str = "peak", window: float = 5.0) -> Point:
    """The place nearest to a point, straight above or below it, at which its trace has an event.

    Parameters
    ----------
    section : Section
    point : (x, z)
    event : {"peak", "trough", "zero-up", "zero-down"}
        Zero crossings up go from negative to positive with increasing z.
    window : float
        How many samples the point may move, up or down.

    Returns
    -------
    point : (x, z)
        To a tenth of a sample; the point as it was where there is no such event in the window, or no data.

    Raises
    ------
    SettingError
        If there is no such event, or the window is not above 0.
    """
    _check(event, window)
    x, z = (float(value) for value in point)
    column, row = (x - section.x0) / section.dx, (z - section.z0) / section.dz
    place = _nearest(_trace(section, column), row, event, window)
    return (x, z) if place is None else (x, section.z0 + place * section.dz)


def followed(
    section: Section, start: Point, end: Point, event: str = "peak", window: float = 20.0, coarse: float = COARSE
) -> np.ndarray:
    """The line along an event from one point to another.

    A route of least cost (`skimage.graph.route_through_array`) through the amplitudes near the straight line, refined
    at each trace, without the points that a straight line can do without.

    Parameters
    ----------
    section : Section
    start, end : (x, z)
        The line's ends, which stay where they are.
    event : {"peak", "trough", "zero-up", "zero-down"}
    window : float
        How many samples the line may leave the straight one, up or down.
    coarse : float
        How many samples it may leave the event, up or down, for the sake of fewer points.

    Returns
    -------
    line : array, shape (n, 2), n >= 2
        Straight where an end lies off the section.

    Raises
    ------
    SettingError
        If there is no such event, or the window is not above 0.
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
    rows = _route(section, columns, np.interp(columns, *cells[np.argsort(cells[:, 0])].T), event, window)
    inner = np.column_stack([columns, rows])[:: 1 if cells[0, 0] < cells[1, 0] else -1]
    kept = _simplified(np.vstack([cells[:1], inner, cells[1:]]), coarse) * steps + (section.x0, section.z0)
    return np.vstack([ends[:1], kept[1:-1], ends[1:]])


def _check(event, window):
    if event not in EVENTS:
        raise SettingError(f"event must be one of {', '.join(EVENTS)}, but is {event!r}")
    if not (np.isfinite(window) and window > 0):
        raise SettingError(f"window must be a number of samples above 0, but is {window!r}")


def _trace(section, column):
    """The amplitudes at a fractional column, shape (nz,); none off the section."""
    if not 0 <= column <= section.shape[1] - 1:
        return np.empty(0)
    left, part = int(column), column - int(column)
    trace = section.amplitude[:, left].astype(float)
    return trace if part == 0 else (1 - part) * trace + part * section.amplitude[:, left + 1]


def _nearest(trace, row, event, window):
    """The fractional sample of the event that is nearest to a fractional sample, None if none is in the window."""
    if len(trace) < 3 or not np.isfinite(row):
        return None
    low, high = max(0, int(np.floor(row - window)) - 1), min(len(trace), int(np.ceil(row + window)) + 2)
    if high - low < 2:
        return None
    if event in ("peak", "trough"):
        near = trace[low:high]
        least = WIGGLE * np.ptp(near[np.isfinite(near)]) if np.isfinite(near).any() else 0.0
        places = _peaks(trace if event == "peak" else -trace, least)
    else:
        places = low + _crossings(trace[low:high] if event == "zero-up" else -trace[low:high])
    places = places[abs(places - row) <= window + 1e-9]
    return None if len(places) == 0 else float(places[np.argmin(abs(places - row))])


def _peaks(trace, least):
    """Fractional samples of the peaks that stand out so far; of clipped ones, the middle."""
    from scipy.signal import find_peaks  # takes half a second to load, which an app that does not snap can spare

    places, found = find_peaks(trace, prominence=least, plateau_size=1)
    before, top, after = trace[places - 1], trace[places], trace[np.minimum(places + 1, len(trace) - 1)]
    middle = (found["left_edges"] + found["right_edges"]) / 2
    bend = 2 * top - before - after
    sharp = (found["plateau_sizes"] == 1) & (bend > 0)
    return np.where(sharp, places + (after - before) / (2 * np.where(sharp, bend, 1.0)), middle)


def _crossings(trace):
    """Fractional samples at which a trace goes from below zero to zero or above."""
    before, after = trace[:-1], trace[1:]
    at = np.flatnonzero((before < 0) & (after >= 0))
    return at - before[at] / (after[at] - before[at])


def _route(section, columns, rows, event, window):
    """The fractional sample of an event at each column, along a route near some rows."""
    from skimage.graph import route_through_array  # as slow to load

    strip = _strip(section, columns, rows, window)
    cost = _cost(strip, event)
    middle = len(strip) // 2
    path, _ = route_through_array(cost, (middle, 0), (middle, cost.shape[1] - 1), fully_connected=True)
    best = {}
    for offset, column in path:
        if column not in best or cost[offset, column] < cost[best[column], column]:
            best[column] = offset
    near = [rows[i] + best.get(i + 1, middle) - middle for i in range(len(columns))]
    places = [_nearest(_trace(section, column), row, event, NEAR) for column, row in zip(columns, near, strict=True)]
    return [row if place is None else place for row, place in zip(near, places, strict=True)]


def _strip(section, columns, rows, window):
    """Amplitudes about a straight line, which is the middle row; NaN off the section."""
    reach = int(np.ceil(window))
    offsets = np.arange(-reach, reach + 1)[:, None]
    at = np.broadcast_to(columns, (len(offsets), len(columns)))
    return map_coordinates(section.amplitude, [rows + offsets, at], order=1, cval=np.nan, output=float)


def _cost(strip, event):
    """What each place of a strip costs a line that follows an event, with a column before it and after for its ends."""
    signal = strip if event in ("peak", "trough") else np.gradient(strip, axis=0)
    signal = -signal if event in ("trough", "zero-down") else signal
    loud = np.nanstd(signal) if np.isfinite(signal).any() else 0.0
    cost = 0.02 + 1 / (1 + np.exp(np.clip(3 * signal / (loud or 1.0), -30, 30)))
    cost = np.where(np.isfinite(cost), cost, NO_DATA)
    return np.pad(cost, ((0, 0), (1, 1)), constant_values=1.0)


def _simplified(line, coarse):
    """A line without the points that it passes within so many samples anyway, measured along z."""
    flat = line * (1e4, 1.0)  # so that distances from the line are those along z
    return np.array(shapely.LineString(flat).simplify(coarse, preserve_topology=False).coords) / (1e4, 1.0)
