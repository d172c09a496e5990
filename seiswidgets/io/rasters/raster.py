"""Stored pixels of an image, and their amplitudes."""

from dataclasses import dataclass
from typing import Any

import numpy as np

DEEPEST_GREY = 16  # bits; larger integers are data, not shades
RED, GREEN, BLUE = 19595, 38470, 7471  # weights of ITU-R BT.601 in 65536ths, rounded as Pillow and libjpeg do


@dataclass(frozen=True, eq=False)
class Raster:
    """Stored pixels, before they are rotated upright.

    Attributes
    ----------
    samples : array, shape (height, width, 1 or 3)
        Grey, or red, green and blue.
    bits : int
        Bits per sample; unsigned integers of up to 16 bits are shades from 0 to ``2**bits - 1``.
    clear : array of bool, shape (height, width), or None
        Pixels without data.
    white_is_zero : bool
    orientation : int
        1 to 8, as defined by TIFF and EXIF.
    """

    samples: np.ndarray
    bits: int
    clear: np.ndarray | None = None
    white_is_zero: bool = False
    orientation: int = 1

    def amplitude(self) -> np.ndarray:
        """Amplitudes, upright, NaN where the image has no data.

        Shades count from middle grey, so that black and white are opposite; those of fewer than 8 bits are scaled to 8.
        Signed integers, floats and integers above 16 bits are used unchanged. The result is float32, or float64 if the
        samples exceed float32's precision.
        """
        shades = are_shades(self.samples.dtype, self.bits)
        grey = _grey(self.samples, shades)
        is_wide = grey.dtype.itemsize > 4 or (grey.dtype.kind in "iu" and self.bits > 24)
        with np.errstate(over="ignore"):  # infinite amplitudes are reported when the section is made
            amplitude: np.ndarray[Any, np.dtype[np.floating]] = grey.astype(np.float64 if is_wide else np.float32)
        if shades:
            largest = 2**self.bits - 1
            if self.bits < 8:
                amplitude *= 255 / largest
                largest = 255
            amplitude -= largest / 2
            amplitude *= -1 if self.white_is_zero else 1
        if self.clear is not None:
            amplitude[self.clear] = np.nan
        return np.ascontiguousarray(upright(amplitude, self.orientation))


def are_shades(dtype: np.dtype, bits: int) -> bool:
    """Check whether samples are shades of grey or colour, rather than data."""
    return dtype.kind == "u" and bits <= DEEPEST_GREY


def _grey(samples: np.ndarray, shades: bool) -> np.ndarray:
    """Luma of red, green and blue, rounded like Pillow's if they are shades; shape (height, width)."""
    if samples.shape[2] == 1:
        return samples[:, :, 0]
    red, green, blue = np.moveaxis(samples, 2, 0)
    if not shades:
        return (np.float64(RED) * red + np.float64(GREEN) * green + np.float64(BLUE) * blue) / 65536
    total = np.multiply(red, RED, dtype=np.uint32)
    total += np.multiply(green, GREEN, dtype=np.uint32)
    total += np.multiply(blue, BLUE, dtype=np.uint32)
    total += 2**15
    return (total >> 16).astype(samples.dtype)


def upright(pixels: np.ndarray, orientation: int) -> np.ndarray:
    """Rotate and mirror pixels according to an orientation of TIFF or EXIF; unknown ones count as upright."""
    if orientation in (2, 3, 7, 8):
        pixels = pixels[:, ::-1]
    if orientation in (3, 4, 6, 7):
        pixels = pixels[::-1]
    return pixels.swapaxes(0, 1) if is_turned(orientation) else pixels


def is_turned(orientation: int) -> bool:
    """Check whether an orientation exchanges width and height."""
    return orientation in (5, 6, 7, 8)
