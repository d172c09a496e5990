"""The next thing to draw, while the picks do not suffice for a restoration yet."""

from shapely import LineString
from shapely.ops import nearest_points

from seiswidgets.geology.picks import Fault, Horizon, Interpretation
from seiswidgets.geology.section import Section

DRAW_FAULT = (
    "Draw a fault: choose Fault, click along it, double click to finish. Then draw a horizon on both sides of it."
)
DRAW_HORIZON = "Now choose Horizon and draw one on both sides of {}; a double click finishes each piece."
DRAW_PIECE = "Now draw {} {} of {}: choose Horizon, click along it, double click to finish."
OTHER_SIDE = {"left": "right", "right": "left"}


def next_step(interpretation: Interpretation, section: Section) -> str:
    """The next thing to draw, such as "Now draw H1 right of F1"; "" if each fault has a horizon on both sides."""
    faults = [fault for fault in interpretation.faults if fault.constrains]
    horizons = [horizon for horizon in interpretation.horizons if horizon.constrains]
    if not faults:
        return "" if horizons else DRAW_FAULT
    if not horizons:
        return DRAW_HORIZON.format(faults[-1].name)
    return next(filter(None, (_step_at(fault, horizons, section) for fault in faults)), "")


def _step_at(fault: Fault, horizons: list[Horizon], section: Section) -> str:
    """The next thing to draw at a fault; "" if a horizon lies on both its sides."""
    sides = {horizon.name: _sides(fault, horizon, section) for horizon in horizons}
    if any(len(found) > 1 for found in sides.values()):
        return ""
    (side,) = sides[horizons[-1].name]
    return DRAW_PIECE.format(horizons[-1].name, OTHER_SIDE[side], fault.name)


def _sides(fault: Fault, horizon: Horizon, section: Section) -> set[str]:
    """Sides of a fault, left and right, on which a horizon has a piece."""
    line, sides = LineString(section.to_rock(fault.points)), set()
    for points in horizon.pieces:
        piece = LineString(section.to_rock(points))
        if piece.crosses(line):
            return set(OTHER_SIDE)
        nearest, _ = nearest_points(line, piece)
        sides.add("left" if piece.centroid.x < nearest.x else "right")
    return sides
