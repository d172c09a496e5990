"""Small SEG-Y files, put together byte by byte from the standard's tables: known answers, whatever segyio does."""

import numpy as np

KINDS = {2: "i4", 3: "i2", 5: "f4", 6: "f8", 8: "i1", 10: "u4", 11: "u2", 16: "u1"}
SIZES = {17: 4, 21: 4, 73: 4, 77: 4, 81: 4, 85: 4, 181: 4, 185: 4, 189: 4, 193: 4, 9: 4, 37: 4}  # all others take 2


def segy_bytes(traces, headers, code=5, endian="big", interval=4000, binary=None, text=None):
    """A file of traces, shape (nx, nz), and of a dictionary from first byte to number for each."""
    order = {"big": ">", "little": "<"}[endian]
    traces = np.asarray(traces)
    head = bytearray((text or "C01 A LINE".ljust(3200)).encode("cp037")) + bytearray(400)
    for byte, number in ({3217: interval, 3221: traces.shape[1], 3225: code} | (binary or {})).items():
        _put(head, byte, number, 2, order)
    parts = [bytes(head)]
    for trace, numbers in zip(traces, headers, strict=True):
        header = bytearray(240)
        for byte, number in numbers.items():
            _put(header, byte, number, SIZES.get(byte, 2), order)
        samples = ibm(trace).astype(f"{order}u4") if code == 1 else trace.astype(f"{order}{KINDS[code]}")
        parts += [bytes(header), samples.tobytes()]
    return b"".join(parts)


def _put(buffer, byte, number, size, order):
    buffer[byte - 1 : byte - 1 + size] = np.array(number).astype(f"{order}i{size}").tobytes()


def ibm(values):
    """IBM's floats of 4 bytes, as integers: sign, 7 bits of a power of 16, and 24 bits of a fraction."""
    values = np.asarray(values, float)
    power = np.where(values == 0, -64, np.floor(np.log2(np.abs(np.where(values == 0, 1, values))) / 4) + 1)
    fraction = np.rint(np.abs(values) / 16.0**power * 2**24)
    return ((values < 0) * 2.0**31 + (power + 64) * 2**24 + fraction).astype(np.uint32)


def straight(count, step=25, x=181, y=185, **more):
    """Headers of a straight line eastwards."""
    return [{x: 1000 + step * number, y: 500, **more} for number in range(count)]


def volume_headers(inlines, crosslines, inline_fast=False, il=189, xl=193):
    """Headers of a volume, crosslines 25 apart in x and inlines 50 in y; crosslines change fastest unless told."""
    pairs = [(i, c) for i in inlines for c in crosslines]
    if inline_fast:
        pairs.sort(key=lambda pair: (crosslines.index(pair[1]), inlines.index(pair[0])))
    return [{il: i, xl: c, 181: 25 * c, 185: 50 * i} for i, c in pairs]


def numbered(headers, samples=4, il=189, xl=193):
    """Traces that hold 100 times their inline plus their crossline, and the sample's number as a hundredth."""
    return np.array([[100 * h[il] + h[xl] + 0.01 * n for n in range(samples)] for h in headers], np.float32)
