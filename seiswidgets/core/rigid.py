"""The rigid part of blocks' motion: the best there is, where a solver starts from, and a share of one that was."""

import numpy as np
from scipy.sparse import csr_array

from seiswidgets.core.solver import energy, update_contacts

TURN = 1e-4  # radians; a start need not be better


def rigid_blocks(blocks, terms, start, free, max_iterations=30) -> np.ndarray:
    """Positions after the rigid motion of each block that leaves the least energy in some terms.

    Gauss-Newton again, with three unknowns a block: the same Jacobians, times each block's two shifts and its turn.
    No triangle is deformed, so none can turn over; a fault that blocks have to turn along, as on a listric one,
    is met before any of them bends.

    Parameters
    ----------
    blocks : array, shape (n,)
        Label of each vertex's block.
    terms : list of terms
        Those between blocks: contact and stitches.
    start : array, shape (n, 2)
    free : array of bool, shape (n,)
        The vertices of the blocks that may move.

    Returns
    -------
    array, shape (n, 2)
    """
    vertices = start
    labels = np.where(free, blocks, -1)
    for _ in range(max_iterations):
        terms = update_contacts(terms, vertices)
        residual = np.concatenate([term.residual(vertices) for term in terms])
        modes, centres, reach = _modes(labels, vertices)
        slopes = np.vstack([(term.jacobian(vertices) @ modes).toarray() for term in terms])
        step = -np.linalg.lstsq(slopes, residual, rcond=1e-9)[0].reshape(-1, 3)
        before, share = energy(terms, vertices), 1.0
        while energy(terms, moved := _moved(labels, vertices, centres, reach, share * step)) > before and share > 1e-3:
            share /= 2
        if share <= 1e-3:
            break
        vertices = moved
        if np.max(np.abs(step), initial=0) < TURN * reach:
            break
    return vertices


def _modes(labels, vertices):
    """Each block's shifts and its turn about its centre as columns; the turn in units of the size of the whole."""
    count, moving = labels.max() + 1, np.flatnonzero(labels >= 0)
    block = labels[moving]
    number = np.maximum(np.bincount(block, minlength=count), 1)
    centres = np.column_stack([np.bincount(block, vertices[moving, k], minlength=count) / number for k in (0, 1)])
    reach = np.ptp(vertices, axis=0).max()
    arm = (vertices[moving] - centres[block]) / reach
    ones = np.ones(len(moving))
    data = np.concatenate([ones, ones, -arm[:, 1], arm[:, 0]])
    rows = np.concatenate([2 * moving, 2 * moving + 1, 2 * moving, 2 * moving + 1])
    columns = np.concatenate([3 * block, 3 * block + 1, 3 * block + 2, 3 * block + 2])
    return csr_array((data, (rows, columns)), shape=(vertices.size, 3 * count)), centres, reach


def _moved(labels, vertices, centres, reach, step):
    moving = labels >= 0
    block = labels[moving]
    angle = step[block, 2] / reach
    arm = vertices[moving] - centres[block]
    turned = np.column_stack(
        [np.cos(angle) * arm[:, 0] - np.sin(angle) * arm[:, 1], np.sin(angle) * arm[:, 0] + np.cos(angle) * arm[:, 1]]
    )
    moved = vertices.copy()
    moved[moving] = centres[block] + turned + step[block, :2]
    return moved


def part_of_motion(before, after, blocks, masses, share: float) -> np.ndarray:
    """Positions at a share of the way from before to after, such that no block shrinks because it turns; shape (n, 2).

    The rigid motion nearest to a block's own (Procrustes) is a turn about a pole; a share of it is a share of that turn
    about the same pole, so a block that slides round a circular fault stays on it. What the block does beside that is
    taken evenly.

    Parameters
    ----------
    before, after : array, shape (n, 2)
    blocks : array, shape (n,)
        Label of each vertex's block.
    masses : array, shape (n,)
        How much each vertex counts.
    share : float
        From 0 to 1.
    """
    start, stop = (points @ [1, 1j] for points in (before, after))
    total = np.bincount(blocks, masses)

    def mean(values):
        return (np.bincount(blocks, masses * values.real) + 1j * np.bincount(blocks, masses * values.imag)) / total

    first, last = mean(start), mean(stop)
    start, stop = start - first[blocks], stop - last[blocks]
    angle = np.angle(mean(start.conj() * stop))
    shape = (1 - share) * start + share * np.exp(-1j * angle)[blocks] * stop
    # (1 - exp(i share angle)) / (1 - exp(i angle)), the centre's share of its arc, in a form that bears an angle of 0
    along = share * np.sinc(share * angle / (2 * np.pi)) / np.sinc(angle / (2 * np.pi))
    centre = first + along * np.exp(0.5j * (share - 1) * angle) * (last - first)
    places = centre[blocks] + np.exp(1j * share * angle)[blocks] * shape
    return np.column_stack([places.real, places.imag])
