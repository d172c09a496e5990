"""Least squares solvers for the positions of a mesh's vertices."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from scipy.sparse import csc_array, tril, vstack

from seiswidgets.core.cholesky import Cholesky, Cholmod, NotPositiveDefinite, SuperLU
from seiswidgets.core.mesh import triangle_areas
from seiswidgets.core.normal_equations import NormalEquations
from seiswidgets.core.term import PaperTerm, Term
from seiswidgets.errors import Cancelled

LEAST_DAMPING, MOST_DAMPING = 1e-9, 1e6  # of the median diagonal; the least only tames motions that cost nothing
LEAST_BENDING = 0.1  # share of the second derivatives that is worth trying
HALVINGS = 5
ROUNDING = 1e-11  # of an energy: changes below this are noise
IDLE, IDLE_STEPS, IDLE_MOVE = 1e-9, 5, 100  # share of the energy, number of steps that gain less, their tolerances
SLOW = 0.8  # share of the energy left by a step: above it, much of the residual will remain

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
        True if the last full step moved no vertex by more than the tolerance, or the last few steps hardly more than
        that and without any gain.
    energies : tuple of float
        The energy at the start and after each iteration.
    """

    vertices: np.ndarray
    terms: Sequence[Term]
    iterations: int
    factorisations: int
    converged: bool
    energies: tuple[float, ...]


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


def first_flip(vertices: np.ndarray, step: np.ndarray, triangles: np.ndarray) -> float:
    """Share of a step at which the first triangle loses all its area, or infinity if none does.

    A triangle's area along a straight step is a quadratic; this is the least positive root of all of them.
    """
    constant = triangle_areas(vertices, triangles)
    square = triangle_areas(step, triangles)
    linear = triangle_areas(vertices + step, triangles) - constant - square
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
) -> Solution:
    """Minimise the energy by damped Gauss-Newton steps that never turn a triangle over.

    After a step that has left most of the energy, the next one includes second derivatives and is Newton's (Fletcher
    and Xu, Hybrid methods for nonlinear least squares, 1987): Gauss-Newton alone is slow where residuals stay large.

    Where a vertex in contact lies at the corner between two segments, or a triangle at the barrier's onset, the second
    derivatives jump, and steps may alternate a little above the tolerance for ever. So the solver has also converged
    when five successive steps, none of them damped, have each moved no vertex by more than 100 times the tolerance and
    gained less than 1e-9 of the energy.

    Parameters
    ----------
    terms : list of terms
    triangles : array, shape (m, 3)
    start : array, shape (n, 2)
        Positions without a flipped triangle.
    free : array of bool, shape (n,) or (n, 2)
        The vertices that may move, or the coordinates that may change.
    tolerance : float
        Stop when a full step moves no vertex farther than this, in metres.
    progress : callable(iteration, energy, vertices), optional
        Called after each iteration; returning False cancels.

    Raises
    ------
    Cancelled
    """
    vertices, control = np.array(start, float), StepControl()
    terms = update_contacts(terms, vertices)
    equations = NormalEquations(terms, np.broadcast_to(free.reshape(len(free), -1), vertices.shape), vertices)
    left = residuals(terms, vertices)
    energies, converged, iteration, idle = [sum_of_squares(left)], False, 0, 0
    while not converged and iteration < max_iterations:
        equations.update(terms, vertices, left)
        curved = len(energies) > 1 and energies[-1] > SLOW * energies[-2]
        descent = _descend(equations, terms, vertices, energies[-1], triangles, control, tolerance, curved)
        if descent is None:
            break
        moved, left, full = descent
        move = _farthest(moved - vertices)
        vertices, iteration, before = moved, iteration + 1, terms
        terms = update_contacts(terms, vertices)
        left = [
            residual if term is old else term.residual(vertices)
            for term, old, residual in zip(terms, before, left, strict=True)
        ]
        energies.append(sum_of_squares(left))
        gained = energies[-1] < (1 - IDLE) * energies[-2]
        idle = 0 if gained or control.damping > LEAST_DAMPING or move > IDLE_MOVE * tolerance else idle + 1
        converged = (full and move <= tolerance) or idle == IDLE_STEPS
        _report_progress(progress, iteration, energies[-1], vertices)
    return Solution(vertices, terms, iteration, equations.factorisations, converged, tuple(energies))


@dataclass
class StepControl:
    """Safeguards of a step: damping, and the share of second derivatives that may make the matrix indefinite."""

    damping: float = LEAST_DAMPING
    bending: float = 1.0

    def make_convex(self) -> None:
        """React to a matrix that was not positive definite."""
        if self.bending > 0:
            self.bending = self.bending / 2 if self.bending > LEAST_BENDING else 0.0
        else:
            self.damp()

    def damp(self) -> None:
        """React to a step that did not lower the energy."""
        self.damping *= 100

    def relax(self) -> None:
        """React to a step that lowered the energy."""
        self.damping = max(self.damping / 10, LEAST_DAMPING)
        self.bending = min(3 * max(self.bending, LEAST_BENDING), 1.0)


def _descend(
    equations: NormalEquations,
    terms: Sequence[Term],
    vertices: np.ndarray,
    height: float,
    triangles: np.ndarray,
    control: StepControl,
    tolerance: float,
    curved: bool,
) -> tuple[np.ndarray, list[np.ndarray], bool] | None:
    """Step to less energy than ``height``, or return None if no step leads there.

    A step within the tolerance is accepted as it is: rounding would hide its gain.

    Returns
    -------
    vertices : array, shape (n, 2)
    residuals : list of array
    full : bool
        True for a whole step that was not damped.
    """
    allowed = height * (1 + ROUNDING)
    while control.damping <= MOST_DAMPING:
        try:
            step = equations.step(control.damping, control.bending if curved else None)
        except NotPositiveDefinite:
            control.make_convex() if curved else control.damp()
            continue
        undamped = control.damping == LEAST_DAMPING
        length = min(1.0, 0.9 * first_flip(vertices, step, triangles))
        settled = undamped and length == 1 and _farthest(step) <= tolerance
        for _ in range(HALVINGS):
            moved = vertices + length * step
            if settled or triangle_areas(moved, triangles).min() > 0:
                left = residuals(terms, moved)
                if settled or sum_of_squares(left) <= allowed:
                    control.relax()
                    return moved, left, undamped and length == 1
            length /= 2
        control.damp()
    return None


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
