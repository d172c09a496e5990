"""The smooth curves along which faults are cut, and the lines of a mesh along them."""

from collections.abc import Iterable, Mapping
from itertools import takewhile

import numpy as np
import shapely
from shapely import LineString, Point
from shapely.geometry.base import BaseGeometry
from shapely.ops import substring

from seiswidgets.core.curves import CORNER, along_curve, smooth_curve
from seiswidgets.geology.domain import RestorationDomain
from seiswidgets.geology.fault_lines import CLOSE, EDGES, Position, along_border
from seiswidgets.geology.shared_stretches import shared_stretches

MET = 5e-4  # of the mesh spacing: a corner so close to a fault becomes one with it in a mesh
FINE = 3e-4  # of a sample: largest distance of a curve's points from the curve


def fault_curve(points: np.ndarray, sample: float) -> LineString:
    """The smooth curve through the points of a fault, in metres of rock; see `smooth_curve`."""
    new = np.append(True, (points[1:] != points[:-1]).any(axis=1))
    return LineString(smooth_curve(points[new], FINE * sample))


def meshed_parts(
    name: str, curves: Mapping[str, LineString], cutoffs: Iterable[Position], domain: RestorationDomain
) -> list[LineString]:
    """Divide a fault into edges short enough to slip along, with cut-offs, crossings and corners among their ends.

    A corner much closer than the mesh spacing to one of the others would make slivers, which hold a whole block. The
    stretches that the fault shares with earlier ones, and scarps at its ends, are left out.
    """
    curve, step = curves[name], min(domain.spacing, curves[name].length / EDGES)
    parts = []
    own = [inner for part in _own_parts(name, curves, domain.sample) for inner in _below_scarps(part, domain)]
    for part in own:
        touch = 1e-6 * curve.length
        points = [Point(point) for point in (*cutoffs, *fault_crossings(name, curves))]
        meetings = [part.project(point) for point in points if part.distance(point) <= touch]
        taken = np.array([0.0, *meetings, part.length])
        corners = [at for at in _corners(part) if np.abs(taken - at).min() > CLOSE * domain.spacing]
        parts.append(along_curve(part, [*meetings, *corners], step))
    return parts


def _below_scarps(part: LineString, domain: RestorationDomain) -> list[LineString]:
    """A part of a fault without scarps at its ends, which are the border already, as far as a corner at their foot."""
    scarps = along_border(part, domain)
    if not scarps:
        return [part]
    corners = shapely.points(_turning_points(domain.outline))
    start, stop = 0.0, part.length
    for scarp in scarps:
        ends = sorted(part.project(Point(scarp.coords[which])) for which in (0, -1))
        is_first, is_last = ends[0] <= domain.sample, ends[1] >= part.length - domain.sample
        foot = ends[1] if is_first else ends[0]
        near = corners[shapely.dwithin(corners, part.interpolate(foot), 2 * domain.sample)]
        at = [part.project(corner) for corner in near if part.distance(corner) <= MET * domain.spacing]
        if is_first == is_last or not at:
            continue
        foot = min(at, key=lambda arc_length: abs(arc_length - foot))
        start, stop = (foot, stop) if is_first else (start, foot)
    return [substring(part, start, stop)] if stop - start > domain.sample else []


def _turning_points(outline: BaseGeometry) -> np.ndarray:
    """The vertices at which an outline turns by more than a corner's angle, shape (n, 2)."""
    found = []
    for part in shapely.get_parts(outline):
        for ring in (part.exterior, *part.interiors):
            points = shapely.get_coordinates(ring)[:-1]
            arms = [points - np.roll(points, 1, axis=0), np.roll(points, -1, axis=0) - points]
            cross = arms[0][:, 0] * arms[1][:, 1] - arms[0][:, 1] * arms[1][:, 0]
            turn = np.abs(np.arctan2(cross, np.sum(arms[0] * arms[1], axis=1)))
            found.append(points[turn > CORNER])
    return np.concatenate(found)


def _own_parts(name: str, curves: Mapping[str, LineString], sample: float) -> list[LineString]:
    """The stretches of a fault that it does not share with earlier ones."""
    curve = curves[name]
    earlier = takewhile(lambda other: other != name, curves)
    stretches = sorted(stretch for other in earlier for stretch in shared_stretches(curve, curves[other], sample))
    starts, stops = [0.0, *(stop for _, stop in stretches)], [*(start for start, _ in stretches), curve.length]
    return [
        substring(curve, start, stop)
        for start, stop in zip(starts, stops, strict=True)
        if stop - start > 1e-6 * curve.length
    ]


def _corners(curve: LineString) -> np.ndarray:
    """Arc lengths at which a curve has corners."""
    arms = np.diff(shapely.get_coordinates(curve), axis=0)
    turns = np.diff(np.unwrap(np.arctan2(arms[:, 1], arms[:, 0])))
    return np.cumsum(np.hypot(*arms.T))[:-1][np.abs(turns) > CORNER]


def fault_crossings(name: str, lines: Mapping[str, LineString]) -> list[Position]:
    """The points where other faults cross one, or end at it."""
    line = lines[name]
    others = [other for key, other in lines.items() if key != name]
    crossings = [part for other in others for part in shapely.get_parts(line.intersection(other))]
    ends = [Point(end) for other in others for end in (other.coords[0], other.coords[-1])]
    touching = [end for end in ends if line.distance(end) <= 1e-9 * line.length]
    return [(point.x, point.y) for part in (*crossings, *touching) for point in _ends_of(part)]


def _ends_of(part: BaseGeometry) -> list[Point]:
    """A point itself, or both ends of a shared stretch."""
    if part.is_empty or part.geom_type == "Point":
        return [part] if not part.is_empty else []
    return [Point(part.coords[0]), Point(part.coords[-1])]
