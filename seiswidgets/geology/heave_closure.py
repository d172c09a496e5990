"""A check of line lengths: whether undoing the heave of a horizon closes the gap, or makes new bed instead."""

from collections.abc import Mapping, Sequence

import numpy as np

from seiswidgets.geology.domain import RestorationDomain
from seiswidgets.geology.findings import Finding
from seiswidgets.geology.report import CutOffReport

MOST = 0.25  # of the heave, that may be made up by a change of bed length; thrusts with a fold reach 0.17
LEAST = 0.5  # traces, that the length must change by


def heave_findings(
    cutoffs: Sequence[CutOffReport],
    made: Mapping[str, float],
    where: Mapping[tuple[str, str], np.ndarray],
    domain: RestorationDomain,
) -> list[Finding]:
    """Findings about horizons whose cut-offs meet because their beds became longer or shorter.

    Parameters
    ----------
    cutoffs : list of CutOffReport
        Before the step.
    made : dict of str to float
        Change of the length of each horizon's bed, in metres.
    where : dict of (str, str) to array, shape (2,)
        A point at the cut-offs of each fault and horizon, in the rock.
    domain : RestorationDomain
    """
    unit = float(domain.section.metres[0])
    found = []
    for horizon, change in made.items():
        heaves = [(cutoff.heave * unit, cutoff.fault) for cutoff in cutoffs if cutoff.horizon == horizon]
        heave = sum(heave for heave, _ in heaves)
        if not is_open(heave, change, unit * domain.section.dx):
            continue
        _, fault = max(heaves, key=lambda pair: abs(pair[0]))
        point = where[fault, horizon]
        change_text = f"{domain.length(abs(change))} {'longer' if change > 0 else 'shorter'}"
        text = (
            f"only {domain.length(max(abs(heave) - abs(change), 0))} of the {domain.length(abs(heave))} of heave of "
            f"horizon {horizon} close: its bed becomes {change_text} instead, so the offset at fault {fault} turns "
            "into a fold or a strain. Faults that die out inside the section do this; draw them on if they go farther"
        )
        found.append(Finding("warning", "heave", text, horizon, domain.position(point)))
    return found


def is_open(heave: float, change: float, trace: float) -> bool:
    """Return whether a change of bed length made up for much of a heave; all in metres."""
    return abs(change) >= LEAST * trace and change * heave > MOST * heave**2
