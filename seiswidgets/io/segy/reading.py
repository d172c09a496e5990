"""Reading of SEG-Y: a line, or a line of a volume, without reading more samples than that line has."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any, Unpack

import numpy as np

from seiswidgets.errors import DataError
from seiswidgets.geology.findings import Finding
from seiswidgets.geology.section import Section
from seiswidgets.io.info import TIME_OR_DEPTH, SectionInfo
from seiswidgets.io.options import (
    LineKeywords,
    OpenOptions,
    Progress,
    check_memory,
    make_section,
    report_progress,
)
from seiswidgets.io.segy.amplitudes import format_doubt
from seiswidgets.io.segy.course import course, remarks, spacing
from seiswidgets.io.segy.layout import read_layout
from seiswidgets.io.segy.lines import Line, line, sample_line
from seiswidgets.io.segy.traces import TraceHeaders, checked_fields
from seiswidgets.io.segy.vertical import delay, interval, start_remarks
from seiswidgets.io.segy.volumes import lines_of_volume

BLOCK = 256  # traces between two reports of progress
PER_MS_OR_M = {"ms": 1.0, "s": 1e-3, "m": 1.0, "km": 1e-3, "ft": 1.0}  # a depth in feet is written as if in metres


def open_segy(path: Path, options: OpenOptions, progress: Progress | None) -> Section:
    """Open the section that the options select in a SEG-Y file.

    Raises
    ------
    DataError
        If the file is damaged, or lacks a value that was not given.
    SettingError
        If an option is missing, or does not apply to this file.
    """
    options.refuse(("extent",), "SEG-Y")
    z_unit = options.time_or_depth(path)
    with open_headers(path, options) as headers:
        selected = line(headers, options, progress)
        axes = _axes(headers, selected, options, PER_MS_OR_M.get(z_unit, 1.0))
        doubt = None if headers.layout.is_format_given else format_doubt(headers, selected.traces)
        if doubt:
            raise DataError(doubt.text, kind="samples")
        amplitude = _read_samples(headers, selected, progress)
    return make_section(path, amplitude, options, **axes)


@contextmanager
def open_headers(path: Path, options: OpenOptions) -> Iterator[TraceHeaders]:
    """Open the trace headers of a SEG-Y file as a context manager."""
    fields = checked_fields(options.keywords.get("header_bytes"))
    layout = read_layout(path, options)
    with path.open("rb", buffering=0) as file:
        yield TraceHeaders(layout, file, fields, options.keywords.get("x_unit") or layout.x_unit or "m")


def _axes(headers: TraceHeaders, line: Line, options: OpenOptions, scale: float) -> dict[str, Any]:
    """Spacing, origin and unit as given, or else as in the headers, whose z is multiplied by ``scale``."""
    given = options.given(("dx", "dz", "x0", "z0"))
    return {
        "dx": given["dx"] if "dx" in given else spacing(headers, line),
        "dz": given["dz"] if "dz" in given else scale * interval(headers, line.traces),
        "x0": given.get("x0", 0.0),
        "z0": given["z0"] if "z0" in given else scale * delay(headers, line.traces),
        "x_unit": headers.layout.x_unit or "m",
    }


def _read_samples(headers: TraceHeaders, line: Line, progress: Progress | None) -> np.ndarray:
    """Amplitudes of a line, in the smallest float type that holds them exactly, NaN in its gaps; shape (nz, nx)."""
    samples, count = headers.layout.samples, len(line.traces)
    dtype = np.result_type(headers.amplitudes(line.traces[0]).dtype, np.float32)
    check_memory(headers.layout.path, (samples, line.width), dtype.itemsize)
    amplitude = np.full((samples, line.width), np.nan, dtype)
    for start in range(0, count, BLOCK):
        part = slice(start, start + BLOCK)
        for column, trace in zip(line.columns[part], line.traces[part], strict=True):
            amplitude[:, column] = headers.amplitudes(trace)
        report_progress(progress, min(1.0, (start + BLOCK) / count))
    return amplitude


def line_on_map(path: Path, **line_options: Unpack[LineKeywords]) -> np.ndarray:
    """Map coordinates along the line of a SEG-Y file, from its first trace on; shape (m, 2).

    Parameters
    ----------
    path : Path
    **line_options
        The line, as for ``open_section``.

    Raises
    ------
    DataError, SettingError
        If there is no such line, or its positions are missing, uneven or angles.
    """
    options = OpenOptions(**line_options)
    with open_headers(path, options) as headers:
        return course(headers, line(headers, options, None))


def preview_segy(path: Path, options: OpenOptions) -> SectionInfo:
    """Summarise a SEG-Y file; only headers are read, and of a volume only some."""
    with open_headers(path, options) as headers:
        layout, lines = headers.layout, lines_of_volume(headers)
        first, offsets = sample_line(headers, lines)
        measures: tuple[Callable[[], float], ...] = (
            lambda: spacing(headers, first),
            lambda: interval(headers, first.traces),
            lambda: delay(headers, first.traces),
        )
        (dx, dz, z0), problems = zip(*map(_measure, measures), strict=True)
        remarked = () if dx is None else remarks(headers, first, dx)
        remarked += () if dz is None or z0 is None else start_remarks(headers, dz, z0)
        doubt = format_doubt(headers, first.traces)
    return SectionInfo(
        path=path,
        kind="SEG-Y",
        format=layout.format,
        size=path.stat().st_size,
        shape=(layout.samples, layout.traces),
        needed=(
            *(["inline, crossline or traces"] if lines else []),
            *(["offset"] if offsets else []),
            *(["sample_format"] if doubt and not layout.is_format_given else []),
            *(name for name, value in (("dx", dx), ("dz", dz), ("z0", z0)) if value is None),
            TIME_OR_DEPTH,
        ),
        dx=dx,
        dz=dz,
        z0=z0,
        x_unit=None if dx is None else layout.x_unit or "m",
        inlines=lines.get("inline"),
        crosslines=lines.get("crossline"),
        offsets=offsets,
        sample_formats=(doubt.likely, doubt.stated) if doubt else (),
        header=layout.text,
        findings=(
            *([Finding("warning" if layout.is_format_given else "problem", "samples", doubt.text)] if doubt else []),
            *(problem for problem in problems if problem is not None),
            *layout.doubts,
            *remarked,
        ),
    )


def _measure(measure: Callable[[], float]) -> tuple[float | None, Finding | None]:
    """The measured number, or a finding that says why it cannot be determined."""
    try:
        return measure(), None
    except DataError as error:
        return None, Finding("problem", error.kind or "headers", error.text)
