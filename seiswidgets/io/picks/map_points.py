"""Common parts of other programs' exports: points on a map, from one seismic line or from several."""

import re
from collections import Counter
from collections.abc import Callable, Hashable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path
from reprlib import repr as brief
from typing import TypeVar

import numpy as np
import shapely

from seiswidgets.errors import DataError, Keyword
from seiswidgets.geology.picks import FAULT, HORIZON
from seiswidgets.io.document import MOST_POINTS, shortened, text_lines
from seiswidgets.io.picks.lines import PickLine

MOST_BESIDE = 0.01  # of the line's length: distance of a pick from it
NUMBERED = re.compile(r"(inline|xline|column|row) \d")  # lines of a 3-D survey
LONGEST_ROW = 1000  # characters
MOST_LISTED = 6  # seismic lines that a message lists

MapFunction = Callable[[np.ndarray, np.ndarray, np.ndarray], object]
Along = str | MapFunction | np.ndarray | Sequence[tuple[float, float]]
Key = TypeVar("Key", bound=Hashable)

LINE, ALONG = Keyword("line"), Keyword("along")  # as errors name them


@dataclass(frozen=True, slots=True)
class MapPoint:
    """A point in an export.

    Attributes
    ----------
    traces : dict
        Trace number on each of the seismic lines that the point lies on, by the line's name.
    name, part : str
        The pick, and its stick or piece where the export has them.
    x, y, z : float
        Position on the map, and depth or time: NaN where the export marks it as undefined.
    location : str
        Location in the file.
    """

    traces: dict[str, float]
    name: str
    part: str
    x: float
    y: float
    z: float
    location: str


@dataclass(frozen=True)
class ExportOptions:
    """Information missing in exports: the seismic line, and how map positions become positions along the section."""

    line: str | None
    along: Along | None


def data_rows(text: str) -> Iterator[tuple[str, str]]:
    """Location and content of the rows that are neither blank nor a comment.

    A row is cut off where it is longer than any row of picks, so that it is refused without taking long.
    """
    for count, long_row in enumerate(text_lines(text), 1):
        row = long_row[:LONGEST_ROW]
        if row.strip() and not row.lstrip().startswith(("#", "!")):
            yield f"row {count}", row


def fault_lines(path: Path, points: Iterable[MapPoint], options: ExportOptions) -> tuple[PickLine, ...]:
    """One fault per stick, named like its fault, with the stick's number if that has several on the line.

    Points without a depth are left out.
    """
    seismic_line, kept = _on_one_line(path, points, options.line)
    sticks = _grouped(((point.name, point.part), point) for point in kept if not np.isnan(point.z))
    stick_counts = Counter(name for name, _ in sticks)
    return tuple(
        _pick_line(path, FAULT, f"{name} {part}" if stick_counts[name] > 1 else name, stick, seismic_line, options)
        for (name, part), stick in sticks.items()
    )


def horizon_lines(path: Path, points: Iterable[MapPoint], options: ExportOptions) -> tuple[PickLine, ...]:
    """The pieces of each horizon, which end where a trace has no pick or is not the next one."""
    seismic_line, kept = _on_one_line(path, points, options.line)
    return tuple(
        _pick_line(path, HORIZON, name, piece, seismic_line, options)
        for name, horizon in _grouped((point.name, point) for point in kept).items()
        for piece in _pieces(horizon, seismic_line)
    )


def _on_one_line(path: Path, points: Iterable[MapPoint], line: str | None) -> tuple[str, list[MapPoint]]:
    """The seismic line that was chosen, or the only one, and its points; others are not kept in memory."""
    known: dict[str, None] = {}
    shared: list[str] | None = None
    kept: list[MapPoint] = []
    for point in points:
        known.update(dict.fromkeys(point.traces) if len(known) < MOST_LISTED else {})
        shared = list(point.traces) if shared is None else [name for name in shared if name in point.traces]
        if line is None and not shared:
            what = "a 3-D horizon or 3-D faults, on" if any(map(NUMBERED.match, known)) else "picks on"
            raise DataError(f"{path} holds {what} several seismic lines: {_listed(known)}; choose one with ", LINE)
        if line is None or line in point.traces:
            kept.append(point)
        if len(kept) > MOST_POINTS:
            raise DataError(
                f"{path}: {point.location} exceeds the limit of {MOST_POINTS:,} points on a line; export fewer"
            )
    if shared is None:
        raise DataError(f"{path} holds no picks; export it again")
    if not kept:
        raise DataError(f"{path} holds no picks on ", Keyword("line", line), f"; there are {_listed(known)}")
    return shared[0] if line is None else line, kept


def _listed(known: Iterable[str]) -> str:
    known = list(known)
    names = shortened(", ".join(map(repr, known[:MOST_LISTED])))
    return f"{names}, ..." if len(known) >= MOST_LISTED else names


def _grouped(pairs: Iterable[tuple[Key, MapPoint]]) -> dict[Key, list[MapPoint]]:
    groups: dict[Key, list[MapPoint]] = {}
    for key, point in pairs:
        groups.setdefault(key, []).append(point)
    return groups


def _pieces(points: list[MapPoint], seismic_line: str) -> list[list[MapPoint]]:
    """Cut a horizon where it has no pick, where its part changes, and where its trace numbers jump or repeat."""
    traces, defined = np.array([(point.traces[seismic_line], not np.isnan(point.z)) for point in points]).T
    jumps = abs(np.diff(traces))
    step = jumps[jumps > 0].min(initial=np.inf)
    breaks = (jumps > 1.5 * step) | (jumps == 0) if np.isfinite(step) else np.zeros(len(jumps), bool)
    other_part = np.array([one.part != following.part for one, following in pairwise(points)], bool)
    pieces = np.cumsum(np.append(0, breaks | other_part | (np.diff(defined) != 0))).tolist()
    kept = ((piece, point) for piece, point, is_pick in zip(pieces, points, defined, strict=True) if is_pick)
    return list(_grouped(kept).values())


def _pick_line(
    path: Path, kind: str, name: str, points: list[MapPoint], seismic_line: str, options: ExportOptions
) -> PickLine:
    x = _positions_along(path, points, seismic_line, options).tolist()
    return PickLine(kind, name, tuple(zip(x, (point.z for point in points), strict=True)), points[0].location)


def _positions_along(path: Path, points: list[MapPoint], seismic_line: str, options: ExportOptions) -> np.ndarray:
    """Positions of map points along the section, shape (n,)."""
    x, y, traces = np.array([(point.x, point.y, point.traces[seismic_line]) for point in points]).T
    along = options.along
    if along is None:
        raise DataError(
            f"{path} gives positions on a map; choose with ",
            ALONG,
            " how they lie along the section: 'x', 'y', the line's own map coordinates [(X, Y), ...], or a function of "
            "X, Y and the trace number",
        )
    if not callable(along) and np.isnan(x).any():
        raise DataError(
            f"{path} gives no X and Y, only numbers of lines and traces; give ",
            ALONG,
            " as a function of X, Y and the trace number, such as lambda X, Y, trace: 25.0 * (trace - 300)",
        )
    if isinstance(along, str) and along in ("x", "y"):
        return x if along == "x" else y
    if callable(along):
        return _positions_by_function(along, x, y, traces)
    return _distances_along(path, points, np.column_stack([x, y]), along)


def _positions_by_function(along: MapFunction, x: np.ndarray, y: np.ndarray, traces: np.ndarray) -> np.ndarray:
    result = along(x, y, traces)
    try:
        positions = np.asarray(result, float)
    except (TypeError, ValueError):
        positions = np.array(np.nan)
    if positions.shape != x.shape or not np.isfinite(positions).all():
        raise DataError(
            "the function given as ",
            ALONG,
            f" must return a finite number for each of {len(x)} points, but returned {brief(result)}, of shape "
            f"{positions.shape}",
        )
    return positions


def _distances_along(path: Path, points: list[MapPoint], on_map: np.ndarray, along: object) -> np.ndarray:
    """Distances of map points along a line, from its first point."""
    line = shapely.LineString(line_coordinates(along))
    shapes = shapely.points(on_map)
    beside = shapely.distance(shapes, line)
    if beside.max() > MOST_BESIDE * line.length:
        worst = points[int(np.argmax(beside))]
        raise DataError(
            f"{path}: {worst.location} lies {beside.max():.0f} beside the line given as ",
            ALONG,
            f", which is {line.length:.0f} long; check that both are in the same map coordinates, and choose the line "
            "with ",
            LINE,
        )
    return shapely.line_locate_point(line, shapes)


def line_coordinates(along: object) -> np.ndarray:
    """Map coordinates of a line, shape (m, 2); DataError if they are none."""
    try:
        coordinates = np.array(along, float)
        line = shapely.LineString(coordinates.reshape(len(coordinates), 2))
    except (TypeError, ValueError, shapely.errors.GEOSException):
        line = shapely.LineString()
    if not (line.length > 0 and np.isfinite(line.length)):
        raise DataError(ALONG, " must be 'x', 'y', a function, or a list of two or more points (X, Y) on the map")
    return shapely.get_coordinates(shapely.remove_repeated_points(line))
