"""Trace headers and samples of a SEG-Y file, read according to its layout.

segyio is not used: it trusts the binary header even where the file's size and the trace headers contradict it.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from io import RawIOBase
from itertools import chain
from numbers import Integral
from typing import NamedTuple

import numpy as np

from seiswidgets.errors import DataError, Keyword, SettingError
from seiswidgets.io.segy.formats import CODES, FORMATS, ORDERS, TRACE_HEADER
from seiswidgets.io.segy.layout import Layout

SHORT = {*range(29, 37, 2), 69, 71, *range(89, 181, 2), 215}  # first bytes of two-byte numbers; others have four
LONG = {*range(1, 29, 4), *range(37, 69, 4), *range(73, 89, 4)}
FREE = range(181, TRACE_HEADER - 2, 2)  # unassigned in revision 0: a number may start at any of these
KINDS = ("i2", "u2", "i4", "u4", "f4", "f8", "ibm")  # of header numbers, named like sample formats
IBM = "ibm"
SHORT_TRACE, BLOCK = 4096, 4096  # bytes of a trace up to which whole blocks are read, and traces in a block


class HeaderField(NamedTuple):
    """A number in the trace header: its first byte, counted from 1, and its kind, one of ``KINDS``.

    A kind that the user has given is not doubted.
    """

    byte: int
    kind: str
    is_given: bool = False

    @property
    def size(self) -> int:
        """Number of bytes."""
        return np.dtype(_stored(self.kind)).itemsize


def _stored(kind: str) -> str:
    """NumPy's name of a kind; IBM floats are read as integers first."""
    return "u4" if kind == IBM else kind


def standard_field(byte: int) -> HeaderField:
    """The number at a byte, with the width that the standard gives it."""
    return HeaderField(byte, "i2" if byte in SHORT else "i4")


FIELDS = {  # as revision 1 of the standard has them
    "inline": standard_field(189),
    "crossline": standard_field(193),
    "x": standard_field(181),
    "y": standard_field(185),
    "scalar": standard_field(71),
    "offset": standard_field(37),
}
WHOLE = ("inline", "crossline", "scalar", "offset")


@dataclass(frozen=True, eq=False)
class TraceHeaders:
    """Traces of an open file.

    Parameters
    ----------
    layout : Layout
    file : RawIOBase
        Unbuffered, as little is read of each trace.
    fields : dict of str to HeaderField
        By name.
    x_unit : "m", "km" or "ft"
        Unit of the positions.
    """

    layout: Layout
    file: RawIOBase
    fields: Mapping[str, HeaderField]
    x_unit: str

    @property
    def first_bytes(self) -> dict[str, int]:
        """First byte of each number, by name."""
        return {name: field.byte for name, field in self.fields.items()}

    def __call__(self, name: str | int, traces: np.ndarray | slice) -> np.ndarray:
        """Numbers in the headers of some traces (indices or a slice), by name or first byte; shape (n,).

        They are integers, or floats if the user has said so.
        """
        field = self.fields[name] if isinstance(name, str) else standard_field(name)
        indices = range(self.layout.traces)[traces] if isinstance(traces, slice) else traces
        pieces = self._pieces if self.layout.trace_length > SHORT_TRACE else self._pieces_of_blocks
        content = b"".join(pieces(indices, field.byte - 1, field.size))
        values = _decoded(content, ORDERS[self.layout.endian], field.kind)
        if values.dtype.kind != "f":
            return values.astype(np.int64)
        values = values.astype(float)
        return np.rint(np.nan_to_num(np.clip(values, -1e15, 1e15))).astype(np.int64) if name in WHOLE else values

    def header(self, trace: int) -> bytes:
        """The header of a trace, 240 bytes."""
        (content,) = self._pieces([trace], 0, TRACE_HEADER)
        return content

    def amplitudes(self, trace: int) -> np.ndarray:
        """Samples of a trace, shape (nz,), in the native byte order; IBM floats as IEEE floats of 4 bytes."""
        with np.errstate(over="ignore"):  # to infinity, which is refused later, with its location
            values = self.samples(trace, slice(None), self.layout.sample_order, FORMATS[self.layout.code].name)
            return values.astype(np.float32) if self.layout.code == CODES[IBM] else values

    def samples(self, trace: int, part: slice, order: str, kind: str) -> np.ndarray:
        """Part of a trace's samples, read as a kind."""
        size = FORMATS[self.layout.code].size
        indices = range(self.layout.samples)[part]
        (content,) = self._pieces([trace], TRACE_HEADER + size * indices.start, size * len(indices))
        return _decoded(content, order, kind)

    def _pieces(self, traces: Sequence[int] | np.ndarray, offset: int, size: int) -> Iterator[bytes]:
        file, length, start = self.file, self.layout.trace_length, self.layout.first + offset
        for trace in traces:
            file.seek(start + int(trace) * length)
            piece = file.read(size)
            if len(piece) != size:
                raise DataError(f"{self.layout.path} ends within its trace {trace} (counted from 0); copy it again")
            yield piece

    def _pieces_of_blocks(self, traces: Sequence[int] | np.ndarray, offset: int, size: int) -> Iterator[bytes]:
        """Read the same from whole blocks of short traces, which takes fewer calls for consecutive traces."""
        length = self.layout.trace_length
        for start in range(0, len(traces), BLOCK):
            block = np.asarray(traces[start : start + BLOCK])
            if len(block) == 1 or (np.diff(block) != 1).any():
                yield from self._pieces(block, offset, size)
                continue
            (content,) = self._pieces(block[:1], 0, length * len(block))
            yield np.frombuffer(content, np.uint8).reshape(-1, length)[:, offset : offset + size].tobytes()


def _decoded(content: bytes, order: str, kind: str) -> np.ndarray:
    """Numbers of a kind, in the native byte order."""
    stored = np.frombuffer(content, order + _stored(kind))
    return ibm_floats(stored) if kind == IBM else stored.astype(stored.dtype.newbyteorder("="))


def ibm_floats(stored: np.ndarray) -> np.ndarray:
    """Decode 4-byte IBM floats: a sign, 7 bits for a power of 16 plus 64, and 24 bits for a fraction."""
    stored = stored.astype(np.uint32)
    power = ((stored >> 24) & 0x7F).astype(np.int32)
    magnitude = np.ldexp((stored & 0xFFFFFF).astype(float), 4 * (power - 64) - 24)
    return np.where(stored >> 31, -magnitude, magnitude)


def checked_fields(chosen: Mapping[str, object] | None) -> dict[str, HeaderField]:
    """Fields of the trace header: the user's choice, or else the standard's.

    Raises
    ------
    SettingError
        If a name or a kind is unknown, or no number can start at a byte.
    """
    return FIELDS | {name: _checked_field(name, value) for name, value in (chosen or {}).items()}


def _checked_field(name: str, value: object) -> HeaderField:
    if name not in FIELDS:
        raise SettingError(Keyword("header_bytes"), f" takes {', '.join(FIELDS)}, but has {name!r}")
    byte, kind = value if isinstance(value, Sequence) and len(value) == 2 else (value, None)
    kinds = [known for known in KINDS if name != "scalar" or known in ("i2", "u2", "i4", "u4")]
    if kind is not None and kind not in kinds:
        raise SettingError(
            Keyword("header_bytes"), f" takes {name} as one of {', '.join(kinds)}, but has {kind!r}, as in {value!r}"
        )
    if isinstance(byte, Integral) and not isinstance(byte, bool):
        field = standard_field(int(byte)) if kind is None else HeaderField(int(byte), kind, True)
        allowed = set(chain(SHORT, LONG, FREE)) if kind is None else range(1, TRACE_HEADER + 2 - field.size)
        if name == "scalar" and kind is None:
            field = HeaderField(field.byte, "i2")
        if byte in allowed:
            return field
    raise SettingError(
        Keyword("header_bytes"),
        f" puts {name} at byte {byte!r} of the trace header, where no number starts; usual bytes are 9, 21, 189 and "
        f"193 for line numbers, and 73, 77, 81, 85, 181 and 185 for positions. Other numbers need their kind, as in "
        f"{{{name!r}: (17, 'i2')}}",
    )
