"""Tags of a TIFF page: sample format, colours and layout; anything that cannot be read without loss is refused."""

from dataclasses import dataclass
from importlib.util import find_spec
from numbers import Integral
from pathlib import Path

import numpy as np
import tifffile

from seiswidgets.errors import DataError
from seiswidgets.io.rasters.raster import are_shades
from seiswidgets.io.rasters.tiff_segments import (
    CCITT,
    COMPRESSIONS,
    DIFFERENCES,
    FLOATS,
    JPEG,
    PREDICTED,
    TagValue,
    TiffLayout,
)

WHITE_IS_ZERO, BLACK_IS_ZERO, RGB, PALETTE, MASK, YCBCR = 0, 1, 2, 3, 4, 6
PHOTOMETRIC, COLORMAP, EXTRA_SAMPLES, T4_OPTIONS, T6_OPTIONS = 262, 320, 338, 292, 293  # tags
PREMULTIPLIED, ALPHA = 1, 2  # extra samples
KINDS = {1: "u", 2: "i", 3: "f", 4: "u"}  # by sample format; the undefined one, 4, counts as unsigned everywhere
COMPLEX = (5, 6)
SIZES = {"u": (*range(1, 17), 32, 64), "i": (8, 16, 32, 64), "f": (16, 32, 64)}  # bits
WORDS = {"u": "unsigned integers", "i": "signed integers", "f": "floats"}
READABLE = (
    "unsigned integers of 1 to 16, 32 and 64 bits, signed integers of 8, 16, 32 and 64 bits, and floats of 16, 32 and "
    "64 bits are supported"
)
SAVE_PLAIN = "save it again as grey or RGB"


@dataclass(frozen=True)
class Colours:
    """Meaning of the samples of a pixel.

    Attributes
    ----------
    photometric : int
        TIFF's photometric interpretation; YCbCr counts as RGB if it is decoded to it.
    count : int
        Number of colour samples, which come first: 1 (grey or an index) or 3 (red, green and blue).
    alpha : int or None
        Index of the sample that holds the opacity.
    premultiplied : bool
        Whether the colours are multiplied by the opacity.
    ignored : int
        Number of further samples.
    """

    photometric: int
    count: int
    alpha: int | None
    premultiplied: bool
    ignored: int


def layout_of(path: Path, page: tifffile.TiffPage) -> TiffLayout:
    """Read and check how the pixels of a page are stored.

    Raises
    ------
    DataError
        If they cannot be read without loss.
    """
    width, height, samples = (whole(path, page, name) for name in ("imagewidth", "imagelength", "samplesperpixel"))
    if min(width, height, samples) < 1 or whole(path, page, "imagedepth") != 1:
        raise DataError(f"{path} must be a flat image, but has shape {page.shape}; {SAVE_PLAIN}")
    bits, dtype = _sample_format(path, page)
    tiled = bool(page.is_tiled)
    segment = ("tilelength", "tilewidth") if tiled else ("rowsperstrip", "imagewidth")
    rows, columns = (whole(path, page, name) for name in segment)
    layout = TiffLayout(
        width=width,
        height=height,
        samples=samples,
        bits=bits,
        dtype=dtype,
        planar=samples > 1 and whole(path, page, "planarconfig") == 2,
        segment=(max(rows, 1), max(columns, 1)),
        tiled=tiled,
        offsets=tuple(page.dataoffsets),
        counts=tuple(page.databytecounts),
        compression=whole(path, page, "compression"),
        predictor=whole(path, page, "predictor"),
        reversed_bits=page.fillorder == 2,
        libtiff_tags=_libtiff_tags(page, samples),
    )
    _check_compression(path, layout)
    _check_predictor(path, layout)
    return layout


def whole(path: Path, page: tifffile.TiffPage, name: str) -> int:
    """A whole number from a page's tags; DataError if they hold several, or something else."""
    value = getattr(page, name)
    if not isinstance(value, Integral):
        raise DataError(f"{path}: its {name} must be one whole number, but is {value!r}; it is damaged: save it again")
    return int(value)


def _sample_format(path: Path, page: tifffile.TiffPage) -> tuple[int, np.dtype]:
    """Bits per sample, and their dtype in the file's byte order."""
    bits, sample_format = page.bitspersample, page.sampleformat
    if not (isinstance(bits, Integral) and isinstance(sample_format, Integral)):
        raise DataError(f"{path} has samples of different formats in one pixel ({bits} bits); {SAVE_PLAIN}")
    if sample_format in COMPLEX:
        raise DataError(f"{path} holds complex numbers; save their real part or their magnitude instead")
    kind = KINDS.get(int(sample_format))
    if kind is None or bits not in SIZES[kind]:
        name = "samples of unknown format" if kind is None else WORDS[kind]
        raise DataError(f"{path} holds {bits}-bit {name}; {READABLE}")
    size = 1 if bits <= 8 else 2 if bits <= 16 else bits // 8
    return int(bits), np.dtype(f"{page.parent.byteorder}{kind}{size}")


def _libtiff_tags(page: tifffile.TiffPage, samples: int) -> dict[int, TagValue]:
    """Tags that libtiff needs to decode a strip of CCITT or JPEG."""
    if page.compression in CCITT:
        options = {tag: (int(page.tags.valueof(tag, 0)),) for tag in (T4_OPTIONS, T6_OPTIONS)}
        return {258: (1,), 262: (BLACK_IS_ZERO,), 266: (int(page.fillorder),), **options}
    if page.compression != JPEG:
        return {}
    tags: dict[int, TagValue] = {
        258: (8,) * samples,
        262: (int(page.photometric) if samples > 1 else BLACK_IS_ZERO,),
        277: (samples,),
    }
    if page.jpegtables:
        tags[347] = bytes(page.jpegtables)
    if page.photometric == YCBCR:
        tags[530] = tuple(int(step) for step in page.subsampling or (2, 2))
    return tags


def _check_compression(path: Path, layout: TiffLayout) -> None:
    if layout.compression not in COMPRESSIONS:
        known = {int(kind): kind.name for kind in tifffile.COMPRESSION}
        if layout.compression not in known or find_spec("imagecodecs") is None:
            raise DataError(
                f"{path} is compressed with {known.get(layout.compression, f'method {layout.compression}')}, which "
                "requires the package imagecodecs, if it can be read at all: pip install imagecodecs, or save it again "
                "without compression, or with LZW or deflate"
            )
    bits = {**dict.fromkeys(CCITT, 1), JPEG: 8}.get(layout.compression, layout.bits)
    if layout.bits != bits or (layout.compression in (JPEG, *CCITT) and layout.dtype.kind != "u"):
        raise DataError(f"{path} has {layout.bits}-bit samples in a compression for {bits}-bit ones; {SAVE_PLAIN}")
    if (layout.compression == JPEG and layout.interleaved not in (1, 3)) or (
        layout.compression in CCITT and layout.samples > 1
    ):
        raise DataError(f"{path} has {layout.samples} samples per pixel in a compression for grey or RGB; {SAVE_PLAIN}")


def _check_predictor(path: Path, layout: TiffLayout) -> None:
    fits = {1: True, DIFFERENCES: layout.bits in (8, 16, 32, 64), FLOATS: layout.dtype.kind == "f"}
    if layout.compression in COMPRESSIONS and not (
        fits.get(layout.predictor, False) and (layout.predictor == 1 or layout.compression in PREDICTED)
    ):
        raise DataError(
            f"{path} has predictor {layout.predictor} with {layout.bits}-bit {WORDS[layout.dtype.kind]} and "
            f"compression {layout.compression}, which programs interpret differently; save it again without predictor"
        )


def colours_of(path: Path, page: tifffile.TiffPage, layout: TiffLayout) -> Colours:
    """Meaning of the samples of a page's pixels.

    Raises
    ------
    DataError
        If the tags do not say, or they are not grey, RGB or a palette, or there are several bands.
    """
    photometric = _photometric(path, page, layout)
    count = 3 if photometric == RGB else 1
    further = layout.samples - count
    if further < 0:
        raise DataError(f"{path} is a colour image of {layout.samples} samples per pixel; it is damaged: {SAVE_PLAIN}")
    kinds = [int(kind) for kind in np.atleast_1d(page.extrasamples)]
    if EXTRA_SAMPLES not in page.tags and photometric == RGB and further == 1:
        kinds = [ALPHA]  # as all programs interpret it
    alpha = next((index for index, kind in enumerate(kinds[:further]) if kind in (PREMULTIPLIED, ALPHA)), None)
    ignored = further - (alpha is not None)
    if count == 1 and ignored:
        raise DataError(f"{path} has {layout.samples} bands, but must have one; save the one with the section")
    premultiplied = alpha is not None and kinds[alpha] == PREMULTIPLIED
    return Colours(photometric, count, None if alpha is None else count + alpha, premultiplied, ignored)


def _photometric(path: Path, page: tifffile.TiffPage, layout: TiffLayout) -> int:
    """Grey, RGB or palette; YCbCr counts as RGB if libtiff decodes it to that."""
    if PHOTOMETRIC not in page.tags:
        if layout.samples == 1 and not are_shades(layout.dtype, layout.bits):
            return BLACK_IS_ZERO
        raise DataError(f"{path} does not say what colours its samples are (tag 262); it is damaged: {SAVE_PLAIN}")
    photometric = whole(path, page, "photometric")
    if photometric == YCBCR and layout.compression == JPEG and layout.interleaved == 3:
        return RGB
    if photometric not in (WHITE_IS_ZERO, BLACK_IS_ZERO, RGB, PALETTE):
        name = getattr(page.photometric, "name", photometric)
        raise DataError(f"{path} has the colours {name}, but must be in grey, RGB or a palette; convert it first")
    if photometric == PALETTE and not are_shades(layout.dtype, layout.bits):
        raise DataError(f"{path} has a palette for {layout.bits}-bit {WORDS[layout.dtype.kind]}; {SAVE_PLAIN}")
    return photometric


def palette_of(path: Path, page: tifffile.TiffPage, bits: int) -> np.ndarray:
    """Red, green and blue of a page's palette, shape (2**bits, 3), with 8 bits if these are enough, otherwise 16.

    Raises
    ------
    DataError
        If it lacks colours.
    """
    palette = np.asarray(page.tags.valueof(COLORMAP, ()))
    if palette.size != 3 * 2**bits or palette.dtype.kind not in "ui":
        raise DataError(f"{path} must have a palette of {2**bits} colours, but does not; it is damaged: {SAVE_PLAIN}")
    palette = palette.reshape(3, -1).T.astype(np.uint16)
    upper, lower = palette >> 8, palette & 255
    return upper.astype(np.uint8) if not lower.any() or (lower == upper).all() else palette
