"""Which traces of a SEG-Y file make a line, and how far apart they stand.

Numbers and positions come from the trace headers, at bytes that the user may choose. They are read a window at a time.
"""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from seiswidgets.errors import DataError, SettingError
from seiswidgets.io.files import import_optional
from seiswidgets.io.options import OpenOptions, Progress, report_progress
from seiswidgets.io.segy.layout import Layout

BYTES = {"inline": 189, "crossline": 193, "x": 181, "y": 185, "scalar": 71}  # as revision 1 of the standard has them
OTHER = {"inline": "crossline", "crossline": "inline"}
PLACES = ((181, 185), (73, 77), (81, 85))  # of the midpoint; source and receiver, where old lines have their positions
WINDOW = 65_536  # headers read at a time
COUNTED = 1_000_000  # headers that are looked at to tell which lines a volume holds that is no full grid
EVEN = 0.05  # of the spacing: what a step may differ from it, beside the rounding of the positions
SCALARS = (0, 1, 10, 100, 1000, 10_000)  # of positions, or below 0; 0 is taken for 1
DEGREES, CLOSE = (360, 90), 0.005  # positions within these, and no farther apart, cannot be metres or feet
STRAIGHT = 0.01  # of its length: by how much a line may be longer than the way from end to end


@dataclass(frozen=True)
class TraceHeaders:
    """The trace headers of an open file.

    Parameters
    ----------
    layout : Layout
    file : segyio.SegyFile
    bytes : dict of str to int
        Where each number stands, by name.
    """

    layout: Layout
    file: object
    bytes: Mapping[str, int]

    def __call__(self, name: str | int, traces) -> np.ndarray:
        """A number of each of some traces (an array or a slice); shape (n,)."""
        return self.file.attributes(self.bytes.get(name, name))[traces].astype(np.int64)


def checked_bytes(layout: Layout, chosen: Mapping[str, int] | None) -> dict[str, int]:
    """The bytes of the trace header at which each number stands, the user's choice over the standard's.

    Raises
    ------
    SettingError
        If a name or a byte is not one of SEG-Y's.
    """
    known = [int(field) for field in import_optional("segyio", f"to read {layout.path}").TraceField.enums()]
    for name, byte in (chosen or {}).items():
        if name not in BYTES:
            raise SettingError(f"header_bytes= takes {', '.join(BYTES)}, but has {name!r}")
        if byte not in known:
            raise SettingError(
                f"header_bytes= says that {name} stands at byte {byte!r} of the trace header, where no number starts; "
                "usual are 9, 21, 189, 193 for the lines' numbers, and 73, 77, 81, 85, 181, 185 for positions"
            )
    return BYTES | {name: int(byte) for name, byte in (chosen or {}).items()}


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
    count, (_, fast, length) = headers.layout.traces, first_line(headers)
    if length == count:
        return {}
    first, last, following = headers(fast, np.array([0, length - 1, length]))
    if np.sign(last - first) == np.sign(following - last):  # it goes on, as a line does that crosses a grid
        return {}
    found = {name: np.unique(headers(name, slice(0, COUNTED))) for name in OTHER}
    return {name: (int(numbers[0]), int(numbers[-1]), len(numbers)) for name, numbers in found.items()}


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
        return _part(layout, choices.keywords.get("traces"))
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
        report_progress(progress, 0.0)
    return np.concatenate(found)


def _numbers_there(headers, name):
    first, last = headers(name, np.array([0, headers.layout.traces - 1]))
    return f"its first trace has {first} there, its last {last}"


def spacing(headers: TraceHeaders, traces: np.ndarray) -> float:
    """Distance between the traces of a line, from their positions, in their own unit; errors as for ``course``."""
    return float(np.hypot(*np.diff(course(headers, traces), axis=0).T).sum()) / (len(traces) - 1)


def course(headers: TraceHeaders, traces: np.ndarray) -> np.ndarray:
    """Where a line runs on the map, in its own unit: through the positions of its traces, shape (m, 2).

    A straight line is given by its ends, since rounded positions make the way along them longer.

    Raises
    ------
    DataError
        If positions are missing, are angles, or are not evenly spaced.
    """
    _refuse_angles(headers, traces)
    x, y, rounding = _positions(headers, traces)
    steps = np.hypot(np.diff(x), np.diff(y))
    if not steps.any():
        raise DataError(_missing(headers, traces))
    typical = float(np.median(steps))
    if typical < CLOSE and np.abs(x).max() <= DEGREES[0] and np.abs(y).max() <= DEGREES[1]:
        raise DataError(
            f"{headers.layout.path} has positions {typical:.2g} apart, all within ±{DEGREES[0]} and ±{DEGREES[1]}, "
            "which seem to be degrees, and are no distances then; say how far apart its traces are: dx="
        )
    off = np.abs(steps - typical)
    if off.max() > EVEN * typical + 1.5 * rounding:  # both ends are rounded, in x and in y
        raise DataError(_uneven(headers, traces, steps, int(np.argmax(off))))
    chord = np.hypot(x[-1] - x[0], y[-1] - y[0])
    places = np.column_stack([x, y])
    return places[[0, -1]] if steps.sum() <= (1 + STRAIGHT) * chord else places


def _uneven(headers, traces, steps, worst):
    same = "" if steps.all() else "; some stand at the same place, as those of a gather before it is stacked do"
    return (
        f"{headers.layout.path} has unevenly spaced traces: most are {np.median(steps):g} apart, but traces "
        f"{traces[worst]} and {traces[worst + 1]} (counted from 0) {steps[worst]:g}{same}. Choose another part, or a "
        "line of a volume (inline=, crossline=, traces=), or say how far apart they shall count: dx="
    )


def _positions(headers, traces):
    """Positions of traces, and what they are rounded to."""
    scalar = headers("scalar", traces).astype(float)
    other = scalar[~np.isin(np.abs(scalar), SCALARS)]
    if len(other):
        raise DataError(
            f"{headers.layout.path} has {other[0]:g} as the scalar of its positions (byte {headers.bytes['scalar']} of "
            "the trace header), which must be 1, 10, 100, 1000 or 10000, or one of these below 0. If it stands at "
            "another byte, give header_bytes=; or say how far apart the traces are: dx="
        )
    factor = np.where(scalar < 0, -1 / np.where(scalar == 0, 1, scalar), np.where(scalar == 0, 1, scalar))
    return headers("x", traces) * factor, headers("y", traces) * factor, float(factor.max())


def _refuse_angles(headers, traces):
    unit = int(headers(89, traces[:1])[0])
    if unit in (2, 3, 4):
        raise DataError(
            f"{headers.layout.path} has positions in degrees or seconds of arc (bytes 89-90 of the trace header: "
            f"{unit}), which are no distances; say how far apart its traces are: dx="
        )


def _missing(headers, traces):
    x, y = headers.bytes["x"], headers.bytes["y"]
    said = f"{headers.layout.path} has no positions of its traces: bytes {x} and {y} of all headers hold the same"
    for other_x, other_y in PLACES:
        if any(np.ptp(headers(byte, traces)) for byte in (other_x, other_y)):
            others = f'header_bytes={{"x": {other_x}, "y": {other_y}}}'
            return f"{said}. Others stand at bytes {other_x} and {other_y}: give {others}, or the distance dx="
    return f"{said}. Say how far apart they are: dx="
