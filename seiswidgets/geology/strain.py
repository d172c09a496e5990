"""How much the rock of a section was compressed, at places of the original section."""

from collections.abc import Sequence

import numpy as np

from seiswidgets.geology.stage import Stage


def area_ratio_at(stages: Sequence[Stage], points) -> np.ndarray:
    """Initial over final area, of all stages together, at points of the rock before the first one; shape (n,).

    Parameters
    ----------
    stages : list of Stage
    points : array, shape (n, 2)
        In metres of rock; those outside have NaN.
    """
    ratio = np.ones(len(points))
    for stage in stages:
        triangles = stage.map.source_finder(points)
        points = stage.map.forward(points, triangles)
        ratio = ratio * stage.area_ratio[triangles]
    return np.where(np.isfinite(points).all(axis=1), ratio, np.nan)
