"""The cut-offs of horizons at faults, two at each place, and the throw and heave that follow."""

from collections.abc import Callable, Container, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike
from scipy.sparse import csr_array
from scipy.sparse.csgraph import min_weight_full_bipartite_matching
from shapely import LineString, Point

from seiswidgets.errors import PickError
from seiswidgets.geology.picks import Fault, Horizon
from seiswidgets.geology.segments import End, HorizonSegment, horizon_segments, nearest_fault_ahead

WALLS = {1: "hanging wall", -1: "footwall"}

Position = tuple[float, float]
SegmentEnd = tuple[int, int]  # index of a segment, and which end of it (0 or -1)


@dataclass(frozen=True)
class CutOff:
    """A place where a fault cuts a horizon off, in the section's units.

    Attributes
    ----------
    fault, horizon : str
        Their names.
    hanging_wall, footwall : tuple (x, z)
        The two points on the fault where the horizon ends.
    throw : float
        Vertical distance between them, positive where the hanging wall lies deeper (a normal fault).
    heave : float
        Horizontal distance between them, positive where the horizon has a gap (a normal fault), negative where it
        overlaps itself.
    """

    fault: str
    horizon: str
    hanging_wall: Position
    footwall: Position
    throw: float
    heave: float


@dataclass(frozen=True)
class CutOffPair:
    """The two cut-offs of a horizon at one place along a fault; a fault may cut a horizon at several.

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


Place = tuple[SegmentEnd | None, SegmentEnd | None]  # hanging wall, footwall; None where no segment ends


def places_along(line: LineString, index: int, segments: Sequence[HorizonSegment]) -> list[Place]:
    """Pair the ends of a horizon's segments at a fault, place by place.

    Slip moves all points of a side the same way, so the ends of both sides follow each other in the same order. Where
    one side has more ends than the other, those are paired that lie closest along the fault.

    Parameters
    ----------
    line : LineString
        The fault.
    index : int
        Its index in the ends of the segments.
    segments : list of HorizonSegment
    """
    sides: dict[int, list[tuple[float, SegmentEnd]]] = {1: [], -1: []}
    for number, segment in enumerate(segments):
        for which, end in zip((0, -1), segment.ends, strict=True):
            if end and end.fault == index:
                sides[end.side].append((line.project(Point(end.point)), (number, which)))
    hanging_wall, footwall = sorted(sides[1]), sorted(sides[-1])
    if len(hanging_wall) < len(footwall):
        return [(end, other) for other, end in _partners(footwall, hanging_wall)]
    return _partners(hanging_wall, footwall)


def _partners(more: Sequence[tuple[float, SegmentEnd]], fewer: Sequence[tuple[float, SegmentEnd]]) -> list[Place]:
    """Pair ends in order of arc length, such that the sum of the distances between partners is least."""
    if not fewer:
        return [(end, None) for _, end in more]
    distances = np.abs(np.subtract.outer([at for at, _ in fewer], [at for at, _ in more]))
    _, chosen = min_weight_full_bipartite_matching(csr_array(1 + distances))  # 1: a zero would be no edge
    partner = {more[index][1]: other for index, (_, other) in zip(sorted(chosen), fewer, strict=True)}
    return [(end, partner.get(end)) for _, end in more]


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
        Their ends count the faults from 0; higher indices are boundaries, which have no cut-offs.
    where : callable(point) -> str
        Text for a position in errors.
    position : callable(point) -> (x, z)
        The position in the section's units, for the ``where`` field of errors.
    length : callable(float) -> str
        Text for a length in errors.
    """

    faults: dict[str, LineString]
    horizons: dict[str, list[HorizonSegment]]
    where: Callable[[Position], str]
    position: Callable[[Position], Position] = _unchanged
    length: Callable[[float], str] = "{:.4g}".format

    def cutoffs(self, prescribed: Container[str] = ()) -> list[CutOffPair]:
        """All pairs of cut-offs of the horizons at the faults that agree with each other.

        Raises
        ------
        PickError
            If no horizon ends at a fault on both sides, and its slip is not prescribed.
        """
        for fault in self.faults:
            if fault not in prescribed and not any(pair.fault == fault for pair in self._pairs[0]):
                raise self._undetermined(fault)
        return self._pairs[0]

    @property
    def refusals(self) -> list[PickError]:
        """An error for each horizon that is not matched at a fault: one-sided, met too often, or contradicting."""
        return self._pairs[1]

    @cached_property
    def _pairs(self) -> tuple[list[CutOffPair], list[PickError]]:
        pairs: list[CutOffPair] = []
        refusals: list[PickError] = []
        for fault in self.faults:
            matched: list[CutOffPair] = []
            for horizon in self.horizons:
                places = self.places(fault, horizon)
                matched += [CutOffPair(fault, horizon, one, other) for one, other in places if one and other]
                refusals += self._unmatched(fault, horizon, places)
            agreeing, contradicting = self._agreeing(matched)
            pairs += agreeing
            refusals += contradicting
        return pairs, refusals

    def _agreeing(self, pairs: list[CutOffPair]) -> tuple[list[CutOffPair], list[PickError]]:
        """Remove pairs at a fault until all follow each other in the same order on both sides, as slip leaves them."""
        refusals: list[PickError] = []
        while True:
            one, other = (self._arc_lengths(pairs, wall) for wall in ("hanging_wall", "footwall"))
            inverted = np.subtract.outer(one, one) * np.subtract.outer(other, other) < 0
            count = inverted.sum(axis=1)
            if not count.any():
                return pairs, refusals
            worst = int(np.flatnonzero(count == count.max())[-1])
            refusals.append(self._contradiction(pairs[worst], pairs[int(np.argmax(inverted[worst]))]))
            pairs = pairs[:worst] + pairs[worst + 1 :]

    def _arc_lengths(self, pairs: Sequence[CutOffPair], wall: str) -> np.ndarray:
        """Positions of cut-offs along their fault, shape (n,)."""
        points = [self.point(pair.horizon, getattr(pair, wall)) for pair in pairs]
        lines = [self.faults[pair.fault] for pair in pairs]
        return np.array([line.project(Point(point)) for line, point in zip(lines, points, strict=True)])

    def _contradiction(self, pair: CutOffPair, other: CutOffPair) -> PickError:
        point = self.point(pair.horizon, pair.hanging_wall)
        return PickError(
            f"horizon {pair.horizon!r} contradicts horizon {other.horizon!r} at fault {pair.fault!r}, near "
            f"{self.where(point)}: it lies above the other one on one side of the fault and below it on the other; "
            "check which pieces belong together",
            kind="contradiction",
            pick=pair.horizon,
            where=self.position(point),
        )

    def ends_at(self, fault: str) -> list[Position]:
        """The points where horizons end at a fault."""
        index = list(self.faults).index(fault)
        ends = (end for segments in self.horizons.values() for segment in segments for end in segment.ends)
        return [end.point for end in ends if end and end.fault == index]

    def places(self, fault: str, horizon: str) -> list[Place]:
        """The places along a fault where it cuts a horizon off; see `places_along`."""
        return places_along(self.faults[fault], list(self.faults).index(fault), self.horizons[horizon])

    def _unmatched(self, fault: str, horizon: str, places: Sequence[Place]) -> list[PickError]:
        """An error if some ends of a horizon at a fault have no partner on its other side."""
        sides = {1: [place[0] for place in places if place[0]], -1: [place[1] for place in places if place[1]]}
        if len(sides[1]) == len(sides[-1]):
            return []
        if not sides[1] or not sides[-1]:
            return [self._one_sided(fault, horizon, sides)]
        side = 1 if len(sides[1]) > len(sides[-1]) else -1
        return [self._two_on_one_side(fault, horizon, side, sorted(sides[side]))]

    def _undetermined(self, fault: str) -> PickError:
        message = f"no horizon ends at fault {fault!r} on both sides, so its slip is undetermined"
        for horizon in self.horizons:
            for error in self._unmatched(fault, horizon, self.places(fault, horizon)):
                return PickError(f"{message}: {error.text}", kind="undetermined", pick=fault, where=error.where)
        return PickError(f"{message}; {self._nearest(fault)}", kind="undetermined", pick=fault)

    def point(self, horizon: str, segment_end: SegmentEnd) -> Position:
        """The point at which a segment of a horizon ends."""
        index, which = segment_end
        return self.horizons[horizon][index].end_point(which)

    def _two_on_one_side(self, fault: str, horizon: str, side: int, ends: list[SegmentEnd]) -> PickError:
        first, second = (self.horizons[horizon][index].piece for index, _ in ends[:2])
        what = f"pieces {first} and {second}" if first != second else f"both ends of piece {first}"
        point = self.point(horizon, ends[1])
        return PickError(
            f"{what} of horizon {horizon!r} reach fault {fault!r} in its {WALLS[side]}, the second near "
            f"{self.where(point)}, and fewer in its {WALLS[-side]}; keep one, or join them",
            pick=horizon,
            where=self.position(point),
        )

    def _one_sided(self, fault: str, horizon: str, sides: Mapping[int, Sequence[SegmentEnd]]) -> PickError:
        present = 1 if sides[1] else -1
        point = self.point(horizon, sides[present][0])
        message = (
            f"horizon {horizon!r} reaches fault {fault!r} in its {WALLS[present]} near {self.where(point)}, but not in "
            f"its {WALLS[-present]}"
        )
        advice = self._out_of_reach(fault, horizon, -present) or "; draw a piece there, or leave one of the two out"
        return PickError(message, advice, kind="one-sided", pick=horizon, where=self.position(point))

    def _out_of_reach(self, fault: str, horizon: str, side: int) -> str | None:
        """Text about a piece on this side of the fault that ends too far from it, or None if there is none."""
        line = self.faults[fault]
        for segment in self.horizons[horizon]:
            for which in (0, -1):
                end = _end_ahead(segment, which, line)
                if end and end.side == side:
                    return (
                        f": piece {segment.piece} ends {self.length(end.gap)} away from the fault, too far to be "
                        "extended to it; draw it closer"
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
            f"the nearest is piece {piece} of horizon {horizon!r}, {self.length(distance)} away: "
            "draw a piece on either side"
        )


def _end_ahead(segment: HorizonSegment, which: int, fault: LineString) -> End | None:
    """The end that a free end of a segment would have at a fault, however far away."""
    if segment.ends[which]:
        return None
    return nearest_fault_ahead(segment.line, which, [fault], None, 1e3 * fault.length)


def separation(fault: ArrayLike, hanging_wall: Position, footwall: Position) -> tuple[float, float]:
    """Throw and heave between two points of a fault, given by its own points, shape (n, 2)."""
    ends = np.asarray(fault)[[0, -1]]
    top, bottom = ends[np.argsort(ends[:, 1], kind="stable")]
    heave = (hanging_wall[0] - footwall[0]) * (1 if bottom[0] >= top[0] else -1)
    return float(hanging_wall[1] - footwall[1]), float(heave)


def cutoffs(fault: Fault, horizon: Horizon) -> tuple[CutOff, ...]:
    """The places where a fault cuts a horizon off, in order along the fault.

    Most often there is one; a fault may cut a fold, or the splays of another fault, at several.

    Raises
    ------
    PickError
        If the horizon does not reach the fault from both sides at each place.

    Examples
    --------
    >>> import seiswidgets as sw
    >>> picks = sw.synthetic.planar_fault(throw=100).interpretation
    >>> [round(cutoff.throw) for cutoff in sw.cutoffs(picks.faults[0], picks.horizons[0])]
    [100]
    """
    for flaw in filter(None, (fault.flaw, horizon.flaw)):
        raise flaw
    line = LineString(fault.points)
    segments = horizon_segments([LineString(piece) for piece in horizon.pieces], [line])
    network = PickNetwork({fault.name: line}, {horizon.name: segments}, "x={0[0]:.6g}, z={0[1]:.6g}".format)
    found = []
    pairs = network.cutoffs()
    for error in network.refusals:
        raise error
    for pair in pairs:
        one, other = (segments[index].end_point(which) for index, which in (pair.hanging_wall, pair.footwall))
        found.append(CutOff(fault.name, horizon.name, one, other, *separation(fault.points, one, other)))
    return tuple(found)


def cutoffs_if_any(fault: Fault, horizon: Horizon) -> tuple[CutOff, ...]:
    """As `cutoffs`, but none where the horizon does not reach the fault from both sides."""
    try:
        return cutoffs(fault, horizon)
    except PickError:
        return ()


def throw(fault: Fault, horizon: Horizon) -> float:
    """Vertical distance between a horizon's two cut-offs at a fault, in the section's unit of z.

    Positive where the hanging wall lies deeper (a normal fault), negative where it lies higher (a reverse fault).

    Raises
    ------
    PickError
        If the horizon does not reach the fault from both sides, or the fault cuts it at several places.
    """
    return _only_cutoff(fault, horizon).throw


def heave(fault: Fault, horizon: Horizon) -> float:
    """Horizontal distance between a horizon's two cut-offs at a fault, in the section's unit of x.

    Positive where the horizon has a gap (a normal fault), negative where it overlaps itself.

    Raises
    ------
    PickError
        If the horizon does not reach the fault from both sides, or the fault cuts it at several places.
    """
    return _only_cutoff(fault, horizon).heave


def _only_cutoff(fault: Fault, horizon: Horizon) -> CutOff:
    found = cutoffs(fault, horizon)
    if len(found) > 1:
        where = " and ".join(f"x={x:.6g}, z={z:.6g}" for x, z in (cutoff.footwall for cutoff in found))
        raise PickError(
            f"fault {fault.name!r} cuts horizon {horizon.name!r} at {len(found)} places, near {where}, so there is no "
            "single throw or heave; take one of cutoffs(fault, horizon)",
            pick=horizon.name,
            where=found[1].footwall,
        )
    return found[0]
