"""From an outline and the lines inside it to a mesh. The only module that knows Triangle.

J. R. Shewchuk, Triangle: engineering a 2D quality mesh generator and Delaunay triangulator, 1996.
"""

import numpy as np
import shapely
import triangle
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components
from scipy.spatial import cKDTree

from seiswidgets.core.mesh import Mesh, triangle_areas
from seiswidgets.errors import SettingError

LEAST_ANGLE = 30  # degrees; Triangle is sure to end up to about 33
LARGEST_AREA = 0.7  # of the squared spacing; the mean then comes close to the equilateral triangle's 0.43
SNAP = 2.0**-30  # of the outline's width and height; what lies closer becomes one place
MERGED = 1e-3  # of the spacing: places that lie closer become one
REACH = 0.1  # of the spacing: a line that ends so close to the outline meets it
DENSITY = 1.15  # vertices in a square whose side is the spacing
TOO_MANY = 250_000
TOO_FEW = 30


def triangulate(outline, lines, spacing: float) -> Mesh:
    """A mesh of an outline that has every line, and every crossing of two lines, among its edges.

    Parameters
    ----------
    outline : shapely Polygon or MultiPolygon
        What to fill; holes stay empty.
    lines : list of shapely LineString
        Lines to conform to; parts outside the outline are left out. The mesh is finer near points that lie
        closer together than the spacing.
    spacing : float
        Typical length of an edge where nothing asks for less, in metres.

    Raises
    ------
    SettingError
        If so many vertices would be needed, or so few come out, that the mesh is of no use.
    """
    _check_count(outline, spacing)
    lines = [_reaching(line, outline.boundary, REACH * spacing) for line in lines]
    vertices, segments = _merged(*_graph(outline, shapely.segmentize(lines, spacing)), outline, MERGED * spacing)
    origin = np.array(outline.bounds[:2])
    drawing = {"vertices": (vertices - origin) / spacing, "segments": segments}  # Triangle is at its best near 1
    if holes := _holes(outline):
        drawing["holes"] = (np.array(holes) - origin) / spacing
    result = triangle.triangulate(drawing, f"pq{LEAST_ANGLE}a{LARGEST_AREA}S{TOO_MANY}")
    return _mesh(result, origin, spacing)


def triangulate_to(outline, lines, count: int) -> Mesh:
    """The mesh of an outline and lines that has about a given number of vertices (within a tenth where it can)."""
    spacing = np.sqrt(outline.area * DENSITY / count)
    for _ in range(5):
        mesh = triangulate(outline, lines, spacing)
        if abs(len(mesh.vertices) / count - 1) < 0.1:
            break
        spacing *= np.clip(np.sqrt(len(mesh.vertices) / count), 0.5, 2)
    return mesh


def _check_count(outline, spacing):
    count = int(outline.area * DENSITY / spacing**2)
    if count > TOO_MANY:
        least = 1.01 * np.sqrt(outline.area * DENSITY / TOO_MANY)
        raise SettingError(
            f"a mesh spacing of {spacing:g} m would make about {count:,} vertices; the limit is {TOO_MANY:,}: "
            f"choose at least {least:.4g} m"
        )


def _reaching(line, border, reach):
    """A line whose ends are drawn on to a border that they nearly meet: what is left between would make slivers."""
    points = shapely.get_coordinates(line)
    for place in (0, -1):
        end = shapely.Point(points[place])
        if 0 < border.distance(end) < reach:
            near = border.interpolate(border.project(end))
            points = np.insert(points, 0 if place == 0 else len(points), near.coords[0], axis=0)
    return shapely.LineString(points)


def _graph(outline, lines):
    """All lines noded together: places, and segments between them.

    Noding is done where the outline's bounding box is the unit square: a rectangle's border is then kept exactly.
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
    pairs = cKDTree(vertices).query_pairs(reach, output_type="ndarray")
    if not len(pairs):
        return vertices, segments
    graph = coo_array((np.ones(len(pairs), bool), pairs.T), shape=(len(vertices),) * 2)
    _, place = connected_components(graph, directed=False)
    corners = shapely.multipoints(shapely.get_coordinates(outline))
    points = shapely.points(vertices)
    order = np.lexsort([shapely.distance(points, corners), np.round(shapely.distance(points, outline.boundary), 9)])
    _, first = np.unique(place[order], return_index=True)
    segments = np.sort(place[segments], axis=1)
    return vertices[order[first]], np.unique(segments[segments[:, 0] != segments[:, 1]], axis=0)


def _holes(outline):
    rings = [ring for part in shapely.get_parts(outline) for ring in part.interiors]
    return [shapely.Polygon(ring).representative_point().coords[0] for ring in rings]


def _mesh(result, origin, spacing):
    triangles = result.get("triangles", np.empty((0, 3), int))
    if len(result["vertices"]) >= TOO_MANY:
        _raise_crowded(result["vertices"][triangles] * spacing + origin)
    used, renumbered = np.unique(triangles, return_inverse=True)
    if len(used) < TOO_FEW:
        raise SettingError(
            f"a mesh spacing of {spacing:g} m makes only {len(used)} vertices; at least {TOO_FEW} are needed: choose less"
        )
    vertices = result["vertices"][used] * spacing + origin
    triangles = renumbered.reshape(-1, 3)
    inverted = triangle_areas(vertices, triangles) < 0
    triangles[inverted] = triangles[inverted, ::-1]
    return Mesh(vertices, triangles)


def _raise_crowded(corners):
    sides = np.hypot(*np.moveaxis(corners - np.roll(corners, 1, axis=1), -1, 0))
    triangle, corner = np.unravel_index(np.argmin(sides), sides.shape)
    x, z = corners[triangle, corner]
    raise SettingError(
        f"two lines lie so close together near x={x:.6g} m, z={z:.6g} m (of rock), or meet at so small an angle, that "
        f"the mesh would need more than {TOO_MANY:,} vertices, the limit; part them, or leave one of them out"
    )


def edges_along(mesh: Mesh, line, spacing: float) -> np.ndarray:
    """The mesh's edges that lie on a line which it was made to conform to, in order and direction of the line.

    Parameters
    ----------
    mesh : Mesh
    line : shapely LineString
    spacing : float
        Of the mesh.

    Returns
    -------
    array, shape (k, 2)
        Pairs of vertices.
    """
    tolerance = 2 * MERGED * spacing
    shapely.prepare(line)
    near = shapely.dwithin(line, shapely.points(mesh.vertices), tolerance)
    edges = mesh.edges[near[mesh.edges].all(axis=1)]
    middle = shapely.points(mesh.vertices[edges].mean(axis=1))
    on_line = shapely.dwithin(line, middle, tolerance)
    edges, middle = edges[on_line], middle[on_line]
    edges = edges[np.argsort(shapely.line_locate_point(line, middle))]
    along = shapely.line_locate_point(line, shapely.points(mesh.vertices[edges]))
    return np.take_along_axis(edges, np.argsort(along, axis=1), axis=1)
