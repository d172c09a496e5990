"""Faults that die out inside the section: the rock around them bends."""

import numpy as np
import pytest

import seiswidgets as sw
from tests.geology.answers import largest_throw


@pytest.fixture(scope="module", params=[{}, {"slip": 80}, {"dip": 80}, {"dip": 120}, {"length": 400}], ids=str)
def answer(request):
    case = sw.synthetic.blind_fault(**request.param)
    picks = case.interpretation
    return case, sw.Restoration(case.section).unfault(picks.faults, picks.horizons)


def test_cutoffs_meet(answer):
    case, unfaulted = answer
    cutoffs = unfaulted.stages[-1].report.cutoffs
    assert len(cutoffs) == len(case.interpretation.horizons)
    assert max(cutoff.misfit for cutoff in cutoffs) < 0.1 * case.section.dz


def test_areas_are_kept(answer):
    _, unfaulted = answer
    ratio = unfaulted.stages[-1].area_ratio
    assert np.mean(np.abs(ratio - 1) < 0.1) >= 0.98
    assert (ratio > 0).all()


def test_far_corners_hardly_move(answer):
    case, unfaulted = answer
    x_min, x_max, z_min, z_max = case.section.extent
    corners = np.array([(x_min, z_min), (x_max, z_min), (x_min, z_max), (x_max, z_max)])
    stage = unfaulted.stages[-1]
    moved = np.hypot(*(stage.map.forward(corners) - corners).T)
    assert moved.max() < 0.1 * largest_throw(stage)


def test_nothing_is_torn_beyond_a_tip(answer):
    case, unfaulted = answer
    fault = case.interpretation.faults[0].points
    along = (fault[1] - fault[0]) / np.hypot(*(fault[1] - fault[0]))
    across = np.array([-along[1], along[0]])
    beyond = np.concatenate([fault[0] - np.outer([1, 5, 20, 80], along), fault[1] + np.outer([1, 5, 20, 80], along)])
    both = [unfaulted.to_restored(beyond + side * 1e-3 * across) for side in (1, -1)]
    assert np.hypot(*(both[0] - both[1]).T).max() < 0.02


def test_the_slip_is_that_of_the_fault(answer):
    """Beside the fault's centre the two sides slide back by the slip there."""
    case, unfaulted = answer
    report = unfaulted.stages[-1].report
    slip = np.hypot([cutoff.throw for cutoff in report.cutoffs], [cutoff.heave for cutoff in report.cutoffs])
    for horizon, size in zip(case.interpretation.horizons, slip, strict=True):
        ends = np.array([horizon.pieces[0][-1], horizon.pieces[1][0]])
        inside = ends + [(-1e-3, 0), (1e-3, 0)]
        back = unfaulted.to_restored(inside)
        assert np.hypot(*(ends[0] - ends[1])) == pytest.approx(size, rel=1e-4)
        assert np.hypot(*(back[0] - back[1])) < 0.02 * size
