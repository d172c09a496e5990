"""A restoration between its stages."""

import numpy as np
import pytest

import seiswidgets as sw
from tests.geology.answers import random_points, restored_fold


@pytest.fixture
def fold():
    return restored_fold()[1]


@pytest.fixture(scope="module")
def listric():
    case = sw.synthetic.listric_fault(turn=0.3)
    picks = case.interpretation
    return case, sw.Restoration(case.section, spacing=100).unfault(picks.faults, picks.horizons, fixed=case.fixed)


@pytest.mark.parametrize("time", [0, 1, 2])
def test_at_a_whole_number_it_is_the_stages_themselves(fold, time):
    assert fold.at(time).stages == fold.stages[:time]


def test_it_starts_where_the_stage_starts_and_ends_where_it_ends(fold):
    spacing = fold.stages[1].spacing
    for stage in fold.stages:
        np.testing.assert_allclose(stage.part(0).vertices, stage.mesh.vertices, atol=1e-9 * spacing)
        np.testing.assert_allclose(stage.part(1).vertices, stage.vertices, atol=1e-9 * spacing)


@pytest.mark.parametrize("time", [0.25, 0.5, 0.9])
def test_a_block_that_slides_round_a_listric_fault_keeps_its_area(listric, time):
    _, restored = listric
    (now,), (end,) = restored.at(time).stages, restored.stages
    assert np.abs(now.area_ratio - 1).max() <= np.abs(end.area_ratio - 1).max()


@pytest.mark.parametrize("time", [0.3, 0.5])
def test_a_block_that_slides_round_a_listric_fault_stays_on_it(listric, time):
    """In between no more rock lies on other rock, and no wider gap opens, than at the end."""
    _, restored = listric
    (now,), (end,) = restored.at(time).stages, restored.stages
    unlike = [abs(stage.outline.area - np.sum(stage.mesh.areas / stage.area_ratio)) for stage in (now, end)]
    assert unlike[0] < unlike[1] + 1e-4 * end.outline.area


def test_the_report_is_that_of_the_whole_stage(fold):
    assert fold.at(1.5).stages[1].report is fold.stages[1].report
    assert fold.at(1.5).at(1.2).stages[1].report is fold.stages[1].report


@pytest.mark.parametrize("time", [0.5, 1.5])
def test_points_go_there_and_back_in_between(fold, time):
    moment, points = fold.at(time), random_points(fold.original, 20_000)
    there = moment.to_restored(points)
    inside = np.isfinite(there).all(axis=1)
    off = np.abs(moment.to_original(there) - points).max(axis=1)
    assert np.mean(inside) > 0.999
    assert np.mean(off[inside] < 1e-6 * fold.stages[0].spacing) > 0.99  # on the way, sides of a fault may overlap


def test_a_picture_in_between(fold):
    picture = fold.at(0.5).picture(order=1)
    assert np.isfinite(picture.amplitude).mean() > 0.9
    assert (picture.dx, picture.dz) == (fold.original.dx, fold.original.dz)


@pytest.mark.parametrize("time", [-0.1, 2.1, np.nan, "late"])
def test_a_time_that_is_not_there(fold, time):
    with pytest.raises(sw.SettingError, match="time must be"):
        fold.at(time)
