"""Random restorations by both solvers: triangles that were turned over, and what became of the rest.

Each stage is given to the fixed point as Gauss-Newton's stages before have left the section.
"""

import multiprocessing
import os

import numpy as np

import seiswidgets as sw
from seiswidgets.core.cholesky import NotPositiveDefinite
from seiswidgets.core.mesh import triangle_areas
from tests.cases import SPACING, random_case

CASES = 1000
QUICK = 12  # iterations
FIXED_POINT_ITERATIONS = 50  # more take hours; its flips come early


def rows():
    os.environ |= dict.fromkeys(["OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS"], "1")  # for the processes to come
    with multiprocessing.get_context("spawn").Pool() as pool:
        stages = [stage for case in pool.imap(restored, range(CASES), chunksize=5) for stage in case]
    ours, theirs = (sum(stage.get(solver, 0) for stage in stages) for solver in ("ours", "theirs"))
    yield f"flipped in {CASES:,} random cases / fixed point", ours, theirs, "", "0", "NO" if ours else "yes", 1
    ours, theirs = (sum(stage.get(solver, 0) > 0 for stage in stages) for solver in ("ours", "theirs"))
    yield f"  stages with a flip, of {len(stages):,}", ours, theirs, "", "", "", 1
    unsettled = sum("not settled" in stage["state"] for stage in stages)
    yield "  stages of ours that did not settle", unsettled, "", "", "<= 10", "NO" if unsettled > 10 else "yes", 1
    unfaults = [stage["iterations"] for stage in stages if "iterations" in stage and stage["state"][:7] == "unfault"]
    slow = np.mean(np.array(unfaults) > QUICK)
    yield f"  unfaults of over {QUICK} iterations", f"{slow:.1%}", "", "", "<= 5%", "NO" if slow > 0.05 else "yes", 1
    for state in sorted({stage["state"] for stage in stages}):
        seeds = [stage["seed"] for stage in stages if stage["state"] == state]
        yield f"  {state}", len(seeds), " ".join(map(str, seeds[:4])), "", "", "", 1


def restored(seed):
    """Outcome of each stage of a case: its state and, for either solver, the number of flipped triangles."""
    section, faults, horizons, fixed = random_case(seed)
    before, stages = sw.Restoration(section, spacing=SPACING), []
    for kind, solve in (
        ("unfault", lambda before, **solver: before.unfault(faults, horizons, fixed=fixed, **solver)),
        ("flatten", lambda before, **solver: before.flatten(horizons[0], **solver)),
    ):
        try:
            after = solve(before)
        except Exception as error:  # noqa: BLE001 (whatever comes is a result)
            stages.append({"seed": seed, "state": f"{kind}: {type(error).__name__}: {error}"[:56]})
            break
        report = after.stages[-1].report
        state = ("settled" if report.converged else "not settled") + (
            ", with a constraint unmet" if report.unmet else ""
        )
        outcome = {"seed": seed, "state": f"{kind}: {state}", "iterations": report.iterations}
        stages.append({**outcome, "ours": flips(after), "theirs": refused(solve, before)})
        before = after
    return stages


def flips(restoration):
    stage = restoration.stages[-1]
    return int(np.sum(triangle_areas(stage.vertices, stage.mesh.triangles) <= 0))


def refused(solve, before):
    """Number of triangles that the fixed point turns over."""
    try:
        solve(before, solver="fixed-point", max_iterations=FIXED_POINT_ITERATIONS)
    except sw.FlippedError as error:
        return error.count
    except NotPositiveDefinite:
        pass  # a part of the rock does not reach the horizon, and nothing in the paper's energy holds it
    return 0
