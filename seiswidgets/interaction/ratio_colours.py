"""From area ratios to colours."""

from dataclasses import dataclass

import matplotlib as mpl
import numpy as np

from seiswidgets.core.deformation import LEAST_SPAN, colour_span
from seiswidgets.plot.palette import AREA_RATIO

FADED = 0.12  # times as opaque is what lies outside the brush
FADING = 0.6  # power of the distance from 1 that the opacity grows with


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
        colours = np.vstack([np.zeros(4), mpl.colormaps[AREA_RATIO](np.linspace(0, 1, 255))])
        level = np.arange(256)
        colours[1:, 3] = (np.abs(level[1:] - 128) / 127) ** FADING
        if brush is not None:
            low, high = self.levels(brush)
            inside = (level >= max(low, 1)) & (level <= high)
            colours[:, 3] = np.where(inside, 1.0, FADED * colours[:, 3])
        return np.rint(255 * colours).astype(np.uint8)
