"""Whole figures: the deformation by a stage, and a complete restoration."""

from typing import Any

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.colors import LogNorm
from matplotlib.figure import Figure
from matplotlib.ticker import FixedLocator, FuncFormatter, MaxNLocator, NullLocator

from seiswidgets.core.deformation import AREA_RATIO_COLOURS, area_ratio_histogram, colour_span, weighted_percentiles
from seiswidgets.geology.pick_colours import PickColours
from seiswidgets.geology.picks import Interpretation
from seiswidgets.geology.restoration import Restoration
from seiswidgets.geology.scenes import ACTIONS
from seiswidgets.plot.frame import WIDTH, PlotFrame, Window, plot_frame
from seiswidgets.plot.panels import (
    amplitude_limit,
    draw_pick_lines,
    draw_picks,
    draw_section,
    first_stages,
    panel_title,
    select_stage,
)
from seiswidgets.signatures import strict_keywords


@strict_keywords
def deformation(
    restored: Restoration,
    interpretation: Interpretation | None = None,
    stage: int = -1,
    *,
    colours: PickColours | None = None,
    span: float | None = None,
    exaggeration: float | None = None,
    window: Window | None = None,
) -> Figure:
    """Draw the deformation by a stage: a map of the area ratio and its histogram (the paper's fig. 6d).

    Parameters
    ----------
    restored : Restoration
    interpretation : Interpretation, optional
    stage : int
        Index of the stage; the last one if left out.
    colours : dict, optional
        Of the picks, as for ``section``.
    span : float, optional
        The colours run from 1 / span to span. If left out, it is chosen such that almost nothing lies beyond.
    exaggeration, window
        As described for this module.

    Raises
    ------
    SettingError
        If there is no such stage, or the span, the exaggeration or the window is invalid.
    """
    index, _ = select_stage(restored, stage)
    shown = first_stages(restored, index + 1)
    frame = plot_frame(restored.original, [shown.section], exaggeration, window)
    size = WIDTH, max(2.8, 0.66 * WIDTH * frame.height_over_width + 1.0)
    figure, (left, right) = plt.subplots(1, 2, figsize=size, width_ratios=(2.6, 1), layout="constrained")
    _draw_deformation(left, right, shown, interpretation, frame, span, colours)
    frame.add_footnote_below(figure)
    return figure


@strict_keywords
def workflow(
    restored: Restoration,
    interpretation: Interpretation | None = None,
    stage: int = -1,
    *,
    colours: PickColours | None = None,
    clip: float = 99.0,
    cmap: str = "gray",
    span: float | None = None,
    exaggeration: float | None = None,
    window: Window | None = None,
    figure: Figure | None = None,
) -> Figure:
    """Draw a whole restoration like the paper's fig. 6: the picked section, each stage's result, and the deformation.

    All panels show the same window. The deformation is that of one stage, the last if left out; other keywords are as
    for ``section`` and ``deformation``.

    Parameters
    ----------
    figure : Figure, optional
        An empty figure to draw on, for example on a thread; its size is set. If left out, pyplot makes one.

    Raises
    ------
    SettingError
        If nothing has been restored yet, or a keyword is out of its range.
    """
    index, _ = select_stage(restored, stage)
    steps = [first_stages(restored, count) for count in range(len(restored.stages) + 1)]
    frame = plot_frame(restored.original, [step.section for step in steps], exaggeration, window)
    limit = amplitude_limit(restored.original, clip)
    figure = plt.figure() if figure is None else figure
    panels, histogram = _make_panels(figure, len(steps) + 1, frame)
    for ax, step in zip(panels[:-1], steps, strict=True):
        draw_section(ax, step, limit, cmap)
        frame.apply_to(ax, panel_title(step))
        draw_picks(ax, step, interpretation, frame, colours)
    _draw_deformation(panels[-1], histogram, steps[index + 1], interpretation, frame, span, colours)
    for letter, ax in zip("abcdefghijklmnopqrstuvwxyz", panels, strict=False):
        ax.set_title(f"({letter}) {ax.get_title(loc='left')}", loc="left", fontsize="medium")
    _keep_outer_labels(panels)
    frame.add_footnote_below(figure)
    return figure


def _make_panels(figure: Figure, count: int, frame: PlotFrame) -> tuple[list[Axes], Axes]:
    """Axes of ``count`` panels in two columns, and of a histogram, in the cell that is left over or below."""
    rows = -(-count // 2)
    below = count % 2 == 0
    heights = [max(1.6, 0.44 * WIDTH * frame.height_over_width)] * rows + [1.4] * below
    figure.set(size_inches=(WIDTH, sum(heights) + 0.3 * rows + 1.2), layout_engine="compressed")
    grid = figure.add_gridspec(len(heights), 2, height_ratios=heights)
    panels = [figure.add_subplot(grid[index // 2, index % 2]) for index in range(count)]
    return panels, figure.add_subplot(grid[-1, :] if below else grid[-1, 1])


def _keep_outer_labels(panels: list[Axes]) -> None:
    """Remove the labels of panels that have the same axis to their left or below them."""
    for index, ax in enumerate(panels):
        if index % 2:
            ax.set_ylabel("")
            ax.tick_params(labelleft=False)
        if index < len(panels) - 2:
            ax.set_xlabel("")
            ax.tick_params(labelbottom=False)


def _draw_deformation(
    ax: Axes,
    histogram: Axes,
    restored: Restoration,
    interpretation: Interpretation | None,
    frame: PlotFrame,
    span: float | None,
    pick_colours: PickColours | None,
) -> None:
    """Draw the map of the last stage's area ratio, and the histogram on the colour bar of both."""
    stage = restored.stages[-1]
    percentiles = weighted_percentiles(stage.area_ratio, stage.mesh.areas, (1, 50, 99))
    span = colour_span(stage.area_ratio, stage.mesh.areas) if span is None else span
    bins, shares = area_ratio_histogram(stage.area_ratio, stage.mesh.areas, span=span)
    colours = ScalarMappable(LogNorm(1 / span, span), AREA_RATIO_COLOURS)
    _draw_map(ax, restored, colours)
    draw_pick_lines(ax, restored, interpretation, pick_colours)
    frame.apply_to(ax, f"deformation by {ACTIONS[stage.kind]}")
    _draw_histogram(histogram, bins, shares, colours)
    _draw_colour_bar(histogram, colours, span)
    low, median, high = (f"{value:.3f}" for value in percentiles)
    histogram.set_title(f"median {median}\n98% of the area from {low} to {high}", loc="left", fontsize=9)


def _draw_map(ax: Axes, restored: Restoration, colours: ScalarMappable) -> None:
    """Draw each triangle after the last stage, in the colour of its area ratio."""
    stage = restored.stages[-1]
    x, z = restored.original.from_rock(stage.vertices).T
    look: dict[str, Any] = {"norm": colours.norm, "cmap": colours.cmap, "edgecolors": "face", "linewidth": 0.3}
    ax.tripcolor(x, z, stage.mesh.triangles, facecolors=stage.area_ratio, **look)


def _draw_histogram(ax: Axes, bins: np.ndarray, shares: np.ndarray, colours: ScalarMappable) -> None:
    """Draw bars for the shares of the area; the colour bar becomes their axis."""
    centres = np.sqrt(bins[:-1] * bins[1:])
    widths = np.diff(bins)
    ax.bar(bins[:-1], shares, widths, align="edge", color=colours.to_rgba(centres), edgecolor="0.5", linewidth=0.3)
    ax.set(xscale="log", xlim=bins[[0, -1]], ylabel="share of the area")
    ax.yaxis.set_major_locator(MaxNLocator(4))
    ax.yaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{100 * value:.3g}%"))
    ax.spines[["top", "right"]].set_visible(False)
    ax.xaxis.set_major_locator(NullLocator())
    ax.xaxis.set_minor_locator(NullLocator())
    for x, text, shade, side in ((0.01, "expansion", 0.1, "left"), (0.99, "compression", 0.9, "right")):
        ax.text(x, 0.97, text, color=colours.cmap(shade), ha=side, va="top", fontsize=9, transform=ax.transAxes)


def _draw_colour_bar(ax: Axes, colours: ScalarMappable, span: float) -> None:
    bar = ax.figure.colorbar(colours, cax=ax.inset_axes((0, -0.1, 1, 0.09)), orientation="horizontal")
    bar.ax.xaxis.set_minor_locator(NullLocator())
    bar.ax.xaxis.set_major_locator(FixedLocator([1 / span, 1, span]))
    bar.ax.xaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:.3g}"))
    bar.set_label("area before / after restoring")
