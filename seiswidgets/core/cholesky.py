"""Sparse Cholesky factorisations of one pattern with many numbers.

CHOLMOD, by way of cvxopt, analyses a pattern once and is several times faster; it is used where it is installed (the
extra ``fast``). SciPy's SuperLU needs nothing more and serves elsewhere.
"""

import warnings

import numpy as np
from scipy.sparse import csc_array
from scipy.sparse.linalg import MatrixRankWarning, splu

try:
    import cvxopt
    import cvxopt.amd
    import cvxopt.cholmod
except ImportError:
    cvxopt = None


class NotPositiveDefinite(ArithmeticError):
    """The matrix has no Cholesky factor."""


class Cholmod:
    """Factorisations by CHOLMOD of symmetric matrices that share a pattern.

    Parameters
    ----------
    rows, pointers : arrays
        The lower triangle in compressed columns, rows in order.
    ordering : the ordering of an earlier, similar pattern, or None to find one.
    """

    def __init__(self, rows, pointers, ordering=None):
        columns = np.repeat(np.arange(len(pointers) - 1), np.diff(pointers))
        size = len(pointers) - 1
        self._matrix = cvxopt.spmatrix(1.0, rows, columns, (size, size))
        self.ordering = cvxopt.amd.order(self._matrix) if ordering is None else ordering
        self._factor = cvxopt.cholmod.symbolic(self._matrix, p=self.ordering)

    def factorise(self, numbers):
        """Take in the numbers of the lower triangle and factorise; NotPositiveDefinite if there is no factor."""
        self._matrix.V = cvxopt.matrix(numbers)
        try:
            cvxopt.cholmod.numeric(self._matrix, self._factor)
        except ArithmeticError:
            raise NotPositiveDefinite from None

    def solve(self, right):
        """The solution for one or several right-hand sides, shape (n,) or (n, k)."""
        columns = cvxopt.matrix(np.asarray(right, float))
        cvxopt.cholmod.solve(self._factor, columns)
        return np.array(columns).reshape(right.shape)


class SuperLU:
    """The same by SciPy's SuperLU, which analyses anew each time."""

    ordering = None

    def __init__(self, rows, pointers, ordering=None):
        self._rows, self._pointers = rows, pointers

    def factorise(self, numbers):
        lower = csc_array((numbers, self._rows, self._pointers))
        matrix = lower + lower.T
        matrix.setdiag(lower.diagonal())
        options = {"permc_spec": "MMD_AT_PLUS_A", "diag_pivot_thresh": 0.0, "options": {"SymmetricMode": True}}
        with warnings.catch_warnings():
            warnings.simplefilter("error", MatrixRankWarning)
            try:
                self._factor = splu(matrix.tocsc(), **options)
            except (RuntimeError, MatrixRankWarning):
                raise NotPositiveDefinite from None
        pivoted = (self._factor.perm_r != self._factor.perm_c).any()
        if pivoted or self._factor.U.diagonal().min(initial=1) <= 0:
            raise NotPositiveDefinite

    def solve(self, right):
        return self._factor.solve(np.asarray(right, float))


Cholesky = SuperLU if cvxopt is None else Cholmod
