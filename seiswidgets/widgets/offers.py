"""Ways out that a finding offers: changes of the plan, one button each."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial

from seiswidgets.geology.beyond import KEEP, LEVEL, TREND
from seiswidgets.geology.findings import Finding
from seiswidgets.geology.steps import FLATTEN
from seiswidgets.widgets.workspace import Workspace

BEYOND = {  # label and tooltip of each choice
    KEEP: ("Leave the rest", "Hold the rock away from {} where it is"),
    LEVEL: ("Extend level", "Extend {} level to the border, and flatten it as far"),
    TREND: ("Extend along trend", "Extend {} along its trend to the border, and flatten it as far"),
}


@dataclass(frozen=True)
class Offer:
    """A button's label and tooltip, and what it does."""

    label: str
    tooltip: str
    act: Callable[[], None]


def offers(workspace: Workspace, finding: Finding) -> list[Offer]:
    """The ways out of a finding; none for most."""
    if finding.kind != "beyond" or finding.severity == "note":
        return []
    return [
        Offer(label, tooltip.format(finding.pick), partial(_choose, workspace, finding.pick or "", beyond))
        for beyond, (label, tooltip) in BEYOND.items()
    ]


def _choose(workspace: Workspace, horizon: str, beyond: str) -> None:
    """Choose what happens beyond the ends of a horizon, in each step that flattens it."""
    job = workspace.job
    steps = tuple(
        replace(step, beyond=beyond) if step.kind == FLATTEN and job.horizon(step).name == horizon else step
        for step in workspace.plan.steps
    )
    workspace.change_plan(f"{BEYOND[beyond][0].lower()} of {horizon}", steps=steps)
