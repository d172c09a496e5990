"""Colours of amplitudes and of area ratios."""

from dataclasses import dataclass

import matplotlib as mpl
import numpy as np
from PIL import Image

from seiswidgets.core.deformation import AREA_RATIO_COLOURS, LEAST_SPAN, colour_span
from seiswidgets.errors import SettingError
from seiswidgets.geology.section import Section

NAMES = {"greys": "gray", "red-white-blue": "RdBu"}  # all others go by matplotlib's own names
SAMPLE = 1_000_000  # amplitudes that a percentile is taken of, about
FADED = 0.12  # times as opaque is what lies outside the brush
FADING = 0.6  # power of the distance from 1 that the opacity grows with


@dataclass(frozen=True)
class Colouring:
    """How amplitudes become colours.

    Parameters
    ----------
    name : str
        "greys", "red-white-blue", or any colour map of matplotlib.
    limit : float
        The amplitude at which the colours end, on both sides of 0.
    """

    name: str
    limit: float

    def levels(self, amplitude: np.ndarray) -> np.ndarray:
        """Places in the palette, of the same shape: 1 to 255, 128 for amplitude 0, and 0 where there are no data."""
        known = np.isfinite(amplitude)
        scaled = np.clip(np.where(known, amplitude, 0) / self.limit, -1, 1)
        return np.where(known, np.rint(128 + 127 * scaled), 0).astype(np.uint8)

    @property
    def palette(self) -> np.ndarray:
        """Red, green, blue and opacity of each level, shape (256, 4), uint8; where there are no data, transparent."""
        colours = colour_map(self.name)(np.linspace(0, 1, 255))
        return np.rint(255 * np.vstack([np.zeros(4), colours])).astype(np.uint8)


def colour_map(name: str) -> mpl.colors.Colormap:
    """A colour map by its name; SettingError if there is none."""
    try:
        return mpl.colormaps[NAMES.get(name, name)]
    except KeyError:
        known = ", ".join(map(repr, NAMES))
        raise SettingError(f"colours must be {known} or a colour map of matplotlib, but are {name!r}") from None


def clip_limit(section: Section, clip: float) -> float:
    """The amplitude of a percentile of the absolute amplitudes; 1 where all of them are 0."""
    stride = max(1, int(np.sqrt(section.amplitude.size / SAMPLE)))
    amplitude = np.abs(section.amplitude[::stride, ::stride])
    known = amplitude[np.isfinite(amplitude)]
    return (float(np.percentile(known, clip)) if len(known) else 0.0) or 1.0


def resampled(amplitude: np.ndarray, size: tuple[int, int]) -> np.ndarray:
    """Amplitudes averaged onto fewer pixels, (width, height); NaN where most of a pixel has no data."""
    known = np.isfinite(amplitude)
    if known.all():
        return _averaged(amplitude, size)
    share, total = _averaged(known, size), _averaged(np.where(known, amplitude, 0), size)
    return np.divide(total, share, out=np.full(share.shape, np.nan, np.float32), where=share >= 0.5)


def _averaged(values, size):
    return np.asarray(Image.fromarray(np.asarray(values, np.float32)).resize(size, Image.Resampling.BOX))


@dataclass(frozen=True)
class RatioColouring:
    """How area ratios become colours, evenly in the logarithm: blue is expansion, red compression.

    Parameters
    ----------
    span : float
        The colours run from 1 / span to span; above 1.
    """

    span: float

    @classmethod
    def of(cls, ratio, areas=None) -> "RatioColouring":
        """The colouring that suits some area ratios, NaNs left out; of triangles of equal area, if none are given."""
        known = ~np.isnan(ratio)
        if not known.any():
            return cls(LEAST_SPAN)
        areas = np.ones(np.shape(ratio)) if areas is None else np.asarray(areas)
        return cls(colour_span(np.asarray(ratio)[known], areas[known]))

    def levels(self, ratio) -> np.ndarray:
        """Places in the palette, uint8 of the same shape: 1 to 255, 128 for ratio 1, and 0 for NaN."""
        place = np.clip(np.log(ratio) / np.log(self.span), -1, 1)
        return np.where(np.isnan(place), 0, np.rint(128 + 127 * place)).astype(np.uint8)

    def palette(self, brush: tuple[float, float] | None = None) -> np.ndarray:
        """Red, green, blue and alpha of each level, shape (256, 4), uint8; level 0 is transparent.

        The nearer to 1 the more transparent, so that rock which has kept its area is seen as it is.

        Parameters
        ----------
        brush : (low, high), optional
            Area ratios; what lies between is opaque, and what lies outside nearly transparent.
        """
        colours = np.vstack([np.zeros(4), mpl.colormaps[AREA_RATIO_COLOURS](np.linspace(0, 1, 255))])
        level = np.arange(256)
        colours[1:, 3] = (np.abs(level[1:] - 128) / 127) ** FADING
        if brush is not None:
            low, high = self.levels(brush)
            inside = (level >= max(low, 1)) & (level <= high)
            colours[:, 3] = np.where(inside, 1.0, FADED * colours[:, 3])
        return np.rint(255 * colours).astype(np.uint8)
