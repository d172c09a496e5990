"""Figures of fault throw, and of burial, against depth or age."""

import matplotlib.pyplot as plt
from matplotlib.axes import Axes

from seiswidgets.errors import SettingError
from seiswidgets.geology.pick_colours import PickColours
from seiswidgets.geology.tables import Table
from seiswidgets.geology.validation import checked_kind
from seiswidgets.signatures import strict_keywords

AGAINST = ("depth", "age")
LEGEND_SIZE = 9
MARKERS = "os^Dv"  # lines of equal throw lie on each other


@strict_keywords
def throws(table: Table, ax: Axes | None = None, *, against: str = "depth", colours: PickColours | None = None) -> Axes:
    """Draw the throw of each fault against depth or age, downwards.

    Parameters
    ----------
    table : Table
        From `fault_throws`.
    ax : Axes, optional
    against : {"depth", "age"}
    colours : dict, optional
        Colours of faults, as for ``section``.

    Raises
    ------
    SettingError
        If ``against`` is neither, or no horizon has an age.
    """
    checked_kind(table, Table, "table")
    if against not in AGAINST:
        raise SettingError(f"against must be one of {', '.join(AGAINST)}, but is {against!r}")
    rows = [row for row in table if row[against] is not None]
    if len(table) and not rows:
        raise SettingError("no horizon has an age; give fault_throws a stratigraphy that names the horizons")
    ax = ax or plt.subplots(figsize=(4, 4.5), layout="constrained")[1]
    for name in dict.fromkeys(row["fault"] for row in rows):
        own = sorted((row for row in rows if row["fault"] == name), key=lambda row: row[against])
        throw, down = ([row[key] for row in own] for key in ("throw", against))
        marker = MARKERS[len(ax.get_lines()) % len(MARKERS)]
        ax.plot(
            throw, down, marker=marker, markersize=8, alpha=0.8, color=(colours or {}).get(("fault", name)), label=name
        )
        for row in own:
            ax.annotate(row["horizon"], (row["throw"], row[against]), (5, 3), textcoords="offset points", fontsize=8)
    ax.axvline(0, color="0.7", zorder=0)
    ax.margins(x=0.15)
    ax.invert_yaxis()
    ax.set(xlabel=f"Throw ({table.units['throw']})", ylabel=f"{against.capitalize()} ({table.units[against]})")
    if rows:
        ax.legend(fontsize=LEGEND_SIZE)
    return ax


@strict_keywords
def burial(table: Table, ax: Axes | None = None) -> Axes:
    """Draw a history of burial: depth below the top of the rock against age, or scene by scene without ages.

    Parameters
    ----------
    table : Table
        From `burial_history`.
    ax : Axes, optional
    """
    checked_kind(table, Table, "table")
    ax = ax or plt.subplots(figsize=(5, 3.5), layout="constrained")[1]
    rows = [row for row in table if row["burial"] is not None]
    dated = all(row["age"] is not None for row in rows)
    at = [row["age"] for row in rows] if dated else list(range(len(rows)))
    ax.plot(at, [row["burial"] for row in rows], "o-")
    if not dated:
        ax.set_xticks(at, [str(row["scene"]) for row in rows], rotation=30, ha="right")
    ax.invert_yaxis()
    ax.invert_xaxis()
    ax.set(xlabel="Age (Ma)" if dated else "", ylabel=f"Depth of burial ({table.units['burial']})")
    return ax
