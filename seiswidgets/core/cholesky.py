"""Sparse Cholesky factorisations of matrices that share a pattern.

CHOLMOD, through cvxopt, analyses a pattern once and is several times faster; it is used where it is installed (the
extra ``fast``). Otherwise SciPy's SuperLU serves.
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
    ordering : object, optional
        Elimination order of an earlier, similar pattern; found if left out.
    """

    def __init__(self, rows: np.ndarray, pointers: np.ndarray, ordering: object = None):
        columns = np.repeat(np.arange(len(pointers) - 1), np.diff(pointers))
        size = len(pointers) - 1
        self._matrix = cvxopt.spmatrix(1.0, rows, columns, (size, size))
        self.ordering = cvxopt.amd.order(self._matrix) if ordering is None else ordering
        self._factor = cvxopt.cholmod.symbolic(self._matrix, p=self.ordering)

    def factorise(self, values: np.ndarray) -> None:
        """Factorise the matrix with these values in its lower triangle; NotPositiveDefinite if there is no factor."""
        self._matrix.V = cvxopt.matrix(values)
        try:
            cvxopt.cholmod.numeric(self._matrix, self._factor)
        except ArithmeticError:
            raise NotPositiveDefinite from None

    def solve(self, right: np.ndarray) -> np.ndarray:
        """Solve for one or several right-hand sides, shape (n,) or (n, k)."""
        columns = cvxopt.matrix(np.asarray(right, float))
        cvxopt.cholmod.solve(self._factor, columns)
        return np.array(columns).reshape(right.shape)


class SuperLU:
    """The same by SciPy's SuperLU, which analyses the pattern again each time."""

    ordering = None

    def __init__(self, rows: np.ndarray, pointers: np.ndarray, ordering: object = None):
        self._rows, self._pointers = rows, pointers

    def factorise(self, values: np.ndarray) -> None:
        lower = csc_array((values, self._rows, self._pointers))
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

    def solve(self, right: np.ndarray) -> np.ndarray:
        return np.asarray(self._factor.solve(np.asarray(right, float)))


Cholesky: type[Cholmod] | type[SuperLU] = SuperLU if cvxopt is None else Cholmod
