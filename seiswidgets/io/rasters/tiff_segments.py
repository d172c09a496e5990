"""Decoding of a TIFF's strips and tiles: decompression, unpacking, predictors, and assembly."""

import lzma
import struct
import zlib
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from io import BytesIO
from math import ceil
from typing import BinaryIO

import numpy as np
from PIL import Image

NONE, CCITT, LZW, JPEG, DEFLATE, PACKBITS, LZMA = 1, (2, 3, 4), 5, 7, (8, 32946), 32773, 34925
BY_LIBTIFF = (*CCITT, LZW, JPEG, PACKBITS)
BY_BYTES = (NONE, *DEFLATE, LZMA, LZW, PACKBITS)
COMPRESSIONS = (*BY_BYTES, *CCITT, JPEG)
PREDICTED = (*DEFLATE, LZMA, LZW)
HIGHEST_RATIO: dict[int, int] = {
    NONE: 1,
    LZW: 4096,
    PACKBITS: 64,
    **dict.fromkeys(DEFLATE, 1032),
}  # decompressed / compressed
DIFFERENCES, FLOATS = 2, 3  # predictors
LONG_TAGS = (256, 257, 273, 278, 279, 292, 293)  # values of 4 bytes; other numbers have 2
BLOCK = 2**20  # samples that are unpacked at a time

TagValue = tuple[int, ...] | bytes


@dataclass(frozen=True, eq=False)
class TiffLayout:
    """Storage of a page's pixels, in TIFF's terms; its maker has checked it.

    Attributes
    ----------
    width, height, samples : int
    bits : int
        Bits per sample.
    dtype : numpy.dtype
        Type of an unpacked sample, in the file's byte order.
    planar : bool
        Whether each sample of a pixel has strips or tiles of its own.
    segment : (int, int)
        Rows and columns of a strip or a tile.
    offsets, counts : tuple of int
        Position and length of the strips or tiles in the file, in bytes.
    compression, predictor : int
    reversed_bits : bool
        Whether the lowest bit of a byte comes first.
    libtiff_tags : dict
        Tags that libtiff needs for JPEG and CCITT.
    """

    width: int
    height: int
    samples: int
    bits: int
    dtype: np.dtype
    planar: bool
    segment: tuple[int, int]
    tiled: bool
    offsets: tuple[int, ...]
    counts: tuple[int, ...]
    compression: int
    predictor: int
    reversed_bits: bool
    libtiff_tags: Mapping[int, TagValue]

    @property
    def interleaved(self) -> int:
        """Samples per pixel in one strip or tile."""
        return 1 if self.planar else self.samples

    @property
    def row_bytes(self) -> int:
        """Decompressed bytes per row of a strip or a tile."""
        return ceil(self.segment[1] * self.interleaved * self.bits / 8)

    def positions(self) -> Iterator[tuple[int, int, int, int]]:
        """First sample, first row, first column and number of rows of each strip or tile, in their order."""
        rows, columns = self.segment
        for sample in range(self.samples if self.planar else 1):
            for row in range(0, self.height, rows):
                for column in range(0, self.width, columns):
                    yield sample, row, column, rows if self.tiled else min(rows, self.height - row)


def missing_data(layout: TiffLayout, file_size: int) -> str:
    """Describe the data that a file has instead of the pixels that it declares; "" if it is complete."""
    rows, columns = layout.segment
    planes = layout.samples if layout.planar else 1
    wanted = planes * ceil(layout.height / rows) * ceil(layout.width / columns)
    name = "tiles" if layout.tiled else "strips"
    held = min(len(layout.offsets), len(layout.counts))
    if held < wanted:
        return f"{held:,} of the {wanted:,} {name} that they need"
    end = max(offset + count for offset, count in zip(layout.offsets, layout.counts, strict=False))
    if layout.compression != NONE and end > file_size:
        return f"{name} up to byte {end:,} in a file of {file_size:,} bytes"
    ratio = HIGHEST_RATIO.get(layout.compression)
    stored = [position for position, count in zip(layout.positions(), layout.counts, strict=False) if count]
    needed = sum(position[3] for position in stored) * layout.row_bytes
    available = min(sum(layout.counts[:wanted]), file_size)
    if ratio and needed > ratio * available + 64:
        return f"only {available:,} bytes of data, which cannot be decompressed to {needed:,}"
    return ""


def decode(file: BinaryIO, layout: TiffLayout) -> tuple[np.ndarray, np.ndarray | None]:
    """All samples, shape (height, width, samples), and a mask of pixels whose strips or tiles are absent, if any."""
    samples = np.empty((layout.height, layout.width, layout.samples), layout.dtype.newbyteorder("="))
    absent = None
    for (sample, row, column, rows), offset, count in zip(
        layout.positions(), layout.offsets, layout.counts, strict=False
    ):
        here = (slice(row, row + rows), slice(column, column + layout.segment[1]))
        if offset == count == 0:  # a sparse file, as GDAL writes
            absent = np.zeros(samples.shape[:2], bool) if absent is None else absent
            absent[here] = True
            samples[here] = 0
            continue
        file.seek(offset)
        segment = _segment(file.read(count), layout, rows)
        target = samples[here][:, :, sample : sample + layout.interleaved]
        target[...] = segment[: target.shape[0], : target.shape[1]]
    return samples, absent


def _segment(data: bytes, layout: TiffLayout, rows: int) -> np.ndarray:
    """Samples of one strip or tile, shape (rows, columns, interleaved samples)."""
    columns, samples = layout.segment[1], layout.interleaved
    if layout.compression not in BY_BYTES:
        return _by_libtiff(data, rows, columns, layout.compression, layout.libtiff_tags).reshape(rows, columns, samples)
    if layout.reversed_bits:
        data = _with_reversed_bits(data)
    pixels = _bytes(data, layout, rows)
    if layout.predictor == FLOATS:
        return _undo_float_predictor(pixels, layout.dtype, samples).reshape(rows, columns, samples)
    values = _unpacked(pixels, layout.bits, layout.dtype, columns * samples).reshape(rows, columns, samples)
    if layout.predictor == DIFFERENCES:
        integers = values.view(f"u{values.itemsize}")
        np.cumsum(integers, axis=1, dtype=integers.dtype, out=integers)
    return values


def _bytes(data: bytes, layout: TiffLayout, rows: int) -> np.ndarray:
    """Decompressed bytes of a strip or a tile, shape (rows, bytes per row)."""
    needed = rows * layout.row_bytes
    if layout.compression in BY_LIBTIFF:
        return _by_libtiff(data, rows, layout.row_bytes, layout.compression, {258: (8,), 262: (1,)})
    if layout.compression in DEFLATE:
        data = zlib.decompressobj().decompress(data, needed + 1)  # one byte more makes it reach the checksum
    elif layout.compression == LZMA:
        data = lzma.LZMADecompressor().decompress(data, needed + 1)
    if len(data) < needed:
        raise ValueError(f"a strip or tile holds {len(data):,} of its {needed:,} bytes")
    return np.frombuffer(data, np.uint8, needed).reshape(rows, layout.row_bytes)


def _unpacked(pixels: np.ndarray, bits: int, dtype: np.dtype, count: int) -> np.ndarray:
    """Samples of rows of bytes, in native byte order, shape (rows, count)."""
    if bits == 8 * dtype.itemsize:
        return pixels.view(dtype).astype(dtype.newbyteorder("="))
    values = np.empty((len(pixels), count), dtype.newbyteorder("="))
    first, shift = np.divmod(np.arange(count) * bits, 8)
    padded = np.pad(pixels, ((0, 0), (0, 2)))
    step = max(1, BLOCK // count)
    for row in range(0, len(pixels), step):
        window = np.zeros((len(values[row : row + step]), count), np.uint32)
        for byte in range(3):  # a 15-bit sample may span three bytes
            window = window << 8 | padded[row : row + step, first + byte]
        values[row : row + step] = window >> (24 - bits - shift).astype(np.uint32) & 2**bits - 1
    return values


def _undo_float_predictor(pixels: np.ndarray, dtype: np.dtype, samples: int) -> np.ndarray:
    """Decode floats whose bytes were sorted by significance and stored as differences; always big-endian."""
    size = dtype.itemsize
    rows, width = pixels.shape
    summed = np.cumsum(pixels.reshape(rows, width // samples, samples), axis=1, dtype=np.uint8)
    sorted_bytes = summed.reshape(rows, size, width // size).swapaxes(1, 2)
    return np.ascontiguousarray(sorted_bytes).view(f">f{size}").astype(dtype.newbyteorder("="))


def _with_reversed_bits(data: bytes) -> bytes:
    bits = np.unpackbits(np.arange(256, dtype=np.uint8)[:, None], axis=1)
    return np.packbits(bits[:, ::-1], axis=1)[:, 0][np.frombuffer(data, np.uint8)].tobytes()


def _by_libtiff(data: bytes, rows: int, columns: int, compression: int, tags: Mapping[int, TagValue]) -> np.ndarray:
    """Decode one strip or tile with Pillow's libtiff, as a TIFF of its own.

    Pillow reads few sample formats correctly, but it returns libtiff's result for 1-bit and 8-bit grey and 8-bit
    colour.
    """
    with Image.open(BytesIO(_tiff_of(data, rows, columns, compression, tags)), formats=("TIFF",)) as image:
        if image.mode not in ("1", "L", "RGB") or image.size != (columns, rows):
            raise ValueError(f"libtiff decodes a strip or tile to {image.mode}")
        return np.asarray(image).astype(np.uint8, copy=False)


def _tiff_of(data: bytes, rows: int, columns: int, compression: int, tags: Mapping[int, TagValue]) -> bytes:
    """Make a little-endian TIFF of one strip."""
    tags = {**tags, 256: (columns,), 257: (rows,), 259: (compression,), 273: (0,), 278: (rows,), 279: (len(data),)}
    start = 8 + 2 + 12 * len(tags) + 4  # of the values that do not fit into the directory
    outside = b""
    directory: dict[int, tuple[int, int, bytes]] = {}
    for tag in sorted(tags):
        value = tags[tag]
        if isinstance(value, bytes):
            kind, content = 7, value
        elif tag in LONG_TAGS:
            kind, content = 4, struct.pack(f"<{len(value)}I", *value)
        else:
            kind, content = 3, struct.pack(f"<{len(value)}H", *value)
        if len(content) > 4:
            directory[tag] = kind, len(value), struct.pack("<I", start + len(outside))
            outside += content
        else:
            directory[tag] = kind, len(value), content.ljust(4, b"\0")
    directory[273] = 4, 1, struct.pack("<I", start + len(outside))
    entries = b"".join(struct.pack("<HHI", tag, kind, count) + held for tag, (kind, count, held) in directory.items())
    return b"II*\0\x08\0\0\0" + struct.pack("<H", len(tags)) + entries + bytes(4) + outside + data
