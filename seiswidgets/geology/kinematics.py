"""Closed-form deformation of level beds: they are folded, then cut by faults, whose blocks slip.

Each deformation is a value with ``apply(points)``, forward in time, and ``undo(points)``, backward. Points are rows
(x, z) in metres.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Protocol, TypedDict

import numpy as np
from numpy.typing import ArrayLike

from seiswidgets.errors import SettingError


def check_range(name: str, value: float, low: float, high: float, unit: str = "") -> None:
    """Raise a SettingError for a setting that is outside its range, or not a number."""
    if not low <= value <= high:
        raise SettingError(f"{name} must be from {low:g} to {high:g}{unit}, but is {value:g}")


class SurveyKeywords(TypedDict, total=False):
    """The keyword arguments of `Survey`."""

    width: float
    depth: float
    dx: float
    dz: float
    seed: int
    noise: float


@dataclass(frozen=True)
class Survey:
    """Size and spacing of a section (m), seed of its beds and noise, and the noise's share of the signal's RMS."""

    width: float = 4000.0
    depth: float = 2000.0
    dx: float = 12.5
    dz: float = 5.0
    seed: int = 0
    noise: float = 0.05

    def __post_init__(self) -> None:
        limits = {"width": (500, 2e4), "depth": (500, 5e3), "dx": (1, 100), "dz": (1, 100), "noise": (0, 10)}
        for name, (low, high) in limits.items():
            check_range(name, getattr(self, name), low, high)
        for size, step in (("width", self.dx), ("depth", self.dz)):
            object.__setattr__(self, size, step * round(getattr(self, size) / step))

    def grid(self) -> np.ndarray:
        """Position of every sample, shape (nz, nx, 2)."""
        nx, nz = round(self.width / self.dx) + 1, round(self.depth / self.dz) + 1
        return np.stack(np.meshgrid(self.dx * np.arange(nx), self.dz * np.arange(nz)), axis=-1)

    def margin(self, points: np.ndarray) -> np.ndarray:
        """Distance to the nearest border, negative outside the section; shape (n,)."""
        x, z = points.T
        return np.asarray(np.min([x, self.width - x, z, self.depth - z], axis=0))

    def snap(self, points: np.ndarray) -> np.ndarray:
        """Remove rounding errors from points, so that ends at the border lie on it and never outside."""
        return np.clip(np.round(points, 9), 0, (self.width, self.depth))


class Deformation(Protocol):
    """A deformation and its inverse."""

    def apply(self, points: np.ndarray) -> np.ndarray:
        """Deform points, shape (n, 2)."""

    def undo(self, points: np.ndarray) -> np.ndarray:
        """Return deformed points to where they were."""


@dataclass(frozen=True)
class RigidMotion:
    """A turn by ``angle`` (radians, from x towards z: clockwise on the screen) about ``centre``, then a shift."""

    angle: float = 0.0
    centre: tuple[float, float] = (0.0, 0.0)
    shift: tuple[float, float] = (0.0, 0.0)

    def apply(self, points: np.ndarray) -> np.ndarray:
        return np.asarray((points - np.array(self.centre)) @ _turn(self.angle) + self.centre + self.shift)

    def undo(self, points: np.ndarray) -> np.ndarray:
        return np.asarray((points - np.array(self.centre) - self.shift) @ _turn(-self.angle) + self.centre)


def _turn(angle: float) -> np.ndarray:
    """Matrix that turns rows (x, z) from x towards z."""
    return np.array([[np.cos(angle), np.sin(angle)], [-np.sin(angle), np.cos(angle)]])


STILL = RigidMotion()


@dataclass(frozen=True)
class ShearFold:
    """A fold by vertical shear: z grows by ``height(x)``."""

    height: Callable[[np.ndarray], np.ndarray]

    def apply(self, points: np.ndarray) -> np.ndarray:
        return np.asarray(points + np.outer(self.height(points[:, 0]), (0, 1)))

    def undo(self, points: np.ndarray) -> np.ndarray:
        return np.asarray(points - np.outer(self.height(points[:, 0]), (0, 1)))


@dataclass(frozen=True)
class BlindSlip:
    """Slip of one side (1 hanging wall, -1 footwall) of a fault that dies out: the displacement about a crack.

    With zeta = t + i n along and across the fault in units of its half length, the displacement down dip is
    slip/2 |Im(zeta - sqrt(zeta^2 - 1))|: elliptic on the fault, 0 ahead of its tips, harmonic elsewhere. Very near
    the tips, within about slip^2 / (4 length) of them, it maps more than one point onto one.
    """

    fault: "Straight"
    slip: float
    side: int

    @property
    def _half_length(self) -> float:
        if self.fault.half_length is None:
            raise ValueError("a blind fault needs a half length")
        return self.fault.half_length

    def _displacement(self, t: np.ndarray, n: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Displacement along t and its derivative, in half lengths."""
        zeta = t + 1j * n
        root = np.sqrt(zeta - 1) * np.sqrt(zeta + 1)  # two roots: this branch makes zeta - root decay
        size, inner = self.side * self.slip / (2 * self._half_length), (zeta - root).imag
        with np.errstate(divide="ignore", invalid="ignore"):
            return size * abs(inner), size * np.sign(inner) * (1 - zeta / root).imag

    def apply(self, points: np.ndarray) -> np.ndarray:
        t, n = self.fault.local(points) / self._half_length
        moved = self._displacement(t, n)[0] * self._half_length
        return np.asarray(points + np.outer(moved, self.fault.direction))

    def undo(self, points: np.ndarray) -> np.ndarray:
        moved, n = self.fault.local(points) / self._half_length
        reach = self.slip / (2 * self._half_length)
        low, t, high = moved - reach, moved, moved + reach
        for _ in range(60):  # Newton's steps, or halving where one leaves the bracket, as it does near the tips
            displacement, slope = self._displacement(t, n)
            excess = t + displacement - moved
            if (abs(excess) < 1e-13).all():
                break
            low, high = np.where(excess < 0, t, low), np.where(excess > 0, t, high)
            with np.errstate(divide="ignore", invalid="ignore"):
                step = t - excess / (1 + slope)
            t = np.where((step >= low) & (step <= high), step, (low + high) / 2)
        return np.asarray(points + np.outer((t - moved) * self._half_length, self.fault.direction))


@dataclass(frozen=True)
class Straight:
    """A fault along a line through ``point``, across the whole section or, with a half length, dying out at tips."""

    point: tuple[float, float]
    dip: float  # degrees to the right; above 90 it dips to the left
    half_length: float | None = None

    @property
    def direction(self) -> np.ndarray:
        """Unit vector down dip."""
        return np.array([np.cos(np.deg2rad(self.dip)), np.sin(np.deg2rad(self.dip))])

    def local(self, points: np.ndarray) -> np.ndarray:
        """Distances of points along (down) and across (to the right) the fault; shape (2, n)."""
        along = self.direction
        return np.asarray(np.array([along, [along[1], -along[0]]]) @ (points - np.array(self.point)).T)

    def side(self, points: np.ndarray) -> np.ndarray:
        """Distance to the right of the fault; shape (n,)."""
        return np.asarray(self.local(points)[1])

    def polyline(self, survey: Survey) -> np.ndarray:
        """The fault's two ends."""
        if self.half_length is None:
            ends = np.array([-self.point[1], survey.depth - self.point[1]]) / self.direction[1]
        else:
            ends = np.array([-self.half_length, self.half_length])
        return np.asarray(np.array(self.point) + np.outer(ends, self.direction))


@dataclass(frozen=True)
class Circular:
    """A fault along a circle, concave upwards, that has the given dip (degrees, to the right) at ``point``."""

    point: tuple[float, float]
    dip: float
    radius: float

    @property
    def centre(self) -> tuple[float, float]:
        """The circle's centre."""
        dip = np.deg2rad(self.dip)
        return self.point[0] + self.radius * np.sin(dip), self.point[1] - self.radius * np.cos(dip)

    def side(self, points: np.ndarray) -> np.ndarray:
        """Distance into the hanging wall, which is inside the circle; shape (n,)."""
        return np.asarray(self.radius - np.hypot(*(points - np.array(self.centre)).T))

    def polyline(self, survey: Survey) -> np.ndarray:
        """Points at most a hundredth of the radius apart, from the top down to the bottom or the right border."""
        x, z = self.centre
        top, bottom = np.arccos(np.clip([-z / self.radius, (survey.depth - z) / self.radius], -1, 1))
        last = max(bottom, np.arcsin(np.clip((x - survey.width) / self.radius, -1, 1)))
        dips = np.linspace(top, last, int(100 * (top - last)) + 2)
        return np.column_stack([x - self.radius * np.sin(dips), z + self.radius * np.cos(dips)])


@dataclass(frozen=True)
class History:
    """Deformation of level beds: a fold, then slip along faults, ordered from left to right, that do not meet.

    There is one slip for each side: left of the first fault, between it and the second, and so on.
    """

    fold: Deformation = STILL
    faults: tuple[Straight | Circular, ...] = ()
    slips: tuple[Deformation, ...] = (STILL,)
    blind: bool = False

    def side(self, points: np.ndarray) -> np.ndarray:
        """Number of faults to the left of each point, shape (n,)."""
        return sum((fault.side(points) > 0 for fault in self.faults), np.zeros(len(points), int))

    def block(self, points: ArrayLike) -> np.ndarray:
        """The fault block that each point lies in, from 0 at the left; always 0 if no fault cuts a block off."""
        array = np.asarray(points, float)
        return np.zeros(len(array), int) if self.blind else self.side(array)

    def to_unfaulted(self, points: ArrayLike) -> np.ndarray:
        """Return points of the present-day section to before the faults slipped; shape (n, 2)."""
        moved = np.array(points, float)
        side = self.side(moved)
        for index, slip in enumerate(self.slips):
            moved[side == index] = slip.undo(moved[side == index])
        return moved

    def to_restored(self, points: ArrayLike) -> np.ndarray:
        """Return points of the present-day section to where they were deposited; shape (n, 2)."""
        return self.fold.undo(self.to_unfaulted(points))

    def blocks_at(self, depth: float) -> list[int]:
        """The blocks in which the bed deposited at a depth lies: all of them."""
        return list(range(len(self.slips)))

    def lines(self, survey: Survey) -> list[np.ndarray]:
        """Points of each fault, from one end to the other.

        Raises
        ------
        SettingError
            If a fault does not cross the section or, if blind, does not end inside it.
        """
        lines = [fault.polyline(survey) for fault in self.faults]
        for index, line in enumerate(lines, 1):
            ends = survey.margin(line[[0, -1]])
            if survey.margin(line).min() < -1e-6 or (ends.max() > 1e-6 and not self.blind):
                rule = "end inside the section" if self.blind else "run from the top of the section to its border"
                raise SettingError(
                    f"fault F{index} must {rule}, "
                    f"but the section is {survey.width:g} m x {survey.depth:g} m and the fault goes from "
                    f"x={line[0, 0]:.0f}, z={line[0, 1]:.0f} to x={line[-1, 0]:.0f}, z={line[-1, 1]:.0f}; "
                    "make the section larger, or the fault steeper, shorter or of a larger radius",
                    pick=f"F{index}",
                )
        return lines

    def bed(self, depth: float, side: int) -> Callable[[np.ndarray], np.ndarray]:
        """Present-day points of the bed deposited at a depth, as a function of the deposited x; valid on one side."""
        return lambda x: self.slips[side].apply(self.fold.apply(np.column_stack([x, np.full(np.shape(x), depth)])))

    def margin(self, points: np.ndarray, side: int, survey: Survey) -> np.ndarray:
        """Distance into a block, to the nearest fault or border; negative outside."""
        left = [fault.side(points) for fault in self.faults[max(side - 1, 0) : side]]
        right = [-fault.side(points) for fault in self.faults[side : side + 1]]
        return np.asarray(np.min([survey.margin(points), *left, *right], axis=0))


def sign_change(function: Callable[[np.ndarray], np.ndarray], low: float, high: float) -> float:
    """Find where a vectorised function changes its sign in an interval, to 1e-12 of the interval's length.

    SciPy's optimizers take a quarter of a second to load, and every notebook would wait for it.
    """
    for _ in range(4):
        x = np.linspace(low, high, 1001)
        (first, *_) = np.flatnonzero(np.diff(function(x) >= 0))
        low, high = x[first : first + 2]
    return (low + high) / 2
