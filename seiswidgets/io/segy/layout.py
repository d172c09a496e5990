"""The layout of a SEG-Y file: its headers' claims, weighed against the file's size and against its trace headers."""

import struct
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from seiswidgets.errors import DataError
from seiswidgets.io.options import checked_shape

TEXT, HEADERS, TRACE_HEADER = 3200, 3600, 240
FORMATS = {  # SEG-Y's code: what a sample is, and its bytes
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
CHECKED = 64  # trace headers that are asked for their number of samples
MOST_PADDING = 2**20  # zero bytes behind the last trace
MOST_TEXTS = 1000  # further textual headers that a file of revision 0 is believed to have, if its size confirms them


@dataclass(frozen=True)
class Layout:
    """Sizes of a SEG-Y file, confirmed by its length.

    Attributes
    ----------
    path : Path
    endian : "big" or "little"
    code : int
        Of the samples' format, a key of ``FORMATS``.
    samples, traces : int
        Samples a trace, and traces in the file.
    first : int
        Bytes before the first trace.
    interval : float
        Of the samples, in microseconds or in millimetres; 0 where the binary header does not say.
    x_unit : "m", "ft" or None
        Unit of lengths; None where the binary header does not say.
    revision : int
        Of the standard: 0, 1 or 2.
    text : str
        The textual header, 40 lines.
    notes : tuple of str
        Where the layout differs from what the headers claim.
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
    notes: tuple[str, ...] = ()

    @property
    def trace_length(self) -> int:
        """Bytes from the start of one trace to the start of the next."""
        return TRACE_HEADER + self.samples * FORMATS[self.code][1]

    @property
    def format(self) -> str:
        """What a sample is, in words."""
        kind, size = FORMATS[self.code]
        return f"{kind}, {size} bytes, {self.endian}-endian"


def layout(path: Path) -> Layout:
    """The layout of a SEG-Y file.

    Raises
    ------
    DataError
        If the file is not SEG-Y, or its length is not what its headers say.
    """
    with path.open("rb") as file:
        head = file.read(HEADERS)
    if len(head) < HEADERS:
        raise DataError(
            f"{path} is no SEG-Y file: it ends after {len(head)} bytes, within the {HEADERS} of the headers; "
            "it was cut short, or is of another kind"
        )
    endian = _byte_order(path, head)
    order = ORDERS[endian]
    code = _code(head, order)
    found, notes = _arrangement(path, head, order, FORMATS[code][1])
    checked_shape(path, (found.samples, found.traces))
    return Layout(
        path=path,
        endian=endian,
        code=code,
        samples=found.samples,
        traces=found.traces,
        first=found.first,
        interval=_interval(head, order),
        x_unit={1: "m", 2: "ft"}.get(struct.unpack_from(f"{order}h", head, 3254)[0]),
        revision=_revision(head),
        text=decoded(head[:TEXT]),
        notes=notes,
    )


def _revision(head):
    """The revision of the standard: two bytes, or by some programs one number; anything unknown is revision 0."""
    major = head[3501] if head[3500:3502] == b"\0\1" else head[3500]
    return major if major in (1, 2) else 0


def _interval(head, order):
    """The sample interval; revision 2 has a finer one, which counts over the old one."""
    (fine,) = struct.unpack_from(f"{order}d", head, 3272)
    return fine if _revision(head) == 2 and 0 < fine < FINE else struct.unpack_from(f"{order}H", head, 3216)[0]


def begins_like_segy(head: bytes) -> bool:
    """Whether the beginning of a file may be SEG-Y's headers."""
    return len(head) >= HEADERS and any(_code(head, order) in FORMATS for order in ORDERS.values())


def _code(head, order):
    return struct.unpack_from(f"{order}H", head, 3224)[0]


def _byte_order(path, head):
    """The one of the two in which the code of the format, two bytes, is one that there is."""
    for endian, order in ORDERS.items():
        if _code(head, order) in FORMATS:
            return endian
    raise DataError(
        f"{path} is no SEG-Y file that can be read: bytes 3225-3226 must be the code of a sample format "
        f"({', '.join(str(code) for code in FORMATS)}), but are {head[3224]} and {head[3225]}; "
        "it is damaged, or of another kind"
    )


@dataclass(frozen=True)
class _Arrangement:
    """A way to divide a file into traces, with the evidence for it.

    Attributes
    ----------
    first, samples, traces, rest : int
        Bytes before the first trace, samples a trace, whole traces, and bytes left behind them.
    agreement : float
        Mean over some trace headers: 1 if they state this number of samples, 0 if none, -1 if another.
    padded : bool
        Whether the bytes left are all 0.
    """

    first: int
    samples: int
    traces: int
    rest: int
    agreement: float
    padded: bool

    @property
    def fits(self):
        """Whether the file's size confirms this; zeros at its end are let pass if all trace headers confirm it."""
        return self.traces >= 1 and (not self.rest or (self.padded and self.agreement == 1))


def _arrangement(path, head, order, itemsize):
    """Find the arrangement that the file's size and its trace headers confirm; and notes on what differs."""
    with path.open("rb") as file:
        tried = [
            _tried(file, path.stat().st_size, first, samples, itemsize, order)
            for first in _starts(path, head, order)
            for samples in _counts(file, head, order, first)
        ]
    if not tried:
        raise DataError(
            f"{path} says that its traces have no samples (bytes 3221-3222, and 115-116 of its first trace header); "
            "write it anew from the program it is from"
        )
    fitting = [each for each in tried if each.fits]
    if not fitting:
        raise DataError(_misfit(path, tried[0], itemsize))
    best = max(fitting, key=lambda each: each.agreement)  # of equals the first, which the binary header states
    return best, tuple(_differences(best, head, order))


def _starts(path, head, order):
    """Bytes that may stand before the first trace, the likeliest first."""
    (texts,) = struct.unpack_from(f"{order}h", head, 3504)
    if not _revision(head):  # which leaves these bytes free: the file's size must confirm them
        return [HEADERS] + [HEADERS + TEXT * texts] * (1 <= texts <= MOST_TEXTS)
    if texts < 0:
        raise DataError(f"{path} has an unknown number of further textual headers (bytes 3505-3506); write it without")
    return [HEADERS + TEXT * texts] + [HEADERS] * (texts > 0)


def _counts(file, head, order, first):
    """Numbers of samples that the binary header and the first trace header state, the likeliest first."""
    (samples,) = struct.unpack_from(f"{order}H", head, 3220)
    (extended,) = struct.unpack_from(f"{order}I", head, 3268)
    own = _own_counts(file, [first], order)
    stated = [extended if _revision(head) == 2 else 0, samples, *own]
    return list(dict.fromkeys(int(count) for count in stated if count))


def _own_counts(file, starts, order):
    """Numbers of samples in the trace headers that start at some bytes of the file; 0 beyond its end."""
    found = []
    for start in starts:
        file.seek(int(start) + 114)
        found.append(file.read(2).ljust(2, b"\0"))
    return np.frombuffer(b"".join(found), f"{order}u2")


def _tried(file, size, first, samples, itemsize, order):
    length = TRACE_HEADER + samples * itemsize
    traces, rest = divmod(max(size - first, 0), length)
    checked = np.unique(np.linspace(0, traces - 1, min(traces, CHECKED)).astype(np.int64)) if traces else [0]
    own = _own_counts(file, [first + int(trace) * length for trace in checked], order)
    agreement = np.where(own == samples & 0xFFFF, 1, np.where(own == 0, 0, -1)).mean()
    file.seek(size - rest)
    padded = agreement == 1 and rest <= MOST_PADDING and not file.read(rest).strip(b"\0")
    return _Arrangement(first, samples, traces, rest, float(agreement), padded)


def _misfit(path, tried, itemsize):
    return (
        f"{path} has {path.stat().st_size} bytes, which do not fit its headers: traces of {tried.samples} samples take "
        f"{TRACE_HEADER + tried.samples * itemsize} bytes each, from byte {tried.first} on; {tried.traces} fit, and "
        f"{tried.rest} bytes are left. It was cut short, its headers are damaged, its traces differ in length, or it "
        "has further headers or trailers of revision 2, which are not read: copy it again from where it came, or write "
        "it anew as revision 1"
    )


def _differences(best, head, order):
    """Where the arrangement that the file confirms differs from what the binary header claims."""
    (samples,) = struct.unpack_from(f"{order}H", head, 3220)
    if best.samples != samples and _revision(head) < 2:
        yield (
            f"the binary header states {samples} samples a trace (bytes 3221-3222); {best.samples} are read, as the "
            "trace headers state and the file's size confirms"
        )
    elif best.agreement < 0:
        yield (
            f"trace headers state other numbers of samples (bytes 115-116) than the binary header; {samples} are read, "
            "as that one states and the file's size confirms"
        )
    if best.rest:
        yield f"{best.rest} zero bytes behind the last trace are ignored"


def decoded(text: bytes) -> str:
    """SEG-Y's textual header in lines of 80 characters, from EBCDIC or ASCII; what cannot be shown as a dot."""
    ebcdic = text.count(0x40) > text.count(0x20)  # the blank of either
    letters = text.decode("cp500").replace("¦", "|") if ebcdic else text.decode("latin-1")  # as segyio has it
    shown = "".join(letter if letter.isprintable() else "." if ord(letter) else " " for letter in letters)
    return "\n".join(shown[start : start + 80].rstrip() for start in range(0, len(shown), 80))
