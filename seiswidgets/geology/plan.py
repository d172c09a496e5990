"""Plans: the steps of a restoration in order, its weights and its mesh, as one value; and how a plan is carried out.

A preview (``RestorationJob.coarse``) approximates the restoration: its mesh is three times as coarse, its lines are
simplified to match, and each step takes two iterations from the preview before. Where lines are smooth it lies within a
few metres of the full restoration, about one sample. While only horizons move from one to the next, meshes are kept:
cut-offs lie between vertices of the faults, and the vertices at the corners of a flattened horizon move with them.
"""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, fields, replace
from itertools import takewhile

import numpy as np

from seiswidgets.core.solver import Progress
from seiswidgets.core.triangulation import DENSITY
from seiswidgets.errors import PickError, SettingError
from seiswidgets.geology import validation
from seiswidgets.geology.beyond import FREE, check_beyond
from seiswidgets.geology.passive import carried_finding
from seiswidgets.geology.picks import CONSTRAIN, MISSING, Fault, Horizon, Interpretation
from seiswidgets.geology.restoration import Restoration
from seiswidgets.geology.section import Section
from seiswidgets.geology.slip_profile import SlipProfile, checked_slip
from seiswidgets.geology.solve import GAUSS_NEWTON, SolverKeywords, SolverOptions
from seiswidgets.geology.stage import Stage
from seiswidgets.geology.weights import Weights

UNFAULT, FLATTEN = "unfault", "flatten"
UNUSED_WEIGHTS = {UNFAULT: ("flatten", "length"), FLATTEN: ("slide", "stitch", "rotation")}
COARSE, QUICK = 3.0, 2  # a preview's mesh spacing as a multiple of the full one, and its number of iterations
EDGES, VERTICES = 3, 100  # least numbers in a preview's mesh: edges along each pick, vertices in all


StepProgress = Callable[[int, int, float], bool | None]


@dataclass(frozen=True)
class Step:
    """One step of a plan.

    Parameters
    ----------
    kind : {"unfault", "flatten"}
    picks : tuple of str
        Names of the faults to slide along, or of the one horizon to flatten; a single name may be a string. By default
        all faults, or the first horizon.
    datum : float, optional
        The level to flatten to, in the section's unit of z; the horizon's mean level if left out.
    on : bool
        A step that is off is left out.
    slip : dict of str to SlipProfile
        Slip to undo along some of the faults, by name; see `Restoration.unfault`. Names of faults that the step does
        not slide along have no effect.
    beyond : {"free", "keep", "level", "trend"}
        What happens to the rock beyond the ends of the horizon; see `Restoration.flatten`.

    Raises
    ------
    SettingError
        If the kind or ``beyond`` is not one of these, the datum is not a finite number, or a slip is not a
        SlipProfile.
    """

    kind: str
    picks: tuple[str, ...] = ()
    datum: float | None = None
    on: bool = True
    slip: Mapping[str, SlipProfile] = field(default_factory=dict, hash=False)
    beyond: str = FREE

    def __post_init__(self) -> None:
        if self.kind not in (UNFAULT, FLATTEN):
            raise SettingError(f"a step must be {UNFAULT!r} or {FLATTEN!r}, but is {self.kind!r}")
        names: str | tuple[str, ...] = self.picks
        object.__setattr__(self, "picks", (names,) if isinstance(names, str) else tuple(names))
        if self.datum is not None:
            object.__setattr__(self, "datum", validation.finite_number("datum", self.datum))
        check_beyond(self.beyond)
        object.__setattr__(self, "slip", checked_slip(self.slip, tuple(self.slip or ())))


@dataclass(frozen=True)
class Plan:
    """The steps that restore a section, and the options that they share.

    Parameters
    ----------
    steps : tuple of Step
        In order; by default unfault, then flatten.
    weights, solver, weighting, max_iterations
        Options of each step; see `Restoration.unfault`.
    spacing : float, optional
        Mesh spacing, in metres of rock; see `Restoration`.
    fixed : (x, z), optional
        A point in the block that stays where it is, in the section's units.
    pins : tuple of (x, z)
    regional : float or tuple of (x, z), optional
        Points that stay, and a level that is kept; see `Restoration.unfault`.

    Raises
    ------
    SettingError
        If a choice is out of its range.
    PickError
        If ``fixed`` is not a point, or ``pins`` or ``regional`` are not points.

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
    regional: float | tuple[tuple[float, float], ...] | None = None
    weighting: str | None = None

    def __post_init__(self) -> None:
        object.__setattr__(self, "steps", tuple(self.steps))
        wrong = [step for step in self.steps if not isinstance(step, Step)]
        if wrong:
            raise SettingError(f"the steps of a plan must be seiswidgets.Step, but one is {wrong[0]!r}")
        SolverOptions(self.weights, self.solver, self.max_iterations, weighting=self.weighting)  # validates them
        if self.fixed is not None:
            object.__setattr__(self, "fixed", validation.held_point(self.fixed))
        object.__setattr__(self, "pins", validation.held_points("pins", self.pins))
        if isinstance(self.regional, int | float):
            object.__setattr__(self, "regional", validation.finite_number("regional", self.regional))
        elif self.regional is not None:
            object.__setattr__(self, "regional", validation.held_points("regional", self.regional))

    def restore(
        self,
        section: Section,
        interpretation: Interpretation,
        fixed: tuple[float, float] | None = None,
        progress: StepProgress | None = None,
    ) -> Restoration:
        """Carry the plan out, without the steps for which there are no faults or horizons.

        Parameters
        ----------
        section : Section
        interpretation : Interpretation
        fixed : (x, z), optional
            The held point, if it differs from the plan's own.
        progress : callable(step, iteration, energy), optional
            Called after each iteration, steps counted from 0; returning False cancels.

        Raises
        ------
        PickError, SettingError, FlippedError, Cancelled
            As for `Restoration.unfault`; PickError also if a step names a pick that does not exist.
        """
        plan = self if fixed is None else replace(self, fixed=fixed)
        return RestorationJob(section, interpretation, plan).restored(progress=progress)


@dataclass(frozen=True, eq=False)
class RestorationJob:
    """A plan for one section and its picks; it knows which stages of an earlier job it can reuse."""

    section: Section
    interpretation: Interpretation
    plan: Plan
    quick: bool = False

    @property
    def steps(self) -> list[Step]:
        """The steps that are on and have picks to use."""
        return [step for step in self.plan.steps if step.on and self._has_picks(step)]

    def _has_picks(self, step: Step) -> bool:
        if step.kind == FLATTEN:
            return bool(step.picks) or any(horizon.use == CONSTRAIN for horizon in self.interpretation.horizons)
        unused = {fault.name for fault in self.interpretation.faults if fault.use != CONSTRAIN}
        return not unused.issuperset(step.picks or [fault.name for fault in self.interpretation.faults])

    @property
    def start(self) -> Restoration:
        """The restoration before the first step."""
        return Restoration(self.section, self.plan.spacing, quick=self.quick, bodies=self.interpretation.bodies)

    @property
    def coarse(self) -> "RestorationJob":
        """The job of a preview: on a coarser mesh, with simpler lines, in few iterations."""
        domain = self.start.domain
        few = np.sqrt(domain.outline.area * DENSITY / VERTICES)
        spacing = max(domain.spacing, float(min(COARSE * domain.spacing, few, self._shortest / EDGES)))
        return replace(self, plan=replace(self.plan, spacing=spacing, max_iterations=QUICK), quick=True)

    @property
    def _shortest(self) -> float:
        """Length of the shortest pick, in metres of rock; of a horizon, its longest piece counts."""
        drawn: list[Fault | Horizon] = [*self.interpretation.faults, *self.interpretation.horizons]
        picks = [pick for pick in drawn if pick.constrains]
        return min((max(map(self._length, _lines(pick))) for pick in picks), default=np.inf)

    def _length(self, line: Sequence[Sequence[float]]) -> float:
        return float(np.hypot(*np.diff(self.section.to_rock(np.array(line)), axis=0).T).sum())

    def restored(
        self,
        earlier: tuple["RestorationJob", Restoration] | None = None,
        progress: StepProgress | None = None,
    ) -> Restoration:
        """Run the plan, reusing or warm-starting the stages of an earlier job.

        A step without a pick that can be used is skipped, if there are others; ``Restoration.skipped`` says why.
        """
        restoration = self.start
        stages = earlier[1].stages if earlier else ()
        reusable = self._count_reusable(earlier[0]) if earlier and not earlier[1].skipped else 0
        for index, step in enumerate(self.steps):
            if index < reusable:
                restoration = replace(restoration, stages=stages[: index + 1])
                continue
            start = stages[index] if index < len(stages) and stages[index].kind == step.kind else None
            try:
                restoration = self._carry_out(restoration, step, start, progress and _of_step(progress, index))
            except PickError as error:
                if error.pick is None or error.kind == MISSING or len(self.steps) == 1:
                    raise
                restoration = replace(restoration, skipped=(*restoration.skipped, carried_finding(error)))
        return restoration

    def _carry_out(
        self, restoration: Restoration, step: Step, start: Stage | None, progress: Progress | None
    ) -> Restoration:
        options: SolverKeywords = {
            "weights": self.plan.weights,
            "solver": self.plan.solver,
            "weighting": self.plan.weighting,
            "max_iterations": self.plan.max_iterations,
            "progress": progress,
            "start": start,
        }
        if step.kind == UNFAULT:
            faults, horizons, others = self.faults(step), self.interpretation.horizons, self.boundaries(step)
            fixed, pins, regional, slip = self.plan.fixed, self.plan.pins, self.plan.regional, self.slip(step)
            return restoration.unfault(
                faults, horizons, boundaries=others, fixed=fixed, pins=pins, regional=regional, slip=slip, **options
            )
        beyond, beds = step.beyond, self._beds
        return restoration.flatten(self.horizon(step), datum=step.datum, beyond=beyond, beds=beds, **options)

    @property
    def _beds(self) -> Sequence[Horizon]:
        """The horizons that give the direction of the beds, if the plan asks for it."""
        return self.interpretation.horizons if self.plan.weights.bedding else ()

    def faults(self, step: Step) -> list[Fault]:
        """The faults that a step slides along; PickError if one does not exist."""
        return [self.interpretation.fault(name) for name in step.picks] or list(self.interpretation.faults)

    def slip(self, step: Step) -> dict[str, SlipProfile]:
        """The slip prescribed for the faults that a step slides along."""
        return {fault.name: step.slip[fault.name] for fault in self.faults(step) if fault.name in step.slip}

    def boundaries(self, step: Step) -> list[Fault]:
        """The faults that a step does not restore."""
        return [fault for fault in self.interpretation.faults if fault not in self.faults(step)]

    def horizon(self, step: Step) -> Horizon:
        """The horizon that a step flattens; PickError if it does not exist."""
        if len(step.picks) > 1:
            raise PickError(
                f"one horizon is flattened at a time, but a step names {', '.join(map(repr, step.picks))}",
                kind=MISSING,
                pick=step.picks[1],
            )
        if step.picks:
            return self.interpretation.horizon(step.picks[0])
        return next(horizon for horizon in self.interpretation.horizons if horizon.use == CONSTRAIN)

    def _count_reusable(self, earlier: "RestorationJob") -> int:
        """Number of leading steps that have the same inputs as in an earlier job."""
        if earlier.section is not self.section:
            return 0
        pairs = zip(self._inputs(), earlier._inputs(), strict=False)
        return sum(1 for _ in takewhile(lambda pair: pair[0] == pair[1], pairs))

    def _inputs(self) -> Iterator[tuple]:
        """Everything that each step depends on, apart from the section and the steps before it."""
        bodies = [(body.name, body.points.tolist()) for body in self.interpretation.bodies]
        shared = (
            bodies,
            self.plan.solver,
            self.plan.weighting,
            self.plan.spacing,
            self.plan.max_iterations,
            self.quick,
        )
        for step in self.steps:
            picks: list[Fault | Horizon] = [self.horizon(step)] if step.kind == FLATTEN else [*self.faults(step)]
            picks += [*self.boundaries(step), *self.interpretation.horizons] if step.kind == UNFAULT else self._beds
            names = [field.name for field in fields(Weights) if field.name not in UNUSED_WEIGHTS[step.kind]]
            weights = [getattr(self.plan.weights, name) for name in names]
            holds = (self.plan.fixed, self.plan.pins, self.plan.regional) if step.kind == UNFAULT else ()
            lines = [
                (pick.name, pick.use, pick.ends if isinstance(pick, Fault) else "", *_lines(pick)) for pick in picks
            ]
            count = len(self.faults(step)) if step.kind == UNFAULT else 0
            slip = self.slip(step) if step.kind == UNFAULT else {}
            yield step.kind, step.datum, step.beyond, holds, count, lines, weights, slip, shared


def _lines(pick: Fault | Horizon) -> list[list[list[float]]]:
    pieces = (pick.points,) if isinstance(pick, Fault) else pick.pieces
    return [piece.tolist() for piece in pieces]


def _of_step(progress: StepProgress, index: int) -> Progress:
    """Adapt a callback that wants the step's index to a solver's, which knows no steps."""

    def report(iteration: int, energy: float, vertices: np.ndarray) -> bool | None:
        return progress(index, iteration, energy)

    return report
