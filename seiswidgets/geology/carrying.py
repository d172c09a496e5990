"""Picks of the original section, carried through the stages of a restoration; in metres of rock."""

from collections.abc import Sequence

import numpy as np
import shapely
from shapely import LineString

from seiswidgets.errors import PickError
from seiswidgets.geology import validation
from seiswidgets.geology.flattening import joined
from seiswidgets.geology.picks import Fault, Horizon
from seiswidgets.geology.section import Section
from seiswidgets.geology.stage import Stage


def carried_fault(original: Section, stages: Sequence[Stage], fault: Fault) -> np.ndarray:
    """The points of a fault after some stages, shape (n, 2)."""
    lines = [LineString(validation.rock_points(original, fault.points, f"fault {fault.name!r}"))]
    for stage in stages:
        lines = [moved for line in lines for moved in stage.carried_fault(line)]
    if not lines:
        raise PickError(f"nothing is left of fault {fault.name!r} after the stages before; it lies outside the rock")
    return np.concatenate([shapely.get_coordinates(line) for line in lines])


def carried_horizon(original: Section, stages: Sequence[Stage], horizon: Horizon) -> list[LineString]:
    """The pieces of a horizon after some stages, joined where they have come to meet."""
    lines = [
        LineString(validation.rock_points(original, piece, f"piece {number} of horizon {horizon.name!r}"))
        for number, piece in enumerate(horizon.pieces, 1)
    ]
    for stage in stages:
        lines = joined(stage.carried_horizon(lines), stage.spacing)
    return lines


def carried_point(original: Section, stages: Sequence[Stage], fixed) -> np.ndarray:
    """The point that is to be held, after some stages, shape (2,)."""
    try:
        point = validation.as_points(fixed).reshape(1, 2)
    except ValueError:
        raise PickError(f"fixed must be one point (x, z), but is {fixed!r}") from None
    point = validation.rock_points(original, point, "fixed")
    for stage in stages:
        point = stage.map.forward(point)
    return point[0]
