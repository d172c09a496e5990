"""Least squares solvers for the positions of a mesh's vertices."""

from dataclasses import dataclass

import numpy as np
from scipy.sparse import tril, vstack

from seiswidgets.core.cholesky import Cholesky, NotPositiveDefinite
from seiswidgets.core.mesh import triangle_areas
from seiswidgets.core.normal_equations import NormalEquations
from seiswidgets.core.terms import MOVING
from seiswidgets.errors import Cancelled

LEAST_DAMPING, MOST_DAMPING = 1e-9, 1e6  # of the median diagonal; the least only tames motions that cost nothing
LEAST_BENDING = 0.1  # share of the second derivatives that is worth a try
HALVINGS = 5
ROUNDING = 1e-11  # of an energy: changes below this are noise
IDLE, IDLE_STEPS, IDLE_MOVE = 1e-9, 5, 100  # share of the energy, steps that gain less, and their size in tolerances
SLOW = 0.8  # share of the energy left by a step: with more, much of the residual is there to stay


@dataclass(frozen=True, eq=False)
class Solution:
    """Where a solver ended.

    Attributes
    ----------
    vertices : array, shape (n, 2)
    terms : list of terms, the moving ones as they were held at the end
    iterations, factorisations : int
    converged : bool
        Whether the last full step moved no vertex by more than the tolerance, or the last few steps hardly more than
        that and without any gain.
    energies : tuple of float
        The energy at the start and after each iteration.
    """

    vertices: np.ndarray
    terms: list
    iterations: int
    factorisations: int
    converged: bool
    energies: tuple


def energy(terms, vertices) -> float:
    """The sum of the squared residuals of all terms, in square metres."""
    return squared(residuals(terms, vertices))


def residuals(terms, vertices) -> list[np.ndarray]:
    """What each term leaves, in metres times its weight."""
    return [term.residual(vertices) for term in terms]


def squared(left) -> float:
    """The energy of some residuals."""
    return float(sum(np.vdot(residual, residual) for residual in left))


def update_contacts(terms, vertices):
    """The terms, with the partners of the moving ones chosen anew."""
    return [term.at(vertices) if term.pattern == MOVING else term for term in terms]


def first_flip(vertices, step, triangles) -> float:
    """The share of a step at which the first triangle has no area left; infinity if none ever comes to that.

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


def gauss_newton(terms, triangles, start, free, tolerance, max_iterations=200, progress=None) -> Solution:
    """Minimise the energy by damped Gauss-Newton steps that never turn a triangle over.

    Where a step has left most of the energy, the next takes second derivatives in as well and is Newton's (Fletcher and
    Xu, Hybrid methods for nonlinear least squares, 1987): Gauss-Newton alone gets slow where residuals stay large.

    Where a vertex in contact lies at the corner between two segments, or a triangle at the barrier's onset, the second
    derivatives jump, and steps may go to and fro a little above the tolerance for ever. So it has settled too when five
    steps in turn, none of them damped, have moved no vertex by more than 100 times the tolerance and gained less
    than 1e-9 of the energy each.

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
    vertices, caution = np.array(start, float), Caution()
    terms = update_contacts(terms, vertices)
    equations = NormalEquations(terms, np.broadcast_to(free.reshape(len(free), -1), vertices.shape), vertices)
    left = residuals(terms, vertices)
    energies, converged, iteration, idle = [squared(left)], False, 0, 0
    while not converged and iteration < max_iterations:
        equations.at(terms, vertices, left)
        curved = len(energies) > 1 and energies[-1] > SLOW * energies[-2]
        found = _descent(equations, terms, vertices, energies[-1], triangles, caution, tolerance, curved)
        if found is None:
            break
        moved, left, full = found
        move = _farthest(moved - vertices)
        vertices, iteration, before = moved, iteration + 1, terms
        terms = update_contacts(terms, vertices)
        left = [
            residual if term is old else term.residual(vertices)
            for term, old, residual in zip(terms, before, left, strict=True)
        ]
        energies.append(squared(left))
        gained = energies[-1] < (1 - IDLE) * energies[-2]
        idle = 0 if gained or caution.damping > LEAST_DAMPING or move > IDLE_MOVE * tolerance else idle + 1
        converged = (full and move <= tolerance) or idle == IDLE_STEPS
        _report(progress, iteration, energies[-1], vertices)
    return Solution(vertices, terms, iteration, equations.factorisations, converged, tuple(energies))


@dataclass
class Caution:
    """How a step is kept safe: by damping, and by taking less of the second derivatives that could be negative."""

    damping: float = LEAST_DAMPING
    bending: float = 1.0

    def more_convex(self):
        """After a matrix that was not positive definite."""
        if self.bending > 0:
            self.bending = self.bending / 2 if self.bending > LEAST_BENDING else 0.0
        else:
            self.shorter()

    def shorter(self):
        """After a step that did not lower the energy."""
        self.damping *= 100

    def less(self):
        """After a step that did."""
        self.damping = max(self.damping / 10, LEAST_DAMPING)
        self.bending = min(3 * max(self.bending, LEAST_BENDING), 1.0)


def _descent(equations, terms, vertices, height, triangles, caution, tolerance, curved):
    """The vertices after a step to less energy than this height, what the terms leave there, and if it was full.

    Full is a whole step that was not damped. None if no step leads to less. A step within the tolerance is taken as
    it is: rounding would hide what it gains.
    """
    allowed = height * (1 + ROUNDING)
    while caution.damping <= MOST_DAMPING:
        try:
            step = equations.step(caution.damping, caution.bending if curved else None)
        except NotPositiveDefinite:
            caution.more_convex() if curved else caution.shorter()
            continue
        undamped = caution.damping == LEAST_DAMPING
        length = min(1.0, 0.9 * first_flip(vertices, step, triangles))
        settled = undamped and length == 1 and _farthest(step) <= tolerance
        for _ in range(HALVINGS):
            moved = vertices + length * step
            if settled or triangle_areas(moved, triangles).min() > 0:
                left = residuals(terms, moved)
                if settled or squared(left) <= allowed:
                    caution.less()
                    return moved, left, undamped and length == 1
            length /= 2
        caution.shorter()
    return None


def _farthest(step):
    return float(np.max(np.abs(step), initial=0))


def fixed_point(terms, start, free, tolerance, max_iterations=1000, progress=None) -> Solution:
    """The paper's solver (eq. 16): the targets lag behind, the matrix is factorised once.

    Kept for teaching and comparison: it is slow, its block hardly slides since the targets pin the fault's vertices
    where they were projected to, and nothing keeps its triangles from turning over.

    Parameters and result are those of ``gauss_newton``; terms without ``rows`` (the area barrier) take no part.
    """
    vertices = np.array(start, float)
    terms = update_contacts([term for term in terms if hasattr(term, "rows")], vertices)
    matrix = vstack([term.rows for term in terms], format="csc")
    unknown, held = matrix[:, free], matrix[:, ~free] @ vertices[~free]
    factor = _normal_factor(unknown)
    energies, converged, iteration = [energy(terms, vertices)], False, 0
    while not converged and iteration < max_iterations:
        targets = np.concatenate([term.target(vertices) for term in terms])
        moved = vertices.copy()
        moved[free] = factor.solve(unknown.T @ (targets - held))
        converged = _farthest(moved - vertices) <= tolerance
        vertices, iteration = moved, iteration + 1
        terms = update_contacts(terms, vertices)
        energies.append(energy(terms, vertices))
        _report(progress, iteration, energies[-1], vertices)
    return Solution(vertices, terms, iteration, 1, converged, tuple(energies))


def _normal_factor(matrix):
    lower = tril(matrix.T @ matrix, format="csc")
    lower.sort_indices()
    diagonal = lower.diagonal()
    lower.setdiag(diagonal + 1e-12 * diagonal.max(initial=1))  # for parts that nothing holds
    factor = Cholesky(lower.indices, lower.indptr)
    factor.factorise(lower.data)
    return factor


def _report(progress, iteration, energy, vertices):
    if progress is not None and progress(iteration, energy, vertices.copy()) is False:
        raise Cancelled(f"cancelled after iteration {iteration}")
