"""Trace headers and samples of a SEG-Y file, read as its layout has them.

They are read here rather than by segyio, which believes the binary header where the file's size and its trace headers
contradict it.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from io import RawIOBase
from itertools import chain

import numpy as np

from seiswidgets.errors import DataError, SettingError
from seiswidgets.io.segy.layout import ORDERS, TRACE_HEADER, Layout

BYTES = {"inline": 189, "crossline": 193, "x": 181, "y": 185, "scalar": 71}  # as revision 1 of the standard has them
SHORT = {*range(29, 37, 2), 69, 71, *range(89, 181, 2), 215}  # where numbers of two bytes start; others have four
LONG = {*range(1, 29, 4), *range(37, 69, 4), *range(73, 89, 4)}
FREE = range(181, TRACE_HEADER - 2, 2)  # revision 0 assigns nothing here: a number may start at any of these
STORED = {1: "u4", 2: "i4", 3: "i2", 5: "f4", 6: "f8", 8: "i1", 10: "u4", 11: "u2", 16: "u1"}  # by code of the format
IBM = 1
SHORT_TRACE, BLOCK = 4096, 4096  # bytes of a trace up to which blocks are read, and traces in one


@dataclass(frozen=True, eq=False)
class TraceHeaders:
    """The traces of an open file.

    Parameters
    ----------
    layout : Layout
    file : RawIOBase
        Unbuffered, since little is read of each trace.
    bytes : dict of str to int
        Where each number stands, by name.
    x_unit : "m", "km" or "ft"
        Unit of the positions.
    """

    layout: Layout
    file: RawIOBase
    bytes: Mapping[str, int]
    x_unit: str

    def __call__(self, name: str | int, traces) -> np.ndarray:
        """Integers of some traces (an array of indices or a slice) by name or first byte; shape (n,)."""
        byte = self.bytes.get(name, name)
        size = 2 if name == "scalar" or byte in SHORT else 4
        numbers = range(self.layout.traces)[traces] if isinstance(traces, slice) else traces
        pieces = self._pieces if self.layout.trace_length > SHORT_TRACE else self._pieces_of_blocks
        content = b"".join(pieces(numbers, byte - 1, size))
        return np.frombuffer(content, f"{ORDERS[self.layout.endian]}i{size}").astype(np.int64)

    def amplitudes(self, trace: int) -> np.ndarray:
        """Samples of a trace, shape (nz,), in the native byte order; IBM floats as IEEE floats of 4 bytes."""
        (content,) = self._pieces([trace], TRACE_HEADER, self.layout.trace_length - TRACE_HEADER)
        stored = np.frombuffer(content, ORDERS[self.layout.endian] + STORED[self.layout.code])
        if self.layout.code == IBM:
            with np.errstate(over="ignore"):  # to infinity, which is refused with its place
                return ibm_floats(stored).astype(np.float32)
        return stored.astype(stored.dtype.newbyteorder("="))

    def _pieces(self, traces, offset, size):
        file, length, start = self.file, self.layout.trace_length, self.layout.first + offset
        for trace in traces:
            file.seek(start + int(trace) * length)
            piece = file.read(size)
            if len(piece) != size:
                raise DataError(f"{self.layout.path} ends within its trace {trace} (counted from 0); copy it again")
            yield piece

    def _pieces_of_blocks(self, traces, offset, size):
        """The same from whole blocks of short traces, which takes fewer calls where traces follow each other."""
        length = self.layout.trace_length
        for start in range(0, len(traces), BLOCK):
            block = np.asarray(traces[start : start + BLOCK])
            if len(block) == 1 or (np.diff(block) != 1).any():
                yield from self._pieces(block, offset, size)
                continue
            (content,) = self._pieces(block[:1], 0, length * len(block))
            yield np.frombuffer(content, np.uint8).reshape(-1, length)[:, offset : offset + size].tobytes()


def ibm_floats(stored: np.ndarray) -> np.ndarray:
    """Values of IBM's floats of 4 bytes: sign, 7 bits of a power of 16 plus 64, and 24 bits of a fraction."""
    stored = stored.astype(np.uint32)
    power = ((stored >> 24) & 0x7F).astype(np.int32)
    magnitude = np.ldexp((stored & 0xFFFFFF).astype(float), 4 * (power - 64) - 24)
    return np.where(stored >> 31, -magnitude, magnitude)


def checked_bytes(chosen: Mapping[str, int] | None) -> dict[str, int]:
    """The bytes of the trace header at which each number stands, the user's choice over the standard's.

    Raises
    ------
    SettingError
        If a name is not one of these, or no number can start at a byte.
    """
    for name, byte in (chosen or {}).items():
        if name not in BYTES:
            raise SettingError(f"header_bytes= takes {', '.join(BYTES)}, but has {name!r}")
        if isinstance(byte, bool) or byte not in set(chain(SHORT, LONG, FREE)):
            raise SettingError(
                f"header_bytes= says that {name} stands at byte {byte!r} of the trace header, where no number starts; "
                "usual are 9, 21, 189, 193 for the lines' numbers, and 73, 77, 81, 85, 181, 185 for positions"
            )
    return BYTES | {name: int(byte) for name, byte in (chosen or {}).items()}
