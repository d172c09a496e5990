"""The check of line lengths: heave either closes, or makes new bed."""

import re

import numpy as np
import pytest

import seiswidgets as sw
from seiswidgets.geology import heave_closure
from seiswidgets.geology.report import CutOffReport
from tests.sections import real_section


def heave_findings(restored):
    return [finding for finding in restored.findings if finding.kind == "heave"]


def unfaulted(case, **choices):
    picks = case.interpretation
    return sw.Restoration(case.section, spacing=100).unfault(picks.faults, picks.horizons, fixed=case.fixed, **choices)


@pytest.mark.parametrize("case", [sw.synthetic.planar_fault(), sw.synthetic.domino(), sw.synthetic.thrust()])
def test_faults_that_cut_the_section_close_their_heave(case):
    assert not heave_findings(unfaulted(case))


def test_the_bed_made_beside_a_blind_fault_is_named_with_its_length():
    case = sw.synthetic.blind_fault(slip=80)
    restored = unfaulted(case)
    (horizon,) = [one for one in case.interpretation.horizons if one.name == "H2"]
    lengths = [
        sum(np.hypot(*np.diff(line, axis=0).T).sum() for line in lines)
        for lines in (horizon.pieces, restored.carried(horizon))
    ]
    finding = next(finding for finding in heave_findings(restored) if finding.pick == "H2")
    heave = sw.heave(case.interpretation.faults[0], horizon)
    made = lengths[1] - lengths[0]
    assert made > 0.5 * heave
    pattern = r"only ([\d.]+) m of the ([\d.]+) m of heave of horizon H2 close: its bed becomes ([\d.]+) m longer"
    said = [float(number) for number in re.search(pattern, finding.text).groups()]
    np.testing.assert_allclose(said, [heave - made, heave, made], atol=1)


def test_on_f3_the_lower_horizon_does_not_close():
    section, picks = real_section("f3")
    restored = sw.Restoration(section).unfault(picks.faults, picks.horizons)
    assert "lower" in {finding.pick for finding in heave_findings(restored)}


def test_heaves_of_several_places_at_one_fault_add_up():
    domain = sw.Restoration(sw.synthetic.planar_fault().section).domain
    twice = [CutOffReport("F1", "H1", 10.0, 30.0, 0.0)] * 2
    (finding,) = heave_closure.heave_findings(twice, {"H1": 20.0}, {("F1", "H1"): np.array([2000.0, 600.0])}, domain)
    assert "40 m of the 60 m of heave" in finding.text
