"""Layout of a SEG-Y file: its headers' claims, checked against the file's size and its trace headers."""

import struct
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from io import SEEK_END
from pathlib import Path
from typing import BinaryIO

import numpy as np

from seiswidgets.errors import DataError
from seiswidgets.geology.findings import Finding
from seiswidgets.io.options import check_shape

TEXT, HEADERS, TRACE_HEADER = 3200, 3600, 240
FORMATS = {  # sample format and its bytes, by SEG-Y's code
    1: ("IBM float", 4),
    2: ("integer", 4),
    3: ("integer", 2),
    5: ("IEEE float", 4),
    6: ("IEEE float", 8),
    8: ("integer", 1),
    10: ("unsigned integer", 4),
    11: ("unsigned integer", 2),
    16: ("unsigned integer", 1),
}
ORDERS = {"big": ">", "little": "<"}
FINE = 1e9  # microseconds or millimetres: no sample interval is that long
CHECKED = 64  # trace headers whose number of samples is checked
MOST_PADDING = 2**20  # zero bytes after the last trace
MOST_TEXTS = 1000  # further textual headers that revision 0 may have, if the file's size confirms them


@dataclass(frozen=True)
class Layout:
    """Arrangement of a SEG-Y file, confirmed by its length.

    Attributes
    ----------
    path : Path
    endian : "big" or "little"
    code : int
        Code of the sample format, a key of ``FORMATS``.
    samples, traces : int
        Samples per trace, and traces in the file.
    first : int
        Bytes before the first trace.
    interval : float
        Sample interval, in microseconds or millimetres; 0 if the binary header does not state it.
    x_unit : "m", "ft" or None
        Unit of lengths; None if the binary header does not state it.
    revision : int
        Revision of the standard: 0, 1 or 2.
    text : str
        The textual header, 40 lines.
    doubts : tuple of Finding
        Differences between the layout and the headers' claims.
    """

    path: Path
    endian: str
    code: int
    samples: int
    traces: int
    first: int
    interval: float
    x_unit: str | None
    revision: int
    text: str
    doubts: tuple[Finding, ...] = ()

    @property
    def trace_length(self) -> int:
        """Bytes from the start of one trace to the start of the next."""
        return TRACE_HEADER + self.samples * FORMATS[self.code][1]

    @property
    def format(self) -> str:
        """Sample format, in words."""
        kind, size = FORMATS[self.code]
        return f"{kind}, {size} bytes, {self.endian}-endian"


def read_layout(path: Path) -> Layout:
    """Read and check the layout of a SEG-Y file.

    Raises
    ------
    DataError
        If the file is not SEG-Y, or its length contradicts its headers.
    """
    with path.open("rb") as file:
        head = file.read(HEADERS)
    if len(head) < HEADERS:
        raise DataError(
            f"{path} is not a SEG-Y file: it ends after {len(head)} bytes, within the {HEADERS} bytes of the headers; "
            "it is truncated, or in another format"
        )
    endian = _byte_order(path, head)
    order = ORDERS[endian]
    code = _code(head, order)
    best = _find_arrangement(path, head, order, FORMATS[code][1])
    check_shape(path, (best.samples, best.traces))
    return Layout(
        path=path,
        endian=endian,
        code=code,
        samples=best.samples,
        traces=best.traces,
        first=best.first,
        interval=_interval(head, order),
        x_unit={1: "m", 2: "ft"}.get(struct.unpack_from(f"{order}h", head, 3254)[0]),
        revision=_revision(head),
        text=decoded(head[:TEXT]),
        doubts=tuple(Finding("warning", "headers", text) for text in _differences(best, head, order)),
    )


def _revision(head: bytes) -> int:
    """Revision of the standard: two bytes, or one number in files of some programs; 0 if it is unknown."""
    major = head[3501] if head[3500:3502] == b"\0\1" else head[3500]
    return major if major in (1, 2) else 0


def _interval(head: bytes, order: str) -> float:
    """Sample interval; the finer one of revision 2 takes precedence over the old one."""
    (fine,) = struct.unpack_from(f"{order}d", head, 3272)
    (whole,) = struct.unpack_from(f"{order}H", head, 3216)
    return float(fine if _revision(head) == 2 and 0 < fine < FINE else whole)


def begins_like_segy(head: bytes) -> bool:
    """Check whether the first bytes of a file may be SEG-Y's headers."""
    return len(head) >= HEADERS and any(_code(head, order) in FORMATS for order in ORDERS.values())


def _code(head: bytes, order: str) -> int:
    (code,) = struct.unpack_from(f"{order}H", head, 3224)
    return int(code)


def _byte_order(path: Path, head: bytes) -> str:
    """The byte order in which the two-byte code of the sample format is a known one."""
    for endian, order in ORDERS.items():
        if _code(head, order) in FORMATS:
            return endian
    raise DataError(
        f"{path} is not a SEG-Y file that can be read: bytes 3225-3226 must be the code of a sample format "
        f"({', '.join(str(code) for code in FORMATS)}), but are {head[3224]} and {head[3225]}; "
        "it is damaged, or in another format"
    )


@dataclass(frozen=True)
class _Arrangement:
    """A possible division of a file into traces, with the evidence for it.

    Attributes
    ----------
    first, samples, traces, rest : int
        Bytes before the first trace, samples per trace, whole traces, and bytes left after them.
    agreement : float
        Mean over some trace headers: 1 for each that states this number of samples, 0 for none, -1 for another.
    padded : bool
        Whether all bytes left are 0.
    """

    first: int
    samples: int
    traces: int
    rest: int
    agreement: float
    padded: bool

    @property
    def fits(self) -> bool:
        """True if the file's size confirms this; zeros at its end are accepted if all trace headers confirm it."""
        return self.traces >= 1 and (not self.rest or (self.padded and self.agreement == 1))


def _find_arrangement(path: Path, head: bytes, order: str, itemsize: int) -> _Arrangement:
    """Find the arrangement that the file's size and its trace headers confirm."""
    with path.open("rb") as file:
        tried = [
            _arrangement(file, first, samples, itemsize, order)
            for first in _starts(path, head, order)
            for samples in _sample_counts(file, head, order, first)
        ]
    if not tried:
        raise DataError(
            f"{path} states that its traces have no samples (bytes 3221-3222, and 115-116 of its first trace header); "
            "export it again from the program that it comes from"
        )
    fitting = [each for each in tried if each.fits]
    if not fitting:
        raise DataError(_misfit(path, tried[0], itemsize))
    return max(fitting, key=lambda each: each.agreement)  # of equals the first, which the binary header states


def _starts(path: Path, head: bytes, order: str) -> list[int]:
    """Possible first bytes of the first trace, the likeliest first."""
    (texts,) = struct.unpack_from(f"{order}h", head, 3504)
    if not _revision(head):  # where these bytes are unassigned: the file's size must confirm them
        return [HEADERS] + [HEADERS + TEXT * texts] * (1 <= texts <= MOST_TEXTS)
    if texts < 0:
        raise DataError(
            f"{path} has an unknown number of further textual headers (bytes 3505-3506); write it again without them"
        )
    return [HEADERS + TEXT * texts] + [HEADERS] * (texts > 0)


def _sample_counts(file: BinaryIO, head: bytes, order: str, first: int) -> list[int]:
    """Numbers of samples stated in the binary header and the first trace header, the likeliest first."""
    (samples,) = struct.unpack_from(f"{order}H", head, 3220)
    (extended,) = struct.unpack_from(f"{order}I", head, 3268)
    own = _own_counts(file, [first], order)
    stated = [extended if _revision(head) == 2 else 0, samples, *own]
    return list(dict.fromkeys(int(count) for count in stated if count))


def _own_counts(file: BinaryIO, starts: Sequence[int], order: str) -> np.ndarray:
    """Numbers of samples in the trace headers that start at some bytes of the file; 0 beyond its end."""
    counts = []
    for start in starts:
        file.seek(int(start) + 114)
        counts.append(file.read(2).ljust(2, b"\0"))
    return np.frombuffer(b"".join(counts), f"{order}u2")


def _arrangement(file: BinaryIO, first: int, samples: int, itemsize: int, order: str) -> _Arrangement:
    size = file.seek(0, SEEK_END)
    length = TRACE_HEADER + samples * itemsize
    traces, rest = divmod(max(size - first, 0), length)
    checked = np.unique(np.linspace(0, max(traces - 1, 0), min(max(traces, 1), CHECKED)).astype(np.int64)).tolist()
    own = _own_counts(file, [first + trace * length for trace in checked], order)
    agreement = float(np.where(own == samples & 0xFFFF, 1, np.where(own == 0, 0, -1)).mean())
    file.seek(size - rest)
    padded = agreement == 1 and rest <= MOST_PADDING and not file.read(rest).strip(b"\0")
    return _Arrangement(first, samples, traces, rest, agreement, padded)


def _misfit(path: Path, tried: _Arrangement, itemsize: int) -> str:
    return (
        f"{path} has {path.stat().st_size} bytes, which do not fit its headers: traces of {tried.samples} samples take "
        f"{TRACE_HEADER + tried.samples * itemsize} bytes each, from byte {tried.first} on; {tried.traces} fit, and "
        f"{tried.rest} bytes are left. It is truncated, its headers are damaged, its traces differ in length, or it "
        "has further headers or trailers of revision 2, which are not supported: copy it again from its source, or "
        "export it again as revision 1"
    )


def _differences(best: _Arrangement, head: bytes, order: str) -> Iterator[str]:
    """Describe how the arrangement that the file confirms differs from the binary header's claims."""
    (samples,) = struct.unpack_from(f"{order}H", head, 3220)
    if best.samples != samples and _revision(head) < 2:
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
        yield f"{best.rest} zero bytes after the last trace are ignored"


def decoded(text: bytes) -> str:
    """Decode SEG-Y's textual header, EBCDIC or ASCII, to lines of 80 characters, with dots for unprintable ones."""
    ebcdic = text.count(0x40) > text.count(0x20)  # the space of either
    letters = text.decode("cp500").replace("¦", "|") if ebcdic else text.decode("latin-1")  # like segyio
    shown = "".join(letter if letter.isprintable() else "." if ord(letter) else " " for letter in letters)
    return "\n".join(shown[start : start + 80].rstrip() for start in range(0, len(shown), 80))
