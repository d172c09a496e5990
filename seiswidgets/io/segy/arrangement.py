"""Division of a SEG-Y file into traces: the headers' claims, checked against the file's size and its trace headers."""

import struct
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from io import SEEK_END
from pathlib import Path
from typing import BinaryIO

import numpy as np

from seiswidgets.errors import DataError, Keyword
from seiswidgets.io.segy.formats import FORMATS, HEADERS, LABEL, TEXT, TRACE_HEADER, label_size, revision

CHECKED = 64  # trace headers whose number of samples is checked
MOST_PADDING = 2**20  # bytes after the last trace
MOST_UNCOUNTED = 40  # further textual headers if the binary header does not state their number
MOST_TEXTS = 1000  # further textual headers that revision 0 may have, if the file's size confirms them


@dataclass(frozen=True)
class Arrangement:
    """A possible division of a file into traces, with the evidence for it.

    Attributes
    ----------
    first, samples, traces, rest : int
        Bytes before the first trace, samples per trace, whole traces, and bytes left after them.
    agreement : float
        Mean over some trace headers: 1 for each that states this number of samples, 0 for none, -1 for another.
    silent : bool
        Whether none of these headers states a number.
    padded : bool
        Whether the bytes left are not the beginning of a trace.
    zeros : bool
        Whether all of them are 0.
    """

    first: int
    samples: int
    traces: int
    rest: int
    agreement: float
    silent: bool
    padded: bool
    zeros: bool

    def is_better_than(self, other: "Arrangement | None") -> bool:
        """Check whether size and trace headers confirm this exactly, and another one less well.

        If trace headers do not state numbers of samples, zeros in all of them confirm it better than other numbers.
        """
        if self.traces < 2 or self.rest or not (self.agreement == 1 or self.silent):
            return False
        if other is None:
            return True
        return (self.agreement == 1 and self.traces > other.traces) or other.agreement < min(self.agreement, 1)

    @property
    def fits(self) -> bool:
        """True if the size confirms this; bytes after the last trace are accepted if all trace headers confirm it."""
        return self.traces >= 1 and (not self.rest or (self.padded and self.agreement == 1))


def arrangements(path: Path, head: bytes, order: str, itemsize: int) -> list[Arrangement]:
    """Possible arrangements for a size of the samples."""
    with path.open("rb") as file:
        label = label_size(file.read(LABEL))
        return [
            _arrangement(file, first + label, samples, itemsize, order)
            for first in _starts(head, order)
            for samples in _sample_counts(file, head, order, first + label)
        ]


def find_arrangement(path: Path, head: bytes, order: str, code: int) -> Arrangement:
    """Find the arrangement that the file's size and its trace headers confirm."""
    itemsize = FORMATS[code].size
    tried = arrangements(path, head, order, itemsize)
    if not tried:
        raise DataError(
            f"{path} states that its traces have no samples (bytes 3221-3222, and 115-116 of its first trace header); "
            "export it again from the program that it comes from"
        )
    fitting = [each for each in tried if each.fits]
    best = max(fitting, key=lambda each: each.agreement, default=None)  # of equals the first, which the header states
    sizes = {each.size for each in FORMATS.values()} - {itemsize}
    others = [(each, size) for size in sizes for each in arrangements(path, head, order, size)]
    better = [(each.agreement, each.traces, size) for each, size in others if each.is_better_than(best)]
    if better:
        raise DataError(*_other_size(path, code, max(better)[2]), kind="samples")
    if best is None:
        raise DataError(_misfit(path, tried[0], itemsize))
    return best


def _other_size(path: Path, code: int, size: int) -> tuple[str | Keyword, ...]:
    names = [each.name for each in FORMATS.values() if each.size == size]
    return (
        f"{path} states that its samples are {FORMATS[code].words} (bytes 3225-3226), but its size and its trace "
        f"headers fit samples of {size} byte{'s' * (size > 1)}: give ",
        Keyword("sample_format", names[0]),
        *(f" or {name!r}" for name in names[1:]),
    )


def _starts(head: bytes, order: str) -> list[int]:
    """Possible first bytes of the first trace, the likeliest first."""
    (texts,) = struct.unpack_from(f"{order}h", head, 3504)
    if not revision(head):  # where these bytes are unassigned: the file's size must confirm them
        return [HEADERS] + [HEADERS + TEXT * texts] * (1 <= texts <= MOST_TEXTS)
    if texts < 0:  # an unknown number, which the trace headers reveal
        return [HEADERS + TEXT * count for count in range(MOST_UNCOUNTED)]
    return [HEADERS + TEXT * texts] + [HEADERS] * (texts > 0)


def _sample_counts(file: BinaryIO, head: bytes, order: str, first: int) -> list[int]:
    """Numbers of samples stated in the binary header and the first trace header, the likeliest first."""
    (samples,) = struct.unpack_from(f"{order}H", head, 3220)
    (extended,) = struct.unpack_from(f"{order}I", head, 3268)
    own = _own_counts(file, [first], order)
    stated = [extended if revision(head) == 2 else 0, samples, *own]
    return list(dict.fromkeys(int(count) for count in stated if count))


def _own_counts(file: BinaryIO, starts: Sequence[int], order: str) -> np.ndarray:
    """Numbers of samples in the trace headers that start at some bytes of the file; 0 beyond its end."""
    counts = []
    for start in starts:
        file.seek(int(start) + 114)
        counts.append(file.read(2).ljust(2, b"\0"))
    return np.frombuffer(b"".join(counts), f"{order}u2")


def _arrangement(file: BinaryIO, first: int, samples: int, itemsize: int, order: str) -> Arrangement:
    size = file.seek(0, SEEK_END)
    length = TRACE_HEADER + samples * itemsize
    traces, rest = divmod(max(size - first, 0), length)
    checked = np.unique(np.linspace(0, max(traces - 1, 0), min(max(traces, 1), CHECKED)).astype(np.int64)).tolist()
    own = _own_counts(file, [first + trace * length for trace in checked], order)
    agreement = float(np.where(own == samples & 0xFFFF, 1, np.where(own == 0, 0, -1)).mean())
    file.seek(size - rest)
    left = file.read(min(rest, MOST_PADDING)) if agreement == 1 else b""
    begins_a_trace = left[114:116] == struct.pack(f"{order}H", samples & 0xFFFF)
    padded = agreement == 1 and rest <= MOST_PADDING and not begins_a_trace
    return Arrangement(first, samples, traces, rest, agreement, not own.any(), padded, not left.strip(b"\0"))


def _misfit(path: Path, tried: Arrangement, itemsize: int) -> str:
    return (
        f"{path} has {path.stat().st_size} bytes, which do not fit its headers: traces of {tried.samples} samples take "
        f"{TRACE_HEADER + tried.samples * itemsize} bytes each, from byte {tried.first} on; {tried.traces} fit, and "
        f"{tried.rest} bytes are left. It is truncated, its headers are damaged, its traces differ in length, or it "
        "has further headers or trailers of revision 2, which are not supported: copy it again from its source, or "
        "export it again as revision 1"
    )


def differences(best: Arrangement, head: bytes, order: str) -> Iterator[str]:
    """Describe how the arrangement that the file confirms differs from the binary header's claims."""
    (samples,) = struct.unpack_from(f"{order}H", head, 3220)
    if best.samples != samples and revision(head) < 2:
        yield (
            f"the binary header states {samples} samples per trace (bytes 3221-3222); {best.samples} are read, as "
            "the trace headers state and the file's size confirms"
        )
    elif best.agreement < 0:
        yield (
            f"trace headers state other numbers of samples (bytes 115-116) than the binary header; {samples} are read, "
            "as the binary header states and the file's size confirms"
        )
    if best.rest:
        zeros = "zero bytes" if best.zeros else "bytes of another kind"
        yield f"{best.rest} {zeros} after the last trace are ignored"
