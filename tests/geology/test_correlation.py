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
