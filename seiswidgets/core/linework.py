"""Lines made fit for meshing: near misses closed, crossings found. What is left between would become slivers."""

import numpy as np
import shapely
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

SNAP = 2.0**-30  # of the outline's width and height; what lies closer becomes one place
MERGED = 1e-3  # of the spacing: places that lie closer to each other, or to a line, become one with it
REACH = 0.1  # of the spacing: a line that ends so close to the outline meets it


def graph(outline, lines, spacing):
    """An outline and the lines inside it as places, and segments between them that meet at places only.

    Parameters
    ----------
    outline : shapely Polygon or MultiPolygon
    lines : list of shapely LineString
    spacing : float
        Of the mesh that this is for.

    Returns
    -------
    vertices : array, shape (n, 2)
    segments : array, shape (k, 2)
    """
    lines = shapely.segmentize(_settled(lines, outline.boundary, spacing), spacing)
    return _merged(*_noded(outline, lines), outline, MERGED * spacing)


def _settled(lines, border, spacing):
    """Lines laid onto the border, and onto the lines before them, wherever they nearly follow or meet those."""
    settled, others = [], border
    for line in lines:
        line = _onto(_reaching(line, border, REACH * spacing), others, MERGED * spacing)
        if line.length > 0:
            settled.append(line)
            others = shapely.union_all([others, line])
    return settled


def _reaching(line, border, reach):
    """A line whose ends are drawn on to a border that they nearly meet."""
    points = shapely.get_coordinates(line)
    for place in (0, -1):
        end = shapely.Point(points[place])
        if 0 < border.distance(end) < reach:
            near = border.interpolate(border.project(end))
            points = np.insert(points, 0 if place == 0 else len(points), near.coords[0], axis=0)
    return shapely.LineString(points)


def _onto(line, others, reach):
    """A line whose points lie on other lines where they are near, and which passes through their points it is near."""
    points = shapely.get_coordinates(line)
    near = shapely.dwithin(shapely.points(points), others, reach)
    if near.any():
        points[near] = shapely.get_coordinates(shapely.shortest_line(others, shapely.points(points[near])))[::2]
        line = shapely.LineString(points)
    corners = shapely.get_coordinates(others)
    corners = corners[shapely.dwithin(shapely.points(corners), line, reach)]
    return shapely.snap(line, shapely.multipoints(corners), reach) if len(corners) else line


def _noded(outline, lines):
    """All lines cut where they cross: places, and segments between them.

    It is done where the outline's bounding box is the unit square: a rectangle's border is then kept exactly.
    """
    low, high = np.reshape(outline.bounds, (2, 2))
    parts = [outline.boundary, *shapely.intersection(lines, outline)]
    unit = shapely.transform(parts, lambda points: (points - low) / (high - low))
    noded = shapely.get_parts(shapely.union_all(unit, grid_size=SNAP))
    places, line = shapely.get_coordinates(noded[shapely.get_type_id(noded) == 1], return_index=True)
    vertices, index = np.unique(places, axis=0, return_inverse=True)
    along = np.flatnonzero((line[1:] == line[:-1]) & (index[1:] != index[:-1]))
    return low + vertices * (high - low), np.column_stack([index[along], index[along + 1]])


def _merged(vertices, segments, outline, reach):
    """A graph whose places lie apart: those closer than the reach become one, on the outline where one of them is."""
    points = shapely.points(vertices)
    pairs = shapely.STRtree(points).query(points, "dwithin", reach)
    if pairs.shape[1] == len(points):  # each is near itself only
        return vertices, segments
    near = coo_array((np.ones(pairs.shape[1], bool), pairs), shape=(len(points),) * 2)
    _, place = connected_components(near, directed=False)
    corners = shapely.multipoints(shapely.get_coordinates(outline))
    order = np.lexsort([shapely.distance(points, corners), np.round(shapely.distance(points, outline.boundary), 9)])
    _, first = np.unique(place[order], return_index=True)
    segments = np.sort(place[segments], axis=1)
    return vertices[order[first]], np.unique(segments[segments[:, 0] != segments[:, 1]], axis=0)
