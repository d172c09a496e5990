"""Figures that show hypotheses beside each other: small multiples, and the difference of two."""

from textwrap import fill, shorten

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.figure import Figure

from seiswidgets.errors import SettingError
from seiswidgets.geology.outcomes import Comparison, Outcome, heading, shown
from seiswidgets.geology.pick_colours import PickColours
from seiswidgets.geology.restoration import Restoration
from seiswidgets.geology.section import Section
from seiswidgets.geology.validation import checked_kind, whole_number
from seiswidgets.plot.frame import NO_DATA, PLAIN_TEXT, WIDTH, Window, edges, plot_frame
from seiswidgets.plot.panels import amplitude_limit, draw_picks, draw_section
from seiswidgets.plot.story import label_outer, make_panels
from seiswidgets.signatures import strict_keywords

FONT = 9.0  # points
NUMBERS = 3  # of an outcome, in the title of its panel


@strict_keywords
def hypotheses(
    comparison: Comparison,
    *,
    columns: int = 2,
    colours: PickColours | None = None,
    clip: float = 99.0,
    cmap: str = "gray",
    exaggeration: float | None = None,
    window: Window | None = None,
    figure: Figure | None = None,
) -> Figure:
    """Draw the restored section of each hypothesis, in panels of one scale, each with its name and its first numbers.

    Parameters
    ----------
    comparison : Comparison
        By `compare`; sort it to sort the panels.
    columns : int
        Number of panels beside each other.
    colours, clip, cmap
        As for ``section``; the same in all panels.
    exaggeration, window
        As described for this module.
    figure : Figure, optional
        An empty figure to draw on; its size is set. If left out, pyplot makes one.

    Raises
    ------
    SettingError
        If a keyword is out of its range, or there is no comparison.
    """
    checked_kind(comparison, Comparison, "comparison")
    outcomes = comparison.outcomes
    restored = [one.restored or Restoration(one.hypothesis.section) for one in outcomes]
    across = min(whole_number("columns", columns, least=1), len(outcomes))
    frame = plot_frame(restored[0].original, [one.section for one in restored], exaggeration, window)
    figure = plt.figure() if figure is None else figure
    panels = make_panels(figure, len(outcomes), across, frame, WIDTH)
    for index, (ax, one, outcome) in enumerate(zip(panels, restored, outcomes, strict=True)):
        if outcome.restored is not None:
            draw_section(ax, one, amplitude_limit(one.original, clip), cmap)
            draw_picks(ax, one, outcome.hypothesis.interpretation, frame, colours, fontsize=FONT)
        frame.apply_to(ax, "")
        ax.set_title(_title(outcome, 120 // across), loc="left", fontsize=FONT, **PLAIN_TEXT)
        label_outer(ax, index % across == 0, index >= len(panels) - across, FONT)
    frame.add_footnote_below(figure)
    return figure


def _title(outcome: Outcome, width: int) -> str:
    """The name, and the first numbers or the reason why there is no restoration."""
    numbers = ", ".join(f"{heading(name)} {shown(name, value)}" for name, value in [*outcome.values.items()][:NUMBERS])
    return f"{outcome.name}\n{fill(shorten(outcome.problem or numbers, 2 * width), width)}"


@strict_keywords
def difference(
    one: Outcome,
    other: Outcome,
    *,
    colours: PickColours | None = None,
    clip: float = 99.0,
    cmap: str = "gray",
    exaggeration: float | None = None,
    window: Window | None = None,
    figure: Figure | None = None,
) -> Figure:
    """Draw two hypotheses after restoration, and the difference of their amplitudes, on one colour scale.

    Parameters
    ----------
    one, other : Outcome
        Of `compare`, on one section.
    colours, clip, cmap, exaggeration, window, figure
        As for ``hypotheses``.

    Raises
    ------
    SettingError
        If one of them was refused, or they are on different sections; and as for ``hypotheses``.
    """
    first, second = (_restored(outcome) for outcome in (one, other))
    if first.original.shape != second.original.shape or first.original.extent != second.original.extent:
        raise SettingError(f"{one.name!r} and {other.name!r} are on different sections; compare two of one section")
    frame = plot_frame(first.original, [first.section, second.section], exaggeration, window)
    figure = plt.figure() if figure is None else figure
    panels, limit = make_panels(figure, 3, 1, frame, WIDTH), amplitude_limit(first.original, clip)
    for ax, restored, outcome in zip(panels, (first, second), (one, other), strict=False):
        draw_section(ax, restored, limit, cmap)
        frame.apply_to(ax, outcome.name)
        draw_picks(ax, restored, outcome.hypothesis.interpretation, frame, colours, fontsize=FONT)
    between = section_difference(first.section, second.section)
    x_min, x_max, z_min, z_max = edges(between)
    shades = plt.get_cmap(cmap).with_extremes(bad=NO_DATA)
    panels[2].imshow(between.amplitude, cmap=shades, vmin=-limit, vmax=limit, extent=(x_min, x_max, z_max, z_min))
    frame.apply_to(panels[2], f"{one.name} less {other.name}")
    for index, ax in enumerate(panels):
        label_outer(ax, True, index == 2, FONT)
    frame.add_footnote_below(figure)
    return figure


def _restored(outcome: Outcome) -> Restoration:
    checked_kind(outcome, Outcome, "what is drawn")
    if outcome.restored is None:
        raise SettingError(f"hypothesis {outcome.name!r} was refused: {outcome.problem}")
    return outcome.restored


def section_difference(one: Section, other: Section) -> Section:
    """The difference of two restored sections of one section, on the samples that they have in common."""
    cell = np.array([one.dx, one.dz])
    origins = np.array([(section.x0, section.z0) for section in (one, other)])
    ends = origins + cell * (np.array([section.shape[::-1] for section in (one, other)]) - 1)
    low, high = origins.max(axis=0), ends.min(axis=0)
    if (high - low < cell).any():
        raise SettingError("the two restored sections have nothing in common")
    parts = []
    for section, origin in zip((one, other), origins, strict=True):
        (column, row), (width, height) = np.rint((low - origin) / cell).astype(int), np.rint((high - low) / cell) + 1
        parts.append(section.amplitude[row : row + int(height), column : column + int(width)])
    return Section(parts[0] - parts[1], one.dx, one.dz, low[0], low[1], one.x_unit, one.z_unit, one.velocity)
