"""Area ratios at places of the original section."""

import numpy as np
import pytest

import seiswidgets as sw
from seiswidgets.core.mesh import triangle_areas
from tests.geology.answers import random_points, restored_fold


@pytest.fixture
def fold():
    return restored_fold()[1]


def test_rock_that_was_only_turned_kept_its_area():
    case = sw.synthetic.tilt()
    restored = sw.Restoration(case.section, spacing=200).flatten(case.interpretation.horizons[0])
    np.testing.assert_allclose(restored.area_ratio_at(random_points(case.section, 500)), 1, atol=1e-3)


def test_today_nothing_has_changed(fold):
    today = sw.Restoration(fold.original)
    assert (today.area_ratio_at(random_points(fold.original, 10)) == 1).all()


def test_the_ratio_is_the_product_of_the_stages(fold):
    points = random_points(fold.original, 3000)
    first = sw.Restoration(fold.original, stages=fold.stages[:1])
    there = fold.original.to_rock(first.to_restored(points))
    second = fold.stages[1].area_ratio[fold.stages[1].map.source_finder(there)]
    np.testing.assert_allclose(fold.area_ratio_at(points), first.area_ratio_at(points) * second, rtol=1e-12)


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


def test_the_ratios_of_equal_cells_add_up_to_the_area_after(fold):
    x_min, x_max, z_min, z_max = fold.original.extent
    x, z = (low + (high - low) * (np.arange(300) + 0.5) / 300 for low, high in ((x_min, x_max), (z_min, z_max)))
    ratio = fold.area_ratio_at(np.stack(np.meshgrid(x, z), axis=-1).reshape(-1, 2))
    after = triangle_areas(fold.stages[-1].vertices, fold.stages[-1].mesh.triangles).sum()
    assert np.nanmean(1 / ratio) * fold.stages[0].mesh.areas.sum() == pytest.approx(after, rel=1e-3)


def test_outside_there_is_no_ratio(fold):
    assert np.isnan(fold.area_ratio_at([(-1e4, 0), (0, 1e5), (np.nan, 3)])).all()
