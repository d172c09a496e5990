"""How a stage is solved: the choice of solver, where it starts, and the refusal of flipped triangles."""

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np

from seiswidgets.core.mesh import Mesh, triangle_areas
from seiswidgets.core.solver import Solution, fixed_point, gauss_newton
from seiswidgets.errors import FlippedError, SettingError
from seiswidgets.geology.weights import Weights

GAUSS_NEWTON, FIXED_POINT = "gauss-newton", "fixed-point"
TOLERANCE = 1e-6  # of the mesh spacing
INWARDS = 1e-3, 0.1, 0.5  # of the way to a triangle's centre
MOST_ITERATIONS = {GAUSS_NEWTON: 200, FIXED_POINT: 1000}


@dataclass(frozen=True)
class Options:
    """The choices that ``unfault`` and ``flatten`` share; see there."""

    weights: Weights = field(default_factory=Weights)
    solver: str = GAUSS_NEWTON
    max_iterations: int | None = None
    progress: Callable | None = None
    start: object = None

    def __post_init__(self):
        if not isinstance(self.weights, Weights):
            raise SettingError(f"weights must be a seiswidgets.Weights, but is {self.weights!r}")
        if self.solver not in tuple(MOST_ITERATIONS):
            raise SettingError(f"solver must be {' or '.join(map(repr, MOST_ITERATIONS))}, but is {self.solver!r}")
        limit = MOST_ITERATIONS[self.solver] if self.max_iterations is None else self.max_iterations
        if not isinstance(limit, int | np.integer) or limit < 1:
            raise SettingError(f"max_iterations must be a whole number of 1 or more, but is {limit!r}")
        object.__setattr__(self, "max_iterations", int(limit))
        if self.progress is not None and not callable(self.progress):
            raise SettingError(
                f"progress must be a function of iteration, energy and vertices, but is {self.progress!r}"
            )
        if self.start is not None and not hasattr(self.start, "map"):
            raise SettingError(f"start must be a stage of a restoration, as restored.stages[-1], but is {self.start!r}")


def solved(mesh: Mesh, terms, start, free, spacing, options: Options, where, adrift=False) -> Solution:
    """The mesh's vertices where the terms' energy is least.

    Parameters
    ----------
    adrift : bool
        Whether a rigid motion of all free vertices costs nothing.

    Raises
    ------
    FlippedError
        If triangles are turned over at the end; it says how many and where the first is.
    """
    settings = (TOLERANCE * spacing, options.max_iterations, options.progress)
    if options.solver == GAUSS_NEWTON:
        return gauss_newton(terms, mesh.triangles, start, anchored(mesh) if adrift else free, *settings)
    solution = fixed_point(terms, start, free, *settings)
    flipped = np.flatnonzero(triangle_areas(solution.vertices, mesh.triangles) <= 0)
    if len(flipped):
        place = mesh.vertices[mesh.triangles[flipped[0]]].mean(axis=0)
        raise FlippedError(
            f"the {options.solver} solver has turned {len(flipped)} of {len(mesh.triangles)} triangles over, the first "
            f"near {where(place)}; use solver={GAUSS_NEWTON!r}, or ask for less",
            count=len(flipped),
        )
    return solution


def anchored(mesh: Mesh) -> np.ndarray:
    """Coordinates that may change where a rigid motion of the whole costs nothing, shape (n, 2): all but three.

    A vertex in the middle stays, and one far from it does not move round it. This takes nothing from any solution but
    its rigid motion. Damping alone would leave Gauss-Newton slow: the residuals that are vectors turn with the whole,
    so that J^T J sees a stiffness against turning which the energy does not have.
    """
    middle = np.argmin(np.hypot(*(mesh.vertices - np.average(mesh.vertices, axis=0, weights=vertex_masses(mesh))).T))
    arms = np.abs(mesh.vertices - mesh.vertices[middle])
    far = np.argmax(np.hypot(*arms.T))
    free = np.ones(mesh.vertices.shape, bool)
    free[middle] = False
    free[far, 1 if arms[far, 0] >= arms[far, 1] else 0] = False
    return free


def reusable_setup(earlier, fingerprint):
    """Mesh set-up cached by an identical earlier stage, or None."""
    return earlier.mesh_setup if earlier is not None and earlier.mesh_setup.fingerprint == fingerprint else None


def warm_start(mesh: Mesh, free, earlier) -> np.ndarray | None:
    """An earlier stage's deformation on this mesh, shape (n, 2); None if there is none, or it turns triangles over."""
    if earlier is None:
        return None
    if earlier.mesh_setup.mesh is mesh:
        moved = earlier.vertices[: len(mesh.vertices)].copy()  # a weld adds vertices behind the mesh's own
    else:
        moved = earlier.map.forward(mesh.vertices, _triangles_before(mesh, earlier))
    moved[~free] = mesh.vertices[~free]
    lost = ~np.isfinite(moved).all() or triangle_areas(moved, mesh.triangles).min() <= 0
    return None if lost else moved


def _triangles_before(mesh, earlier):
    """The triangle of an earlier stage's mesh that carries each vertex, -1 where there is none; shape (n,).

    It is looked for a little inside one of the vertex's own triangles: a vertex on a cut lies on that side of it. Where
    the rock now reaches beyond the earlier mesh, it is looked for farther inside, and carries what lies beside it.
    """
    corner = np.empty(len(mesh.vertices), int)
    corner[mesh.triangles.ravel()] = np.arange(mesh.triangles.size)
    inwards = mesh.vertices[mesh.triangles[corner // 3]].mean(axis=1) - mesh.vertices
    found = np.full(len(mesh.vertices), -1)
    for share in INWARDS:
        missing = np.flatnonzero(found < 0)
        if not len(missing):
            break
        found[missing] = earlier.map.source_finder(mesh.vertices[missing] + share * inwards[missing])
    return found


def nearest_rigid(rest, moved, masses) -> np.ndarray:
    """Positions after the rigid motion that brings them nearest to where they were (Procrustes), shape (n, 2)."""
    share = masses / masses.sum()
    centre, centre_moved = share @ rest, share @ moved
    a, b = moved - centre_moved, rest - centre
    sine = share @ (a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0])
    cosine = share @ np.sum(a * b, axis=1)
    length = np.hypot(sine, cosine)
    turn = np.array([[cosine, sine], [-sine, cosine]]) / length
    return a @ turn + centre


def vertex_masses(mesh: Mesh) -> np.ndarray:
    """A third of the area of the triangles at each vertex, shape (n,)."""
    return np.bincount(mesh.triangles.ravel(), np.repeat(mesh.areas / 3, 3), minlength=len(mesh.vertices))
