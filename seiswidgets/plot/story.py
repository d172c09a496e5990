"""The storyboard: how a section evolved, one panel a step."""

from textwrap import fill

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import to_rgba
from matplotlib.figure import Figure
from matplotlib.patches import Patch

from seiswidgets.geology.layers import WATER, Layers
from seiswidgets.geology.pick_colours import PickColours
from seiswidgets.geology.picks import Interpretation
from seiswidgets.geology.restoration import Restoration
from seiswidgets.geology.scenes import scenes
from seiswidgets.geology.stratigraphy import Stratigraphy
from seiswidgets.geology.validation import checked_kind, whole_number
from seiswidgets.plot.frame import FOOTNOTE, PLAIN_TEXT, PlotFrame, Window, plot_frame
from seiswidgets.plot.panels import amplitude_limit, draw_picks, draw_section, first_stages
from seiswidgets.signatures import strict_keywords

WIDTH = 7.1  # inches: 180 mm, the width of a printed page
FONT = 9.0  # points
POINTS = 72  # in an inch
COLUMNS = 2
TINT = 0.35  # opacity of the layers' colours
TINTED = 60_000  # points of a panel at which the layer is found
LAYER_COLOURS = ("#f5d76e", "#8fd694", "#7fb3d5", "#c39bd3", "#f0a07c", "#b0bec5", "#d7b98e", "#f4a6c0")
LEGEND_COLUMNS = 4
LETTERS = 96  # across the figure


@strict_keywords
def storyboard(
    restored: Restoration,
    interpretation: Interpretation | None = None,
    *,
    stratigraphy: Stratigraphy | None = None,
    columns: int | None = None,
    oldest_first: bool = False,
    colours: PickColours | None = None,
    clip: float = 99.0,
    cmap: str = "gray",
    exaggeration: float | None = None,
    window: Window | None = None,
    figure: Figure | None = None,
) -> Figure:
    """Draw a restoration step by step, from the present day back in time, in panels of the same scale and colours.

    Each panel is the section after a stage, with its picks; stages of the same age, as a sequential restoration makes
    them, share one. The figure is as wide as a printed page, with letters of 9 points and lines that stay sharp.

    Parameters
    ----------
    restored : Restoration
    interpretation : Interpretation, optional
        Picks to draw; by default those that the stages were given.
    stratigraphy : Stratigraphy, optional
        Layers to tint, each in its own colour; their tops must be horizons of the interpretation.
    columns : int, optional
        Number of panels beside each other; 2 if left out, or 1 for a single stage.
    oldest_first : bool
        True to tell the story forwards: from the oldest state to the present day.
    colours, clip, cmap
        As for ``section``; the same in all panels.
    exaggeration, window
        As described for this module.
    figure : Figure, optional
        An empty figure to draw on; its size is set. If left out, pyplot makes one.

    Raises
    ------
    SettingError
        If a keyword is out of its range, or ``restored`` is not a Restoration.
    PickError
        If the interpretation lacks the top of a layer, or tops cross.
    """
    checked_kind(restored, Restoration, "restored")
    picks = restored.interpretation if interpretation is None else interpretation
    shown = scenes(restored.stages)
    steps = [first_stages(restored, scene.count) for scene in shown]
    across = min(COLUMNS, len(shown) - 1 or 1) if columns is None else whole_number("columns", columns, least=1)
    frame = plot_frame(restored.original, [step.section for step in steps], exaggeration, window)
    layers = steps[0].stratified(stratigraphy, picks).layers if stratigraphy is not None else None
    limit = amplitude_limit(restored.original, clip)
    figure = plt.figure() if figure is None else figure
    panels = make_panels(figure, len(steps), across, frame)
    apart = 1.2 * FONT / POINTS / _panel_height(frame, across, WIDTH) * (frame.window[3] - frame.window[2])
    story = list(zip(steps, shown, strict=True))
    for number, (ax, (step, scene)) in enumerate(zip(panels, story[::-1] if oldest_first else story, strict=True), 1):
        draw_section(ax, step, limit, cmap)
        frame.apply_to(ax, "")
        ax.set_title(fill(f"{number}  {scene.label}", LETTERS // across), loc="left", fontsize=FONT, **PLAIN_TEXT)
        label_outer(ax, (number - 1) % across == 0, number > len(panels) - across)
        if layers is not None:
            _tint_layers(ax, step, layers)
        draw_picks(ax, step, picks, frame, colours, FONT, apart)
    if stratigraphy is not None:
        _add_legend(figure, stratigraphy)
    figure.supxlabel(frame.footnote, x=0.01, **{**FOOTNOTE, "fontsize": FONT})
    return figure


def make_panels(figure: Figure, count: int, columns: int, frame: PlotFrame, width: float = WIDTH) -> list[Axes]:
    """Axes in rows of equal size; the figure gets the size that they need."""
    rows = -(-count // columns)
    figure.set(
        size_inches=(width, rows * (_panel_height(frame, columns, width) + 0.36) + 0.75), layout_engine="compressed"
    )
    grid = figure.add_gridspec(rows, columns)
    return [figure.add_subplot(grid[divmod(index, columns)]) for index in range(count)]


def _panel_height(frame: PlotFrame, columns: int, width: float) -> float:
    return (width - 0.8) / columns * frame.height_over_width


def label_outer(ax: Axes, at_left: bool, at_bottom: bool, fontsize: float = FONT) -> None:
    """Leave labels only where no neighbour has them."""
    ax.tick_params(labelsize=fontsize, labelleft=at_left, labelbottom=at_bottom)
    ax.set_xlabel(ax.get_xlabel() if at_bottom else "", fontsize=fontsize)
    ax.set_ylabel(ax.get_ylabel() if at_left else "", fontsize=fontsize)


def _tint_layers(ax: Axes, step: Restoration, layers: Layers) -> None:
    """Lay over the rock the colour of the layer that it is in at the present day."""
    section = step.section
    stride = max(1, int(np.ceil(np.sqrt(section.amplitude.size / TINTED))))
    x, z = section.x[::stride], section.z[::stride]
    origins = step.to_original(np.stack(np.meshgrid(x, z), axis=-1).reshape(-1, 2))
    known = np.isfinite(origins).all(axis=1)
    layer = np.full(len(origins), WATER)
    layer[known] = layers.layer_at(section.to_rock(origins[known]))
    palette = np.array([to_rgba(_layer_colour(index), TINT) for index in range(layers.count)] + [(0, 0, 0, 0)])
    half = stride * section.dx / 2, stride * section.dz / 2
    extent = (x[0] - half[0], x[-1] + half[0], z[-1] + half[1], z[0] - half[1])
    ax.imshow(palette[layer].reshape(len(z), len(x), 4), extent=extent, interpolation="nearest")


def _add_legend(figure: Figure, stratigraphy: Stratigraphy) -> None:
    """Name the layers, young to old, with the ages of their tops."""
    handles = [
        Patch(color=_layer_colour(index), alpha=2 * TINT, label=f"{layer.name}, {layer.age:g} Ma")
        for index, layer in enumerate(stratigraphy.layers)
    ]
    figure.legend(handles=handles, loc="outside lower right", ncols=LEGEND_COLUMNS, fontsize=FONT, frameon=False)


def _layer_colour(index: int) -> str:
    return LAYER_COLOURS[index % len(LAYER_COLOURS)]
