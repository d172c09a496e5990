"""Triangulation of an outline and the lines inside it, by Triangle or CDT."""

from collections.abc import Sequence

import numpy as np
import shapely
from scipy.sparse import coo_array, csr_array
from scipy.sparse.csgraph import connected_components, dijkstra
from shapely import LineString, MultiPolygon, Polygon

from seiswidgets.core.linework import MERGED, planar_graph
from seiswidgets.core.mesh import Mesh, edge_keys, triangle_areas
from seiswidgets.core.meshers import fill
from seiswidgets.errors import Keyword, SettingError

DENSITY = 1.15  # vertices per squared spacing
TOO_MANY = 250_000
TOO_FEW = 30
CROWDED, EXTRA = 20, 5_000  # at most 20 times the vertices that the area alone needs, and 5,000 for small meshes
COARSER = 1.5  # at most, than a count of vertices asks for, to make up for those that the lines add


class CrowdedError(Exception):
    """Lines so close together that a mesh would need too many vertices; ``point`` lies between them."""

    def __init__(self, point: np.ndarray):
        super().__init__(f"lines too close together near {point}")
        self.point = point


def triangulate(
    outline: Polygon | MultiPolygon, lines: Sequence[LineString], spacing: float, most: int | None = None
) -> Mesh:
    """Triangulate an outline with every line, and every crossing of two lines, among the edges.

    Parameters
    ----------
    outline : shapely Polygon or MultiPolygon
        Region to fill; holes stay empty.
    lines : list of shapely LineString
        Lines to conform to; parts outside the outline are left out. The mesh is finer near points that lie
        closer together than the spacing.
    spacing : float
        Typical length of an edge where no line needs shorter ones, in metres.
    most : int, optional
        Limit for the number of vertices, by default in proportion to those that the area alone needs.

    Raises
    ------
    SettingError
        If the area alone needs too many vertices, or the mesh has too few to be of use.
    CrowdedError
        If lines lie so close together that the mesh would exceed the limit.
    """
    expected = expected_vertices(outline, spacing)
    most = most or min(CROWDED * expected + EXTRA, TOO_MANY)
    vertices, segments = planar_graph(outline, lines, spacing)
    origin = np.array(outline.bounds[:2])
    filled, triangles = fill((vertices - origin) / spacing, segments, most)
    vertices = filled * spacing + origin
    if len(vertices) >= most:
        raise CrowdedError(_shortest_side(vertices[triangles]))
    return _mesh(vertices, _inside(triangles, vertices, outline), spacing)


def triangulate_to(outline: Polygon | MultiPolygon, lines: Sequence[LineString], count: int) -> Mesh:
    """Triangulate an outline and lines with about ``count`` vertices, to within a tenth if the lines allow it.

    CrowdedError if the lines alone need twenty times as many.
    """
    first = spacing = float(np.sqrt(outline.area * DENSITY / count))
    most = CROWDED * count + EXTRA
    for _ in range(5):
        mesh = triangulate(outline, lines, spacing, most)
        wanted = spacing * float(np.clip(np.sqrt(len(mesh.vertices) / count), 0.5, 2))
        wanted = min(wanted, COARSER * first)
        if abs(len(mesh.vertices) / count - 1) < 0.1 or wanted == spacing:
            break
        spacing = wanted
    return mesh


def expected_vertices(outline: Polygon | MultiPolygon, spacing: float) -> int:
    """Number of vertices that the area alone needs; SettingError if it is too large."""
    count = int(outline.area * DENSITY / spacing**2)
    if count > TOO_MANY:
        least = 1.01 * np.sqrt(outline.area * DENSITY / TOO_MANY)
        raise SettingError(
            f"a mesh spacing of {spacing:g} m would make about {count:,} vertices; the limit is {TOO_MANY:,}: "
            f"choose at least {least:.4g} m for ",
            Keyword("spacing"),
        )
    return count


def _inside(triangles: np.ndarray, vertices: np.ndarray, outline: Polygon | MultiPolygon) -> np.ndarray:
    """The triangles that do not lie in a hole."""
    if not any(len(part.interiors) for part in shapely.get_parts(outline)):
        return triangles
    shapely.prepare(outline)
    return triangles[shapely.contains_xy(outline, vertices[triangles].mean(axis=1))]


def _mesh(vertices: np.ndarray, triangles: np.ndarray, spacing: float) -> Mesh:
    """Keep the vertices that triangles use, and orient the triangles."""
    used, renumbered = np.unique(triangles, return_inverse=True)
    if len(used) < TOO_FEW:
        raise SettingError(
            f"a mesh spacing of {spacing:g} m makes only {len(used)} vertices; at least {TOO_FEW} are needed: reduce ",
            Keyword("spacing"),
        )
    triangles = renumbered.reshape(-1, 3)
    inverted = triangle_areas(vertices[used], triangles) < 0
    triangles[inverted] = triangles[inverted, ::-1]
    return Mesh(vertices[used], triangles)


def _shortest_side(corners: np.ndarray) -> np.ndarray:
    """The first point of the shortest of all triangles' sides."""
    sides = np.hypot(*np.moveaxis(corners - np.roll(corners, 1, axis=1), -1, 0))
    return np.asarray(corners[np.unravel_index(np.argmin(sides), sides.shape)])


def edges_along(mesh: Mesh, line: LineString, spacing: float, without: np.ndarray | None = None) -> np.ndarray:
    """Edges of the mesh along a line that it conforms to, in order and direction of the line.

    Merged points lie a little beside the line, and so do short edges of other lines. Of all edges close to the line,
    only those on the shortest path from its start to its end are returned.

    Parameters
    ----------
    mesh : Mesh
    line : shapely LineString
        A line that does not cross itself.
    spacing : float
        Mesh spacing.
    without : array, shape (k, 2), optional
        Edges of other lines, which are excluded.

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
    along, beside = shapely.line_locate_point(line, points), shapely.distance(line, points)
    lengths = np.hypot(*(mesh.vertices[edges[:, 1]] - mesh.vertices[edges[:, 0]]).T)
    near = coo_array((lengths, ends.T), shape=(len(used),) * 2).tocsr()
    paths = []
    for part in _connected(near):
        start, stop = part[np.argmin(along[part] + beside[part])], part[np.argmax(along[part] - beside[part])]
        if along[stop] - along[start] > 2 * tolerance or len(part) == len(used):  # the line, no stray edge beside it
            paths.append((along[start], used[_shortest_path(near, start, stop)]))
    paths.sort(key=lambda entry: entry[0])
    return np.concatenate([np.column_stack([path[:-1], path[1:]]) for _, path in paths] or [np.empty((0, 2), int)])


def _edges_near(mesh: Mesh, line: LineString, tolerance: float) -> np.ndarray:
    """The edges whose ends and middle lie within the tolerance of a line."""
    shapely.prepare(line)
    low, high = np.reshape(line.bounds, (2, 2)) + [[-tolerance], [tolerance]]
    near = ((mesh.vertices >= low) & (mesh.vertices <= high)).all(axis=1)  # a cheap test before the exact one
    near[near] = shapely.dwithin(line, shapely.points(mesh.vertices[near]), tolerance)
    edges = mesh.edges[near[mesh.edges[:, 0]] & near[mesh.edges[:, 1]]]
    return edges[shapely.dwithin(line, shapely.points(mesh.vertices[edges].mean(axis=1)), tolerance)]


def _connected(graph: csr_array) -> list[np.ndarray]:
    """The vertices of each connected part of a graph."""
    count, label = connected_components(graph, directed=False)
    return [np.flatnonzero(label == part) for part in range(count)]


def _shortest_path(graph: csr_array, start: int, stop: int) -> np.ndarray:
    """The vertices from one to another, both included."""
    _, before = dijkstra(graph, directed=False, indices=start, return_predecessors=True)
    path = [stop]
    while path[-1] != start:
        path.append(before[path[-1]])
    return np.array(path[::-1])
