"""Preparation of lines for meshing: near misses closed, crossings found. Gaps left between would become slivers."""

from collections.abc import Sequence

import numpy as np
import shapely
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components
from shapely import LineString, MultiPolygon, Polygon
from shapely.geometry.base import BaseGeometry

SNAP = 2.0**-30  # of the outline's width and height; points that lie closer become one
MERGED = 1e-3  # of the spacing: points that lie closer to each other, or to a line, become one with it
REACH = 0.1  # of the spacing: a line that ends so close to the outline meets it


def planar_graph(
    outline: Polygon | MultiPolygon, lines: Sequence[LineString], spacing: float
) -> tuple[np.ndarray, np.ndarray]:
    """Planar straight-line graph of an outline and the lines inside it: segments meet at vertices only.

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
    lines = shapely.segmentize(_close_near_misses(lines, outline.boundary, spacing), spacing)
    vertices, segments = _node(outline, lines)
    return _merge_vertices(vertices, segments, outline, MERGED * spacing)


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
