"""Scanned pictures in: PNG, JPEG and TIFF, their grey as amplitude."""

import warnings
from contextlib import contextmanager
from pathlib import Path

import numpy as np
from PIL import Image

from seiswidgets.errors import DataError, SeiswidgetsError
from seiswidgets.geology.section import Section
from seiswidgets.io.choices import OF_SEGY, Choices, Progress, section_of
from seiswidgets.io.info import SectionInfo

MOST_PIXELS = 40_000_000
MIDDLE = {"L": 127.5, "I;16": 32767.5, "I;16B": 32767.5}  # grey halfway from black to white
AS_THEY_ARE = ("I", "F")
DAMAGED = (OSError, SyntaxError, ValueError, TypeError, LookupError, ArithmeticError, EOFError, RuntimeError)


def open_picture(path: Path, choices: Choices, _progress: Progress | None) -> Section:
    """A section of a picture: grey counted from the middle one, so that black and white are opposite amplitudes.

    Colours become grey; what is transparent becomes NaN. Grey of 32 bits is taken as it is.

    Raises
    ------
    DataError
        If the picture is damaged or too large.
    SettingError
        If its axes or units are not said.
    """
    choices.refuse(OF_SEGY, "a picture")
    choices.time_or_depth(path)
    with _picture(path) as image:
        fields = choices.axes(path, image.size[::-1])
        amplitude = _grey(image)
    return section_of(path, amplitude, choices, **fields)


def preview_picture(path: Path) -> SectionInfo:
    """What a picture holds, without decoding it."""
    with _picture(path) as image:
        return SectionInfo(
            path=path,
            kind="picture",
            format=f"{image.format}, mode {image.mode}",
            size=path.stat().st_size,
            shape=image.size[::-1],
            needed=("extent", "z_unit or velocity"),
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
        raise DataError(f"{path} is too large a picture: {error}") from error
    except DAMAGED as error:
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
    if right < width or bottom < height:  # Pillow would leave the rest black
        raise DataError(
            f"{path} says that it has {width} x {height} pixels, but holds {right} x {bottom}; it is damaged: save it "
            "anew as PNG"
        )


def _grey(image):
    """Amplitudes of a picture, float32, shape (height, width)."""
    opaque = None
    if image.has_transparency_data:
        image = image.convert("RGBA")
        opaque = np.asarray(image.getchannel("A")) > 0
    if image.mode not in (*MIDDLE, *AS_THEY_ARE):
        image = image.convert("L")
    amplitude = np.array(image, np.float32)
    amplitude -= MIDDLE.get(image.mode, 0.0)
    return amplitude if opaque is None else np.where(opaque, amplitude, np.float32(np.nan))
