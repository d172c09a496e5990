"""F3 and Teapot with their trial picks: every fault dies out inside the section."""

import numpy as np
import pytest

import seiswidgets as sw
from tests.sections import FILES, real_section


@pytest.fixture(scope="module", params=FILES)
def restored(request):
    section, picks = real_section(request.param)
    unfaulted = sw.Restoration(section).unfault(picks.faults, picks.horizons)
    return picks, unfaulted, unfaulted.flatten(picks.horizons[0])


def test_it_settles_soon(restored):
    _, _, flat = restored
    for stage in flat.stages:
        assert stage.report.converged
        assert stage.report.iterations <= 12


def test_cutoffs_meet(restored):
    picks, unfaulted, _ = restored
    section, report = unfaulted.original, unfaulted.stages[0].report
    sample = section.dz * section.metres[1]
    assert {cutoff.fault for cutoff in report.cutoffs} == {fault.name for fault in picks.faults}
    assert max(cutoff.misfit for cutoff in report.cutoffs) < 0.1 * sample


def test_areas_are_kept(restored):
    _, unfaulted, _ = restored
    stage = unfaulted.stages[0]
    assert np.average(np.abs(stage.area_ratio - 1) < 0.05, weights=stage.mesh.areas) >= 0.995


def test_the_horizon_becomes_level(restored):
    _, _, flat = restored
    (bed,) = flat.stages[1].report.beds
    assert bed.flatness < 0.1 * flat.original.dz
    assert abs(bed.length_change) < 0.01


def test_the_two_sides_of_each_fault_are_more_alike(restored, record_property):
    picks, unfaulted, _ = restored
    today = sw.Restoration(unfaulted.original)
    for fault in picks.faults:
        before, after = sw.cross_fault_correlation(today, fault), sw.cross_fault_correlation(unfaulted, fault)
        record_property(f"cross_fault_correlation across {fault.name}", f"{before:.2f} before, {after:.2f} after")
        print(f"{unfaulted.original.name}, fault {fault.name}: correlation {before:.2f} before, {after:.2f} after")
        assert after > before + 0.1


def test_points_go_there_and_back(restored):
    _, _, flat = restored
    section = flat.original
    x_min, x_max, z_min, z_max = section.extent
    points = np.random.default_rng(0).uniform((x_min, z_min), (x_max, z_max), (100_000, 2))
    back = flat.to_original(flat.to_restored(points))
    assert np.abs((back - points) * section.metres).max() < 1e-6 * flat.stages[0].spacing


@pytest.mark.parametrize(("name", "unfold"), [("teapot", "vertical shear"), ("f3", "length")])
def test_it_goes_back_through_time(name, unfold):
    section, picks = real_section(name)
    by_depth = sorted(picks.horizons, key=lambda pick: np.vstack(pick.pieces)[:, 1].mean())
    layers = [sw.Layer(None, 0.0), *(sw.Layer(pick.name, 10.0 * age) for age, pick in enumerate(by_depth, 1))]
    plan = sw.Plan.sequential(sw.Stratigraphy(layers), picks, isostasy=sw.Isostasy(5e3), unfold=unfold)
    restored = plan.restore(section, picks)
    assert not restored.skipped
    assert len(restored.stages) == len(plan.steps)
    assert all((stage.area_ratio > 0).all() for stage in restored.stages)
    assert restored.settled
