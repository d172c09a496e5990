"""Extension and burial scene by scene through a restoration, and with ages through time."""

from dataclasses import replace
from itertools import pairwise

import numpy as np
import shapely
from numpy.typing import ArrayLike
from shapely import LineString

from seiswidgets.errors import SettingError
from seiswidgets.geology import validation
from seiswidgets.geology.bed_lines import bed_extent
from seiswidgets.geology.picks import IGNORE, Interpretation
from seiswidgets.geology.restoration import Restoration
from seiswidgets.geology.scenes import scenes
from seiswidgets.geology.tables import Table, Value
from seiswidgets.geology.validation import point_in_section


def extension_history(restored: Restoration, interpretation: Interpretation) -> Table:
    """Mean width of the horizons in each scene, the extension since the scene before in time, and its rate.

    Parameters
    ----------
    restored : Restoration
        The scenes of a sequential restoration have ages; without, there are no rates.
    interpretation : Interpretation
        The horizons that are not ignored, and the faults that they meet.
    """
    shown = scenes(restored.stages)
    widths = [_widths(_at(restored, scene.count), interpretation) for scene in shown]
    rows: list[tuple[Value, ...]] = [(shown[0].title, shown[0].age, _mean(list(widths[0].values())), None, None)]
    for (younger, before), (older, after) in pairwise(zip(shown, widths, strict=True)):
        extension = _mean([before[name] - after[name] for name in before.keys() & after.keys()])
        span = older.age - younger.age if older.age is not None and younger.age is not None else 0.0
        rate = extension / span if extension is not None and span else None
        rows.append((older.title, older.age, _mean(list(after.values())), extension, rate))
    units = {"scene": "", "age": "Ma", "width": "m", "extension since": "m", "extension rate": "m/Ma"}
    return Table("Extension through time", units, tuple(rows))


def _at(restored: Restoration, count: int) -> Restoration:
    return replace(restored, stages=restored.stages[:count])


def _widths(restored: Restoration, interpretation: Interpretation) -> dict[str, float]:
    """Width of each horizon that has not been removed, in metres."""
    used = [horizon for horizon in interpretation.horizons if horizon.use != IGNORE]
    extents = {horizon.name: bed_extent(restored, interpretation.faults, horizon) for horizon in used}
    return {name: extent.restored_width for name, extent in extents.items() if extent}


def _mean(values: list[float]) -> float | None:
    return float(np.mean(values)) if values else None


def burial_history(restored: Restoration, point: ArrayLike) -> Table:
    """Depth of a grain of rock, and its depth of burial below the top of the rock, in each scene.

    Parameters
    ----------
    restored : Restoration
    point : (x, z)
        In the present-day section.

    Raises
    ------
    SettingError, PickError
        If it is not a point of the section.
    """
    points = validation.as_points(point)
    if len(points) != 1:
        raise SettingError(f"the history of burial is that of one point (x, z), but {len(points)} were given")
    position = point_in_section(restored.original, points[0], "the point")[None]
    unit, rows, done = float(restored.original.metres[1]), [], 0
    for scene in scenes(restored.stages):
        for stage in restored.stages[done : scene.count]:
            position = stage.map.forward(position)
        done = scene.count
        if not np.isfinite(position).all():
            rows.append((scene.title, scene.age, None, None))
            continue
        x, z = position[0].tolist()
        burial = z - _top(_at(restored, scene.count), x)
        rows.append((scene.title, scene.age, z / unit, burial / unit))
    z_unit = restored.original.z_unit
    return Table("Burial", {"scene": "", "age": "Ma", "depth": z_unit, "burial": z_unit}, tuple(rows))


def _top(restored: Restoration, x: float) -> float:
    """Depth of the highest rock at a position, in metres."""
    outline = restored.domain.outline
    _, z_min, _, z_max = outline.bounds
    met = LineString([(x, z_min - 1), (x, z_max + 1)]).intersection(outline)
    return float(shapely.bounds(met)[1])
