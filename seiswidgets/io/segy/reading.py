"""SEG-Y in: a line, or a line of a volume, read through a window that holds no more than that line."""

from contextlib import contextmanager
from pathlib import Path

import numpy as np

from seiswidgets.errors import DataError
from seiswidgets.geology.findings import Finding
from seiswidgets.geology.section import Section
from seiswidgets.io.files import import_optional
from seiswidgets.io.info import TIME_OR_DEPTH, SectionInfo
from seiswidgets.io.options import OpenOptions, Progress, check_memory, make_section, report_progress
from seiswidgets.io.segy.layout import layout
from seiswidgets.io.segy.lines import TraceHeaders, checked_bytes, course, first_line, line, lines_of_volume, spacing

BLOCK = 256  # traces between two reports of progress
PREVIEWED = 10_000  # traces that a preview looks at, for their spacing
PER_MS_OR_M = {"ms": 1.0, "s": 1e-3, "m": 1.0, "km": 1e-3, "ft": 1.0}  # a depth in feet is written as if in metres


def open_segy(path: Path, choices: OpenOptions, progress: Progress | None) -> Section:
    """The section that a user chose of a SEG-Y file.

    Raises
    ------
    DataError
        If the file is damaged, or does not say what was not chosen.
    SettingError
        If a choice is missing, or is not to be had from this file.
    """
    choices.refuse(("extent",), "SEG-Y")
    z_unit = choices.time_or_depth(path)
    with trace_headers(path, choices) as headers:
        traces = line(headers, choices, progress)
        found = _axes(headers, traces, choices, PER_MS_OR_M.get(z_unit, 1.0))
        amplitude = _samples(headers, traces, progress)
    return make_section(path, amplitude, choices, **found)


@contextmanager
def trace_headers(path: Path, choices: OpenOptions):
    """The trace headers of a SEG-Y file, open for as long as the context lasts."""
    found = layout(path)
    segyio = import_optional("segyio", f"to read {path}")
    positions = checked_bytes(found, choices.keywords.get("header_bytes"))
    try:
        file = segyio.open(path, ignore_geometry=True, endian=found.endian)
    except (OSError, RuntimeError, ValueError) as error:
        raise DataError(f"{path} cannot be read as SEG-Y: {error}") from error
    with file:
        if (file.tracecount, len(file.samples)) != (found.traces, found.samples):
            raise DataError(
                f"{path} has headers that can be read in two ways ({found.traces} traces of {found.samples} samples, "
                f"or {file.tracecount} of {len(file.samples)}); write it anew as revision 1 of SEG-Y"
            )
        yield TraceHeaders(found, file, positions)


def _axes(headers, traces, choices, scale):
    """Spacing, origin and unit as the user chose, else as the headers say: z there times a scale."""
    return {
        "dx": spacing(headers, traces) if choices.keywords.get("dx") is None else choices.keywords.get("dx"),
        "dz": scale * _interval(headers, traces) if choices.keywords.get("dz") is None else choices.keywords.get("dz"),
        "x0": choices.keywords.get("x0") or 0.0,
        "z0": scale * _delay(headers, traces) if choices.keywords.get("z0") is None else choices.keywords.get("z0"),
        "x_unit": "ft" if headers.layout.feet else "m",
    }


def _interval(headers, traces):
    """Between samples, in milliseconds or metres, as the headers say in thousandths of it."""
    path, general = headers.layout.path, headers.layout.interval
    own = np.unique(headers(117, traces) & 0xFFFF)  # the standard has it signed, programs do not
    said = [value for value in (general, *own.tolist()) if value]
    if not said or np.ptp(said) >= 1:  # those of the traces are whole numbers, even where the general one is not
        several = f"speaks of several sample intervals ({', '.join(f'{value:g}' for value in sorted(said)[:5])})"
        what = several if said else "says no sample interval"
        raise DataError(
            f"{path} {what} (bytes 3217-3218 of the file, 117-118 of the trace headers); say the distance "
            "between samples, in the unit of z: dz="
        )
    return said[0] / 1000


def _delay(headers, traces):
    """Of the first sample, in milliseconds or metres; bytes 109-110, and their scalar, 215-216."""
    delay, scalar = headers(109, traces).astype(float), headers(215, traces[:1])[0]
    delay *= -1 / scalar if scalar < 0 else scalar or 1
    if np.ptp(delay):
        raise DataError(
            f"{headers.layout.path} has traces that start at different times or depths, from {delay.min():g} to "
            f"{delay.max():g} (bytes 109-110 of the trace headers); say where they shall start, in the unit of z: z0="
        )
    return float(delay[0])


def _samples(headers, traces, progress):
    """Amplitudes of some traces, as the smallest floats that hold each exactly; shape (nz, nx)."""
    samples, file = headers.layout.samples, headers.file
    kind = np.result_type(file.dtype, np.float32)
    check_memory(headers.layout.path, (samples, len(traces)), kind.itemsize)
    amplitude = np.empty((samples, len(traces)), kind)
    for start in range(0, len(traces), BLOCK):
        for place, trace in enumerate(traces[start : start + BLOCK], start):
            amplitude[:, place] = file.trace.raw[int(trace)]
        report_progress(progress, min(1.0, (start + BLOCK) / len(traces)))
    return amplitude


def line_on_map(path: Path, **line_choices) -> np.ndarray:
    """Map coordinates that the line of a SEG-Y file runs through, from its first trace on; shape (m, 2).

    Parameters
    ----------
    path : Path
    **line_choices
        The line, as for ``open_section``: inline, crossline, traces, header_bytes.

    Raises
    ------
    DataError, SettingError
        If there is no such line, or its positions are missing, uneven or angles.
    """
    choices = OpenOptions(**line_choices)
    with trace_headers(path, choices) as headers:
        return course(headers, line(headers, choices, None))


def preview_segy(path: Path, choices: OpenOptions) -> SectionInfo:
    """What a SEG-Y file holds; reads its headers alone, and of a volume only some."""
    with trace_headers(path, choices) as headers:
        found, lines = headers.layout, lines_of_volume(headers)
        first = np.arange(min(PREVIEWED, first_line(headers)[2] if lines else found.traces))
        measured = [_measured(measure, headers, first) for measure in (spacing, _interval, _delay)]
    (dx, dz, z0), findings = zip(*measured, strict=True)
    return SectionInfo(
        path=path,
        kind="SEG-Y",
        format=found.format,
        size=path.stat().st_size,
        shape=(found.samples, found.traces),
        needed=(
            *(["inline, crossline or traces"] if lines else []),
            *(name for name, value in (("dx", dx), ("dz", dz), ("z0", z0)) if value is None),
            TIME_OR_DEPTH,
        ),
        dx=dx,
        dz=dz,
        z0=z0,
        x_unit=None if dx is None else "ft" if found.feet else "m",
        inlines=lines.get("inline"),
        crosslines=lines.get("crossline"),
        header=found.text,
        findings=tuple(finding for finding in findings if finding is not None),
    )


def _measured(measure, headers, traces):
    """A number and no finding, or none and why it cannot be determined."""
    try:
        return measure(headers, traces), None
    except DataError as error:
        return None, Finding("problem", error.kind or "headers", error.text)
