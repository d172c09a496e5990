"""From area ratios to colours."""

from dataclasses import dataclass

import matplotlib as mpl
import numpy as np

from seiswidgets.core.deformation import LEAST_SPAN, area_ratio_histogram
from seiswidgets.plot.figures import COLOURS

FADED = 0.12  # opacity of what lies outside the brush


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
    def of(cls, ratio) -> "RatioColouring":
        """The colouring whose span is that of the histogram of some area ratios, NaNs left out."""
        known = np.asarray(ratio, float)
        known = known[~np.isnan(known)]
        if not len(known):
            return cls(LEAST_SPAN)
        edges, _ = area_ratio_histogram(known, np.ones(len(known)), bins=1)
        return cls(float(edges[-1]))

    def levels(self, ratio) -> np.ndarray:
        """Places in the palette, uint8 of the same shape: 1 to 255, 128 for ratio 1, and 0 for NaN."""
        place = np.clip(np.log(ratio) / np.log(self.span), -1, 1)
        return np.where(np.isnan(place), 0, np.rint(128 + 127 * place)).astype(np.uint8)

    def palette(self, brush: tuple[float, float] | None = None) -> np.ndarray:
        """Red, green, blue and alpha of each level, shape (256, 4), uint8; level 0 is transparent.

        Parameters
        ----------
        brush : (low, high), optional
            Area ratios; what lies outside is nearly transparent.
        """
        colours = np.vstack([np.zeros(4), mpl.colormaps[COLOURS](np.linspace(0, 1, 255))])
        if brush is not None:
            low, high = self.levels(brush)
            level = np.arange(256)
            colours[(level < low) | (level > high), 3] *= FADED
        return np.rint(255 * colours).astype(np.uint8)
