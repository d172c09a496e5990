"""Trace headers and samples of a SEG-Y file, read according to its layout.

segyio is not used: it trusts the binary header even where the file's size and the trace headers contradict it.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from io import RawIOBase
from itertools import chain

import numpy as np

from seiswidgets.errors import DataError, Keyword, SettingError
from seiswidgets.io.segy.layout import ORDERS, TRACE_HEADER, Layout

BYTES = {"inline": 189, "crossline": 193, "x": 181, "y": 185, "scalar": 71}  # as revision 1 of the standard has them
SHORT = {*range(29, 37, 2), 69, 71, *range(89, 181, 2), 215}  # first bytes of two-byte numbers; others have four
LONG = {*range(1, 29, 4), *range(37, 69, 4), *range(73, 89, 4)}
FREE = range(181, TRACE_HEADER - 2, 2)  # unassigned in revision 0: a number may start at any of these
DTYPES = {1: "u4", 2: "i4", 3: "i2", 5: "f4", 6: "f8", 8: "i1", 10: "u4", 11: "u2", 16: "u1"}  # by sample format
IBM = 1
SHORT_TRACE, BLOCK = 4096, 4096  # bytes of a trace up to which whole blocks are read, and traces in a block


@dataclass(frozen=True, eq=False)
class TraceHeaders:
    """Traces of an open file.

    Parameters
    ----------
    layout : Layout
    file : RawIOBase
        Unbuffered, as little is read of each trace.
    first_bytes : dict of str to int
        First byte of each number, by name.
    x_unit : "m", "km" or "ft"
        Unit of the positions.
    """

    layout: Layout
    file: RawIOBase
    first_bytes: Mapping[str, int]
    x_unit: str

    def __call__(self, name: str | int, traces: np.ndarray | slice) -> np.ndarray:
        """Integers in the headers of some traces (indices or a slice), by name or first byte; shape (n,)."""
        byte = self.first_bytes[name] if isinstance(name, str) else name
        size = 2 if name == "scalar" or byte in SHORT else 4
        indices = range(self.layout.traces)[traces] if isinstance(traces, slice) else traces
        pieces = self._pieces if self.layout.trace_length > SHORT_TRACE else self._pieces_of_blocks
        content = b"".join(pieces(indices, byte - 1, size))
        return np.frombuffer(content, f"{ORDERS[self.layout.endian]}i{size}").astype(np.int64)

    def amplitudes(self, trace: int) -> np.ndarray:
        """Samples of a trace, shape (nz,), in the native byte order; IBM floats as IEEE floats of 4 bytes."""
        (content,) = self._pieces([trace], TRACE_HEADER, self.layout.trace_length - TRACE_HEADER)
        stored = np.frombuffer(content, ORDERS[self.layout.endian] + DTYPES[self.layout.code])
        if self.layout.code == IBM:
            with np.errstate(over="ignore"):  # to infinity, which is refused later, with its location
                return ibm_floats(stored).astype(np.float32)
        return stored.astype(stored.dtype.newbyteorder("="))

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


def ibm_floats(stored: np.ndarray) -> np.ndarray:
    """Decode 4-byte IBM floats: a sign, 7 bits for a power of 16 plus 64, and 24 bits for a fraction."""
    stored = stored.astype(np.uint32)
    power = ((stored >> 24) & 0x7F).astype(np.int32)
    magnitude = np.ldexp((stored & 0xFFFFFF).astype(float), 4 * (power - 64) - 24)
    return np.where(stored >> 31, -magnitude, magnitude)


def checked_bytes(chosen: Mapping[str, int] | None) -> dict[str, int]:
    """First byte of each number in the trace header: the user's choice, or else the standard's.

    Raises
    ------
    SettingError
        If a name is unknown, or no number can start at a byte.
    """
    for name, byte in (chosen or {}).items():
        if name not in BYTES:
            raise SettingError(Keyword("header_bytes"), f" takes {', '.join(BYTES)}, but has {name!r}")
        if isinstance(byte, bool) or byte not in set(chain(SHORT, LONG, FREE)):
            raise SettingError(
                Keyword("header_bytes"),
                f" puts {name} at byte {byte!r} of the trace header, where no number starts; usual bytes are 9, 21, "
                "189 and 193 for line numbers, and 73, 77, 81, 85, 181 and 185 for positions",
            )
    return BYTES | {name: int(byte) for name, byte in (chosen or {}).items()}
