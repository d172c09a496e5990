"""Traces of a SEG-Y file that make a line: all of them, or a line of a volume, told by inline and crossline numbers.

The numbers come from the trace headers, at bytes that the user may choose. They are read a window at a time.
"""

from dataclasses import dataclass

import numpy as np

from seiswidgets.errors import SettingError
from seiswidgets.io.options import OpenOptions, Progress, tell
from seiswidgets.io.segy.traces import TraceHeaders

OTHER = {"inline": "crossline", "crossline": "inline"}
SAMPLED = 50_000  # headers that are looked at to find one of its lines
FILLED = 0.25  # of a grid: the least that an unsorted volume is believed to fill
WINDOW = 65_536  # headers read at a time
COUNTED = 1_000_000  # headers that are looked at to tell which lines a volume holds that is no full grid


@dataclass(frozen=True, eq=False)
class Volume:
    """A file whose traces are a full grid of lines, one line after the other.

    Attributes
    ----------
    slow, fast : "inline" or "crossline"
        What stays the same along a line as it is written, and what changes.
    numbers : dict of str to array
        Numbers of the inlines and of the crosslines, in the file's order.
    """

    slow: str
    fast: str
    numbers: dict

    def traces(self, name: str, number: int) -> slice | None:
        """The traces of an inline or a crossline; None if there is none of that number."""
        (found,) = np.nonzero(self.numbers[name] == number)
        if not len(found):
            return None
        across, along = len(self.numbers[self.slow]), len(self.numbers[self.fast])
        start = int(found[0])
        return slice(start * along, (start + 1) * along) if name == self.slow else slice(start, across * along, along)

    def range(self, name: str) -> tuple[int, int, int]:
        """First, last and count of the inlines or the crosslines."""
        numbers = self.numbers[name]
        return int(numbers[0]), int(numbers[-1]), len(numbers)


def volume(headers: TraceHeaders) -> Volume | None:
    """The grid of lines that a file is, told from a few of its headers; None if it is none, or not a full one."""
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
    """First, last and count of a volume's inlines and crosslines; empty of a file that is one line.

    Of a volume that is no full grid they are the lowest, the highest and the count among its first million traces.
    """
    grid = volume(headers)
    if grid is not None:
        return {name: grid.range(name) for name in OTHER}
    found = _counted(headers)
    if not _cover_an_area(found["inline"], found["crossline"]):
        return {}
    unique = {name: np.unique(numbers) for name, numbers in found.items()}
    return {name: (int(numbers[0]), int(numbers[-1]), len(numbers)) for name, numbers in unique.items()}


def _counted(headers, count=COUNTED):
    return {name: headers(name, slice(0, count)) for name in OTHER}


def _cover_an_area(inline, crossline):
    """Whether traces lie side by side on a grid, as those of a volume: more of it than a line across it would meet.

    Numbers that mean something else may be as many; those of a volume fill much of their grid, or are sorted.
    """
    counts = [len(np.unique(numbers)) for numbers in (inline, crossline)]
    cells = len(np.unique((inline << 32) + (crossline & 0xFFFFFFFF)))
    if min(counts) < 2 or cells <= sum(counts) - 1:
        return False
    is_sorted = any((steps >= 0).all() or (steps <= 0).all() for steps in map(np.diff, (inline, crossline)))
    return is_sorted or cells >= FILLED * counts[0] * counts[1]


def sample_line(headers: TraceHeaders) -> np.ndarray:
    """Indices of the traces of one line of a volume: the first of a full grid, else the longest near its beginning."""
    if volume(headers) is not None:
        return np.arange(first_line(headers)[2])
    lines = []
    for name, numbers in (found := _counted(headers, SAMPLED)).items():
        values, counts = np.unique(numbers, return_counts=True)
        (traces,) = np.nonzero(numbers == values[np.argmax(counts)])
        lines.append(traces[np.argsort(found[OTHER[name]][traces], kind="stable")])
    return max(lines, key=len)


def first_line(headers: TraceHeaders) -> tuple[str, str, int]:
    """Which number stays the same along the file's first line, which changes, and how many traces that line has."""
    count = headers.layout.traces
    same = [name for name in ("inline", "crossline") if np.ptp(headers(name, slice(0, 2))) == 0]
    if len(same) != 1:
        return "inline", "crossline", count
    slow, fast = same[0], OTHER[same[0]]
    return slow, fast, _length_of_first_line(headers, slow)


def _length_of_first_line(headers, slow):
    count = headers.layout.traces
    first = headers(slow, slice(0, 1))
    for start in range(0, count, WINDOW):
        (other,) = np.nonzero(headers(slow, slice(start, start + WINDOW)) != first)
        if len(other):
            return start + int(other[0])
    return count


def line(headers: TraceHeaders, choices: OpenOptions, progress: Progress | None) -> np.ndarray:
    """Indices of the traces that the user chose, shape (n,); those of an inline or a crossline one beside the other.

    Raises
    ------
    SettingError
        If nothing was chosen of a volume, more than one thing was, or there is none such.
    """
    layout = headers.layout
    chosen = choices.given(("inline", "crossline", "traces"))
    if len(chosen) > 1:
        raise SettingError(f"choose one of inline=, crossline= and traces=, not {' and '.join(chosen)}")
    if "traces" in chosen:
        return _part(layout, choices.traces)
    if chosen:
        ((name, number),) = chosen.items()
        return _numbered(headers, volume(headers), name, number, progress)
    if lines := lines_of_volume(headers):
        (a, b, m), (c, d, n) = lines["inline"], lines["crossline"]
        raise SettingError(
            f"{layout.path} is a volume of {m} inlines ({a} to {b}) and {n} crosslines ({c} to {d}); "
            "choose a section of it by inline=, crossline= or traces="
        )
    return np.arange(layout.traces)


def _part(layout, traces):
    try:
        part = range(layout.traces)[traces] if isinstance(traces, slice) else traces
    except (TypeError, ValueError):  # of a slice of anything but whole numbers, or in steps of 0
        part = range(0)
    if len(part[:2]) < 2 or min(part[0], part[-1]) < 0 or max(part[0], part[-1]) >= layout.traces:
        raise SettingError(
            f"traces= must be a slice or a range of two traces or more, counted from 0, of the {layout.traces} in "
            f"{layout.path}, but is {traces!r}"
        )
    return np.array(part)


def _numbered(headers, grid, name, number, progress):
    """The traces of an inline or a crossline: where the grid has them, if they are there; else by all headers."""
    part = None if grid is None else grid.traces(name, number)
    if part is not None and (headers(name, part) == number).all():
        found = np.arange(headers.layout.traces)[part]
    else:
        found = _searched(headers, name, number, progress)
    if len(found) < 2:
        raise SettingError(
            f"{headers.layout.path} has {len(found)} traces of {name} {number!r} (byte {headers.bytes[name]} of the "
            f"trace header); {_numbers_there(headers, name)}. If they stand at other bytes, give header_bytes="
        )
    along = headers(OTHER[name], found)
    steps = np.diff(along)
    in_order = (steps >= 0).all() or (steps <= 0).all()
    return found if in_order else found[np.argsort(along, kind="stable")]


def _searched(headers, name, number, progress):
    found, count = [], headers.layout.traces
    for start in range(0, count, WINDOW):
        found.append(start + np.flatnonzero(headers(name, slice(start, start + WINDOW)) == number))
        tell(progress, 0.0)
    return np.concatenate(found)


def _numbers_there(headers, name):
    first, last = headers(name, np.array([0, headers.layout.traces - 1]))
    return f"its first trace has {first} there, its last {last}"
