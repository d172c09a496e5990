"""Previews keep their meshes while only horizons move, and agree with those on new meshes."""

from dataclasses import replace

import numpy as np
import pytest

import seiswidgets as sw
from seiswidgets.geology.plan import RestorationJob

CASE = sw.synthetic.faulted_fold()
LEVEL = 0.012  # of the coarse spacing: off which level a moved horizon may lie, root mean square
AGREEING = 0.05  # of the coarse spacing: by which 95% of the rock may differ from a preview on a new mesh
POINTS = np.stack(np.meshgrid(np.linspace(20, 3980, 40), np.linspace(20, 1980, 25)), axis=-1).reshape(-1, 2)


def job(drop, vertex=20, picks=CASE.interpretation):
    """A preview's job, a vertex of the first piece of H1 moved downwards, its cut-off (-1) along the fault."""
    pieces = [np.array(piece) for piece in picks.horizons[0].pieces]
    down_the_fault = np.ptp(picks.faults[0].points, axis=0) / np.ptp(picks.faults[0].points[:, 1])
    pieces[0][vertex] += drop * (down_the_fault if vertex == -1 else np.array([0.0, 1.0]))
    picks = replace(picks, horizons=(sw.Horizon(*pieces, name="H1"), *picks.horizons[1:]))
    return RestorationJob(CASE.section, picks, sw.Plan(fixed=CASE.fixed)).coarse


def dragged(*drops, **options):
    """The jobs and previews of a drag."""
    drag = []
    for drop in drops:
        asked = job(drop, **options)
        drag.append((asked, asked.restored(drag[-1] if drag else None)))
    return drag


def keeps_meshes(before, after):
    pairs = zip(before.stages, after.stages, strict=True)
    return [one.mesh_setup.mesh.triangles is other.mesh_setup.mesh.triangles for one, other in pairs]


def unevenness(restoration, horizon):
    level = np.concatenate([line[:, 1] for line in restoration.carried(horizon)])
    return np.sqrt(np.mean((level - np.median(level)) ** 2))


@pytest.mark.parametrize("vertex", [20, -1])
def test_a_moved_horizon_is_restored_in_the_same_mesh(vertex):
    drag = dragged(30.0, 34.0, 40.0, vertex=vertex)
    asked, kept = drag[-1]
    assert keeps_meshes(drag[-2][1], kept) == [True, True]
    spacing, horizon = asked.plan.spacing, asked.interpretation.horizons[0]
    assert unevenness(kept, horizon) < LEVEL * spacing
    assert [cutoff.misfit < 0.1 for cutoff in kept.stages[0].report.cutoffs] == [True] * 3
    differences = np.hypot(*(kept.to_restored(POINTS) - asked.restored().to_restored(POINTS)).T)
    assert np.isfinite(differences).all()
    assert np.percentile(differences, 95) < AGREEING * spacing


def test_a_horizon_flattened_first_keeps_its_mesh():
    plan = sw.Plan(steps=(sw.Step("flatten", "H1"),))
    case = sw.synthetic.sine_fold()
    horizon = case.interpretation.horizons[0]
    drag = []
    for drop in (10.0, 12.0, 16.0):
        (piece,) = (np.array(piece) for piece in horizon.pieces)
        piece[len(piece) // 3, 1] += drop
        picks = replace(case.interpretation, horizons=(sw.Horizon(piece, name="H1"),))
        asked = RestorationJob(case.section, picks, plan).coarse
        drag.append((asked, asked.restored(drag[-1] if drag else None)))
    assert keeps_meshes(drag[1][1], drag[2][1]) == [True]
    assert unevenness(drag[2][1], drag[2][0].interpretation.horizons[0]) < LEVEL * drag[2][0].plan.spacing


def test_a_mesh_is_made_anew_for_new_corners_and_for_faults():
    asked, first = dragged(10.0)[0]
    elsewhere = job(10.0, vertex=50, picks=asked.interpretation)
    assert keeps_meshes(first, elsewhere.restored((asked, first))) == [True, False]
    (fault,) = CASE.interpretation.faults
    shifted = replace(CASE.interpretation, faults=(sw.Fault(fault.points + (3.0, 0.0), name=fault.name),))
    assert keeps_meshes(first, job(10.0, picks=shifted).restored((asked, first))) == [False, False]


def test_the_full_restoration_does_not_depend_on_kept_meshes():
    asked, kept = dragged(10.0, 14.0)[-1]
    full = RestorationJob(CASE.section, asked.interpretation, sw.Plan(spacing=100.0, fixed=CASE.fixed))
    warm, cold = full.restored((asked, kept)), full.restored()
    assert warm.stages[-1].mesh_setup.points is None
    assert warm.stages[-1].outcome.solution.equations is None
    np.testing.assert_allclose(warm.to_restored(POINTS), cold.to_restored(POINTS), atol=0.05)
