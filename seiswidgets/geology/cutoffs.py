"""The cut-offs of horizons at faults, two for each pair, and the throw and heave that follow."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from shapely import LineString

from seiswidgets.errors import PickError
from seiswidgets.geology.picks import Fault, Horizon
from seiswidgets.geology.segments import EXTENSION, HorizonSegment, horizon_segments, reached

WALLS = {1: "hanging wall", -1: "footwall"}


@dataclass(frozen=True)
class CutOffPair:
    """The two cut-offs of a horizon at a fault.

    Attributes
    ----------
    fault, horizon : str
        Their names.
    hanging_wall, footwall : tuple of int
        Each a part's index, and the end of it (0 or -1).
    """

    fault: str
    horizon: str
    hanging_wall: tuple[int, int]
    footwall: tuple[int, int]


@dataclass(frozen=True, eq=False)
class PickNetwork:
    """The lines of some faults and horizons, ready to be matched with each other.

    Attributes
    ----------
    faults : dict of str to LineString
        By name.
    horizons : dict of str to list of HorizonSegment
    where : callable(point) -> str
        How errors name a place.
    unit : str
        Of lengths, in errors.
    """

    faults: dict[str, LineString]
    horizons: dict[str, list[HorizonSegment]]
    where: Callable[[tuple[float, float]], str]
    unit: str = " m"

    def cutoffs(self) -> list[CutOffPair]:
        """All pairs of cut-offs of the horizons at the faults.

        Raises
        ------
        PickError
            If a horizon meets a fault from one side only, or twice from one side, or if no horizon meets a fault.
        """
        found = [pair for fault in self.faults for horizon in self.horizons if (pair := self._pair(fault, horizon))]
        for fault in self.faults:
            if not any(pair.fault == fault for pair in found):
                raise PickError(
                    f"no horizon ends at fault {fault!r} on both sides, so that nothing tells how far it has slipped; "
                    f"{self._nearest(fault)}",
                    pick=fault,
                )
        return found

    def ends_at(self, fault: str) -> list[tuple[float, float]]:
        """The points where horizons end at a fault."""
        number = list(self.faults).index(fault)
        ends = (end for horizon in self.horizons.values() for part in horizon for end in part.ends)
        return [end.point for end in ends if end and end.fault == number]

    def _pair(self, fault, horizon):
        sides = {side: self._claims(fault, horizon, side) for side in WALLS}
        for side, claims in sides.items():
            if len(claims) > 1:
                first, second = (self.horizons[horizon][index].number for index, _ in claims[:2])
                what = f"pieces {first} and {second}" if first != second else f"both ends of piece {first}"
                raise PickError(
                    f"{what} of horizon {horizon!r} reach fault {fault!r} in its {WALLS[side]}, the second near "
                    f"{self._place(horizon, claims[1])}; keep one, or join them"
                )
        if sides[1] and sides[-1]:
            return CutOffPair(fault, horizon, sides[1][0], sides[-1][0])
        if sides[1] or sides[-1]:
            self._raise_one_sided(fault, horizon, sides)
        return None

    def _claims(self, fault, horizon, side):
        """The parts, and ends of them, that lie at a fault on one side."""
        number = list(self.faults).index(fault)
        return [
            (index, place)
            for index, part in enumerate(self.horizons[horizon])
            for place in (0, -1)
            if (end := part.ends[place]) and end.fault == number and end.side == side
        ]

    def _place(self, horizon, claim):
        index, place = claim
        return self.where(self.horizons[horizon][index].ends[place].point)

    def _raise_one_sided(self, fault, horizon, sides):
        present = 1 if sides[1] else -1
        message = (
            f"horizon {horizon!r} reaches fault {fault!r} in its {WALLS[present]} near "
            f"{self._place(horizon, sides[present][0])}, but not in its {WALLS[-present]}"
        )
        line = self.faults[fault]
        for part in self.horizons[horizon]:
            for place in (0, -1):
                end = None if part.ends[place] else reached(part.line, place, [line], 1e3 * line.length)
                if end and end.side == -present:
                    raise PickError(
                        f"{message}: piece {part.number} ends {end.gap:.4g}{self.unit} away from the fault, and can be "
                        f"extended by a fifth of its length at most, {EXTENSION * part.line.length:.4g}{self.unit}; "
                        "draw it closer"
                    )
        raise PickError(f"{message}; draw a piece there, or leave one of the two out")

    def _nearest(self, fault):
        distances = [
            (part.line.distance(self.faults[fault]), horizon, part.number)
            for horizon, horizon_parts in self.horizons.items()
            for part in horizon_parts
        ]
        if not distances:
            return "give a horizon with a piece on either side"
        distance, horizon, number = min(distances)
        return (
            f"the nearest is piece {number} of horizon {horizon!r}, {distance:.4g}{self.unit} away: "
            "draw a piece on either side"
        )


def _cutoff_points(fault, horizon):
    line = LineString(fault.points)
    found = horizon_segments([LineString(piece) for piece in horizon.pieces], [line])
    (pair,) = PickNetwork(
        {fault.name: line}, {horizon.name: found}, "x={0[0]:.6g}, z={0[1]:.6g}".format, unit=""
    ).cutoffs()
    return tuple(np.array(found[index].ends[place].point) for index, place in (pair.hanging_wall, pair.footwall))


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
