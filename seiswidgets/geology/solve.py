"""Solving a stage: the solver's options, where it starts, and the refusal of flipped triangles."""

from collections.abc import Callable, Sequence
from dataclasses import asdict, dataclass, field, replace
from typing import TypedDict, TypeGuard, TypeVar

import numpy as np

from seiswidgets.core.mesh import Mesh, triangle_areas
from seiswidgets.core.point_location import TriangleFinder
from seiswidgets.core.solver import Progress, Solution, fixed_point, gauss_newton
from seiswidgets.core.term import Term, same_terms
from seiswidgets.errors import FlippedError, Keyword, SettingError
from seiswidgets.geology import validation
from seiswidgets.geology.domain import RestorationDomain
from seiswidgets.geology.stage import MeshSetup, Stage
from seiswidgets.geology.weights import Weights
from seiswidgets.signatures import check_keywords

GAUSS_NEWTON, FIXED_POINT = "gauss-newton", "fixed-point"
NORMS, ROWS = "norms", "rows"
WEIGHTINGS = {GAUSS_NEWTON: ROWS, FIXED_POINT: NORMS}
SETTLED = 0.01  # of the slack: a thousandth of a sample
TOLERANCE = 1e-6  # of the mesh spacing, for the fixed point, whose steps are short far from its end
INWARDS = 1e-3, 0.1, 0.5  # shares of the distance to a triangle's centre
SetupT = TypeVar("SetupT", bound=MeshSetup)
MOST_ITERATIONS = {GAUSS_NEWTON: 200, FIXED_POINT: 1000}


class SolverKeywords(TypedDict, total=False):
    """The keyword arguments of `SolverOptions`."""

    weights: Weights
    solver: str
    weighting: str | None
    max_iterations: int | None
    progress: Callable[[int, float, np.ndarray], bool | None] | None
    start: Stage | None


@dataclass(frozen=True)
class SolverOptions:
    """Keyword arguments that `Restoration.unfault` and `Restoration.flatten` share.

    Parameters
    ----------
    weights : Weights, optional
        Those of the paper if left out.
    solver : {"gauss-newton", "fixed-point"}
        The second is the paper's (eq. 16), kept for teaching and comparison.
    weighting : {"norms", "rows"}, optional
        What the weights multiply: the squared norm of each term, as in the paper's eqs. 12 and 13, or its rows, as in
        its eq. 14, where a weight of 10 counts as 100. By default rows for Gauss-Newton, and for the fixed point norms,
        with which it is far better.
    max_iterations : int, optional
        By default 200 Gauss-Newton steps, or 1000 of the fixed point. A solver that has not settled by then says so in
        the report.
    progress : callable(iteration, energy, vertices), optional
        Called after each iteration; returning False cancels.
    start : Stage, optional
        An earlier solution of a similar problem, to start from.

    Raises
    ------
    SettingError
        If one of them is out of its range.
    """

    weights: Weights = field(default_factory=Weights)
    solver: str = GAUSS_NEWTON
    max_iterations: int | None = None
    progress: Progress | None = None
    start: Stage | None = None
    weighting: str | None = None

    @classmethod
    def from_keywords(cls, function: str, keywords: SolverKeywords) -> "SolverOptions":
        """Validate the keyword arguments of a function; a misspelt one is a TypeError."""
        check_keywords(function, keywords, SolverKeywords.__annotations__)
        if keywords.get("weights") is None:
            keywords["weights"] = Weights()
        return cls(**keywords)

    def __post_init__(self) -> None:
        if not isinstance(self.weights, Weights):
            raise SettingError(f"weights must be a seiswidgets.Weights, but is {self.weights!r}")
        if self.solver not in tuple(MOST_ITERATIONS):
            raise SettingError(f"solver must be {' or '.join(map(repr, MOST_ITERATIONS))}, but is {self.solver!r}")
        if self.weighting not in (None, NORMS, ROWS):
            raise SettingError(f"weighting must be {NORMS!r} or {ROWS!r}, but is {self.weighting!r}")
        if self.max_iterations is not None:
            validation.whole_number("max_iterations", self.max_iterations, least=1)
        if self.progress is not None and not callable(self.progress):
            raise SettingError(
                f"progress must be a function of iteration, energy and vertices, but is {self.progress!r}"
            )
        if self.start is not None and not isinstance(self.start, Stage):
            raise SettingError(f"start must be a stage of a restoration, as restored.stages[-1], but is {self.start!r}")

    @property
    def row_weights(self) -> Weights:
        """Factors of the rows of each term."""
        if (self.weighting or WEIGHTINGS[self.solver]) == ROWS:
            return self.weights
        return Weights(**{name: weight**0.5 for name, weight in asdict(self.weights).items()})

    @property
    def iteration_limit(self) -> int:
        """Largest number of iterations."""
        return MOST_ITERATIONS[self.solver] if self.max_iterations is None else int(self.max_iterations)


def minimise(
    mesh: Mesh,
    terms: Sequence[Term],
    start: np.ndarray,
    free: np.ndarray,
    domain: RestorationDomain,
    options: SolverOptions,
    *,
    adrift: bool = False,
) -> Solution:
    """Move the mesh's vertices to where the terms' energy is least.

    Parameters
    ----------
    mesh : Mesh
    terms : list of terms
    start : array, shape (n, 2)
    free : array of bool, shape (n,)
        The vertices that may move.
    domain : RestorationDomain
    options : SolverOptions
    adrift : bool
        True if a rigid motion of all free vertices costs nothing.

    Raises
    ------
    FlippedError
        If triangles are turned over at the end; it says how many and where the first is.
    """
    limits = options.iteration_limit, options.progress
    if options.solver == GAUSS_NEWTON:
        free = _anchor(mesh) if adrift else free
        earlier = options.start.outcome.solution if shares_mesh(options.start, mesh) else None
        equations = earlier.equations if earlier else None
        terms = same_terms(terms, earlier.terms) if earlier else terms
        solution = gauss_newton(terms, mesh.triangles, start, free, SETTLED * domain.slack, *limits, equations)
        return solution if domain.quick else replace(solution, equations=None)  # which are large
    solution = fixed_point(terms, start, free, TOLERANCE * domain.spacing, *limits)
    flipped = np.flatnonzero(triangle_areas(solution.vertices, mesh.triangles) <= 0)
    if len(flipped):
        centre = mesh.vertices[mesh.triangles[flipped[0]]].mean(axis=0)
        raise FlippedError(
            f"the {options.solver} solver has turned {len(flipped)} of {len(mesh.triangles)} triangles over, the first "
            f"near {domain.where(centre)}; use ",
            Keyword("solver", GAUSS_NEWTON),
            ", or restore less in one step",
            count=len(flipped),
            where=domain.position(centre),
        )
    return solution


def _anchor(mesh: Mesh) -> np.ndarray:
    """Coordinates that may change where a rigid motion of the whole costs nothing, shape (n, 2): all but three.

    A vertex in the middle stays, and one far from it does not move around it. This removes only the rigid motion from
    the solution. Damping alone would leave Gauss-Newton slow: residuals that are vectors turn with the whole, so that
    J^T J has a stiffness against turning that the energy does not have.
    """
    centre = np.average(mesh.vertices, axis=0, weights=mesh.vertex_areas)
    middle = np.argmin(np.hypot(*(mesh.vertices - centre).T))
    arms = np.abs(mesh.vertices - mesh.vertices[middle])
    far = np.argmax(np.hypot(*arms.T))
    free = np.ones(mesh.vertices.shape, bool)
    free[middle] = False
    free[far, 1 if arms[far, 0] >= arms[far, 1] else 0] = False
    return free


def reusable_setup(earlier: Stage | None, setup: type[SetupT], fingerprint: tuple) -> SetupT | None:
    """Mesh set-up cached by an identical earlier stage, or None."""
    if earlier is None or not isinstance(earlier.mesh_setup, setup):
        return None
    return earlier.mesh_setup if earlier.mesh_setup.fingerprint == fingerprint else None


def shares_mesh(earlier: Stage | None, mesh: Mesh) -> TypeGuard[Stage]:
    """Return whether an earlier stage has the same triangles, perhaps with their vertices elsewhere."""
    return earlier is not None and earlier.mesh_setup.mesh.triangles is mesh.triangles


def warm_start(mesh: Mesh, free: np.ndarray, earlier: Stage | None) -> np.ndarray | None:
    """An earlier stage's deformation on this mesh, shape (n, 2); None if there is none, or it turns triangles over."""
    if earlier is None:
        return None
    if earlier.mesh_setup.mesh is mesh:
        moved = earlier.vertices[: len(mesh.vertices)].copy()  # welding adds vertices behind the mesh's own
    elif shares_mesh(earlier, mesh):
        moved = mesh.vertices + earlier.vertices[: len(mesh.vertices)] - earlier.mesh_setup.mesh.vertices
    else:
        moved = earlier.map.forward(mesh.vertices, triangles_inside(mesh, earlier.map.source_finder))
    moved[~free] = mesh.vertices[~free]
    unusable = ~np.isfinite(moved).all() or triangle_areas(moved, mesh.triangles).min() <= 0
    return None if unusable else moved


def triangles_inside(mesh: Mesh, finder: TriangleFinder) -> np.ndarray:
    """The triangle of another mesh that carries each vertex, -1 where there is none; shape (n,).

    The search starts a little inside one of the vertex's own triangles: a vertex on a cut lies on that side of it.
    Where the rock reaches beyond the other mesh, the search goes farther inside.
    """
    corner = np.empty(len(mesh.vertices), int)
    corner[mesh.triangles.ravel()] = np.arange(mesh.triangles.size)
    inwards = mesh.vertices[mesh.triangles[corner // 3]].mean(axis=1) - mesh.vertices
    triangles = np.full(len(mesh.vertices), -1)
    for share in INWARDS:
        missing = np.flatnonzero(triangles < 0)
        if not len(missing):
            break
        triangles[missing] = finder(mesh.vertices[missing] + share * inwards[missing])
    return triangles
