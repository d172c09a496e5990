"""Meshing of a section with a horizon to be flattened, and the horizon's terms of the energy."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
import shapely
from shapely import LineString

from seiswidgets.core.interpolated import AtPoints, PointsInMesh
from seiswidgets.core.mesh import Mesh, edge_keys
from seiswidgets.core.point_location import TriangleFinder, triangles_at
from seiswidgets.core.term import Term
from seiswidgets.core.terms import EdgeLength, Level
from seiswidgets.core.triangulation import edges_along
from seiswidgets.errors import PickError
from seiswidgets.geology.domain import RestorationDomain
from seiswidgets.geology.fault_lines import merge_close_points
from seiswidgets.geology.picks import HORIZON
from seiswidgets.geology.segments import join_pieces
from seiswidgets.geology.solve import reusable_setup, triangles_inside
from seiswidgets.geology.stage import Stage
from seiswidgets.geology.weights import Weights

SQUEEZED = 0.2  # of its area: a triangle of a kept mesh keeps more


@dataclass(frozen=True, eq=False)
class Bed:
    """A mesh and a horizon in it.

    Attributes
    ----------
    mesh : Mesh
    edges : array, shape (k, 2)
        Edges of the horizon between vertices, or between ``points``.
    fingerprint : tuple
        Everything that shaped the mesh.
    name : str
        Name of the horizon.
    vertices : array
        The vertices along the horizon when the mesh was made.
    points : PointsInMesh, optional
        Points of a horizon that has moved since the mesh was made, for a preview.
    origin : CarriedMesh, optional
        The mesh as it was made, and how it lies in that of the stage before; only for a preview.
    """

    mesh: Mesh
    edges: np.ndarray
    fingerprint: tuple
    name: str
    vertices: np.ndarray
    points: PointsInMesh | None = None
    origin: "CarriedMesh | None" = None

    def mesh_for(self, lines: Sequence[LineString], fingerprint: tuple, before: Stage | None) -> Mesh | None:
        """The mesh kept for the horizon where it has moved, with a vertex at each corner; None if it needs another."""
        is_same_rock = before is not None or fingerprint[:-1] == self.fingerprint[:-1]
        mesh = self.origin.after(before) if self.origin and is_same_rock else None
        return mesh and _moved_onto(shapely.get_coordinates(lines), mesh, self.vertices)

    @property
    def reach(self) -> float:
        """Factor of the horizon's weights: the root of the number of its edges.

        A horizon is a line, but has to move an area, whose stiffness stays the same on a finer mesh while that of the
        line's edges falls. With this factor the horizon keeps its length, and lies level, on any mesh.
        """
        return float(np.sqrt(len(self.edges)))

    def positions(self, vertices: np.ndarray) -> np.ndarray:
        """The points that ``edges`` refer to, after a deformation; shape (n, 2)."""
        return vertices if self.points is None else self.points.positions(vertices)

    def level(self, datum: float | np.ndarray, weight: float) -> Level:
        """The term that brings the horizon to a datum, in terms of ``positions``."""
        count = len(self.mesh.vertices) if self.points is None else len(self.points.corners)
        return Level(np.unique(self.edges), datum, count, weight * self.reach)

    def terms(self, level: Level, weights: Weights) -> list[Term]:
        """The terms of the horizon, and the lengths of all other edges."""
        length = EdgeLength(self.positions(self.mesh.vertices), self.edges, weights.length * self.reach, "bed length")
        edges, rest = self.mesh.edges, self.mesh.vertices
        if self.points is not None:
            return [EdgeLength(rest, edges, weights.edge), *(AtPoints(term, self.points) for term in (length, level))]
        others = edges[~np.isin(edge_keys(edges), edge_keys(self.edges))]
        return [EdgeLength(rest, others, weights.edge), length, level]


@dataclass(frozen=True, eq=False)
class CarriedMesh:
    """A mesh whose vertices lie in the mesh of the stage before, with which they move.

    Attributes
    ----------
    mesh : Mesh
    triangles : array, shape (m, 3)
        Those of the stage before; None if there is none.
    vertices : PointsInMesh or None
    """

    mesh: Mesh
    triangles: np.ndarray | None = None
    vertices: PointsInMesh | None = None

    @classmethod
    def of(cls, mesh: Mesh, before: Stage | None) -> "CarriedMesh | None":
        """Locate a mesh in that of the stage before; None if it does not lie in it."""
        if before is None:
            return cls(mesh)
        triangles, count = before.mesh_setup.mesh.triangles, len(before.mesh_setup.mesh.vertices)
        held = triangles_inside(mesh, TriangleFinder(before.vertices[:count], triangles))
        if (held < 0).any():
            return None
        return cls(mesh, triangles, PointsInMesh.in_triangles(before.vertices, triangles[held], mesh.vertices))

    def after(self, before: Stage | None) -> Mesh | None:
        """The mesh after another solution of the stage before; None if that has another mesh or squeezes this one."""
        if (before.mesh_setup.mesh.triangles if before else None) is not self.triangles:
            return None
        if before is None or self.vertices is None:
            return self.mesh
        moved = self.mesh.moved(self.vertices.positions(before.vertices))
        return moved if (moved.areas > SQUEEZED * self.mesh.areas).all() else None


def mesh_bed(
    domain: RestorationDomain,
    name: str,
    pieces: Sequence[LineString],
    start: Stage | None = None,
    before: Stage | None = None,
) -> Bed:
    """Mesh a horizon; an earlier stage's set-up is reused if it is identical, and for a preview its mesh in any case.

    Raises
    ------
    PickError
        If too little of the horizon lies inside the rock.
    """
    fingerprint = domain.fingerprint({name: pieces})
    if same := reusable_setup(start, Bed, fingerprint):
        return same
    lines = _tidy(join_pieces(pieces, domain.cell), domain, name)
    earlier = start.mesh_setup if domain.quick and start and isinstance(start.mesh_setup, Bed) else None
    if earlier and earlier.name == name and (kept := earlier.mesh_for(lines, fingerprint, before)):
        return _bed_in(kept, lines, replace(earlier, mesh=kept, fingerprint=fingerprint), domain.spacing)
    mesh = domain.mesh({(HORIZON, name): lines})
    edges = np.concatenate([edges_along(mesh, line, domain.spacing) for line in lines])
    origin = CarriedMesh.of(mesh, before) if domain.quick else None
    return Bed(mesh, edges, fingerprint, name, np.unique(edges), origin=origin)


def _moved_onto(corners: np.ndarray, mesh: Mesh, vertices: np.ndarray) -> Mesh | None:
    """A mesh with the nearest of some vertices at each corner of a horizon; None if that would squeeze it."""
    places = mesh.vertices[vertices]
    nearest = np.argmin(np.hypot(*(corners[:, None] - places).transpose(2, 0, 1)), axis=1)
    moved = mesh.vertices.copy()
    moved[vertices[nearest]] = corners
    mesh, before = mesh.moved(moved), mesh
    is_fit = len(np.unique(nearest)) == len(nearest) and (mesh.areas > SQUEEZED * before.areas).all()
    return mesh if is_fit else None


def _bed_in(mesh: Mesh, lines: Sequence[LineString], earlier: Bed, spacing: float) -> Bed:
    """A horizon whose points lie inside the triangles of a mesh."""
    chains = [shapely.get_coordinates(line.segmentize(spacing)) for line in lines]
    ends = np.cumsum([len(chain) for chain in chains])
    points, first = np.concatenate(chains), np.delete(np.arange(ends[-1]), ends - 1)
    triangles = triangles_at(mesh.vertices, mesh.triangles, points)
    inside = triangles >= 0
    edges = np.column_stack([first, first + 1])
    edges = (np.cumsum(inside) - 1)[edges[inside[edges].all(axis=1)]]
    within = PointsInMesh.in_triangles(mesh.vertices, mesh.triangles[triangles[inside]], points[inside])
    return replace(earlier, edges=edges, points=within)


def _tidy(lines: Sequence[LineString], domain: RestorationDomain, name: str) -> list[LineString]:
    """Simplify the lines of a horizon; PickError if too little of it lies inside the rock."""
    pieces = [merge_close_points(shapely.get_coordinates(line), domain.spacing) for line in lines]
    tidied = [domain.simplify(domain.on_border(LineString(points))) for points in pieces if len(points) > 1]
    inside = [shapely.get_coordinates(line.intersection(domain.outline)) for line in tidied]
    if all(len(points) < 2 or domain.is_short(points) for points in inside):
        raise PickError(
            f"horizon {name!r} is no longer than three traces and samples, too short to flatten; draw more of it",
            pick=name,
            where=domain.position(pieces[0][0]) if pieces else None,
        )
    return tidied
