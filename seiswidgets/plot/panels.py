"""Pictures of one Axes: a section and a restored one, with picks, and the mesh."""

from dataclasses import replace

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.patheffects import withStroke

from seiswidgets.errors import SettingError
from seiswidgets.geology.picks import Fault, Interpretation
from seiswidgets.geology.restoration import Restoration
from seiswidgets.geology.section import Section
from seiswidgets.geology.stage import Stage
from seiswidgets.plot.frame import AS_IT_IS, OUTSIDE, PlotFrame, Window, edges, framed

FAULT, HORIZON, MESH = "#d7191c", "#1565d8", "#e8a400"
DONE = {"unfault": "unfaulting", "flatten": "flattening"}
HALO = [withStroke(linewidth=3, foreground="white", alpha=0.75)]


def section(
    section: Section,
    interpretation: Interpretation | None = None,
    ax: Axes | None = None,
    *,
    clip: float = 99.0,
    cmap: str = "gray",
    exaggeration: float | None = None,
    window: Window | None = None,
) -> Axes:
    """A section, z down, with its faults in red and its horizons in blue.

    Parameters
    ----------
    section : Section
    interpretation : Interpretation, optional
    ax : Axes, optional
    clip : float
        Percentile of the absolute amplitudes at which the colours end, on both sides of 0.
    cmap : str
        A colour map of matplotlib.
    exaggeration, window
        As described for this module.

    Raises
    ------
    SettingError
        If the clip, the exaggeration or the window cannot be.
    """
    return restoration(
        Restoration(section), interpretation, ax, clip=clip, cmap=cmap, exaggeration=exaggeration, window=window
    )


def restoration(
    restored: Restoration,
    interpretation: Interpretation | None = None,
    ax: Axes | None = None,
    *,
    clip: float = 99.0,
    cmap: str = "gray",
    exaggeration: float | None = None,
    window: Window | None = None,
) -> Axes:
    """The restored section, with picks of the original carried along; keywords as for ``section``.

    Its grey tones are those of the original, so that both compare.
    """
    frame = framed(restored.original, [restored.section], exaggeration, window)
    ax = ax or frame.axes()
    draw_section(ax, restored, amplitude_limit(restored.original, clip), cmap)
    frame.put_on(ax, titled(restored))
    draw_picks(ax, restored, interpretation, frame)
    frame.put_footnote(ax)
    return ax


def mesh(
    restored: Restoration,
    stage: int = -1,
    when: str = "after",
    ax: Axes | None = None,
    *,
    exaggeration: float | None = None,
    window: Window | None = None,
) -> Axes:
    """The mesh of a stage on the section, before that stage or after it; keywords as for ``section``.

    Raises
    ------
    SettingError
        If there is no such stage, or ``when`` is neither "before" nor "after".
    """
    if when not in ("before", "after"):
        raise SettingError(f'when must be "before" or "after", but is {when!r}')
    number, made = chosen_stage(restored, stage)
    shown = up_to(restored, number + (when == "after"))
    ax = restoration(shown, None, ax, exaggeration=exaggeration, window=window)
    vertices = restored.original.from_rock(made.vertices if when == "after" else made.mesh.vertices)
    ax.triplot(*vertices.T, made.mesh.triangles, color=MESH, linewidth=0.45, alpha=0.9)
    ax.set_title(f"mesh {when} {DONE[made.kind]}", loc="left", fontsize="medium")
    return ax


def chosen_stage(restored: Restoration, stage: int) -> tuple[int, Stage]:
    """A stage and its number, counted from 0."""
    count = len(restored.stages)
    if not count:
        raise SettingError("nothing has been restored yet; draw this after unfault or flatten")
    if not -count <= stage < count:
        raise SettingError(f"there is no stage {stage}; there are {count}, counted from 0")
    return stage % count, restored.stages[stage]


def up_to(restored: Restoration, count: int) -> Restoration:
    """The restoration after so many of its stages."""
    return restored if count == len(restored.stages) else replace(restored, stages=restored.stages[:count])


def titled(restored: Restoration) -> str:
    """What a picture of a restoration is called."""
    if not restored.stages:
        return restored.original.name or "section"
    report = restored.stages[-1].report
    level = [bed.horizon for bed in report.beds if bed.flatness is not None]
    return " ".join(["after", DONE[report.kind], *level])


def amplitude_limit(section: Section, clip: float) -> float:
    """The amplitude at which the colours end: a percentile of the absolute amplitudes."""
    if not 0 < clip <= 100:
        raise SettingError(f"clip must be a percentile, above 0 and at most 100, but is {clip:g}")
    return float(np.nanpercentile(np.abs(section.amplitude), clip)) or 1.0


def draw_section(ax: Axes, restored: Restoration, limit: float, cmap: str):
    """Draw the restored section, its colours even about 0."""
    x_min, x_max, z_min, z_max = edges(restored.section)
    colours = mpl.colormaps[cmap].with_extremes(bad=OUTSIDE)
    extent = (x_min, x_max, z_max, z_min)
    ax.imshow(restored.section.amplitude, cmap=colours, vmin=-limit, vmax=limit, extent=extent)


def draw_picks(ax: Axes, restored: Restoration, interpretation: Interpretation | None, frame: PlotFrame):
    """Draw the picks of the original as they lie now, each with its name."""
    lines = carried(restored, interpretation)
    for pick, pieces in lines:
        colour = FAULT if isinstance(pick, Fault) else HORIZON
        for piece in pieces:
            ax.plot(*piece.T, color=colour, linewidth=1.6, solid_capstyle="round", path_effects=HALO)
    for pick, pieces in lines:
        points = frame.seen(np.concatenate([np.empty((0, 2)), *pieces]))
        if len(points):
            where = _at_its_end(points, frame) if isinstance(pick, Fault) else _above_its_start(points)
            colour = FAULT if isinstance(pick, Fault) else HORIZON
            look = {"color": colour, "path_effects": HALO, "fontsize": 8.5, "fontweight": "bold", **AS_IT_IS}
            ax.annotate(pick.name, textcoords="offset points", **where, **look)


def carried(restored: Restoration, interpretation: Interpretation | None) -> list[tuple]:
    """Each pick and its lines as they lie now, the faults last so that they are drawn on top."""
    picks = () if interpretation is None else (*interpretation.horizons, *interpretation.faults)
    return [(pick, restored.carried(pick) if restored.stages else _drawn(pick)) for pick in picks]


def _drawn(pick):
    """The lines of a pick, be they on the section or not: a picture is where such a mistake is seen."""
    return [pick.points] if isinstance(pick, Fault) else list(pick.pieces)


def _at_its_end(points, frame):
    """Where a fault's name stands: below it or above it if there is room, else beside its top, in the footwall.

    So names of faults that dip to each other stay apart, and away from those of horizons.
    """
    x_min, x_max, z_min, z_max = frame.window
    top, bottom = points[np.argmin(points[:, 1])], points[np.argmax(points[:, 1])]
    room, margin = 0.08 * (z_max - z_min), 0.05 * (x_max - x_min)
    if bottom[1] < z_max - room:
        return {"xy": bottom, "xytext": (0, -3), "ha": "center", "va": "top"}
    if top[1] > z_min + 2 * room:
        return {"xy": top, "xytext": (0, 3), "ha": "center", "va": "bottom"}
    left = bottom[0] >= top[0] if x_min + margin < top[0] < x_max - margin else top[0] > x_max - margin
    return {"xy": top, "xytext": (-5 if left else 5, -2), "ha": "right" if left else "left", "va": "top"}


def _above_its_start(points):
    """Where a horizon's name stands."""
    return {"xy": points[np.argmin(points[:, 0])], "xytext": (3, 4), "ha": "left", "va": "bottom"}
