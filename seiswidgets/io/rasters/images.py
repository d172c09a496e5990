"""Scanned pictures in: PNG, JPEG and TIFF, their grey as amplitude."""

import struct
import warnings
from contextlib import contextmanager
from pathlib import Path

import numpy as np
from PIL import ExifTags, Image, ImageOps

from seiswidgets.errors import DataError, SeiswidgetsError
from seiswidgets.geology.section import Section
from seiswidgets.io.info import TIME_OR_DEPTH, SectionInfo
from seiswidgets.io.options import DAMAGED, SEGY_OPTIONS, OpenOptions, Progress, make_section

MOST_PIXELS = 40_000_000
DEEP = ("I;16", "I;16B")
MIDDLE = {"L": 127.5, **dict.fromkeys(DEEP, 32767.5)}  # grey halfway from black to white
AS_THEY_ARE = ("I", "F")
PHOTOMETRIC, WHITE_IS_ZERO = 262, 0  # a tag of TIFF: Pillow heeds it in all modes but the deep ones


def open_picture(path: Path, choices: OpenOptions, _progress: Progress | None) -> Section:
    """A section of a picture: grey counted from the middle one, so that black and white are opposite amplitudes.

    Colours become grey; what is transparent becomes NaN. Grey of 32 bits is taken as it is. A picture is turned as its
    metadata say, and of several pages the first is taken.

    Raises
    ------
    DataError
        If the picture is damaged or too large.
    SettingError
        If its axes or units are not said.
    """
    choices.refuse(SEGY_OPTIONS, "a picture")
    choices.time_or_depth(path)
    with _picture(path) as image:
        fields = choices.axes(path, _shape(image))
        amplitude = _grey(image)
    return make_section(path, amplitude, choices, **fields)


def preview_picture(path: Path, choices: OpenOptions) -> SectionInfo:
    """What a picture holds, without decoding it."""
    choices.refuse(SEGY_OPTIONS, "a picture")
    with _picture(path) as image:
        return SectionInfo(
            path=path,
            kind="picture",
            format=f"{image.format}, mode {image.mode}{_pages(image)}",
            size=path.stat().st_size,
            shape=_shape(image),
            needed=("extent", TIME_OR_DEPTH),
        )


@contextmanager
def _picture(path):
    """A picture, not yet decoded; whatever goes wrong with it says so of the file."""
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # about its size, which is checked here, and about odd metadata
            with Image.open(path, formats=("PNG", "JPEG", "TIFF")) as image:
                _check_size(path, image)
                yield image
    except SeiswidgetsError:
        raise
    except Image.DecompressionBombError as error:
        raise DataError(f"{path} is too large a picture: {error}; save a smaller one") from error
    except (*DAMAGED, struct.error) as error:
        raise DataError(
            f"{path} is a damaged picture, or one of an unusual kind: {error}; save it anew as PNG"
        ) from error


def _check_size(path, image):
    width, height = image.size
    if width * height > MOST_PIXELS:
        raise DataError(
            f"{path} is a picture of {width} x {height} pixels; there may be {MOST_PIXELS:,}: save a smaller one"
        )
    right, bottom = np.max([tile[1][2:] for tile in image.tile], axis=0)
    if image.tile[0][0] == "libtiff" and _is_turned(image):  # Pillow turns these well, but others into a jumble
        right, bottom = bottom, right
    if right < width or bottom < height:  # Pillow would leave the rest black
        raise DataError(
            f"{path} says that it has {width} x {height} pixels, but holds {right} x {bottom}; it is damaged: save it "
            "anew as PNG"
        )


def _is_turned(image):
    """Whether a picture's metadata say that it lies on its side."""
    return image.getexif().get(ExifTags.Base.Orientation, 1) >= 5


def _shape(image):
    """Rows and columns of a picture, upright."""
    return image.size if _is_turned(image) and image.format != "TIFF" else image.size[::-1]


def _pages(image):
    pages = getattr(image, "n_frames", 1)
    return f", the first of {pages} pages" if pages > 1 else ""


def _grey(image):
    """Amplitudes of a picture, upright, float32, shape (height, width)."""
    negative = image.mode in DEEP and image.format == "TIFF" and image.tag_v2.get(PHOTOMETRIC) == WHITE_IS_ZERO
    image = ImageOps.exif_transpose(image)
    clear = _clear(image)
    if image.mode not in (*MIDDLE, *AS_THEY_ARE):
        image = image.convert("L")
    amplitude = np.array(image, np.float32)
    amplitude -= MIDDLE.get(image.mode, 0.0)
    amplitude *= -1 if negative else 1
    amplitude[clear] = np.nan
    return amplitude


def _clear(image):
    """Where a picture shows nothing; shape (height, width), or False for nowhere."""
    if not image.has_transparency_data:
        return False
    if image.mode in DEEP:  # Pillow's own conversion would cut them to 8 bits
        return np.asarray(image) == image.info["transparency"]
    return np.asarray(image.convert("RGBA").getchannel("A")) == 0
