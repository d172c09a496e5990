"""Restoring by a prescribed slip, without horizons."""

import numpy as np
import pytest

import seiswidgets as sw
from tests.geology.answers import random_points

ELLIPSE = np.sqrt(np.maximum(0, 1 - np.linspace(-1, 1, 101) ** 2))
CASES = {
    "planar": (sw.synthetic.planar_fault, {}, [0], [150 / np.sin(np.radians(60))]),
    "listric": (sw.synthetic.listric_fault, {"horizons": ()}, [0], [0.1 * 3500]),
    "blind": (sw.synthetic.blind_fault, {}, np.linspace(0, 500, 101), 40 * ELLIPSE),
    "blind, reverse": (sw.synthetic.blind_fault, {"dip": 120}, np.linspace(0, 500, 101), -40 * ELLIPSE),
}


def errors(case, restored):
    """Distance of random points from where they belong, the mean motion aside if nothing is held."""
    points = random_points(case.section, 1000)
    apart = restored.to_restored(points) - case.to_unfaulted(points)
    apart = apart[np.isfinite(apart).all(axis=1)]
    return np.hypot(*apart.T)


@pytest.mark.parametrize("name", list(CASES))
def test_a_known_slip_restores_without_horizons(name):
    make, choices, s, slip = CASES[name]
    case = make(noise=0.0, **choices)
    (fault,) = case.interpretation.faults
    profile = sw.SlipProfile(s, slip)
    restored = sw.Restoration(case.section).unfault(fault, fixed=case.fixed, slip={fault.name: profile})
    report = restored.stages[-1].report
    assert report.converged
    assert report.slips[0].misfit < 0.1 * case.section.dz
    assert not [finding for finding in restored.findings if finding.severity != "note"]
    largest = np.abs(profile.slip).max()
    if case.fixed:
        assert np.percentile(errors(case, restored), 99) < 0.01 * largest
    else:  # the rock around a blind fault bends as the mesh likes, but no more than with horizons
        drawn = sw.Restoration(case.section).unfault(fault, case.interpretation.horizons)
        assert np.percentile(errors(case, restored), 90) < 1.3 * np.percentile(errors(case, drawn), 90)


def test_drawing_a_fault_upwards_changes_nothing():
    case = sw.synthetic.planar_fault()
    (fault,) = case.interpretation.faults
    profile = {"F1": sw.SlipProfile([500, 1500], [100, 160])}
    one, other = (
        sw.Restoration(case.section).unfault(sw.Fault(points, "F1"), fixed=case.fixed, slip=profile)
        for points in (fault.points, fault.points[::-1])
    )
    points = random_points(case.section, 200)
    np.testing.assert_allclose(other.to_restored(points), one.to_restored(points), atol=1e-3)


def test_a_profile_outweighs_horizons_that_contradict_it():
    case = sw.synthetic.planar_fault()
    picks = case.interpretation
    slip = {"F1": sw.SlipProfile([0], [100])}
    restored = sw.Restoration(case.section).unfault(picks.faults, picks.horizons, fixed=case.fixed, slip=slip)
    assert restored.stages[-1].report.slips[0].misfit < 0.01
    assert {finding.kind for finding in restored.findings} == {"cut-off"}


def test_slip_that_does_not_die_out_with_its_fault_is_reduced():
    case = sw.synthetic.blind_fault()
    (fault,) = case.interpretation.faults
    restored = sw.Restoration(case.section).unfault(fault, slip={"F1": sw.SlipProfile([0, 500], [0, 30])})
    (finding,) = [finding for finding in restored.findings if finding.kind == "slip"]
    assert "is 30 m at its end near" in finding.text
    assert finding.where == pytest.approx(tuple(fault.points[-1]))


def test_a_second_profile_takes_the_mesh_of_the_first():
    case = sw.synthetic.planar_fault()
    first, second = (
        sw.Plan((sw.Step("unfault", slip={"F1": sw.SlipProfile([0], [slip])}),), fixed=case.fixed)
        for slip in (100, 150 / np.sin(np.radians(60)))
    )
    picks = sw.Interpretation(case.interpretation.faults)
    start = first.restore(case.section, picks)
    restored = sw.Restoration(case.section).unfault(
        picks.faults, fixed=case.fixed, slip=second.steps[0].slip, start=start.stages[0]
    )
    assert restored.stages[0].mesh_setup.mesh is start.stages[0].mesh_setup.mesh
    assert errors(case, restored).max() < 0.01 * 150
    np.testing.assert_allclose(second.restore(case.section, picks).stages[0].vertices, restored.stages[0].vertices)


def test_bad_profiles_say_what_is_wrong():
    with pytest.raises(sw.SettingError, match="2 positions s, but 1 values"):
        sw.SlipProfile([0, 1], [3])
    with pytest.raises(sw.SettingError, match="must increase along the fault"):
        sw.SlipProfile([1, 0], [3, 3])
    with pytest.raises(sw.SettingError, match="slip must be a finite number, but is nan"):
        sw.SlipProfile([0], [np.nan])
    case = sw.synthetic.planar_fault()
    unfault = sw.Restoration(case.section).unfault
    with pytest.raises(sw.SettingError, match="names fault 'F9', which is not unfaulted here; there are 'F1'"):
        unfault(case.interpretation.faults, slip={"F9": sw.SlipProfile([0], [1])})
    with pytest.raises(sw.PickError, match=r"'F1' changes by 3\.0 m per metre of fault near s=5"):
        unfault(case.interpretation.faults, slip={"F1": sw.SlipProfile([500, 600], [0, 300])})
