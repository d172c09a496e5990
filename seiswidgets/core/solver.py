"""Least squares solvers for the positions of a mesh's vertices."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from scipy.sparse import csc_array, tril, vstack

from seiswidgets.core.cholesky import Cholesky, Cholmod, SuperLU
from seiswidgets.core.mesh import triangle_areas
from seiswidgets.core.normal_equations import NormalEquations, Springs
from seiswidgets.core.term import PaperTerm, Term
from seiswidgets.errors import Cancelled

SLOW = 0.8  # share of the energy left by a step: above it, the next step includes second derivatives
KEPT = 0.1  # of its area: a step leaves at least this much of each triangle
STIFFENINGS, STIFFNESS = 2, 3.0  # how often, and from what stiffness, triangles that would lose more are stiffened
SUFFICIENT = 1e-4  # of the decrease that the slope promises
HALVINGS = 12
ROUNDING = 1e-11  # of an energy: changes below this are noise
NEGLIGIBLE = 1e-8  # of the energy
GOOD, POOR = 0.75, 0.25  # actual over predicted decrease

Progress = Callable[[int, float, np.ndarray], bool | None]


@dataclass(frozen=True, eq=False)
class Solution:
    """Result of a solver.

    Attributes
    ----------
    vertices : array, shape (n, 2)
    terms : list of terms
        With the contacts of the last iteration.
    iterations, factorisations : int
    converged : bool
        True if the last step moved no vertex by more than the tolerance, and had nothing more to gain.
    energies : tuple of float
        The energy at the start and after each iteration.
    equations : NormalEquations, optional
        Kept for the next solution on the same triangles.
    """

    vertices: np.ndarray
    terms: Sequence[Term]
    iterations: int
    factorisations: int
    converged: bool
    energies: tuple[float, ...]
    equations: NormalEquations | None = None


def energy(terms: Sequence[Term], vertices: np.ndarray) -> float:
    """Sum of the squared residuals of all terms, in square metres."""
    return sum_of_squares(residuals(terms, vertices))


def residuals(terms: Sequence[Term], vertices: np.ndarray) -> list[np.ndarray]:
    """Residual of each term, in metres times its weight."""
    return [term.residual(vertices) for term in terms]


def sum_of_squares(vectors: Sequence[np.ndarray]) -> float:
    """Sum of the squares of all entries of some vectors."""
    return float(sum(np.vdot(vector, vector) for vector in vectors))


def update_contacts(terms: Sequence[Term], vertices: np.ndarray) -> list[Term]:
    """Choose the contacts of all terms again, for these positions."""
    return [term.with_contacts(vertices) for term in terms]


def first_flip(vertices: np.ndarray, step: np.ndarray, triangles: np.ndarray, kept: float = 0.0) -> float:
    """Share of a step at which the first triangle keeps only a share of its area, or infinity if none does.

    A triangle's area along a straight step is a quadratic; this is the least positive root of all of them.
    """
    areas = triangle_areas(vertices, triangles)
    square = triangle_areas(step, triangles)
    linear = triangle_areas(vertices + step, triangles) - areas - square
    constant = (1 - kept) * areas
    root = np.full(len(triangles), np.inf)
    discriminant = linear**2 - 4 * square * constant
    falls = (discriminant >= 0) & ((linear < 0) | (square < 0))
    # this form of the root does not cancel, and holds for a vanishing square term
    root[falls] = 2 * constant[falls] / (-linear[falls] + np.sqrt(discriminant[falls]))
    return float(np.min(np.where(root > 0, root, np.inf), initial=np.inf))


def gauss_newton(
    terms: Sequence[Term],
    triangles: np.ndarray,
    start: np.ndarray,
    free: np.ndarray,
    tolerance: float,
    max_iterations: int = 200,
    progress: Progress | None = None,
    equations: NormalEquations | None = None,
) -> Solution:
    """Minimise the energy by Gauss-Newton and Newton steps that never turn a triangle over.

    Gauss-Newton is fast until the residuals that must remain dominate. After a step that has left most of the energy,
    the next one includes the second derivatives of all terms, within a trust region.

    Few triangles, such as those at the tip of a fault, may lose all their area long before the rest has arrived. They
    are made stiffer for this step and the next ones, so that they turn and shift with their surroundings; only what
    remains to be limited shortens the whole step.

    Parameters
    ----------
    terms : list of terms
    triangles : array, shape (m, 3)
    start : array, shape (n, 2)
        Positions without a flipped triangle.
    free : array of bool, shape (n,) or (n, 2)
        The vertices that may move, or the coordinates that may change.
    tolerance : float
        Stop when a step moves no vertex farther than this, in metres, unless it was shortened and would still lower the
        energy noticeably.
    progress : callable(iteration, energy, vertices), optional
        Called after each iteration; returning False cancels.
    equations : NormalEquations, optional
        Those of an earlier solution on the same triangles, whose pattern and its analysis are used again.

    Raises
    ------
    Cancelled
    """
    vertices = np.array(start, float)
    terms = update_contacts(terms, vertices)
    renew = equations.renewed if equations else NormalEquations
    equations = renew(terms, np.broadcast_to(free.reshape(len(free), -1), vertices.shape), vertices)
    left = residuals(terms, vertices)
    energies, converged, iteration = [sum_of_squares(left)], False, 0
    stepper = Stepper(equations, triangles)
    while not converged and iteration < max_iterations:
        equations.update(terms, vertices, left)
        step = stepper.step(vertices, curved=len(energies) > 1 and energies[-1] > SLOW * energies[-2])
        descent = _search_line(step, vertices, terms, triangles, energies[-1], tolerance)
        if descent is None:
            break
        length, left = descent
        stepper.adapt(step, length, energies[-1] - sum_of_squares(left))
        converged = step.settles(length, tolerance, energies[-1])
        vertices, iteration, before = vertices + length * step.vector, iteration + 1, terms
        terms = update_contacts(terms, vertices)
        left = [
            residual if term is old else term.residual(vertices)
            for term, old, residual in zip(terms, before, left, strict=True)
        ]
        energies.append(sum_of_squares(left))
        _report_progress(progress, iteration, energies[-1], vertices)
    return Solution(vertices, terms, iteration, equations.factorisations, converged, tuple(energies), equations)


@dataclass(frozen=True, eq=False)
class Step:
    """A step, before its length is chosen.

    Attributes
    ----------
    vector : array, shape (n, 2)
    slope : float
        Derivative of the energy along it.
    norm : float
        Its length in the solver's own norm, infinite for a Gauss-Newton step.
    limited : bool
        True if the trust region limits it.
    """

    vector: np.ndarray
    slope: float
    norm: float = np.inf
    limited: bool = False

    @property
    def farthest(self) -> float:
        """Largest change of a coordinate."""
        return _farthest(self.vector)

    def settles(self, length: float, tolerance: float, energy: float) -> bool:
        """Test if nothing moves noticeably by this step, and nothing more is to be gained."""
        if self.farthest <= tolerance and not self.limited:
            return True
        return length * self.farthest <= tolerance and -self.slope <= NEGLIGIBLE * energy


class Stepper:
    """Maker of steps, with what it has learnt from the steps before: stiff triangles, and the trust region's radius."""

    def __init__(self, equations: NormalEquations, triangles: np.ndarray):
        self._equations, self._triangles = equations, triangles
        self._edges = triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2)
        self._stiffness = np.zeros(len(triangles))
        self._radius = np.inf

    def step(self, vertices: np.ndarray, *, curved: bool) -> Step:
        """Factorise and solve, again if triangles have to be stiffened."""
        least = KEPT * triangle_areas(vertices, self._triangles)
        for remaining in reversed(range(STIFFENINGS + 1)):
            self._equations.factorise(self._springs, curved=curved)
            vector = self._equations.step()
            collapsing = triangle_areas(vertices + vector, self._triangles) < least
            if not remaining or not collapsing.any():
                break
            self._stiffness[collapsing] = np.maximum(10 * self._stiffness[collapsing], STIFFNESS)
        if not curved:
            return Step(vector, self._equations.slope(vector))
        vector, norm, limited = self._equations.newton_step(self._radius)
        return Step(vector, self._equations.slope(vector), norm, limited)

    @property
    def _springs(self) -> Springs | None:
        stiff = np.repeat(self._stiffness > 0, 3)
        return Springs(self._edges[stiff], np.repeat(self._stiffness, 3)[stiff]) if stiff.any() else None

    def adapt(self, step: Step, length: float, gained: float) -> None:
        """Learn from a step's length and gain."""
        self._stiffness *= 0.1
        self._stiffness[self._stiffness < 1e-3] = 0
        promised = -0.5 * step.slope  # what a quadratic model gains by its full step
        if not np.isfinite(step.norm):
            return
        if length != 1:
            self._radius = length * step.norm
        elif gained < POOR * promised:
            self._radius = 0.5 * step.norm
        elif gained > GOOD * promised and step.limited:
            self._radius = 4 * step.norm


def _search_line(
    step: Step, vertices: np.ndarray, terms: Sequence[Term], triangles: np.ndarray, height: float, tolerance: float
) -> tuple[float, list[np.ndarray]] | None:
    """Find a length of the step that lowers the energy, and the residuals there; None if there is none.

    A step within the tolerance is accepted as it is: rounding would hide its gain. A full step that gains is doubled
    as long as it gains more.
    """

    def evaluate(length: float) -> tuple[float, list[np.ndarray]]:
        moved = vertices + length * step.vector
        if triangle_areas(moved, triangles).min() <= 0:
            return np.inf, []
        left = residuals(terms, moved)
        return sum_of_squares(left), left

    longest = first_flip(vertices, step.vector, triangles, KEPT)
    length = min(1.0, longest)
    reached, left = evaluate(length)
    if length == 1 and step.farthest <= tolerance:
        return length, left
    for _ in range(HALVINGS):
        if reached <= height * (1 + ROUNDING) + SUFFICIENT * length * step.slope:
            break
        length /= 2
        reached, left = evaluate(length)
    else:
        return None
    while length >= 1 and 2 * length <= longest:
        farther, more = evaluate(2 * length)
        if farther >= reached - 0.1 * (height - reached):
            break
        length, reached, left = 2 * length, farther, more
    return length, left


def _farthest(step: np.ndarray) -> float:
    return float(np.max(np.abs(step), initial=0))


def fixed_point(
    terms: Sequence[Term],
    start: np.ndarray,
    free: np.ndarray,
    tolerance: float,
    max_iterations: int = 1000,
    progress: Progress | None = None,
) -> Solution:
    """Minimise the energy by the paper's solver (eq. 16): the targets lag behind, the matrix is factorised once.

    Kept for teaching and comparison: it is slow, its block hardly slides since the targets pin the fault's vertices
    to their projections, and nothing keeps its triangles from turning over.

    Parameters and result are those of `gauss_newton`; only the paper's own terms take part, not the area barrier.
    """
    vertices = np.array(start, float)
    paper_terms = [term.with_contacts(vertices) for term in terms if isinstance(term, PaperTerm)]
    matrix = vstack([term.rows for term in paper_terms], format="csc")
    unknown, held = matrix[:, free], matrix[:, ~free] @ vertices[~free]
    factor = _normal_factor(unknown)
    energies, converged, iteration = [energy(paper_terms, vertices)], False, 0
    while not converged and iteration < max_iterations:
        targets = np.concatenate([term.target(vertices) for term in paper_terms])
        moved = vertices.copy()
        moved[free] = factor.solve(unknown.T @ (targets - held))
        converged = _farthest(moved - vertices) <= tolerance
        vertices, iteration = moved, iteration + 1
        paper_terms = [term.with_contacts(vertices) for term in paper_terms]
        energies.append(energy(paper_terms, vertices))
        _report_progress(progress, iteration, energies[-1], vertices)
    return Solution(vertices, paper_terms, iteration, 1, converged, tuple(energies))


def _normal_factor(matrix: csc_array) -> Cholmod | SuperLU:
    lower = tril(matrix.T @ matrix, format="csc")
    lower.sort_indices()
    diagonal = lower.diagonal()
    lower.setdiag(diagonal + 1e-12 * diagonal.max(initial=1))  # for parts that no term holds
    factor = Cholesky(lower.indices, lower.indptr)
    factor.factorise(lower.data)
    return factor


def _report_progress(progress: Progress | None, iteration: int, energy: float, vertices: np.ndarray) -> None:
    if progress is not None and progress(iteration, energy, vertices.copy()) is False:
        raise Cancelled(f"cancelled after iteration {iteration}")
