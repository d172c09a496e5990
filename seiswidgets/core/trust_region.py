"""Truncated Newton steps: conjugate gradients on the exact second derivatives, within a trust region."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

ACCURACY = 1e-2  # of the gradient, in the norm of the preconditioner's inverse
MOST_PRODUCTS = 30

Operator = Callable[[np.ndarray], np.ndarray]


@dataclass(frozen=True, eq=False)
class TruncatedStep:
    """A step towards the minimum of a quadratic model.

    Attributes
    ----------
    step : array, shape (n,)
    norm : float
        Its length in the preconditioner's norm.
    limited : bool
        True if it ends at the border of the trust region, or where the model began to curve downwards.
    """

    step: np.ndarray
    norm: float
    limited: bool


def truncated_newton(gradient: np.ndarray, hessian: Operator, precondition: Operator, radius: float) -> TruncatedStep:
    """Minimise gradient . s + s . hessian(s) / 2 within a radius by Steihaug's conjugate gradients.

    T. Steihaug, The conjugate gradient method and trust regions in large scale optimization, 1983. The Hessian may be
    indefinite: along a direction of negative curvature the step goes to the border of the region; if that is
    unlimited, it stops before the direction.

    Parameters
    ----------
    gradient : array, shape (n,)
    hessian : callable
        Product of the Hessian with a vector.
    precondition : callable
        Product of a positive definite approximation's inverse with a vector.
    radius : float
        In the norm of that approximation; may be infinite.
    """
    step, left = np.zeros_like(gradient), gradient.copy()
    along = -precondition(left)
    slope = start = float(-left @ along)
    inside, cross, ahead = 0.0, 0.0, slope  # products in the norm: step . step, step . along, along . along
    for count in range(MOST_PRODUCTS if start > 0 else 0):
        product = hessian(along)
        curvature = float(along @ product)
        if curvature <= 0 and np.isinf(radius):
            return TruncatedStep(step if count else along, float(np.sqrt(inside if count else ahead)), limited=True)
        share = slope / curvature if curvature > 0 else 0.0
        if curvature <= 0 or inside + 2 * share * cross + share**2 * ahead >= radius**2:
            share = (np.sqrt(max(cross**2 + ahead * (radius**2 - inside), 0)) - cross) / ahead
            return TruncatedStep(step + share * along, radius, limited=True)
        step, left = step + share * along, left + share * product
        inside += 2 * share * cross + share**2 * ahead
        raised = precondition(left)
        before, slope = slope, float(left @ raised)
        if slope <= ACCURACY**2 * start:
            break
        turn = slope / before
        along, cross, ahead = turn * along - raised, turn * (cross + share * ahead), slope + turn**2 * ahead
    return TruncatedStep(step, float(np.sqrt(inside)), limited=False)
