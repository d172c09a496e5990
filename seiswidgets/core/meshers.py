"""The two libraries that fill a planar graph with triangles. The only module that imports them.

Triangle is used where it is installed; its licence restricts commercial distribution (see LICENSES.md). Elsewhere CDT
takes its place. Both insert points until no triangle is large, and none has a small angle that the lines do not have.

J. R. Shewchuk, Triangle: engineering a 2D quality mesh generator and Delaunay triangulator, 1996.
"""

from collections.abc import Callable
from typing import Any

import numpy as np

try:
    import triangle
except ImportError:
    triangle = None

LARGEST_AREA = 0.7  # the mean is then close to the 0.43 of an equilateral triangle with sides of 1
LEAST_ANGLE = {"Triangle": 30.0, "CDT": 28.0}  # degrees
ROUNDS = 2  # of CDT: splitting small angles leaves some triangles large

Mesher = Callable[[np.ndarray, np.ndarray, int], tuple[np.ndarray, np.ndarray]]


def _by_triangle(vertices: np.ndarray, segments: np.ndarray, most: int) -> tuple[np.ndarray, np.ndarray]:
    drawing = {"vertices": vertices, "segments": segments}
    result = triangle.triangulate(drawing, f"pq{LEAST_ANGLE['Triangle']:g}a{LARGEST_AREA}S{most}")
    return result["vertices"], result.get("triangles", np.empty((0, 3), int))


def _by_cdt(vertices: np.ndarray, segments: np.ndarray, most: int) -> tuple[np.ndarray, np.ndarray]:
    import pythoncdt as cdt

    mesh = cdt.Triangulation(cdt.VertexInsertionOrder.AUTO, cdt.IntersectingConstraintEdges.TRY_RESOLVE, 0.0)
    points: Any = np.ascontiguousarray(vertices, np.float64)  # an array is a buffer, which types before 3.12 do not say
    edges: Any = np.ascontiguousarray(segments, np.uintc)
    mesh.insert_vertices(points)
    mesh.conform_to_edges(edges)
    outside = mesh.collect_outer_triangles()
    criteria = (
        (cdt.RefinementCriterion.LARGEST_AREA, LARGEST_AREA),
        (cdt.RefinementCriterion.SMALLEST_ANGLE, cdt.deg_to_rad(LEAST_ANGLE["CDT"])),
    )
    for criterion, threshold in criteria * ROUNDS:
        mesh.refine_triangles(max(0, most - mesh.vertices_count()), criterion, threshold, outside)
    mesh.finalize_triangulation(outside)
    filled = mesh.vertices_array()
    return np.column_stack([filled["x"], filled["y"]]), mesh.triangles_array()["vertices"].astype(int)


MESHERS: dict[str, Mesher] = ({} if triangle is None else {"Triangle": _by_triangle}) | {"CDT": _by_cdt}


def chosen_mesher() -> str:
    """Name of the library that makes the meshes."""
    return next(iter(MESHERS))


def fill(vertices: np.ndarray, segments: np.ndarray, most: int) -> tuple[np.ndarray, np.ndarray]:
    """Fill a planar graph with triangles whose sides are about 1 long.

    Parameters
    ----------
    vertices : array, shape (n, 2)
    segments : array, shape (k, 2)
        Each becomes an edge, or several.
    most : int
        Number of vertices at which refinement stops, wherever it is.

    Returns
    -------
    vertices : array, shape (v, 2)
    triangles : array, shape (m, 3)
        Holes are filled too.
    """
    return MESHERS[chosen_mesher()](vertices, segments, most)
