"""The lines of the picks that a step can use, after the stages so far, and notes about the others."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import TypeVar

import numpy as np
from shapely import LineString

from seiswidgets.errors import PickError
from seiswidgets.geology import validation
from seiswidgets.geology.clipping import CLIPPED, clip_findings
from seiswidgets.geology.crossings import crossing_findings
from seiswidgets.geology.domain import RestorationDomain
from seiswidgets.geology.findings import Finding
from seiswidgets.geology.holds import Holds
from seiswidgets.geology.passive import carried_finding, carry_refused, constraining, flaws
from seiswidgets.geology.picks import Ends, Fault, Horizon, both_ends
from seiswidgets.geology.section import Section
from seiswidgets.geology.stage import Stage
from seiswidgets.geology.transfer import carried_boundaries, carried_fault, carried_horizon, carried_point

Lines = dict[str, np.ndarray]
Beds = dict[str, list[LineString]]
EndsOfFaults = dict[str, Ends]
Regional = float | Sequence[tuple[float, float]] | None
Made = TypeVar("Made")


@dataclass(frozen=True, eq=False)
class UsablePicks:
    """Picks of the original section as the next stage finds them.

    Attributes
    ----------
    original : Section
    stages : tuple of Stage
        The stages so far.
    domain : RestorationDomain
        The rock after them.
    """

    original: Section
    stages: tuple[Stage, ...]
    domain: RestorationDomain

    def use(
        self,
        make: Callable[[Lines, Beds, Lines, EndsOfFaults], Made],
        faults: Fault | Sequence[Fault],
        horizons: Horizon | Sequence[Horizon] = (),
        boundaries: Fault | Sequence[Fault] = (),
    ) -> tuple[Made, tuple[Finding, ...]]:
        """Call a function with the lines of picks after the stages so far, without the picks that it refuses.

        Parameters
        ----------
        make : callable(faults, horizons, boundaries, ends)
            Lines in metres of rock by name; a PickError about one of them refuses it.
        faults, horizons, boundaries
            As for `unfault`.

        Returns
        -------
        made : object
            The result of the function.
        notes : tuple of Finding
            About picks that were clipped, refused, or can only be carried.

        Raises
        ------
        PickError
            If no fault can be used.
        """
        named_faults = validation.named_picks(faults, Fault, "fault")
        named_horizons = validation.named_picks(horizons, Horizon, "horizon")
        named_boundaries = validation.named_picks(boundaries, Fault, "fault")
        if not named_faults:
            raise PickError("there is no fault to unfault; give at least one")
        chain = self.original, self.stages
        first = self.stages[0].domain if self.stages else self.domain
        others = {name: fault for name, fault in named_boundaries.items() if fault not in named_faults.values()}
        walls = carried_boundaries(*chain, constraining(others), first)

        def make_of(faults: dict[str, Fault], horizons: dict[str, Horizon]) -> Made:
            lines = {name: carried_fault(*chain, fault, first) for name, fault in faults.items()}
            beds = {name: carried_horizon(*chain, bed, flawless=True) for name, bed in horizons.items()}
            return make(lines, beds, walls, {name: both_ends(fault.ends) for name, fault in faults.items()})

        picks: list[Fault | Horizon] = [*named_faults.values(), *named_horizons.values()]
        used = constraining(named_faults), constraining(named_horizons)
        if not used[0]:
            unused = PickError("no fault is used as a constraint; set the use of one to 'constrain'")
            raise next(iter(flaws(picks)), unused)
        made, refusals = carry_refused(make_of, *used)
        return made, self.notes(picks, refusals)

    def notes(self, picks: Sequence[Fault | Horizon], refusals: Sequence[PickError] = ()) -> tuple[Finding, ...]:
        """Notes about picks that are clipped, cross each other, are refused, or can only be carried."""
        refused = {error.pick for error in refusals}
        flawed = [self._brought_here(carried_finding(flaw)) for flaw in flaws(picks)]
        horizons = [pick for pick in picks if isinstance(pick, Horizon) and pick.constrains]
        crossed = map(self._brought_here, crossing_findings(self.original, horizons))
        clipped = self._clipped(*(pick for pick in picks if pick.constrains and pick.name not in refused))
        return (*clipped, *flawed, *crossed, *map(carried_finding, refusals))

    def bed_lines(self, horizon: Horizon) -> list[LineString]:
        """The lines of a horizon after the stages so far, without pieces that have a flaw."""
        if horizon.flaw and None not in horizon.flaws:
            raise horizon.flaw
        return carried_horizon(self.original, self.stages, horizon, flawless=True)

    def holds(
        self, fixed: tuple[float, float] | None, pins: Sequence[tuple[float, float]], regional: Regional
    ) -> Holds:
        """The points that hold the section, after the stages so far."""
        x_min, x_max, *_ = self.original.extent
        ends = [(x_min, regional), (x_max, regional)] if isinstance(regional, int | float) else regional
        pinned, level = (
            np.array([carried_point(self.original, self.stages, point, name) for point in held]).reshape(-1, 2)
            for name, held in (
                ("a pin", validation.held_points("pins", pins)),
                ("the regional level", validation.held_points("regional", ends or ())),
            )
        )
        return Holds(None if fixed is None else carried_point(self.original, self.stages, fixed), pinned, level)

    def _clipped(self, *picks: Fault | Horizon) -> tuple[Finding, ...]:
        """Notes about picks that stick out of the section, unless an earlier stage has them."""
        noted = {note.pick for stage in self.stages for note in stage.outcome.notes if note.kind == CLIPPED}
        notes = [note for note in clip_findings(self.original, picks) if note.pick not in noted]
        return tuple(replace(note, where=None) if self.stages else note for note in notes)

    def _brought_here(self, finding: Finding) -> Finding:
        """A finding with its position after the stages so far."""
        if finding.where is None or not self.stages:
            return finding
        point = self.original.to_rock([finding.where])
        for stage in self.stages:
            point = stage.map.forward(point)
        ((x, z),) = self.original.from_rock(point)
        return replace(finding, where=(float(x), float(z)) if np.isfinite([x, z]).all() else None)
