"""The rock that the next stage starts from, divided into the layers of a stratigraphy."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
import shapely
from shapely import LineString

from seiswidgets.errors import PickError
from seiswidgets.geology.crossings import crossing_findings
from seiswidgets.geology.decompaction import BurialMemory
from seiswidgets.geology.findings import Finding
from seiswidgets.geology.layers import WATER, Layers, layers_of
from seiswidgets.geology.picks import Fault, Horizon, Interpretation
from seiswidgets.geology.stage import STRIP
from seiswidgets.geology.stratigraphy import Stratigraphy
from seiswidgets.geology.surfaces import surface_line
from seiswidgets.geology.transfer import carried_boundaries
from seiswidgets.geology.usable_picks import UsablePicks


@dataclass(frozen=True, eq=False)
class StratifiedRock:
    """Layers and faults as the next stage finds them.

    Attributes
    ----------
    picks : UsablePicks
    stratigraphy : Stratigraphy
    interpretation : Interpretation

    Raises
    ------
    PickError
        From its first use on, if a top does not exist, or two tops cross.
    """

    picks: UsablePicks
    stratigraphy: Stratigraphy
    interpretation: Interpretation

    @cached_property
    def tops(self) -> dict[int, Horizon]:
        """The horizon at the top of each layer, by the layer's index."""
        layers = enumerate(self.stratigraphy.layers)
        tops = {index: self.interpretation.horizon(layer.top) for index, layer in layers if layer.top is not None}
        for finding in crossing_findings(self.picks.original, tops.values()):
            raise PickError(finding.text, kind=finding.kind, pick=finding.pick, where=finding.where)
        return tops

    @cached_property
    def layers(self) -> Layers:
        """The layers after the stages so far."""
        pieces = {index: self.picks.bed_lines(horizon) for index, horizon in self.tops.items()}
        faults = fault_lines_of(self.picks, self.interpretation.faults)
        return layers_of(self.picks.domain, pieces, faults, len(self.stratigraphy.layers), self._youngest)

    @property
    def _youngest(self) -> int:
        """Index of the youngest layer that is left; water if there may be some above it."""
        stripped = [stage.outcome.picks[0] for stage in self.picks.stages if stage.kind == STRIP]
        left = [index for index, layer in enumerate(self.stratigraphy.layers) if layer.top in stripped]
        return max(left, default=WATER if 0 in self.tops else 0)

    @property
    def notes(self) -> tuple[Finding, ...]:
        """Notes about the tops as they were drawn."""
        return self.picks.notes(list(self.tops.values()))

    @cached_property
    def memory(self) -> BurialMemory:
        """The deepest burial after the stages so far."""
        return BurialMemory(self.picks.stages, self._sea_floor)

    @cached_property
    def _sea_floor(self) -> np.ndarray:
        """The present-day sea floor, from left to right, in metres of rock; shape (k, 2)."""
        original, stages = self.picks.original, self.picks.stages
        if 0 not in self.tops:
            x_min, x_max, z_min, _ = original.extent
            return original.to_rock([(x_min, z_min), (x_max, z_min)])
        first = UsablePicks(original, (), stages[0].domain if stages else self.picks.domain)
        line, _ = surface_line(self.tops[0].name, first.bed_lines(self.tops[0]), [], first.domain)
        points = shapely.get_coordinates(line)
        return points[np.append(True, np.diff(np.maximum.accumulate(points[:, 0])) > 0)]


def fault_lines_of(picks: UsablePicks, faults: Sequence[Fault]) -> list[LineString]:
    """The lines of faults after the stages so far, without those that are ignored or of which nothing is left."""
    first = picks.stages[0].domain if picks.stages else picks.domain
    used = {fault.name: fault for fault in faults if fault.constrains}
    carried = carried_boundaries(picks.original, picks.stages, used, first)
    return [LineString(points) for points in carried.values()]
