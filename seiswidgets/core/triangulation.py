"""From an outline and the lines inside it to a mesh. The only module that knows Triangle.

J. R. Shewchuk, Triangle: engineering a 2D quality mesh generator and Delaunay triangulator, 1996.
"""

import numpy as np
import shapely
import triangle
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components, dijkstra

from seiswidgets.core.linework import MERGED, graph
from seiswidgets.core.mesh import Mesh, edge_keys, triangle_areas
from seiswidgets.errors import SettingError

LEAST_ANGLE = 30  # degrees; Triangle is sure to end up to about 33
LARGEST_AREA = 0.7  # of the squared spacing; the mean then comes close to the equilateral triangle's 0.43
DENSITY = 1.15  # vertices in a square whose side is the spacing
TOO_MANY = 250_000
TOO_FEW = 30
CROWDED = 20  # times the vertices that the area alone would need, and some for small meshes: no more are made
SOME = 5_000


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
    most = min(CROWDED * expected_vertices(outline, spacing) + SOME, TOO_MANY)
    vertices, segments = graph(outline, lines, spacing)
    origin = np.array(outline.bounds[:2])
    drawing = {"vertices": (vertices - origin) / spacing, "segments": segments}  # Triangle is at its best near 1
    result = triangle.triangulate(drawing, f"pq{LEAST_ANGLE}a{LARGEST_AREA}S{most}")
    triangles = result.get("triangles", np.empty((0, 3), int))
    places = result["vertices"] * spacing + origin
    if len(places) >= most:
        _raise_crowded(places[triangles], most)
    return _mesh(places, _inside(triangles, places, outline), spacing)


def triangulate_to(outline, lines, count: int) -> Mesh:
    """The mesh of an outline and lines that has about a given number of vertices (within a tenth where it can)."""
    spacing = np.sqrt(outline.area * DENSITY / count)
    for _ in range(5):
        mesh = triangulate(outline, lines, spacing)
        if abs(len(mesh.vertices) / count - 1) < 0.1:
            break
        spacing *= np.clip(np.sqrt(len(mesh.vertices) / count), 0.5, 2)
    return mesh


def expected_vertices(outline, spacing: float) -> int:
    """How many vertices a mesh needs for the area alone; SettingError if they would be too many."""
    count = int(outline.area * DENSITY / spacing**2)
    if count > TOO_MANY:
        least = 1.01 * np.sqrt(outline.area * DENSITY / TOO_MANY)
        raise SettingError(
            f"a mesh spacing of {spacing:g} m would make about {count:,} vertices; the limit is {TOO_MANY:,}: "
            f"choose at least {least:.4g} m"
        )
    return count


def _inside(triangles, places, outline):
    """The triangles that do not lie in a hole."""
    if not any(len(part.interiors) for part in shapely.get_parts(outline)):
        return triangles
    shapely.prepare(outline)
    return triangles[shapely.contains_xy(outline, places[triangles].mean(axis=1))]


def _mesh(places, triangles, spacing):
    used, renumbered = np.unique(triangles, return_inverse=True)
    if len(used) < TOO_FEW:
        raise SettingError(
            f"a mesh spacing of {spacing:g} m makes only {len(used)} vertices; at least {TOO_FEW} are needed: "
            "choose less"
        )
    triangles = renumbered.reshape(-1, 3)
    inverted = triangle_areas(places[used], triangles) < 0
    triangles[inverted] = triangles[inverted, ::-1]
    return Mesh(places[used], triangles)


def _raise_crowded(corners, most):
    sides = np.hypot(*np.moveaxis(corners - np.roll(corners, 1, axis=1), -1, 0))
    x, z = corners[np.unravel_index(np.argmin(sides), sides.shape)]
    raise SettingError(
        f"two lines lie so close together near x={x:.6g} m, z={z:.6g} m (of rock), or meet at so small an angle, that "
        f"the mesh would need more than {most:,} vertices, the limit here; part them, or leave one of them out"
    )


def edges_along(mesh: Mesh, line, spacing: float, without=None) -> np.ndarray:
    """The mesh's edges that lie on a line which it was made to conform to, in order and direction of the line.

    Points that were merged lie a little beside the line, and short edges of other lines a little beside it too. So of
    all edges close to the line only those on the shortest path from its start to its end are taken.

    Parameters
    ----------
    mesh : Mesh
    line : shapely LineString
        One that does not cross itself.
    spacing : float
        Of the mesh.
    without : array, shape (k, 2), optional
        Edges of other lines, which are never taken.

    Returns
    -------
    array, shape (k, 2)
        Pairs of vertices.
    """
    tolerance = 2 * MERGED * spacing
    edges = _edges_near(mesh, line, tolerance)
    if without is not None:
        edges = edges[~np.isin(edge_keys(edges), edge_keys(without))]
    used, ends = np.unique(edges, return_inverse=True)
    if not len(used):
        return np.empty((0, 2), int)
    ends = ends.reshape(-1, 2)
    points = shapely.points(mesh.vertices[used])
    way, beside = shapely.line_locate_point(line, points), shapely.distance(line, points)
    lengths = np.hypot(*(mesh.vertices[edges[:, 1]] - mesh.vertices[edges[:, 0]]).T)
    near = coo_array((lengths, ends.T), shape=(len(used),) * 2).tocsr()
    paths = []
    for part in _connected(near):
        start, stop = part[np.argmin(way[part] + beside[part])], part[np.argmax(way[part] - beside[part])]
        if way[stop] - way[start] > 2 * tolerance or len(part) == len(used):  # the line, and no stray edge beside it
            paths.append((way[start], _shortest_path(near, start, stop)))
    paths = [used[path] for _, path in sorted(paths, key=lambda found: found[0])]
    return np.concatenate([np.column_stack([path[:-1], path[1:]]) for path in paths] or [np.empty((0, 2), int)])


def _edges_near(mesh, line, tolerance):
    """The edges whose ends and middle lie within the tolerance of a line."""
    shapely.prepare(line)
    low, high = np.reshape(line.bounds, (2, 2)) + [[-tolerance], [tolerance]]
    near = ((mesh.vertices >= low) & (mesh.vertices <= high)).all(axis=1)  # spares most of them the exact question
    near[near] = shapely.dwithin(line, shapely.points(mesh.vertices[near]), tolerance)
    edges = mesh.edges[near[mesh.edges[:, 0]] & near[mesh.edges[:, 1]]]
    return edges[shapely.dwithin(line, shapely.points(mesh.vertices[edges].mean(axis=1)), tolerance)]


def _connected(graph):
    """The vertices of each connected part of a graph."""
    count, label = connected_components(graph, directed=False)
    return [np.flatnonzero(label == number) for number in range(count)]


def _shortest_path(graph, start, stop):
    """The vertices from one to another, both included."""
    _, before = dijkstra(graph, directed=False, indices=start, return_predecessors=True)
    path = [stop]
    while path[-1] != start:
        path.append(before[path[-1]])
    return np.array(path[::-1])
