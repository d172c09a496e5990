"""Scanned pictures in: PNG, JPEG and TIFF, their grey as amplitude."""

import lzma
import struct
import warnings
import zlib
from contextlib import contextmanager
from pathlib import Path
from typing import Protocol

from PIL import Image

from seiswidgets.errors import DataError, SeiswidgetsError
from seiswidgets.geology.section import Section
from seiswidgets.io.document import shortened
from seiswidgets.io.info import HEIGHT, SectionInfo
from seiswidgets.io.options import DAMAGED, OF_SEGY, OpenOptions, Progress, section_of
from seiswidgets.io.rasters.raster import Raster

MOST_PIXELS = 40_000_000
TIFF = (b"II*\0", b"MM\0*", b"II+\0", b"MM\0+")


class Picture(Protocol):
    """A picture that is open, and of which no pixel has been decoded yet.

    Attributes
    ----------
    size : (int, int)
        Width and height as stored.
    shape : (int, int)
        Rows and columns, upright.
    format : str
        File format and sample format, in words.
    pages : int
        Number of pages in full resolution, of which the first is read.
    """

    size: tuple[int, int]
    shape: tuple[int, int]
    format: str
    pages: int

    def check(self):
        """Raise DataError if the file is cut short, or cannot be read without loss."""

    def raster(self) -> Raster:
        """Decode the pixels."""


def open_picture(path: Path, choices: OpenOptions, _progress: Progress | None) -> Section:
    """A section of a picture: grey counted from the middle one, so that black and white are opposite amplitudes.

    Colours become grey; clear pixels and those of a no-data value become NaN. Signed integers, floats and integers of
    32 and 64 bits are amplitudes already. A picture is turned as its metadata say. Of several pages the first in full
    resolution is taken, with a warning.

    Raises
    ------
    DataError
        If the picture is damaged, too large, or of a kind that cannot be read without loss.
    SettingError
        If its axes or units are not said.
    """
    choices.refuse(OF_SEGY, "a picture")
    choices.time_or_depth(path)
    with _picture(path) as picture:
        fields = choices.axes(path, picture.shape)
        amplitude = picture.raster().amplitude()
    if picture.pages > 1:
        message = f"{path} has {picture.pages} pages, of which only the first is read"
        warnings.warn(message, stacklevel=3)  # where open_section was called
    return section_of(path, amplitude, choices, **fields)


def preview_picture(path: Path, choices: OpenOptions) -> SectionInfo:
    """What a picture holds, without decoding it."""
    choices.refuse(OF_SEGY, "a picture")
    with _picture(path) as picture:
        page = f", page 1 of {picture.pages}" if picture.pages > 1 else ""
        return SectionInfo(
            path=path,
            kind="picture",
            format=f"{picture.format}{page}",
            size=path.stat().st_size,
            shape=picture.shape,
            needed=("extent", HEIGHT),
        )


@contextmanager
def _picture(path):
    """A picture, not yet decoded; all errors of the libraries that read it become ours."""
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # about its size, which is checked here, and about odd metadata
            with _opened(path) as picture:
                _check_size(path, picture)
                picture.check()
                yield picture
    except SeiswidgetsError:
        raise
    except Image.DecompressionBombError as error:
        raise DataError(f"{path} is too large a picture: {error}; save a smaller one") from error
    except (*DAMAGED, MemoryError, struct.error, zlib.error, lzma.LZMAError) as error:
        raise DataError(
            f"{path} is a damaged picture, or one of an unusual kind: {shortened(str(error))}; save it anew as PNG"
        ) from error


def _opened(path):
    """The picture of a file, as a context manager. tifffile is imported only where it is needed."""
    with path.open("rb") as file:
        beginning = file.read(4)
    if beginning in TIFF:
        from seiswidgets.io.rasters.tiff import opened_tiff

        return opened_tiff(path)
    from seiswidgets.io.rasters.png_jpeg import opened_png_or_jpeg

    return opened_png_or_jpeg(path)


def _check_size(path, picture):
    width, height = picture.size
    if width * height > MOST_PIXELS:
        raise DataError(
            f"{path} is a picture of {width} x {height} pixels; there may be {MOST_PIXELS:,}: save a smaller one"
        )
