"""Hypotheses: an interpretation of a section with a plan to restore it, and what slips and velocities change in it."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from seiswidgets.geology.bodies import Body
from seiswidgets.geology.picks import Horizon, Interpretation
from seiswidgets.geology.plan import Plan, RestorationJob
from seiswidgets.geology.restoration import Restoration
from seiswidgets.geology.section import Section
from seiswidgets.geology.slip_profile import SlipProfile
from seiswidgets.geology.validation import checked_kind

Point = tuple[float, float]
Level = float | tuple[Point, ...] | None

FIRST_NAME = "A"  # of a section's only hypothesis


@dataclass(frozen=True, eq=False)
class Hypothesis:
    """An interpretation of a section, and the plan to restore it.

    Parameters
    ----------
    section : Section
    interpretation : Interpretation
    plan : Plan
    name : str

    Raises
    ------
    SettingError
        If one of them has the wrong type.
    """

    section: Section
    interpretation: Interpretation
    plan: Plan = field(default_factory=Plan)
    name: str = FIRST_NAME

    def __post_init__(self) -> None:
        for name, kind in (("section", Section), ("interpretation", Interpretation), ("plan", Plan), ("name", str)):
            checked_kind(getattr(self, name), kind, name)

    def restored(self) -> Restoration:
        """Carry the plan out; errors as for `Plan.restore`."""
        return RestorationJob(self.section, self.interpretation, self.plan).restored()


def with_slip(hypothesis: Hypothesis, slip: Mapping[str, SlipProfile]) -> Hypothesis:
    """A hypothesis whose plan prescribes the slip along some faults; see `Plan.with_slip`."""
    plan = hypothesis.plan
    for fault, profile in slip.items():
        plan = plan.with_slip(fault, profile)
    return replace(hypothesis, plan=plan)


def with_velocity(hypothesis: Hypothesis, factor: float) -> Hypothesis:
    """A hypothesis in which the velocity is a multiple of what it was: in depth, all depths grow with it.

    Slips, measured along faults, grow as if those were upright.
    """
    if factor == 1:
        return hypothesis
    section, plan = hypothesis.section, hypothesis.plan
    steps = tuple(
        replace(step, slip={name: _grown(profile, factor) for name, profile in step.slip.items()})
        for step in plan.steps
    )
    hypothesis = replace(hypothesis, plan=replace(plan, steps=steps))
    if section.velocity is not None:
        return replace(hypothesis, section=replace(section, velocity=section.velocity * factor))
    return _deepened(hypothesis, factor)


def _grown(profile: SlipProfile, factor: float) -> SlipProfile:
    return SlipProfile(*(tuple(factor * value for value in values) for values in (profile.s, profile.slip)))


def _deepened(hypothesis: Hypothesis, factor: float) -> Hypothesis:
    section, picks, plan = hypothesis.section, hypothesis.interpretation, hypothesis.plan
    scale = np.array([1.0, factor])

    def deeper(rows: Sequence[Point]) -> tuple[Point, ...]:
        return tuple((x, z * factor) for x, z in rows)

    def deeper_level(level: Level) -> Level:
        return None if level is None else level * factor if isinstance(level, int | float) else deeper(level)

    horizons = [
        Horizon(*(piece * scale for piece in pick.pieces), name=pick.name, use=pick.use) for pick in picks.horizons
    ]
    return replace(
        hypothesis,
        section=replace(section, dz=section.dz * factor, z0=section.z0 * factor),
        interpretation=Interpretation(
            [replace(pick, points=pick.points * scale) for pick in picks.faults],
            horizons,
            [Body(body.points * scale, body.kind, body.name) for body in picks.bodies],
        ),
        plan=replace(
            plan,
            steps=tuple(replace(step, datum=deeper_level(step.datum)) for step in plan.steps),
            fixed=deeper([plan.fixed])[0] if plan.fixed else None,
            pins=deeper(plan.pins),
            regional=deeper_level(plan.regional),
        ),
    )
