"""Colours of amplitudes and of area ratios."""

from dataclasses import dataclass
from io import BytesIO

import matplotlib as mpl
import numpy as np
from numpy.typing import ArrayLike
from PIL import Image

from seiswidgets.core.deformation import AREA_RATIO_COLOURS, LEAST_SPAN, colour_span
from seiswidgets.errors import SettingError
from seiswidgets.geology.section import Section

NAMES = {"greys": "gray", "red-white-blue": "RdBu"}  # all others have matplotlib's own names
SAMPLE = 1_000_000  # approximate number of amplitudes that a percentile is computed from
FADED = 0.12  # factor on the opacity outside the brush
FADING = 0.6  # exponent: opacity grows with this power of the distance from ratio 1


@dataclass(frozen=True)
class Colouring:
    """Colours of amplitudes.

    Parameters
    ----------
    name : str
        "greys", "red-white-blue", or any matplotlib colour map.
    limit : float
        Amplitude at which the colours end, on both sides of 0.
    """

    name: str
    limit: float

    def levels(self, amplitude: np.ndarray) -> np.ndarray:
        """Palette indices of amplitudes: 1 to 255, with 128 for amplitude 0, and 0 where there are no data."""
        known = np.isfinite(amplitude)
        scaled = np.clip(np.where(known, amplitude, 0) / self.limit, -1, 1)
        return np.where(known, np.rint(128 + 127 * scaled), 0).astype(np.uint8)

    @property
    def palette(self) -> np.ndarray:
        """Red, green, blue and alpha of each level, shape (256, 4), uint8; level 0 (no data) is transparent."""
        colours = colour_map(self.name)(np.linspace(0, 1, 255))
        return np.rint(255 * np.vstack([np.zeros(4), colours])).astype(np.uint8)


def colour_map(name: str) -> mpl.colors.Colormap:
    """Look up a colour map by name; SettingError if there is none."""
    try:
        return mpl.colormaps[NAMES.get(name, name)]
    except KeyError:
        known = ", ".join(map(repr, NAMES))
        raise SettingError(f"colours must be {known} or a matplotlib colour map, but are {name!r}") from None


def clip_limit(section: Section, clip: float) -> float:
    """Percentile ``clip`` of the absolute amplitudes; 1 if all of them are 0."""
    stride = max(1, int(np.sqrt(section.amplitude.size / SAMPLE)))
    amplitude = np.abs(section.amplitude[::stride, ::stride])
    known = amplitude[np.isfinite(amplitude)]
    return (float(np.percentile(known, clip)) if len(known) else 0.0) or 1.0


def resampled(amplitude: np.ndarray, size: tuple[int, int]) -> np.ndarray:
    """Amplitudes averaged onto fewer pixels, ``size`` being (width, height); NaN where most of a pixel has no data."""
    known = np.isfinite(amplitude)
    if known.all():
        return _averaged(amplitude, size)
    share, total = _averaged(known, size), _averaged(np.where(known, amplitude, 0), size)
    return np.divide(total, share, out=np.full(share.shape, np.nan, np.float32), where=share >= 0.5)


def _averaged(values: np.ndarray, size: tuple[int, int]) -> np.ndarray:
    return np.asarray(Image.fromarray(np.asarray(values, np.float32)).resize(size, Image.Resampling.BOX))


@dataclass(frozen=True)
class RatioColouring:
    """Colours of area ratios, even in their logarithm: blue is expansion, red compression.

    Parameters
    ----------
    span : float
        The colours run from 1 / span to span; above 1.
    """

    span: float

    @classmethod
    def of(cls, ratio: ArrayLike, areas: ArrayLike | None = None) -> "RatioColouring":
        """Choose the span from the area ratios of triangles, NaN left out; equal areas if none are given."""
        ratio = np.asarray(ratio, float)
        known = ~np.isnan(ratio)
        if not known.any():
            return cls(LEAST_SPAN)
        areas = np.ones(ratio.shape) if areas is None else np.asarray(areas)
        return cls(colour_span(ratio[known], areas[known]))

    def levels(self, ratio: ArrayLike) -> np.ndarray:
        """Palette indices, uint8 of the same shape: 1 to 255, 128 for ratio 1, and 0 for NaN."""
        scaled = np.clip(np.log(ratio) / np.log(self.span), -1, 1)
        return np.where(np.isnan(scaled), 0, np.rint(128 + 127 * scaled)).astype(np.uint8)

    def palette(self, brush: tuple[float, float] | None = None, faded: float = FADED) -> np.ndarray:
        """Red, green, blue and alpha of each level, shape (256, 4), uint8; level 0 is transparent.

        Ratios near 1 are the most transparent, so that rock that kept its area looks as it is.

        Parameters
        ----------
        brush : (low, high), optional
            Area ratios: between them the map is opaque, outside it is nearly transparent.
        faded : float
            Factor on the opacity outside the brush.
        """
        colours = np.vstack([np.zeros(4), mpl.colormaps[AREA_RATIO_COLOURS](np.linspace(0, 1, 255))])
        level = np.arange(256)
        colours[1:, 3] = (np.abs(level[1:] - 128) / 127) ** FADING
        if brush is not None:
            low, high = self.levels(brush)
            inside = (level >= max(low, 1)) & (level <= high)
            colours[:, 3] = np.where(inside, 1.0, faded * colours[:, 3])
        return np.rint(255 * colours).astype(np.uint8)


def checked_span(span: float) -> float:
    """Validate the end of a scale of area ratios; SettingError unless it is finite and above 1."""
    if not 1 < span < np.inf:
        raise SettingError(f"span must be above 1, since the colours run from 1 / span to span, but is {span:g}")
    return float(span)


def encode_png(levels: np.ndarray, palette: np.ndarray) -> bytes:
    """Encode a picture as a PNG with a palette, which keeps every colour and transparency.

    A JPEG is a third of the size but takes as long to encode (measured at 450 x 300 and 900 x 600), and has no
    transparency: parts without data would flicker between moving and still pictures.

    Parameters
    ----------
    levels : array of uint8, shape (height, width)
    palette : array of uint8, shape (256, 4)
        Red, green, blue and alpha.
    """
    picture = Image.fromarray(levels)
    picture.putpalette(palette[:, :3].tobytes())
    file = BytesIO()
    picture.save(file, "PNG", transparency=palette[:, 3].tobytes(), compress_level=3)
    return file.getvalue()
