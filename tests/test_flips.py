import numpy as np
import pytest

import seiswidgets as sw
from seiswidgets.core.mesh import triangle_areas
from tests.cases import SPACING, random_case


def assert_no_flips(restoration):
    for stage in restoration.stages:
        assert stage.report.flipped == 0
        assert triangle_areas(stage.mesh.vertices, stage.mesh.triangles).min() > 0
        assert triangle_areas(stage.vertices, stage.mesh.triangles).min() > 0


@pytest.mark.parametrize("seed", range(100))
def test_no_triangle_flips_and_points_come_back(seed):
    section, faults, horizons, fixed = random_case(seed)
    unfaulted = sw.Restoration(section, spacing=SPACING).unfault(faults, horizons, fixed=fixed)
    restored = unfaulted.flatten(horizons[0])
    assert_no_flips(restored)
    if {finding.kind for finding in restored.findings} - {"fault end", "bed length"}:
        return  # blocks may still overlap, and two places be one
    x_min, x_max, z_min, z_max = section.extent
    points = np.random.default_rng(seed).uniform((x_min, z_min), (x_max, z_max), (1000, 2))
    there = restored.to_restored(points)
    mapped = np.isfinite(there).all(axis=1)
    assert mapped.mean() > 0.99
    np.testing.assert_allclose(restored.to_original(there[mapped]), points[mapped], rtol=0, atol=1e-6 * SPACING)


def test_picks_that_contradict_each_other_are_named():
    case = sw.synthetic.planar_fault(throw=150.0)
    (fault,), (first, _, third) = case.interpretation.faults, case.interpretation.horizons
    # what is the upper bed on one side is the lower one on the other: throws of 950 m and -650 m
    falling = sw.Horizon(first.pieces[0], third.pieces[1], name="falling")
    rising = sw.Horizon(third.pieces[0], first.pieces[1], name="rising")
    restored = sw.Restoration(case.section, spacing=SPACING).unfault(fault, [falling, rising], fixed=case.fixed)
    assert_no_flips(restored)
    (contradiction,) = [finding for finding in restored.findings if "contradicts" in finding.text]
    assert contradiction.pick == "rising"
    assert "'falling'" in contradiction.text
    (cutoff,) = restored.stages[-1].report.cutoffs  # the other one is carried along
    assert cutoff.horizon == "falling"
