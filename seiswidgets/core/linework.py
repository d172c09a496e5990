"""Preparation of lines for meshing: near misses closed, crossings found. Gaps left between would become slivers."""

from collections.abc import Sequence

import numpy as np
import shapely
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components
from shapely import LineString, MultiPolygon, Polygon
from shapely.geometry.base import BaseGeometry
from shapely.ops import substring

SNAP = 2.0**-30  # of the outline's width and height; points that lie closer become one
MERGED = 1e-3  # of the spacing: points that lie closer to each other, or to a line, become one with it
AWAY = 2.0  # times the reach: a stretch whose middle lies farther from the border does not follow it
REPEATED = 0.2  # of the reach of a border: points that lie closer once they are on it become one
STRAIGHT = 1.1  # length of the border between two points of a line that follows it, as a multiple of their distance
REACH = 0.1  # of the spacing: a line that ends so close to the outline meets it


def planar_graph(
    outline: Polygon | MultiPolygon, lines: Sequence[LineString], spacing: float
) -> tuple[np.ndarray, np.ndarray]:
    """Planar straight-line graph of an outline and the lines inside it: segments meet at vertices only.

    It does not depend on the order of the lines or on their directions.

    Parameters
    ----------
    outline : shapely Polygon or MultiPolygon
    lines : list of shapely LineString
    spacing : float
        Spacing of the mesh that will be made.

    Returns
    -------
    vertices : array, shape (n, 2)
    segments : array, shape (k, 2)
    """
    lines = sorted(shapely.normalize(lines), key=longest_first)
    lines = shapely.segmentize(_close_near_misses(lines, outline.boundary, spacing), spacing)
    vertices, segments = _node(outline, lines)
    return _merge_vertices(vertices, segments, outline, MERGED * spacing)


def longest_first(line: LineString) -> tuple:
    """Key that sorts lines by their shape alone, whatever order and direction they were drawn in."""
    return round(-line.length, 6), *shapely.normalize(line).coords


def follow_border(line: LineString, border: LineString, reach: np.ndarray) -> LineString:
    """Lay a line onto the border wherever it lies close to it, so that no sliver is left between the two.

    Parameters
    ----------
    line : LineString
    border : LineString
        A ring.
    reach : array, shape (2,)
        Distance that counts as close, along x and along z.
    """
    points = shapely.get_coordinates(line)
    scaled = shapely.transform(border, lambda xz: xz / reach)
    near = shapely.dwithin(shapely.points(points / reach), scaled, 1.0)
    if not near.any():
        return line
    corners = _corners(border)
    for index in np.flatnonzero(near).tolist():
        to_corners = np.hypot(*((corners - points[index]) / reach).T)
        if np.min(to_corners, initial=np.inf) <= 1:
            points[index] = corners[np.argmin(to_corners)]
    arc_lengths = shapely.line_locate_point(border, shapely.points(points))
    points[near] = shapely.get_coordinates(shapely.line_interpolate_point(border, arc_lengths[near]))
    parts, vertices = [points[:1]], np.hypot(*np.diff(shapely.get_coordinates(border), axis=0).T).cumsum()
    middles = shapely.dwithin(shapely.points((points[1:] + points[:-1]) / 2 / reach), scaled, AWAY)
    for index in range(1, len(points)):
        start, stop = arc_lengths[index - 1 : index + 1].tolist()
        direct, around = abs(stop - start), border.length - abs(stop - start)
        is_along = near[index - 1] and near[index] and middles[index - 1]
        is_along &= min(direct, around) <= STRAIGHT * np.hypot(*(points[index] - points[index - 1]))
        if is_along and (direct > around or np.diff(np.searchsorted(vertices, sorted((start, stop))))[0]):
            parts.append(shapely.get_coordinates(_border_between(border, start, stop))[1:-1])
        parts.append(points[index : index + 1])
    laid = shapely.remove_repeated_points(LineString(np.concatenate(parts)), REPEATED * float(np.min(reach)))
    return laid if laid.length > 0 else line


def _corners(border: LineString) -> np.ndarray:
    """The points where a ring turns by more than 45 degrees."""
    points = shapely.get_coordinates(border)[:-1]
    before, after = points - np.roll(points, 1, axis=0), np.roll(points, -1, axis=0) - points
    cosine = np.sum(before * after, axis=1) / np.maximum(np.hypot(*before.T) * np.hypot(*after.T), np.finfo(float).tiny)
    return points[cosine < np.sqrt(0.5)]


def _border_between(border: LineString, start: float, stop: float) -> LineString:
    """The shorter way along a ring from one arc length to another."""
    if abs(stop - start) <= border.length / 2:
        return substring(border, start, stop)
    around = [substring(border, start, border.length if start > stop else 0.0)]
    around.append(substring(border, 0.0 if start > stop else border.length, stop))
    return LineString(np.concatenate([shapely.get_coordinates(part) for part in around if part.length > 0]))


def _close_near_misses(lines: Sequence[LineString], border: BaseGeometry, spacing: float) -> list[LineString]:
    """Snap lines to the border, and to the lines before them, wherever they nearly follow or meet those."""
    closed, others = [], border
    for line in lines:
        snapped = _snap(_extend_to_border(line, border, REACH * spacing), others, MERGED * spacing)
        if snapped.length > 0:
            closed.append(snapped)
            others = shapely.union_all([others, snapped])
    return closed


def _extend_to_border(line: LineString, border: BaseGeometry, reach: float) -> LineString:
    """Extend the ends of a line to a border that they nearly meet."""
    points = shapely.get_coordinates(line)
    for which in (0, -1):
        end = shapely.Point(points[which])
        if 0 < border.distance(end) < reach:
            near = border.interpolate(border.project(end))
            points = np.insert(points, 0 if which == 0 else len(points), near.coords[0], axis=0)
    return shapely.LineString(points)


def _snap(line: LineString, others: BaseGeometry, reach: float) -> LineString:
    """Move a line's points onto other lines nearby, and the line through their points nearby."""
    points = shapely.get_coordinates(line)
    near = shapely.dwithin(shapely.points(points), others, reach)
    if near.any():
        points[near] = shapely.get_coordinates(shapely.shortest_line(others, shapely.points(points[near])))[::2]
        line = shapely.LineString(points)
    corners = shapely.get_coordinates(others)
    corners = corners[shapely.dwithin(shapely.points(corners), line, reach)]
    return shapely.snap(line, shapely.multipoints(corners), reach) if len(corners) else line


def _node(outline: Polygon | MultiPolygon, lines: Sequence[LineString]) -> tuple[np.ndarray, np.ndarray]:
    """Cut all lines where they cross; return vertices, and segments between them.

    The outline's bounding box is scaled to the unit square, which keeps a rectangle's border exactly.
    """
    low, high = np.reshape(outline.bounds, (2, 2))
    parts = [outline.boundary, *shapely.intersection(lines, outline)]
    unit = shapely.transform(parts, lambda points: (points - low) / (high - low))
    noded = shapely.get_parts(shapely.union_all(unit, grid_size=SNAP))
    points, line = shapely.get_coordinates(noded[shapely.get_type_id(noded) == 1], return_index=True)
    vertices, index = np.unique(points, axis=0, return_inverse=True)
    along = np.flatnonzero((line[1:] == line[:-1]) & (index[1:] != index[:-1]))
    return low + vertices * (high - low), np.column_stack([index[along], index[along + 1]])


def _merge_vertices(
    vertices: np.ndarray, segments: np.ndarray, outline: Polygon | MultiPolygon, reach: float
) -> tuple[np.ndarray, np.ndarray]:
    """Merge vertices closer than ``reach``, into one on the outline where one of them is."""
    points = shapely.points(vertices)
    pairs = shapely.STRtree(points).query(points, "dwithin", reach)
    if pairs.shape[1] == len(points):  # each is near itself only
        return vertices, segments
    near = coo_array((np.ones(pairs.shape[1], bool), pairs), shape=(len(points),) * 2)
    _, cluster = connected_components(near, directed=False)
    corners = shapely.multipoints(shapely.get_coordinates(outline))
    order = np.lexsort([shapely.distance(points, corners), np.round(shapely.distance(points, outline.boundary), 9)])
    _, first = np.unique(cluster[order], return_index=True)
    segments = np.sort(cluster[segments], axis=1)
    return vertices[order[first]], np.unique(segments[segments[:, 0] != segments[:, 1]], axis=0)
