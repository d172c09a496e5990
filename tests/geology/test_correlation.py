import numpy as np
import pytest

import seiswidgets as sw


@pytest.mark.parametrize("make", [sw.synthetic.planar_fault, sw.synthetic.listric_fault, sw.synthetic.blind_fault])
def test_restoring_makes_the_two_sides_alike(make):
    case = make(noise=0.0)
    picks = case.interpretation
    today = sw.Restoration(case.section)
    restored = today.unfault(picks.faults, picks.horizons, fixed=case.fixed)
    (fault,) = picks.faults
    assert sw.cross_fault_correlation(today, fault) < 0.3
    assert sw.cross_fault_correlation(restored, fault) > 0.8


def test_level_beds_without_slip_are_alike_from_the_beginning():
    case = sw.synthetic.planar_fault(noise=0.0)
    level = sw.synthetic.tilt(dip=0, noise=0.0)
    assert sw.cross_fault_correlation(sw.Restoration(level.section), case.interpretation.faults[0]) == pytest.approx(
        1, abs=1e-6
    )


def test_it_is_worse_with_a_wrong_match():
    """A horizon stitched to another one: the deformation does not tell, the cross_fault_correlation does."""
    case = sw.synthetic.planar_fault(noise=0.0)
    first, second, _ = case.interpretation.horizons
    today = sw.Restoration(case.section)
    wrong = sw.Horizon(first.pieces[0], second.pieces[1])
    cross_fault_correlation = {
        name: sw.cross_fault_correlation(
            today.unfault(case.interpretation.faults, horizon, fixed=case.fixed), *case.interpretation.faults
        )
        for name, horizon in (("right", first), ("wrong", wrong))
    }
    assert cross_fault_correlation["right"] > cross_fault_correlation["wrong"] + 0.5


def test_too_short_a_fault_cannot_be_compared():
    section = sw.synthetic.tilt(dip=0).section
    with pytest.raises(sw.PickError, match=r"only .* samples beside fault 'F' have data"):
        sw.cross_fault_correlation(sw.Restoration(section), sw.Fault([(10, 500), (20, 700)], name="F"))


def test_it_is_known_along_the_fault_and_how_far_it_can_be_believed():
    case = sw.synthetic.planar_fault(noise=0.0)
    picks = case.interpretation
    today = sw.Restoration(case.section)
    restored = sw.cross_fault_correlation(today.unfault(picks.faults, picks.horizons, fixed=case.fixed), *picks.faults)
    assert restored.total == float(restored)
    assert restored.significance > 0.999
    assert 20 < restored.samples < 100
    inner = np.isfinite(restored.slip)
    np.testing.assert_allclose(restored.slip[inner], 150 / np.sin(np.radians(60)), atol=1)
    assert np.median(restored.local[inner]) > 0.95
    assert sw.cross_fault_correlation(today, *picks.faults).significance < 0.9


def test_dipping_beds_do_not_bias_it():
    """Beds that dip differently on the two sides, which level strips would misplace by several samples."""
    case = sw.synthetic.listric_fault(turn=0.15, noise=0.0)
    (fault,) = case.interpretation.faults
    slips = np.linspace(500, 550, 11)
    correlation = [sw.match(case.section, fault, sw.SlipProfile([0], [slip])) for slip in slips]
    assert slips[np.argmax(correlation)] == pytest.approx(0.15 * 3500, abs=5)
    assert max(correlation) > 0.95


def test_windows_above_and_below_tell_where_the_match_ends():
    case = sw.synthetic.planar_fault(noise=0.0)
    (fault,) = case.interpretation.faults
    half = sw.SlipProfile([0, 1000, 1001, 2000], [173.2, 173.2, 0, 0])
    found = sw.match(case.section, fault, half)
    at = np.argmin(np.abs(found.s - 1000))
    assert found.above[at] > 0.9
    assert found.below[at] < 0.6


def test_few_samples_have_a_low_significance():
    case = sw.synthetic.planar_fault(noise=0.0)
    (fault,) = case.interpretation.faults
    short = sw.Fault(fault.points[0] + (fault.points[-1] - fault.points[0]) * [[0.4], [0.44]], "short")
    best = max(sw.match(case.section, short, sw.SlipProfile([0], [slip])) for slip in range(-80, 80, 5))
    assert best > 0.6
    assert best.significance < 0.97
