"""Closing the seams of a cut mesh after its sides have slid along each other, and the outline of the whole."""

import numpy as np
import shapely

from seiswidgets.core.contact import Contact
from seiswidgets.core.mesh import Mesh, triangle_areas
from seiswidgets.core.point_location import TriangleFinder


def welded(mesh: Mesh, vertices, seams) -> tuple[Mesh, np.ndarray]:
    """A mesh and its vertices after deformation, made to fit along its seams to the last digit.

    A solver leaves slivers of gap and overlap: two polygons that have slid along each other share no corners. Here
    the one side's vertices are laid on the other side's polyline, and its triangles are split where that polyline has
    a corner; so the map from rest to now becomes one to one, without a gap, along the seam. Vertices that this would
    move over their own triangles stay where they are.

    Parameters
    ----------
    mesh : Mesh
        At rest, cut.
    vertices : array, shape (n, 2)
        After deformation.
    seams : list of (slave, master), each an array of shape (s, 2)
        The edges of both sides of each seam, in order and direction of it.

    Returns
    -------
    The mesh with the split triangles, and its vertices after deformation; the first n vertices are the mesh's own.
    """
    vertices = np.array(vertices)
    for slave, master in seams:
        ways = _ways(mesh, vertices, slave, master)
        _lay(mesh, vertices, slave, master, ways)
    splits = {}
    for slave, master in seams:
        splits |= _corners(vertices, slave, master, _ways(mesh, vertices, slave, master))
    return _split(mesh, vertices, splits)


def _ways(mesh, vertices, slave, master):
    """How far along the master each vertex of the slave lies, in segments; NaN beyond the master's ends.

    Returns
    -------
    dict of int to float
    """
    points = np.setdiff1d(slave, master)
    contact = Contact(points, master, np.zeros(len(points)), np.zeros((len(master), 3)), len(vertices)).at(vertices)
    held = contact.partner >= 0
    start, stop = (vertices[master[contact.partner[held], k]] for k in (0, 1))
    along = stop - start
    foot = np.sum(along * (vertices[points[held]] - start), axis=1) / np.sum(along**2, axis=1)
    ways = dict.fromkeys(points.tolist(), np.nan)
    ways.update(zip(points[held].tolist(), (contact.partner[held] + np.clip(foot, 0, 1)).tolist(), strict=True))
    for vertex in np.intersect1d(slave, master):
        ways[int(vertex)] = float(np.flatnonzero((master == vertex).any(axis=1))[0] + (master[-1, 1] == vertex))
    return ways


def _lay(mesh, vertices, slave, master, ways):
    """Move the slave's vertices onto the master's polyline, but for those that would turn a triangle over."""
    laid = {vertex: way for vertex, way in ways.items() if np.isfinite(way) and vertex not in master}
    if not laid:
        return
    moving, way = np.array(list(laid)), np.array(list(laid.values()))
    segment = np.minimum(way.astype(int), len(master) - 1)
    start, stop = vertices[master[segment, 0]], vertices[master[segment, 1]]
    before = vertices[moving].copy()
    vertices[moving] = start + (way - segment)[:, None] * (stop - start)
    while (bad := _turned(mesh, vertices, moving)).any():
        vertices[moving[bad]] = before[bad]
        moving, before = moving[~bad], before[~bad]


def _turned(mesh, vertices, moving):
    areas = triangle_areas(vertices, mesh.triangles)
    return np.isin(moving, mesh.triangles[areas <= 1e-3 * mesh.areas])


def _corners(vertices, slave, master, ways):
    """The master's vertices that lie on each of the slave's edges, in order from its first vertex to its second."""
    splits = {}
    for first, second in slave.tolist():
        start, stop = ways[first], ways[second]
        if np.isnan(start) and np.isnan(stop):
            continue
        start, stop = _beyond(start, stop, len(master)), _beyond(stop, start, len(master))
        low, high = sorted((start, stop))
        between = np.arange(int(np.floor(low + 1e-9)) + 1, int(np.ceil(high - 1e-9)))
        inner = [vertex for way in between for vertex in _at(master, way) if vertex not in (first, second)]
        if inner:
            splits[first, second] = np.array(inner if start < stop else inner[::-1])
    return splits


def _at(master, way):
    """The vertex between two segments of a polyline: two where another fault has broken it."""
    ends = [master[way - 1, 1]] if way > 0 else []
    return dict.fromkeys([*ends, *([master[way, 0]] if way < len(master) else [])])


def _beyond(way, other, count):
    """A way beyond an end of the polyline, NaN until now, such that the end lies in between."""
    if np.isfinite(way):
        return way
    return -0.5 if other < count / 2 else count + 0.5


def _split(mesh, vertices, splits):
    """Triangles at split edges replaced by fans from their far corner; those that would have no area stay."""
    corner_of = {tuple(mesh.half_edges[number].tolist()): number for number in mesh.boundary_half_edges}
    rest, moved, gone, fans = [mesh.vertices], [vertices], set(), []
    count = len(vertices)
    for (first, second), inner in splits.items():
        forward = (first, second) in corner_of
        half_edge = corner_of[(first, second) if forward else (second, first)]
        if half_edge // 3 in gone:
            continue
        one, two = (first, second) if forward else (second, first)
        far, at_rest, places = _fan(mesh, vertices, half_edge, one, two, inner if forward else inner[::-1])
        least = min(_least_area(at_rest - mesh.vertices[far]), _least_area(places - vertices[far]))
        if least <= 1e-9 * mesh.areas[half_edge // 3]:
            continue
        chain = np.array([one, *range(count, count + len(inner)), two])
        gone.add(half_edge // 3)
        fans.append(np.column_stack([chain[:-1], chain[1:], np.full(len(inner) + 1, far)]))
        rest.append(at_rest[1:-1])
        moved.append(places[1:-1])
        count += len(inner)
    kept = np.delete(mesh.triangles, list(gone), axis=0)
    return Mesh(np.vstack(rest), np.vstack([kept, *fans])), np.vstack(moved)


def _fan(mesh, vertices, half_edge, one, two, inner):
    """A triangle's far corner, and the chain of places along its opposite edge, at rest and after deformation."""
    triangle, corner = divmod(half_edge, 3)
    places = vertices[[one, *inner, two]]
    ways = np.append(0, np.hypot(*np.diff(places, axis=0).T).cumsum())
    share = (ways / ways[-1])[:, None]
    at_rest = (1 - share) * mesh.vertices[one] + share * mesh.vertices[two]
    return mesh.triangles[triangle, (corner + 2) % 3], at_rest, places


def _least_area(arms):
    """The least area of the triangles between arms that follow each other, all from one corner."""
    return 0.5 * (arms[:-1, 0] * arms[1:, 1] - arms[:-1, 1] * arms[1:, 0]).min()


def outline(mesh: Mesh, vertices, closing: float, finder: TriangleFinder | None = None):
    """What a deformed mesh covers, gaps narrower than twice ``closing`` filled.

    Parameters
    ----------
    mesh : Mesh
    vertices : array, shape (n, 2)
        After deformation.
    closing : float
    finder : TriangleFinder, optional
        Of the deformed triangles, where there is one.

    Returns
    -------
    shapely Polygon or MultiPolygon
    """
    edges = shapely.line_merge(shapely.multilinestrings(shapely.linestrings(vertices[mesh.boundary])))
    grid = 2.0**-30 * np.ptp(vertices, axis=0).max()
    faces = shapely.get_parts(shapely.polygonize([shapely.union_all([edges], grid_size=grid)]))
    inside = shapely.get_coordinates(shapely.point_on_surface(faces))
    finder = finder or TriangleFinder(vertices, mesh.triangles)
    covered = shapely.union_all(faces[finder(inside) >= 0])
    style = {"join_style": "mitre", "mitre_limit": 10}
    closed = covered.buffer(closing, **style).buffer(-closing, **style)
    covered = _without_specks(covered, (5 * closing) ** 2)
    gaps = shapely.get_parts(closed.difference(covered))
    gaps = gaps[shapely.area(gaps) > (0.1 * closing) ** 2]  # what is smaller is rounding
    return shapely.union_all([covered, *gaps], grid_size=grid).simplify(1e-5 * closing)


def _without_specks(shape, area):
    """A shape without the holes and the parts that are smaller than an area."""
    parts = [
        shapely.Polygon(part.exterior, [ring for ring in part.interiors if shapely.Polygon(ring).area > area])
        for part in shapely.get_parts(shape)
        if part.area > area
    ]
    return shapely.union_all(parts)
