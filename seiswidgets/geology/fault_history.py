"""Throw and growth of faults, from the cut-offs of horizons on both sides."""

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from seiswidgets.geology.cutoffs import CutOff, cutoffs_if_any
from seiswidgets.geology.picks import IGNORE, Fault, Interpretation
from seiswidgets.geology.section import Section
from seiswidgets.geology.stratigraphy import Stratigraphy
from seiswidgets.geology.tables import Table


@dataclass(frozen=True)
class DatedCutOff:
    """A cut-off with the age of its horizon in Ma, None if unknown, and the slip between its points, in metres."""

    cutoff: CutOff
    age: float | None
    slip: float

    @property
    def depth(self) -> float:
        """Depth half way between its two points."""
        return (self.cutoff.hanging_wall[1] + self.cutoff.footwall[1]) / 2


def fault_throws(section: Section, interpretation: Interpretation, stratigraphy: Stratigraphy | None = None) -> Table:
    """Throw and heave against depth and age, at each fault from the top down.

    Throw that grows downwards was gained while the layers were deposited.

    Parameters
    ----------
    section : Section
    interpretation : Interpretation
        Faults without a horizon on both sides have no row.
    stratigraphy : Stratigraphy, optional
        Ages of the horizons.

    Examples
    --------
    >>> import seiswidgets as sw
    >>> case = sw.synthetic.planar_fault(throw=100)
    >>> [round(throw) for throw in sw.fault_throws(case.section, case.interpretation).column("throw")]
    [100, 100, 100]
    """
    units = {"fault": "", "horizon": "", "age": "Ma", "depth": section.z_unit, "throw": section.z_unit}
    rows = tuple(
        (fault.name, dated.cutoff.horizon, dated.age, dated.depth, dated.cutoff.throw, dated.cutoff.heave, dated.slip)
        for fault, found in _histories(section, interpretation, stratigraphy)
        for dated in found
    )
    return Table("Throw along faults", {**units, "heave": section.x_unit, "slip": "m"}, rows)


def fault_growth(section: Section, interpretation: Interpretation, stratigraphy: Stratigraphy | None = None) -> Table:
    """Expansion index and slip gained between successive horizons, at each fault from the top down.

    The expansion index (Thorsen 1963) is the thickness between two horizons in the hanging wall over that in the
    footwall, both measured vertically between their cut-offs: above 1, the fault grew while they were deposited. With
    ages, the slip gained gives a rate. Nothing is decompacted: restore a `Plan.sequential` for that.

    Parameters
    ----------
    section, interpretation, stratigraphy
        As for `fault_throws`.
    """
    z = section.z_unit
    units = {"fault": "", "younger": "", "older": "", "hanging wall": z, "footwall": z, "expansion index": "1"}
    rows = tuple(
        (fault.name, *_growth(upper, lower))
        for fault, found in _histories(section, interpretation, stratigraphy)
        for upper, lower in pairwise(found)
    )
    return Table("Growth of faults", {**units, "slip gained": "m", "slip rate": "m/Ma"}, rows)


def _growth(upper: DatedCutOff, lower: DatedCutOff) -> tuple[str | float | None, ...]:
    above, below, gained = upper.cutoff, lower.cutoff, lower.slip - upper.slip
    hanging_wall, footwall = below.hanging_wall[1] - above.hanging_wall[1], below.footwall[1] - above.footwall[1]
    index = hanging_wall / footwall if footwall > 0 else None
    span = None if upper.age is None or lower.age is None else lower.age - upper.age
    rate = gained / span if span else None
    return above.horizon, below.horizon, hanging_wall, footwall, index, gained, rate


def _histories(
    section: Section, interpretation: Interpretation, stratigraphy: Stratigraphy | None
) -> Iterator[tuple[Fault, list[DatedCutOff]]]:
    """Each used fault with its cut-offs, from the top down."""
    ages = {layer.top: layer.age for layer in stratigraphy.layers} if stratigraphy else {}
    for fault in interpretation.faults:
        found = []
        for horizon in interpretation.horizons:
            if IGNORE in (fault.use, horizon.use):
                continue
            places = cutoffs_if_any(fault, horizon)
            found += [DatedCutOff(place, ages.get(horizon.name), _slip(section, place)) for place in places]
        yield fault, sorted(found, key=lambda dated: dated.depth)


def _slip(section: Section, cutoff: CutOff) -> float:
    """Distance between the two points in rock, negative for a reverse fault."""
    across = np.subtract(*section.to_rock([cutoff.hanging_wall, cutoff.footwall]))
    return float(np.copysign(np.hypot(*across), cutoff.throw))
