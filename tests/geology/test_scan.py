"""Scans of the slip along faults: known answers, doubts, and bad input."""

from dataclasses import replace

import numpy as np
import pytest

import seiswidgets as sw
from tests.geology.slips import slipped, throw_errors
from tests.sections import real_section


@pytest.mark.parametrize(
    ("kind", "slip"), [("constant", 120), ("linear", -120), ("elliptic", 120), ("elliptic", -120), ("blind", 60)]
)
def test_the_slip_is_found_in_noise(kind, slip):
    case, truth = slipped(kind, slip)
    found = sw.scan(case.section, case.interpretation.faults[0])
    errors = np.abs(throw_errors(case, found, truth))
    assert np.mean(errors <= 1) >= 0.95
    assert np.mean(errors > 7.5) < 0.05  # half a cycle
    assert found.decided
    assert found.best.kind == ("elliptic" if kind == "blind" else kind)
    assert found.peaks[0].weight > 0.8


@pytest.mark.parametrize("slip", [120, -120])
def test_slip_that_is_linear_in_intervals_is_found_where_these_are_given(slip):
    case, truth = slipped("piecewise", slip)
    found = sw.scan(case.section, case.interpretation.faults[0], intervals=truth.s)
    assert found.best.kind == "piecewise"
    assert np.mean(np.abs(throw_errors(case, found, truth)) <= 1) >= 0.95
    assert "piecewise" not in sw.scan(case.section, case.interpretation.faults[0]).curves


def test_a_listric_fault_has_a_constant_slip():
    case = sw.synthetic.listric_fault()
    found = sw.scan(case.section, case.interpretation.faults[0])
    assert found.best.kind == "constant"
    assert found.profile.slip[0] == pytest.approx(0.1 * 3500, abs=2)


def test_the_direction_and_the_position_of_a_fault_do_not_matter():
    case, truth = slipped("constant", 120)
    (fault,) = case.interpretation.faults
    upwards = sw.scan(case.section, sw.Fault(fault.points[::-1], "F1"))
    assert upwards.profile.slip[0] == pytest.approx(truth.slip[0], abs=2)
    moved = replace(case.section, x0=700.0, z0=-300.0)
    found = sw.scan(moved, sw.Fault(fault.points + [700, -300], "F1"))
    assert found.profile.slip == pytest.approx(upwards.profile.slip, rel=1e-6)


def test_time_and_depth_give_the_same_slip_in_rock():
    case, _ = slipped("constant", 120)
    (fault,) = case.interpretation.faults
    timed = replace(case.section, dz=4.0, z_unit="ms", velocity=2500.0)
    found = sw.scan(timed, sw.Fault(fault.points * [1, 0.8], "F1"))
    assert found.profile.slip == pytest.approx(sw.scan(case.section, fault).profile.slip, rel=1e-6)
    assert found.throw([500]) == pytest.approx(0.8 * found.traces.offsets(500, found.profile)[0, 1] / 0.8)


def test_horizons_on_one_side_get_a_counterpart():
    case = sw.synthetic.planar_fault()
    (fault,), (one, *_) = case.interpretation.faults, case.interpretation.horizons
    found = sw.scan(case.section, fault, sw.Horizon(one.pieces[0], name="H1"))
    (proposal,) = found.proposals
    assert (proposal.horizon, proposal.wall) == ("H1", "hanging wall")
    assert proposal.throw == pytest.approx(150, abs=case.section.dz)
    assert proposal.confidence > 0.95
    truth = np.interp(proposal.points[:, 0], *one.pieces[1].T)
    np.testing.assert_allclose(proposal.points[:, 1], truth, atol=case.section.dz)
    assert sw.scan(case.section, fault, one).proposals == ()


@pytest.mark.parametrize("name", ["f3", "teapot"])
def test_real_faults_have_the_throw_that_was_picked_by_hand(name):
    section, picks = real_section(name)
    for fault in picks.faults:
        found = sw.scan(section, fault)
        for horizon in picks.horizons:
            try:
                (cutoff,) = sw.cutoffs(fault, horizon)
            except sw.PickError:
                continue
            arcs, _ = found.traces.arcs(section.to_rock([cutoff.hanging_wall, cutoff.footwall]))
            throw = found.throw(arcs.mean())[0]
            assert not found.decided or abs(throw - cutoff.throw) <= 2 * section.dz


def test_noise_alone_gives_no_credible_match():
    case = sw.synthetic.planar_fault()
    noise = replace(case.section, amplitude=np.random.default_rng(0).standard_normal(case.section.shape))
    found = sw.scan(noise, case.interpretation.faults[0])
    assert [finding.kind for finding in found.findings] == ["no match"]
    assert "no slip matches its two sides credibly" in found.findings[0].text


def test_a_repetitive_section_is_undecided():
    case = sw.synthetic.planar_fault(dip=90)
    z = case.section.z[:, None] + np.where(case.section.x < 0.45 * 4000, 0, -60)
    periodic = replace(case.section, amplitude=np.cos(2 * np.pi * z / 70))
    found = sw.scan(periodic, case.interpretation.faults[0])
    assert not found.decided


def test_bad_input_says_what_is_wrong():
    case = sw.synthetic.planar_fault()
    (fault,) = case.interpretation.faults
    with pytest.raises(sw.PickError, match="fault 'F' lies outside the section"):
        sw.scan(case.section, sw.Fault([(9000, 0), (9500, 900)], "F"))
    flat = replace(case.section, amplitude=np.full(case.section.shape, 3.0))
    with pytest.raises(sw.PickError, match="all amplitudes are alike, so there is nothing to match"):
        sw.scan(flat, fault)
    gap = case.section.amplitude.copy()
    gap[:, case.section.x > 1000] = np.nan
    with pytest.raises(sw.PickError, match="only 0 samples beside fault 'F1' have data on both sides"):
        sw.scan(replace(case.section, amplitude=gap), fault)
    with pytest.raises(sw.SettingError, match="in increasing order"):
        sw.scan(case.section, fault, slips=[3, 2, 1])
    with pytest.raises(sw.Cancelled, match="the scan was cancelled"):
        sw.scan(case.section, fault, progress=lambda share: False)
    with pytest.raises(sw.SettingError, match="width must be a whole number of 1 or more"):
        sw.scan(case.section, fault, width=0)


def test_a_scan_can_be_limited_to_some_slips():
    case = sw.synthetic.planar_fault()
    found = sw.scan(case.section, case.interpretation.faults[0], slips=np.linspace(100, 250, 40))
    assert found.profile.slip[0] == pytest.approx(150 / np.sin(np.radians(60)), abs=1)
    assert found.curves["constant"].slip[[0, -1]].tolist() == [100, 250]
    assert found.local_correlation.shape == (len(found.slip), len(found.traces.s))
    close = sw.scan(case.section, case.interpretation.faults[0], slips=[172, 173, 174])
    assert close.profile.slip[0] == pytest.approx(found.profile.slip[0], abs=1)


def test_a_scan_prints_its_peaks_with_throw_and_heave():
    case = sw.synthetic.planar_fault(throw=150)
    scanned = sw.scan(case.section, case.interpretation.faults[0])
    np.testing.assert_allclose(scanned.table.column("throw")[0], 150, atol=case.section.dz)
    assert repr(scanned).startswith("Matches at fault F1")
    assert len(repr(scanned).splitlines()) == 2 + len(scanned.peaks) + len(scanned.findings)
    assert "throw (m)" in scanned._repr_html_()


@pytest.mark.parametrize("intervals", [[100], [100, 50], "F1"])
def test_intervals_must_increase(intervals):
    case = sw.synthetic.planar_fault()
    with pytest.raises(sw.SettingError, match="intervals must be two or more numbers in increasing order"):
        sw.scan(case.section, case.interpretation.faults[0], intervals=intervals)
