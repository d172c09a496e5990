"""Mean value coordinates: each inner vertex as a weighted mean of its neighbours."""

import numpy as np
from scipy.sparse import csr_array

from seiswidgets.core.mesh import Mesh


def mean_value_matrix(mesh: Mesh) -> csr_array:
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
    arms = [mesh.vertices.take(neighbour, axis=0) - mesh.vertices.take(centre, axis=0) for neighbour in neighbours]
    lengths = [np.hypot(*arm.T) for arm in arms]
    cross = np.abs(arms[0][:, 0] * arms[1][:, 1] - arms[0][:, 1] * arms[1][:, 0])
    half_tangent = cross / (lengths[0] * lengths[1] + np.sum(arms[0] * arms[1], axis=1))
    weights = np.concatenate([half_tangent / length for length in lengths])
    rows, columns = np.tile(centre, 2), np.concatenate(neighbours)
    weights /= np.bincount(rows, weights, minlength=count)[rows]
    row_of = np.full(count, -1)
    row_of[mesh.interior] = np.arange(len(mesh.interior))
    inner = row_of[rows] >= 0
    rows, columns = np.append(row_of[rows[inner]], row_of[mesh.interior]), np.append(columns[inner], mesh.interior)
    data = np.append(weights[inner], np.full(len(mesh.interior), -1.0))
    return csr_array((data, (rows, columns)), shape=(len(mesh.interior), count))
