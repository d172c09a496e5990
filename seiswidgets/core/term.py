"""The interface of the energy's terms."""

from collections.abc import Sequence
from dataclasses import fields, is_dataclass
from typing import Protocol, Self, runtime_checkable

import numpy as np
from scipy.sparse import csr_array

# How a term's Jacobian changes as the vertices move
STEADY = "steady"  # its pattern never changes
CONSTANT = "constant"  # its values never change either
MOVING = "moving"  # its pattern follows the vertices

Layer = tuple[np.ndarray, np.ndarray]


class Term(Protocol):
    """A term of the energy: a function of the positions of all vertices, shape (n, 2), in metres.

    A term multiplies its residual by its weight, as in the paper's eq. 14.
    """

    @property
    def name(self) -> str:
        """Name in reports; several terms may share it."""

    @property
    def pattern(self) -> str:
        """One of STEADY, CONSTANT and MOVING."""

    def residual(self, vertices: np.ndarray) -> np.ndarray:
        """The vector whose squared length is the term's energy."""

    def jacobian(self, vertices: np.ndarray) -> csr_array:
        """Derivative of the residual, with columns x0, z0, x1, z1, ..."""

    def curvature(self, vertices: np.ndarray) -> Sequence[Layer]:
        """Contribution of the residual's second derivatives, empty if they are zero or left out.

        Returns
        -------
        list of (data, factor)
            Entries of rows with the Jacobian's pattern, and a factor for each row, such that the sum of factor times
            row times row is the sum of residual times its Hessian.
        """
        return ()

    def with_contacts(self, vertices: np.ndarray) -> Self:
        """The term with its contacts chosen for these positions; the term itself if it has none."""
        return self


@runtime_checkable
class PaperTerm(Term, Protocol):
    """A term of the paper, which its fixed point (eq. 16) can use."""

    @property
    def rows(self) -> csr_array:
        """Matrix over vertices."""

    def target(self, vertices: np.ndarray) -> np.ndarray:
        """The lagged target that ``rows @ vertices`` is pulled to."""


def same_terms(terms: Sequence[Term], earlier: Sequence[Term]) -> list[Term]:
    """Replace terms by equal ones of an earlier solution, which know their rows already."""
    return [next((known for known in earlier if _are_same(known, term)), term) for term in terms]


def _are_same(one: Term, other: Term) -> bool:
    """Return whether two terms have the same values; arrays must be the same objects."""
    if type(one) is not type(other) or not is_dataclass(one):
        return False
    pairs = [(getattr(one, field.name), getattr(other, field.name)) for field in fields(one)]
    return all(a is b or (isinstance(a, float | int | str) and a == b) for a, b in pairs)
