"""Faults that cross, meet and share stretches, restored at once and one after the other: known answers."""

import numpy as np
import pytest
from shapely import LineString

import seiswidgets as sw
from seiswidgets.geology.shared_stretches import continue_along
from tests.geology.networks import SECTION, Crossing, Slip

CROSSINGS = {
    "X": Crossing(Slip(2600, 60, 150), Slip(3600, 115, 120), (500, 1400, 1700, 2000)),
    "Y": Crossing(Slip(1700, 60, 150), Slip(4550, 120, -250), (500, 1000, 1400)),
    "small throw": Crossing(Slip(2600, 60, 20), Slip(3600, 115, 120), (500, 1400, 1700, 2000)),
}
TOLERANCE = 2e-3  # of the slip


def drawings(case):
    """The younger fault, and the older one drawn as two, or as one that runs along the younger one in between."""
    upper, lower = case.parts
    younger = sw.Fault([case.younger.at(z) for z in (0, SECTION.extent[3])], name="young")
    if lower[0, 1] >= SECTION.extent[3]:  # the lower part lies below the section
        return younger, [sw.Fault(upper, name="old")], sw.Fault(upper, name="old")
    two = [sw.Fault(upper, name="upper"), sw.Fault(lower, name="lower")]
    return younger, two, sw.Fault([*upper, *lower], name="old")


@pytest.fixture(params=CROSSINGS, scope="module")
def case(request):
    return CROSSINGS[request.param]


def check(case, restored):
    assert restored.settled
    assert max(stage.report.iterations for stage in restored.stages) <= 5
    assert max(stage.report.overlap for stage in restored.stages) < 1
    assert case.errors(restored).max() < TOLERANCE * abs(case.younger.slip)


@pytest.mark.parametrize("parts", [1, 2], ids=["drawn as one", "drawn as two"])
def test_crossing_faults_restore_at_once_and_in_sequence(case, parts):
    younger, two, one = drawings(case)
    older = two if parts == 2 else [one]
    start = sw.Restoration(SECTION, spacing=150)
    check(case, start.unfault([younger, *older], case.horizons, fixed=case.fixed))
    first = start.unfault(younger, case.horizons, boundaries=older, fixed=case.fixed)
    check(case, first.unfault(older, case.horizons, boundaries=younger, fixed=case.fixed))


def test_a_plan_passes_the_faults_that_are_restored_later(case):
    younger, _, older = drawings(case)
    steps = (sw.Step("unfault", "young"), sw.Step("unfault", "old"))
    plan = sw.Plan(steps, fixed=case.fixed, spacing=150)
    check(case, plan.restore(SECTION, sw.Interpretation([older, younger], case.horizons)))


def test_without_boundaries_a_bed_is_carried_across_a_fault_that_is_restored_later():
    """The reason for them: here a bed that ends at the older fault is drawn on to the younger one behind it."""
    case = CROSSINGS["X"]
    younger, two, _ = drawings(case)
    alone = sw.Restoration(SECTION, spacing=150).unfault(younger, case.horizons, fixed=case.fixed)
    assert "carried" in {finding.kind for finding in alone.findings}
    named = sw.Restoration(SECTION, spacing=150).unfault(younger, case.horizons, boundaries=[younger, *two])
    assert named.stages[0].report.picks == ("young",)
    assert "carried" not in {finding.kind for finding in named.findings}


def test_a_fault_that_lies_on_another_from_end_to_end_cuts_nothing():
    fault = sw.Fault([(1000, 0), (2000, 2400)], name="F1")
    again = sw.Fault([(1250, 600), (1750, 1800)], name="F2")
    bed = sw.Horizon([(0, 1000), (6000, 1000)])
    (stage,) = sw.Restoration(SECTION, spacing=150).unfault([fault, again], bed).stages
    assert stage.report.picks == ("F1",)
    assert any("'F1' and 'F2' lie on top of each other" in finding.text for finding in stage.report.findings)


def test_boundaries_are_faults():
    fault = sw.Fault([(1000, 0), (2000, 2400)])
    with pytest.raises(sw.PickError, match="expected a fault"):
        sw.Restoration(SECTION).unfault(fault, boundaries=sw.Horizon([(0, 0), (1, 1)]))
    assert np.isfinite(fault.points).all()


@pytest.mark.parametrize("faults", [2, 3])
def test_imbricate_thrusts_settle_without_rock_on_rock(faults):
    case = sw.synthetic.thrust(faults=faults)
    picks = case.interpretation
    (stage,) = sw.Restoration(case.section, spacing=120).unfault(picks.faults, picks.horizons, fixed=case.fixed).stages
    assert stage.report.converged
    assert not [finding for finding in stage.report.findings if finding.kind == "overlap"]
    assert max(cutoff.misfit for cutoff in stage.report.cutoffs) < 0.1 * case.section.dz


@pytest.mark.parametrize("order", [("F1", "F2"), ("F2", "F1")], ids=["youngest first", "oldest first"])
def test_imbricate_thrusts_restore_one_after_the_other(order):
    """The second thrust ends on the floor of the first: it slides on along it."""
    case = sw.synthetic.thrust(faults=2)
    plan = sw.Plan(tuple(sw.Step("unfault", name) for name in order), spacing=120, fixed=case.fixed)
    restored = plan.restore(case.section, case.interpretation)
    assert restored.settled
    assert not [finding for finding in restored.findings if finding.kind in ("overlap", "fault end", "carried")]
    assert max(cutoff.misfit for stage in restored.stages for cutoff in stage.report.cutoffs) < 0.1 * case.section.dz


@pytest.mark.parametrize("turned", [1, -1])
def test_a_fault_is_drawn_on_along_the_boundary_it_ends_at(turned):
    floor = LineString([(0, 800), (1000, 800), (1500, 500)])
    ramp = LineString([(1400, 100), (600, 800)][::turned])
    along = continue_along(ramp, [floor], [])
    np.testing.assert_array_equal(along.coords[::turned], [(1400, 100), (600, 800), (0, 800)])
    steep = LineString([(700, 100), (600, 800)][::turned])
    assert continue_along(steep, [floor], []) == steep
    assert continue_along(ramp, [floor], [LineString([(600, 800), (600, 1000)])]) == ramp
