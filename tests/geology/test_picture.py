"""Pictures with fewer samples, and the maps that programs carry points by."""

from dataclasses import replace

import numpy as np
import pytest

import seiswidgets as sw
from tests.geology.answers import random_points, restored_fold


@pytest.fixture
def fold():
    return restored_fold()[1]


@pytest.mark.parametrize("cells", [4, 1000, 20_000])
def test_a_coarse_picture_is_every_so_manyth_sample_of_the_fine_one(fold, cells):
    fine, coarse = fold.picture(order=1), fold.picture(order=1, cells=cells)
    step = round(coarse.dx / fine.dx)
    assert coarse.amplitude.size <= cells
    assert (coarse.dx, coarse.dz) == (step * fine.dx, step * fine.dz)
    column = np.rint((coarse.x - fine.x0) / fine.dx).astype(int)
    row = np.rint((coarse.z - fine.z0) / fine.dz).astype(int)
    on = np.ix_((row >= 0) & (row < fine.shape[0]), (column >= 0) & (column < fine.shape[1]))
    expected = fine.amplitude[
        np.ix_(*(line[(line >= 0) & (line < size)] for line, size in ((row, fine.shape[0]), (column, fine.shape[1]))))
    ]
    alike = np.isclose(coarse.amplitude[on], expected, rtol=1e-4, atol=1e-6, equal_nan=True)
    assert alike.mean() > 0.999  # a sample on the seam of a fault may be either side's


def test_a_coarse_picture_stands_on_multiples_of_its_step(fold):
    coarse = fold.picture(order=1, cells=5000)
    for start, origin, step in ((coarse.x0, fold.original.x0, coarse.dx), (coarse.z0, fold.original.z0, coarse.dz)):
        assert (start - origin) / step == pytest.approx(round((start - origin) / step), abs=1e-9)


def test_with_room_enough_the_picture_is_whole(fold):
    np.testing.assert_array_equal(
        fold.picture(order=1, cells=10**7).amplitude, fold.picture(order=1).amplitude, strict=True
    )


def test_todays_section_is_thinned_out():
    section = sw.synthetic.tilt().section
    coarse = sw.Restoration(section).picture(order=1, cells=section.amplitude.size // 3)
    np.testing.assert_allclose(coarse.amplitude, section.amplitude[::2, ::2], atol=1e-6)
    assert sw.Restoration(section).picture() is section


@pytest.mark.parametrize("cells", [3, 10.0, "few"])
def test_too_few_cells(fold, cells):
    with pytest.raises(sw.SettingError, match="cells must be a whole number of 4 or more"):
        fold.picture(cells=cells)


def carried(maps, points):
    """Points after a chain of (source, target, triangles), one by one by barycentric coordinates, shape (n, 2)."""
    for source, target, triangles in maps:
        points = np.array([_carried(source[triangles], target[triangles], point) for point in points])
    return points


def _carried(before, after, point):
    matrix = np.concatenate([before.transpose(0, 2, 1), np.ones((len(before), 1, 3))], axis=1)
    weights = np.linalg.solve(matrix, np.append(point, 1.0)[:, None])[..., 0]
    best = np.argmax(weights.min(axis=1))
    return weights[best] @ after[best]


def test_the_maps_do_what_the_restoration_does(fold):
    section = fold.original
    restored = replace(fold, original=replace(section, z_unit="ms", velocity=2500.0, dz=section.dz / 1.25))
    points = random_points(restored.original, 200)
    there = restored.to_restored(points)
    np.testing.assert_allclose(carried(restored.maps_to_restored, points), there, atol=1e-6)
    np.testing.assert_allclose(carried(restored.maps_to_original, there), restored.to_original(there), atol=1e-6)


def test_today_there_is_no_map():
    today = sw.Restoration(sw.synthetic.tilt().section)
    assert today.maps_to_restored == today.maps_to_original == []
