"""Figures of an ensemble: its restored horizons, and where the deformation is uncertain."""

from dataclasses import replace

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from seiswidgets.errors import SettingError
from seiswidgets.geology.ensembles.ensemble import Ensemble
from seiswidgets.geology.pick_colours import PickColours, pick_colours
from seiswidgets.geology.picks import HORIZON
from seiswidgets.geology.validation import checked_kind
from seiswidgets.plot.frame import NO_DATA, WIDTH, PlotFrame, Window, plot_frame
from seiswidgets.plot.story import label_outer, make_panels
from seiswidgets.signatures import strict_keywords

THREADS = 200  # members whose horizons are drawn, at most
FONT = 9.0  # points
SPREAD_COLOURS = "viridis"


@strict_keywords
def ensemble(
    ensemble: Ensemble,
    *,
    colours: PickColours | None = None,
    exaggeration: float | None = None,
    window: Window | None = None,
    figure: Figure | None = None,
) -> Figure:
    """Draw the restored horizons of all members, their means and bands, and a map of the spread of the area ratio.

    A band is the mean and two standard deviations to either side. The map lies on the present-day section.

    Parameters
    ----------
    ensemble : Ensemble
    colours : dict, optional
        Of the picks, as for ``section``.
    exaggeration, window
        As described for this module; the window is that of the restored horizons.
    figure : Figure, optional
        An empty figure to draw on; its size is set. If left out, pyplot makes one.

    Raises
    ------
    SettingError
        If no member was restored, or a keyword is out of its range.
    """
    checked_kind(ensemble, Ensemble, "ensemble")
    if not np.isfinite(ensemble.depths).any():
        raise SettingError("no member was restored, so there are no horizons to draw; give a plan with steps")
    section = ensemble.study.drawn.section
    frame = plot_frame(section, [section], exaggeration, window)
    figure = plt.figure() if figure is None else figure
    horizons, spread = make_panels(figure, 2, 1, frame, WIDTH)
    _draw_horizons(horizons, ensemble, colours)
    frame.apply_to(horizons, f"restored horizons: {ensemble.summary}; bands of two standard deviations")
    if window is None:
        horizons.autoscale(axis="x")
    _draw_spread(figure, spread, ensemble, frame)
    label_outer(horizons, True, True, FONT)
    label_outer(spread, True, True, FONT)
    frame.add_footnote_below(figure)
    return figure


def _draw_horizons(ax: Axes, ensemble: Ensemble, colours: PickColours | None) -> None:
    x, by_name = ensemble.frame.x, pick_colours(ensemble.study.drawn.interpretation, colours)
    mean, spread = ensemble.horizon_mean, ensemble.horizon_spread
    for index, name in enumerate(ensemble.frame.horizons):
        colour = by_name[HORIZON, name]
        ax.plot(x, ensemble.depths[:THREADS, index].T, color=colour, linewidth=0.4, alpha=0.25)
        band = 2 * np.nan_to_num(spread[index])
        ax.fill_between(x, mean[index] - band, mean[index] + band, color=colour, alpha=0.25, linewidth=0)
        ax.plot(x, mean[index], color=colour, linewidth=1.6, label=name)
    ax.legend(loc="best", fontsize=FONT, framealpha=0.8)


def _draw_spread(figure: Figure, ax: Axes, ensemble: Ensemble, frame: PlotFrame) -> None:
    nodes = ensemble.frame.nodes
    colours = plt.get_cmap(SPREAD_COLOURS).with_extremes(bad=NO_DATA)
    image = ax.pcolormesh(nodes[0, :, 0], nodes[:, 0, 1], ensemble.ratio_spread, cmap=colours, shading="nearest")
    section = frame.section
    x_min, x_max, z_min, z_max = section.extent
    replace(frame, window=(x_min, x_max, z_min, z_max)).apply_to(ax, "standard deviation of the area ratio")
    figure.colorbar(image, ax=ax, pad=0.01)
