"""The normal equations of a nonlinear least squares problem, put together quickly time after time."""

from functools import cache

import numpy as np

from seiswidgets.core.cholesky import Cholesky
from seiswidgets.core.terms import CONSTANT, MOVING


class Gram:
    """The products that J^T J of a Jacobian is the sum of, and where in its lower triangle each belongs.

    A place is the key column * size + row. Columns of J that are not among the unknowns are left out.
    """

    def __init__(self, jacobian, unknown, size):
        self.first, self.second = _pairs_within_rows(jacobian.indptr)
        self._row = np.repeat(np.arange(jacobian.shape[0]), np.diff(jacobian.indptr))[self.first]
        one, other = unknown[jacobian.indices[self.first]], unknown[jacobian.indices[self.second]]
        inner = (one >= 0) & (other >= 0)
        if not inner.all():
            self.first, self.second, self._row = self.first[inner], self.second[inner], self._row[inner]
            one, other = one[inner], other[inner]
        self.keys = np.minimum(one, other) * size + np.maximum(one, other)

    def products(self, data, factor=None):
        """The products, one a key, when ``data`` are the entries of J; of J^T diag(factor) J if that is given."""
        products = data[self.first] * data[self.second]
        if factor is not None:
            products *= factor[self._row]
        return products


def _numbered(keys, size):
    """The different keys in order, and the place of each key among them.

    What `np.unique` does, many times faster: rows and columns are short integers, which NumPy sorts by their digits.
    """
    columns, rows = (part.astype(np.min_scalar_type(size)) for part in np.divmod(keys, max(size, 1)))
    order = np.lexsort((rows, columns))
    keys = keys[order]
    new = np.append(True, keys[1:] != keys[:-1])[: len(keys)]
    place = np.empty(len(keys), np.int64)
    place[order] = np.cumsum(new) - 1
    return keys[new], place


def _pairs_within_rows(pointers):
    """All pairs of entries, each with itself too, that stand in the same row of a CSR matrix."""
    lengths = np.diff(pointers)
    pairs = [(np.empty(0, np.int64), np.empty(0, np.int64))]
    for length in np.unique(lengths[lengths > 0]):
        one, other = _pairs(int(length))
        start = pointers[:-1][lengths == length].astype(np.int64)[:, None]
        pairs.append(((start + one).ravel(), (start + other).ravel()))
    first, second = zip(*pairs, strict=True)
    return np.concatenate(first), np.concatenate(second)


def _transposed_product(matrix, vector):
    """J^T r for a CSR matrix: where J is small, SciPy's transpose takes longer than the product."""
    numbers = matrix.data * np.repeat(vector, np.diff(matrix.indptr))
    return np.bincount(matrix.indices, numbers, minlength=matrix.shape[1])


@cache
def _pairs(length):
    return np.triu_indices(length)


class NormalEquations:
    """Solves (J^T J + B + damping) step = -J^T r for the unknown coordinates, at one place after another.

    B are the second derivatives of the terms that know theirs (``curvature``): without them Gauss-Newton's steps get
    small only slowly where much is left of a residual, as in a tight fold.

    The pattern of J^T J is found once for the terms whose Jacobians keep theirs, and widened only when a moving
    term needs a new place; the matrix is then analysed anew, in the same order of elimination.

    Parameters
    ----------
    terms : list of terms
    free : array of bool, shape (n, 2)
        The coordinates that may change.
    vertices : array, shape (n, 2)
        Any positions; only their number matters.
    """

    def __init__(self, terms, free, vertices):
        coordinates = free.ravel()
        self.size = int(coordinates.sum())
        self._unknown = np.where(coordinates, np.cumsum(coordinates) - 1, -1)
        self._coordinates = np.flatnonzero(coordinates)
        steady = {number: term for number, term in enumerate(terms) if term.pattern != MOVING}
        jacobians = {number: term.jacobian(vertices) for number, term in steady.items()}
        self._gram = {number: Gram(jacobian, self._unknown, self.size) for number, jacobian in jacobians.items()}
        self._constant = {number: jacobians[number] for number, term in steady.items() if term.pattern == CONSTANT}
        self.factorisations = self.analyses = 0
        self._ordering = None
        keys = [gram.keys for gram in self._gram.values()]
        diagonal = np.arange(self.size) * (self.size + 1)
        distinct, place = _numbered(np.concatenate([*keys, diagonal]), self.size)
        self._place = dict(zip(self._gram, np.split(place, np.cumsum([len(key) for key in keys])), strict=False))
        self._set_pattern(distinct)
        self._unchanging = np.zeros(len(distinct))
        for number, jacobian in self._constant.items():
            self._unchanging += self._numbers_of(number, jacobian.data)

    def _set_pattern(self, keys):
        self._keys = keys
        columns, rows = np.divmod(keys, self.size)
        pointers = np.searchsorted(columns, np.arange(self.size + 1))
        self._diagonal = pointers[:-1]
        self._cholesky = Cholesky(rows, pointers, self._ordering)
        self._ordering = self._cholesky.ordering
        self.analyses += 1

    def _numbers_of(self, number, data):
        """What a steady term adds to the matrix."""
        return self._at_places(self._place[number], self._gram[number].products(data))

    def _at_places(self, place, products):
        return np.bincount(place, products, minlength=len(self._keys))

    def at(self, terms, vertices, residuals):
        """Take in the residuals and Jacobians at these positions.

        Parameters
        ----------
        terms : list of terms
            The terms given at first, the moving ones as they are now.
        vertices : array, shape (n, 2)
        residuals : list of array
            Those of the terms.
        """
        moving, gradient, steady = [], np.zeros(len(self._unknown)), []
        for number, (term, residual) in enumerate(zip(terms, residuals, strict=True)):
            jacobian = self._constant.get(number)
            if jacobian is None:
                jacobian = term.jacobian(vertices)
                if not jacobian.shape[0]:
                    continue
                (moving if term.pattern == MOVING else steady).append((number, jacobian))
            gradient += _transposed_product(jacobian, residual)
        self._gradient = gradient[self._coordinates]
        grams = [(Gram(jacobian, self._unknown, self.size), jacobian.data) for _, jacobian in moving]
        self._widen([gram.keys for gram, _ in grams])
        self._numbers = self._unchanging.copy()
        for number, jacobian in steady:
            self._numbers += self._numbers_of(number, jacobian.data)
        places = [(terms[number], self._gram[number], self._place[number]) for number, _ in steady]
        for (number, _), (gram, data) in zip(moving, grams, strict=True):
            place = np.searchsorted(self._keys, gram.keys)
            self._numbers += self._at_places(place, gram.products(data))
            places.append((terms[number], gram, place))
        self._bent = [
            (gram, place, layer)
            for term, gram, place in places
            if hasattr(term, "curvature")
            for layer in term.curvature(vertices)
        ]

    def _widen(self, wanted):
        keys = np.concatenate([np.empty(0, np.int64), *wanted])
        place = np.minimum(np.searchsorted(self._keys, keys), len(self._keys) - 1)
        missing = keys[self._keys[place] != keys]
        if not len(missing):
            return
        wider, _ = _numbered(np.concatenate([self._keys, missing]), self.size)
        shifted = np.searchsorted(wider, self._keys)
        self._place = {number: shifted[place] for number, place in self._place.items()}
        unchanging, self._unchanging = self._unchanging, np.zeros(len(wider))
        self._unchanging[shifted] = unchanging
        self._set_pattern(wider)

    def step(self, damping: float, bending: float | None = None):
        """The damped step, shape (n, 2); 0 for what is held.

        Parameters
        ----------
        damping : float
            What is added to the diagonal, in units of its median: a few heavy rows must not stiffen soft rock elsewhere.
        bending : float, optional
            The share that is taken of the second derivatives of what is shortened. With 1, and all of those of what
            is stretched, the step is Newton's; with less the matrix is more surely positive definite. Without it the
            step is Gauss-Newton's.

        Raises
        ------
        NotPositiveDefinite
        """
        numbers = self._numbers.copy()
        if bending is not None:
            for gram, place, (data, factor) in self._bent:
                convex = np.where(factor > 0, factor, bending * factor)
                numbers += self._at_places(place, gram.products(data, convex))
        if self.size:
            numbers[self._diagonal] += damping * np.median(self._numbers[self._diagonal])
        self.factorisations += 1
        self._cholesky.factorise(numbers)
        step = np.zeros(len(self._unknown))
        step[self._coordinates] = -self._cholesky.solve(self._gradient)
        return step.reshape(-1, 2)
