"""Options for opening a section file, and the axes and units that follow from them."""

from collections.abc import Callable, Iterable, Mapping
from numbers import Integral
from pathlib import Path
from reprlib import repr as brief
from typing import Any, TypedDict, Unpack, cast

import numpy as np

from seiswidgets.errors import Cancelled, DataError, Keyword, SectionError, SettingError
from seiswidgets.geology.section import SECONDS, Section
from seiswidgets.geology.validation import finite_number

Progress = Callable[[float], bool | None]
LAYOUT_OPTIONS = ("header_bytes", "sample_format", "byte_order", "revision")  # of SEG-Y
SEGY_OPTIONS = ("inline", "crossline", "offset", "traces", *LAYOUT_OPTIONS)
AXIS_OPTIONS = ("dx", "dz", "x0", "z0")
PICTURE_OPTIONS = ("crop", "calibration")
DAMAGED = (  # raised by other libraries' readers on damaged files; some of them are surprising
    ArithmeticError,
    EOFError,
    LookupError,
    OSError,
    RuntimeError,
    SyntaxError,
    TypeError,
    ValueError,
)
MOST_BYTES = 2**30  # for the amplitudes of one section
EXPECTED_TYPES: dict[str, tuple[Any, str]] = {  # of the options that are checked nowhere else
    **dict.fromkeys(("x_unit", "z_unit", "name", "credit"), (str, "a string")),
    **dict.fromkeys(("inline", "crossline", "offset"), (Integral, "a whole number")),
    "traces": ((slice, range), "a slice or a range"),
    "header_bytes": (Mapping, 'a dictionary such as {"x": 73, "y": 77}'),
    "crop": ((list, tuple), "four whole numbers (first column, last column, first row, last row)"),
    "calibration": (Mapping, "a dictionary with two points on each axis"),
}


class LayoutKeywords(TypedDict, total=False):
    """Keywords that correct the headers of a SEG-Y file, described at ``open_section``."""

    header_bytes: Mapping[str, int | tuple[int, str]] | None
    sample_format: str | int | None
    byte_order: str | None
    revision: int | None


class LineKeywords(LayoutKeywords, total=False):
    """Keywords that select a line of a SEG-Y file, described at ``open_section``."""

    inline: int | None
    crossline: int | None
    offset: int | None
    traces: slice | range | None


class OpenKeywords(LineKeywords, total=False):
    """Keywords of ``open_section``, described there."""

    dx: float | None
    dz: float | None
    x0: float | None
    z0: float | None
    extent: tuple[float, float, float, float] | None
    crop: tuple[int, int, int, int] | None
    calibration: Mapping[str, Any] | None
    x_unit: str | None
    z_unit: str | None
    velocity: float | None
    name: str | None
    credit: str | None


class OpenOptions:
    """Checked keywords of ``open_section``.

    Attributes
    ----------
    keywords : dict
        Those that were given, None left out.

    Raises
    ------
    SettingError
        If one has the wrong type, or a spacing is not above 0.
    """

    def __init__(self, **keywords: Unpack[OpenKeywords]):
        self.keywords = cast(OpenKeywords, {name: value for name, value in keywords.items() if value is not None})
        for name, value in self.given(EXPECTED_TYPES).items():
            expected, description = EXPECTED_TYPES[name]
            if not isinstance(value, expected) or isinstance(value, bool):
                raise SettingError(Keyword(name), f" must be {description}, but is {brief(value)}")
        for name, value in self.given(("dx", "dz")).items():
            if finite_number(name, value) <= 0:
                raise SettingError(Keyword(name), f" must be above 0, but is {value}")

    def given(self, names: Iterable[str]) -> dict[str, Any]:
        """Select the given options among some names."""
        keywords = cast(dict[str, Any], self.keywords)
        return {name: keywords[name] for name in names if name in keywords}

    def refuse(self, names: Iterable[str], description: str) -> None:
        """Raise SettingError if an option was given that has no meaning for this kind of file."""
        for name in self.given(names):
            raise SettingError(Keyword(name), f" has no meaning for {description}; leave it out")

    def time_or_depth(self, path: Path) -> str:
        """Unit of z, either given or implied by a velocity.

        Raises
        ------
        SettingError
            If neither was given.
        """
        if not self.given(("z_unit", "velocity")):
            raise SettingError(
                f"{path} does not say whether it is in time or in depth: give ",
                Keyword("velocity"),
                " in m/s (for two-way time in ms, or in s with ",
                Keyword("z_unit", "s"),
                "), or ",
                Keyword("z_unit", "m"),
                " (for depth)",
            )
        return self.keywords.get("z_unit") or "ms"

    def axes(self, path: Path, shape: tuple[int, int], *other: str | Keyword) -> dict[str, float]:
        """Spacing and origin of a matrix or an image, by name, from ``extent`` or from ``dx`` and ``dz``.

        ``other`` is a further way to give them, in the words of the error.

        Raises
        ------
        SettingError
            If neither or both were given, or the extent is not valid.
        """
        extent = self.keywords.get("extent")
        if extent is not None:
            self.refuse(AXIS_OPTIONS, "a file whose extent is given")
            return _axes_of_extent(extent, shape)
        if len(self.given(("dx", "dz"))) < 2:
            raise SettingError(
                f"{path} does not say how wide and how deep it is: give ",
                Keyword("extent"),
                "(x_min, x_max, z_min, z_max), the positions of its first and last trace and sample, or the spacings ",
                Keyword("dx"),
                " and ",
                Keyword("dz"),
                *other,
            )
        return self.given(AXIS_OPTIONS)


def _axes_of_extent(extent: Iterable[float], shape: tuple[int, int]) -> dict[str, float]:
    try:
        x_min, x_max, z_min, z_max = (float(value) for value in extent)
    except (TypeError, ValueError):
        raise SettingError(
            Keyword("extent"), f" must be four numbers (x_min, x_max, z_min, z_max), but is {extent!r}"
        ) from None
    if not (x_min < x_max and z_min < z_max and np.isfinite([x_min, x_max, z_min, z_max]).all()):
        raise SettingError(
            Keyword("extent"), f" must be (x_min, x_max, z_min, z_max), each minimum first, but is {extent!r}"
        )
    nz, nx = (max(count - 1, 1) for count in shape)
    return {"x0": x_min, "dx": (x_max - x_min) / nx, "z0": z_min, "dz": (z_max - z_min) / nz}


def make_section(path: Path, amplitude: np.ndarray, options: OpenOptions, **from_file: Any) -> Section:
    """Make a section from a file's amplitudes and fields; the user's options take precedence.

    Raises
    ------
    DataError
        If the amplitudes do not make a section.
    SectionError, SettingError
        If the spacing or the units do not make a section; the message names the file.
    """
    check_amplitude(path, amplitude)
    fields = {"name": path.stem, **from_file, **options.given(("x_unit", "z_unit", "velocity", "name", "credit"))}
    if "z_unit" not in fields:
        fields["z_unit"] = options.time_or_depth(path)
    if fields["z_unit"] not in SECONDS and not options.given(["velocity"]):
        fields.pop("velocity", None)
    try:
        return Section(amplitude, **fields)
    except SectionError as error:
        raise SectionError(f"{path}: ", error.text) from error


def check_shape(path: Path, shape: tuple[int, ...]) -> None:
    """Raise DataError if a matrix of this shape does not make a section."""
    if len(shape) != 2 or min(shape) < 2:
        raise DataError(
            f"{path} must hold a matrix of at least 2 samples by 2 traces, but holds an array of shape {shape}"
        )


def check_amplitude(path: Path, amplitude: np.ndarray) -> None:
    """Raise DataError if amplitudes do not make a section; the message names the file and the sample."""
    check_shape(path, amplitude.shape)
    if np.isinf(amplitude).any():
        sample, trace = np.argwhere(np.isinf(amplitude))[0]
        raise DataError(
            f"{path} has an infinite amplitude at sample {sample} of trace {trace} (both counted from 0); amplitudes "
            "must be finite, or NaN where there are no data: repair the file, or leave that trace out"
        )
    if np.isnan(amplitude).all():
        raise DataError(
            f"{path} has no amplitudes: all {amplitude.size} are NaN; choose another part of it, or another file"
        )


def check_memory(path: Path, shape: tuple[int, ...], itemsize: int = 4) -> None:
    """Raise DataError if an array of this shape would take too much memory."""
    size = itemsize
    for count in shape:
        size *= int(count)
    if size > MOST_BYTES:
        raise DataError(
            f"{path} would make a section of {' x '.join(str(count) for count in shape)} amplitudes, "
            f"{size / 2**30:.3g} GiB; the limit is {MOST_BYTES / 2**30:g} GiB: open a smaller part of it"
        )


def report_progress(progress: Progress | None, share: float) -> None:
    """Report the share done; raise Cancelled if the callback returns False."""
    if progress is not None and progress(share) is False:
        raise Cancelled("opening the file was cancelled")
