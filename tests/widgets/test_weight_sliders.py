from dataclasses import fields, replace

import pytest

import seiswidgets as sw
from seiswidgets.widgets.panels.weight_sliders import GROUPS

NAMES = [field.name for field in fields(sw.Weights)]


@pytest.fixture
def sliders():
    return sw.WeightSliders()


@pytest.fixture
def told(sliders):
    """The weights of all notifications."""
    heard = []
    sliders.observe(lambda change: heard.append(change.new), "weights")
    return heard


def reset_button(sliders):
    return sliders.reset_button


def test_every_weight_has_one_slider_at_its_place(sliders):
    assert sorted(sliders.sliders) == sorted(NAMES)
    assert sliders.weights == sw.Weights()
    for name, slider in sliders.sliders.items():
        assert slider.value == max(0.01, getattr(sw.Weights(), name))
        assert sliders.readouts[name].value == f"{getattr(sw.Weights(), name):g}"
        assert slider.tooltip.endswith(".")


def test_symbols_are_those_of_the_papers_equations_19_and_22():
    symbols = {term.field: term.symbol for terms in GROUPS.values() for term in terms}
    assert [symbols[name] for name in NAMES] == ["α", "β", "γ", "ζ", "λ", "ζ", "λ", "", ""]


@pytest.mark.parametrize("name", NAMES)
def test_a_slider_changes_its_weight_once_and_no_other(sliders, told, name):
    sliders.sliders[name].value = 31.6
    assert told == [replace(sw.Weights(), **{name: 31.6})]
    assert sliders.readouts[name].value == "31.6"


def test_weights_set_from_code_move_the_sliders_with_one_notification(sliders, told):
    weights = sw.Weights(0.5, 2, 3, 4, 5, 6, 700, 8, 9)
    sliders.weights = weights
    assert told == [weights]
    assert [sliders.sliders[name].value for name in NAMES] == [0.5, 2, 3, 4, 5, 6, 700, 8, 9]
    assert sliders.readouts["length"].value == "700"


@pytest.mark.parametrize(("weight", "place", "text"), [(0.0, 0.01, "0"), (0.001, 0.01, "0.001"), (5e4, 1000, "50,000")])
def test_a_weight_beyond_its_slider_is_kept_until_that_is_moved(sliders, told, weight, place, text):
    weights = sw.Weights(slide=weight)
    sliders.weights = weights
    assert sliders.sliders["slide"].value == pytest.approx(place)
    assert sliders.readouts["slide"].value == text
    sliders.sliders["edge"].value = 7.0
    assert sliders.weights == sw.Weights(slide=weight, edge=7.0)
    sliders.sliders["slide"].value = 20.0
    assert sliders.weights == sw.Weights(slide=20.0, edge=7.0)
    assert len(told) == 3


def test_reset_is_one_change(sliders, told):
    sliders.weights = sw.Weights(0, 2, 3, 4, 5, 6, 7)
    reset_button(sliders).click()
    assert told[1:] == [sw.Weights()]
    assert sliders.sliders["mean_value"].value == 1


def test_weights_may_be_given(sliders):
    assert sw.WeightSliders(sw.Weights(edge=4)).weights.edge == 4
    assert sw.WeightSliders(weights=sw.Weights(edge=4)).sliders["edge"].value == 4
