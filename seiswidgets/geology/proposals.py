"""Counterparts of horizons across a fault, proposed from the slip along it."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
import shapely
from shapely import Point

from seiswidgets.geology.correlation import Correlation, local_samples, significance
from seiswidgets.geology.cutoffs import WALLS, separation
from seiswidgets.geology.fault_traces import FOOT, HANGING, FaultTraces
from seiswidgets.geology.picks import Horizon
from seiswidgets.geology.segments import End, nearest_fault_ahead, split_at_faults
from seiswidgets.geology.slip_profile import SlipProfile
from seiswidgets.geology.transfer import carried_horizon


@dataclass(frozen=True, eq=False)
class Proposal:
    """A piece of a horizon where it should go on beyond a fault.

    Attributes
    ----------
    fault, horizon : str
        Their names.
    wall : str
        "hanging wall" or "footwall": the side of the proposed piece.
    points : array, shape (n, 2)
        From the fault outwards, in the section's units.
    slip : float
        In metres of rock along the fault, positive for a normal fault.
    throw, heave : float
        Of the horizon's two cut-offs, in the units of z and x; see `CutOff`.
    confidence : float
        Significance of the match around the cut-offs, from 0 to 1; see `Correlation`.
    """

    fault: str
    horizon: str
    wall: str
    points: np.ndarray
    slip: float
    throw: float
    heave: float
    confidence: float


def proposals(
    traces: FaultTraces, profile: SlipProfile, correlation: Correlation, horizons: Sequence[Horizon]
) -> tuple[Proposal, ...]:
    """Propose a piece on the other side for each horizon that reaches a fault on one side only."""
    found = []
    for horizon in horizons:
        ends = list(_ends_at(traces, horizon))
        if len({end.side for end in ends}) == 1:
            made = [_counterpart(traces, profile, correlation, horizon.name, end) for end in ends]
            found += [proposal for proposal in made if proposal is not None]
    return tuple(found)


def _ends_at(traces: FaultTraces, horizon: Horizon) -> Iterator[End]:
    section = traces.section
    cell = np.array([section.dx, section.dz]) * section.metres
    for piece in carried_horizon(section, (), horizon):
        for part in split_at_faults(piece, [traces.line], cell=cell):
            for which in (0, -1):
                end = part.ends[which] or nearest_fault_ahead(part.line, which, [traces.line], cell)
                if end is not None:
                    yield end


def _counterpart(
    traces: FaultTraces, profile: SlipProfile, correlation: Correlation, name: str, end: End
) -> Proposal | None:
    """The proposal for one end of a horizon; None if its counterpart has no data."""
    slip = profile.at(traces.s)
    walls = traces.s + slip / 2, traces.s - slip / 2
    own, other = (HANGING, FOOT) if end.side == 1 else (FOOT, HANGING)
    at = traces.line.project(Point(end.point)) + traces.s[0]
    middle = np.interp(at, walls[own], traces.s, left=np.nan, right=np.nan)
    arc = np.interp(middle, traces.s, walls[other]) if np.isfinite(middle) else np.nan
    if not 0 <= arc <= traces.length:
        return None
    points = traces.bed(other, float(arc))
    if points is None:
        return None
    ends = {own: traces.section.from_rock(end.point), other: points[0]}
    line = traces.section.from_rock(shapely.get_coordinates(traces.line))
    throw, heave = separation(line, ends[HANGING], ends[FOOT])
    local = float(np.interp(middle, correlation.s, correlation.local))
    confidence = significance(local, local_samples(traces))
    wall = WALLS[-end.side]
    return Proposal(traces.name, name, wall, points, float(profile.at(middle)), throw, heave, confidence)
