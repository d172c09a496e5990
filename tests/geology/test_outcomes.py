from dataclasses import replace
from functools import cache

import numpy as np
import pytest

import seiswidgets as sw
from seiswidgets.geology.outcomes import Comparison, Outcome


@cache
def comparison():
    """The true match, one in which a horizon is matched with the next, and one that is refused."""
    case = sw.synthetic.planar_fault()
    picks, plan = case.interpretation, sw.Plan((sw.Step("unfault"),), fixed=case.fixed, spacing=200)
    first, second, _ = picks.horizons
    wrong = sw.Horizon(first.pieces[0], second.pieces[1], name="H1")
    interpretations = {
        "wrong": sw.Interpretation(picks.faults, [wrong]),
        "one-sided": sw.Interpretation(picks.faults, [sw.Horizon(first.pieces[0])]),
        "right": picks,
    }
    return sw.compare([sw.Hypothesis(case.section, one, plan, name) for name, one in interpretations.items()])


def names(comparison):
    return [outcome.name for outcome in comparison.outcomes]


def test_the_right_match_correlates_best_and_the_refused_one_comes_last():
    assert names(comparison()) == ["wrong", "one-sided", "right"]
    assert names(comparison().sorted_by("correlation F1", descending=True)) == ["right", "wrong", "one-sided"]
    assert names(comparison().sorted_by("correlation F1")) == ["wrong", "right", "one-sided"]
    assert names(comparison().sorted_by("hypothesis")) == ["one-sided", "right", "wrong"]


def test_the_numbers_are_those_of_the_restoration():
    right = comparison().outcomes[2]
    fault = right.hypothesis.interpretation.faults[0]
    assert right.values["correlation F1"] == sw.cross_fault_correlation(right.restored, fault)
    assert right.values["bed change"] == pytest.approx(0, abs=1e-5)
    assert right.values["problems"] == 0
    assert right.verdict == right.restored.verdict


def test_what_was_refused_says_why():
    refused = comparison().outcomes[1]
    assert refused.restored is None
    assert "slip is undetermined" in refused.verdict
    assert refused.verdict in comparison()._repr_html_().replace("&#x27;", "'")


def test_the_table_has_units_and_no_value_where_there_is_none():
    table = comparison().table
    assert table.headings[:3] == ["hypothesis", "correlation F1", "bed change (%)"]
    assert table.rows[1][:-1] == ("one-sided", *[None] * (len(table.units) - 2))
    assert "slip is undetermined" in str(comparison())


def test_an_opposite_match_is_a_bad_one_but_a_loss_is_as_bad_as_a_gain():
    hypothesis = comparison().outcomes[0].hypothesis
    numbers = [("good", 0.5, 0.1), ("poor", 0.1, 0.02), ("opposite", -0.9, -0.2)]
    made = Comparison(
        tuple(
            Outcome(replace(hypothesis, name=name), None, {"correlation F1": match, "bed change": change})
            for name, match, change in numbers
        )
    )
    assert names(made.sorted_by("correlation F1", descending=True)) == ["good", "poor", "opposite"]
    assert names(made.sorted_by("bed change", descending=True)) == ["opposite", "good", "poor"]


def test_what_cannot_be_compared():
    with pytest.raises(sw.SettingError, match="nothing to compare"):
        sw.compare([])
    with pytest.raises(sw.SettingError, match="hypotheses must be a Hypothesis"):
        sw.compare([sw.Plan()])
    with pytest.raises(sw.SettingError, match="no column 'beauty'; there are hypothesis, correlation F1"):
        comparison().sorted_by("beauty")


@pytest.mark.parametrize(
    ("field", "value"), [("section", 1), ("interpretation", None), ("plan", "flatten"), ("name", 3)]
)
def test_a_hypothesis_has_a_section_picks_a_plan_and_a_name(field, value):
    case = sw.Section(np.ones((3, 3)), 1, 1)
    fields = {"section": case, "interpretation": sw.Interpretation(), "plan": sw.Plan(), "name": "A"}
    with pytest.raises(sw.SettingError, match=f"{field} must be"):
        sw.Hypothesis(**{**fields, field: value})
