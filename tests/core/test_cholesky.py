import numpy as np
import pytest
from scipy.sparse import csc_array, eye_array, random_array, tril

from seiswidgets.core import cholesky

NO_CVXOPT = pytest.mark.skipif(cholesky.cvxopt is None, reason="cvxopt, the extra `fast`, is not installed")
BACKENDS = [pytest.param(cholesky.Cholmod, marks=NO_CVXOPT), cholesky.SuperLU]


def positive_definite(rng, size):
    part = random_array((size, size), density=0.05, rng=rng, format="csc")
    return (part @ part.T + eye_array(size)).tocsc()


def lower(matrix):
    """The lower triangle in compressed columns, rows in order."""
    triangle = csc_array(tril(matrix, format="csc"))
    triangle.sort_indices()
    return triangle


def factored(backend, matrix):
    triangle = lower(matrix)
    factor = backend(triangle.indices, triangle.indptr)
    factor.factorise(triangle.data)
    return factor


@pytest.mark.parametrize("backend", BACKENDS)
@pytest.mark.parametrize(("size", "shape"), [(1, ()), (1, (3,)), (2, (1,)), (200, ()), (200, (3,))])
def test_solves_a_random_system(backend, size, shape):
    rng = np.random.default_rng(size)
    matrix, right = positive_definite(rng, size), rng.standard_normal((size, *shape))
    solution = factored(backend, matrix).solve(right)
    assert solution.shape == right.shape
    np.testing.assert_allclose(matrix @ solution, right, atol=1e-10)


@pytest.mark.parametrize("backend", BACKENDS)
def test_factorises_again_with_new_numbers(backend):
    rng = np.random.default_rng(0)
    matrix, right = positive_definite(rng, 50), rng.standard_normal(50)
    factor = factored(backend, matrix)
    for scale in rng.uniform(0.1, 10, size=3):
        other = matrix * scale + eye_array(50, format="csc")
        factor.factorise(lower(other).data)
        np.testing.assert_allclose(other @ factor.solve(right), right, atol=1e-10)


@pytest.mark.parametrize("backend", BACKENDS)
def test_an_earlier_ordering_serves_a_wider_pattern(backend):
    rng = np.random.default_rng(1)
    matrix, right = positive_definite(rng, 50), rng.standard_normal(50)
    ordering = factored(backend, matrix).ordering
    wider = (matrix + positive_definite(rng, 50)).tocsc()
    triangle = lower(wider)
    factor = backend(triangle.indices, triangle.indptr, ordering)
    factor.factorise(triangle.data)
    np.testing.assert_allclose(wider @ factor.solve(right), right, atol=1e-10)


NOT_DEFINITE = {
    "indefinite": [[1, 2], [2, 1]],
    "negative": [[-1, 0], [0, -1]],
    "singular": [[1, 1], [1, 1]],
    "zero": [[0, 0], [0, 0]],
    "zero pivot": [[0, 1], [1, 0]],
}


@pytest.mark.parametrize("backend", BACKENDS)
@pytest.mark.parametrize("name", NOT_DEFINITE)
def test_a_matrix_without_a_factor_is_refused(backend, name):
    numbers = np.array(NOT_DEFINITE[name], float)[[0, 1, 1], [0, 0, 1]]
    factor = backend(np.array([0, 1, 1]), np.array([0, 2, 3]))
    with pytest.raises(cholesky.NotPositiveDefinite):
        factor.factorise(numbers)


@pytest.mark.parametrize("backend", BACKENDS)
def test_a_refusal_is_not_the_end(backend):
    factor = backend(np.array([0, 1, 1]), np.array([0, 2, 3]))
    with pytest.raises(cholesky.NotPositiveDefinite):
        factor.factorise(np.array([1.0, 1.0, 1.0]))
    factor.factorise(np.array([2.0, 1.0, 2.0]))
    np.testing.assert_allclose(factor.solve(np.array([3.0, 3.0])), [1, 1])


def test_cholmod_is_preferred_where_it_is_installed():
    assert cholesky.Cholesky is (cholesky.SuperLU if cholesky.cvxopt is None else cholesky.Cholmod)


@NO_CVXOPT
def test_both_backends_agree():
    rng = np.random.default_rng(2)
    matrix, right = positive_definite(rng, 300), rng.standard_normal(300)
    np.testing.assert_allclose(*(factored(b, matrix).solve(right) for b in (cholesky.Cholmod, cholesky.SuperLU)))
