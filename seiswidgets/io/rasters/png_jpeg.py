"""PNG and JPEG, read with Pillow at their full bit depth."""

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import BinaryIO

import numpy as np
from PIL import ExifTags, Image

from seiswidgets.errors import DataError
from seiswidgets.io.rasters.raster import Raster, is_turned

GREY, RGB, PALETTE, GREY_ALPHA, RGB_ALPHA = 0, 2, 3, 4, 6  # PNG's colour types
PNG_WORDS = {
    GREY: "grey",
    RGB: "colour",
    PALETTE: "palette",
    GREY_ALPHA: "grey with alpha",
    RGB_ALPHA: "colour with alpha",
}
JPEG_WORDS = {"L": "8-bit grey", "RGB": "8-bit colour"}
ORIENTED = (b"Raw profile type exif", b"XML:com.adobe.xmp")  # text chunks of a PNG that may hold an orientation


@contextmanager
def open_png_or_jpeg(path: Path) -> "Iterator[PngPicture | JpegPicture]":
    """Open a PNG or JPEG file as a ``Picture``; an animated PNG counts its frames as pages."""
    with Image.open(path, formats=("PNG", "JPEG")) as image:
        yield PngPicture(path, image) if image.format == "PNG" else JpegPicture(path, image)


class JpegPicture:
    """A JPEG file, grey or colour; see ``Picture``."""

    def __init__(self, path: Path, image: Image.Image):
        self.path, self.image = path, image
        self.size = image.size
        self.orientation = image.getexif().get(ExifTags.Base.Orientation, 1)
        self.shape = image.size if is_turned(self.orientation) else image.size[::-1]
        self.pages = getattr(image, "n_frames", 1)
        self.format = f"JPEG, {JPEG_WORDS.get(image.mode, image.mode)}"

    def check(self) -> None:
        """Raise DataError if it is neither grey nor RGB."""
        if self.image.mode not in JPEG_WORDS:
            raise DataError(
                f"{self.path} is a JPEG in {self.image.mode}, but must be in grey or RGB; convert it to RGB first"
            )

    def raster(self) -> Raster:
        """Decode the pixels."""
        return Raster(np.atleast_3d(np.asarray(self.image)), 8, orientation=self.orientation)


class PngPicture:
    """A PNG file of any depth and colour type; see ``Picture``."""

    def __init__(self, path: Path, image: Image.Image):
        self.path, self.image = path, image
        with path.open("rb") as file:
            *_, self.depth, self.colour = file.read(26)  # the first chunk, IHDR, is always here
            late = _has_late_orientation(file)
        self.size = image.size
        exif = image.getexif() if late else Image.Image.getexif(image)  # PNG's own method decodes all pixels
        self.orientation = exif.get(ExifTags.Base.Orientation, 1)
        self.shape = image.size if is_turned(self.orientation) else image.size[::-1]
        self.pages = getattr(image, "n_frames", 1)
        clear = " and a transparent colour" if "transparency" in image.info else ""
        self.format = f"PNG, {self.depth}-bit {PNG_WORDS.get(self.colour, 'pixels')}{clear}"

    def check(self) -> None:
        """Raise DataError if PNG does not have this depth or colour type."""
        if self.colour not in PNG_WORDS or self.depth not in (1, 2, 4, 8, 16):
            raise DataError(
                f"{self.path} has the colour type {self.colour} at {self.depth} bits, which PNG does not have; it is "
                "damaged: save it again"
            )

    def raster(self) -> Raster:
        """Decode the pixels."""
        samples = self._samples()
        if self.colour in (GREY_ALPHA, RGB_ALPHA, PALETTE):
            samples, clear = samples[:, :, :-1], samples[:, :, -1] == 0
        else:
            clear = self._has_clear_colour(samples)
        return Raster(samples, max(self.depth, 8), clear, orientation=self.orientation)

    def _samples(self) -> np.ndarray:
        """All samples, with at least 8 bits, shape (height, width, samples)."""
        if self.depth == 16 and self.colour == RGB:
            return self._two_byte_samples("RGB")
        if self.depth == 16 and self.colour == RGB_ALPHA:
            return self._two_byte_samples("RGBA")
        if self.depth == 16 and self.colour == GREY_ALPHA:  # as many bytes per pixel as 8-bit RGBA
            return np.ascontiguousarray(self._decoded("RGBA", "RGBA")).view(">u2").astype(np.uint16)
        if self.depth == 16:
            return np.asarray(self.image)[:, :, None].astype(np.uint16)
        mode = {GREY: "L", RGB: "RGB", PALETTE: "RGBA", GREY_ALPHA: "LA", RGB_ALPHA: "RGBA"}[self.colour]
        return np.atleast_3d(np.asarray(self.image.convert(mode)))

    def _two_byte_samples(self, mode: str) -> np.ndarray:
        """16-bit colours, decoded twice: Pillow keeps the upper 8 bits or, in the other byte order, the lower ones."""
        samples = self._decoded(mode, f"{mode};16B").astype(np.uint16)
        samples <<= 8
        samples |= self._decoded(mode, f"{mode};16L")
        return samples

    def _decoded(self, mode: str, rawmode: str) -> np.ndarray:
        """Pixels as Pillow unpacks them with another raw mode than its own."""
        with Image.open(self.path, formats=("PNG",)) as image:
            if image.mode != mode or len(image.tile) != 1:
                raise DataError(
                    f"{self.path} has {self.depth} bits per colour, of which this version of Pillow would lose some; "
                    "save it as 16-bit grey"
                )
            tile = (*image.tile[0][:3], rawmode)
            image.tile = [tile]  # type: ignore[list-item]  # a named tuple only since Pillow 11
            return np.asarray(image)

    def _has_clear_colour(self, samples: np.ndarray) -> np.ndarray | None:
        """Mask of pixels whose colour a tRNS chunk declares transparent, or None."""
        colour = self.image.info.get("transparency")
        if colour is None:
            return None
        scale = {2: 85, 4: 17}.get(self.depth, 1)  # Pillow scales the transparent shade for 1 bit, but not for these
        clear: np.ndarray = (samples == np.multiply(colour, scale)).all(axis=2)
        return clear


def _has_late_orientation(file: BinaryIO) -> bool:
    """Check whether a PNG's orientation may follow its pixels, where Pillow finds it only after decoding them."""
    file.seek(8)
    late = False
    while len(head := file.read(8)) == 8:
        length, kind = int.from_bytes(head[:4], "big"), head[4:]
        start = file.tell()
        if late and (kind == b"eXIf" or (kind in (b"tEXt", b"zTXt", b"iTXt") and file.read(40).startswith(ORIENTED))):
            return True
        late = late or kind == b"IDAT"
        file.seek(start + length + 4)
    return False
