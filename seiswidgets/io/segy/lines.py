"""Selection of a line's traces in a SEG-Y file: all of them, or those of an inline or a crossline of a volume.

Line numbers come from the trace headers, at bytes that the user may choose, and are read window by window.
"""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from seiswidgets.errors import Keyword, SettingError
from seiswidgets.io.options import OpenOptions, Progress, report_progress
from seiswidgets.io.segy.layout import Layout
from seiswidgets.io.segy.traces import TraceHeaders

LINE_CHOICES = (Keyword("inline"), ", ", Keyword("crossline"), " or ", Keyword("traces"))
OTHER = {"inline": "crossline", "crossline": "inline"}
SAMPLED = 50_000  # headers read to find one line of a volume
FILLED = 0.25  # of a grid: the smallest share that an unsorted volume is assumed to fill
WINDOW = 65_536  # headers read at a time
COUNTED = 1_000_000  # headers read to list the lines of a volume that is not a full grid


@dataclass(frozen=True, eq=False)
class Volume:
    """A file whose traces are a full grid of lines, one line after the other.

    Attributes
    ----------
    slow, fast : "inline" or "crossline"
        The number that is constant along a line as it is written, and the one that changes.
    numbers : dict of str to array
        Numbers of the inlines and of the crosslines, in the file's order.
    """

    slow: str
    fast: str
    numbers: Mapping[str, np.ndarray]

    def traces(self, name: str, number: int) -> slice | None:
        """Traces of an inline or a crossline, or None if there is no line of that number."""
        (indices,) = np.nonzero(self.numbers[name] == number)
        if not len(indices):
            return None
        across, along = len(self.numbers[self.slow]), len(self.numbers[self.fast])
        start = int(indices[0])
        return slice(start * along, (start + 1) * along) if name == self.slow else slice(start, across * along, along)

    def range(self, name: str) -> tuple[int, int, int]:
        """First number, last number and count of the inlines or the crosslines."""
        numbers = self.numbers[name]
        return int(numbers[0]), int(numbers[-1]), len(numbers)


def volume(headers: TraceHeaders) -> Volume | None:
    """The full grid of lines in a file, recognised by a few of its headers; None if it is not a full grid."""
    count, (slow, fast, length) = headers.layout.traces, first_line(headers)
    if length == count or count % length:
        return None
    numbers = {slow: headers(slow, slice(0, None, length)), fast: headers(fast, slice(0, length))}
    if not np.array_equal(headers(fast, slice(length, 2 * length)), numbers[fast]):
        return None
    steps = [np.diff(line) for line in numbers.values()]
    if not all((step > 0).all() or (step < 0).all() for step in steps):
        return None
    return Volume(slow, fast, numbers)


def lines_of_volume(headers: TraceHeaders) -> dict[str, tuple[int, int, int]]:
    """First, last and count of a volume's inlines and crosslines; empty for a file with a single line.

    For a volume that is not a full grid, they are the lowest, the highest and the count in its first million traces.
    """
    grid = volume(headers)
    if grid is not None:
        return {name: grid.range(name) for name in OTHER}
    numbers = _line_numbers(headers, COUNTED)
    if not _cover_an_area(numbers["inline"], numbers["crossline"]):
        return {}
    unique = {name: np.unique(values) for name, values in numbers.items()}
    return {name: (int(values[0]), int(values[-1]), len(values)) for name, values in unique.items()}


def _line_numbers(headers: TraceHeaders, count: int) -> dict[str, np.ndarray]:
    return {name: headers(name, slice(0, count)) for name in OTHER}


def _cover_an_area(inline: np.ndarray, crossline: np.ndarray) -> bool:
    """Check whether traces cover more cells of their grid than a line across it would.

    Numbers with another meaning may also do that, but those of a volume fill much of their grid, or are sorted.
    """
    counts = [len(np.unique(numbers)) for numbers in (inline, crossline)]
    cells = len(np.unique((inline << 32) + (crossline & 0xFFFFFFFF)))
    if min(counts) < 2 or cells <= sum(counts) - 1:
        return False
    is_sorted = any((steps >= 0).all() or (steps <= 0).all() for steps in map(np.diff, (inline, crossline)))
    return bool(is_sorted or cells >= FILLED * counts[0] * counts[1])


def sample_line(headers: TraceHeaders) -> np.ndarray:
    """Indices of the traces of one line: the first line of a full grid, else the longest line near the beginning."""
    if volume(headers) is not None:
        return np.arange(first_line(headers)[2])
    lines = []
    line_numbers = _line_numbers(headers, SAMPLED)
    for name, numbers in line_numbers.items():
        values, counts = np.unique(numbers, return_counts=True)
        (traces,) = np.nonzero(numbers == values[np.argmax(counts)])
        lines.append(traces[np.argsort(line_numbers[OTHER[name]][traces], kind="stable")])
    return max(lines, key=len)


def first_line(headers: TraceHeaders) -> tuple[str, str, int]:
    """Names of the constant and the changing number along the file's first line, and its number of traces."""
    count = headers.layout.traces
    same = [name for name in ("inline", "crossline") if np.ptp(headers(name, slice(0, 2))) == 0]
    if len(same) != 1:
        return "inline", "crossline", count
    slow, fast = same[0], OTHER[same[0]]
    return slow, fast, _length_of_first_line(headers, slow)


def _length_of_first_line(headers: TraceHeaders, slow: str) -> int:
    count = headers.layout.traces
    first = headers(slow, slice(0, 1))
    for start in range(0, count, WINDOW):
        (other,) = np.nonzero(headers(slow, slice(start, start + WINDOW)) != first)
        if len(other):
            return start + int(other[0])
    return count


def line(headers: TraceHeaders, options: OpenOptions, progress: Progress | None) -> np.ndarray:
    """Indices of the selected traces, shape (n,); those of an inline or a crossline are sorted along it.

    Raises
    ------
    SettingError
        If no line of a volume is selected, more than one is, or there is no such line.
    """
    layout = headers.layout
    chosen = options.given(("inline", "crossline", "traces"))
    if len(chosen) > 1:
        raise SettingError("choose one of ", *LINE_CHOICES, f", not {' and '.join(chosen)}")
    if "traces" in chosen:
        return _trace_range(layout, chosen["traces"])
    if chosen:
        ((name, number),) = chosen.items()
        return _numbered_line(headers, volume(headers), name, number, progress)
    if lines := lines_of_volume(headers):
        (a, b, m), (c, d, n) = lines["inline"], lines["crossline"]
        raise SettingError(
            f"{layout.path} is a volume of {m} inlines ({a} to {b}) and {n} crosslines ({c} to {d}); "
            "choose a section of it with ",
            *LINE_CHOICES,
        )
    return np.arange(layout.traces)


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
    along = headers(OTHER[name], traces)
    steps = np.diff(along)
    in_order = (steps >= 0).all() or (steps <= 0).all()
    return traces if in_order else traces[np.argsort(along, kind="stable")]


def _search(headers: TraceHeaders, name: str, number: int, progress: Progress | None) -> np.ndarray:
    found, count = [], headers.layout.traces
    for start in range(0, count, WINDOW):
        found.append(start + np.flatnonzero(headers(name, slice(start, start + WINDOW)) == number))
        report_progress(progress, 0.0)
    return np.concatenate(found)


def _first_and_last(headers: TraceHeaders, name: str) -> str:
    first, last = headers(name, np.array([0, headers.layout.traces - 1]))
    return f"its first trace has {first} there, its last one {last}"
