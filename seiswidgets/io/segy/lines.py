"""Selection of a line's traces in a SEG-Y file: all of them, or those of an inline or a crossline of a volume.

Line numbers come from the trace headers, at bytes that the user may choose, and are read window by window.
"""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from seiswidgets.errors import DataError, Keyword, SettingError
from seiswidgets.io.options import OpenOptions, Progress, report_progress
from seiswidgets.io.segy.layout import Layout
from seiswidgets.io.segy.positions import positions
from seiswidgets.io.segy.traces import TraceHeaders
from seiswidgets.io.segy.volumes import OTHER, WINDOW, Volume, first_line, line_numbers, lines_of_volume, volume

LINE_CHOICES = (Keyword("inline"), ", ", Keyword("crossline"), " or ", Keyword("traces"))
MOST_GAPS = 4  # columns of a line for each of its traces
DEAD, TRACE_CODE, CDP = 2, 29, 21  # a code, and bytes of the trace header
PREVIEWED = 10_000  # traces of a line that a preview uses
SAMPLED = 50_000  # headers read to find one line of a volume


@dataclass(frozen=True, eq=False)
class Line:
    """Traces of a line, in order.

    Attributes
    ----------
    traces : array, shape (n,)
        Indices in the file.
    columns : array, shape (n,)
        Column of each in the section, increasing from 0; a column without a trace has no data.
    """

    traces: np.ndarray
    columns: np.ndarray

    @classmethod
    def without_gaps(cls, traces: np.ndarray) -> "Line":
        """A line whose traces follow each other."""
        return cls(traces, np.arange(len(traces)))

    @property
    def width(self) -> int:
        """Number of columns."""
        return int(self.columns[-1]) + 1

    def index_before(self, column: int) -> int:
        """Index of the last trace that is not beyond a column."""
        return max(int(np.searchsorted(self.columns, column, "right")) - 1, 0)


def sample_line(headers: TraceHeaders, lines: Mapping[str, tuple]) -> tuple[Line, tuple[int, int, int] | None]:
    """A line near the beginning of a file, to measure its spacing, and the offsets of its traces if it needs one."""
    name, traces = _sampled_traces(headers, lines)
    try:
        return _arranged(headers, name, traces, None), None
    except SettingError as error:
        if error.kind != "offset":
            return Line.without_gaps(traces), None
    offsets, counts = np.unique(headers("offset", traces), return_counts=True)
    commonest = int(offsets[np.argmax(counts)])
    return _arranged(headers, name, traces, commonest), (int(offsets[0]), int(offsets[-1]), len(offsets))


def _sampled_traces(headers: TraceHeaders, lines: Mapping[str, tuple]) -> tuple[str | None, np.ndarray]:
    """Traces of the first line of a full grid, of the longest line of another volume, or of a file's only line."""
    if not lines:
        return None, np.arange(min(headers.layout.traces, PREVIEWED))
    if volume(headers) is not None:
        slow, _, length = first_line(headers)
        return slow, np.arange(min(length, PREVIEWED))
    numbers, found = line_numbers(headers, SAMPLED), []
    for name in OTHER:
        values, counts = np.unique(numbers[name], return_counts=True)
        found.append((name, numbers["trace"][numbers[name] == values[np.argmax(counts)]]))
    name, traces = max(found, key=lambda each: len(each[1]))
    return name, traces[:PREVIEWED]


def _arranged(headers: TraceHeaders, name: str | None, traces: np.ndarray, offset: int | None) -> Line:
    """Traces of an inline or a crossline, or of a file's only line, as a line of one offset."""
    if name is None:
        return _one_line(headers, traces, offset)
    return _sorted_line(headers, name, traces, offset)


def line(headers: TraceHeaders, options: OpenOptions, progress: Progress | None) -> Line:
    """The selected line; the traces of an inline or a crossline are sorted along it, with gaps where some are missing.

    Raises
    ------
    SettingError
        If no line of a volume is selected, more than one is, or there is no such line.
    """
    layout, offset = headers.layout, options.keywords.get("offset")
    chosen = options.given(("inline", "crossline", "traces"))
    if len(chosen) > 1:
        raise SettingError("choose one of ", *LINE_CHOICES, f", not {' and '.join(chosen)}")
    if "traces" in chosen:
        options.refuse(("offset",), "a range of traces")
        return Line.without_gaps(_trace_range(layout, chosen["traces"]))
    if chosen:
        ((name, number),) = chosen.items()
        traces = _numbered_line(headers, volume(headers), name, number, progress)
        return _arranged(headers, name, traces, offset)
    if lines := lines_of_volume(headers):
        (a, b, m), (c, d, n) = lines["inline"], lines["crossline"]
        raise SettingError(
            f"{layout.path} is a volume of {m} inlines ({a} to {b}) and {n} crosslines ({c} to {d}); "
            "choose a section of it with ",
            *LINE_CHOICES,
        )
    return _arranged(headers, None, np.arange(layout.traces), offset)


def _one_line(headers: TraceHeaders, traces: np.ndarray, offset: int | None) -> Line:
    """All traces of a file with a single line, or those of one offset."""
    places = np.column_stack([headers(name, traces) for name in (CDP, "x", "y")])
    _, place = np.unique(places, axis=0, return_inverse=True)
    gathers = offset is not None or (place.any() and _offsets_at_one_place(headers, traces, place.ravel()))
    return _with_gaps(headers, _of_one_offset(headers, traces, offset) if gathers else traces)


def _with_gaps(headers: TraceHeaders, traces: np.ndarray) -> Line:
    """A file's only line, with a column for each missing trace if numbers and positions reveal it."""
    whole = Line.without_gaps(traces)
    try:
        found = positions(headers, traces)
    except DataError:  # which is reported when the spacing is measured
        return whole
    if found.is_even:
        return whole
    for name in ("crossline", CDP):
        numbers = headers(name, traces)
        steps = np.diff(numbers)
        if (steps > 0).all() or (steps < 0).all():
            columns = _columns(numbers)
            if found.at(columns).is_even:
                return Line(traces, columns)
    return whole


def _sorted_line(headers: TraceHeaders, name: str, traces: np.ndarray, offset: int | None) -> Line:
    """Traces of an inline or a crossline, sorted along it, with a column for each missing one."""
    traces = _without_padding(headers, traces)
    along = headers(OTHER[name], traces)
    if offset is not None or _offsets_at_one_place(headers, traces, along):
        traces = _of_one_offset(headers, traces, offset)
        along = headers(OTHER[name], traces)
    steps = np.diff(along)
    if not ((steps >= 0).all() or (steps <= 0).all()):
        order = np.argsort(along, kind="stable")
        traces, along = traces[order], along[order]
    if not np.diff(along).all():
        raise SettingError(
            f"{headers.layout.path} has several traces at one place of that line (the same {name}, {OTHER[name]} and "
            "offset); choose them with ",
            Keyword("traces"),
        )
    return Line(traces, _columns(along))


def _without_padding(headers: TraceHeaders, traces: np.ndarray) -> np.ndarray:
    """Leave out traces that pad a volume: those at (0, 0) that are marked as dead, or hold zeros only."""
    is_placed = (headers("x", traces) != 0) | (headers("y", traces) != 0)
    if is_placed.all() or is_placed.sum() < 2:
        return traces
    codes = headers(TRACE_CODE, traces)
    kept = [
        placed or (code != DEAD and bool(headers.amplitudes(int(trace)).any()))
        for placed, code, trace in zip(is_placed, codes, traces, strict=True)
    ]
    return traces[kept]


def _columns(along: np.ndarray) -> np.ndarray:
    """Columns of traces by their numbers along the line; one after the other if the numbers are not regular."""
    columns, rest = np.divmod(np.abs(along - along[0]), np.abs(np.diff(along)).min())
    regular = not rest.any() and columns[-1] < MOST_GAPS * len(along)
    return columns if regular else np.arange(len(along))


def _offsets_at_one_place(headers: TraceHeaders, traces: np.ndarray, place: np.ndarray) -> bool:
    """Check whether traces at one place differ in their offset, as before stack."""
    order = np.argsort(place, kind="stable")
    same = np.diff(place[order]) == 0
    return bool(same.any() and np.diff(headers("offset", traces[order]))[same].any())


def _of_one_offset(headers: TraceHeaders, traces: np.ndarray, offset: int | None) -> np.ndarray:
    offsets = headers("offset", traces)
    chosen = traces[offsets == offset]
    if len(chosen) > 1:
        return chosen
    unique = np.unique(offsets).tolist()
    few = map(str, unique if len(unique) < 5 else (*unique[:3], "...", unique[-1]))
    raise SettingError(
        f"{headers.layout.path} has traces before stack, of {len(unique)} offsets: {', '.join(few)} (byte "
        f"{headers.first_bytes['offset']} of the trace header)"
        f"{'' if offset is None else f', but {len(chosen)} traces of offset {offset}'}; choose one with ",
        Keyword("offset"),
        kind="offset",
    )


def _trace_range(layout: Layout, traces: slice | range) -> np.ndarray:
    try:
        part = range(layout.traces)[traces] if isinstance(traces, slice) else traces
    except (TypeError, ValueError):  # a slice with other things than whole numbers, or in steps of 0
        part = range(0)
    if len(part[:2]) < 2 or min(part[0], part[-1]) < 0 or max(part[0], part[-1]) >= layout.traces:
        raise SettingError(
            Keyword("traces"),
            f" must be a slice or a range of two or more of the {layout.traces} traces in {layout.path}, counted from "
            f"0, but is {traces!r}",
        )
    return np.array(part)


def _numbered_line(
    headers: TraceHeaders, grid: Volume | None, name: str, number: int, progress: Progress | None
) -> np.ndarray:
    """Traces of an inline or a crossline: in the grid if its headers agree, else found by searching all headers."""
    part = None if grid is None else grid.traces(name, number)
    if part is not None and (headers(name, part) == number).all():
        traces = np.arange(headers.layout.traces)[part]
    else:
        traces = _search(headers, name, number, progress)
    if len(traces) < 2:
        raise SettingError(
            f"{headers.layout.path} has {len(traces)} traces of {name} {number!r} (byte {headers.first_bytes[name]} of "
            f"the trace header); {_first_and_last(headers, name)}. If the numbers are at other bytes, give ",
            Keyword("header_bytes"),
        )
    return traces


def _search(headers: TraceHeaders, name: str, number: int, progress: Progress | None) -> np.ndarray:
    found, count = [], headers.layout.traces
    for start in range(0, count, WINDOW):
        found.append(start + np.flatnonzero(headers(name, slice(start, start + WINDOW)) == number))
        report_progress(progress, 0.0)
    return np.concatenate(found)


def _first_and_last(headers: TraceHeaders, name: str) -> str:
    first, last = headers(name, np.array([0, headers.layout.traces - 1]))
    return f"its first trace has {first} there, its last one {last}"
