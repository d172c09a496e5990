"""The cut-offs of horizons at faults, two for each pair, and the throw and heave that follow."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import NoReturn

import numpy as np
from shapely import LineString

from seiswidgets.errors import PickError
from seiswidgets.geology.picks import Fault, Horizon
from seiswidgets.geology.segments import EXTENSION, End, HorizonSegment, horizon_segments, nearest_fault_ahead

WALLS = {1: "hanging wall", -1: "footwall"}

Position = tuple[float, float]
SegmentEnd = tuple[int, int]  # index of a segment, and which end of it (0 or -1)


@dataclass(frozen=True)
class CutOffPair:
    """The two cut-offs of a horizon at a fault.

    Attributes
    ----------
    fault, horizon : str
        Their names.
    hanging_wall, footwall : tuple of int
        Index of a segment of the horizon, and which end of it (0 or -1).
    """

    fault: str
    horizon: str
    hanging_wall: SegmentEnd
    footwall: SegmentEnd


def _unchanged(point: Position) -> Position:
    return point


@dataclass(frozen=True, eq=False)
class PickNetwork:
    """Faults, and the segments of horizons that end at them.

    Attributes
    ----------
    faults : dict of str to LineString
        By name.
    horizons : dict of str to list of HorizonSegment
    where : callable(point) -> str
        Text for a position in errors.
    position : callable(point) -> (x, z)
        The position in the section's units, for the ``where`` field of errors.
    unit : str
        Unit of lengths in errors, with a leading space.
    """

    faults: dict[str, LineString]
    horizons: dict[str, list[HorizonSegment]]
    where: Callable[[Position], str]
    position: Callable[[Position], Position] = _unchanged
    unit: str = " m"

    def cutoffs(self) -> list[CutOffPair]:
        """All pairs of cut-offs of the horizons at the faults.

        Raises
        ------
        PickError
            If a horizon meets a fault from one side only, or twice from one side, or if no horizon meets a fault.
        """
        pairs = [pair for fault in self.faults for horizon in self.horizons if (pair := self._pair(fault, horizon))]
        for fault in self.faults:
            if not any(pair.fault == fault for pair in pairs):
                raise PickError(
                    f"no horizon ends at fault {fault!r} on both sides, so its slip is undetermined; "
                    f"{self._nearest(fault)}",
                    pick=fault,
                )
        return pairs

    def ends_at(self, fault: str) -> list[Position]:
        """The points where horizons end at a fault."""
        index = list(self.faults).index(fault)
        ends = (end for segments in self.horizons.values() for segment in segments for end in segment.ends)
        return [end.point for end in ends if end and end.fault == index]

    def _pair(self, fault: str, horizon: str) -> CutOffPair | None:
        sides = {side: self._ends_on_side(fault, horizon, side) for side in WALLS}
        for side, ends in sides.items():
            if len(ends) > 1:
                self._raise_two_on_one_side(fault, horizon, side, ends)
        if sides[1] and sides[-1]:
            return CutOffPair(fault, horizon, sides[1][0], sides[-1][0])
        if sides[1] or sides[-1]:
            self._raise_one_sided(fault, horizon, sides)
        return None

    def _ends_on_side(self, fault: str, horizon: str, side: int) -> list[SegmentEnd]:
        """The ends of a horizon's segments at a fault on one side."""
        fault_index = list(self.faults).index(fault)
        return [
            (index, which)
            for index, segment in enumerate(self.horizons[horizon])
            for which in (0, -1)
            if (end := segment.ends[which]) and end.fault == fault_index and end.side == side
        ]

    def _point(self, horizon: str, segment_end: SegmentEnd) -> Position:
        index, which = segment_end
        return self.horizons[horizon][index].end_point(which)

    def _raise_two_on_one_side(self, fault: str, horizon: str, side: int, ends: list[SegmentEnd]) -> NoReturn:
        first, second = (self.horizons[horizon][index].piece for index, _ in ends[:2])
        what = f"pieces {first} and {second}" if first != second else f"both ends of piece {first}"
        point = self._point(horizon, ends[1])
        raise PickError(
            f"{what} of horizon {horizon!r} reach fault {fault!r} in its {WALLS[side]}, the second near "
            f"{self.where(point)}; keep one, or join them",
            pick=horizon,
            where=self.position(point),
        )

    def _raise_one_sided(self, fault: str, horizon: str, sides: dict[int, list[SegmentEnd]]) -> NoReturn:
        present = 1 if sides[1] else -1
        point = self._point(horizon, sides[present][0])
        message = (
            f"horizon {horizon!r} reaches fault {fault!r} in its {WALLS[present]} near {self.where(point)}, but not in "
            f"its {WALLS[-present]}"
        )
        advice = self._out_of_reach(fault, horizon, -present) or "; draw a piece there, or leave one of the two out"
        raise PickError(message, advice, pick=horizon, where=self.position(point))

    def _out_of_reach(self, fault: str, horizon: str, side: int) -> str | None:
        """Text about a piece on this side of the fault that ends too far from it, or None if there is none."""
        line = self.faults[fault]
        for segment in self.horizons[horizon]:
            for which in (0, -1):
                end = _end_ahead(segment, which, line)
                if end and end.side == side:
                    return (
                        f": piece {segment.piece} ends {end.gap:.4g}{self.unit} away from the fault, and can be "
                        f"extended by at most a fifth of its length, {EXTENSION * segment.line.length:.4g}{self.unit}; "
                        "draw it closer"
                    )
        return None

    def _nearest(self, fault: str) -> str:
        distances = [
            (segment.line.distance(self.faults[fault]), horizon, segment.piece)
            for horizon, segments in self.horizons.items()
            for segment in segments
        ]
        if not distances:
            return "give a horizon with a piece on either side"
        distance, horizon, piece = min(distances)
        return (
            f"the nearest is piece {piece} of horizon {horizon!r}, {distance:.4g}{self.unit} away: "
            "draw a piece on either side"
        )


def _end_ahead(segment: HorizonSegment, which: int, fault: LineString) -> End | None:
    """The end that a free end of a segment would have at a fault, however far away."""
    if segment.ends[which]:
        return None
    return nearest_fault_ahead(segment.line, which, [fault], 1e3 * fault.length)


def _cutoff_points(fault: Fault, horizon: Horizon) -> tuple[np.ndarray, np.ndarray]:
    line = LineString(fault.points)
    segments = horizon_segments([LineString(piece) for piece in horizon.pieces], [line])
    network = PickNetwork({fault.name: line}, {horizon.name: segments}, "x={0[0]:.6g}, z={0[1]:.6g}".format, unit="")
    (pair,) = network.cutoffs()
    hanging_wall, footwall = (segments[index].end_point(which) for index, which in (pair.hanging_wall, pair.footwall))
    return np.array(hanging_wall), np.array(footwall)


def throw(fault: Fault, horizon: Horizon) -> float:
    """Vertical separation of a horizon's two cut-offs at a fault, in the section's unit of z.

    Positive where the hanging wall lies deeper (a normal fault).

    Raises
    ------
    PickError
        If the horizon does not reach the fault from both sides.
    """
    hanging_wall, footwall = _cutoff_points(fault, horizon)
    return float(hanging_wall[1] - footwall[1])


def heave(fault: Fault, horizon: Horizon) -> float:
    """Horizontal separation of a horizon's two cut-offs at a fault, in the section's unit of x.

    Positive where the horizon has a gap (a normal fault), negative where it overlaps itself.

    Raises
    ------
    PickError
        If the horizon does not reach the fault from both sides.
    """
    hanging_wall, footwall = _cutoff_points(fault, horizon)
    top, bottom = fault.points[np.argsort(fault.points[[0, -1], 1], kind="stable") * (len(fault.points) - 1)]
    return float((hanging_wall[0] - footwall[0]) * (1 if bottom[0] >= top[0] else -1))
