"""Faults as lines that a mesh can be cut along: tidied, joined to what they reach, and checked against each other."""

from collections.abc import Iterable, Mapping, Sequence

import numpy as np
import shapely
from shapely import LineString, Point
from shapely.geometry.base import BaseGeometry
from shapely.ops import substring

from seiswidgets.errors import Keyword, PickError
from seiswidgets.geology.domain import RestorationDomain
from seiswidgets.geology.shared_stretches import follow, shared_stretches

MERGED = 0.01  # of the mesh spacing: points closer than this become one
REACH = 0.25  # of the mesh spacing: a fault that ends so close to the border or to another fault meets it
CLOSE = 0.05  # of the mesh spacing: a drawn point so close to a cut-off, a crossing or a tip gives way to it
EDGES = 8  # at least, along each fault
SHARPEST = np.radians(10)  # between two stretches of a fault: less makes slivers of rock

Position = tuple[float, float]


def merge_close_points(points: np.ndarray, spacing: float) -> np.ndarray:
    """Remove the points of a polyline that lie within a hundredth of the spacing of the one before."""
    kept = [points[0]]
    for point in points[1:]:
        if np.hypot(*(point - kept[-1])) > MERGED * spacing:
            kept.append(point)
    if len(kept) > 1:
        kept[-1] = points[-1]
    return np.array(kept)


def fault_lines(faults: Mapping[str, np.ndarray], domain: RestorationDomain) -> dict[str, LineString]:
    """Faults ready to be cut: without repeated points, and meeting what they nearly meet.

    Parameters
    ----------
    faults : dict of str to array, shape (n, 2)
        In metres of rock.
    domain : RestorationDomain

    Raises
    ------
    PickError
        If a fault is no longer than the spacing or turns back on itself, or lies on top of another one as a whole.
    """
    lines = _follow_earlier({name: _line(name, points, domain) for name, points in faults.items()}, domain)
    extended: dict[str, LineString] = {}
    for name, line in lines.items():
        others = [extended.get(other, lines[other]) for other in lines if other != name]
        extended[name] = _fit_ends(line, [domain.outline.boundary, *others], REACH * domain.spacing)
    return extended


def _line(name: str, points: np.ndarray, domain: RestorationDomain) -> LineString:
    points = merge_close_points(points, domain.spacing)
    length = np.hypot(*np.diff(points, axis=0).T).sum() if len(points) > 1 else 0.0
    if length <= domain.spacing:
        raise PickError(
            f"fault {name!r} near {domain.where(points[0])} is {length:.4g} m long, no longer than the mesh spacing of "
            f"{domain.spacing:.4g} m; reduce ",
            Keyword("spacing"),
            ", or leave the fault out",
            pick=name,
            where=domain.position(points[0]),
        )
    _check_onward(name, points, domain)
    return domain.simplify(LineString(points)) if domain.quick else LineString(points)


def _check_onward(name: str, points: np.ndarray, domain: RestorationDomain) -> None:
    steps = np.diff(points, axis=0)
    directions = steps / np.hypot(*steps.T)[:, None]
    back = np.sum(directions[1:] * directions[:-1], axis=1) < -np.cos(SHARPEST)
    if back.any():
        point = points[1 + np.argmax(back)]
        raise PickError(
            f"fault {name!r} turns back on itself near {domain.where(point)}; leave that point out",
            pick=name,
            where=domain.position(point),
        )


def _follow_earlier(drawn: Mapping[str, LineString], domain: RestorationDomain) -> dict[str, LineString]:
    """Make faults coincide exactly on the stretches that they share; PickError if one has no stretch of its own."""
    lines: dict[str, LineString] = {}
    for name, line in drawn.items():
        for other, earlier in lines.items():
            shared = shared_stretches(line, earlier, domain.sample)
            if sum(stop - start for start, stop in shared) > line.length - domain.spacing:
                point = line.interpolate(0.5, normalized=True).coords[0]
                raise PickError(
                    f"faults {other!r} and {name!r} lie on top of each other near {domain.where(point)}, for "
                    f"{line.length:.4g} m; keep one, or move them apart",
                    pick=name,
                    where=domain.position(point),
                )
        lines[name] = follow(line, lines.values(), domain.sample)
    return lines


def _fit_ends(line: LineString, others: Sequence[BaseGeometry], reach: float) -> LineString:
    """Extend the ends of a fault to a line that they nearly meet, or cut them back to it."""
    start, stop = 0.0, line.length
    for crossing in (point for other in others for point in _common_points(line, other)):
        arc_length = line.project(crossing)
        if 0 < arc_length < reach:
            start = max(start, arc_length)
        elif 0 < line.length - arc_length < reach:
            stop = min(stop, arc_length)
    points = shapely.get_coordinates(substring(line, start, stop))
    for which, cut in ((0, start > 0), (-1, stop < line.length)):
        near = [other.interpolate(other.project(Point(points[which]))) for other in others]
        distance, target = min((Point(points[which]).distance(point), point.coords[0]) for point in near)
        if not cut and 0 < distance < reach:
            points = np.insert(points, 0 if which == 0 else len(points), target, axis=0)
    return LineString(points)


def _common_points(line: LineString, other: BaseGeometry) -> list[Point]:
    return [part.centroid for part in shapely.get_parts(line.intersection(other)) if not part.is_empty]


def route_through(
    line: LineString, cutoffs: Iterable[Position], crossings: Iterable[Position], reach: float
) -> LineString:
    """Make a fault pass through its cut-offs and crossings instead of through drawn points close to them.

    Two points of a fault that lie much closer than the mesh spacing make slivers, which hold a whole block.

    Parameters
    ----------
    line : LineString
    cutoffs, crossings : lists of points on it
        Crossings are where other faults cross it, or end.
    reach : float
        Distance within which a drawn point is replaced.
    """
    points = shapely.get_coordinates(line)
    targets = np.array([points[0], points[-1], *cutoffs, *crossings], float).reshape(-1, 2)
    distances = np.hypot(*np.moveaxis(points[:, None] - targets, -1, 0))
    close = distances.min(axis=1) < reach
    close[[0, -1]] = False
    if not close.any():
        return line
    points[close] = targets[distances[close].argmin(axis=1)]
    new = np.append(True, (points[1:] != points[:-1]).any(axis=1))
    return insert_points(LineString(points[new]), crossings)


def fault_crossings(name: str, lines: Mapping[str, LineString]) -> list[Position]:
    """The points where other faults cross one, or end at it."""
    line = lines[name]
    others = [other for key, other in lines.items() if key != name]
    crossings = [point.coords[0] for other in others for point in _common_points(line, other)]
    return crossings + [end for other in others for end in (other.coords[0], other.coords[-1]) if _touches(line, end)]


def _touches(line: LineString, point: Position) -> bool:
    return bool(line.distance(Point(point)) <= 1e-9 * line.length)


def insert_points(line: LineString, points: Iterable[Position]) -> LineString:
    """Insert points that lie on a line among its own, in order."""
    vertices = shapely.get_coordinates(line)
    arc_lengths = [line.project(Point(vertex)) for vertex in vertices]
    for point in points:
        arc_length = line.project(Point(point))
        nearest = int(np.argmin(np.abs(np.array(arc_lengths) - arc_length)))
        if abs(arc_lengths[nearest] - arc_length) > 1e-9 * line.length:
            index = int(np.searchsorted(arc_lengths, arc_length))
            vertices = np.insert(vertices, index, point, axis=0)
            arc_lengths.insert(index, arc_length)
    return LineString(vertices)
