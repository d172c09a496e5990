from functools import cache

import numpy as np
import pytest
import shapely

import seiswidgets as sw
from seiswidgets.core.correlated_noise import noise_kernels
from seiswidgets.geology.measures import depths_along
from tests.executors import InThisThread

PICKS_ONLY = sw.Plan(steps=())


def run(uncertainty, members=200, plan=PICKS_ONLY, case=None, **choices):
    case = case or planar_fault()
    return sw.ensemble(case.section, case.interpretation, plan, uncertainty, members, **choices)


@cache
def planar_fault(**choices):
    return sw.synthetic.planar_fault(**{"throw": 100, "dip": 60, "horizons": (1000.0,), **choices})


def spread(ensemble):
    return dict(zip(ensemble.labels, np.nanstd(ensemble.values, axis=0, ddof=1), strict=True))


def test_noise_has_unit_variance_and_the_correlation_asked_for():
    kernels = noise_kernels(np.linspace(0, 3000, 61), 500.0)
    correlation = kernels @ kernels.T
    np.testing.assert_allclose(np.diag(correlation), 1)
    np.testing.assert_allclose(correlation[30, [35, 40, 50]], np.exp([-0.125, -0.5, -2]), atol=2e-3)


def test_spread_of_throw_equals_linear_error_propagation():
    """The picks of two pieces have independent errors; a level bed's throw does not depend on where the fault is."""
    case = planar_fault()
    found = spread(run(sw.Uncertainty(horizon=2, fault=1), 600, case=case))
    expected = np.sqrt(2) * 2 * case.section.dz
    assert found["throw", "H1 at F1"] == pytest.approx(expected, rel=0.1)


def test_the_turn_of_a_fault_changes_its_heave():
    case = planar_fault()
    found = spread(run(sw.Uncertainty(dip=1), 300, case=case))
    assert found["throw", "H1 at F1"] == pytest.approx(0, abs=1e-6)
    assert found["heave", "H1 at F1"] == pytest.approx(100 / np.sin(np.radians(60)) ** 2 * np.radians(1), rel=0.12)


def test_in_depth_all_depths_grow_with_the_velocity():
    ensemble = run(sw.Uncertainty(velocity=0.05), 300)
    throws = ensemble.values[:, ensemble.labels.index(("throw", "H1 at F1"))]
    assert np.std(np.log(throws)) == pytest.approx(0.05, rel=0.1)
    assert np.median(throws) == pytest.approx(100, rel=0.02)


def test_shares_of_variance_add_up_and_name_the_cause():
    """Heave depends on the horizons' errors over the tangent of the dip, and on the fault's dip; throw on the first."""
    ensemble = run(sw.Uncertainty(horizon=1, dip=2), 300)
    shares = {name: dict(zip(ensemble.labels, share, strict=True)) for name, share in ensemble.shares.items()}
    assert shares["horizon"]["throw", "H1 at F1"] == pytest.approx(1, abs=0.03)
    assert shares["dip"]["throw", "H1 at F1"] == pytest.approx(0, abs=0.03)
    by_picks, by_dip = 2 * (5 / np.tan(np.radians(60))) ** 2, (100 / 0.75 * np.radians(2)) ** 2
    expected = by_dip / (by_picks + by_dip)
    assert shares["dip"]["heave", "H1 at F1"] == pytest.approx(expected, abs=0.1)
    assert 0.9 < sum(share["heave", "H1 at F1"] for share in shares.values()) < 1.03  # the rest is their product


def test_too_few_members_explain_nothing():
    assert np.isnan(run(sw.Uncertainty(horizon=1), 10).shares["horizon"]).all()


def test_members_do_not_depend_on_how_many_there_are():
    few, many = (run(sw.Uncertainty(horizon=1, fault=1, dip=1), count, seed=3) for count in (5, 9))
    np.testing.assert_array_equal(few.values, many.values[:5])
    assert not np.array_equal(few.values, run(sw.Uncertainty(horizon=1), 5, seed=4).values)


def test_intervals_of_throw_contain_the_truth():
    """Each case has errors of its own, and its ensemble says how far the truth may be; `make bench` runs 1,000."""
    truth, count = 100.0, 40
    uncertainty = sw.Uncertainty(horizon=1, fault=1)
    case = sw.synthetic.planar_fault(throw=truth, horizons=(1000.0,))
    drawn = [
        sw.ensemble(case.section, case.interpretation, PICKS_ONLY, uncertainty, 1, seed)
        for seed in range(1000, 1000 + count)
    ]
    hits = 0
    for one in drawn:
        picks = one.study.perturbation.hypothesis(0).interpretation
        low, high = sw.ensemble(case.section, picks, PICKS_ONLY, uncertainty, 30).percentiles((5, 95))[
            "throw", "H1 at F1"
        ]
        hits += low <= truth <= high
    assert hits / count == pytest.approx(0.9, abs=0.12)


def test_restored_members_measure_lengths_areas_and_turns():
    case = sw.synthetic.faulted_fold(throw=120)
    plan = sw.Plan(fixed=case.fixed, spacing=250)
    uncertainty = sw.Uncertainty(horizon=0.5, fault=0.5, correlation_length=2000)
    ensemble = run(uncertainty, 3, plan, case, executor=InThisThread())
    assert not ensemble.refused
    restored = plan.restore(case.section, case.interpretation)
    drawn = dict(zip(ensemble.labels, ensemble.drawn, strict=True))
    bed = np.concatenate(restored.carried(case.interpretation.horizons[0]))
    width = np.ptp(np.concatenate(case.interpretation.horizons[0].pieces)[:, 0])
    assert drawn["extension", "H1"] == pytest.approx(width / np.ptp(bed[:, 0]) - 1)
    assert drawn["rotation", "hanging wall of F1"] == restored.stages[0].report.motions[1].rotation
    assert abs(drawn["area change", ""]) < 0.01
    np.testing.assert_allclose(ensemble.values.mean(axis=0), ensemble.drawn, rtol=0.05, atol=0.5)
    level = ensemble.horizon_mean[0]  # the first horizon was flattened
    assert np.nanmax(level) - np.nanmin(level) < 2
    assert (ensemble.horizon_spread[0, 10:90] > 0).all()
    assert np.nanmedian(ensemble.ratio_mean) == pytest.approx(1, abs=0.02)


def test_refused_members_are_counted_and_listed():
    """Errors of 30 samples make horizons 100 m apart cross, or leave the section."""
    case = sw.synthetic.planar_fault(throw=100, horizons=(900.0, 1000.0, 1100.0))
    plan = sw.Plan((sw.Step("unfault"),), fixed=case.fixed, spacing=250, max_iterations=15)
    ensemble = run(sw.Uncertainty(horizon=40, correlation_length=300), 6, plan, case, executor=InThisThread())
    assert len(ensemble.members) == 6
    assert ensemble.refused
    assert all(member.problem for member in ensemble.refused)
    assert sum(int(finding.text.split()[0]) for finding in ensemble.findings) == len(ensemble.refused)
    assert f"{len(ensemble.refused)} refused or not settled" in str(ensemble)


def test_each_member_takes_a_match_as_often_as_its_weight_says():
    """The slip along a fault that no horizon crosses is in doubt: two peaks of its scan are credible."""
    case = sw.synthetic.planar_fault(throw=100, dip=60)
    picks = sw.Interpretation(case.interpretation.faults)
    plan = sw.Plan((sw.Step("unfault"),), fixed=case.fixed, spacing=400)
    true = 100 / np.sin(np.radians(60))
    matches = {"F1": [(sw.SlipProfile([0], [true]), 3), (sw.SlipProfile([0], [0.5 * true]), 1)]}
    ensemble = sw.ensemble(case.section, picks, plan, sw.Uncertainty(matches=matches), 12, executor=InThisThread())
    slips = ensemble.values[:, ensemble.labels.index(("slip", "F1"))]
    assert set(slips.round(3)) == {round(true, 3), round(0.5 * true, 3)}
    assert 0.5 < np.mean(slips == slips.max()) < 1
    assert dict(zip(ensemble.labels, ensemble.drawn, strict=True))["slip", "F1"] == pytest.approx(true)
    assert ensemble.shares["matches"][ensemble.labels.index(("slip", "F1"))] == pytest.approx(1)


def test_matches_of_a_fault_that_is_not_there_are_refused():
    with pytest.raises(sw.PickError, match="no fault called 'F9'"):
        run(sw.Uncertainty(matches={"F9": [(sw.SlipProfile([0], [50]), 1)]}), 2)


def test_the_peaks_of_a_scan_are_matches():
    case = planar_fault()
    scan = sw.scan(case.section, case.interpretation.faults[0])
    choices = sw.Uncertainty(matches={"F1": scan}).choices["F1"]
    assert [profile for profile, _ in choices] == [peak.profile for peak in scan.peaks]
    assert sum(weight for _, weight in choices) == pytest.approx(1)


def test_pieces_go_on_ending_at_their_faults():
    """Horizons end at a fault that moves by many traces, and none crosses it."""
    case = sw.synthetic.faulted_fold()
    drawn = run(sw.Uncertainty(horizon=2, fault=4, dip=3), 1, case=case).study.perturbation
    for index in range(20):
        picks = drawn.hypothesis(index).interpretation
        fault = shapely.LineString(picks.faults[0].points)
        for horizon in picks.horizons:
            left, right = map(shapely.LineString, horizon.pieces)
            ends = shapely.Point(left.coords[-1]), shapely.Point(right.coords[0])
            assert max(end.distance(fault) for end in ends) < 1e-6
            assert all(piece.intersection(fault.buffer(1e-6)).length < 1e-3 for piece in (left, right))


def test_pieces_do_not_end_at_a_fault_that_is_ignored():
    """Another reading of the fault, which is ignored, begins where the used one does and moves by errors of its own."""
    case = planar_fault()
    (fault,) = case.interpretation.faults
    picks = sw.Interpretation([sw.Fault(fault.points, "other", use="ignore"), fault], case.interpretation.horizons)
    study = sw.ensemble(case.section, picks, PICKS_ONLY, sw.Uncertainty(fault=4), 1).study
    drawn = study.perturbation.hypothesis(0).interpretation
    line = shapely.LineString(drawn.faults[1].points)
    ends = [drawn.horizons[0].pieces[0][-1], drawn.horizons[0].pieces[1][0]]
    assert max(line.distance(shapely.Point(end)) for end in ends) < 1e-6


def test_depths_along_lines():
    lines = [np.array([(0.0, 10.0), (2.0, 20.0)]), np.array([(1.0, 5.0), (4.0, 5.0)])]
    np.testing.assert_allclose(depths_along(lines, np.array([0.0, 1, 3, 5])), [10, 10, 5, np.nan])


@pytest.mark.parametrize(
    ("choices", "message"),
    [
        ({"horizon": -1}, "horizon is a standard deviation, 0 or more, but is -1"),
        ({"dip": np.nan}, "dip must be a finite number"),
        ({"correlation_length": 0}, "correlation_length must be above 0 m"),
        ({"matches": {"F1": [(100, 1)]}}, "matches of fault 'F1' must be pairs of a seiswidgets.SlipProfile"),
        ({"matches": {"F1": [(sw.SlipProfile([0], [50]), 0)]}}, "a weight of 0 or more, not all of them 0"),
        ({"dip": 60}, "dip must be at most 45 degrees, but is 60"),
    ],
)
def test_deviations_that_make_no_sense(choices, message):
    with pytest.raises(sw.SettingError, match=message):
        sw.Uncertainty(**choices)


@pytest.mark.parametrize("members", [0, -3, 2.5, True])
def test_the_number_of_members(members):
    with pytest.raises(sw.SettingError, match="members must be a whole number of 1 or more"):
        run(sw.Uncertainty(), members)


def test_what_cannot_be_restored_as_drawn_is_refused_at_once():
    case = sw.synthetic.planar_fault()
    picks = sw.Interpretation(case.interpretation.faults)
    with pytest.raises(sw.PickError, match="slip is undetermined"):
        sw.ensemble(case.section, picks, None, sw.Uncertainty(horizon=1), 2)
