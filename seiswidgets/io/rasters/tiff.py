"""TIFF: tags read with tifffile, pixels decoded at their full bit depth."""

import logging
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import BinaryIO, cast

import numpy as np
import tifffile

from seiswidgets.errors import DataError
from seiswidgets.io.options import check_memory
from seiswidgets.io.rasters.raster import Raster, are_shades, is_turned
from seiswidgets.io.rasters.tiff_layout import (
    PALETTE,
    RGB,
    WHITE_IS_ZERO,
    WORDS,
    colours_of,
    layout_of,
    palette_of,
    whole,
)
from seiswidgets.io.rasters.tiff_segments import COMPRESSIONS, TiffLayout, decode, missing_data

ORIENTATION, NO_DATA = 274, 42113  # tags
REDUCED, MASK = 1, 4  # bits of the subfile type of a page that belongs to another one
UNEXPECTED = (AssertionError, AttributeError)  # raised by tifffile on damaged files, besides the usual errors


@contextmanager
def open_tiff(path: Path) -> "Iterator[TiffPicture]":
    """Open the first page in full resolution of a TIFF file as a ``Picture``."""
    with _quiet(), path.open("rb") as file:
        try:
            tiff = tifffile.TiffFile(file)  # not closed: long tags are read on demand
            pages = cast(list[tifffile.TiffPage], list(tiff.pages))
            kinds = [whole(path, page, "subfiletype") for page in pages]
        except UNEXPECTED as error:
            raise DataError(f"{path} is a damaged TIFF: {error!r}; save it again") from error
        typed = list(zip(pages, kinds, strict=True))
        full = [page for page, kind in typed if not kind & (REDUCED | MASK) and page.dataoffsets] or pages[:1]
        masks = [page for page, kind in typed if kind & MASK and page.index > full[0].index]
        yield TiffPicture(path, file, full[0], masks, len(full))


@contextmanager
def _quiet() -> Iterator[None]:
    """Keep tifffile's log messages about unusual files out of notebooks: what matters is checked here."""

    def nothing(_record: logging.LogRecord) -> bool:  # a filter for each call, as several files may be read at a time
        return False

    logger = logging.getLogger("tifffile")
    logger.addFilter(nothing)
    try:
        yield
    finally:
        logger.removeFilter(nothing)


class TiffPicture:
    """A page of a TIFF file; see ``Picture``."""

    def __init__(self, path: Path, file: BinaryIO, page: tifffile.TiffPage, masks: list[tifffile.TiffPage], pages: int):
        self.path, self.file, self.page, self.pages = path, file, page, pages
        self.layout = layout_of(path, page)
        self.colours = colours_of(path, page, self.layout)
        self.size = self.layout.width, self.layout.height
        self.orientation = int(page.tags.valueof(ORIENTATION, 1))
        self.shape = self.size if is_turned(self.orientation) else self.size[::-1]
        self.no_data = _no_data(path, page)
        self.masks = [mask for mask in masks if (mask.imagewidth, mask.imagelength) == self.size][:1]

    @property
    def format(self) -> str:
        """Sample format and colours, in words."""
        bits, colours = self.layout.bits, self.colours
        named = {RGB: "colour", PALETTE: "palette"}.get(colours.photometric, "grey")
        white = ", white is zero" if colours.photometric == WHITE_IS_ZERO else ""
        if not are_shades(self.layout.dtype, bits):
            named = WORDS[self.layout.dtype.kind] + (" in colour" if colours.count == 3 else "")
            white = ""
        alpha = " with alpha" if colours.alpha is not None else ""
        mask = ", with a mask" if self.masks else ""
        no_data = f", no-data value {self.no_data}" if self.no_data is not None else ""
        ignored = f", {colours.ignored} more band(s) ignored" if colours.ignored else ""
        return f"TIFF, {bits}-bit {named}{alpha}{white}{mask}{no_data}{ignored}"

    def check(self) -> None:
        """Raise DataError if the file is truncated."""
        self._check_data(self.layout)
        check_memory(self.path, (*self.shape, self.layout.samples), self.layout.dtype.itemsize)

    def _check_data(self, layout: TiffLayout) -> None:
        missing = missing_data(layout, self.path.stat().st_size)
        if missing:
            raise DataError(
                f"{self.path} claims to have {layout.width} x {layout.height} pixels, but holds {missing}; it is "
                "damaged: save it again"
            )

    def raster(self) -> Raster:
        """Decode the pixels."""
        stored, clear = self._decoded()
        colours = stored[:, :, : self.colours.count]
        clear = _either(clear, _equal(colours, self.no_data))
        bits = self.layout.bits
        if self.colours.alpha is not None:
            alpha = stored[:, :, self.colours.alpha, None]
            clear = _either(clear, alpha[:, :, 0] == 0)
            colours = _unmultiplied(colours, alpha, bits) if self.colours.premultiplied else colours
        if self.colours.photometric == PALETTE:
            palette = palette_of(self.path, self.page, bits)
            colours, bits = palette[colours[:, :, 0]], 8 * palette.itemsize
        for mask in self.masks:
            clear = _either(clear, self._is_masked(mask))
        return Raster(colours, bits, clear, self.colours.photometric == WHITE_IS_ZERO, self.orientation)

    def _decoded(self) -> tuple[np.ndarray, np.ndarray | None]:
        if self.layout.compression in COMPRESSIONS:
            return decode(self.file, self.layout)
        with tifffile.TiffFile(self.path) as tiff:  # with imagecodecs: its absence is refused earlier
            pixels = tiff.pages[self.page.index].asarray(maxworkers=1)
        pixels = np.moveaxis(pixels, 0, 2) if self.layout.planar else pixels
        return pixels.reshape(self.layout.height, self.layout.width, self.layout.samples), None

    def _is_masked(self, mask: tifffile.TiffPage) -> np.ndarray | None:
        layout = layout_of(self.path, mask)
        self._check_data(layout)
        pixels, absent = decode(self.file, layout)
        return _either(absent, (pixels == 0).all(axis=2))


def _no_data(path: Path, page: tifffile.TiffPage) -> float | None:
    """Value of GDAL's tag for pixels without data: an int if it is whole, otherwise a float; None without the tag."""
    text = page.tags.valueof(NO_DATA)
    text = text.strip().replace(",", ".") if isinstance(text, str) else text
    if not text:
        return None
    for number in (int, float):
        try:
            return number(text)
        except (TypeError, ValueError):
            continue
    raise DataError(f"{path}: its no-data value (GDAL's tag 42113) must be a number, but is {text!r}; save it again")


def _equal(colours: np.ndarray, value: float | None) -> np.ndarray | None:
    """Mask of pixels whose colours all equal a value, or None if their dtype cannot hold it."""
    if value is None or value != value:
        return None
    if colours.dtype.kind == "f":
        with np.errstate(over="ignore"):
            return (colours == colours.dtype.type(value)).all(axis=2)
    bounds = np.iinfo(colours.dtype)
    if value != value // 1 or not bounds.min <= value <= bounds.max:
        return None
    return (colours == colours.dtype.type(int(value))).all(axis=2)


def _either(first: np.ndarray | None, second: np.ndarray | None) -> np.ndarray | None:
    return second if first is None else first if second is None else first | second


def _unmultiplied(colours: np.ndarray, alpha: np.ndarray, bits: int) -> np.ndarray:
    """Colours before they were multiplied by their opacity, from 0 to 1 or to the largest integer."""
    largest = 1.0 if colours.dtype.kind == "f" else 2.0 ** (bits - (colours.dtype.kind == "i")) - 1
    factor = np.divide(largest, alpha, out=np.zeros(alpha.shape), where=alpha != 0)
    if colours.dtype.kind == "f":
        return colours * factor
    return np.rint(np.minimum(colours * factor, largest)).astype(colours.dtype)
