"""All findings about picks and a plan at once, before anything is solved."""

import numpy as np
import pytest

import seiswidgets as sw

SECTION = sw.Section(np.zeros((41, 61), np.float32), dx=25.0, dz=25.0)  # 1500 m x 1000 m
FAULT = sw.Fault([(700, 0), (900, 1000)], name="F1")
HORIZON = sw.Horizon([(0, 400), (780, 400)], [(800, 500), (1500, 500)], name="H1")
UNCROSSED = sw.Fault([(1100, 0), (1200, 450)], name="F2")
LOOPED = sw.Fault([(100, 500), (200, 900), (200, 500), (100, 900)], name="F3")
ONE_SIDED = sw.Horizon([(0, 700), (840, 700)], name="H2")
SWAPPED = sw.Horizon([(0, 300), (760, 300)], [(820, 600), (1500, 600)], name="H3")
CROSSING = sw.Horizon([(0, 350), (400, 450)], name="H4")


def found(faults, horizons, **plan):
    findings = sw.check(SECTION, sw.Interpretation(faults, horizons), sw.Plan(**plan))
    return [(finding.severity, finding.kind, finding.pick) for finding in findings]


def test_all_findings_at_once():
    assert found([FAULT, UNCROSSED, LOOPED], [HORIZON, ONE_SIDED, SWAPPED, CROSSING]) == [
        ("problem", "contradiction", "H3"),
        ("warning", "crossing", "H4"),
        ("warning", "carried", "F3"),
        ("warning", "undetermined", "F2"),
        ("note", "one-sided", "H2"),
    ]


def test_picks_that_are_only_carried_are_not_checked():
    carried = [sw.Horizon(*bed.pieces, name=bed.name, use="carry") for bed in (ONE_SIDED, SWAPPED, CROSSING)]
    faults = [sw.Fault(fault.points, name=fault.name, use="ignore") for fault in (UNCROSSED, LOOPED)]
    assert found([FAULT, *faults], [HORIZON, *carried]) == []
    assert found(faults, carried) == [("note", "skipped", None)] * 2
    assert sw.Plan().restore(SECTION, sw.Interpretation(faults, carried)).stages == ()


@pytest.mark.parametrize(
    ("plan", "problem"),
    [
        ({"fixed": (-100.0, 100.0)}, ("problem", "held outside", None)),
        ({"steps": (sw.Step("unfault"), sw.Step("flatten", "top"))}, ("problem", "missing", "top")),
        ({"spacing": 0.5}, ("problem", "refused", None)),
    ],
)
def test_what_prevents_a_step_is_a_problem(plan, problem):
    assert problem in found([FAULT, UNCROSSED], [HORIZON], **plan)


def test_nothing_is_determined():
    assert found([FAULT], []) == [("problem", "undetermined", "F1")]
    assert found([], [sw.Horizon([(0, 10), (20, 10)], name="H")]) == [("problem", "refused", "H")]


def test_steps_that_can_be_done_are_done():
    looped = sw.Interpretation([LOOPED], [HORIZON])
    restored = sw.Plan().restore(SECTION, looped)
    assert [stage.kind for stage in restored.stages] == ["flatten"]
    assert "but fault 'F3' crosses itself near" in restored.verdict
    with pytest.raises(sw.PickError, match="fault 'F3' crosses itself"):
        sw.Plan((sw.Step("unfault"),)).restore(SECTION, looped)


def test_a_flaw_is_found_once_whatever_the_number_of_steps():
    flawed = sw.Horizon(*HORIZON.pieces, LOOPED.points, name="H1")
    restored = sw.Plan().restore(SECTION, sw.Interpretation([FAULT], [flawed]))
    assert [stage.kind for stage in restored.stages] == ["unfault", "flatten"]
    assert [finding.kind for finding in restored.findings if finding.severity == "warning"] == ["carried"]


def test_a_pick_outside_the_section_has_no_lines():
    outside = sw.Fault([(2000, 0), (2100, 500)], name="F4")
    restored = sw.Restoration(SECTION).unfault([FAULT, outside], HORIZON)
    assert restored.carried(outside) == []
    assert [finding.kind for finding in restored.findings if finding.pick == "F4"] == ["outside"]


def test_the_restoration_has_the_findings_of_the_check():
    faults, horizons = [FAULT, UNCROSSED, LOOPED], [HORIZON, ONE_SIDED, SWAPPED]
    restored = sw.Plan((sw.Step("unfault"),)).restore(SECTION, sw.Interpretation(faults, horizons))
    assert set(sw.check(SECTION, sw.Interpretation(faults, horizons), sw.Plan((sw.Step("unfault"),)))) <= set(
        restored.findings
    )
    assert restored.settled
