"""Horizons that end short of a fault: how far they are extended, in which direction, and what the report says."""

import numpy as np
import pytest

import seiswidgets as sw

SECTION = sw.Section(np.zeros((301, 561), np.float32), 25.0, 5.0)
FAULT = sw.Fault([(10500.0, 0.0), (11300.0, 1500.0)], name="F")
RIGHT = [(11000.0, 900.0), (14000.0, 900.0)]


def on_fault(z, shift=0.0):
    return np.interp(z, FAULT.points[:, 1], FAULT.points[:, 0]) + shift


def extension(*pieces, faults=(FAULT,)):
    report = sw.Restoration(SECTION).unfault(faults, sw.Horizon(*pieces, name="H")).stages[-1].report
    found = [finding for finding in report.findings if finding.kind == "extension"]
    return report, found


@pytest.mark.parametrize(("gap", "severity"), [(30.0, "note"), (120.0, "note"), (400.0, "warning")])
def test_an_extension_is_reported_with_its_distance(gap, severity):
    end = on_fault(800) - gap
    report, (finding,) = extension([(0, 800), (end, 800)], [(on_fault(900), 900), (14000, 900)])
    assert (finding.severity, finding.pick) == (severity, "H")
    assert f"horizon H was extended by {gap:g} m to F near x={end:.6g} m, z=800 m" in finding.text
    assert finding.where == pytest.approx((end, 800))
    assert report.cutoffs[0].throw == pytest.approx(100, abs=0.1)


def test_beds_that_end_at_the_fault_are_not_extended():
    assert extension([(0, 800), (on_fault(800), 800)], [(on_fault(900), 900), (14000, 900)])[1] == []


@pytest.mark.parametrize("stop", [10000.0, 9100.0])
def test_a_long_piece_is_not_extended_far(stop):
    with pytest.raises(sw.PickError, match=r"piece 1 ends .* m away from the fault, too far to be extended to it"):
        extension([(0, 800), (stop, 800)], RIGHT)


def test_a_piece_is_not_extended_to_a_fault_that_nothing_else_reaches():
    other = sw.Fault([(8000.0, 500.0), (8200.0, 830.0)], name="F2")
    pieces = [(8400, 800), (on_fault(800), 800)], [(on_fault(900), 900), (14000, 900)]
    beside = sw.Horizon([(7000, 600), (8061, 600)], [(8066, 610), (9000, 610)], name="upper")
    stage = sw.Restoration(SECTION).unfault([FAULT, other], [sw.Horizon(*pieces, name="H"), beside]).stages[-1]
    assert {(cutoff.fault, cutoff.horizon) for cutoff in stage.report.cutoffs} == {("F", "H"), ("F2", "upper")}


def test_a_small_gap_on_a_short_piece_is_bridged():
    other = sw.Fault([(10600.0, 0.0), (11400.0, 1500.0)], name="F2")
    between = [(on_fault(820, 20), 820), (on_fault(820, 80), 820)]
    pieces = [(0, 800), (on_fault(800), 800)], between, [(on_fault(850, 100), 850), (14000, 850)]
    report, (finding,) = extension(*pieces, faults=[FAULT, other])
    assert {cutoff.fault: round(cutoff.throw, 3) for cutoff in report.cutoffs} == {"F": 20, "F2": 30}
    assert "by 20 m to F near" in finding.text
    assert "by 20 m to F2 near" in finding.text


def test_a_steep_last_segment_is_not_extrapolated():
    steep = [(0, 800), (10600, 800), (10650, 870)]
    report, (finding,) = extension(steep, [(on_fault(970), 970), (14000, 970)])
    assert report.cutoffs[0].throw == pytest.approx(100, abs=1)
    assert finding.severity == "warning"


def test_an_overshoot_towards_another_fault_stays_an_overshoot():
    other = sw.Fault([(10700.0, 0.0), (11500.0, 1500.0)], name="F2")
    over = [(0, 800), (on_fault(800, 40), 800)]
    middle = [(on_fault(830), 830), (on_fault(830, 200), 830)]
    report, _ = extension(over, middle, [(on_fault(860, 200), 860), (14000, 860)], faults=[FAULT, other])
    assert [round(cutoff.throw, 3) for cutoff in report.cutoffs] == [30, 30]
