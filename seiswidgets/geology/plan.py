"""What a restoration is to do, as one value: its steps in order, the weights, the mesh; and how it is carried out.

A preview (``RestorationJob.coarse``) approximates the restoration: its mesh is three times as coarse, its lines are
simplified to match, and each step takes two iterations from the preview before. Where lines are smooth it lies within a
few metres of the full restoration, about one sample.
"""

from collections.abc import Callable
from dataclasses import dataclass, field, fields, replace
from functools import partial

import numpy as np

from seiswidgets.core.triangulation import DENSITY
from seiswidgets.errors import PickError, SettingError
from seiswidgets.geology import validation
from seiswidgets.geology.picks import Fault, Horizon, Interpretation
from seiswidgets.geology.restoration import Restoration
from seiswidgets.geology.section import Section
from seiswidgets.geology.solve import GAUSS_NEWTON, MOST_ITERATIONS
from seiswidgets.geology.weights import Weights

UNFAULT, FLATTEN = "unfault", "flatten"
OTHER_WEIGHTS = {UNFAULT: ("flatten", "length"), FLATTEN: ("slide", "stitch")}  # that a step has no use for
COARSE, QUICK = 3.0, 2  # times the mesh spacing, and iterations, of a quick look
EDGES, VERTICES = 3, 100  # that a quick look's mesh has at least: along each pick, and in all


@dataclass(frozen=True)
class Step:
    """One step of a plan.

    Parameters
    ----------
    kind : {"unfault", "flatten"}
    picks : tuple of str
        Names of the faults to slide along, or of the one horizon to flatten; one name may stand alone. If left out: all
        faults; the first horizon.
    datum : float, optional
        The level to flatten to, in the section's unit of z; the horizon's mean level if left out.
    on : bool
        A step that is off is left out.

    Raises
    ------
    SettingError
        If there is no such kind of step.
    """

    kind: str
    picks: tuple[str, ...] = ()
    datum: float | None = None
    on: bool = True

    def __post_init__(self):
        if self.kind not in (UNFAULT, FLATTEN):
            raise SettingError(f"a step must be {UNFAULT!r} or {FLATTEN!r}, but is {self.kind!r}")
        object.__setattr__(self, "picks", (self.picks,) if isinstance(self.picks, str) else tuple(self.picks))
        if self.datum is not None:
            object.__setattr__(self, "datum", validation.finite_number("datum", self.datum))


@dataclass(frozen=True)
class Plan:
    """The steps that restore a section, and the choices that they share; see `Restoration` for each.

    Parameters
    ----------
    steps : tuple of Step
        In order; to unfault and then to flatten, if left out.
    weights : Weights
    solver : {"gauss-newton", "fixed-point"}
    spacing : float, optional
        Of the mesh, in metres of rock.
    max_iterations : int, optional
        Of each step.
    fixed : (x, z), optional
        A point in the block that stays where it is, in the section's units.
    pins : tuple of (x, z)
    regional : optional
        Reserved for points and a level that hold the far field; not supported yet.

    Raises
    ------
    SettingError
        If a choice is out of its range, or pins or a regional level are given.
    PickError
        If ``fixed`` is not a point.

    Examples
    --------
    >>> import seiswidgets as sw
    >>> case = sw.synthetic.faulted_fold()
    >>> restored = sw.Plan(fixed=case.fixed).restore(case.section, case.interpretation)
    >>> [stage.kind for stage in restored.stages]
    ['unfault', 'flatten']
    """

    steps: tuple[Step, ...] = (Step(UNFAULT), Step(FLATTEN))
    weights: Weights = field(default_factory=Weights)
    solver: str = GAUSS_NEWTON
    spacing: float | None = None
    max_iterations: int | None = None
    fixed: tuple[float, float] | None = None
    pins: tuple[tuple[float, float], ...] = ()
    regional: float | None = None

    def __post_init__(self):
        object.__setattr__(self, "steps", tuple(self.steps))
        wrong = [step for step in self.steps if not isinstance(step, Step)]
        if wrong:
            raise SettingError(f"the steps of a plan must be seiswidgets.Step, but one is {wrong[0]!r}")
        if not isinstance(self.weights, Weights):
            raise SettingError(f"the weights of a plan must be seiswidgets.Weights, but are {self.weights!r}")
        if self.solver not in MOST_ITERATIONS:
            raise SettingError(f"solver must be {' or '.join(map(repr, MOST_ITERATIONS))}, but is {self.solver!r}")
        if self.fixed is not None:
            object.__setattr__(self, "fixed", validation.held_point(self.fixed))
        if self.pins or self.regional is not None:
            raise SettingError("pins and a regional level are not supported yet; hold a block by fixed instead")

    def restore(self, section: Section, interpretation: Interpretation, fixed=None, progress=None) -> Restoration:
        """Carry the plan out; steps that have nothing to work on, for want of faults or horizons, are left out.

        Parameters
        ----------
        section : Section
        interpretation : Interpretation
        fixed : (x, z), optional
            The held point, if it is not the plan's own.
        progress : callable(step, iteration, energy), optional
            Called after each iteration, steps counted from 0; returning False cancels.

        Raises
        ------
        PickError, SettingError, FlippedError, Cancelled
            As for `Restoration.unfault`; PickError also if a step names a pick that is not there.
        """
        plan = self if fixed is None else replace(self, fixed=fixed)
        return RestorationJob(section, interpretation, plan).restored(progress=progress)


@dataclass(frozen=True, eq=False)
class RestorationJob:
    """A plan for the picks of one section, which knows what of an earlier task's result can be used again."""

    section: Section
    interpretation: Interpretation
    plan: Plan
    quick: bool = False

    @property
    def steps(self) -> list[Step]:
        """Those that are on and have something to work on."""
        there = {UNFAULT: bool(self.interpretation.faults), FLATTEN: bool(self.interpretation.horizons)}
        return [step for step in self.plan.steps if step.on and (step.picks or there[step.kind])]

    @property
    def coarse(self) -> "RestorationJob":
        """The same for a quick look from an earlier one: on a coarser mesh with simpler lines, in few iterations."""
        domain = Restoration(self.section, self.plan.spacing).domain
        few = np.sqrt(domain.outline.area * DENSITY / VERTICES)
        spacing = max(domain.spacing, float(min(COARSE * domain.spacing, few, self._shortest / EDGES)))
        return replace(self, plan=replace(self.plan, spacing=spacing, max_iterations=QUICK), quick=True)

    @property
    def _shortest(self):
        """Length of the shortest fault, or of the longest piece of a horizon if that is less; in metres of rock."""
        picks = (*self.interpretation.faults, *self.interpretation.horizons)
        return min((max(map(self._length, _lines(pick))) for pick in picks), default=np.inf)

    def _length(self, line):
        return float(np.hypot(*np.diff(self.section.to_rock(np.array(line)), axis=0).T).sum())

    def restored(
        self,
        earlier: tuple["RestorationJob", Restoration] | None = None,
        progress: Callable[[int, int, float], bool | None] | None = None,
    ) -> Restoration:
        """What the task comes to; stages of an earlier one are taken, or started from."""
        restoration = Restoration(self.section, self.plan.spacing, quick=self.quick)
        stages = earlier[1].stages if earlier else ()
        same = self._alike(earlier[0]) if earlier else 0
        for number, step in enumerate(self.steps):
            if number < same:
                restoration = replace(restoration, stages=stages[: number + 1])
                continue
            start = stages[number] if number < len(stages) and stages[number].kind == step.kind else None
            told = progress and partial(_told, progress, number)
            restoration = self._made(restoration, step, start, told)
        return restoration

    def _made(self, restoration, step, start, progress):
        choices = {"weights": self.plan.weights, "solver": self.plan.solver, "progress": progress, "start": start}
        choices["max_iterations"] = self.plan.max_iterations
        if step.kind == UNFAULT:
            faults, horizons = self._faults(step), self.interpretation.horizons
            return restoration.unfault(faults, horizons, fixed=self.plan.fixed, **choices)
        return restoration.flatten(self._horizon(step), datum=step.datum, **choices)

    def _faults(self, step) -> list[Fault]:
        return [self.interpretation.fault(name) for name in step.picks] or list(self.interpretation.faults)

    def _horizon(self, step) -> Horizon:
        if len(step.picks) > 1:
            raise PickError(f"one horizon is flattened at a time, but a step names {', '.join(map(repr, step.picks))}")
        return self.interpretation.horizon(step.picks[0]) if step.picks else self.interpretation.horizons[0]

    def _alike(self, other):
        """How many steps from the first ask for the same on the same section."""
        if other.section is not self.section:
            return 0
        pairs = zip(self._keys(), other._keys(), strict=False)
        return next(
            (number for number, (one, two) in enumerate(pairs) if one != two), min(len(self.steps), len(other.steps))
        )

    def _keys(self):
        """What each step depends on, apart from the section and the steps before it."""
        for step in self.steps:
            picks = (
                [*self._faults(step), *self.interpretation.horizons] if step.kind == UNFAULT else [self._horizon(step)]
            )
            weights = [
                getattr(self.plan.weights, f.name) for f in fields(Weights) if f.name not in OTHER_WEIGHTS[step.kind]
            ]
            fixed = self.plan.fixed if step.kind == UNFAULT else None
            lines = [(pick.name, *_lines(pick)) for pick in picks]
            yield (
                step.kind,
                step.datum,
                fixed,
                lines,
                weights,
                self.plan.solver,
                self.plan.spacing,
                self.plan.max_iterations,
                self.quick,
            )


def _lines(pick):
    pieces = (pick.points,) if isinstance(pick, Fault) else pick.pieces
    return [np.asarray(piece).tolist() for piece in pieces]


def _told(progress, number, iteration, energy, vertices):
    return progress(number, iteration, energy)
