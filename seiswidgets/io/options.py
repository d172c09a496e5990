"""What a user says about a file when it is opened, and how it becomes a section's axes and units."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, fields
from numbers import Integral
from pathlib import Path
from reprlib import repr as brief

import numpy as np

from seiswidgets.errors import Cancelled, DataError, SectionError, SettingError
from seiswidgets.geology.section import SECONDS, Section

Progress = Callable[[float], bool | None]
OF_SEGY = ("inline", "crossline", "traces", "header_bytes")
OF_AXES = ("dx", "dz", "x0", "z0")
DAMAGED = (  # what other libraries' readers raise at a damaged file, some of them strange
    ArithmeticError,
    EOFError,
    LookupError,
    OSError,
    RuntimeError,
    SyntaxError,
    TypeError,
    ValueError,
)
MOST_BYTES = 2**30  # of the amplitudes of one section
KINDS = {  # of those choices that nothing else checks
    **dict.fromkeys(("x_unit", "z_unit", "name", "credit"), (str, "a text")),
    **dict.fromkeys(("inline", "crossline"), (Integral, "a whole number")),
    "traces": ((slice, range), "a slice or a range"),
    "header_bytes": (Mapping, 'a dictionary like {"x": 73, "y": 77}'),
}


@dataclass(frozen=True, kw_only=True)
class OpenOptions:
    """The keywords of ``open_section``, described there; None where nothing was said.

    Raises
    ------
    SettingError
        If one is of a kind that it cannot be.
    """

    dx: float | None = None
    dz: float | None = None
    x0: float | None = None
    z0: float | None = None
    extent: tuple[float, float, float, float] | None = None
    x_unit: str | None = None
    z_unit: str | None = None
    velocity: float | None = None
    name: str | None = None
    credit: str | None = None
    inline: int | None = None
    crossline: int | None = None
    traces: slice | range | None = None
    header_bytes: Mapping[str, int] | None = None

    def __post_init__(self):
        for name, value in self.given(KINDS).items():
            kind, words = KINDS[name]
            if not isinstance(value, kind) or isinstance(value, bool):
                raise SettingError(f"{name} must be {words}, but is {brief(value)}")

    def given(self, names=None) -> dict:
        """Those that were said, of all or of some, by name."""
        names = names or [field.name for field in fields(self)]
        return {name: getattr(self, name) for name in names if getattr(self, name) is not None}

    def refuse(self, names, kind: str):
        """SettingError if one was said that has no meaning for this kind of file."""
        for name in self.given(names):
            raise SettingError(f"{name}= has no meaning for {kind}; leave it out")

    def time_or_depth(self, path: Path) -> str:
        """The unit of z, which must have been said, or follow from a velocity.

        Raises
        ------
        SettingError
            If neither was said.
        """
        if self.z_unit is None and self.velocity is None:
            raise SettingError(
                f"{path} does not say whether it is in time or in depth: give velocity= in m/s (two-way time in ms, or "
                'in s with z_unit="s"), or z_unit="m" (depth)'
            )
        return self.z_unit or "ms"

    def axes(self, path: Path, shape: tuple[int, int]) -> dict:
        """Spacing and origin of a matrix or a picture, from ``extent`` or from ``dx`` and ``dz``, by name.

        Raises
        ------
        SettingError
            If neither, or both were said, or the extent is none.
        """
        if self.extent is None:
            if self.dx is None or self.dz is None:
                raise SettingError(
                    f"{path} does not say how long and how deep it is: give extent=(x_min, x_max, z_min, z_max), the "
                    "places of its first and last trace and sample, or the spacings dx= and dz="
                )
            return self.given(OF_AXES)
        self.refuse(OF_AXES, "an extent, which says it already")
        return _axes_of_extent(self.extent, shape)


def _axes_of_extent(extent, shape):
    try:
        x_min, x_max, z_min, z_max = (float(value) for value in extent)
    except (TypeError, ValueError):
        raise SettingError(f"extent must be four numbers (x_min, x_max, z_min, z_max), but is {extent!r}") from None
    if not (x_min < x_max and z_min < z_max and np.isfinite([x_min, x_max, z_min, z_max]).all()):
        raise SettingError(f"extent must be (x_min, x_max, z_min, z_max), each minimum first, but is {extent!r}")
    nz, nx = (max(count - 1, 1) for count in shape)
    return {"x0": x_min, "dx": (x_max - x_min) / nx, "z0": z_min, "dz": (z_max - z_min) / nz}


def section_of(path: Path, amplitude: np.ndarray, choices: OpenOptions, **found) -> Section:
    """The section of a file's amplitudes, with what was found in it, under what the user said.

    Raises
    ------
    DataError
        If the amplitudes are none.
    SectionError, SettingError
        If the spacing or the units do not make a section; the message names the file.
    """
    checked_amplitude(path, amplitude)
    said = choices.given(("x_unit", "z_unit", "velocity", "name", "credit"))
    fields = {"name": path.stem, **found, **said}
    if "z_unit" not in fields:
        fields["z_unit"] = choices.time_or_depth(path)
    if fields["z_unit"] not in SECONDS and choices.velocity is None:
        fields.pop("velocity", None)
    try:
        return Section(amplitude, **fields)
    except SectionError as error:
        raise SectionError(f"{path}: {error}") from error


def checked_shape(path: Path, shape: tuple[int, ...]):
    """DataError if a matrix of this shape makes no section."""
    if len(shape) != 2 or min(shape) < 2:
        raise DataError(f"{path} must hold a matrix of at least 2 samples by 2 traces, but holds one of shape {shape}")


def checked_amplitude(path: Path, amplitude: np.ndarray):
    """DataError if amplitudes do not make a section, with the file and the place."""
    checked_shape(path, amplitude.shape)
    if np.isinf(amplitude).any():
        sample, trace = np.argwhere(np.isinf(amplitude))[0]
        raise DataError(
            f"{path} has an infinite amplitude, at sample {sample} of trace {trace} (both counted from 0); amplitudes "
            "must be finite, or NaN where there are none: repair the file, or leave that trace out"
        )
    if np.isnan(amplitude).all():
        raise DataError(f"{path} has no amplitudes: all {amplitude.size} are NaN; choose another part, or file")


def checked_size(path: Path, shape: tuple[int, ...], itemsize: int = 4):
    """DataError if a section of this shape would take more memory than one may."""
    size = itemsize
    for count in shape:
        size *= int(count)
    if size > MOST_BYTES:
        raise DataError(
            f"{path} would make a section of {' x '.join(str(count) for count in shape)} amplitudes, "
            f"{size / 2**30:.3g} GB; a section may have {MOST_BYTES / 2**30:g} GB: open a smaller part of it"
        )


def tell(progress: Progress | None, share: float):
    """Report the share done; Cancelled if the user has had enough."""
    if progress is not None and progress(share) is False:
        raise Cancelled("opening the file was cancelled")
