"""Velocity models: the depth of a two-way time at each position, and the two-way time of a depth."""

from collections.abc import Collection, Sequence
from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import ArrayLike

from seiswidgets.errors import PickError, SettingError
from seiswidgets.geology import validation
from seiswidgets.geology.picks import Horizon
from seiswidgets.geology.section import METRES, SECONDS

SLOWEST, FASTEST = 100.0, 12_000.0  # m/s: other velocities are not of rock, or in another unit


class Velocity(Protocol):
    """A velocity model. Positions are in metres; times are two-way, in seconds, from depth zero."""

    @property
    def source(self) -> str:
        """Origin of the figures; "" if not stated."""
        ...

    def depth(self, x: np.ndarray, time: np.ndarray) -> np.ndarray:
        """Depth in metres at some times; shape of ``time``."""
        ...

    def time(self, x: np.ndarray, depth: np.ndarray) -> np.ndarray:
        """Two-way time in seconds at some depths, NaN where there is none; shape of ``depth``."""
        ...

    def __str__(self) -> str: ...


@dataclass(frozen=True)
class ConstantVelocity:
    """One velocity everywhere.

    Parameters
    ----------
    velocity : float
        In m/s.
    source : str
        Origin of the figure, such as "stacking velocities"; shown in reports.

    Raises
    ------
    SettingError
        If the velocity is not one of rock.
    """

    velocity: float
    source: str = ""

    def __post_init__(self) -> None:
        object.__setattr__(self, "velocity", _checked_velocity("velocity", self.velocity))

    def depth(self, x: np.ndarray, time: np.ndarray) -> np.ndarray:
        return np.asarray(time) * self.velocity / 2

    def time(self, x: np.ndarray, depth: np.ndarray) -> np.ndarray:
        return np.asarray(depth) * 2 / self.velocity

    def __str__(self) -> str:
        return f"{self.velocity:g} m/s"


@dataclass(frozen=True)
class LinearVelocity:
    """A velocity that changes linearly with depth, ``v0 + k z``.

    Depth and two-way time are related by ``z = v0 / k (exp(k t / 2) - 1)``.

    Parameters
    ----------
    v0 : float
        Velocity at depth zero, in m/s.
    k : float
        Increase, in m/s per metre; typically 0.3 to 1 in young sediment.
    source : str
        Origin of the figures; shown in reports.

    Raises
    ------
    SettingError
        If ``v0`` is not a velocity of rock, or ``k`` is not finite.
    """

    v0: float
    k: float
    source: str = ""

    def __post_init__(self) -> None:
        object.__setattr__(self, "v0", _checked_velocity("v0", self.v0))
        object.__setattr__(self, "k", validation.finite_number("k", self.k))

    def depth(self, x: np.ndarray, time: np.ndarray) -> np.ndarray:
        half = np.asarray(time) / 2
        return self.v0 * (half if self.k == 0 else np.expm1(self.k * half) / self.k)

    def time(self, x: np.ndarray, depth: np.ndarray) -> np.ndarray:
        depth = np.asarray(depth)
        if self.k == 0:
            return 2 * depth / self.v0
        growth = np.where(self.v0 + self.k * depth > 0, self.k * depth / self.v0, np.nan)
        return np.asarray(2 / self.k * np.log1p(growth))

    def __str__(self) -> str:
        return f"{self.v0:g} m/s {'+' if self.k >= 0 else '-'} {abs(self.k):g}/s × depth"


@dataclass(frozen=True, eq=False)
class TimeDepthTable:
    """Pairs of two-way time and depth, as from a checkshot survey; linear between them.

    Above the first pair and below the last, the velocity of the next interval holds.

    Parameters
    ----------
    times : array, shape (n,), n >= 2
        Two-way times, increasing, in ``time_unit``.
    depths : array, shape (n,)
        Depths, increasing, in ``depth_unit``.
    time_unit : {"ms", "s"}
    depth_unit : {"m", "km", "ft"}
    source : str
        Origin of the table, such as the name of the well; shown in reports.

    Raises
    ------
    SettingError
        If the table is not one of increasing times and depths, or an interval's velocity is not one of rock.
    """

    times: np.ndarray
    depths: np.ndarray
    time_unit: str = "ms"
    depth_unit: str = "m"
    source: str = ""

    def __post_init__(self) -> None:
        _check_unit("time_unit", self.time_unit, SECONDS)
        _check_unit("depth_unit", self.depth_unit, METRES)
        times, depths = (_checked_column(name, getattr(self, name)) for name in ("times", "depths"))
        if len(times) != len(depths):
            raise SettingError(f"each time needs a depth, but there are {len(times)} times and {len(depths)} depths")
        object.__setattr__(self, "times", times)
        object.__setattr__(self, "depths", depths)
        for index, velocity in enumerate(2 * np.diff(self._depths) / np.diff(self._times)):
            _checked_velocity(f"velocity between rows {index + 1} and {index + 2} of the table", velocity)

    @property
    def _times(self) -> np.ndarray:
        return self.times * SECONDS[self.time_unit]

    @property
    def _depths(self) -> np.ndarray:
        return self.depths * METRES[self.depth_unit]

    def depth(self, x: np.ndarray, time: np.ndarray) -> np.ndarray:
        return _interpolate(np.asarray(time, float), self._times, self._depths)

    def time(self, x: np.ndarray, depth: np.ndarray) -> np.ndarray:
        return _interpolate(np.asarray(depth, float), self._depths, self._times)

    def __str__(self) -> str:
        return f"time-depth table of {len(self.times)} rows"


@dataclass(frozen=True, eq=False)
class LayerCake:
    """Layers of constant velocity between horizons.

    A layer that pinches out has no thickness there. Between the pieces of a horizon, as in the heave of a normal fault,
    its time changes linearly; beyond its ends it stays that of the end.

    Parameters
    ----------
    horizons : list of Horizon
        Picked on the section in time, from the top down.
    velocities : list of float
        In m/s, from the top down: one more than horizons.
    time_unit : {"ms", "s"}
        Unit of z of the section that the horizons are picked on.
    x_unit : {"m", "km", "ft"}
        Its unit of x.
    source : str
        Origin of the velocities; shown in reports.

    Raises
    ------
    PickError
        If a horizon has two times at one position, or crosses the one above.
    SettingError
        If the number of velocities does not fit, or one is not of rock.
    """

    horizons: Sequence[Horizon]
    velocities: Sequence[float]
    time_unit: str = "ms"
    x_unit: str = "m"
    source: str = ""

    def __post_init__(self) -> None:
        _check_unit("time_unit", self.time_unit, SECONDS)
        _check_unit("x_unit", self.x_unit, METRES)
        horizons = tuple(validation.named_picks(self.horizons, Horizon, "horizon").values())
        velocities = tuple(_checked_velocity(f"velocity {n}", v) for n, v in enumerate(self.velocities, 1))
        if len(velocities) != len(horizons) + 1:
            raise SettingError(
                f"{len(horizons)} horizons bound {len(horizons) + 1} layers, but there are {len(velocities)} velocities"
            )
        object.__setattr__(self, "horizons", horizons)
        object.__setattr__(self, "velocities", velocities)
        self._check_order()

    def _check_order(self) -> None:
        lines = [_single_valued(horizon) for horizon in self.horizons]
        x = np.unique(np.concatenate([line[:, 0] for line in lines]))
        times = [np.interp(x, line[:, 0], line[:, 1], left=np.nan, right=np.nan) for line in lines]
        for above, below, crossed in zip(self.horizons, self.horizons[1:], np.diff(times, axis=0) < 0, strict=False):
            if crossed.any():
                raise PickError(
                    f"horizon {below.name!r} lies above {above.name!r} near x={x[np.argmax(crossed)]:g} "
                    f"{self.x_unit}; list them from the top down, and let them touch where a layer pinches out",
                    pick=below.name,
                )

    def depth(self, x: np.ndarray, time: np.ndarray) -> np.ndarray:
        return self._sum_layers(np.asarray(time, float), self._tops(x), np.array(self.velocities) / 2)

    def time(self, x: np.ndarray, depth: np.ndarray) -> np.ndarray:
        tops = self._tops(x)
        halves = np.array(self.velocities).reshape(-1, *(1,) * (tops.ndim - 1)) / 2
        tops = np.cumsum(np.diff(tops, axis=0, prepend=0) * halves[:-1], axis=0)
        return self._sum_layers(np.asarray(depth, float), tops, 2 / np.array(self.velocities))

    def _tops(self, x: np.ndarray) -> np.ndarray:
        """Two-way time in seconds of each horizon at some positions, one row a horizon, increasing downwards."""
        x = np.asarray(x) / METRES[self.x_unit]
        times = [np.interp(x, *_single_valued(horizon).T) for horizon in self.horizons]
        return np.maximum.accumulate(np.array(times).reshape(-1, *x.shape) * SECONDS[self.time_unit], axis=0)

    @staticmethod
    def _sum_layers(value: np.ndarray, tops: np.ndarray, factors: np.ndarray) -> np.ndarray:
        """Sum the parts of each value that lie in the layers, each times the factor of its layer."""
        total, below = np.zeros_like(value), np.full(value.shape, -np.inf)
        for top, factor, above in zip([*tops, np.inf], factors, [0.0, *tops], strict=True):
            total += factor * (np.clip(value, below, top) - above)
            below = np.broadcast_to(top, value.shape)
        return total

    def __str__(self) -> str:
        names = [*(f"{v:g} m/s above {h.name}" for v, h in zip(self.velocities, self.horizons, strict=False))]
        return ", ".join([*names, f"{self.velocities[-1]:g} m/s below"])


def _checked_velocity(name: str, value: float) -> float:
    velocity = validation.finite_number(name, value)
    if not SLOWEST <= velocity <= FASTEST:
        raise SettingError(
            f"{name} must be from {SLOWEST:g} to {FASTEST:g} m/s, but is {velocity:g}; check its unit and sign"
        )
    return velocity


def _check_unit(name: str, unit: str, units: Collection[str]) -> None:
    if unit not in units:
        raise SettingError(f"{name} must be one of {', '.join(units)}, but is {unit!r}")


def _checked_column(name: str, values: ArrayLike) -> np.ndarray:
    try:
        column = np.array(values, float)
    except (TypeError, ValueError):
        column = np.array(np.nan)
    if column.ndim != 1 or len(column) < 2 or not np.isfinite(column).all():
        raise SettingError(f"{name} must be two finite numbers or more")
    back = np.diff(column) <= 0
    if back.any():
        row = int(np.argmax(back)) + 2
        raise SettingError(f"{name} must increase, but row {row} has {column[row - 1]:g} after {column[row - 2]:g}")
    column.setflags(write=False)
    return column


def _interpolate(at: np.ndarray, known: np.ndarray, values: np.ndarray) -> np.ndarray:
    """Interpolate linearly, beyond the ends along the first and the last interval."""
    interval = np.clip(np.searchsorted(known, at) - 1, 0, len(known) - 2)
    slope = np.diff(values) / np.diff(known)
    return np.asarray(values[interval] + slope[interval] * (at - known[interval]))


def _single_valued(horizon: Horizon) -> np.ndarray:
    """The points of all pieces from left to right, shape (n, 2)."""
    pieces = sorted((piece[np.argsort(piece[:, 0], kind="stable")] for piece in horizon.pieces), key=lambda p: p[0, 0])
    line = np.concatenate(pieces)
    back = np.diff(line[:, 0]) < 0
    folded = any(np.ptp(np.sign(np.diff(piece[:, 0]))) > 1 for piece in horizon.pieces)
    if back.any() or folded:
        where = "" if folded else f" near x={line[np.argmax(back), 0]:g}"
        raise PickError(
            f"horizon {horizon.name!r} has two times at one position{where}; a layer cake needs one, so draw it with "
            "pieces that do not overlap",
            pick=horizon.name,
        )
    return line
