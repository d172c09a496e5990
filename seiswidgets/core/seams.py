"""Welding of a cut mesh's seams after its sides have slid along each other, and the outline of the whole."""

from collections.abc import Iterable, Sequence

import numpy as np
import shapely
from shapely import LinearRing, MultiPolygon, Polygon

from seiswidgets.core.contact import Contact
from seiswidgets.core.mesh import Mesh, triangle_areas
from seiswidgets.core.point_location import TriangleFinder

Seam = tuple[np.ndarray, np.ndarray]
Positions = dict[int, float]  # along a polyline, in segments, by vertex

# of the width that is closed: the distance of corners that crowd a mesh, and the change that removing one may make
HAIRLINE = 1e-5, 1e-3  # of the width that is closed, on average
CROWDED, DEVIATION = 2.5, 2e-3


def weld_seams(mesh: Mesh, vertices: np.ndarray, seams: Sequence[Seam]) -> tuple[Mesh, np.ndarray]:
    """Make a deformed mesh fit along its seams to the last digit.

    A solver leaves slivers of gap and overlap: two polygons that have slid along each other share no corners. Here
    the vertices of one side move onto the other side's polyline, and its triangles are split where that polyline has
    a corner; so the map from rest to the deformed mesh becomes one to one, without a gap, along the seam. Vertices that
    this would move over their own triangles stay where they are.

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
    mesh : Mesh
        With the split triangles.
    vertices : array
        After deformation; the first n vertices are the mesh's own.
    """
    vertices = np.array(vertices)
    for slave, master in seams:
        _move_onto_master(mesh, vertices, master, _positions_on_master(vertices, slave, master))
    splits: dict[tuple[int, int], np.ndarray] = {}
    for slave, master in seams:
        splits |= _splits(slave, master, _positions_on_master(vertices, slave, master))
    return _split_triangles(mesh, vertices, splits)


def _positions_on_master(vertices: np.ndarray, slave: np.ndarray, master: np.ndarray) -> Positions:
    """Position of each vertex of the slave along the master, in segments; NaN beyond the master's ends."""
    points = np.setdiff1d(slave, master)
    unbent, none = np.zeros((len(master), 3)), np.empty(0, int)
    contact = Contact(points, master, unbent, len(vertices), len(master), none).with_contacts(vertices)
    held = contact.partner >= 0
    start, stop = (vertices[master[contact.partner[held], k]] for k in (0, 1))
    along = stop - start
    foot = np.sum(along * (vertices[points[held]] - start), axis=1) / np.sum(along**2, axis=1)
    positions: Positions = dict.fromkeys(points.tolist(), np.nan)
    positions.update(zip(points[held].tolist(), (contact.partner[held] + np.clip(foot, 0, 1)).tolist(), strict=True))
    for vertex in np.intersect1d(slave, master):
        positions[int(vertex)] = float(np.flatnonzero((master == vertex).any(axis=1))[0] + (master[-1, 1] == vertex))
    return positions


def _move_onto_master(mesh: Mesh, vertices: np.ndarray, master: np.ndarray, positions: Positions) -> None:
    """Move vertices onto the master's polyline, except those that would turn a triangle over."""
    movable = {vertex: at for vertex, at in positions.items() if np.isfinite(at) and vertex not in master}
    if not movable:
        return
    moving, position = np.array(list(movable)), np.array(list(movable.values()))
    segment = np.minimum(position.astype(int), len(master) - 1)
    start, stop = vertices[master[segment, 0]], vertices[master[segment, 1]]
    before = vertices[moving].copy()
    vertices[moving] = start + (position - segment)[:, None] * (stop - start)
    while (bad := _squashing(mesh, vertices, moving)).any():
        vertices[moving[bad]] = before[bad]
        moving, before = moving[~bad], before[~bad]


def _squashing(mesh: Mesh, vertices: np.ndarray, moving: np.ndarray) -> np.ndarray:
    """True for vertices with a triangle that has lost nearly all of its area, or is turned over."""
    areas = triangle_areas(vertices, mesh.triangles)
    return np.isin(moving, mesh.triangles[areas <= 1e-3 * mesh.areas])


def _splits(slave: np.ndarray, master: np.ndarray, positions: Positions) -> dict[tuple[int, int], np.ndarray]:
    """The master's vertices that lie on each of the slave's edges, in order from its first vertex to its second."""
    splits = {}
    for first, second in slave.tolist():
        start, stop = positions[first], positions[second]
        if np.isnan(start) and np.isnan(stop):
            continue
        start, stop = _beyond_end(start, stop, len(master)), _beyond_end(stop, start, len(master))
        low, high = sorted((start, stop))
        between = range(int(np.floor(low + 1e-9)) + 1, int(np.ceil(high - 1e-9)))
        inner = [vertex for at in between for vertex in _vertices_at(master, at) if vertex not in (first, second)]
        if inner:
            splits[first, second] = np.array(inner if start < stop else inner[::-1])
    return splits


def _vertices_at(master: np.ndarray, index: int) -> Iterable[int]:
    """The vertex between two segments of a polyline; two vertices where another fault has broken it."""
    ends = [master[index - 1, 1]] if index > 0 else []
    return dict.fromkeys([*ends, *([master[index, 0]] if index < len(master) else [])])


def _beyond_end(position: float, other: float, count: int) -> float:
    """Replace NaN by a position beyond that end of the polyline which lies nearer to the other position."""
    if np.isfinite(position):
        return position
    return -0.5 if other < count / 2 else count + 0.5


def _split_triangles(
    mesh: Mesh, vertices: np.ndarray, splits: dict[tuple[int, int], np.ndarray]
) -> tuple[Mesh, np.ndarray]:
    """Replace triangles at split edges by fans from their far corner, unless one of a fan would have no area."""
    half_edges = {tuple(mesh.half_edges[index].tolist()): int(index) for index in mesh.boundary_half_edges}
    rest, moved, replaced, fans = [mesh.vertices], [vertices], set(), []
    count = len(vertices)
    for (first, second), inner in splits.items():
        forward = (first, second) in half_edges
        one, two = (first, second) if forward else (second, first)
        half_edge = half_edges[one, two]
        if half_edge // 3 in replaced:
            continue
        far, at_rest, after = _fan(mesh, vertices, half_edge, np.array([one, *inner[:: 1 if forward else -1], two]))
        least = min(_least_area(at_rest - mesh.vertices[far]), _least_area(after - vertices[far]))
        if least <= 1e-9 * mesh.areas[half_edge // 3]:
            continue
        chain = np.array([one, *range(count, count + len(inner)), two])
        replaced.add(half_edge // 3)
        fans.append(np.column_stack([chain[:-1], chain[1:], np.full(len(inner) + 1, far)]))
        rest.append(at_rest[1:-1])
        moved.append(after[1:-1])
        count += len(inner)
    kept = np.delete(mesh.triangles, list(replaced), axis=0)
    return Mesh(np.vstack(rest), np.vstack([kept, *fans])), np.vstack(moved)


def _fan(mesh: Mesh, vertices: np.ndarray, half_edge: int, chain: np.ndarray) -> tuple[int, np.ndarray, np.ndarray]:
    """A triangle's far corner, and a chain of points along its opposite edge, at rest and after deformation."""
    triangle, corner = divmod(half_edge, 3)
    after = vertices[chain]
    arc_lengths = np.append(0, np.hypot(*np.diff(after, axis=0).T).cumsum())
    share = (arc_lengths / arc_lengths[-1])[:, None]
    at_rest = (1 - share) * mesh.vertices[chain[0]] + share * mesh.vertices[chain[-1]]
    return int(mesh.triangles[triangle, (corner + 2) % 3]), at_rest, after


def _least_area(arms: np.ndarray) -> float:
    """Least area of the triangles between consecutive arms from one corner."""
    return float(0.5 * (arms[:-1, 0] * arms[1:, 1] - arms[:-1, 1] * arms[1:, 0]).min())


def outline(
    mesh: Mesh, vertices: np.ndarray, closing: float, finder: TriangleFinder | None = None
) -> Polygon | MultiPolygon:
    """Outline of a deformed mesh, gaps narrower than twice ``closing`` filled.

    Parameters
    ----------
    mesh : Mesh
    vertices : array, shape (n, 2)
        After deformation.
    closing : float
    finder : TriangleFinder, optional
        Of the deformed triangles, if there is one already.
    """
    edges = shapely.line_merge(shapely.multilinestrings(shapely.linestrings(vertices[mesh.boundary])))
    grid = 2.0**-30 * np.ptp(vertices, axis=0).max()
    faces = shapely.get_parts(shapely.polygonize([shapely.union_all([edges], grid_size=grid)]))
    inside = shapely.get_coordinates(shapely.point_on_surface(faces))
    finder = finder or TriangleFinder(vertices, mesh.triangles)
    covered = shapely.union_all(faces[finder(inside) >= 0])
    style = {"join_style": "mitre", "mitre_limit": 10}
    closed = covered.buffer(closing, **style).buffer(-closing, **style)
    covered = _remove_specks(covered, (5 * closing) ** 2)
    gaps = shapely.get_parts(closed.difference(covered))
    area, length = shapely.area(gaps), closing * shapely.length(gaps)
    hairline = (area > HAIRLINE[0] * length) & (area < HAIRLINE[1] * length)  # it could remain as a cut in the rock
    gaps = gaps[hairline | (area > (0.1 * closing) ** 2)]  # others are rounding
    whole = shapely.union_all([covered, *gaps], grid_size=grid).simplify(1e-5 * closing)
    return _remove_crowded_corners(whole, CROWDED * closing, DEVIATION * closing)


def _remove_crowded_corners(shape: Polygon | MultiPolygon, reach: float, deviation: float) -> Polygon | MultiPolygon:
    """Remove corners that lie close to the next one, and that the outline hardly needs: they would crowd a mesh.

    A side that has slid along another often ends a little before or beyond a corner of the other.
    """
    needed = set(map(tuple, shapely.get_coordinates(shape.simplify(deviation))))

    def thinned(ring: LinearRing) -> np.ndarray:
        points = shapely.get_coordinates(ring)[:-1]
        gaps = np.hypot(*(points - np.roll(points, 1, axis=0)).T)
        crowded = np.minimum(gaps, np.roll(gaps, -1)) < reach
        return points[~crowded | [tuple(point) in needed for point in points]]

    parts = [
        Polygon(thinned(part.exterior), [thinned(ring) for ring in part.interiors]) for part in shapely.get_parts(shape)
    ]
    return parts[0] if len(parts) == 1 else MultiPolygon(parts)


def new_holes(before: Polygon | MultiPolygon, after: Polygon | MultiPolygon) -> list[Polygon]:
    """The holes of an outline that it did not have before: all but its largest ones, as many as there were."""
    old, new = (
        sorted(
            (Polygon(ring) for part in shapely.get_parts(shape) for ring in part.interiors), key=lambda hole: hole.area
        )
        for shape in (before, after)
    )
    return new[: len(new) - len(old)] if len(new) > len(old) else []


def _remove_specks(shape: Polygon | MultiPolygon, area: float) -> Polygon | MultiPolygon:
    """Remove the holes and the parts of a shape that are smaller than an area."""
    parts = [
        shapely.Polygon(part.exterior, [ring for ring in part.interiors if shapely.Polygon(ring).area > area])
        for part in shapely.get_parts(shape)
        if part.area > area
    ]
    return shapely.union_all(parts)
