"""The restoration of a section: a chain of stages, each a value made from the one before."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
import shapely
from shapely import LineString

from seiswidgets.core.resampling import resampled
from seiswidgets.errors import PickError, SettingError
from seiswidgets.geology import asked
from seiswidgets.geology.flattening import flattened, joined
from seiswidgets.geology.ground import Ground
from seiswidgets.geology.picks import Fault, Horizon
from seiswidgets.geology.section import Section
from seiswidgets.geology.solving import GAUSS_NEWTON, Options
from seiswidgets.geology.stage import Stage
from seiswidgets.geology.unfaulting import unfaulted
from seiswidgets.geology.weights import Weights


@dataclass(frozen=True, eq=False)
class Restoration:
    """A section and the stages that restore it.

    A value: ``unfault`` and ``flatten`` return a new one with a stage more. Stages can be chained in any order; faults,
    horizons and held points are always given in the coordinates of the original section.

    Parameters
    ----------
    original : Section
        As it is today.
    spacing : float, optional
        Typical length of the mesh's edges, in metres of rock; where it is left out, such that a mesh has about 2,500
        vertices.
    stages : tuple of Stage
        Those made so far.

    Raises
    ------
    SettingError
        If the spacing is not above 0.

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

    def __post_init__(self):
        if not isinstance(self.original, Section):
            raise SettingError(
                f"a restoration starts from a seiswidgets.Section, but got a {type(self.original).__name__}"
            )
        if self.spacing is not None:
            spacing = asked.number("spacing", self.spacing)
            if spacing <= 0:
                raise SettingError(f"spacing must be above 0 m, but is {spacing:g}")
            object.__setattr__(self, "spacing", spacing)

    def unfault(
        self,
        faults: Fault | Sequence[Fault],
        horizons: Horizon | Sequence[Horizon],
        *,
        fixed: tuple[float, float] | None = None,
        weights: Weights | None = None,
        solver: str = GAUSS_NEWTON,
        max_iterations: int | None = None,
        progress: Callable[[int, float, np.ndarray], bool | None] | None = None,
        start: Stage | None = None,
    ) -> "Restoration":
        """Slide the blocks back along some faults until the horizons match across them (the paper's section 3.1).

        Parameters
        ----------
        faults : Fault or list of Fault
        horizons : Horizon or list of Horizon
            Each fault needs at least one that meets it on both sides.
        fixed : (x, z), optional
            A point in the block that stays exactly where it is. If left out both sides of every fault move, and of
            all solutions that differ by a rigid motion the one that moves least is taken.
        weights : Weights, optional
            Those of the paper if left out.
        solver : {"gauss-newton", "fixed-point"}
            The second is the paper's (eq. 16), kept for teaching and comparison.
        max_iterations : int, optional
            200 Gauss-Newton steps, or 1000 of the fixed point, if left out. A solver that has not settled by then
            says so in the report.
        progress : callable(iteration, energy, vertices), optional
            Called after each iteration; returning False cancels.
        start : Stage, optional
            An earlier solution of nearly the same task, to start from.

        Raises
        ------
        PickError
            If the picks cannot be used as they were drawn.
        SettingError
            If a choice is out of its range, or the mesh would be too large.
        FlippedError
            If the fixed point turns triangles over.
        Cancelled
            If ``progress`` returned False.
        """
        options = Options(weights or Weights(), solver, max_iterations, progress, start)
        faults, horizons = asked.picks(faults, Fault, "fault"), asked.picks(horizons, Horizon, "horizon")
        if not faults:
            raise PickError("there is no fault to unfault; give at least one")
        held = None if fixed is None else self._held(fixed)
        fault_points = {name: self._fault(fault) for name, fault in faults.items()}
        pieces = {name: self._pieces(horizon) for name, horizon in horizons.items()}
        stage = unfaulted(self.ground, fault_points, pieces, held, options)
        return replace(self, stages=(*self.stages, stage))

    def flatten(
        self,
        horizon: Horizon,
        *,
        datum: float | None = None,
        weights: Weights | None = None,
        solver: str = GAUSS_NEWTON,
        max_iterations: int | None = None,
        progress: Callable[[int, float, np.ndarray], bool | None] | None = None,
        start: Stage | None = None,
    ) -> "Restoration":
        """Bring a horizon to one level while it keeps its length (the paper's section 3.2).

        Parameters
        ----------
        horizon : Horizon
        datum : float, optional
            The level, in the section's unit of z; the horizon's mean level if left out.
        weights, solver, max_iterations, progress, start
            As for ``unfault``.

        Raises
        ------
        PickError, SettingError, FlippedError, Cancelled
            As for ``unfault``.
        """
        options = Options(weights or Weights(), solver, max_iterations, progress, start)
        (horizon,) = asked.picks([horizon], Horizon, "horizon").values()
        if datum is not None:
            datum = asked.number("datum", datum) * self.original.metres[1]
        stage = flattened(self.ground, horizon.name, self._pieces(horizon), datum, options)
        return replace(self, stages=(*self.stages, stage))

    @cached_property
    def ground(self) -> Ground:
        """What the next stage will start from."""
        if not self.stages:
            x_min, x_max, z_min, z_max = self.original.extent
            corners = self.original.to_rock([(x_min, z_min), (x_max, z_max)])
            return Ground(shapely.box(*corners.ravel()), self.original, self.spacing)
        return Ground(self.stages[-1].outline, self.original, self.spacing)

    def to_restored(self, points) -> np.ndarray:
        """Where points of the original section lie after all stages, NaN outside; in its units, shape (n, 2)."""
        points = self.original.to_rock(asked.points(points))
        for stage in self.stages:
            points = stage.map.forward(points)
        return self.original.from_rock(points)

    def to_original(self, points) -> np.ndarray:
        """Where points of the restored section lie in the original one, NaN outside; in its units, shape (n, 2)."""
        points = self.original.to_rock(asked.points(points))
        for stage in reversed(self.stages):
            points = stage.map.inverse(points)
        return self.original.from_rock(points)

    @cached_property
    def section(self) -> Section:
        """The restored section: each sample interpolated once, in the original (cubic).

        It has the original's spacing, and its samples stand on the same lattice; it reaches as far as the rock does.
        NaN where nothing maps.
        """
        return self.picture(order=3)

    def picture(self, order: int = 3) -> Section:
        """The restored section with a choice of interpolation: 1 is linear and quick, 3 is cubic."""
        if not self.stages:
            return self.original
        section = self.original
        x, z = self._lattice()
        places = self.stages[-1].map.inverse_on_grid(x * section.metres[0], z * section.metres[1]).reshape(-1, 2)
        for stage in reversed(self.stages[:-1]):
            places = stage.map.inverse(places)
        columns, rows = ((section.from_rock(places) - (section.x0, section.z0)) / (section.dx, section.dz)).T
        shape = len(z), len(x)
        amplitude = resampled(section.amplitude, columns.reshape(shape), rows.reshape(shape), order)
        return replace(section, amplitude=amplitude, x0=x[0], z0=z[0])

    def _lattice(self):
        """Positions of the restored section's traces and samples, on the original's lattice."""
        section = self.original
        low, high = (
            (section.from_rock(corner(self.stages[-1].vertices, axis=0)) - (section.x0, section.z0))
            / (section.dx, section.dz)
            for corner in (np.min, np.max)
        )
        first, last = np.ceil(low - 1e-6), np.floor(high + 1e-6)
        thin = last <= first  # a section has two traces and two samples at least
        first, last = np.where(thin, np.floor(low), first), np.where(thin, np.floor(low) + 1, last)
        x, z = (np.arange(a, b + 1) for a, b in zip(first, last, strict=True))
        return section.x0 + section.dx * x, section.z0 + section.dz * z

    def carried(self, pick: Fault | Horizon) -> list[np.ndarray]:
        """A fault or a horizon as it lies after all stages: its lines, each of shape (n, 2), in the section's units."""
        lines = [LineString(self._fault(pick))] if isinstance(pick, Fault) else self._pieces(pick)
        return [self.original.from_rock(shapely.get_coordinates(line)) for line in lines]

    def _fault(self, fault):
        lines = [LineString(asked.rock_points(self.original, fault.points, f"fault {fault.name!r}"))]
        for stage in self.stages:
            lines = [moved for line in lines for moved in stage.carried_fault(line)]
        if not lines:
            raise PickError(
                f"nothing is left of fault {fault.name!r} after the stages before; it lies outside the rock"
            )
        return np.concatenate([shapely.get_coordinates(line) for line in lines])

    def _pieces(self, horizon):
        lines = [
            LineString(asked.rock_points(self.original, piece, f"piece {number} of horizon {horizon.name!r}"))
            for number, piece in enumerate(horizon.pieces, 1)
        ]
        for stage in self.stages:
            lines = joined(stage.carried_horizon(lines), stage.spacing)
        return lines

    def _held(self, fixed):
        try:
            point = asked.points(fixed).reshape(1, 2)
        except ValueError:
            raise PickError(f"fixed must be one point (x, z), but is {fixed!r}") from None
        point = asked.rock_points(self.original, point, "fixed")
        for stage in self.stages:
            point = stage.map.forward(point)
        return point[0]

    def __repr__(self):
        stages = ", ".join(stage.kind for stage in self.stages) or "no stage yet"
        return f"<Restoration of {self.original!r}: {stages}>"
