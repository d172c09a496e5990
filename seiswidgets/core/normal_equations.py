"""The normal equations of a nonlinear least squares problem, assembled quickly again and again."""

from collections.abc import Sequence
from functools import cache

import numpy as np
from scipy.sparse import csr_array

from seiswidgets.core.cholesky import Cholesky
from seiswidgets.core.term import CONSTANT, MOVING, Layer, Term


class Gram:
    """Products of the entries of a Jacobian that add up to J^T J, and the key of each in its lower triangle.

    A key is column * size + row. Columns of J that are not among the unknowns are left out.

    Parameters
    ----------
    jacobian : csr_array
    unknown : array
        Index of the unknown of each column, -1 for none.
    size : int
        Number of unknowns.
    """

    def __init__(self, jacobian: csr_array, unknown: np.ndarray, size: int):
        self.first, self.second = _pairs_within_rows(jacobian.indptr)
        self._row = np.repeat(np.arange(jacobian.shape[0]), np.diff(jacobian.indptr))[self.first]
        one, other = unknown[jacobian.indices[self.first]], unknown[jacobian.indices[self.second]]
        inner = (one >= 0) & (other >= 0)
        if not inner.all():
            self.first, self.second, self._row = self.first[inner], self.second[inner], self._row[inner]
            one, other = one[inner], other[inner]
        self.keys = np.minimum(one, other) * size + np.maximum(one, other)

    def products(self, data: np.ndarray, factor: np.ndarray | None = None) -> np.ndarray:
        """Products of the entries ``data`` of J, one per key; those of J^T diag(factor) J with a factor."""
        products = data[self.first] * data[self.second]
        if factor is not None:
            products *= factor[self._row]
        return np.asarray(products)


def _distinct(keys: np.ndarray, size: int) -> tuple[np.ndarray, np.ndarray]:
    """The distinct keys in order, and the index of each key among them.

    The same as `np.unique`, but many times faster: rows and columns are short integers, for which NumPy uses a radix
    sort.
    """
    columns, rows = (part.astype(np.min_scalar_type(size)) for part in np.divmod(keys, max(size, 1)))
    order = np.lexsort((rows, columns))
    keys = keys[order]
    new = np.append(True, keys[1:] != keys[:-1])[: len(keys)]
    index = np.empty(len(keys), np.int64)
    index[order] = np.cumsum(new) - 1
    return keys[new], index


def _pairs_within_rows(pointers: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """All pairs of entries in the same row of a CSR matrix, each with itself too."""
    lengths = np.diff(pointers)
    firsts, seconds = [np.empty(0, np.int64)], [np.empty(0, np.int64)]
    for length in np.unique(lengths[lengths > 0]):
        one, other = _pairs(int(length))
        start = pointers[:-1][lengths == length].astype(np.int64)[:, None]
        firsts.append((start + one).ravel())
        seconds.append((start + other).ravel())
    return np.concatenate(firsts), np.concatenate(seconds)


@cache
def _pairs(length: int) -> tuple[np.ndarray, np.ndarray]:
    return np.triu_indices(length)


def _transposed_product(matrix: csr_array, vector: np.ndarray) -> np.ndarray:
    """J^T r for a CSR matrix; for a small J, SciPy's transpose takes longer than the product."""
    products = matrix.data * np.repeat(vector, np.diff(matrix.indptr))
    return np.bincount(matrix.indices, products, minlength=matrix.shape[1])


class NormalEquations:
    """Solver of (J^T J + B + damping) step = -J^T r for the unknown coordinates, at one position after another.

    B are the second derivatives of the terms (``curvature``): without them Gauss-Newton converges slowly where large
    residuals remain, as in a tight fold.

    The pattern of J^T J is found once for the terms whose Jacobians keep theirs, and widened only when a moving
    term needs a new entry; the matrix is then analysed again, in the same order of elimination.

    Parameters
    ----------
    terms : list of terms
    free : array of bool, shape (n, 2)
        The coordinates that may change.
    vertices : array, shape (n, 2)
        Any positions; they only set the size.
    """

    def __init__(self, terms: Sequence[Term], free: np.ndarray, vertices: np.ndarray):
        coordinates = free.ravel()
        self.size = int(coordinates.sum())
        self._unknown = np.where(coordinates, np.cumsum(coordinates) - 1, -1)
        self._coordinates = np.flatnonzero(coordinates)
        steady = {index: term for index, term in enumerate(terms) if term.pattern != MOVING}
        jacobians = {index: term.jacobian(vertices) for index, term in steady.items()}
        self._gram = {index: Gram(jacobian, self._unknown, self.size) for index, jacobian in jacobians.items()}
        self._constant = {index: jacobians[index] for index, term in steady.items() if term.pattern == CONSTANT}
        self.factorisations = self.analyses = 0
        self._ordering: object = None
        keys = [gram.keys for gram in self._gram.values()]
        diagonal = np.arange(self.size) * (self.size + 1)
        distinct, entry = _distinct(np.concatenate([*keys, diagonal]), self.size)
        self._entries = dict(zip(self._gram, np.split(entry, np.cumsum([len(key) for key in keys])), strict=False))
        self._set_pattern(distinct)
        self._unchanging = np.zeros(len(distinct))
        for index, jacobian in self._constant.items():
            self._unchanging += self._steady_values(index, jacobian.data)

    def _set_pattern(self, keys: np.ndarray) -> None:
        self._keys = keys
        columns, rows = np.divmod(keys, self.size)
        pointers = np.searchsorted(columns, np.arange(self.size + 1))
        self._diagonal = pointers[:-1]
        self._cholesky = Cholesky(rows, pointers, self._ordering)
        self._ordering = self._cholesky.ordering
        self.analyses += 1

    def _steady_values(self, index: int, data: np.ndarray) -> np.ndarray:
        """Contribution of a steady term to the matrix."""
        return self._add_up(self._entries[index], self._gram[index].products(data))

    def _add_up(self, entries: np.ndarray, products: np.ndarray) -> np.ndarray:
        return np.bincount(entries, products, minlength=len(self._keys))

    def update(self, terms: Sequence[Term], vertices: np.ndarray, residuals: Sequence[np.ndarray]) -> None:
        """Assemble the equations at these positions.

        Parameters
        ----------
        terms : list of terms
            The terms given at first, the moving ones with their present contacts.
        vertices : array, shape (n, 2)
        residuals : list of array
            Those of the terms.
        """
        moving, steady = self._set_gradient(terms, vertices, residuals)
        grams = {index: Gram(jacobian, self._unknown, self.size) for index, jacobian in moving.items()}
        self._widen([gram.keys for gram in grams.values()])
        self._values = self._unchanging.copy()
        for index, jacobian in steady.items():
            self._values += self._steady_values(index, jacobian.data)
        layouts = [(terms[index], self._gram[index], self._entries[index]) for index in steady]
        for index, gram in grams.items():
            entries = np.searchsorted(self._keys, gram.keys)
            self._values += self._add_up(entries, gram.products(moving[index].data))
            layouts.append((terms[index], gram, entries))
        self._bent: list[tuple[Gram, np.ndarray, Layer]] = [
            (gram, entries, layer) for term, gram, entries in layouts for layer in term.curvature(vertices)
        ]

    def _set_gradient(
        self, terms: Sequence[Term], vertices: np.ndarray, residuals: Sequence[np.ndarray]
    ) -> tuple[dict[int, csr_array], dict[int, csr_array]]:
        """Add up J^T r; return the Jacobians that have changed, of moving and of steady terms, by the term's index."""
        moving: dict[int, csr_array] = {}
        steady: dict[int, csr_array] = {}
        gradient = np.zeros(len(self._unknown))
        for index, (term, residual) in enumerate(zip(terms, residuals, strict=True)):
            jacobian = self._constant.get(index)
            if jacobian is None:
                jacobian = term.jacobian(vertices)
                if not jacobian.shape[0]:
                    continue
                (moving if term.pattern == MOVING else steady)[index] = jacobian
            gradient += _transposed_product(jacobian, residual)
        self._gradient = gradient[self._coordinates]
        return moving, steady

    def _widen(self, wanted: Sequence[np.ndarray]) -> None:
        """Add missing keys to the pattern."""
        keys = np.concatenate([np.empty(0, np.int64), *wanted])
        entry = np.minimum(np.searchsorted(self._keys, keys), len(self._keys) - 1)
        missing = keys[self._keys[entry] != keys]
        if not len(missing):
            return
        wider, _ = _distinct(np.concatenate([self._keys, missing]), self.size)
        shifted = np.searchsorted(wider, self._keys)
        self._entries = {index: shifted[entries] for index, entries in self._entries.items()}
        unchanging, self._unchanging = self._unchanging, np.zeros(len(wider))
        self._unchanging[shifted] = unchanging
        self._set_pattern(wider)

    def step(self, damping: float, bending: float | None = None) -> np.ndarray:
        """The damped step, shape (n, 2); 0 for held coordinates.

        Parameters
        ----------
        damping : float
            Added to the diagonal, in units of its median: a few heavy rows must not stiffen soft rock elsewhere.
        bending : float, optional
            Share of the negative second derivatives, those of what is shortened. With 1, and all of the positive ones,
            the step is Newton's; with less the matrix is more likely to be positive definite. Without it the step is
            Gauss-Newton's.

        Raises
        ------
        NotPositiveDefinite
        """
        values = self._values.copy()
        if bending is not None:
            for gram, entries, (data, factor) in self._bent:
                convex = np.where(factor > 0, factor, bending * factor)
                values += self._add_up(entries, gram.products(data, convex))
        if self.size:
            values[self._diagonal] += damping * np.median(self._values[self._diagonal])
        self.factorisations += 1
        self._cholesky.factorise(values)
        step = np.zeros(len(self._unknown))
        step[self._coordinates] = -self._cholesky.solve(self._gradient)
        return step.reshape(-1, 2)
