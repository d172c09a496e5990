"""Drawings on one Axes: a section, a restored section with picks, and the mesh."""

from dataclasses import replace
from typing import Any

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.patheffects import withStroke

from seiswidgets.errors import SettingError
from seiswidgets.geology.bodies import BODY, Body
from seiswidgets.geology.pick_colours import PickColours, pick_colours
from seiswidgets.geology.picks import FAULT, HORIZON, Fault, Horizon, Interpretation
from seiswidgets.geology.restoration import Restoration
from seiswidgets.geology.scenes import ACTIONS
from seiswidgets.geology.section import Section
from seiswidgets.geology.stage import Stage
from seiswidgets.plot.frame import NO_DATA, PLAIN_TEXT, PlotFrame, Window, edges, plot_frame
from seiswidgets.signatures import strict_keywords

ROOM = 0.08  # of a panel's height, for a name
MESH_COLOUR = "#d81b60"
HALO = [withStroke(linewidth=3.2, foreground="0.15", alpha=0.75)]  # dark: most colours of picks are light
AnyPick = Fault | Horizon | Body
KIND_OF: dict[type, str] = {Fault: FAULT, Horizon: HORIZON, Body: BODY}


@strict_keywords
def section(
    section: Section,
    interpretation: Interpretation | None = None,
    ax: Axes | None = None,
    *,
    colours: PickColours | None = None,
    clip: float = 99.0,
    cmap: str = "gray",
    exaggeration: float | None = None,
    window: Window | None = None,
) -> Axes:
    """Draw a section, z down, with its picks in the colours that they have in the app.

    Parameters
    ----------
    section : Section
    interpretation : Interpretation, optional
    ax : Axes, optional
    colours : dict, optional
        ``{("fault", "F1"): "#e69f00", ...}``; `RestorationApp.colours` has those chosen there. Without a colour of its
        own, a pick gets the one that the app would give it.
    clip : float
        Percentile of the absolute amplitudes at which the colours end, symmetrically about 0.
    cmap : str
        A matplotlib colour map.
    exaggeration, window
        As described for this module.

    Raises
    ------
    SettingError
        If the clip, the exaggeration or the window is invalid.
    """
    return restoration(
        Restoration(section),
        interpretation,
        ax,
        colours=colours,
        clip=clip,
        cmap=cmap,
        exaggeration=exaggeration,
        window=window,
    )


@strict_keywords
def restoration(
    restored: Restoration,
    interpretation: Interpretation | None = None,
    ax: Axes | None = None,
    *,
    colours: PickColours | None = None,
    clip: float = 99.0,
    cmap: str = "gray",
    exaggeration: float | None = None,
    window: Window | None = None,
) -> Axes:
    """Draw the restored section, with the original's picks restored too; keywords as for ``section``.

    Its grey tones are those of the original, so that both can be compared.
    """
    frame = plot_frame(restored.original, [restored.section], exaggeration, window)
    ax = ax or frame.new_axes()
    draw_section(ax, restored, amplitude_limit(restored.original, clip), cmap)
    frame.apply_to(ax, panel_title(restored))
    draw_picks(ax, restored, interpretation, frame, colours)
    frame.add_footnote(ax)
    return ax


@strict_keywords
def mesh(
    restored: Restoration,
    stage: int = -1,
    when: str = "after",
    ax: Axes | None = None,
    *,
    exaggeration: float | None = None,
    window: Window | None = None,
) -> Axes:
    """Draw the mesh of a stage on the section, before or after that stage; keywords as for ``section``.

    Raises
    ------
    SettingError
        If there is no such stage, or ``when`` is neither "before" nor "after".
    """
    if when not in ("before", "after"):
        raise SettingError(f'when must be "before" or "after", but is {when!r}')
    index, drawn = select_stage(restored, stage)
    shown = first_stages(restored, index + (when == "after"))
    ax = restoration(shown, None, ax, exaggeration=exaggeration, window=window)
    vertices = restored.original.from_rock(drawn.vertices if when == "after" else drawn.mesh.vertices)
    ax.triplot(*vertices.T, drawn.mesh.triangles, color=MESH_COLOUR, linewidth=0.45, alpha=0.9)
    ax.set_title(f"mesh {when} {ACTIONS[drawn.kind]}", loc="left", fontsize="medium")
    return ax


def select_stage(restored: Restoration, stage: int) -> tuple[int, Stage]:
    """Index of a stage, counted from 0, and the stage itself."""
    count = len(restored.stages)
    if not count:
        raise SettingError("nothing has been restored yet; draw this after unfault or flatten")
    if not -count <= stage < count:
        raise SettingError(f"there is no stage {stage}; there are {count}, counted from 0")
    return stage % count, restored.stages[stage]


def first_stages(restored: Restoration, count: int) -> Restoration:
    """The restoration after its first ``count`` stages."""
    return restored if count == len(restored.stages) else replace(restored, stages=restored.stages[:count])


def panel_title(restored: Restoration) -> str:
    """Title of a restored section: its last stage, or the name of the section if there is none."""
    if not restored.stages:
        return restored.original.name or "section"
    report = restored.stages[-1].report
    flattened = [bed.horizon for bed in report.beds if bed.flatness is not None]
    return " ".join(["after", ACTIONS[report.kind], *flattened])


def amplitude_limit(section: Section, clip: float) -> float:
    """The amplitude at which the colours end: a percentile of the absolute amplitudes."""
    if not 0 < clip <= 100:
        raise SettingError(f"clip must be a percentile, above 0 and at most 100, but is {clip:g}")
    return float(np.nanpercentile(np.abs(section.amplitude), clip)) or 1.0


def draw_section(ax: Axes, restored: Restoration, limit: float, cmap: str) -> None:
    """Draw the restored section, with colours symmetrical about 0."""
    x_min, x_max, z_min, z_max = edges(restored.section)
    colours = mpl.colormaps[cmap].with_extremes(bad=NO_DATA)
    extent = (x_min, x_max, z_max, z_min)
    ax.imshow(restored.section.amplitude, cmap=colours, vmin=-limit, vmax=limit, extent=extent)


def draw_picks(
    ax: Axes,
    restored: Restoration,
    interpretation: Interpretation | None,
    frame: PlotFrame,
    colours: PickColours | None = None,
    fontsize: float = 9,
    apart: float = 0.0,
) -> None:
    """Draw the original's picks after restoration, each with its name.

    A horizon's name stands at its right end if another one is less than ``apart`` (in z) from it at the left, and is
    left out if there is none there either.
    """
    picks = draw_pick_lines(ax, restored, interpretation, colours)
    taken: list[tuple[str, float]] = []
    for pick, lines, colour in picks:
        points = frame.visible(np.concatenate([np.empty((0, 2)), *lines]))
        if not len(points):
            continue
        if isinstance(pick, Fault):
            placement = _below_or_beside(points, frame)
        else:
            places = [(one, _name_at(one, apart)) for one in _beside_ends(points, frame)]
            free = [place for place in places if _is_free(place[1], taken, apart)]
            if not free:
                continue
            placement, at = free[0]
            taken.append(at)
        look: dict[str, Any] = {"color": colour, "path_effects": HALO, "fontsize": fontsize, "fontweight": "bold"}
        ax.annotate(pick.name, textcoords="offset points", **placement, **look, **PLAIN_TEXT)


def _name_at(placement: dict[str, Any], height: float) -> tuple[str, float]:
    """Side at which a name stands, and z of its middle."""
    return placement["ha"], placement["xy"][1] + (height / 2 if placement["va"] == "top" else -height / 2)


def _is_free(at: tuple[str, float], taken: list[tuple[str, float]], apart: float) -> bool:
    return all(side != at[0] or abs(at[1] - z) >= apart for side, z in taken)


def draw_pick_lines(
    ax: Axes, restored: Restoration, interpretation: Interpretation | None, colours: PickColours | None
) -> list[tuple[AnyPick, list[np.ndarray], str]]:
    """Draw the original's picks after restoration, and return each with its lines and its colour."""
    by_name = pick_colours(interpretation or Interpretation(), colours)
    picks = [
        (pick, lines, by_name[KIND_OF[type(pick)], pick.name])
        for pick, lines in restored_picks(restored, interpretation)
    ]
    for _, lines, colour in picks:
        for line in lines:
            ax.plot(*line.T, color=colour, linewidth=1.6, solid_capstyle="round", path_effects=HALO)
    return picks


def restored_picks(
    restored: Restoration, interpretation: Interpretation | None
) -> list[tuple[AnyPick, list[np.ndarray]]]:
    """Each pick and its lines after restoration, faults last so that they are drawn on top."""
    picks: list[AnyPick] = []
    if interpretation is not None:
        picks = [*interpretation.bodies, *interpretation.horizons, *interpretation.faults]
    return [(pick, restored.carried(pick) if restored.stages else _lines_as_drawn(pick)) for pick in picks]


def _lines_as_drawn(pick: AnyPick) -> list[np.ndarray]:
    """Lines of a pick, even if they lie outside the section: a figure is where such a mistake is seen."""
    if isinstance(pick, Body):
        return [np.vstack([pick.points, pick.points[:1]])]
    return [pick.points] if isinstance(pick, Fault) else list(pick.pieces)


def _below_or_beside(points: np.ndarray, frame: PlotFrame) -> dict[str, Any]:
    """Placement of a fault's name: below or above it if there is room, otherwise beside its top, in the footwall.

    This keeps the names of faults that dip towards each other apart, and away from those of horizons.
    """
    x_min, x_max, z_min, z_max = frame.window
    top, bottom = points[np.argmin(points[:, 1])], points[np.argmax(points[:, 1])]
    room, margin = ROOM * (z_max - z_min), 0.05 * (x_max - x_min)
    if bottom[1] < z_max - room:
        return {"xy": bottom, "xytext": (0, -3), "ha": "center", "va": "top"}
    if top[1] > z_min + 2 * room:
        return {"xy": top, "xytext": (0, 3), "ha": "center", "va": "bottom"}
    left = bottom[0] >= top[0] if x_min + margin < top[0] < x_max - margin else top[0] > x_max - margin
    return {"xy": top, "xytext": (-5 if left else 5, -2), "ha": "right" if left else "left", "va": "top"}


def _beside_ends(points: np.ndarray, frame: PlotFrame) -> list[dict[str, Any]]:
    """Placements of a horizon's name: above its first point, and above its last; below it if there is no room."""
    first, last = points[np.argmin(points[:, 0])], points[np.argmax(points[:, 0])]
    _, _, z_min, z_max = frame.window
    up, down = {"va": "bottom"}, {"va": "top"}
    return [
        {"xy": end, "xytext": (inwards, 4 if has_room else -4), "ha": side, **(up if has_room else down)}
        for end, inwards, side in ((first, 3, "left"), (last, -3, "right"))
        for has_room in (end[1] - z_min > ROOM * (z_max - z_min),)
    ]
