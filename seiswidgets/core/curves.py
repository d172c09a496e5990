"""The smooth curve that a drawn line stands for, and meshes whose vertices lie on it."""

from collections.abc import Sequence
from itertools import pairwise

import numpy as np
import shapely
from shapely import LineString

from seiswidgets.core.mesh import Mesh, triangle_areas

CORNER = np.radians(10)  # a larger turn of a drawn line is a corner, unless the next turn is like it
ROUND = np.radians(25)  # a larger turn is always a corner
LOCAL = 2.0  # times the length of the next segment: a longer segment is straight farther away from it
MOST = 64  # pieces of a segment


def smooth_curve(points: np.ndarray, tolerance: float) -> np.ndarray:
    """Draw a smooth curve through the points of a line.

    The line is smooth where it turns by no more than 10 degrees, or by no more than 25 if the turn before or after has
    the same sense and half to twice the size, as in a listric fault drawn with few points. There the curve has the
    tangent of the circle through a point and its neighbours, and between points it is a cubic; so a circle's arc is
    recovered from a few of its points. Other turns are corners, as those of a ramp. Without this the two sides of a
    round fault, which are polygons, would mesh like cogs.

    Parameters
    ----------
    points : array, shape (n, 2)
        Without repeated points.
    tolerance : float
        Largest distance of the result from the curve.

    Returns
    -------
    array, shape (k, 2)
        With the points among them.
    """
    points = _with_straight_parts(points)
    arms = np.diff(points, axis=0)
    lengths, angles = np.hypot(*arms.T), np.unwrap(np.arctan2(arms[:, 1], arms[:, 0]))
    slopes = np.tan(_deviations(lengths, np.diff(angles)))
    counts = np.ceil(np.sqrt(lengths * np.abs(slopes).max(axis=1) / (4 * tolerance)))
    curve = [points[:1]]
    for index, count in enumerate(np.clip(counts, 1, MOST).astype(int).tolist()):
        s = np.arange(1, count)[:, None] / count
        bulge = slopes[index, 0] * s * (1 - s) ** 2 - slopes[index, 1] * s**2 * (1 - s)
        inner = points[index] + s * arms[index] + bulge * (arms[index, ::-1] * [-1, 1])
        curve += [inner, points[index + 1 : index + 2]]
    return np.concatenate(curve)


def _with_straight_parts(points: np.ndarray) -> np.ndarray:
    """Insert a point into each segment that is much longer than the next one: it bends only near their common point."""
    lengths = np.hypot(*np.diff(points, axis=0).T)
    parts = [points[:1]]
    for index, length in enumerate(lengths):
        shares = [LOCAL * lengths[index - 1] / length] if index > 0 else []
        shares += [1 - LOCAL * lengths[index + 1] / length] if index + 1 < len(lengths) else []
        fit = 0 < shares[0] <= shares[-1] < 1 if shares else False
        inner = np.array(shares if fit else [])
        parts += [points[index] + inner[:, None] * (points[index + 1] - points[index]), points[index + 1 : index + 2]]
    return np.concatenate(parts)


def _deviations(lengths: np.ndarray, turns: np.ndarray) -> np.ndarray:
    """Angles between each segment and the curve's tangents at its two ends, shape (n, 2)."""
    share = lengths[:-1] / (lengths[:-1] + lengths[1:])
    smooth = _are_smooth(turns)
    known = np.full((len(lengths), 2), np.nan)
    known[:-1, 1] = np.where(smooth, share * turns, np.nan)
    known[1:, 0] = np.where(smooth, (share - 1) * turns, np.nan)
    known = np.where(np.isnan(known), -known[:, ::-1], known)  # at an end or a corner: as a circle would go on
    return np.nan_to_num(known)


def _are_smooth(turns: np.ndarray) -> np.ndarray:
    """True for turns that sample a smooth curve, False for corners."""
    one, other = turns[:-1], turns[1:]
    alike = (one * other > 0) & (np.abs(one) <= 2 * np.abs(other)) & (np.abs(other) <= 2 * np.abs(one))
    in_series = np.append(alike, False) | np.append(False, alike)
    return np.asarray(np.abs(turns) <= np.where(in_series[: len(turns)], ROUND, CORNER))


def along_curve(curve: LineString, anchors: Sequence[float], step: float) -> LineString:
    """Points of a curve no more than a step apart, among them those at some arc lengths, in order."""
    ends = np.unique(np.clip([0.0, *anchors, curve.length], 0, curve.length))
    counts = np.maximum(np.ceil(np.diff(ends) / step - 1e-9), 1).astype(int)
    stretches = zip(pairwise(ends), counts, strict=True)
    parts = [np.linspace(start, stop, count, endpoint=False) for (start, stop), count in stretches]
    arc_lengths = np.append(np.concatenate(parts), curve.length)
    return LineString(shapely.line_interpolate_point(curve, arc_lengths).tolist())


def move_onto(mesh: Mesh, edges: np.ndarray, curve: LineString) -> Mesh:
    """Move the vertices of edges along a curve's chords onto the curve, except where a triangle would turn over."""
    moving = np.setdiff1d(edges, mesh.boundary)
    arc_lengths = shapely.line_locate_point(curve, shapely.points(mesh.vertices[moving]))
    vertices = mesh.vertices.copy()
    vertices[moving] = shapely.get_coordinates(shapely.line_interpolate_point(curve, arc_lengths))
    if np.abs(vertices - mesh.vertices).max() == 0:
        return mesh
    squashed = np.unique(mesh.triangles[triangle_areas(vertices, mesh.triangles) < 0.1 * mesh.areas])
    vertices[squashed] = mesh.vertices[squashed]
    return Mesh(vertices, mesh.triangles)
