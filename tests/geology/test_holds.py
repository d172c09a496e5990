"""Pins, a regional level, the far field of a block that is not cut off, and blocks that should not turn."""

import numpy as np
import pytest

import seiswidgets as sw

WIDTH, DEPTH = 8000.0, 960.0
SECTION = sw.Section(np.zeros((97, 161), np.float32), 50.0, 10.0)
PINS = [(7000.0, 300.0), (7800.0, 700.0)]


def at(z):
    """The point of a fault that dips by 45 degrees to the left."""
    return (5000.0 - z, z)


def unfaulted(top, section=SECTION, **options):
    """A fault that offsets one bed by 150 m, restored; it starts at a depth of ``top``."""
    fault = sw.Fault([at(top), at(DEPTH)], name="F1")
    bed = sw.Horizon([(0.0, 600.0), at(600.0)], [at(450.0), (WIDTH, 450.0)], name="H1")
    return sw.Restoration(section, 150.0).unfault(fault, bed, **options)


@pytest.fixture(scope="module")
def free():
    return {top: unfaulted(top) for top in (0.0, 200.0)}


@pytest.mark.parametrize("top", [0.0, 200.0])
@pytest.mark.parametrize("pins", [PINS, PINS[:1]], ids=["two", "one"])
def test_pins_stay_and_hold_nothing_else(free, top, pins):
    restored = unfaulted(top, pins=pins)
    assert restored.settled
    np.testing.assert_allclose(restored.to_restored(pins), pins, atol=0.02)
    energies = [sum(stage.report.energy.values()) for stage in (*free[top].stages, *restored.stages)]
    assert energies[1] == pytest.approx(energies[0], rel=0.02, abs=1e-6)  # a rigid motion brings one to the other


def test_of_all_turns_about_one_pin_the_least_is_taken():
    restored = unfaulted(0.0, pins=PINS[:1])
    points = np.stack(np.meshgrid(np.linspace(50, 7950, 40), np.linspace(20, 940, 20)), axis=-1).reshape(-1, 2)
    moved = restored.to_restored(points)
    before, after = points - PINS[0], moved - PINS[0]
    turn = np.sum(before[:, 0] * after[:, 1] - before[:, 1] * after[:, 0]) / np.sum(before * after)
    assert abs(turn) < 2e-3


@pytest.mark.parametrize("top", [0.0, 200.0])
@pytest.mark.parametrize("regional", [500.0, [(0.0, 500.0), (WIDTH, 500.0)]], ids=["level", "line"])
def test_a_regional_level_is_kept_at_both_ends(top, regional):
    restored = unfaulted(top, regional=regional)
    ends = np.array([(0.0, 500.0), (WIDTH, 500.0)])
    moved = restored.to_restored(ends + [(1e-6, 0), (-1e-6, 0)])
    np.testing.assert_allclose(moved[:, 1], 500, atol=0.02)
    assert abs(moved[0, 0] - ends[0, 0]) > 10
    assert restored.settled


def test_the_far_field_stays_where_a_fault_dies_out():
    for point, x in (((7000.0, 500.0), WIDTH), ((1000.0, 500.0), 0.0)):
        restored = unfaulted(200.0, fixed=point)
        assert restored.settled
        border = np.column_stack([np.full(5, x + (1e-6 if x == 0 else -1e-6)), np.linspace(10, 950, 5)])
        np.testing.assert_allclose(restored.to_restored(border), border, atol=1e-3)
        other = restored.to_restored([(WIDTH - x + (1e-6 if x else -1e-6), 500.0)])[0] - (WIDTH - x, 500.0)
        assert np.hypot(*other) > 100


def test_blocks_do_not_turn_where_that_is_dear(free):
    turns = []
    for restored in (free[200.0], unfaulted(200.0, weights=sw.Weights(rotation=1.0))):
        turned = {motion.part: motion.rotation for motion in restored.stages[-1].report.motions}
        turns.append(abs(turned["footwall of F1"] - turned["hanging wall of F1"]))
    assert turns[0] > 5
    assert turns[1] < 1


def test_held_points_that_cannot_be_used():
    with pytest.raises(sw.PickError, match=r"pins must be points \(x, z\) of two finite numbers each, but is 'left'"):
        unfaulted(0.0, pins="left")
    with pytest.raises(sw.PickError, match="regional must be points"):
        sw.Plan(regional=[(0.0, np.nan)])
    with pytest.raises(sw.PickError, match="a pin lies outside the section"):
        unfaulted(0.0, pins=[(-500.0, 100.0)])
    with pytest.raises(sw.SettingError, match="pins and a regional level need solver='gauss-newton'"):
        unfaulted(0.0, regional=500.0, solver="fixed-point")


def test_a_plan_passes_what_is_held_and_a_session_keeps_it(tmp_path):
    case = sw.synthetic.planar_fault()
    plan = sw.Plan((sw.Step("unfault"),), pins=((3500.0, 500.0),), regional=500.0, weights=sw.Weights(rotation=0.5))
    restored = plan.restore(case.section, case.interpretation)
    np.testing.assert_allclose(restored.to_restored(plan.pins), plan.pins, atol=0.02)
    source = sw.SectionSource("synthetic", "planar_fault")
    sw.Session.of(case.section, source, case.interpretation, plan=plan).save(tmp_path / "session.json")
    assert sw.open_session(tmp_path / "session.json").plan == plan
