"""Mean value coordinates: each inner vertex as a weighted mean of its neighbours."""

import numpy as np
from scipy.sparse import coo_array

from seiswidgets.core.mesh import Mesh


def mean_value_matrix(mesh: Mesh):
    """M of the paper's eq. 5: its rows give the neighbours' weighted mean minus the vertex itself.

    Rows belong to ``mesh.interior``, columns to all vertices; ``M @ mesh.vertices`` is 0. The weights are those of
    eq. 4, with tan(a / 2) = |cross| / (r_i r_j + dot), which never divides by a vanishing sine.

    Returns
    -------
    scipy.sparse.csr_array, shape (len(mesh.interior), n)
    """
    count = len(mesh.vertices)
    centre = mesh.triangles[:, [0, 1, 2]].ravel()
    neighbours = [mesh.triangles[:, [1, 2, 0]].ravel(), mesh.triangles[:, [2, 0, 1]].ravel()]
    arms = [mesh.vertices[neighbour] - mesh.vertices[centre] for neighbour in neighbours]
    lengths = [np.hypot(*arm.T) for arm in arms]
    cross = np.abs(arms[0][:, 0] * arms[1][:, 1] - arms[0][:, 1] * arms[1][:, 0])
    half_tangent = cross / (lengths[0] * lengths[1] + np.sum(arms[0] * arms[1], axis=1))
    data = np.concatenate([half_tangent / length for length in lengths])
    rows, columns = np.tile(centre, 2), np.concatenate(neighbours)
    weights = coo_array((data, (rows, columns)), shape=(count, count)).tocsr()[mesh.interior]
    totals = coo_array((-weights.sum(axis=1), (np.arange(len(mesh.interior)), mesh.interior)), shape=weights.shape)
    scale = coo_array((1 / weights.sum(axis=1), (np.arange(len(mesh.interior)),) * 2))
    return (scale @ (weights + totals)).tocsr()
