"""Horizons as surfaces from one end of the section to the other."""

from collections.abc import Sequence
from itertools import pairwise

import numpy as np
import shapely
from shapely import LineString, Point
from shapely.ops import substring

from seiswidgets.errors import PickError
from seiswidgets.geology.domain import RestorationDomain
from seiswidgets.geology.findings import Finding
from seiswidgets.geology.picks import HORIZON
from seiswidgets.geology.segments import HorizonSegment, horizon_segments

FAR = 3.0  # traces between a horizon's end and the border that are worth a note


def surface_line(
    name: str, pieces: Sequence[LineString], faults: Sequence[LineString], domain: RestorationDomain
) -> tuple[LineString, tuple[Finding, ...]]:
    """One line along a horizon from border to border, and notes about where it was extended.

    The horizon is simplified as for a mesh. Between two pieces that end at one fault it follows the fault to the last
    digit, so that the fault can be found again along it; other gaps are bridged straight. Beyond its ends the horizon
    goes on level.

    Parameters
    ----------
    name : str
    pieces, faults : list of LineString
        In metres of rock.
    domain : RestorationDomain

    Raises
    ------
    PickError
        If nothing is left of the horizon, or its pieces overlap such that the line would cross itself.
    """
    segments = sorted(
        map(_rightwards, horizon_segments(pieces, faults, domain.cell)), key=lambda part: part.line.centroid.x
    )
    if not segments:
        raise PickError(f"nothing is left of {HORIZON} {name!r}; it lies outside the rock", pick=name)
    points = [shapely.get_coordinates(domain.on_border(domain.simplify(segment.line))) for segment in segments]
    joints = [_joint(*pair, faults) for pair in pairwise(segments)]
    inner = np.vstack([part for pair in zip(points, [*joints, np.empty((0, 2))], strict=True) for part in pair])
    x_min, _, x_max, _ = domain.outline.bounds
    reach = x_max - x_min
    ends = [(min(x_min, inner[0, 0]) - reach, inner[0, 1]), (max(x_max, inner[-1, 0]) + reach, inner[-1, 1])]
    line = LineString([ends[0], *inner, ends[1]])
    if not line.is_simple:  # where pieces that were joined overlap by a little
        line = LineString([ends[0], *without_steps_back(inner, FAR * float(domain.cell[0])), ends[1]])
    if not line.is_simple:
        point = _overlap(line, segments)
        raise PickError(
            f"the pieces of {HORIZON} {name!r} do not follow each other from left to right near {domain.where(point)}; "
            "redraw them, or leave out one of two that lie above each other",
            pick=name,
            where=domain.position(point),
        )
    return line, tuple(_extension_notes(name, inner, domain))


def _rightwards(segment: HorizonSegment) -> HorizonSegment:
    """The segment, directed from left to right."""
    points = shapely.get_coordinates(segment.line)
    if points[0, 0] <= points[-1, 0]:
        return segment
    return HorizonSegment(LineString(points[::-1]), segment.ends[::-1], segment.piece, segment.short)


def _joint(left: HorizonSegment, right: HorizonSegment, faults: Sequence[LineString]) -> np.ndarray:
    """The points of a fault between two segments that end at it, shape (n, 2); none if they do not."""
    one, other = left.ends[1], right.ends[0]
    if one is None or other is None or one.fault != other.fault:
        return np.empty((0, 2))
    fault = faults[one.fault]
    part = substring(fault, fault.project(Point(one.point)), fault.project(Point(other.point)))
    return shapely.get_coordinates(part)[1:-1]


def without_steps_back(points: np.ndarray, most: float) -> np.ndarray:
    """Leave out the points of a line that lie behind earlier ones, by no more than a distance."""
    behind = np.maximum.accumulate(points[:, 0]) - points[:, 0]
    return points[(behind == 0) | (behind > most)]


def _overlap(line: LineString, segments: Sequence[HorizonSegment]) -> np.ndarray:
    """A point where segments overlap."""
    for one, other in pairwise(segments):
        if one.line.bounds[2] > other.line.bounds[0]:
            return shapely.get_coordinates(one.line)[-1]
    return shapely.get_coordinates(line)[len(line.coords) // 2]


def _extension_notes(name: str, points: np.ndarray, domain: RestorationDomain) -> list[Finding]:
    x_min, _, x_max, _ = domain.outline.bounds
    notes = []
    for point, border, side in ((points[0], x_min, "left"), (points[-1], x_max, "right")):
        if abs(point[0] - border) > FAR * domain.cell[0]:
            text = (
                f"{HORIZON} {name!r} ends {domain.length(abs(point[0] - border))} from the {side} end of the rock; it "
                f"was continued there, level from {domain.where(point)}. Draw it farther if it is not level"
            )
            notes.append(Finding("note", "extended", text, name, domain.position(point)))
    return notes


def region_below(line: LineString, domain: RestorationDomain) -> shapely.Polygon:
    """The area below a surface, down to beyond the rock."""
    points = shapely.get_coordinates(line)
    bottom = max(domain.outline.bounds[3], points[:, 1].max()) + np.ptp(points[:, 0])
    return shapely.Polygon([*points, (points[-1, 0], bottom), (points[0, 0], bottom)])
