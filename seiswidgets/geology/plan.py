"""Plans: the steps of a restoration in order, its weights and its mesh, as one value; and how a plan is carried out.

A preview (``RestorationJob.coarse``) approximates the restoration: its mesh is three times as coarse, its lines are
simplified to match, and each step takes two iterations from the preview before. Where lines are smooth it lies within a
few metres of the full restoration, about one sample. While only horizons move from one to the next, meshes are kept:
cut-offs lie between vertices of the faults, and the vertices at the corners of a flattened horizon move with them.
"""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, fields, replace
from itertools import takewhile
from typing import Any

import numpy as np

from seiswidgets.core.solver import Progress
from seiswidgets.core.triangulation import DENSITY
from seiswidgets.errors import PickError, SettingError
from seiswidgets.geology import validation
from seiswidgets.geology.flexure import BEYONDS, MIRROR, Isostasy
from seiswidgets.geology.passive import carried_finding
from seiswidgets.geology.picks import CONSTRAIN, MISSING, Fault, Horizon, Interpretation
from seiswidgets.geology.restoration import Restoration
from seiswidgets.geology.section import Section
from seiswidgets.geology.sequence import FaultActivity, sequential_steps
from seiswidgets.geology.slip_profile import SlipProfile
from seiswidgets.geology.solve import GAUSS_NEWTON, SolverKeywords, SolverOptions
from seiswidgets.geology.stage import DECOMPACT, ISOSTASY, STRIP, UNERODE, Stage
from seiswidgets.geology.steps import FLATTEN, ON_A_HORIZON, UNFAULT, WITH_LAYERS, Step
from seiswidgets.geology.stratigraphy import Stratigraphy
from seiswidgets.geology.vertical_shear import VERTICAL_SHEAR
from seiswidgets.geology.weights import Weights

UNUSED_WEIGHTS = {UNFAULT: ("flatten", "length"), FLATTEN: ("slide", "stitch", "rotation")}
COARSE, QUICK = 3.0, 2  # a preview's mesh spacing as a multiple of the full one, and its number of iterations
EDGES, VERTICES = 3, 100  # least numbers in a preview's mesh: edges along each pick, vertices in all


StepProgress = Callable[[int, int, float], bool | None]


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
    stratigraphy : Stratigraphy, optional
        The layers, for the steps "decompact" and "isostasy", which are left out without it.
    isostasy : Isostasy, optional
        The crust, for the step "isostasy"; Airy's by default.
    load_beyond : {"mirror", "constant", "zero"}
        The load beyond the section; see `Restoration.isostasy`.

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
    stratigraphy: Stratigraphy | None = None
    isostasy: Isostasy | None = None
    load_beyond: str = MIRROR

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
        if self.stratigraphy is not None:
            validation.checked_kind(self.stratigraphy, Stratigraphy, "stratigraphy")
        if self.isostasy is not None:
            validation.checked_kind(self.isostasy, Isostasy, "isostasy")
        if self.load_beyond not in BEYONDS:
            raise SettingError(f"load_beyond must be {', '.join(map(repr, BEYONDS))}, but is {self.load_beyond!r}")

    @classmethod
    def sequential(
        cls,
        stratigraphy: Stratigraphy,
        interpretation: Interpretation,
        *,
        activity: FaultActivity | Mapping[str, Sequence[str]] | None = None,
        decompact: bool = True,
        isostasy: Isostasy | None = None,
        unfold: str = VERTICAL_SHEAR,
        **options: Any,
    ) -> "Plan":
        """The plan that takes a section back through time, from the youngest layer to the oldest.

        For each top in turn it strips what lies above, undoes the slip of the faults that moved before the next younger
        top was laid down, lets the rest expand, lets the crust rise, and brings the top to its depth below the sea.

        Parameters
        ----------
        stratigraphy : Stratigraphy
        interpretation : Interpretation
        activity : FaultActivity, or dict of str to list of str, optional
            Which faults moved when, if not as `FaultActivity.of` derives it: the names of the faults whose slip is
            undone when a top is the surface, by the name of that top.
        decompact : bool
            False leaves out compaction.
        isostasy : Isostasy, optional
            Left out without it. Its sea level is the one that water depths are measured from, otherwise z = 0.
        unfold : {"vertical shear", "length"}
            How a top is brought to its depth; see `Restoration.flatten`.
        **options
            Other fields of the plan, such as ``fixed``.

        Raises
        ------
        PickError
            If a top does not exist.
        SettingError
            If no layer has a horizon at its top.
        """
        validation.checked_kind(stratigraphy, Stratigraphy, "stratigraphy")
        validation.checked_kind(interpretation, Interpretation, "interpretation")
        activity = FaultActivity.of(stratigraphy, interpretation) if activity is None else activity
        if isinstance(activity, FaultActivity):
            activity = {top: activity.moved(top) for top in stratigraphy.tops}
        steps = sequential_steps(
            stratigraphy,
            activity,
            decompact=decompact,
            isostasy=isostasy is not None,
            unfold=unfold,
            sea_level=(isostasy.sea_level or 0.0) if isostasy else 0.0,
        )
        return cls(steps, stratigraphy=stratigraphy, isostasy=isostasy, **options)

    def slip_of(self, fault: str) -> SlipProfile | None:
        """The slip that is prescribed for a fault, in the first step that slides along it; None if there is none."""
        return next((step.slip.get(fault) for step in self.steps if step.slides_along(fault)), None)

    def with_slip(self, fault: str, slip: SlipProfile | None) -> "Plan":
        """Prescribe the slip of a fault, or None to match horizons, in the first step that slides along it.

        Without such a step, one is added before the others.
        """
        steps = self.steps
        if slip is not None and not any(step.slides_along(fault) for step in steps):
            steps = (Step(UNFAULT, (fault,)), *steps)
        index = next((index for index, step in enumerate(steps) if step.slides_along(fault)), None)
        if index is None:
            return self
        others = {name: profile for name, profile in steps[index].slip.items() if name != fault}
        changed = replace(steps[index], slip=others if slip is None else others | {fault: slip})
        return replace(self, steps=(*steps[:index], changed, *steps[index + 1 :]))

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
        if step.kind in WITH_LAYERS:
            return self.plan.stratigraphy is not None
        if step.kind in ON_A_HORIZON:
            return bool(step.picks) or any(horizon.use == CONSTRAIN for horizon in self.interpretation.horizons)
        unused = {fault.name for fault in self.interpretation.faults if fault.use != CONSTRAIN}
        return step.kind == UNERODE or not unused.issuperset(
            step.picks or [fault.name for fault in self.interpretation.faults]
        )

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
        if step.kind not in (UNFAULT, FLATTEN):
            return self._step_in_time(restoration, step, progress)
        options: SolverKeywords = {
            "weights": self.plan.weights,
            "solver": self.plan.solver,
            "weighting": self.plan.weighting,
            "max_iterations": self.plan.max_iterations,
            "progress": progress,
            "start": start,
        }
        if step.kind == UNFAULT:
            return restoration.unfault(
                self.faults(step),
                self.horizons(step),
                boundaries=self.boundaries(step),
                fixed=self.plan.fixed,
                pins=self.plan.pins,
                regional=self.plan.regional,
                slip=self.slip(step),
                age=step.age,
                **options,
            )
        return restoration.flatten(
            self.horizon(step),
            datum=step.datum,
            by=step.by,
            beyond=step.beyond,
            beds=self._beds,
            age=step.age,
            **options,
        )

    def _step_in_time(self, restoration: Restoration, step: Step, progress: Progress | None) -> Restoration:
        """Carry out a step that needs no solver."""
        plan, picks = self.plan, self.interpretation
        if step.kind == STRIP:
            return restoration.strip(self.horizon(step), faults=picks.faults, age=step.age, progress=progress)
        if step.kind == UNERODE and step.datum is not None:
            return restoration.unerode(step.datum, age=step.age, progress=progress)
        layers = plan.stratigraphy
        if layers is None:
            raise SettingError(f"the step {step.kind} needs a stratigraphy; give the plan one")
        if step.kind == DECOMPACT:
            return restoration.decompact(layers, picks, age=step.age, progress=progress)
        crust = plan.isostasy or Isostasy()
        return restoration.isostasy(crust, layers, picks, beyond=plan.load_beyond, age=step.age, progress=progress)

    @property
    def _beds(self) -> Sequence[Horizon]:
        """The horizons that give the direction of the beds, if the plan asks for it."""
        return self.interpretation.horizons if self.plan.weights.bedding else ()

    def faults(self, step: Step) -> list[Fault]:
        """The faults that a step slides along; PickError if one does not exist."""
        return [self.interpretation.fault(name) for name in step.picks] or list(self.interpretation.faults)

    def horizons(self, step: Step) -> Sequence[Horizon]:
        """The horizons that a step matches across faults; PickError if one does not exist."""
        return [self.interpretation.horizon(name) for name in step.horizons] or self.interpretation.horizons

    def slip(self, step: Step) -> dict[str, SlipProfile]:
        """The slip prescribed for the faults that a step slides along."""
        return {fault.name: step.slip[fault.name] for fault in self.faults(step) if fault.name in step.slip}

    def boundaries(self, step: Step) -> list[Fault]:
        """The faults that a step does not restore."""
        return [fault for fault in self.interpretation.faults if fault not in self.faults(step)]

    def horizon(self, step: Step) -> Horizon:
        """The horizon that a step flattens or strips down to; PickError if it does not exist."""
        if len(step.picks) > 1:
            raise PickError(
                f"a step takes one horizon at a time, but a step names {', '.join(map(repr, step.picks))}",
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
            names = [field.name for field in fields(Weights) if field.name not in UNUSED_WEIGHTS.get(step.kind, ())]
            weights = [getattr(self.plan.weights, name) for name in names if step.kind in UNUSED_WEIGHTS]
            holds = (self.plan.fixed, self.plan.pins, self.plan.regional) if step.kind == UNFAULT else ()
            crust = (self.plan.isostasy, self.plan.load_beyond) if step.kind == ISOSTASY else ()
            layers = (self.plan.stratigraphy, crust) if step.kind in WITH_LAYERS else ()
            lines = [
                (pick.name, pick.use, pick.ends if isinstance(pick, Fault) else "", *_lines(pick))
                for pick in self._picks(step)
            ]
            count = len(self.faults(step)) if step.kind == UNFAULT else 0
            slip = self.slip(step) if step.kind == UNFAULT else {}
            options = step.kind, step.datum, step.by, step.beyond, step.age
            yield options, holds, count, lines, weights, slip, layers, shared

    def _picks(self, step: Step) -> list[Fault | Horizon]:
        """The picks that a step depends on."""
        faults = list(self.interpretation.faults)
        if step.kind == UNFAULT:
            return [*self.faults(step), *self.boundaries(step), *self.horizons(step)]
        if step.kind == FLATTEN:
            return [self.horizon(step), *self._beds]
        if step.kind == STRIP:
            return [self.horizon(step), *faults]
        tops = self.plan.stratigraphy.tops if self.plan.stratigraphy and step.kind in WITH_LAYERS else []
        return [*(self.interpretation.horizon(top) for top in tops), *(faults if tops else [])]


def _lines(pick: Fault | Horizon) -> list[list[list[float]]]:
    pieces = (pick.points,) if isinstance(pick, Fault) else pick.pieces
    return [piece.tolist() for piece in pieces]


def _of_step(progress: StepProgress, index: int) -> Progress:
    """Adapt a callback that wants the step's index to a solver's, which knows no steps."""

    def report(iteration: int, energy: float, vertices: np.ndarray) -> bool | None:
        return progress(index, iteration, energy)

    return report
