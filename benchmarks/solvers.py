"""Gauss-Newton beside the paper's fixed point, and beside its own factorisations alone.

The fixed point is read at its best: weights multiply squared norms (eqs. 12 and 13), not rows (eq. 14).
"""

import time
from contextlib import suppress
from unittest.mock import patch

import numpy as np
from problems import problem
from timing import at_most, faster, in_turns, told

import seiswidgets as sw
from seiswidgets.core import normal_equations
from seiswidgets.core.cholesky import Cholesky, NotPositiveDefinite
from seiswidgets.core.rigid import rigid_blocks
from seiswidgets.core.solver import fixed_point
from seiswidgets.errors import Cancelled

CAP = 20_000
CLOSE = 0.05  # of the largest throw


def rows():
    yield from listric()
    yield from readings()
    for count, runs in ((5_000, 5), (20_000, 3), (50_000, 3)):
        yield overhead(
            f"flatten sine fold of 30°, {count:,} vertices", problem(sw.synthetic.sine_fold(dip=30), count), runs
        )
        yield overhead(f"unfault blind fault, {count:,} vertices", problem(sw.synthetic.blind_fault(), count), runs)
        yield overhead(f"unfault listric fault, {count:,} vertices", problem(sw.synthetic.listric_fault(), count), runs)


def listric():
    case = sw.synthetic.listric_fault(turn=0.1)
    listric = problem(case, 2500, case.fixed)
    fault = case.interpretation.faults[0]
    limit = CLOSE * max(abs(sw.throw(fault, horizon)) for horizon in case.interpretation.horizons)
    triangles = listric.mesh.triangles[listric.free[listric.mesh.triangles].all(axis=1)]
    truth = case.to_unfaulted(listric.mesh.vertices[triangles].mean(axis=1))

    def there(vertices):
        return np.linalg.norm(vertices[triangles].mean(axis=1) - truth, axis=1).max() <= limit

    def slid():
        return rigid_blocks(*listric.rigid[0])

    rest = listric.mesh.vertices
    ours = np.median(
        [arrival(lambda progress: listric.solved(start=slid(), progress=progress), there) for _ in range(5)]
    )
    unmoved = np.median(
        [arrival(lambda progress: listric.solved(start=rest, progress=progress), there) for _ in range(5)]
    )
    terms = problem(case, 2500, case.fixed, solver="fixed-point", weighting="norms").terms
    settings = terms, rest, listric.free, listric.tolerance, CAP
    peer = arrival(lambda progress: fixed_point(*settings, progress), there)
    what = f"listric block to 5% of its throw, {len(rest):,} vertices"
    yield faster(f"{what} / fixed point", ours, peer, 50, "5/1")
    yield faster("  the same from the unmoved start, as the fixed point", unmoved, peer, None, "5/1")


def readings():
    """Median error of the hanging wall of a straight fault, by the two readings of the paper's weights."""
    case = sw.synthetic.planar_fault()
    picks, start = case.interpretation, sw.Restoration(case.section, spacing=100)
    mesh = start.unfault(picks.faults, picks.horizons, fixed=case.fixed).stages[0].mesh_setup.mesh
    centres = mesh.vertices[mesh.triangles].mean(axis=1)
    moved = case.block(centres) > 0
    for weighting in ("norms", "rows"):
        errors = {}

        def progress(iteration, energy, vertices, errors=errors):
            if iteration in (1, 10, 100, 1000):
                off = vertices[mesh.triangles].mean(axis=1) - case.to_unfaulted(centres)
                errors[iteration] = float(np.median(np.hypot(*off[moved].T)))

        options = {"solver": "fixed-point", "weighting": weighting, "progress": progress}
        with suppress(sw.FlippedError):
            start.unfault(picks.faults, picks.horizons, fixed=case.fixed, **options)
        listed = ", ".join(f"{error:.1f}" for error in errors.values())
        yield f"straight fault, off after 1, 10, 100, 1000 it., {weighting}", "", f"{listed} m", "", "", "", 1


def arrival(solve, there):
    """The time a solver takes to an iterate that is there; all its time if it ends before."""
    checking, began = 0.0, time.perf_counter()

    def progress(iteration, energy, vertices):
        nonlocal checking
        before = time.perf_counter()
        arrived = there(vertices)
        checking += time.perf_counter() - before
        return not arrived

    try:
        solve(progress)
        print("    not reached", flush=True)
    except Cancelled:
        pass
    return time.perf_counter() - began - checking


def overhead(what, problem, runs):
    calls = []

    class Recording(Cholesky):
        def __init__(self, *pattern):
            calls.append((None, pattern))
            super().__init__(*pattern)

        def factorise(self, numbers):
            calls.append(("factorise", (numbers.copy(),)))
            super().factorise(numbers)

        def solve(self, right):
            calls.append(("solve", (right.copy(),)))
            return super().solve(right)

    def replayed():
        for name, given in calls:
            if name is None:
                cholesky = Cholesky(*given)
                continue
            with suppress(NotPositiveDefinite):
                getattr(cholesky, name)(*given)

    with patch.object(normal_equations, "Cholesky", Recording):
        solution = problem.solved()
    whole, alone = in_turns([problem.solved, replayed], runs)
    settled = "" if solution.converged else ", NOT SETTLED"
    what = f"{what}, {solution.iterations} it.{settled}"
    return at_most(what, told(whole), f"factors {told(alone)}", whole / alone, 2.5, runs)
