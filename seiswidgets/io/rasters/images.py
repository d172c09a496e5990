"""Scanned images as sections: PNG, JPEG and TIFF, with shades of grey as amplitudes."""

import lzma
import struct
import warnings
import zlib
from collections.abc import Iterator
from contextlib import AbstractContextManager, contextmanager
from pathlib import Path
from typing import Protocol

from PIL import Image

from seiswidgets.errors import DataError, Keyword, SeiswidgetsError
from seiswidgets.geology.section import Section
from seiswidgets.io.document import shortened
from seiswidgets.io.info import TIME_OR_DEPTH, SectionInfo
from seiswidgets.io.options import AXIS_OPTIONS, DAMAGED, SEGY_OPTIONS, OpenOptions, Progress, make_section
from seiswidgets.io.rasters.calibration import ROTATED, Calibration, Window, checked_window
from seiswidgets.io.rasters.raster import Raster

MOST_PIXELS = 40_000_000
BY_AXES = ", or two points on each axis by ", Keyword("calibration")
TIFF = (b"II*\0", b"MM\0*", b"II+\0", b"MM\0+")


class Picture(Protocol):
    """An open image, of which no pixel has been decoded yet.

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

    @property
    def size(self) -> tuple[int, int]: ...

    @property
    def shape(self) -> tuple[int, int]: ...

    @property
    def format(self) -> str: ...

    @property
    def pages(self) -> int: ...

    def check(self) -> None:
        """Raise DataError if the file is truncated, or cannot be read without loss."""

    def raster(self) -> Raster:
        """Decode the pixels."""


def open_picture(path: Path, options: OpenOptions, _progress: Progress | None) -> Section:
    """Open an image as a section; shades count from middle grey, so that black and white are opposite amplitudes.

    Colours become grey; transparent pixels and those with a no-data value become NaN. Signed integers, floats, and
    integers of 32 and 64 bits are used as amplitudes. An image is rotated according to its metadata. If it has several
    pages, the first in full resolution is read, with a warning.

    Raises
    ------
    DataError
        If the image is damaged, too large, or cannot be read without loss.
    SettingError
        If its axes or units are not given.
    """
    options.refuse(SEGY_OPTIONS, "a picture")
    options.time_or_depth(path)
    calibration = _calibration(path, options)
    with _picture(path) as picture:
        window = checked_window(options.keywords.get("crop"), picture.shape)
        fields = {} if calibration else options.axes(path, _shape_of(window), *BY_AXES)
        amplitude = picture.raster().amplitude()
    if picture.pages > 1:
        message = f"{path} has {picture.pages} pages, of which only the first is read"
        warnings.warn(message, stacklevel=4)  # points to the call of open_section
    if calibration:
        amplitude, fields = calibration.calibrated(amplitude, window)
    else:
        left, right, top, bottom = window
        amplitude = amplitude[top : bottom + 1, left : right + 1]
    return make_section(path, amplitude, options, **fields)


def _shape_of(window: Window) -> tuple[int, int]:
    left, right, top, bottom = window
    return bottom - top + 1, right - left + 1


def _calibration(path: Path, options: OpenOptions) -> Calibration | None:
    """The calibration that was given, if any; warn if its axes are rotated and are to stay so."""
    given = options.keywords.get("calibration")
    if given is None:
        return None
    options.refuse((*AXIS_OPTIONS, "extent"), "a picture that is calibrated")
    calibration = Calibration.of(given)
    angle = calibration.rotation
    if abs(angle) > ROTATED and not calibration.deskew:
        message = (
            f'the axes of {path} are rotated by {angle:.1f} degrees; straighten them by "deskew": True in '
            "calibration=, or choose both points of an axis on one line"
        )
        warnings.warn(message, stacklevel=5)  # points to the call of open_section
    return calibration


def preview_picture(path: Path, options: OpenOptions) -> SectionInfo:
    """Summarise an image without decoding it."""
    options.refuse(SEGY_OPTIONS, "a picture")
    with _picture(path) as picture:
        page = f", page 1 of {picture.pages}" if picture.pages > 1 else ""
        return SectionInfo(
            path=path,
            kind="picture",
            format=f"{picture.format}{page}",
            size=path.stat().st_size,
            shape=picture.shape,
            needed=("extent", TIME_OR_DEPTH),
        )


@contextmanager
def _picture(path: Path) -> Iterator[Picture]:
    """Open an image and check it; errors of the libraries that read it become DataErrors."""
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # about its size, which is checked here, and about unusual metadata
            with _open_picture(path) as picture:
                _check_size(path, picture)
                picture.check()
                yield picture
    except SeiswidgetsError:
        raise
    except Image.DecompressionBombError as error:
        raise DataError(f"{path} is too large an image: {error}; save a smaller one") from error
    except (*DAMAGED, MemoryError, struct.error, zlib.error, lzma.LZMAError) as error:
        raise DataError(
            f"{path} is a damaged image, or one of an unusual kind: {shortened(str(error))}; save it again as PNG"
        ) from error


def _open_picture(path: Path) -> AbstractContextManager[Picture]:
    """Open an image file; tifffile is imported only if it is needed."""
    with path.open("rb") as file:
        beginning = file.read(4)
    if beginning in TIFF:
        from seiswidgets.io.rasters.tiff import open_tiff

        return open_tiff(path)
    from seiswidgets.io.rasters.png_jpeg import open_png_or_jpeg

    return open_png_or_jpeg(path)


def _check_size(path: Path, picture: Picture) -> None:
    width, height = picture.size
    if width * height > MOST_PIXELS:
        raise DataError(
            f"{path} is an image of {width} x {height} pixels; the limit is {MOST_PIXELS:,}: save a smaller one"
        )
