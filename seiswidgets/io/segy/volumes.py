"""Recognition of volumes in SEG-Y files, and the numbers of their lines, read window by window."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from seiswidgets.io.segy.traces import TraceHeaders

OTHER = {"inline": "crossline", "crossline": "inline"}
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
    numbers = line_numbers(headers, COUNTED)
    if not _cover_an_area(numbers["inline"], numbers["crossline"]):
        return {}
    unique = {name: np.unique(numbers[name]) for name in OTHER}
    return {name: (int(values[0]), int(values[-1]), len(values)) for name, values in unique.items()}


def line_numbers(headers: TraceHeaders, count: int) -> dict[str, np.ndarray]:
    """Numbers of the first traces, without those that pad a volume: both of their numbers are 0."""
    numbers = {name: headers(name, slice(0, count)) for name in OTHER}
    is_numbered = (numbers["inline"] != 0) | (numbers["crossline"] != 0)
    traces = np.flatnonzero(is_numbered) if is_numbered.any() else np.arange(len(is_numbered))
    return {"trace": traces, **{name: values[traces] for name, values in numbers.items()}}


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
