"""A tilted section brought level, beside libigl's as-rigid-as-possible with the horizon pinned to the answer."""

from functools import partial

import igl
import numpy as np
from problems import problem
from timing import faster, in_turns

import seiswidgets as sw
from seiswidgets.core.terms import Level

CLOSE = 1e-5  # of the largest displacement


def rows():
    case = sw.synthetic.tilt()
    for count in (4_000, 8_000):
        tilted = problem(case, count)
        rest = tilted.mesh.vertices
        truth = case.to_restored(rest)
        ours = partial(levelled, tilted)
        horizon = next(term for term in tilted.terms if isinstance(term, Level)).vertices
        peer = partial(pinned, rest, tilted.mesh.triangles, horizon, truth)
        needed = [iterations(solve, rest, truth) for solve in (ours, peer)]
        times = in_turns([partial(ours, needed[0]), partial(peer, needed[1])], 7)
        what = f"tilt to 1e-5, {len(rest):,} vertices, {needed[0]} it. / libigl ARAP, {needed[1]} it."
        yield faster(what, *times, 1, 7)


def iterations(solve, rest, truth):
    """Number of iterations until a solver is within 1e-5 of the answer, apart from a shift along x."""
    largest, low, high = np.linalg.norm(truth - rest, axis=1).max(), 0, 1

    def far(count):
        away = solve(count) - truth
        away[:, 0] -= away[:, 0].mean()
        return np.linalg.norm(away, axis=1).max() > CLOSE * largest

    while far(high):
        low, high = high, 2 * high
        if high > 1e5:
            raise RuntimeError(f"not within {CLOSE:g} after {low} iterations")
    while high - low > 1:
        middle = (low + high) // 2
        low, high = (middle, high) if far(middle) else (low, middle)
    return high


def levelled(problem, count):
    return problem.solved(max_iterations=count).vertices


def pinned(rest, triangles, horizon, truth, count):
    data = igl.ARAPData()
    data.max_iter = count
    igl.arap_precomputation(rest, triangles, 2, horizon.astype(np.int32), data)
    return igl.arap_solve(truth[horizon], data, rest)
