"""Whole figures: what a stage has done to the rock, and all of a restoration."""

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.cm import ScalarMappable
from matplotlib.colors import LogNorm
from matplotlib.figure import Figure
from matplotlib.ticker import FixedLocator, FuncFormatter, NullLocator, PercentFormatter

from seiswidgets.core.deformation import area_ratio_histogram, weighted_percentiles
from seiswidgets.geology.picks import Interpretation
from seiswidgets.geology.restoration import Restoration
from seiswidgets.plot.frame import WIDTH, Window, framed
from seiswidgets.plot.pictures import (
    DONE,
    amplitude_limit,
    carried,
    chosen_stage,
    draw_picks,
    draw_section,
    state,
    up_to,
)

COLOURS = "RdBu_r"  # red is compression, blue dilatation; told apart by the colour-blind too
SPANS = (1.02, 1.05, 1.1, 1.25, 1.5, 2, 3, 5)  # area ratios at which the colours end


def deformation(
    restored: Restoration,
    interpretation: Interpretation | None = None,
    stage: int = -1,
    *,
    span: float | None = None,
    exaggeration: float | None = None,
    window: Window | None = None,
) -> Figure:
    """What a stage has done to the rock: the map of its area ratio and the histogram (the paper's fig. 6d).

    Parameters
    ----------
    restored : Restoration
    interpretation : Interpretation, optional
        Its picks are drawn as black lines.
    stage : int
        Which one, counted from 0; the last one if left out.
    span : float, optional
        The colours run from 1 / span to span. If left out, such that one triangle in a hundred lies beyond.
    exaggeration, window
        As described for this module.

    Raises
    ------
    SettingError
        If there is no such stage, or the span, the exaggeration or the window cannot be.
    """
    number, _ = chosen_stage(restored, stage)
    shown = up_to(restored, number + 1)
    frame = framed(restored.original, [shown.section], exaggeration, window)
    size = WIDTH, max(2.8, 0.66 * WIDTH * frame.shape + 1.0)
    figure, (on_the_left, on_the_right) = plt.subplots(
        1, 2, figsize=size, width_ratios=(2.6, 1), layout="constrained"
    )
    _draw_deformation(on_the_left, on_the_right, shown, interpretation, frame, span)
    frame.put_footnote_below(figure)
    return figure


def workflow(
    restored: Restoration,
    interpretation: Interpretation | None = None,
    stage: int = -1,
    *,
    clip: float = 99.0,
    cmap: str = "gray",
    span: float | None = None,
    exaggeration: float | None = None,
    window: Window | None = None,
) -> Figure:
    """The whole of a restoration, as the paper's fig. 6: the section as picked, after each stage, and the deformation.

    All pictures show the same window. The deformation is that of one stage, the last if left out; keywords as for
    ``section`` and ``deformation``.

    Raises
    ------
    SettingError
        If nothing has been restored yet, or a keyword is out of its range.
    """
    number, _ = chosen_stage(restored, stage)
    states = [up_to(restored, count) for count in range(len(restored.stages) + 1)]
    frame = framed(restored.original, [state.section for state in states], exaggeration, window)
    limit = amplitude_limit(restored.original, clip)
    figure, pictures, histogram = _panels(len(states) + 1, frame)
    for ax, state in zip(pictures[:-1], states, strict=True):
        draw_section(ax, state, limit, cmap)
        frame.put_on(ax, state(state))
        draw_picks(ax, state, interpretation, frame)
    _draw_deformation(pictures[-1], histogram, states[number + 1], interpretation, frame, span)
    for letter, ax in zip("abcdefghijklmnopqrstuvwxyz", pictures, strict=False):
        ax.set_title(f"({letter}) {ax.get_title(loc='left')}", loc="left", fontsize="medium")
        ax.label_outer()
    frame.put_footnote_below(figure)
    return figure


def _panels(count, frame):
    """Axes of so many pictures, in two columns, and of a histogram: in the cell that is left over, or below."""
    rows = -(-count // 2)
    low = count % 2 == 0
    heights = [max(1.6, 0.44 * WIDTH * frame.shape)] * rows + [1.5] * low
    figure = plt.figure(figsize=(WIDTH, sum(heights) + 0.35 * rows + 0.9), layout="constrained")
    grid = figure.add_gridspec(len(heights), 2, height_ratios=heights)
    pictures = [figure.add_subplot(grid[number // 2, number % 2]) for number in range(count)]
    return figure, pictures, figure.add_subplot(grid[-1, :] if low else grid[-1, 1])


def _draw_deformation(ax, histogram, restored, interpretation, frame, span):
    """The map of the last stage's area ratio, and the histogram, which stands on the colour bar of both."""
    stage = restored.stages[-1]
    ratio, areas = stage.area_ratio, stage.mesh.areas
    low, median, high = weighted_percentiles(ratio, areas, (1, 50, 99))
    span = _chosen_span(max(high, 1 / low)) if span is None else span
    edges, shares = area_ratio_histogram(ratio, areas, span=span)
    colours = ScalarMappable(LogNorm(1 / span, span), COLOURS)

    x, z = restored.original.from_rock(stage.vertices).T
    look = {"norm": colours.norm, "cmap": colours.cmap, "edgecolors": "face", "linewidth": 0.3}
    ax.tripcolor(x, z, stage.mesh.triangles, facecolors=ratio, **look)
    frame.put_on(ax, f"deformation by {DONE[stage.kind]}")
    draw_picks(ax, restored, interpretation, frame, colours=("black", "black"), named=False)

    middles = np.sqrt(edges[:-1] * edges[1:])
    histogram.bar(edges[:-1], shares, np.diff(edges), align="edge", color=colours.to_rgba(middles), ec="0.5", lw=0.3)
    histogram.set(xscale="log", xlim=edges[[0, -1]], ylabel="share of the area")
    histogram.yaxis.set_major_formatter(PercentFormatter(1))
    histogram.spines[["top", "right"]].set_visible(False)
    histogram.set_title(f"median {median:.3f}\n98% from {low:.3f} to {high:.3f}", loc="left", fontsize=SMALL)
    _draw_colour_bar(histogram, colours, span)


def _chosen_span(farthest):
    return next((span for span in SPANS if span >= farthest), SPANS[-1])


def _draw_colour_bar(histogram, colours, span):
    """The colour bar as the histogram's axis of x."""
    histogram.xaxis.set_major_locator(NullLocator())
    histogram.xaxis.set_minor_locator(NullLocator())
    bar = histogram.figure.colorbar(colours, cax=histogram.inset_axes([0, -0.1, 1, 0.08]), orientation="horizontal")
    bar.ax.xaxis.set_minor_locator(NullLocator())
    bar.ax.xaxis.set_major_locator(FixedLocator([1 / span, 1, span]))
    bar.ax.xaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:.3g}"))
    bar.set_label("initial area / final area")
