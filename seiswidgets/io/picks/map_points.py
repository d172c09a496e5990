"""What exports of other programs have in common: points on a map, of one seismic line or of many."""

from collections import Counter
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path
from reprlib import repr as brief

import numpy as np
import shapely

from seiswidgets.errors import DataError
from seiswidgets.io.document import MOST_POINTS, lines, shortened
from seiswidgets.io.picks.lines import FAULT, HORIZON, PickLine

BESIDE = 0.01  # of the line's length: how far from it a pick may lie
SHOWN = 6  # seismic lines, where a message names those that there are

Along = str | Callable | np.ndarray | list


@dataclass(frozen=True, slots=True)
class Node:
    """A point of an export.

    Attributes
    ----------
    lines : dict
        The seismic lines that it lies on, and its trace number on each.
    name, part : str
        The pick, and its stick or piece where the export says so.
    x, y, z : float
        Place on the map, and depth or time: NaN where the export says that there is no pick.
    place : str
        In the file.
    """

    lines: dict[str, float]
    name: str
    part: str
    x: float
    y: float
    z: float
    place: str


@dataclass(frozen=True)
class ExportOptions:
    """What exports do not say of themselves: which seismic line, and where on the section a place on the map is."""

    line: str | None
    along: Along | None
    x0: float


def rows(text: str) -> Iterator[tuple[str, str]]:
    """Place and content of the rows that are neither blank nor a comment."""
    for count, row in enumerate(lines(text), 1):
        if row.strip() and not row.lstrip().startswith(("#", "!")):
            yield f"row {count}", row


def fault_lines(path: Path, nodes: Iterable[Node], choices: ExportOptions) -> tuple[PickLine, ...]:
    """A fault a stick, called as it is, with its stick's number where its fault has several on the line.

    Points without a depth are left out.
    """
    seismic, nodes = _on_one_line(path, nodes, choices.line)
    sticks = _grouped((node for node in nodes if not np.isnan(node.z)), lambda node: (node.name, node.part))
    several = Counter(name for name, _ in sticks)
    return tuple(
        _line(path, FAULT, f"{name} {part}" if several[name] > 1 else name, stick, seismic, choices)
        for (name, part), stick in sticks.items()
    )


def horizon_lines(path: Path, nodes: Iterable[Node], choices: ExportOptions) -> tuple[PickLine, ...]:
    """The pieces of each horizon: one ends where a trace has no pick, or is not the next one."""
    seismic, nodes = _on_one_line(path, nodes, choices.line)
    return tuple(
        _line(path, HORIZON, name, piece, seismic, choices)
        for name, horizon in _grouped(nodes, lambda node: node.name).items()
        for piece in _pieces(horizon, seismic)
    )


def _on_one_line(path, nodes, line):
    """The seismic line that is asked for, or else the only one; and its nodes, the others not kept in memory."""
    known, possible, kept = {}, None, []
    for node in nodes:
        known.update(dict.fromkeys(node.lines) if len(known) < SHOWN else {})
        possible = list(node.lines) if possible is None else [name for name in possible if name in node.lines]
        if line is None and not possible:
            raise DataError(f"{path} holds picks on several seismic lines: {_listed(known)}; choose one by line=")
        if line is None or line in node.lines:
            kept.append(node)
        if len(kept) > MOST_POINTS:
            raise DataError(
                f"{path}: {node.place} is one more than the {MOST_POINTS:,} points that there may be on a line; export "
                "fewer"
            )
    if possible is None:
        raise DataError(f"{path} holds no picks; export it again")
    if not kept:
        raise DataError(f"{path} holds no picks on line={line!r}; there are {_listed(known)}")
    return possible[0] if line is None else line, kept


def _listed(known):
    names = shortened(", ".join(map(repr, list(known)[:SHOWN])))
    return f"{names}, ..." if len(known) >= SHOWN else names


def _grouped(nodes: Iterable[Node], key):
    groups = {}
    for node in nodes:
        groups.setdefault(key(node), []).append(node)
    return groups


def _pieces(nodes, seismic):
    traces, there = np.array([(node.lines[seismic], not np.isnan(node.z)) for node in nodes]).T
    jumps = abs(np.diff(traces))
    step = jumps[jumps > 0].min(initial=np.inf)
    breaks = (jumps > 1.5 * step) | (jumps == 0) if np.isfinite(step) else np.zeros(len(jumps), bool)
    other = np.array([one.part != next_one.part for one, next_one in pairwise(nodes)], bool)
    parts = np.cumsum(np.append(0, breaks | other | (np.diff(there) != 0)))
    kept = [(part, node) for part, node, pick in zip(parts, nodes, there, strict=True) if pick]
    return [[node for _, node in piece] for piece in _grouped(kept, lambda pair: pair[0]).values()]


def _line(path, kind, name, nodes, seismic, choices):
    along = _positions(path, nodes, seismic, choices).tolist()
    points = tuple(zip(along, (node.z for node in nodes), strict=True))
    return PickLine(kind, name, points, nodes[0].place)


def _positions(path, nodes, seismic, choices):
    """Where on the section nodes are."""
    x, y, trace = np.array([(node.x, node.y, node.lines[seismic]) for node in nodes]).T
    along = choices.along
    if along is None:
        raise DataError(
            f"{path} gives places on a map; say by along= where they are on the section: 'x', 'y', the line's own "
            "map coordinates [(X, Y), ...], or a function of X, Y and the trace number"
        )
    if isinstance(along, str) and along in ("x", "y"):
        return x if along == "x" else y
    if callable(along):
        return _answer(along, x, y, trace)
    return choices.x0 + _distances(path, nodes, np.column_stack([x, y]), along)


def _answer(along, x, y, trace):
    answer = along(x, y, trace)
    try:
        found = np.asarray(answer, float)
    except (TypeError, ValueError):
        found = np.array(np.nan)
    if found.shape != x.shape or not np.isfinite(found).all():
        raise DataError(
            f"the function given as along= must return a finite number for each of {len(x)} points, but returned "
            f"{brief(answer)}, of shape {found.shape}"
        )
    return found


def _distances(path, nodes, places, along):
    """Distances from the first point of the line on the map, along it."""
    try:
        line = shapely.LineString(np.array(along, float).reshape(len(along), 2))
    except (TypeError, ValueError, shapely.errors.GEOSException):
        line = shapely.LineString()
    if not (line.length > 0 and np.isfinite(line.length)):
        raise DataError("along= must be 'x', 'y', a function, or a list of two points (X, Y) or more, of the map")
    points = shapely.points(places)
    beside = shapely.distance(points, line)
    if beside.max() > BESIDE * line.length:
        worst = nodes[int(np.argmax(beside))]
        raise DataError(
            f"{path}: {worst.place} lies {beside.max():.0f} beside the line given as along=, which is "
            f"{line.length:.0f} long; check that both are in the same map coordinates, and choose the line by line="
        )
    return shapely.line_locate_point(line, points)
