import pytest

import seiswidgets as sw


@pytest.fixture(scope="module")
def report():
    case = sw.synthetic.graben()
    picks = case.interpretation
    fault = sw.Fault(picks.faults[0].points, name="<img src=x onerror=alert(1)>")
    return sw.Restoration(case.section, spacing=100).unfault([fault, picks.faults[1]], picks.horizons).stages[0].report


def test_it_reports_every_cut_off_and_every_pick(report):
    assert len(report.cutoffs) == 6
    assert [seam.fault for seam in report.seams] == list(report.picks)
    assert [bed.horizon for bed in report.beds] == ["H1", "H2", "H3"]
    assert set(report.energy) == {"mean value", "contour", "edge length", "stitch", "contact", "area barrier"}


def test_throw_and_heave_are_those_of_the_picks(report):
    case = sw.synthetic.graben()
    for cutoff in report.cutoffs:
        fault = case.interpretation.faults[0 if cutoff.fault.startswith("<") else 1]
        horizon = case.interpretation.horizon(cutoff.horizon)
        assert cutoff.throw == pytest.approx(sw.throw(fault, horizon), rel=1e-6)
        assert cutoff.heave == pytest.approx(sw.heave(fault, horizon), rel=1e-6)


def test_text_has_units(report):
    text = str(report)
    for words in ("throw 120 m", "heave 69.28 m", "m apart", "m²", "settled in"):
        assert words in text


def test_html_escapes_names(report):
    html = report._repr_html_()
    assert "<img" not in html
    assert "&lt;img src=x onerror=alert(1)&gt;" in html
