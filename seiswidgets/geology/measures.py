"""Measures of an interpretation and of its restoration, one number each, to compare hypotheses by."""

from collections.abc import Sequence

import numpy as np

from seiswidgets.core.deformation import weighted_percentiles
from seiswidgets.geology.bed_lines import bed_extent
from seiswidgets.geology.cutoffs import cutoffs_if_any
from seiswidgets.geology.picks import IGNORE, Fault, Horizon, Interpretation
from seiswidgets.geology.restoration import Restoration
from seiswidgets.geology.section import Section
from seiswidgets.geology.stage import Stage
from seiswidgets.geology.steps import FLATTEN, UNFAULT

THROW, HEAVE, SLIP, EXTENSION, BED_LENGTH = "throw", "heave", "slip", "extension", "bed length"
BED_CHANGE, AREA_CHANGE, ROTATION, DEFORMATION = "bed change", "area change", "rotation", "deformation"
SHARES = (EXTENSION, BED_CHANGE, AREA_CHANGE, DEFORMATION)
MEANING = {
    THROW: "vertical distance between two cut-offs; positive if normal",
    HEAVE: "horizontal distance between two cut-offs; positive if normal",
    SLIP: "mean of the least and the largest slip prescribed along a fault",
    EXTENSION: "present-day over restored distance between a horizon's ends, less 1",
    BED_LENGTH: "length of a horizon after restoring",
    BED_CHANGE: "restored over present-day length of a horizon, less 1",
    AREA_CHANGE: "change of the section's area by unfaulting and flattening",
    ROTATION: "turn of a block by unfaulting, positive clockwise",
    DEFORMATION: "change of area that 98% of the rock stays below",
}
LARGEST = 98  # percent

Label = tuple[str, str]  # quantity, and what it is about: "H1 at F1", "H1", "hanging wall of F1" or ""
Measures = dict[Label, float]


def unit_of(quantity: str, section: Section) -> str:
    """The unit of a quantity; "1" for a share."""
    units = {THROW: section.z_unit, HEAVE: section.x_unit, SLIP: "m", BED_LENGTH: "m", ROTATION: "degrees"}
    return units.get(quantity, "1")


def measure_picks(interpretation: Interpretation) -> Measures:
    """Throw and heave at each cut-off, from the picks alone."""
    found: Measures = {}
    for fault in _used(interpretation.faults):
        for horizon in _used(interpretation.horizons):
            for count, place in enumerate(cutoffs_if_any(fault, horizon), 1):
                about = f"{horizon.name} at {fault.name}" + (f" ({count})" if count > 1 else "")
                found |= {(THROW, about): place.throw, (HEAVE, about): place.heave}
    return found


def measure_restoration(restored: Restoration, interpretation: Interpretation) -> Measures:
    """Lengths, areas and turns after all stages; nothing if there is no stage."""
    if not restored.stages:
        return {}
    found: Measures = {}
    for horizon in _used(interpretation.horizons):
        extent = bed_extent(restored, interpretation.faults, horizon)
        if extent:
            found |= {
                (EXTENSION, horizon.name): extent.extension,
                (BED_LENGTH, horizon.name): extent.restored_length,
                (BED_CHANGE, horizon.name): extent.change,
            }
    solved = [stage for stage in restored.stages if stage.kind in (UNFAULT, FLATTEN)]
    found[AREA_CHANGE, ""] = float(np.prod([stage.outline.area / stage.domain.outline.area for stage in solved])) - 1
    found[DEFORMATION, ""] = _largest_deformation(solved)
    for stage in solved:
        if stage.kind == UNFAULT:
            found |= {(SLIP, slip.fault): (slip.least + slip.most) / 2 for slip in stage.report.slips}
            for motion in stage.report.motions:
                found[ROTATION, motion.part] = found.get((ROTATION, motion.part), 0.0) + motion.rotation
    return found


def _largest_deformation(stages: Sequence[Stage]) -> float:
    """The change of area, by any stage, that 98% of the rock stays below."""
    changes = [
        weighted_percentiles(np.exp(np.abs(np.log(stage.area_ratio))), stage.mesh.areas, (LARGEST,))[0] - 1
        for stage in stages
    ]
    return float(max(changes, default=0.0))


def depths_along(lines: Sequence[np.ndarray], x: np.ndarray) -> np.ndarray:
    """Depth of lines at positions along the section: the mean where they pass one several times, NaN where never."""
    total, count = np.zeros(len(x)), np.zeros(len(x))
    for line in lines:
        for (x1, z1), (x2, z2) in zip(line[:-1].tolist(), line[1:].tolist(), strict=True):
            low, high = np.searchsorted(x, (min(x1, x2), max(x1, x2)))
            if high > low:
                total[low:high] += z1 + (z2 - z1) * (x[low:high] - x1) / (x2 - x1)
                count[low:high] += 1
    return np.where(count > 0, total / np.maximum(count, 1), np.nan)


def _used(picks: Sequence[Fault] | Sequence[Horizon]) -> list:
    return [pick for pick in picks if pick.use != IGNORE]
