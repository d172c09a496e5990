"""Faults as lines that a mesh can be cut along: tidied, joined to what they reach, and checked against each other."""

import numpy as np
import shapely
from shapely import LineString, Point
from shapely.ops import substring

from seiswidgets.errors import PickError
from seiswidgets.geology.domain import RestorationDomain

MERGED = 0.01  # of the mesh spacing: points closer than this become one
REACH = 0.25  # of the mesh spacing: a fault that ends so close to the border or to another fault meets it
CLOSE = 0.05  # of the mesh spacing: a drawn point so close to a cut-off, a crossing or a tip gives way to it
EDGES = 8  # at least, along each fault
SHARPEST = np.radians(10)  # between two stretches of a fault: less makes slivers of rock


def merged(points, spacing) -> np.ndarray:
    """A polyline without the points that follow closer than a hundredth of the spacing on the one before."""
    kept = [points[0]]
    for point in points[1:]:
        if np.hypot(*(point - kept[-1])) > MERGED * spacing:
            kept.append(point)
    if len(kept) > 1:
        kept[-1] = points[-1]
    return np.array(kept)


def fault_lines(faults: dict, domain: RestorationDomain) -> dict:
    """Faults as they are to be cut: without repeated points, meeting what they nearly meet.

    Parameters
    ----------
    faults : dict of str to array, shape (n, 2)
        In metres of rock.
    domain : RestorationDomain

    Raises
    ------
    PickError
        If a fault is no longer than the spacing or turns back on itself, or two lie on top of each other.
    """
    lines = {name: _line(name, points, domain) for name, points in faults.items()}
    _check_apart(lines, domain)
    met = {}
    for name, line in lines.items():
        others = [met.get(other, lines[other]) for other in lines if other != name]
        met[name] = _meeting(line, [domain.outline.boundary, *others], REACH * domain.spacing)
    return met


def _line(name, points, domain):
    points = merged(points, domain.spacing)
    length = np.hypot(*np.diff(points, axis=0).T).sum() if len(points) > 1 else 0.0
    if length <= domain.spacing:
        raise PickError(
            f"fault {name!r} near {domain.where(points[0])} is {length:.4g} m long, no longer than the mesh spacing of "
            f"{domain.spacing:.4g} m; choose a finer spacing, or leave it out"
        )
    _check_onward(name, points, domain)
    return domain.simplified(LineString(points)) if domain.quick else LineString(points)


def _check_onward(name, points, domain):
    steps = np.diff(points, axis=0)
    directions = steps / np.hypot(*steps.T)[:, None]
    back = np.sum(directions[1:] * directions[:-1], axis=1) < -np.cos(SHARPEST)
    if back.any():
        place = domain.where(points[1 + np.argmax(back)])
        raise PickError(f"fault {name!r} turns back on itself near {place}; leave that point out")


def _check_apart(lines, domain):
    names = list(lines)
    for number, name in enumerate(names):
        for other in names[:number]:
            shared = lines[name].intersection(lines[other].buffer(0.05 * domain.spacing))
            if shared.length > domain.spacing:
                raise PickError(
                    f"faults {other!r} and {name!r} lie on top of each other near "
                    f"{domain.where(shared.centroid.coords[0])}, for {shared.length:.4g} m; keep one, or part them"
                )


def _meeting(line, others, reach):
    """A fault whose ends are drawn on to, or cut back to, a line that they nearly meet."""
    start, stop = 0.0, line.length
    for crossing in (point for other in others for point in _crossings(line, other)):
        way = line.project(crossing)
        if 0 < way < reach:
            start = max(start, way)
        elif 0 < line.length - way < reach:
            stop = min(stop, way)
    points = shapely.get_coordinates(substring(line, start, stop))
    for place, cut in ((0, start > 0), (-1, stop < line.length)):
        near = [other.interpolate(other.project(Point(points[place]))) for other in others]
        distance, target = min((Point(points[place]).distance(point), point.coords[0]) for point in near)
        if not cut and 0 < distance < reach:
            points = np.insert(points, 0 if place == 0 else len(points), target, axis=0)
    return LineString(points)


def _crossings(line, other):
    return [part.centroid for part in shapely.get_parts(line.intersection(other)) if not part.is_empty]


def passing_through(line: LineString, cutoffs, crossings, reach: float) -> LineString:
    """A fault that passes through its cut-offs and crossings instead of through drawn points close to them.

    Two points of a fault that lie much closer than the mesh spacing make slivers, which hold a whole block.

    Parameters
    ----------
    line : LineString
    cutoffs, crossings : lists of points on it
        Crossings are where other faults cross it, or end.
    reach : float
        How close is close.
    """
    points = shapely.get_coordinates(line)
    places = np.array([points[0], points[-1], *cutoffs, *crossings], float).reshape(-1, 2)
    apart = np.hypot(*np.moveaxis(points[:, None] - places, -1, 0))
    close = apart.min(axis=1) < reach
    close[[0, -1]] = False
    if not close.any():
        return line
    points[close] = places[apart[close].argmin(axis=1)]
    new = np.append(True, (points[1:] != points[:-1]).any(axis=1))
    return with_points(LineString(points[new]), crossings)


def crossings(name: str, lines: dict) -> list:
    """The points where other faults cross one, or end at it."""
    line = lines[name]
    others = [other for key, other in lines.items() if key != name]
    met = [point.coords[0] for other in others for point in _crossings(line, other)]
    return met + [end for other in others for end in (other.coords[0], other.coords[-1]) if _touches(line, end)]


def _touches(line, point):
    return line.distance(Point(point)) <= 1e-9 * line.length


def with_points(line: LineString, places) -> LineString:
    """A line with some more places on it among its points, in order."""
    points = shapely.get_coordinates(line)
    ways = [line.project(Point(point)) for point in points]
    for place in places:
        way = line.project(Point(place))
        nearest = int(np.argmin(np.abs(np.array(ways) - way)))
        if abs(ways[nearest] - way) > 1e-9 * line.length:
            number = int(np.searchsorted(ways, way))
            points, ways = np.insert(points, number, place, axis=0), [*ways[:number], way, *ways[number:]]
    return LineString(points)
