"""SEG-Y in: a line, or a line of a volume, read through a window that holds no more than that line."""

from contextlib import contextmanager
from pathlib import Path

import numpy as np

from seiswidgets.errors import DataError
from seiswidgets.geology.section import Section
from seiswidgets.io.info import HEIGHT, SectionInfo
from seiswidgets.io.options import OpenOptions, Progress, checked_size, section_of, tell
from seiswidgets.io.segy.course import course, remarks, spacing
from seiswidgets.io.segy.layout import layout
from seiswidgets.io.segy.lines import line, lines_of_volume, sample_line
from seiswidgets.io.segy.traces import TraceHeaders, checked_bytes
from seiswidgets.io.segy.vertical import delay, interval

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
    return section_of(path, amplitude, choices, **found)


@contextmanager
def trace_headers(path: Path, choices: OpenOptions):
    """The trace headers of a SEG-Y file, open for as long as the context lasts."""
    found = layout(path)
    positions = checked_bytes(choices.header_bytes)
    with path.open("rb", buffering=0) as file:
        yield TraceHeaders(found, file, positions, choices.x_unit or found.x_unit or "m")


def _axes(headers, traces, choices, scale):
    """Spacing, origin and unit as the user chose, else as the headers say: z there times a scale."""
    return {
        "dx": spacing(headers, traces) if choices.dx is None else choices.dx,
        "dz": scale * interval(headers, traces) if choices.dz is None else choices.dz,
        "x0": choices.x0 or 0.0,
        "z0": scale * delay(headers, traces) if choices.z0 is None else choices.z0,
        "x_unit": headers.layout.x_unit or "m",
    }


def _samples(headers, traces, progress):
    """Amplitudes of some traces, as the smallest floats that hold each exactly; shape (nz, nx)."""
    samples = headers.layout.samples
    kind = np.result_type(headers.amplitudes(traces[0]).dtype, np.float32)
    checked_size(headers.layout.path, (samples, len(traces)), kind.itemsize)
    amplitude = np.empty((samples, len(traces)), kind)
    for start in range(0, len(traces), BLOCK):
        for place, trace in enumerate(traces[start : start + BLOCK], start):
            amplitude[:, place] = headers.amplitudes(trace)
        tell(progress, min(1.0, (start + BLOCK) / len(traces)))
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
        first = (sample_line(headers) if lines else np.arange(min(PREVIEWED, found.traces)))[:PREVIEWED]
        measured = [_measured(measure, headers, first) for measure in (spacing, interval, delay)]
        (dx, dz, z0), reasons = zip(*measured, strict=True)
        notes = found.notes if dx is None else (*found.notes, *remarks(headers, first, dx))
    return SectionInfo(
        path=path,
        kind="SEG-Y",
        format=found.format,
        size=path.stat().st_size,
        shape=(found.samples, found.traces),
        needed=(
            *(["inline, crossline or traces"] if lines else []),
            *(name for name, value in (("dx", dx), ("dz", dz), ("z0", z0)) if value is None),
            HEIGHT,
        ),
        dx=dx,
        dz=dz,
        z0=z0,
        x_unit=None if dx is None else found.x_unit or "m",
        inlines=lines.get("inline"),
        crosslines=lines.get("crossline"),
        header=found.text,
        reasons=tuple(filter(None, reasons)),
        notes=notes,
    )


def _measured(measure, headers, traces):
    """A number and no reason, or none and the reason."""
    try:
        return measure(headers, traces), ""
    except DataError as error:
        return None, str(error)
