"""How much the rock of a section was compressed, at places of the original section."""

from collections.abc import Sequence

import numpy as np

from seiswidgets.geology.section import Section
from seiswidgets.geology.stage import Stage


def area_ratio_at(stages: Sequence[Stage], points, only: int | None = None) -> np.ndarray:
    """Initial over final area at points of the rock before the first stage, NaN outside; shape (n,).

    Parameters
    ----------
    stages : list of Stage
    points : array, shape (n, 2)
        In metres of rock.
    only : int, optional
        The stage that counts; all of them if left out.
    """
    ratio = np.ones(len(points))
    for number, stage in enumerate(stages if only is None else stages[: only + 1]):
        triangles = stage.map.source_finder(points)
        points = stage.map.forward(points, triangles)
        if only is None or number == only:
            ratio = ratio * stage.area_ratio[triangles]
    return np.where(np.isfinite(points).all(axis=1), ratio, np.nan)


def even_points(section: Section, count: int) -> np.ndarray:
    """About so many points of a section, at the middles of equal cells that are nearly square in rock; shape (n, 2)."""
    x_min, x_max, z_min, z_max = section.extent
    width, height = np.array([x_max - x_min, z_max - z_min]) * section.metres
    columns = max(1, round(np.sqrt(count * width / height)))
    rows = max(1, round(count / columns))
    x = x_min + (x_max - x_min) * (np.arange(columns) + 0.5) / columns
    z = z_min + (z_max - z_min) * (np.arange(rows) + 0.5) / rows
    return np.stack(np.meshgrid(x, z), axis=-1).reshape(-1, 2)
