"""The match of a fault as it is picked or planned, and what other matches would deform."""

from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np

from seiswidgets.errors import Cancelled, SeiswidgetsError
from seiswidgets.geology.cutoffs import cutoffs_if_any
from seiswidgets.geology.fault_traces import FaultTraces
from seiswidgets.geology.picks import Fault, Interpretation
from seiswidgets.geology.plan import Plan, RestorationJob
from seiswidgets.geology.slip_profile import SlipProfile
from seiswidgets.geology.steps import UNFAULT


def present_profile(
    traces: FaultTraces, fault: Fault, interpretation: Interpretation, plan: Plan
) -> SlipProfile | None:
    """The slip along a fault that a plan prescribes, else that of the horizons' cut-offs; None if neither is there."""
    prescribed = plan.slip_of(fault.name)
    if prescribed is not None:
        return prescribed
    rows: dict[float, float] = {}
    for horizon in interpretation.horizons:
        if not horizon.constrains:
            continue
        for cutoff in cutoffs_if_any(fault, horizon):
            arcs, _ = traces.arcs(traces.section.to_rock([cutoff.hanging_wall, cutoff.footwall]))
            rows[float(arcs.mean())] = float(arcs[0] - arcs[1])
    return SlipProfile(*zip(*sorted(rows.items()), strict=True)) if rows else None


def deformation(
    job: RestorationJob, fault: str, profiles: Sequence[SlipProfile], wanted: Callable[[], bool] = lambda: True
) -> list[float]:
    """Mean change of the area, in percent, that undoing a fault's slip takes, for some profiles; NaN if it fails.

    On the mesh of a preview, in steps of ``unfault`` only.

    Raises
    ------
    Cancelled
        If ``wanted`` is false before all are done.
    """
    found = []
    for profile in profiles:
        if not wanted():
            raise Cancelled("the deformation is not wanted any more")
        plan = job.plan.with_slip(fault, profile)
        steps = tuple(step for step in plan.steps if step.kind == UNFAULT)
        try:
            stage = replace(job, plan=replace(plan, steps=steps)).coarse.restored().stages[-1]
        except (SeiswidgetsError, IndexError):
            found.append(np.nan)
            continue
        found.append(100 * float(np.average(np.abs(np.log(stage.area_ratio)), weights=stage.mesh.areas)))
    return found
