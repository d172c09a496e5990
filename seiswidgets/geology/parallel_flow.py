"""Closed-form deformation along bent lines: thrust sheets that climb ramps, and parallel folds whose beds keep lengths.

Both follow the parallels of a bent line, which bend on the bisectors of its bends (Suppe, Geometry and kinematics of
fault-bend folding, 1983). Points are rows (x, z) in metres.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np
import shapely
from numpy.typing import ArrayLike

from seiswidgets.errors import SettingError
from seiswidgets.geology.kinematics import Survey, check_range


@dataclass(frozen=True, eq=False)
class ParallelLines:
    """Coordinates along and across a bent line, both of them lengths; the map between them and (x, z) keeps areas.

    Parameters
    ----------
    points : array, shape (n, 2), n >= 3
        The line from left to right; its first and last segments continue beyond its ends.
    origin : int
        Index of the bend at which, on every parallel, the length along it is zero.
    """

    points: np.ndarray
    origin: int = 1

    @cached_property
    def _arms(self) -> tuple[np.ndarray, np.ndarray]:
        """Lengths and unit directions of the segments."""
        arms = np.diff(self.points, axis=0)
        lengths = np.hypot(*arms.T)
        return lengths, arms / lengths[:, None]

    @cached_property
    def _mitres(self) -> np.ndarray:
        """Shift of each bend from one parallel to the next, one metre across; shape (n - 2, 2)."""
        normals = self._arms[1][:, ::-1] * (1, -1)
        both = normals[:-1] + normals[1:]
        return np.asarray(2 * both / np.sum(both**2, axis=1)[:, None])

    @cached_property
    def _starts(self) -> np.ndarray:
        """Length along the line at each bend, and its growth from one parallel to the next; shape (2, n - 2)."""
        lengths, directions = self._arms
        growth = np.sum(np.diff(self._mitres, axis=0) * directions[1:-1], axis=1)
        starts = np.cumsum(np.insert(np.stack([lengths[1:-1], growth]), 0, 0, axis=1), axis=1)
        return np.asarray(starts - starts[:, [self.origin - 1]])

    def past_bend(self, points: np.ndarray, bend: np.ndarray | int) -> np.ndarray:
        """Positive for points to the right of a bend's bisector, a linear function of the points; shape (n,)."""
        directions = self._arms[1]
        return np.sum((points - self.points[bend]) * (directions[bend] + directions[np.asarray(bend) - 1]), axis=1)

    def local(self, points: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Lengths of points along (to the right) and across (upwards) the line; each of shape (n,)."""
        segment = self._segments(len(points), lambda bend: self.past_bend(points, bend) > 0)
        nearest = np.maximum(segment, 1)  # bend at the start of the segment, or the first one
        directions, offset = self._arms[1][segment], points - self.points[nearest]
        across = offset[:, 0] * directions[:, 1] - offset[:, 1] * directions[:, 0]
        ahead = np.sum((offset - across[:, None] * self._mitres[nearest - 1]) * directions, axis=1)
        return self._along(nearest, across) + ahead, across

    def at(self, along: np.ndarray, across: np.ndarray) -> np.ndarray:
        """Points from their lengths along and across the line, shape (n, 2)."""
        segment = self._segments(len(along), lambda bend: along > self._along(bend, across))
        nearest = np.maximum(segment, 1)
        ahead = along - self._along(nearest, across)
        start = self.points[nearest] + across[:, None] * self._mitres[nearest - 1]
        return np.asarray(start + ahead[:, None] * self._arms[1][segment])

    def _along(self, bend: np.ndarray, across: np.ndarray) -> np.ndarray:
        """Length along a point's parallel at which that has a bend."""
        start, growth = self._starts[:, bend - 1]
        return np.asarray(start + growth * across)

    def _segments(self, count: int, is_past: Callable[[np.ndarray], np.ndarray]) -> np.ndarray:
        """The segment that each point lies at, by bisection: the number of bends that it is past."""
        low, high = np.zeros(count, int), np.full(count, len(self.points) - 2)
        while (low < high).any():
            bend = np.minimum((low + high) // 2 + 1, len(self.points) - 2)
            past = is_past(bend) & (low < high)
            low, high = np.where(past, bend, low), np.where(past, high, np.minimum(high, bend - 1))
        return low


@dataclass(frozen=True, eq=False)
class FlexuralSlip:
    """A parallel fold: level beds slip past each other and keep their thicknesses and lengths.

    The bed at a depth becomes the reference line, on which ``line.origin`` was at ``x``.
    """

    line: ParallelLines
    x: float
    depth: float

    def apply(self, points: np.ndarray) -> np.ndarray:
        return self.line.at(points[:, 0] - self.x, self.depth - points[:, 1])

    def undo(self, points: np.ndarray) -> np.ndarray:
        along, across = self.line.local(points)
        return np.column_stack([along + self.x, self.depth - across])


def rounded_fold(dip: float, radius: float, limb: float, crest: tuple[float, float]) -> ParallelLines:
    """An upright anticline between flats: limbs of a dip (degrees), joined by arcs of a radius (m) in steps of 2°."""
    steps = max(1, round(dip / 2))
    rise = dip * np.arange(1, steps) / steps
    angles = np.deg2rad(np.concatenate([[0], rise, [dip], rise[::-1], [0]]))
    lengths = np.full(len(angles), radius * np.deg2rad(dip) / steps)
    lengths[[steps, -1]] = limb, lengths[0] / 2
    left = np.cumsum(lengths[:, None] * np.column_stack([np.cos(angles), -np.sin(angles)]), axis=0)
    left = np.vstack([(0, 0), left]) - left[-1]
    line = np.vstack([left, left[-2::-1] * (-1, 1)]) + crest
    return ParallelLines(line, len(left) - 1)


@dataclass(frozen=True, eq=False)
class Thrust:
    """A thrust along a bent line; its hanging wall, above, flows parallel to it to the left by ``slip`` (m)."""

    line: ParallelLines
    slip: float

    def side(self, points: np.ndarray) -> np.ndarray:
        """Distance into the hanging wall; shape (n,)."""
        return self.line.local(points)[1]

    def apply(self, points: np.ndarray) -> np.ndarray:
        return self._flow(points, -self.slip)

    def undo(self, points: np.ndarray) -> np.ndarray:
        return self._flow(points, self.slip)

    def _flow(self, points: np.ndarray, distance: float) -> np.ndarray:
        along, across = self.line.local(points)
        return self.line.at(along + distance, across)

    def carried(self, line: np.ndarray) -> np.ndarray:
        """A line of the hanging wall after the slip, exact where the thrust has one bend."""
        line = _with_sign_changes(line, lambda points: self.line.past_bend(points, 1))
        line = _with_sign_changes(line, lambda points: self.line.local(points)[0] - self.slip)
        return self.apply(line)


def _with_sign_changes(line: np.ndarray, function: Callable[[np.ndarray], np.ndarray]) -> np.ndarray:
    """Insert points where a function that is linear on each segment changes its sign."""
    values = function(line)
    before = np.flatnonzero(values[:-1] * values[1:] < 0)
    share = values[before] / (values[before] - values[before + 1])
    points = line[before] + share[:, None] * (line[before + 1] - line[before])
    return np.insert(line, before + 1, points, axis=0)


@dataclass(frozen=True, eq=False)
class ThrustSequence:
    """Slip along thrusts from left to right, of which the rightmost slipped first and was then carried by the others.

    All hanging walls lie one above the other, so block 0, below the leftmost thrust, has not moved.
    """

    faults: tuple[Thrust, ...]
    blind = False

    def side(self, points: np.ndarray) -> np.ndarray:
        """Number of thrusts below each point, shape (n,)."""
        return self._undone(points)[0]

    def block(self, points: ArrayLike) -> np.ndarray:
        """The fault block that each point lies in, from 0 at the left."""
        return self.side(np.asarray(points, float))

    def to_unfaulted(self, points: ArrayLike) -> np.ndarray:
        """Return points of the present-day section to before the thrusts slipped; shape (n, 2)."""
        return self._undone(np.array(points, float))[1]

    def to_restored(self, points: ArrayLike) -> np.ndarray:
        """Return points of the present-day section to where they were deposited; shape (n, 2)."""
        return self.to_unfaulted(points)

    def _undone(self, points: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        moved, side = points.copy(), np.zeros(len(points), int)
        for number, fault in enumerate(self.faults):
            above = (side == number) & (fault.side(moved) > 0)
            moved[above] = fault.undo(moved[above])
            side += above
        return side, moved

    def blocks_at(self, depth: float) -> list[int]:
        """The blocks in which the bed deposited at a depth lies."""
        heights = [fault.line.points[:, 1] for fault in self.faults]
        if depth > max(height.max() for height in heights):
            return [0]
        return [*([0] if depth >= heights[0].min() else []), *range(1, len(self.faults) + 1)]

    def bed(self, depth: float, side: int) -> Callable[[np.ndarray], np.ndarray]:
        """Present-day points of the bed deposited at a depth, as a function of the deposited x; valid on one side."""

        def points(x: np.ndarray) -> np.ndarray:
            moved = np.column_stack([x, np.full(np.shape(x), depth)])
            for fault in self.faults[:side][::-1]:
                moved = fault.apply(moved)
            return moved

        return points

    def margin(self, points: np.ndarray, side: int, survey: Survey) -> np.ndarray:
        """Distance into a block, to the nearest fault or border; negative outside."""
        margins, moved = [survey.margin(points)], points
        for number, fault in enumerate(self.faults[: side + 1]):
            if number >= side - 1:
                margins.append(fault.side(moved) if number < side else -fault.side(moved))
            moved = fault.undo(moved)
        return np.asarray(np.min(margins, axis=0))

    def lines(self, survey: Survey) -> list[np.ndarray]:
        """Present-day points of each thrust from left to right, inside the section."""
        lines = []
        for number, fault in enumerate(self.faults):
            line = fault.line.points if number == 0 else fault.line.points[:-1]  # to the floor it shares
            for younger in self.faults[:number][::-1]:
                line = younger.carried(line)
            inside = shapely.LineString(line).intersection(shapely.box(0, 0, survey.width, survey.depth))
            if inside.geom_type != "LineString" or inside.length < min(survey.width, survey.depth) / 10:
                raise SettingError(
                    f"fault F{number + 1} must cross the section, which is {survey.width:g} m x {survey.depth:g} m; "
                    "make the section larger, or the ramps steeper",
                    pick=f"F{number + 1}",
                )
            lines.append(shapely.get_coordinates(inside))
        return lines


def ramp_thrust(points: ArrayLike, slip: float) -> Thrust:
    """A thrust through points from left to right."""
    return Thrust(ParallelLines(np.array(points, float)), slip)


def check_fold_fits(dip: float, radius: float, limb: float, depth: float) -> float:
    """The height of a `rounded_fold` that is centred in a section of a depth (m).

    Raises
    ------
    SettingError
        If parallels would meet inside the section.
    """
    angle = np.deg2rad(dip)
    height = float(2 * radius * (1 - np.cos(angle)) + limb * np.sin(angle))
    least = float((depth + limb * np.sin(angle)) / 2 / np.cos(angle))
    check_range("radius", radius, 1.02 * least, 1e5, f" m with limbs of {dip:g} degrees in a section {depth:g} m deep")
    return height
