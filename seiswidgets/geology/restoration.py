"""The restoration of a section: a chain of stages, each made from the one before."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Unpack

import numpy as np
import shapely
from numpy.typing import ArrayLike
from shapely import LineString

from seiswidgets.core.solver import Progress
from seiswidgets.errors import PickError, SettingError
from seiswidgets.geology import validation
from seiswidgets.geology.beyond import FREE, check_beyond
from seiswidgets.geology.bodies import Body, body_polygons, without_bodies
from seiswidgets.geology.decompaction import decompact_stage
from seiswidgets.geology.domain import RestorationDomain
from seiswidgets.geology.erosion import unerode_stage
from seiswidgets.geology.findings import Finding, worst_first
from seiswidgets.geology.flattening import flatten_stage
from seiswidgets.geology.flexure import MIRROR, Isostasy
from seiswidgets.geology.picks import Fault, Horizon, Interpretation
from seiswidgets.geology.rebound import isostasy_stage
from seiswidgets.geology.report import verdict
from seiswidgets.geology.section import Section
from seiswidgets.geology.slip_profile import SlipProfile, checked_slip
from seiswidgets.geology.solve import SolverKeywords, SolverOptions
from seiswidgets.geology.stage import ISOSTASY, STRIP, UNERODE, Stage
from seiswidgets.geology.stratified_rock import StratifiedRock, fault_lines_of
from seiswidgets.geology.stratigraphy import Profile, Stratigraphy, checked_profile
from seiswidgets.geology.stripping import strip_stage
from seiswidgets.geology.transfer import (
    OUTSIDE,
    area_ratio_at,
    carried_body,
    carried_fault,
    carried_horizon,
    picture,
)
from seiswidgets.geology.unfaulting import unfault_stage
from seiswidgets.geology.usable_picks import Beds, EndsOfFaults, Lines, Regional, UsablePicks
from seiswidgets.geology.vertical_shear import FLATTENINGS, LENGTH, VERTICAL_SHEAR, shear_flat_stage


@dataclass(frozen=True, eq=False)
class Restoration:
    """A section and the stages that restore it.

    A value: `unfault` and `flatten` return a new one with one more stage. Stages can be chained in any order; faults,
    horizons and held points are always given in the coordinates of the original section.

    Parameters
    ----------
    original : Section
        The present-day section.
    spacing : float, optional
        Typical length of the mesh's edges, in metres of rock; by default such that a mesh has about 2,500 vertices.
    stages : tuple of Stage
        The stages so far.
    quick : bool
        True if lines may lose details that are small beside the mesh spacing, for a preview.
    skipped : tuple of Finding
        The reasons why steps of a plan were skipped.
    bodies : list of Body, optional
        Areas that are left out of the mesh.

    Raises
    ------
    SettingError
        If the spacing is not above 0.
    PickError
        From its first step on, if a body lies outside the section.

    Examples
    --------
    >>> import seiswidgets as sw
    >>> case = sw.synthetic.faulted_fold()
    >>> picks = case.interpretation
    >>> unfaulted = sw.Restoration(case.section).unfault(picks.faults, picks.horizons, fixed=case.fixed)
    >>> restored = unfaulted.flatten(picks.horizons[0])
    >>> [stage.report.converged for stage in restored.stages]
    [True, True]
    """

    original: Section
    spacing: float | None = None
    stages: tuple[Stage, ...] = ()
    quick: bool = False
    skipped: tuple[Finding, ...] = ()
    bodies: Sequence[Body] = ()

    def __post_init__(self) -> None:
        if not isinstance(self.original, Section):
            raise SettingError(
                f"a restoration starts from a seiswidgets.Section, but got a {type(self.original).__name__}"
            )
        if self.spacing is not None:
            spacing = validation.finite_number("spacing", self.spacing)
            if spacing <= 0:
                raise SettingError(f"spacing must be above 0 m, but is {spacing:g}")
            object.__setattr__(self, "spacing", spacing)

    def unfault(
        self,
        faults: Fault | Sequence[Fault],
        horizons: Horizon | Sequence[Horizon] = (),
        *,
        boundaries: Fault | Sequence[Fault] = (),
        fixed: tuple[float, float] | None = None,
        pins: Sequence[tuple[float, float]] = (),
        regional: Regional = None,
        slip: Mapping[str, SlipProfile] | None = None,
        age: float | None = None,
        **options: Unpack[SolverKeywords],
    ) -> "Restoration":
        """Slide the blocks back along some faults until the horizons match across them (the paper's section 3.1).

        Parameters
        ----------
        faults : Fault or list of Fault
            Those whose ``use`` is "constrain".
        horizons : Horizon or list of Horizon
            Each fault needs at least one that meets it on both sides, or its ``slip``. A fault without, and any other
            pick that cannot be used as it was drawn, is carried along with the rock, and the report has a finding.
        boundaries : Fault or list of Fault
            The other faults of the interpretation, such as older ones that are restored later: no bed crosses them,
            and the rock does not slip along them, except where one of ``faults`` ends at a boundary and can continue
            along it without a sharp turn, as thrusts do on a common floor. Those among ``faults`` are left out.
        fixed : (x, z), optional
            A point in the block that stays exactly where it is; if faults die out inside that block, its far field on
            this side of them does. If nothing is held both sides of every fault move, and of all solutions that differ
            by a rigid motion the one that moves least is taken.
        pins : list of (x, z), optional
            Points that stay exactly where they are.
        regional : float or list of (x, z), optional
            A level that both ends of the section keep, in the unit of z, or a line of points that keep their depth.
        slip : dict of str to SlipProfile, optional
            Slip to undo along some of the faults, by name, in place of matching horizons there; such a fault needs
            none. At an end where a fault dies out the slip is reduced to 0.
        age : float, optional
            Time that the section after it stands for, in Ma.
        weights : Weights, optional
            Those of the paper if left out.
        solver : {"gauss-newton", "fixed-point"}
            The second is the paper's (eq. 16), kept for teaching and comparison.
        weighting : {"norms", "rows"}, optional
            What the weights multiply: the squared norm of each term, as in the paper's eqs. 12 and 13, or its rows, as
            in its eq. 14. By default rows for Gauss-Newton, and for the fixed point norms, with which it is far better.
        max_iterations : int, optional
            By default 200 Gauss-Newton steps, or 1000 of the fixed point. A solver that has not settled by then says
            so in the report.
        progress : callable(iteration, energy, vertices), optional
            Called after each iteration; returning False cancels.
        start : Stage, optional
            An earlier solution of a similar problem, to start from.

        Raises
        ------
        PickError
            If no fault can be used as it was drawn.
        SettingError
            If an option is out of its range or misspelt, or the mesh would be too large.
        FlippedError
            If the fixed point turns triangles over.
        Cancelled
            If ``progress`` returned False.
        """
        solver_options = SolverOptions.from_keywords("unfault", options)
        holds = self.usable_picks.holds(fixed, pins, regional)
        profiles = checked_slip(slip, list(validation.named_picks(faults, Fault, "fault")))

        def slide_blocks(lines: Lines, beds: Beds, walls: Lines, ends: EndsOfFaults) -> Stage:
            return unfault_stage(self.domain, lines, beds, holds, solver_options, walls, ends=ends, profiles=profiles)

        stage, notes = self.usable_picks.use(slide_blocks, faults, horizons, boundaries)
        held = replace(stage, fixed=fixed, pins=tuple(pins), regional=regional, age=age)
        drawn = _drawn(faults, boundaries, horizons)
        return self._with_stage(replace(held, weights=solver_options.weights, slip=profiles, drawn=drawn), notes)

    def _with_stage(self, stage: Stage, notes: Sequence[Finding] = ()) -> "Restoration":
        return replace(self, stages=(*self.stages, stage.with_notes(*notes)))

    def flatten(
        self,
        horizon: Horizon,
        *,
        datum: float | Profile | None = None,
        by: str = LENGTH,
        beyond: str = FREE,
        beds: Sequence[Horizon] = (),
        age: float | None = None,
        **options: Unpack[SolverKeywords],
    ) -> "Restoration":
        """Bring a horizon to one level while it keeps its length (the paper's section 3.2).

        Level and length are weighted requirements, not constraints. With the default weights sine folds keep their
        length to 0.06% with limbs of up to 45 degrees and to 0.14% at 60 degrees, and lie within 0.02 m of the level,
        on meshes of 40 to 100 m; the rock above and below pays for that with its area. The report holds a finding where
        the length changes by more than 0.5%, or the horizon stays more than a tenth of a sample off its level.

        Parameters
        ----------
        horizon : Horizon
        datum : float or list of (x, z), optional
            The level, in the section's unit of z, or points of a palaeobathymetry from left to right, joined by
            straight lines and level beyond; the horizon's mean level if left out.
        by : {"length", "vertical shear"}
            The second moves each column of rock up or down, in closed form: it keeps areas, but not the lengths of beds
            that dip, and suits relief that comes from compaction and subsidence.
        beyond : {"free", "keep", "level", "trend"}
            What happens to the rock beyond the ends of a horizon that does not cross the section. "free": it turns with
            the horizon. "keep": it stays where it is from a distance on: the horizon's own width, or half of the way to
            the section's end. "level", "trend": the horizon is extended straight to the border, level, or in the
            direction from its leftmost end to its rightmost one, and flattened as far. The report says how far the
            rest moves.
        beds : list of Horizon, optional
            Horizons that give the direction of the beds besides this one, for ``weights.bedding``.
        age : float, optional
            Time that the section after it stands for, in Ma.
        weights, solver, weighting, max_iterations, progress, start
            As for `unfault`.

        Raises
        ------
        PickError, SettingError, FlippedError, Cancelled
            As for `unfault`.
        """
        solver_options = SolverOptions.from_keywords("flatten", options)
        if by not in FLATTENINGS:
            raise SettingError(f"by must be {' or '.join(map(repr, FLATTENINGS))}, but is {by!r}")
        (horizon,) = validation.named_picks([horizon], Horizon, "horizon").values()
        picks = self.usable_picks
        pieces = picks.bed_lines(horizon)
        check_beyond(beyond)
        level = None if datum is None else self._profile_in_rock("datum", datum)
        if by == VERTICAL_SHEAR:
            stage = shear_flat_stage(self.domain, horizon.name, pieces, [], level, solver_options.progress)
        else:
            others = [bed for bed in beds if bed.name != horizon.name and bed.constrains]
            guides = [line for bed in others for line in picks.bed_lines(bed)]
            before = self.stages[-1] if self.stages else None
            stage = flatten_stage(self.domain, horizon.name, pieces, level, solver_options, guides, before, beyond)
        stage = replace(stage, weights=solver_options.weights, drawn=_drawn(horizon, beds), age=age)
        return self._with_stage(stage, (*stage.outcome.notes, *picks.notes([horizon])))

    def _profile_in_rock(self, name: str, profile: float | Profile) -> float | Profile:
        """A depth, or a profile, in metres of rock."""
        checked, (dx, dz) = checked_profile(name, profile), self.original.metres.tolist()
        return tuple((x * dx, z * dz) for x, z in checked) if isinstance(checked, tuple) else checked * dz

    def strip(
        self,
        horizon: Horizon,
        *,
        faults: Sequence[Fault] = (),
        age: float | None = None,
        progress: Progress | None = None,
    ) -> "Restoration":
        """Remove the rock above a horizon: what lies below stays where it is, and nothing above has a place any more.

        A horizon that does not span the rock is continued level from its ends to the border, and the report says so.

        Parameters
        ----------
        horizon : Horizon
        faults : list of Fault, optional
            Those that offset the horizon: between two of its pieces the new border follows the fault.
        age : float, optional
            Age of the horizon, in Ma.
        progress : callable(iteration, energy, vertices), optional
            Called once; returning False cancels.

        Raises
        ------
        PickError
            If no rock is left below the horizon, or its pieces overlap.
        Cancelled
        """
        (horizon,) = validation.named_picks([horizon], Horizon, "horizon").values()
        picks = self.usable_picks
        lines = fault_lines_of(picks, list(validation.named_picks(faults, Fault, "fault").values()))
        stage = strip_stage(self.domain, horizon.name, picks.bed_lines(horizon), lines, progress)
        stage = replace(stage, age=age, drawn=_drawn(horizon, faults))
        return self._with_stage(stage, (*stage.outcome.notes, *picks.notes([horizon])))

    def decompact(
        self,
        stratigraphy: Stratigraphy,
        interpretation: Interpretation,
        *,
        age: float | None = None,
        progress: Progress | None = None,
    ) -> "Restoration":
        """Let the rock expand to the porosity of its present depth of burial, column by column.

        Each column keeps its thickness of grains, and the bottom of the section stays where it is. Rock never becomes
        looser than its deepest burial so far left it; see `Lithology` for the law.

        Parameters
        ----------
        stratigraphy : Stratigraphy
        interpretation : Interpretation
            Holds the tops of the layers, and the faults that divide them.
        age : float, optional
            In Ma.
        progress : callable(iteration, energy, vertices), optional
            Called once; returning False cancels.

        Raises
        ------
        PickError
            If a top does not exist, or two tops cross.
        FlippedError
            If the rock expands so differently from column to column that triangles would turn over.
        Cancelled
        """
        rock = self.stratified(stratigraphy, interpretation)
        stage = decompact_stage(self.domain, rock.layers, stratigraphy, rock.memory, rock.notes, progress)
        drawn = _drawn(list(rock.tops.values()), interpretation.faults)
        return self._with_stage(replace(stage, age=age, drawn=drawn), stage.outcome.notes)

    def isostasy(
        self,
        model: Isostasy,
        stratigraphy: Stratigraphy,
        interpretation: Interpretation,
        *,
        beyond: str = MIRROR,
        age: float | None = None,
        progress: Progress | None = None,
    ) -> "Restoration":
        """Let the crust rise, or sink, under what the steps since the last such step took away or put back.

        The load is the change, since before the first of them that strips or unerodes, of the weight of the rock, the
        water in its pores, and the water above it. Columns move up and down as wholes.

        Parameters
        ----------
        model : Isostasy
            The strength of the crust, the densities, and the sea level.
        stratigraphy : Stratigraphy
            Gives the rock its density.
        interpretation : Interpretation
            Holds the tops of the layers, and the faults.
        beyond : {"mirror", "constant", "zero"}
            The load beyond the section: its mirror image, that at its ends, or none.
        age : float, optional
            In Ma.
        progress : callable(iteration, energy, vertices), optional
            Called once; returning False cancels.

        Raises
        ------
        PickError
            If a top does not exist, or two tops cross.
        SettingError
            If ``beyond`` is none of these.
        Cancelled
        """
        validation.checked_kind(model, Isostasy, "model")
        kinds = [stage.kind for stage in self.stages]
        last = max((index for index, kind in enumerate(kinds) if kind == ISOSTASY), default=-1)
        changes = (index for index, kind in enumerate(kinds) if kind in (STRIP, UNERODE) and index > last)
        count = next(changes, len(kinds))
        states = (replace(self, stages=self.stages[:count]), self)
        before, after = (state.stratified(stratigraphy, interpretation) for state in states)
        stage = isostasy_stage(self.domain, model, before, after, beyond, progress)
        drawn = _drawn(list(after.tops.values()), interpretation.faults)
        return self._with_stage(replace(stage, age=age, drawn=drawn))

    def unerode(
        self,
        surface: float | Profile,
        *,
        name: str = "eroded rock",
        age: float | None = None,
        progress: Progress | None = None,
    ) -> "Restoration":
        """Put eroded rock back, as an area without an image.

        It belongs to the layer whose top was stripped last. The rock below remembers that it was buried under it.

        Parameters
        ----------
        surface : float or list of (x, z)
            The surface before the erosion, in the section as it is after the steps so far; level beyond its ends. What
            lies above it stays.
        name : str
            Names it in reports.
        age : float, optional
            In Ma.
        progress : callable(iteration, energy, vertices), optional
            Called once; returning False cancels.

        Raises
        ------
        SettingError
            If the surface lies nowhere above the rock.
        Cancelled
        """
        level = self._profile_in_rock("surface", surface)
        return self._with_stage(replace(unerode_stage(self.domain, level, name, progress), age=age))

    def stratified(self, stratigraphy: Stratigraphy, interpretation: Interpretation) -> StratifiedRock:
        """The rock that the next stage starts from, divided into layers."""
        validation.checked_kind(stratigraphy, Stratigraphy, "stratigraphy")
        validation.checked_kind(interpretation, Interpretation, "interpretation")
        return StratifiedRock(self.usable_picks, stratigraphy, interpretation)

    @property
    def interpretation(self) -> Interpretation:
        """The picks that the stages were given, as they were drawn on the original section, and the bodies."""
        drawn = {(type(pick), pick.name): pick for stage in self.stages for pick in stage.drawn}
        faults = [pick for pick in drawn.values() if isinstance(pick, Fault)]
        return Interpretation(faults, [pick for pick in drawn.values() if isinstance(pick, Horizon)], self.bodies)

    @property
    def usable_picks(self) -> UsablePicks:
        """The picks that the next stage can use, in metres of rock."""
        return UsablePicks(self.original, self.stages, self.domain)

    @cached_property
    def domain(self) -> RestorationDomain:
        """The rock that the next stage starts from."""
        x_min, x_max, z_min, z_max = self.original.extent
        corners = self.original.to_rock([(x_min, z_min), (x_max, z_max)])
        if self.stages:
            outline, bodies = self.stages[-1].outline, self.stages[-1].carried_bodies
        else:
            bodies = body_polygons(self.original, self.bodies)
            outline = without_bodies(shapely.box(*corners.ravel()), bodies)
        return RestorationDomain(outline, self.original, self.spacing, self.quick, bodies)

    def to_restored(self, points: ArrayLike) -> np.ndarray:
        """Carry points of the original section through all stages, NaN outside; in its units, shape (n, 2)."""
        points = self.original.to_rock(validation.as_points(points))
        for stage in self.stages:
            points = stage.map.forward(points)
        return self.original.from_rock(points)

    def to_original(self, points: ArrayLike) -> np.ndarray:
        """Carry points of the restored section back to the original, NaN outside; in its units, shape (n, 2)."""
        points = self.original.to_rock(validation.as_points(points))
        for stage in reversed(self.stages):
            points = stage.map.inverse(points)
        return self.original.from_rock(points)

    @property
    def verdict(self) -> str:
        """One sentence on all stages: whether they settled, what they achieved, and the worst problem or warning."""
        return verdict([stage.report for stage in self.stages], self.findings)

    @property
    def settled(self) -> bool:
        """True if the solver settled in every stage."""
        return all(stage.report.converged for stage in self.stages)

    @cached_property
    def findings(self) -> tuple[Finding, ...]:
        """The findings of all stages, problems first; ``where`` is a position in the original section, or None."""
        findings = list(self.skipped)
        for index, stage in enumerate(self.stages):
            before = replace(self, stages=self.stages[:index])
            findings += [replace(finding, where=before._origin(finding.where)) for finding in stage.report.findings]
        once = {(finding.kind, finding.pick, finding.text): finding for finding in reversed(findings)}
        return worst_first(reversed(once.values()))

    def _origin(self, where: tuple[float, float] | None) -> tuple[float, float] | None:
        """Carry a position in the restored section, or one beside it, back to the original; None outside."""
        if where is None or not self.stages:
            return where
        step = 1e-3 * self.stages[-1].spacing / self.original.metres  # the border may be off by rounding
        around = np.array([(0, 0), (1, 0), (-1, 0), (0, 1), (0, -1), (1, 1), (1, -1), (-1, 1), (-1, -1)])
        origins = self.to_original(where + step * around)
        known = origins[np.isfinite(origins).all(axis=1)]
        return (float(known[0, 0]), float(known[0, 1])) if len(known) else None

    @cached_property
    def section(self) -> Section:
        """The restored section: each sample interpolated once, in the original (cubic).

        It has the original's spacing and lattice of samples, and covers all of the rock. NaN where there is no rock.
        """
        return self.picture(order=3)

    def picture(self, order: int = 3, cells: int | None = None) -> Section:
        """The restored section, with a choice of the interpolation and the number of samples.

        Parameters
        ----------
        order : int
            1 is linear and quick, 3 is cubic.
        cells : int, optional
            Largest number of samples: only every second, third, ... sample of the lattice is computed, such that ``dx``
            and ``dz`` grow alike. For pictures that follow the mouse: amplitudes are not smoothed before decimation.

        Raises
        ------
        SettingError
            If the order is neither, or there would be fewer than 2 x 2 cells.
        """
        cells = None if cells is None else validation.whole_number("cells", cells, least=4)
        if not self.stages and cells is None:
            return self.original
        return picture(self.original, self.stages, order, cells)

    def at(self, time: float) -> "Restoration":
        """The restoration at a moment: 0 is the present-day section, 1 the section after the first stage, and so on.

        In between, a stage is carried out in part: each block turns by a share of its angle, about the same pole, and
        the rest of its deformation grows linearly. The report is that of the whole stage.

        Raises
        ------
        SettingError
            If the time is not between 0 and the number of stages.
        """
        time, count = validation.finite_number("time", time), len(self.stages)
        if not 0 <= time <= count:
            raise SettingError(
                f"time must be between 0 (present day) and {count} (after the last stage), but is {time:g}"
            )
        whole = int(time)
        part = () if time == whole else (self.stages[whole].part(time - whole),)
        return replace(self, stages=self.stages[:whole] + part)

    def area_ratio_at(self, points: ArrayLike) -> np.ndarray:
        """Present-day over restored area, of all stages together, at points of the original section; NaN outside.

        Above 1, rock was compressed by restoring it, so that it was dilated in nature.

        Parameters
        ----------
        points : array, shape (n, 2)
            In the section's units; the result is of shape (n,).
        """
        return area_ratio_at(self.stages, self.original.to_rock(validation.as_points(points)))

    @property
    def maps_to_restored(self) -> list[tuple[np.ndarray, np.ndarray, np.ndarray]]:
        """The maps of `to_restored`, stage by stage, for programs that carry points themselves.

        Each is ``(source, target, triangles)``: vertices before and after, shape (n, 2), in the section's units, and
        corners of the triangles, shape (m, 3). A point keeps its barycentric coordinates in the triangle that holds it.
        """
        unit = self.original.from_rock
        return [(unit(stage.mesh.vertices), unit(stage.vertices), stage.mesh.triangles) for stage in self.stages]

    @property
    def maps_to_original(self) -> list[tuple[np.ndarray, np.ndarray, np.ndarray]]:
        """The maps of `to_original`, stage by stage; as `maps_to_restored`."""
        return [(target, source, triangles) for source, target, triangles in reversed(self.maps_to_restored)]

    def carried(self, pick: Fault | Horizon | Body) -> list[np.ndarray]:
        """Lines of a pick after all stages, each of shape (n, 2), in the section's units; of a body, its closed border.

        There are none if it lies outside the section.
        """
        try:
            if isinstance(pick, Body):
                lines = carried_body(self.original, self.stages, pick)
            elif isinstance(pick, Fault):
                first = self.stages[0].domain if self.stages else None
                lines = [LineString(carried_fault(self.original, self.stages, pick, first))]
            else:
                lines = carried_horizon(self.original, self.stages, pick)
        except PickError as error:
            if error.kind != OUTSIDE:
                raise
            return []
        return [self.original.from_rock(shapely.get_coordinates(line)) for line in lines]

    def __repr__(self) -> str:
        stages = ", ".join(stage.kind for stage in self.stages) or "no stage yet"
        return f"<Restoration of {self.original!r}: {stages}>"


def _drawn(*picks: Fault | Horizon | Sequence[Fault | Horizon]) -> tuple[Fault | Horizon, ...]:
    """Picks that were given alone or several at a time, in one tuple."""
    return tuple(pick for some in picks for pick in ([some] if isinstance(some, Fault | Horizon) else some))
