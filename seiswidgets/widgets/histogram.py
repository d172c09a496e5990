"""The distribution of the area ratio over the rock, as bars that can be brushed."""

from typing import Any

import anywidget
import numpy as np
from matplotlib.ticker import MaxNLocator
from numpy.typing import ArrayLike
from traitlets import Bool, Bunch, Dict, Float, List, Unicode, observe, validate

from seiswidgets.core.deformation import USUAL_SPAN, area_ratio_histogram, weighted_percentiles
from seiswidgets.errors import SettingError
from seiswidgets.interaction.colour import RatioColouring, checked_span
from seiswidgets.interaction.ratio_axis import BINS, ratio_axis
from seiswidgets.widgets.assets import asset
from seiswidgets.widgets.closing import WithParts

EMPTY = "Nothing restored yet: there is no deformation to show."
LEAST_SHARE = 1e-6  # of the area, above which a bar begins on a logarithmic axis


class DeformationHistogram(WithParts, anywidget.AnyWidget):
    """The distribution of the area ratio, present-day over restored, in the colours of the deformation map.

    A drag brushes a range of bars, a click one bar, Shift+click extends the range; a double click clears it. With the
    keyboard: the left and right arrow, Home and End brush one bar, with Shift they extend the range; Escape clears it.

    Parameters
    ----------
    ratio, areas : array, shape (m,), optional
        As for `show`; empty if left out.
    bins : int
        Number of bars; an odd one centres a bar on 1.
    **settings
        Initial values of the attributes.

    Attributes
    ----------
    brush : list
        Area ratios ``[low, high]`` that are brushed, or empty; may be set. At an end of the axis, the brush includes
        everything beyond.
    mark : float or None
        Area ratio whose bar is marked.
    span : float
        Bars and colours run from 1 / span to span; what lies beyond is counted in the end bars.
    log_shares : bool
        Whether the axis of the shares is logarithmic.
    summary, brushed : str
        Text above the bars: median and percentiles by area, and the scale; the brush with its share of the area.
    bars : dict
        The drawing: "edges", "shares", "colours", the ticks "x" and "y" with their labels, "decimals", and "floor", the
        lowest share of a logarithmic axis, or 0; or empty.

    Raises
    ------
    SettingError
        If there is no bin, the brush is not a range of ratios above 0, the span is not above 1; and as for `show`.
    """

    _esm = asset("histogram.js")
    _css = asset("histogram.css")

    bars = Dict().tag(sync=True)
    summary = Unicode(EMPTY).tag(sync=True)
    brushed = Unicode().tag(sync=True)
    brush: List[float] = List().tag(sync=True)
    mark = Float(None, allow_none=True).tag(sync=True)
    log_shares = Bool(False).tag(sync=True)
    span = Float(USUAL_SPAN)

    def __init__(
        self, ratio: ArrayLike | None = None, areas: ArrayLike | None = None, *, bins: int = BINS, **settings: Any
    ):
        self.check_settings(settings)
        if bins < 1:
            raise SettingError(f"a histogram needs at least one bin, but bins is {bins!r}")
        self._bins, self._ratio, self._areas = bins, np.empty(0), np.empty(0)
        super().__init__(**settings)
        self.show([] if ratio is None else ratio, areas)

    @property
    def colouring(self) -> RatioColouring:
        """Colours of the bars, for a map beside them."""
        return RatioColouring(self.span)

    def show(self, ratio: ArrayLike, areas: ArrayLike | None = None) -> None:
        """Show other area ratios; the brush stays.

        Parameters
        ----------
        ratio : array, shape (m,)
            Area ratio of each triangle; NaN is left out. If nothing remains, the histogram is empty.
        areas : array, shape (m,), optional
            Their initial areas; equal if left out.

        Raises
        ------
        SettingError
            If the shapes differ, a ratio is not above 0, an area is below 0, or all areas are 0.
        """
        self._ratio, self._areas = _checked(ratio, areas)
        self._draw()

    @observe("span", "log_shares")
    def _draw(self, change: Bunch | None = None) -> None:
        has_ratio = len(self._ratio) > 0
        with self.hold_sync():
            self.bars = (
                _bars(self._ratio, self._areas, self._bins, self.colouring, self.log_shares) if has_ratio else {}
            )
            self.summary = _summary(self._ratio, self._areas, self.span) if has_ratio else EMPTY
            self._show_brush()

    @validate("span")
    def _valid_span(self, proposal: Bunch) -> float:
        return checked_span(proposal.value)

    @validate("brush")
    def _valid_brush(self, proposal: Bunch) -> list[float]:
        brush = proposal.value
        try:
            low, high = map(float, brush) if brush else (1.0, 2.0)
        except (TypeError, ValueError):
            low = high = np.nan
        if not 0 < low < high < np.inf:
            raise SettingError(f"brush must be [low, high], two area ratios above 0, or [] for none, but is {brush!r}")
        return [low, high] if brush else []

    @observe("brush")
    def _show_brush(self, change: Bunch | None = None) -> None:
        self.brushed = self._brush_text() if self.brush and self.bars else ""

    def _brush_text(self) -> str:
        low, high = self.brush
        first, last = self.bars["edges"][0], self.bars["edges"][-1]
        inside = ((self._ratio >= low) | (low <= first)) & ((self._ratio <= high) | (high >= last))
        share = 100 * self._areas[inside].sum() / self._areas.sum()
        decimals = self.bars["decimals"]
        return f"{low:.{decimals}f} to {high:.{decimals}f}: {share:.3g}% of the area"


def _checked(ratio: ArrayLike, areas: ArrayLike | None) -> tuple[np.ndarray, np.ndarray]:
    """Validate area ratios and areas, and leave out those that are NaN."""
    ratios = np.asarray(ratio, float)
    weights = np.ones(ratios.shape) if areas is None else np.asarray(areas, float)
    if ratios.ndim != 1 or weights.shape != ratios.shape:
        raise SettingError(
            f"each triangle has one area ratio and one area, but these have shapes {ratios.shape} and {weights.shape}"
        )
    known = ~np.isnan(ratios)
    ratios, weights = ratios[known], weights[known]
    if not ((ratios > 0) & (ratios < np.inf)).all():
        raise SettingError("area ratios must be finite and above 0; a triangle has collapsed or is turned over")
    if not ((weights >= 0) & (weights < np.inf)).all() or (len(weights) and not weights.any()):
        raise SettingError("areas must be finite, 0 or more, and not all of them 0")
    return ratios, weights


def _bars(ratio: np.ndarray, areas: np.ndarray, bins: int, colouring: RatioColouring, is_log: bool) -> dict[str, Any]:
    _, shares = area_ratio_histogram(ratio, areas, bins, colouring.span)
    floor = _decade_below(shares[shares > 0].min()) if is_log else 0.0
    percents = _percents(100 * shares.max(), 100 * floor)
    return {
        **ratio_axis(colouring, bins),
        "shares": shares.tolist(),
        "y": [[percent / 100, f"{percent:g}"] for percent in percents],
        "floor": floor,
    }


def _percents(most: float, floor: float) -> list[float]:
    """Ticks of the shares up to the highest, in percent: decades from a floor above 0, or else round numbers."""
    if floor:
        decades = np.arange(np.log10(floor), np.log10(most) + 0.5)
        return [float(f"{percent:.3g}") for percent in 10**decades]
    return [float(percent) for percent in MaxNLocator(3).tick_values(0, most)]


def _decade_below(share: float) -> float:
    """Power of 10 below a share, so that its bar has a height."""
    return float(10.0 ** np.ceil(np.log10(max(share, LEAST_SHARE)) - 1))


def _summary(ratio: np.ndarray, areas: np.ndarray, span: float) -> str:
    low, median, high = weighted_percentiles(ratio, areas, (1, 50, 99))
    beyond = 100 * areas[(ratio < 1 / span) | (ratio > span)].sum() / areas.sum()
    rest = f", {beyond:.2g}% of the area beyond" if beyond > 0 else ""
    rescaled = "" if span == USUAL_SPAN else ", rescaled"
    return f"median {median:.3f}, P1 {low:.3f}, P99 {high:.3f}; scale ±{100 * (span - 1):.3g}%{rescaled}{rest}"
