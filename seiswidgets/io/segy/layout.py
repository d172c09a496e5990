"""Layout of a SEG-Y file: its headers' claims, checked against the file's size and its trace headers."""

import struct
from dataclasses import dataclass
from pathlib import Path

from seiswidgets.errors import DataError, Keyword
from seiswidgets.geology.findings import Finding
from seiswidgets.io.options import OpenOptions, check_shape
from seiswidgets.io.segy.arrangement import arrangements, differences, find_arrangement
from seiswidgets.io.segy.formats import (
    CODES,
    FORMATS,
    HEADERS,
    LABEL,
    ORDERS,
    TEXT,
    TRACE_HEADER,
    checked_choice,
    label_size,
    revision,
)

FINE = 1e9  # microseconds or millimetres: no sample interval is that long


@dataclass(frozen=True)
class Layout:
    """Arrangement of a SEG-Y file, confirmed by its length.

    Attributes
    ----------
    path : Path
    endian : "big" or "little"
    sample_order : ">" or "<"
        Byte order of the samples, that of the headers unless the user says otherwise.
    code : int
        Code of the sample format, a key of ``FORMATS``.
    is_format_given : bool
        Whether the user gave the sample format, so that it is not doubted.
    samples, traces : int
        Samples per trace, and traces in the file.
    label, first : int
        Bytes before the textual header, and before the first trace.
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
    sample_order: str
    code: int
    is_format_given: bool
    samples: int
    traces: int
    label: int
    first: int
    interval: float
    x_unit: str | None
    revision: int
    text: str
    doubts: tuple[Finding, ...] = ()

    @property
    def trace_length(self) -> int:
        """Bytes from the start of one trace to the start of the next."""
        return TRACE_HEADER + self.samples * FORMATS[self.code].size

    @property
    def format(self) -> str:
        """Sample format, in words."""
        return f"{FORMATS[self.code].words}, {self.endian}-endian"


def read_layout(path: Path, options: OpenOptions) -> Layout:
    """Read and check the layout of a SEG-Y file, corrected by the options.

    Raises
    ------
    DataError
        If the file is not SEG-Y, or its length contradicts its headers.
    SettingError
        If an option has an unknown value.
    """
    given, (code, sample_order) = options.keywords, _checked_format(options)
    with path.open("rb") as file:
        label = label_size(file.read(LABEL))
        file.seek(label)
        head = file.read(HEADERS)
    if len(head) < HEADERS:
        raise DataError(
            f"{path} is not a SEG-Y file: it ends after {len(head)} bytes, within the {HEADERS} bytes of the headers; "
            "it is truncated, or in another format"
        )
    if "revision" in given:
        head = head[:3500] + bytes([checked_choice("revision", given["revision"], (0, 1, 2)), 0]) + head[3502:]
    endian = _byte_order(path, head, options, code)
    order = ORDERS[endian]
    code = code or _code(head, order)
    best = find_arrangement(path, head, order, code)
    check_shape(path, (best.samples, best.traces))
    return Layout(
        path=path,
        endian=endian,
        sample_order=sample_order or order,
        code=code,
        is_format_given="sample_format" in given,
        samples=best.samples,
        traces=best.traces,
        label=label,
        first=best.first,
        interval=_interval(head, order),
        x_unit={1: "m", 2: "ft"}.get(struct.unpack_from(f"{order}h", head, 3254)[0]),
        revision=revision(head),
        text=decoded(head[:TEXT]),
        doubts=tuple(Finding("warning", "headers", text) for text in differences(best, head, order)),
    )


def _checked_format(options: OpenOptions) -> tuple[int, str]:
    """Code and byte order in ``sample_format``, as in "ibm", 1 or "<f4"; 0 and "" if they are not given."""
    value = options.keywords.get("sample_format", 0)
    if value in (0, *FORMATS) and not isinstance(value, bool):
        return int(value), ""
    order, name = (value[0], value[1:]) if isinstance(value, str) and value[:1] in ORDERS.values() else ("", value)
    return CODES[checked_choice("sample_format", name, tuple(CODES))], order


def _interval(head: bytes, order: str) -> float:
    """Sample interval; the finer one of revision 2 takes precedence over the old one."""
    (fine,) = struct.unpack_from(f"{order}d", head, 3272)
    (whole,) = struct.unpack_from(f"{order}H", head, 3216)
    return float(fine if revision(head) == 2 and 0 < fine < FINE else whole)


def begins_like_segy(head: bytes) -> bool:
    """Check whether the first bytes of a file may be SEG-Y's headers."""
    head = head[label_size(head) :]
    return len(head) >= HEADERS and any(_code(head, order) in FORMATS for order in ORDERS.values())


def _code(head: bytes, order: str) -> int:
    (code,) = struct.unpack_from(f"{order}H", head, 3224)
    return int(code)


def _byte_order(path: Path, head: bytes, options: OpenOptions, code: int) -> str:
    """The byte order as given, or in which the code of the sample format is a known one, or that fits the file."""
    if "byte_order" in options.keywords:
        given: str = checked_choice("byte_order", options.keywords["byte_order"], tuple(ORDERS))
        known = [given] if code or _code(head, ORDERS[given]) in FORMATS else []
    else:
        known = [endian for endian, order in ORDERS.items() if _code(head, order) in FORMATS]
    if code and not known:
        fitting = (endian for endian, order in ORDERS.items() if _fits(path, head, order, code))
        return next(fitting, "big")
    if not known:
        raise DataError(
            f"{path} is not a SEG-Y file that can be read: bytes 3225-3226 must be the code of a sample format "
            f"({', '.join(str(code) for code in FORMATS)}), but are {head[3224]} and {head[3225]}; it is damaged, or "
            "in another format, or states no format: give ",
            Keyword("sample_format"),
            f", one of {', '.join(CODES)}",
        )
    return known[0]


def _fits(path: Path, head: bytes, order: str, code: int) -> bool:
    return any(each.fits for each in arrangements(path, head, order, FORMATS[code].size))


def decoded(text: bytes) -> str:
    """Decode SEG-Y's textual header, EBCDIC or ASCII, to lines of 80 characters, with dots for unprintable ones."""
    ebcdic = text.count(0x40) > text.count(0x20)  # the space of either
    letters = text.decode("cp500").replace("¦", "|") if ebcdic else text.decode("latin-1")  # like segyio
    shown = "".join(letter if letter.isprintable() else "." if ord(letter) else " " for letter in letters)
    return "\n".join(shown[start : start + 80].rstrip() for start in range(0, len(shown), 80))
