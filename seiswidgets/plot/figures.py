"""Whole figures: what a stage has done to the rock, and all of a restoration."""

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.cm import ScalarMappable
from matplotlib.colors import LogNorm
from matplotlib.figure import Figure
from matplotlib.ticker import FixedLocator, FuncFormatter, MaxNLocator, NullLocator

from seiswidgets.core.deformation import AREA_RATIO_COLOURS, area_ratio_histogram, colour_span, weighted_percentiles
from seiswidgets.geology.picks import Interpretation
from seiswidgets.geology.restoration import Restoration
from seiswidgets.plot.frame import WIDTH, Window, framed
from seiswidgets.plot.panels import (
    DONE,
    amplitude_limit,
    carried,
    chosen_stage,
    draw_picks,
    draw_section,
    titled,
    up_to,
)


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
        The colours run from 1 / span to span. If left out, such that hardly any lies beyond.
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
    figure, (on_the_left, on_the_right) = plt.subplots(1, 2, figsize=size, width_ratios=(2.6, 1), layout="constrained")
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
    figure: Figure | None = None,
) -> Figure:
    """The whole of a restoration, as the paper's fig. 6: the section as picked, after each stage, and the deformation.

    All pictures show the same window. The deformation is that of one stage, the last if left out; other keywords as for
    ``section`` and ``deformation``.

    Parameters
    ----------
    figure : Figure, optional
        An empty one to draw on, whose size is set, as for work on a thread; one of pyplot's if left out.

    Raises
    ------
    SettingError
        If nothing has been restored yet, or a keyword is out of its range.
    """
    number, _ = chosen_stage(restored, stage)
    steps = [up_to(restored, count) for count in range(len(restored.stages) + 1)]
    frame = framed(restored.original, [step.section for step in steps], exaggeration, window)
    limit = amplitude_limit(restored.original, clip)
    figure = plt.figure() if figure is None else figure
    pictures, histogram = _panels(figure, len(steps) + 1, frame)
    for ax, step in zip(pictures[:-1], steps, strict=True):
        draw_section(ax, step, limit, cmap)
        frame.put_on(ax, titled(step))
        draw_picks(ax, step, interpretation, frame)
    _draw_deformation(pictures[-1], histogram, steps[number + 1], interpretation, frame, span)
    for letter, ax in zip("abcdefghijklmnopqrstuvwxyz", pictures, strict=False):
        ax.set_title(f"({letter}) {ax.get_title(loc='left')}", loc="left", fontsize="medium")
    _with_outer_labels_only(pictures)
    frame.put_footnote_below(figure)
    return figure


def _panels(figure, count, frame):
    """Axes of so many pictures, in two columns, and of a histogram: in the cell that is left over, or below."""
    rows = -(-count // 2)
    low = count % 2 == 0
    heights = [max(1.6, 0.44 * WIDTH * frame.shape)] * rows + [1.4] * low
    figure.set(size_inches=(WIDTH, sum(heights) + 0.3 * rows + 1.2), layout_engine="compressed")
    grid = figure.add_gridspec(len(heights), 2, height_ratios=heights)
    pictures = [figure.add_subplot(grid[number // 2, number % 2]) for number in range(count)]
    return pictures, figure.add_subplot(grid[-1, :] if low else grid[-1, 1])


def _with_outer_labels_only(pictures):
    """Take off the labels of pictures that have the same axis to their left or below them."""
    for number, ax in enumerate(pictures):
        if number % 2:
            ax.set_ylabel("")
            ax.tick_params(labelleft=False)
        if number < len(pictures) - 2:
            ax.set_xlabel("")
            ax.tick_params(labelbottom=False)


def _draw_deformation(ax, histogram, restored, interpretation, frame, span):
    """The map of the last stage's area ratio, and the histogram, which stands on the colour bar of both."""
    stage = restored.stages[-1]
    percentiles = weighted_percentiles(stage.area_ratio, stage.mesh.areas, (1, 50, 99))
    span = colour_span(stage.area_ratio, stage.mesh.areas) if span is None else span
    bins, shares = area_ratio_histogram(stage.area_ratio, stage.mesh.areas, span=span)
    colours = ScalarMappable(LogNorm(1 / span, span), AREA_RATIO_COLOURS)
    _draw_map(ax, restored, interpretation, colours)
    frame.put_on(ax, f"deformation by {DONE[stage.kind]}")
    _draw_histogram(histogram, bins, shares, colours)
    low, median, high = (f"{value:.3f}" for value in percentiles)
    histogram.set_title(f"median {median}\n98% of the area from {low} to {high}", loc="left", fontsize=8.5)


def _draw_map(ax, restored, interpretation, colours):
    """Each triangle where it lies after the last stage, in the colour of its area ratio."""
    stage = restored.stages[-1]
    x, z = restored.original.from_rock(stage.vertices).T
    look = {"norm": colours.norm, "cmap": colours.cmap, "edgecolors": "face", "linewidth": 0.3}
    ax.tripcolor(x, z, stage.mesh.triangles, facecolors=stage.area_ratio, **look)
    for _, lines in carried(restored, interpretation):
        for line in lines:
            ax.plot(*line.T, color="black", linewidth=0.8)


def _draw_histogram(ax, bins, shares, colours):
    """Bars of the share of the area, which stand on the colour bar as their axis."""
    middles = np.sqrt(bins[:-1] * bins[1:])
    look = {"color": colours.to_rgba(middles), "edgecolor": "0.5", "linewidth": 0.3}
    ax.bar(bins[:-1], shares, np.diff(bins), align="edge", **look)
    ax.set(xscale="log", xlim=bins[[0, -1]], ylabel="share of the area")
    ax.yaxis.set_major_locator(MaxNLocator(4))
    ax.yaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{100 * value:.3g}%"))
    ax.spines[["top", "right"]].set_visible(False)
    ax.xaxis.set_major_locator(NullLocator())
    ax.xaxis.set_minor_locator(NullLocator())
    side = {"transform": ax.transAxes, "va": "top", "fontsize": 8.5}
    ax.text(0.01, 0.97, "dilatation", color=colours.cmap(0.1), ha="left", **side)
    ax.text(0.99, 0.97, "compression", color=colours.cmap(0.9), ha="right", **side)
    _draw_colour_bar(ax, colours)


def _draw_colour_bar(ax, colours):
    bar = ax.figure.colorbar(colours, cax=ax.inset_axes([0, -0.1, 1, 0.09]), orientation="horizontal")
    bar.ax.xaxis.set_minor_locator(NullLocator())
    bar.ax.xaxis.set_major_locator(FixedLocator([colours.norm.vmin, 1, colours.norm.vmax]))
    bar.ax.xaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:.3g}"))
    bar.set_label("initial area / final area")
