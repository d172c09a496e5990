"""Conversion between two-way time and depth, of sections and of picks."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any, Protocol, TypeVar, overload, runtime_checkable

import numpy as np
from numpy.typing import ArrayLike

from seiswidgets.core.resampling import resample
from seiswidgets.errors import Keyword, SectionError

if TYPE_CHECKING:  # sections import this module
    from seiswidgets.geology.section import Section
    from seiswidgets.geology.velocity import Velocity

MOST_SAMPLES = 20  # times as many as in time
MOST_CONTRAST = 100  # between the velocities of one section: beyond, the lower one tends to zero
STRAIGHT = 0.1  # samples between a converted line and the chords that stand for it
LineMap = Callable[[np.ndarray], np.ndarray]


@runtime_checkable
class Mapped(Protocol):
    """A pick, or an interpretation, whose lines can be mapped."""

    def mapped(self: "Pick", line_map: LineMap) -> "Pick": ...


Pick = TypeVar("Pick", bound=Mapped)


@dataclass(frozen=True, eq=False)
class DepthConversion:
    """A vertical map between a section in time and the same section in depth.

    Points are rows ``(x, z)`` in the units of the sections. The map and its inverse are those of the velocity model, in
    closed form.

    Parameters
    ----------
    time_section : Section
        The section as it was recorded.
    velocity : ConstantVelocity, LinearVelocity, TimeDepthTable, LayerCake, or another with their methods
    dz : float
        Distance between samples in depth, in metres.
    """

    time_section: "Section"
    velocity: "Velocity"
    dz: float

    @overload
    def to_depth(self, what: Pick) -> Pick: ...
    @overload
    def to_depth(self, what: ArrayLike) -> np.ndarray: ...
    def to_depth(self, what: Pick | ArrayLike) -> Pick | np.ndarray:
        """Convert points, a pick or an interpretation from time to depth.

        Straight segments become curves, so picks get more points where chords would be off by a tenth of a sample.
        """
        return what.mapped(self._line_to_depth) if isinstance(what, Mapped) else self._points_to_depth(what)

    @overload
    def to_time(self, what: Pick) -> Pick: ...
    @overload
    def to_time(self, what: ArrayLike) -> np.ndarray: ...
    def to_time(self, what: Pick | ArrayLike) -> Pick | np.ndarray:
        """Convert points, a pick or an interpretation from depth to time; as `to_depth`."""
        return what.mapped(self._line_to_time) if isinstance(what, Mapped) else self._points_to_time(what)

    def _line_to_depth(self, line: np.ndarray) -> np.ndarray:
        return curve(line, self._points_to_depth, STRAIGHT * self.dz)

    def _line_to_time(self, line: np.ndarray) -> np.ndarray:
        return curve(line, self._points_to_time, STRAIGHT * self.time_section.dz)

    def _points_to_depth(self, points: ArrayLike) -> np.ndarray:
        x, time = np.moveaxis(np.asarray(points, float), -1, 0)
        return np.stack([x, self.velocity.depth(x * self._metres, time * self._seconds)], axis=-1)

    def _points_to_time(self, points: ArrayLike) -> np.ndarray:
        x, depth = np.moveaxis(np.asarray(points, float), -1, 0)
        return np.stack([x, self.velocity.time(x * self._metres, depth) / self._seconds], axis=-1)

    @property
    def _metres(self) -> float:
        return float(self.time_section.metres[0])

    @property
    def _seconds(self) -> float:
        return self.time_section.unit_of_time

    def sample(self, columns: np.ndarray, z: np.ndarray, order: int) -> np.ndarray:
        """Interpolate amplitudes once, in the section in time; at columns counted in traces, and at depths."""
        section = self.time_section
        x = section.x0 + section.dx * columns
        times = self._points_to_time(np.stack([x, z], axis=-1))[..., 1]
        return resample(section.amplitude, columns, (times - section.z0) / section.dz, order)

    def __str__(self) -> str:
        source = f" ({self.velocity.source})" if self.velocity.source else ""
        return f"converted from time to depth with {self.velocity}{source}"


def section_in_depth(section: "Section", velocity: "Velocity", dz: float | None) -> "Section":
    """A section in two-way time as one in depth, in metres; see `Section.to_depth`."""
    if not section.is_time:
        raise SectionError("a section in depth cannot be converted to depth; it is already there")
    if dz is not None and dz <= 0:
        raise SectionError(f"dz must be above 0, but is {dz:g}")
    conversion = DepthConversion(section, velocity, dz or 1.0)
    dz = dz or _least_step(section, conversion.to_depth, velocity)
    conversion = replace(conversion, dz=dz)
    converted = _resampled(section, conversion.to_depth, conversion.to_time, dz)
    return replace(section, **converted, z_unit="m", velocity=None, conversion=conversion)


def section_in_time(section: "Section", velocity: "Velocity | None") -> "Section":
    """A section in depth as one in two-way time, in milliseconds; see `Section.to_time`."""
    if section.is_time:
        raise SectionError("a section in two-way time cannot be converted to time; it is already there")
    if velocity is None:
        if section.conversion is None:
            raise SectionError("a section that was not converted from time needs ", Keyword("velocity"), " for that")
        return section.conversion.time_section

    def to_time(points: np.ndarray) -> np.ndarray:
        x, z = np.moveaxis(section.to_rock(points), -1, 0)
        return np.stack([points[..., 0], velocity.time(x, z) * 1000], axis=-1)

    def to_depth(points: np.ndarray) -> np.ndarray:
        x, time = np.moveaxis(points, -1, 0)
        return np.stack([x, velocity.depth(x * section.metres[0], time / 1000) / section.metres[1]], axis=-1)

    dz = _least_step(section, to_time, velocity)
    converted = _resampled(section, to_time, to_depth, dz)
    mean = 2000 * float(np.ptp(section.z) * section.metres[1]) / (dz * (len(converted["amplitude"]) - 1))
    return replace(section, **converted, z_unit="ms", velocity=mean, conversion=None)


def _least_step(section: "Section", vertical: LineMap, velocity: "Velocity") -> float:
    """Shortest distance between the samples of a trace after a vertical map."""
    steps = np.diff(vertical(np.stack(np.meshgrid(section.x, section.z), axis=-1))[..., 1], axis=0)
    if np.isfinite(steps).all() and steps.min() > steps.max() / MOST_CONTRAST:
        return float(steps.min())
    row, column = np.unravel_index(np.argmin(np.nan_to_num(steps)), steps.shape)
    where = section.where((section.x[column], section.z[row]))
    raise SectionError(f"the velocity must be positive everywhere, but {velocity} is not near {where}")


def _resampled(section: "Section", vertical: LineMap, back: LineMap, dz: float) -> dict[str, Any]:
    """Amplitudes, first sample and spacing of a section after a vertical map."""
    top, base = vertical(np.stack(np.meshgrid(section.x, section.z[[0, -1]]), axis=-1))[..., 1]
    count = int(np.ceil((base.max() - top.min()) / dz - 1e-9)) + 1
    if count > MOST_SAMPLES * section.shape[0]:
        raise SectionError(
            f"the converted section would have {count} samples, of {dz:g} each; make dz larger, or check the velocities"
        )
    columns, rows = np.meshgrid(np.arange(section.shape[1], dtype=float), np.arange(count))
    nodes = np.stack([section.x0 + section.dx * columns, top.min() + dz * rows], axis=-1)
    rows = (back(nodes)[..., 1] - section.z0) / section.dz
    return {"amplitude": section.sampled(columns, rows, 3), "z0": float(top.min()), "dz": dz}


def curve(line: np.ndarray, line_map: LineMap, tolerance: float) -> np.ndarray:
    """Map a line, with points added until its chords are within a vertical tolerance of the curve; shape (n, 2)."""
    shares = np.array([[0.25], [0.5], [0.75]])
    for _ in range(20):
        start, mapped = line[:-1, None], line_map(line)
        between = start + shares * (line[1:, None] - start)
        chords = mapped[:-1, None] + shares * np.diff(mapped, axis=0)[:, None]
        off = np.abs(line_map(between) - chords)[..., 1]
        far = off.max(axis=1) > tolerance
        if not far.any():
            return mapped
        worst = between[far, off[far].argmax(axis=1)]
        line = np.insert(line, np.flatnonzero(far) + 1, worst, axis=0)
    return line_map(line)
