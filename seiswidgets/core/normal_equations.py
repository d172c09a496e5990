"""The normal equations of a nonlinear least squares problem, assembled quickly again and again."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache

import numpy as np
from scipy.sparse import csc_array, csr_array

from seiswidgets.core.cholesky import Cholesky, NotPositiveDefinite
from seiswidgets.core.term import CONSTANT, MOVING, Layer, Term
from seiswidgets.core.trust_region import Operator, truncated_newton

LEAST_DAMPING, MOST_DAMPING = 1e-9, 1e6  # of the median diagonal; the least only tames motions that cost nothing


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


def _kinds(terms: Sequence[Term]) -> list[tuple[type, str]]:
    return [(type(term), term.pattern) for term in terms]


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


@dataclass(frozen=True, eq=False)
class Springs:
    """Springs that resist a step's stretching of edges; a step that turns no triangle over needs none.

    Attributes
    ----------
    edges : array, shape (k, 2)
    stiffness : array, shape (k,)
    """

    edges: np.ndarray
    stiffness: np.ndarray


class NormalEquations:
    """Solver of (J^T J + B) step = -J^T r for the unknown coordinates, at one position after another.

    B are the second derivatives of the terms (``curvature``). Without them the step is Gauss-Newton's, which converges
    slowly where large residuals remain, as in a tight fold. With them it is Newton's, by conjugate gradients whose
    preconditioner is the Cholesky factor with the convex part of B alone: so nothing indefinite is ever factorised.

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
        self._terms = terms
        self.factorisations = self.analyses = 0
        self._ordering: object = None
        keys = [gram.keys for gram in self._gram.values()]
        diagonal = np.arange(self.size) * (self.size + 1)
        distinct, entry = _distinct(np.concatenate([*keys, diagonal]), self.size)
        self._entries = dict(zip(self._gram, np.split(entry, np.cumsum([len(key) for key in keys])), strict=False))
        self._set_pattern(distinct)
        self._add_up_constant_terms()

    def renewed(self, terms: Sequence[Term], free: np.ndarray, vertices: np.ndarray) -> "NormalEquations":
        """The equations with other constant terms, whose Jacobians must have the same patterns.

        If the terms are of other kinds, or other coordinates are free, the equations are made anew.
        """
        is_same = np.array_equal(np.flatnonzero(free), self._coordinates)
        if not is_same or _kinds(terms) != _kinds(self._terms):
            return NormalEquations(terms, free, vertices)
        if any(terms[index] is not self._terms[index] for index in self._constant):
            self._constant = {index: terms[index].jacobian(vertices) for index in self._constant}
            self._add_up_constant_terms()
        self._terms, self.factorisations = terms, 0
        return self

    def _add_up_constant_terms(self) -> None:
        self._unchanging = np.zeros(len(self._keys))
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
        self._layouts, self._vertices = layouts, vertices
        self._bent: list[tuple[Gram, np.ndarray, Layer]] | None = None  # until it is needed

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

    def factorise(self, springs: Springs | None = None, *, curved: bool = False) -> None:
        """Factorise J^T J, with springs and the convex part of the second derivatives.

        The diagonal is raised a little, in units of its median, to hold motions that cost nothing.
        """
        values = self._values + self._bending(1) if curved else self._values.copy()
        if springs is not None:
            values += self._spring_values(springs)
        self._factorised, damping = values, LEAST_DAMPING
        while True:
            if self.size:
                values[self._diagonal] += damping * np.median(self._values[self._diagonal])
            self.factorisations += 1
            try:
                return self._cholesky.factorise(values)
            except NotPositiveDefinite:
                if damping > MOST_DAMPING:
                    raise
                damping *= 100

    def _bending(self, sign: int) -> np.ndarray:
        """Values of the convex (1) or concave (-1) part of the second derivatives."""
        if self._bent is None:
            self._bent = [
                (gram, entries, layer)
                for term, gram, entries in self._layouts
                for layer in term.curvature(self._vertices)
            ]
        values = np.zeros(len(self._keys))
        for gram, entries, (data, factor) in self._bent:
            values += self._add_up(entries, gram.products(data, sign * np.maximum(sign * factor, 0)))
        return values

    def _spring_values(self, springs: Springs) -> np.ndarray:
        """Values of the springs; what the pattern lacks of them is left out, which only stiffens them."""
        columns = np.concatenate([2 * springs.edges, 2 * springs.edges + 1])
        data = np.tile([1.0, -1.0], len(columns))
        pointers = 2 * np.arange(len(columns) + 1)
        rows = csr_array((data, columns.ravel(), pointers), shape=(len(columns), len(self._unknown)))
        gram = Gram(rows, self._unknown, self.size)
        products = gram.products(data, np.tile(springs.stiffness, 2))
        entries = np.minimum(np.searchsorted(self._keys, gram.keys), len(self._keys) - 1)
        known = self._keys[entries] == gram.keys
        return self._add_up(entries[known], products[known])

    def step(self) -> np.ndarray:
        """The step of the factorised matrix, shape (n, 2); 0 for held coordinates."""
        return self._all_coordinates(-self._cholesky.solve(self._gradient))

    def newton_step(self, radius: float) -> tuple[np.ndarray, float, bool]:
        """Newton's step within a radius; call ``factorise(curved=True)`` before.

        Returns
        -------
        step : array, shape (n, 2)
        norm : float
            Length of the step in the norm of the factorised matrix, as the radius.
        limited : bool
            True if it is limited by the radius, or by negative curvature.
        """
        found = truncated_newton(self._gradient, self.hessian(), self._cholesky.solve, radius)
        return self._all_coordinates(found.step), found.norm, found.limited

    def hessian(self) -> Operator:
        """Product of a vector of unknowns with J^T J + B, and the springs of ``factorise(curved=True)``."""
        values = self._factorised + self._bending(-1)
        columns, rows = np.divmod(self._keys, max(self.size, 1))
        lower = csc_array((values, (rows, columns)), shape=(self.size, self.size))
        upper, diagonal = lower.T, values[self._diagonal]
        return lambda vector: lower @ vector + upper @ vector - diagonal * vector

    def slope(self, step: np.ndarray) -> float:
        """Derivative of the energy along a step; negative."""
        return float(2 * self._gradient @ step.ravel()[self._coordinates])

    def _all_coordinates(self, unknowns: np.ndarray) -> np.ndarray:
        step = np.zeros(len(self._unknown))
        step[self._coordinates] = unknowns
        return step.reshape(-1, 2)
