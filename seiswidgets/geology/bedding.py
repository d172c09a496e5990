"""Rock whose beds slip past each other, in directions interpolated between horizons."""

from collections.abc import Sequence

import numpy as np
import shapely
from shapely import LineString

from seiswidgets.core.bedding import AreaChange, BedStretch
from seiswidgets.core.mesh import Mesh
from seiswidgets.core.term import Term
from seiswidgets.geology.weights import Weights


def bedding_terms(mesh: Mesh, lines: Sequence[LineString], spacing: float, weights: Weights) -> list[Term]:
    """The terms that let beds slip past each other."""
    if not weights.bedding:
        return []
    centres = mesh.vertices[mesh.triangles].mean(axis=1)
    directions = bed_directions(centres, lines, spacing)
    return [BedStretch(mesh, directions, weights.bedding), AreaChange(mesh, weights.bedding)]


def bed_directions(points: np.ndarray, lines: Sequence[LineString], spacing: float) -> np.ndarray:
    """Unit vectors along the beds, interpolated between horizons by the inverse squared distance; shape (n, 2).

    Where a bed is parallel to a horizon, its direction is that of the nearest point of the horizon.
    """
    square = np.zeros(len(points), complex)  # of a direction as a complex number: opposite directions are the same
    for line in lines:
        nearest = shapely.line_locate_point(line, shapely.points(points))
        ends = np.clip([nearest - spacing / 2, nearest + spacing / 2], 0, line.length)
        start, stop = (shapely.get_coordinates(shapely.line_interpolate_point(line, end)) for end in ends)
        arm = (stop - start) @ [1, 1j]
        near = shapely.distance(line, shapely.points(points)) + 0.1 * spacing
        square += (arm / np.maximum(np.abs(arm), np.finfo(float).tiny)) ** 2 / near**2
    direction = np.sqrt(square / np.maximum(np.abs(square), np.finfo(float).tiny))
    return np.column_stack([direction.real, direction.imag])
