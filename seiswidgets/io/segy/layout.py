"""How a SEG-Y file is laid out, told from its headers and confirmed by its length, before anything else reads it."""

import struct
from dataclasses import dataclass
from pathlib import Path

from seiswidgets.errors import DataError
from seiswidgets.io.options import check_shape

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


@dataclass(frozen=True)
class Layout:
    """Sizes of a SEG-Y file whose length is what its headers say.

    Attributes
    ----------
    path : Path
    endian : "big" or "little"
    code : int
        Of the samples' format, a key of ``FORMATS``.
    samples, traces : int
        Samples a trace, and traces in the file.
    interval : float
        Of the samples, in microseconds or in millimetres; 0 where the binary header does not say.
    feet : bool
        Whether the binary header says that lengths are in feet.
    text : str
        The textual header, 40 lines.
    """

    path: Path
    endian: str
    code: int
    samples: int
    traces: int
    interval: float
    feet: bool
    text: str

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
    (samples,) = struct.unpack_from(f"{order}H", head, 3220)
    (extended,) = struct.unpack_from(f"{order}I", head, 3268)
    if extended and (not samples or head[3500] >= 2):  # since revision 2
        samples = extended
    code = _code(head, order)
    return Layout(
        path=path,
        endian=endian,
        code=code,
        samples=samples,
        traces=_traces(path, samples, FORMATS[code][1], *struct.unpack_from(f"{order}h", head, 3504)),
        interval=_interval(head, order),
        feet=struct.unpack_from(f"{order}h", head, 3254)[0] == 2,
        text=decoded(head[:TEXT]),
    )


def _interval(head, order):
    """The sample interval; revision 2 has a finer one, which counts over the old one."""
    (fine,) = struct.unpack_from(f"{order}d", head, 3272)
    return fine if head[3500] >= 2 and 0 < fine < FINE else struct.unpack_from(f"{order}H", head, 3216)[0]


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


def _traces(path, samples, itemsize, extra_texts):
    if not samples:
        raise DataError(
            f"{path} says that its traces have no samples (bytes 3221-3222); write it anew from the program it is from"
        )
    if extra_texts < 0:
        raise DataError(f"{path} has an unknown number of further textual headers (bytes 3505-3506); write it without")
    first, length = HEADERS + TEXT * extra_texts, TRACE_HEADER + samples * itemsize
    size = path.stat().st_size
    traces, rest = divmod(size - first, length)
    if traces < 1 or rest:
        raise DataError(
            f"{path} has {size} bytes, which do not fit its headers: traces of {samples} samples take {length} bytes "
            f"each, from byte {first} on; {max(traces, 0)} fit, and {rest} bytes are left. It was cut short, its "
            "headers are damaged, its traces differ in length, or it has further headers or trailers of revision 2, "
            "which are not read: copy it again from where it came, or write it anew as revision 1"
        )
    check_shape(path, (samples, traces))
    return traces


def decoded(text: bytes) -> str:
    """SEG-Y's textual header in lines of 80 characters, from EBCDIC or ASCII; what cannot be shown as a dot."""
    ebcdic = text.count(0x40) > text.count(0x20)  # the blank of either
    letters = text.decode("cp500").replace("¦", "|") if ebcdic else text.decode("latin-1")  # as segyio has it
    shown = "".join(letter if letter.isprintable() else "." if ord(letter) else " " for letter in letters)
    return "\n".join(shown[start : start + 80].rstrip() for start in range(0, len(shown), 80))
