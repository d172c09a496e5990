"""Rigid motion of blocks: the best one to start a solver from, the nearest one to a deformation, and parts of one."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.sparse import csr_array

from seiswidgets.core.solver import energy, update_contacts
from seiswidgets.core.term import Term

TURN = 1e-4  # radians; accurate enough for a start


def rigid_blocks(
    blocks: np.ndarray, terms: Sequence[Term], start: np.ndarray, free: np.ndarray, max_iterations: int = 30
) -> np.ndarray:
    """Move each block rigidly so that the energy of some terms is least.

    Gauss-Newton with three unknowns per block: the same Jacobians, times each block's two shifts and its turn. No
    triangle is deformed, so none can turn over; blocks that have to turn along their fault, as along a listric one,
    do so before any of them bends.

    Parameters
    ----------
    blocks : array, shape (n,)
        Label of each vertex's block.
    terms : list of terms
        The terms between blocks: contact and stitches.
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
        while (
            energy(terms, moved := _move_blocks(labels, vertices, centres, reach, share * step)) > before
            and share > 1e-3
        ):
            share /= 2
        if share <= 1e-3:
            break
        vertices = moved
        if np.max(np.abs(step), initial=0) < TURN * reach:
            break
    return vertices


def _modes(labels: np.ndarray, vertices: np.ndarray) -> tuple[csr_array, np.ndarray, float]:
    """Shifts of each block and its turn about its centre as columns, the centres, and the unit of the turns."""
    count, moving = labels.max() + 1, np.flatnonzero(labels >= 0)
    block = labels[moving]
    size = np.maximum(np.bincount(block, minlength=count), 1)
    centres = np.column_stack([np.bincount(block, vertices[moving, k], minlength=count) / size for k in (0, 1)])
    reach = np.ptp(vertices, axis=0).max()
    arm = (vertices[moving] - centres[block]) / reach
    ones = np.ones(len(moving))
    data = np.concatenate([ones, ones, -arm[:, 1], arm[:, 0]])
    rows = np.concatenate([2 * moving, 2 * moving + 1, 2 * moving, 2 * moving + 1])
    columns = np.concatenate([3 * block, 3 * block + 1, 3 * block + 2, 3 * block + 2])
    return csr_array((data, (rows, columns)), shape=(vertices.size, 3 * count)), centres, reach


def _move_blocks(
    labels: np.ndarray, vertices: np.ndarray, centres: np.ndarray, reach: float, step: np.ndarray
) -> np.ndarray:
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


def part_of_motion(
    before: np.ndarray, after: np.ndarray, blocks: np.ndarray, masses: np.ndarray, share: float
) -> np.ndarray:
    """Positions after a share of a motion, such that no block shrinks because it turns; shape (n, 2).

    The rigid motion nearest to a block's own (Procrustes) is a turn about a pole; a share of it is a share of that turn
    about the same pole, so a block that slides around a circular fault stays on it. The rest of its deformation grows
    linearly.

    Parameters
    ----------
    before, after : array, shape (n, 2)
    blocks : array, shape (n,)
        Label of each vertex's block.
    masses : array, shape (n,)
        Weight of each vertex.
    share : float
        From 0 to 1.
    """
    start, stop = (points @ [1, 1j] for points in (before, after))
    total = np.bincount(blocks, masses)

    def mean(values: np.ndarray) -> np.ndarray:
        sums = np.bincount(blocks, masses * values.real) + 1j * np.bincount(blocks, masses * values.imag)
        return np.asarray(sums / total)

    first, last = mean(start), mean(stop)
    start, stop = start - first[blocks], stop - last[blocks]
    angle = np.angle(mean(start.conj() * stop))
    shape = (1 - share) * start + share * np.exp(-1j * angle)[blocks] * stop
    # (1 - exp(i share angle)) / (1 - exp(i angle)), the centre's share of its arc, in a form that is finite at angle 0
    along = share * np.sinc(share * angle / (2 * np.pi)) / np.sinc(angle / (2 * np.pi))
    centre = first + along * np.exp(0.5j * (share - 1) * angle) * (last - first)
    points = centre[blocks] + np.exp(1j * share * angle)[blocks] * shape
    return np.column_stack([points.real, points.imag])


@dataclass(frozen=True, eq=False)
class RigidMotion:
    """A turn by an angle in radians, from the x axis towards the z axis, that carries ``start`` to ``stop``."""

    angle: float
    start: np.ndarray
    stop: np.ndarray

    def __call__(self, points: np.ndarray) -> np.ndarray:
        """Move points, shape (..., 2)."""
        sine, cosine = np.sin(self.angle), np.cos(self.angle)
        return np.asarray((points - self.start) @ [[cosine, sine], [-sine, cosine]] + self.stop)


def rigid_motion(
    before: np.ndarray, after: np.ndarray, masses: np.ndarray, pole: np.ndarray | None = None
) -> RigidMotion:
    """The rigid motion nearest to that of some points (Procrustes); it carries the centre of mass along.

    Parameters
    ----------
    before, after : array, shape (n, 2)
    masses : array, shape (n,)
    pole : array, shape (2,), optional
        A point that stays: the motion is a turn about it.
    """
    share = masses / masses.sum()
    start, stop = (share @ before, share @ after) if pole is None else (pole, pole)
    a, b = before - start, after - stop
    angle = np.arctan2(share @ (a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]), share @ np.sum(a * b, axis=1))
    return RigidMotion(float(angle), start, stop)


def nearest_rigid(rest: np.ndarray, moved: np.ndarray, masses: np.ndarray) -> np.ndarray:
    """Move positions rigidly so that they lie nearest to where they were, shape (n, 2)."""
    return rigid_motion(moved, rest, masses)(moved)
