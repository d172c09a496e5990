"""One check for every term: its derivatives against central finite differences."""

import numpy as np
from scipy.sparse import csr_array


def check_jacobian(term, vertices, rng, step=1e-4):
    """Compare the Jacobian's product with a random direction to central finite differences along it.

    Parameters
    ----------
    term : a residual term, a moving one with its partners chosen
    vertices : array, shape (n, 2)
    rng : numpy Generator that draws the direction
    step : float
        How far the vertices are moved either way, in metres: sections are a thousand metres wide.
    """
    direction = rng.standard_normal(vertices.shape)
    ahead, behind = (term.residual(vertices + sign * step * direction) for sign in (1, -1))
    jacobian = term.jacobian(vertices)
    assert jacobian.shape == (len(term.residual(vertices)), vertices.size)
    expected = (ahead - behind) / (2 * step)
    scale = max(1e-3, np.max(np.abs(expected), initial=0))
    np.testing.assert_allclose(jacobian @ direction.ravel(), expected, rtol=1e-5, atol=1e-6 * scale)


def check_curvature(term, vertices, rng, step=1e-4):
    """Compare the second derivative of half the energy along a random direction to differences of its gradient."""
    direction = rng.standard_normal(vertices.shape)
    jacobian = term.jacobian(vertices)
    along = direction.ravel()
    found = np.sum((jacobian @ along) ** 2)
    for data, factor in term.curvature(vertices):
        rows = csr_array((data, jacobian.indices, jacobian.indptr), shape=jacobian.shape)
        found += np.sum(factor * (rows @ along) ** 2)
    ahead, behind = (vertices + sign * step * direction for sign in (1, -1))
    slopes = [along @ (term.jacobian(at).T @ term.residual(at)) for at in (ahead, behind)]
    np.testing.assert_allclose(found, (slopes[0] - slopes[1]) / (2 * step), rtol=1e-5)
