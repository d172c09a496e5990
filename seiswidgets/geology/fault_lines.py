"""Faults as lines that a mesh can be cut along: tidied, joined to what they reach, and checked against each other."""

from collections.abc import Mapping, Sequence

import numpy as np
import shapely
from shapely import LineString, Point
from shapely.geometry.base import BaseGeometry
from shapely.ops import substring

from seiswidgets.core.linework import longest_first
from seiswidgets.errors import PickError
from seiswidgets.geology.domain import ON_BORDER, RestorationDomain
from seiswidgets.geology.picks import AUTO, EXTEND, TIP, Ends
from seiswidgets.geology.shared_stretches import follow, shared_stretches

MERGED = 0.01  # of the mesh spacing: points closer than this become one
CLOSE = 0.05  # of the mesh spacing: a corner or a tip so close to a cut-off or a crossing gives way to it
FINE = 0.4  # of the mesh spacing: points closer than this, where the fault bends, are averaged
TOUCHING = 1e-9  # of the mesh spacing: rounding
EDGES = 8  # at least, along each fault
NEAR = 3.0  # traces and samples: a fault that ends so close to the border or to another fault meets it
AHEAD = 3.0  # times that, straight ahead
SHARPEST = np.radians(10)  # between two stretches of a fault: less makes slivers of rock

Position = tuple[float, float]
NO_ENDS: Mapping[str, Ends] = {}


def merge_close_points(points: np.ndarray, spacing: float) -> np.ndarray:
    """Remove the points of a polyline that lie within a hundredth of the spacing of the one before."""
    kept = [points[0]]
    for point in points[1:]:
        if np.hypot(*(point - kept[-1])) > MERGED * spacing:
            kept.append(point)
    if len(kept) > 1:
        kept[-1] = points[-1]
    return np.array(kept)


def resample_fine(points: np.ndarray, domain: RestorationDomain) -> np.ndarray:
    """Replace points of a drawn fault that lie closer together than a mesh can follow, if any do, by fewer.

    Points within the domain's tolerance of a straight line are left out. Where the others still lie too close together,
    each group of them is replaced by its mean, which also smooths the jitter of a hand. The ends stay.
    """
    merged = merge_close_points(points, domain.spacing)
    lengths = np.hypot(*np.diff(merged, axis=0).T)
    step = FINE * min(domain.spacing, lengths.sum() / EDGES)
    if np.min(lengths, initial=np.inf) >= step:
        return points
    points = shapely.get_coordinates(LineString(merged).simplify(domain.tolerance))
    groups = [[points[0]]]
    for point in points[1:]:
        if np.hypot(*(point - groups[-1][0])) < step:
            groups[-1].append(point)
        else:
            groups.append([point])
    inner = [np.mean(group, axis=0) for group in groups[1:]]
    while inner and np.hypot(*(points[-1] - inner[-1])) < step:
        inner.pop()
    return np.array([points[0], *inner, points[-1]])


def fault_lines(
    faults: Mapping[str, np.ndarray],
    domain: RestorationDomain,
    ends: Mapping[str, Ends] = NO_ENDS,
    boundaries: Sequence[LineString] = (),
) -> dict[str, LineString]:
    """Faults ready to be cut: without repeated points, and meeting what they nearly meet.

    Their shapes depend neither on the order of the faults nor on the direction in which each was drawn, except on
    stretches that two faults share, which have the shape of the earlier one.

    Parameters
    ----------
    faults : dict of str to array, shape (n, 2)
        In metres of rock.
    domain : RestorationDomain
    ends : dict of str to pair of str, optional
        See `Fault.ends`; "auto" for faults without an entry.
    boundaries : list of LineString, optional
        Other faults, which these may meet.

    Raises
    ------
    PickError
        If a fault is no longer than three traces and samples, turns back on itself, or lies on top of another one.
    """
    drawn = {name: _line(name, points, domain) for name, points in faults.items()}
    lines = _follow_earlier(drawn, domain)
    for name in sorted(lines, key=lambda name: longest_first(lines[name])):
        others = [domain.outline.boundary, *boundaries, *(line for other, line in lines.items() if other != name)]
        lines[name] = _fit_ends(lines[name], others, ends.get(name, (AUTO, AUTO)), domain)
    return lines


def _line(name: str, points: np.ndarray, domain: RestorationDomain) -> LineString:
    points = merge_close_points(points, domain.spacing)
    if domain.is_short(points):
        raise PickError(
            f"fault {name!r} near {domain.where(points[0])} is no longer than three traces and samples, too short to "
            "restore; draw more of it, or leave it out",
            pick=name,
            where=domain.position(points[0]),
        )
    _check_onward(name, points, domain)
    return LineString(points)


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
            own = line.length - sum(stop - start for start, stop in shared)
            if own < min(domain.spacing, line.length / 2):
                point = line.interpolate(0.5, normalized=True).coords[0]
                raise PickError(
                    f"faults {other!r} and {name!r} lie on top of each other near {domain.where(point)}, for "
                    f"{domain.length(line.length)}; keep one, or move them apart",
                    pick=name,
                    where=domain.position(point),
                )
        lines[name] = follow(line, lines.values(), domain.sample)
    return lines


def _fit_ends(
    line: LineString, others: Sequence[BaseGeometry], ends: Sequence[str], domain: RestorationDomain
) -> LineString:
    """Extend the ends of a fault to a line that they nearly meet, or cut them back to it."""
    start, stop = 0.0, line.length
    scarps = along_border(line, domain)
    for arc_length in (line.project(point) for other in others for point in _common_points(line, other)):
        if shapely.dwithin(scarps, line.interpolate(arc_length), domain.sample).any():
            continue
        if ends[0] == AUTO and 0 < arc_length <= line.length / 2 and _is_near(substring(line, 0, arc_length), domain):
            start = max(start, arc_length)
        before_end = substring(line, arc_length, line.length)
        if ends[1] == AUTO and line.length / 2 < arc_length < line.length and _is_near(before_end, domain):
            stop = min(stop, arc_length)
    points = shapely.get_coordinates(substring(line, start, stop))
    if start == 0 and ends[0] != TIP:
        points = _extend_end(points[::-1], others, ends[0], domain)[::-1]
    if stop == line.length and ends[1] != TIP:
        points = _extend_end(points, others, ends[1], domain)
    return LineString(points)


def along_border(line: LineString, domain: RestorationDomain) -> list[LineString]:
    """The stretches of a fault that are the border of the rock, as the scarps that stripping leaves."""
    near = line.intersection(domain.outline.boundary.buffer(ON_BORDER * domain.sample))
    return [part for part in shapely.get_parts(near) if part.length > 2 * domain.sample]


def _is_near(stub: LineString, domain: RestorationDomain) -> bool:
    """True for a stretch of a fault that ends within three traces and samples of its start."""
    return bool(np.hypot(*(np.diff(stub.coords, axis=0).sum(axis=0) / domain.cell)) <= NEAR)


def _extend_end(
    points: np.ndarray, others: Sequence[BaseGeometry], choice: str, domain: RestorationDomain
) -> np.ndarray:
    """Draw the last point on to what it nearly meets: straight ahead if that is not far, else by the shortest way."""
    tip = points[-1]
    nearest = [np.array(other.interpolate(other.project(Point(tip))).coords[0]) for other in others]
    if any(np.hypot(*(point - tip)) <= TOUCHING * domain.spacing for point in nearest):
        return points
    near = [point for point in nearest if np.hypot(*((point - tip) / domain.cell)) <= NEAR]
    if choice == AUTO and not near:
        return points
    ahead = _heading(points, NEAR * float(np.max(domain.cell)))
    low, high = np.reshape(domain.outline.bounds, (2, 2))
    reach = np.hypot(*(high - low)) if choice == EXTEND else AHEAD * NEAR / np.hypot(*(ahead / domain.cell))
    met = shapely.intersection(LineString([tip, tip + reach * ahead]), others)
    hits = list(shapely.get_coordinates(shapely.shortest_line(met[~shapely.is_empty(met)], Point(tip)))[::2])
    if not hits and not near:
        return points
    target = min(hits or near, key=lambda point: float(np.hypot(*(point - tip))))
    kept = points[:-1] if LineString([points[-2], target]).distance(Point(tip)) < TOUCHING * domain.spacing else points
    return np.append(kept, [target], axis=0)


def _heading(points: np.ndarray, back: float) -> np.ndarray:
    """The unit vector in which a line continues at its end: that of its last segment, or of its last stretch."""
    line = LineString(points)
    before = points[-2]
    if np.hypot(*(points[-1] - before)) < back:
        before = np.array(line.interpolate(max(line.length - back, line.length / 2)).coords[0])
    arm = points[-1] - before
    return np.asarray(arm / np.hypot(*arm))


def _common_points(line: LineString, other: BaseGeometry) -> list[Point]:
    return [part.centroid for part in shapely.get_parts(line.intersection(other)) if not part.is_empty]


def settle_tips(
    lines: Mapping[str, LineString],
    beds: Sequence[LineString],
    cutoffs: Mapping[str, Sequence[Position]],
    domain: RestorationDomain,
) -> dict[str, LineString]:
    """Move the ends of faults onto what nearly coincides with them.

    An end at another fault moves to a cut-off beside it, and an end inside the rock onto a horizon that passes it.

    Parameters
    ----------
    lines : dict of str to LineString
    beds : list of LineString
    cutoffs : dict of str to list of (x, z)
        Points where horizons end at each fault.
    domain : RestorationDomain
    """
    settled = {}
    for name, line in lines.items():
        points = shapely.get_coordinates(line)
        for which in (0, -1):
            tip = Point(points[which])
            met = [other for other in lines if other != name and _touches(lines[other], tip.coords[0])]
            if domain.outline.boundary.distance(tip) > TOUCHING * domain.spacing:
                near = [Point(cutoff) for other in met for cutoff in cutoffs[other]] if met else beds
                target = min(near, key=tip.distance, default=tip)
                if 0 < tip.distance(target) <= CLOSE * domain.spacing:
                    end = target.interpolate(target.project(tip)).coords[0] if not met else target.coords[0]
                    kept = points[np.hypot(*(points - end).T) > CLOSE * domain.spacing]
                    points = np.insert(kept, 0 if which == 0 else len(kept), end, axis=0)
        settled[name] = LineString(points)
    return settled


def _touches(line: LineString, point: Position) -> bool:
    return bool(line.distance(Point(point)) <= 1e-9 * line.length)
