"""A seismic section: amplitudes on a regular grid, with spacing and units."""

from collections.abc import Hashable
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike

from seiswidgets.core.resampling import resample
from seiswidgets.errors import Keyword, SectionError, number_text
from seiswidgets.geology.depth_conversion import DepthConversion, section_in_depth, section_in_time

if TYPE_CHECKING:  # velocity models import this module
    from seiswidgets.geology.velocity import Velocity

METRES = {"m": 1.0, "km": 1000.0, "ft": 0.3048}
SECONDS = {"s": 1.0, "ms": 0.001}


@dataclass(frozen=True, eq=False)
class Section:
    """Amplitudes on a regular grid of traces and samples.

    Points on a section are rows ``(x, z)``, z down, in the section's own units. Shapes are measured in rock:
    a two-way time becomes a depth of half its product with the velocity.

    Parameters
    ----------
    amplitude : array, shape (nz, nx)
        One column a trace, one row a sample. NaN, or masked, where there are no data.
    dx, dz : float
        Distance between traces, in ``x_unit``, and between samples, in ``z_unit``.
    x0, z0 : float
        Position of the first trace and the first sample.
    x_unit : {"m", "km", "ft"}
        Unit of x.
    z_unit : {"m", "km", "ft", "ms", "s"}
        Unit of z: a depth, or a two-way time, which needs a velocity.
    velocity : float
        Seismic (P-wave) velocity, in m/s; for two-way time only.
    name, credit : str
        Title of the section, and the owner of its data; shown with its pictures.
    conversion : DepthConversion, optional
        The section in time and the velocities that this one was converted from; see `to_depth`.

    Raises
    ------
    SectionError
        If a parameter is out of its range.
    """

    amplitude: np.ndarray
    dx: float
    dz: float
    x0: float = 0.0
    z0: float = 0.0
    x_unit: str = "m"
    z_unit: str = "m"
    velocity: float | None = None
    name: str = ""
    credit: str = ""
    conversion: DepthConversion | None = None

    def __post_init__(self) -> None:
        object.__setattr__(self, "amplitude", _validate_amplitude(self.amplitude))
        for field in ("dx", "dz", "x0", "z0"):
            object.__setattr__(self, field, _validate_number(field, getattr(self, field)))
        for field in ("dx", "dz"):
            if getattr(self, field) <= 0:
                raise SectionError(f"{field} must be above 0, but is {getattr(self, field):g}")
        if self.x_unit not in tuple(METRES):
            raise SectionError(f"x_unit must be one of {', '.join(METRES)}, but is {self.x_unit!r}")
        if self.z_unit not in (*METRES, *SECONDS):
            raise SectionError(f"z_unit must be one of {', '.join([*METRES, *SECONDS])}, but is {self.z_unit!r}")
        object.__setattr__(self, "velocity", self._validate_velocity())
        for field in ("name", "credit"):
            if not isinstance(getattr(self, field), str):
                raise SectionError(f"{field} must be text, but is {getattr(self, field)!r}")

    def _validate_velocity(self) -> float | None:
        if self.velocity is None:
            if self.is_time:
                raise SectionError(
                    "a section in two-way time (",
                    Keyword("z_unit", self.z_unit),
                    ") needs ",
                    Keyword("velocity"),
                    ", in m/s, to keep true shapes in rock; 2000 suits shallow, soft sediment, 3500 well-compacted "
                    "rock",
                )
            return None
        if not self.is_time:
            raise SectionError(
                "a section in depth (",
                Keyword("z_unit", self.z_unit),
                ") takes no ",
                Keyword("velocity"),
                "; leave it out",
            )
        velocity = _validate_number("velocity", self.velocity)
        if velocity <= 0:
            raise SectionError(f"velocity must be above 0 m/s, but is {velocity:g}")
        return velocity

    @property
    def is_time(self) -> bool:
        """True if z is a two-way time."""
        return self.z_unit in SECONDS

    @property
    def velocity_text(self) -> str:
        """Text for the velocities that relate time to depth, and their source; "" for a section that was in depth."""
        return str(self.conversion or "") or (f"{self.velocity:g} m/s throughout" if self.is_time else "")

    @property
    def shape(self) -> tuple[int, int]:
        """Number of samples and of traces, ``(nz, nx)``."""
        nz, nx = self.amplitude.shape
        return nz, nx

    @cached_property
    def x(self) -> np.ndarray:
        """Positions of the traces, shape (nx,)."""
        return self.x0 + self.dx * np.arange(self.shape[1])

    @cached_property
    def z(self) -> np.ndarray:
        """Positions of the samples, shape (nz,)."""
        return self.z0 + self.dz * np.arange(self.shape[0])

    @property
    def extent(self) -> tuple[float, float, float, float]:
        """First and last trace, first and last sample: ``(x_min, x_max, z_min, z_max)``."""
        nz, nx = self.shape
        return self.x0, self.x0 + self.dx * (nx - 1), self.z0, self.z0 + self.dz * (nz - 1)

    @cached_property
    def metres(self) -> np.ndarray:
        """Metres of rock in one unit of x and one of z, shape (2,)."""
        z = METRES[self.z_unit] if self.velocity is None else SECONDS[self.z_unit] * self.velocity / 2
        return np.array([METRES[self.x_unit], z])

    @cached_property
    def derived(self) -> dict[Hashable, Any]:
        """Costly results of functions of the section, kept as long as it lives."""
        return {}

    def to_rock(self, points: ArrayLike) -> np.ndarray:
        """Convert points from the section's units to metres of rock, in true proportions; shape (n, 2)."""
        return np.asarray(np.asarray(points, float) * self.metres)

    def from_rock(self, points: ArrayLike) -> np.ndarray:
        """Convert points from metres of rock to the section's units; shape (n, 2)."""
        return np.asarray(np.asarray(points, float) / self.metres)

    @property
    def unit_of_time(self) -> float:
        """Seconds in one unit of z, which must be a time."""
        return SECONDS[self.z_unit]

    def to_depth(self, velocity: "Velocity", dz: float | None = None) -> "Section":
        """Convert a section in two-way time to depth in metres, measured from time zero.

        What is restored from the result is interpolated in the recorded amplitudes, once. Its ``conversion`` carries
        points and picks between time and depth.

        Parameters
        ----------
        velocity : ConstantVelocity, LinearVelocity, TimeDepthTable or LayerCake
        dz : float, optional
            Distance between samples, in metres; that of the slowest rock if left out.

        Raises
        ------
        SectionError
            If the section is in depth, or a velocity is not positive somewhere.

        Examples
        --------
        >>> import seiswidgets as sw
        >>> amplitude = [[0, 0], [1, 1], [0, 0]]
        >>> timed = sw.Section(amplitude, dx=25, dz=4, z_unit="ms", velocity=2000)
        >>> timed.to_depth(sw.LinearVelocity(v0=1800, k=0.6)).z.round(2)
        array([ 0.  ,  3.6 ,  7.2 , 10.81])
        """
        return section_in_depth(self, velocity, None if dz is None else _validate_number("dz", dz))

    def to_time(self, velocity: "Velocity | None" = None) -> "Section":
        """Convert a section in depth to two-way time in milliseconds.

        Parameters
        ----------
        velocity : ConstantVelocity, LinearVelocity, TimeDepthTable or LayerCake, optional
            If left out, the recorded section that this one was converted from.

        Raises
        ------
        SectionError
            If the section is in time, was not converted and no velocity is given, or a velocity is not positive
            somewhere.
        """
        return section_in_time(self, velocity)

    def sampled(self, columns: np.ndarray, rows: np.ndarray, order: int) -> np.ndarray:
        """Interpolate the recorded amplitudes at positions in traces and samples; shape of ``columns``.

        A converted section is interpolated in the section in time. NaN outside. The order is 1 (linear) or 3 (cubic).
        """
        if self.conversion is None:
            return resample(self.amplitude, columns, rows, order)
        return self.conversion.sample(columns, self.z0 + self.dz * rows, order)

    def contains(self, points: ArrayLike) -> np.ndarray:
        """True for each point on the section, its border included; shape (n,) of bool."""
        x, z = np.asarray(points, float).T
        x_min, x_max, z_min, z_max = self.extent
        return np.asarray((x >= x_min) & (x <= x_max) & (z >= z_min) & (z <= z_max))

    def where(self, point: ArrayLike) -> str:
        """Text for a position, with its units."""
        x, z = np.asarray(point, float).tolist()
        return f"x={number_text(x)} {self.x_unit}, z={number_text(z)} {self.z_unit}"

    @property
    def reach(self) -> str:
        """Text for the section's extent, with its units."""
        x_min, x_max, z_min, z_max = map(number_text, self.extent)
        return f"x={x_min} to {x_max} {self.x_unit} and from z={z_min} to {z_max} {self.z_unit}"

    def __repr__(self) -> str:
        nz, nx = self.shape
        x_min, x_max, z_min, z_max = map(number_text, self.extent)
        speed = f", {self.velocity:g} m/s" if self.is_time else ""
        speed += f", {self.conversion}" if self.conversion else ""
        name = f" {self.name!r}" if self.name else ""
        credit = f"\n  data: {self.credit!r}" if self.credit else ""
        return (
            f"<Section{name}: {nx} traces x {nz} samples, x {x_min} to {x_max} {self.x_unit}, "
            f"z {z_min} to {z_max} {self.z_unit}{speed}>{credit}"
        )


def _validate_number(name: str, value: float) -> float:
    try:
        number = float(value)
    except (TypeError, ValueError):
        raise SectionError(f"{name} must be a number, but is {value!r}") from None
    if not np.isfinite(number):
        raise SectionError(f"{name} must be a finite number, but is {number}")
    return number


def filled(values: ArrayLike) -> ArrayLike:
    """Values with NaN in place of the masked ones of a masked array; others unchanged."""
    if not isinstance(values, np.ma.MaskedArray):
        return values
    return np.ma.filled(values.astype(np.result_type(values.dtype, np.float32)), np.nan)


def _validate_amplitude(amplitude: ArrayLike) -> np.ndarray:
    try:
        array = np.array(filled(amplitude))
        array = array if array.dtype in (np.float32, np.float64) else array.astype(np.float64, casting="same_kind")
    except (TypeError, ValueError):
        raise SectionError("amplitudes must be an array of real numbers, of shape (samples, traces)") from None
    if array.ndim != 2:
        raise SectionError(
            f"amplitudes must be 2-D, (samples, traces), but have {array.ndim} dimension(s), shape {array.shape}"
        )
    if min(array.shape) < 2:
        raise SectionError(f"amplitudes must be at least 2 samples by 2 traces, but have shape {array.shape}")
    if np.isinf(array).any():
        row, column = np.argwhere(np.isinf(array))[0]
        raise SectionError(
            f"amplitudes must be finite, or NaN where there are none; sample {row} of trace {column} is infinite"
        )
    if np.isnan(array).all():
        raise SectionError("all amplitudes are NaN; there is nothing to restore")
    array.setflags(write=False)
    return array
