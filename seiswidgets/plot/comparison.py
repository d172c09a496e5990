"""Figures of interpretations beside the truth: one student's picks, and those of a whole class."""

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from seiswidgets.geology.comparison import compare_picks
from seiswidgets.geology.pick_colours import pick_colours
from seiswidgets.geology.picks import HORIZON, Fault, Horizon, Interpretation
from seiswidgets.geology.pooling import PooledPicks
from seiswidgets.geology.section import Section
from seiswidgets.plot.frame import PLAIN_TEXT, WIDTH, Window, plot_frame
from seiswidgets.plot.panels import HALO, KIND_OF
from seiswidgets.plot.panels import section as draw_section
from seiswidgets.signatures import strict_keywords

TRUTH = "#ffffff"
LEGEND_SIZE = 9


@strict_keywords
def comparison(
    section: Section,
    picks: Interpretation,
    truth: Interpretation,
    ax: Axes | None = None,
    *,
    exaggeration: float | None = None,
    window: Window | None = None,
) -> Axes:
    """Draw picks and, dashed in white, the truth; the legend gives the distance of each pick from it.

    Parameters
    ----------
    section : Section
    picks, truth : Interpretation
    ax : Axes, optional
    exaggeration, window
        As described for this module.
    """
    ax = draw_section(section, picks, ax, exaggeration=exaggeration, window=window)
    colours = pick_colours(picks)
    for line in compare_picks(section, picks, truth).lines:
        text = "not picked" if line.pick is None else f"{line.error:.0f} m off"
        colour = "none" if line.pick is None else colours[line.kind, line.pick]
        ax.plot([], [], color=colour, linewidth=2, label=f"{line.name}: {text}")
    for pick in _all(truth):
        for piece in _lines(pick):
            ax.plot(*piece.T, "--", color=TRUTH, linewidth=1.4, path_effects=HALO)
    ax.plot([], [], "--", color="0.4", label="truth")
    legend = ax.legend(fontsize=LEGEND_SIZE, loc="upper left", bbox_to_anchor=(1.01, 1), borderaxespad=0)
    for label in legend.get_texts():
        label.set_parse_math(False)
    return ax


@strict_keywords
def pooled(
    section: Section,
    pool: PooledPicks,
    *,
    exaggeration: float | None = None,
    window: Window | None = None,
    figure: Figure | None = None,
) -> Figure:
    """Draw a class's interpretations of one section, and how far their throws differ.

    Left: every pick, the band that holds the middle 80% of each horizon, and the reference, dashed. Right: every throw
    as a dot, the middle 80% as a bar, and the reference as a cross.

    Parameters
    ----------
    section : Section
    pool : PooledPicks
        From `pool_picks`.
    exaggeration, window
        As described for this module.
    figure : Figure, optional
        An empty figure to draw on; if left out, pyplot makes one.
    """
    frame = plot_frame(section, [section], exaggeration, window)
    height = max(3.2, 0.62 * WIDTH * frame.height_over_width + 1.2)
    figure = plt.figure() if figure is None else figure
    figure.set(size_inches=(WIDTH, height), layout_engine="constrained")
    left, right = figure.subplots(1, 2, width_ratios=(2.4, 1))
    draw_section(section, ax=left, exaggeration=frame.exaggeration, window=frame.window)
    colours = pick_colours(pool.reference)
    for picks, found in zip(pool.interpretations, pool.comparisons, strict=True):
        partners = {(line.kind, line.pick): (line.kind, line.name) for line in found.lines}
        for pick in _all(picks):
            colour = colours.get(partners.get((KIND_OF[type(pick)], pick.name), ("", "")), "0.7")
            for piece in _lines(pick):
                left.plot(*piece.T, color=colour, linewidth=0.6, alpha=0.5)
    for horizon in pool.reference.horizons:
        low, _, high = pool.depth_percentiles(horizon.name)
        left.fill_between(pool.x, low, high, color=colours[HORIZON, horizon.name], alpha=0.4, linewidth=0)
    for pick in _all(pool.reference):
        for piece in _lines(pick):
            left.plot(*piece.T, "--", color=TRUTH, linewidth=1.2, path_effects=HALO)
    left.set_title(f"{len(pool.interpretations)} interpretations", loc="left", fontsize="medium")
    _draw_throws(right, section, pool)
    return figure


def _draw_throws(ax: Axes, section: Section, pool: PooledPicks) -> None:
    """Draw the throws of each horizon at each fault, a row for each."""
    colours, true = pick_colours(pool.reference), pool.comparisons[0].throws
    for row, score in enumerate(true):
        key = score.fault, score.horizon
        throws = pool.throws[key]
        spread = np.linspace(-0.2, 0.2, len(throws))
        ax.plot(throws, row + spread, "o", color=colours[HORIZON, score.horizon], markersize=3, alpha=0.7)
        found = pool.throw_percentiles(*key)
        if found is not None:
            ax.plot(found[[0, 2]], [row, row], color="black", linewidth=2)
        ax.plot(score.true, row, "x", color="black", markersize=8, markeredgewidth=2)
    names = [f"{score.horizon} at {score.fault}" for score in true]
    ax.set(yticks=range(len(names)), ylim=(len(names) - 0.5, -0.5), xlabel=f"throw ({section.z_unit})")
    ax.set_yticklabels(names, **PLAIN_TEXT)
    ax.set_title("dots: throws; bar: middle 80%; cross: reference", loc="left", fontsize=LEGEND_SIZE)


def _all(picks: Interpretation) -> list[Horizon | Fault]:
    return [*picks.horizons, *picks.faults]


def _lines(pick: Horizon | Fault) -> tuple[np.ndarray, ...]:
    return (pick.points,) if isinstance(pick, Fault) else pick.pieces
