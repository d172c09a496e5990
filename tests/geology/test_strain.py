"""Area ratios at places of the original section."""

import numpy as np
import pytest

import seiswidgets as sw
from tests.geology.test_restoration import random_points, restored_in_two_stages


@pytest.fixture(scope="module")
def fold():
    return restored_in_two_stages(sw.synthetic.faulted_fold(), spacing=120)


def test_rock_that_was_only_turned_kept_its_area():
    case = sw.synthetic.tilt()
    restored = sw.Restoration(case.section, spacing=200).flatten(case.interpretation.horizons[0])
    np.testing.assert_allclose(restored.area_ratio_at(random_points(case.section, 500)), 1, atol=1e-3)


def test_today_nothing_has_changed(fold):
    today = sw.Restoration(fold.original)
    assert (today.area_ratio_at(random_points(fold.original, 10)) == 1).all()


def test_the_ratio_is_the_product_of_the_stages(fold):
    points = random_points(fold.original, 3000)
    stages = [fold.area_ratio_at(points, stage=stage) for stage in (0, 1)]
    np.testing.assert_allclose(fold.area_ratio_at(points), stages[0] * stages[1], rtol=1e-12)


def test_the_ratio_is_what_a_small_square_does(fold):
    """Against the map itself: the area of a small square of points before and after."""
    centres, half = random_points(fold.original, 2000, seed=1), 1e-3
    corners = fold.to_restored(
        (centres[:, None] + half * np.array([(-1, -1), (1, -1), (1, 1), (-1, 1)])).reshape(-1, 2)
    )
    (x, z), (u, w) = (
        np.moveaxis(corners.reshape(-1, 4, 2)[:, a] - corners.reshape(-1, 4, 2)[:, b], -1, 0)
        for a, b in ((2, 0), (3, 1))
    )
    expected = 4 * half**2 / (0.5 * (x * w - z * u))
    alike = np.isclose(fold.area_ratio_at(centres), expected, rtol=1e-5)
    assert alike.mean() > 0.99  # a few squares lie across an edge of the mesh


@pytest.mark.parametrize("stage", [None, 0])
def test_the_sampled_ratios_add_up_to_the_area_after(fold, stage):
    after = (fold.stages[-1] if stage is None else fold.stages[stage]).vertices
    mesh = (fold.stages[-1] if stage is None else fold.stages[stage]).mesh
    triangles = after[mesh.triangles]
    (ax, az), (bx, bz) = (np.moveaxis(triangles[:, k] - triangles[:, 0], -1, 0) for k in (1, 2))
    area = np.sum(ax * bz - az * bx) / 2
    sampled = fold.area_ratio_sampled(100_000, stage=stage)
    assert np.mean(1 / sampled) * fold.stages[0].mesh.areas.sum() == pytest.approx(area, rel=1e-3)


@pytest.mark.parametrize("count", [1, 500, 20_000])
def test_about_so_many_places_are_sampled(fold, count):
    assert len(fold.area_ratio_sampled(count)) == pytest.approx(count, rel=0.05)


def test_outside_there_is_no_ratio(fold):
    assert np.isnan(fold.area_ratio_at([(-1e4, 0), (0, 1e5), (np.nan, 3)])).all()


@pytest.mark.parametrize("stage", [2, -1, 0.5])
def test_a_stage_that_is_not_there(fold, stage):
    with pytest.raises(sw.SettingError, match=r"stage must be the number of a stage \(0 to 1\)"):
        fold.area_ratio_at([(0, 0)], stage=stage)


def test_no_places_at_all(fold):
    with pytest.raises(sw.SettingError, match="count must be a whole number of 1 or more"):
        fold.area_ratio_sampled(0)
