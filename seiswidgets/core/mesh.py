"""A triangle mesh as a value, and its cuts."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components


def triangle_areas(vertices: np.ndarray, triangles: np.ndarray) -> np.ndarray:
    """Signed areas of triangles, positive when their corners run from x to z; shape (m,)."""
    a, b, c = np.take(vertices, triangles.T, axis=0)  # called often; five times as fast as indexing
    areas = 0.5 * ((b[:, 0] - a[:, 0]) * (c[:, 1] - a[:, 1]) - (b[:, 1] - a[:, 1]) * (c[:, 0] - a[:, 0]))
    return np.asarray(areas)


def edge_keys(edges: np.ndarray) -> np.ndarray:
    """Integer key of each edge, whichever of its vertices comes first; shape (k,)."""
    return np.asarray(edges.min(axis=1) << 32 | edges.max(axis=1))


@dataclass(frozen=True, eq=False)
class Mesh:
    """A triangle mesh at rest, before any deformation.

    Parameters
    ----------
    vertices : array, shape (n, 2)
        Positions in metres of rock. Two vertices may coincide: the two sides of a cut.
    triangles : array, shape (m, 3)
        Corners of each triangle, all in the same sense (positive area).
    """

    vertices: np.ndarray
    triangles: np.ndarray

    def __post_init__(self) -> None:
        for name, dtype in (("vertices", float), ("triangles", np.int64)):
            array = np.array(getattr(self, name), dtype=dtype)
            array.setflags(write=False)
            object.__setattr__(self, name, array)

    def __repr__(self) -> str:
        return f"<Mesh: {len(self.vertices)} vertices, {len(self.triangles)} triangles>"

    @cached_property
    def areas(self) -> np.ndarray:
        """Area of each triangle, shape (m,)."""
        return triangle_areas(self.vertices, self.triangles)

    @cached_property
    def vertex_areas(self) -> np.ndarray:
        """A third of the area of the triangles at each vertex, shape (n,)."""
        return np.bincount(self.triangles.ravel(), np.repeat(self.areas / 3, 3), minlength=len(self.vertices))

    @cached_property
    def half_edges(self) -> np.ndarray:
        """Directed edges, three a triangle in its own order; shape (3 m, 2)."""
        return self.triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2)

    @cached_property
    def _edges_of_half_edges(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Edges, the edge of each half-edge, and the number of triangles at each edge."""
        keys, inverse, counts = np.unique(self._keys(self.half_edges), return_inverse=True, return_counts=True)
        return np.stack(np.divmod(keys, len(self.vertices)), axis=1), inverse, counts

    def _keys(self, pairs: np.ndarray) -> np.ndarray:
        return np.asarray(pairs.min(axis=1) * len(self.vertices) + pairs.max(axis=1))

    @property
    def edges(self) -> np.ndarray:
        """Each edge once, its lower vertex first; shape (e, 2)."""
        return self._edges_of_half_edges[0]

    @cached_property
    def boundary_half_edges(self) -> np.ndarray:
        """Indices of the half-edges whose edge has one triangle only, shape (b,)."""
        _, inverse, counts = self._edges_of_half_edges
        return np.flatnonzero(counts[inverse] == 1)

    @property
    def boundary(self) -> np.ndarray:
        """Edges with one triangle only, directed so that the mesh always lies on the same side; shape (b, 2)."""
        return self.half_edges[self.boundary_half_edges]

    @cached_property
    def contour(self) -> np.ndarray:
        """Each contour vertex between its neighbours along the boundary: rows (before, vertex, after)."""
        arriving = self.boundary[np.argsort(self.boundary[:, 1])]
        leaving = self.boundary[np.argsort(self.boundary[:, 0])]
        return np.column_stack([arriving[:, 0], leaving])

    @cached_property
    def interior(self) -> np.ndarray:
        """Indices of the vertices that are not on the contour."""
        inside = np.ones(len(self.vertices), bool)
        inside[self.boundary] = False
        return np.flatnonzero(inside)

    @cached_property
    def blocks(self) -> np.ndarray:
        """Label of the connected part that each vertex belongs to, counted from 0; shape (n,)."""
        return _components(len(self.vertices), self.edges)

    def moved(self, vertices: np.ndarray) -> "Mesh":
        """The same triangles with their vertices elsewhere."""
        mesh = Mesh(vertices, self.triangles)
        topology = ("half_edges", "_edges_of_half_edges", "boundary_half_edges", "contour", "interior", "blocks")
        vars(mesh).update({name: getattr(self, name) for name in ("triangles", *topology)})
        return mesh

    def cut(self, edges: np.ndarray) -> "Cut":
        """Cut the mesh open along some of its edges.

        Every corner of a triangle is a node; corners are joined across each edge that is not cut; each connected
        set of corners is one vertex of the new mesh. So a cut's tip stays whole, and branches, crossings and cuts
        that reach the border come apart, without special cases.

        Parameters
        ----------
        edges : array, shape (k, 2)
            Directed pairs of vertices that are edges of the mesh, with a triangle on either side.
        """
        _, edge, counts = self._edges_of_half_edges
        order = np.argsort(edge, kind="stable")
        twin = np.flatnonzero(counts[edge[order]] == 2).reshape(-1, 2)
        one, other = order[twin].T  # the two half-edges of every inner edge; half-edge 3 t + k leaves corner 3 t + k
        whole = ~np.isin(self._keys(self.half_edges[one]), self._keys(np.asarray(edges).reshape(-1, 2)))
        one, other = one[whole], other[whole]
        joined = np.concatenate([np.column_stack([one, _next(other)]), np.column_stack([_next(one), other])])
        corner_vertex = _components(self.triangles.size, joined)
        vertices = np.empty((corner_vertex.max() + 1, 2))
        vertices[corner_vertex] = self.vertices[self.triangles.ravel()]
        return Cut(self, Mesh(vertices, corner_vertex.reshape(-1, 3)))


@dataclass(frozen=True, eq=False)
class Cut:
    """A mesh before and after cutting: the triangles are the same, the vertices along the cuts are doubled."""

    whole: Mesh
    mesh: Mesh

    def sides(self, edges: np.ndarray) -> np.ndarray:
        """The two copies of each directed edge of the whole mesh, shape (2, k, 2).

        First the copies whose triangle follows the edge in its own sense (positive area: where x points right and z
        down, the right-hand side of the direction of travel), then the copies on the other side.
        """
        edges = np.asarray(edges)
        return np.stack([self._copies(edges)[0], self._copies(edges[:, ::-1])[0][:, ::-1]])

    def along(self, edges: np.ndarray) -> np.ndarray:
        """Copies in the cut mesh of directed edges of the whole mesh that are not cut; shape (k, 2)."""
        edges = np.asarray(edges)
        (forward, known), (backward, _) = self._copies(edges), self._copies(edges[:, ::-1])
        return np.where(known[:, None], forward, backward[:, ::-1])

    @cached_property
    def _half_edges_in_order(self) -> tuple[np.ndarray, np.ndarray]:
        """Sorted keys of the whole mesh's half-edges, and the half-edge that each belongs to."""
        keys = self.whole.half_edges @ [len(self.whole.vertices), 1]
        order = np.argsort(keys)
        return keys[order], order

    def _copies(self, directed: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Ends of each directed edge in the triangle that follows it in its own sense, and True where there is one."""
        keys, order = self._half_edges_in_order
        wanted = directed @ [len(self.whole.vertices), 1]
        index = np.minimum(np.searchsorted(keys, wanted), len(keys) - 1)
        corners, half_edge = self.mesh.triangles.ravel(), order[index]
        return np.column_stack([corners[half_edge], corners[_next(half_edge)]]), keys[index] == wanted


def _next(half_edge: np.ndarray) -> np.ndarray:
    """The half-edge after this one in its triangle."""
    return np.asarray(half_edge - 2 * (half_edge % 3 == 2) + (half_edge % 3 != 2))


def _components(count: int, pairs: np.ndarray) -> np.ndarray:
    """Label of the connected component of each of ``count`` nodes."""
    graph = coo_array((np.ones(len(pairs), bool), (pairs[:, 0], pairs[:, 1])), shape=(count, count))
    return np.asarray(connected_components(graph, directed=False)[1].astype(np.int64))
