import matplotlib.pyplot as plt
import numpy as np
import pytest

import seiswidgets as sw
from seiswidgets.plot.hypotheses import section_difference
from tests.executors import InThisThread

CASE = sw.synthetic.planar_fault(throw=60.0, width=1500.0, depth=1000.0, horizons=(400.0, 600.0))
PLAN = sw.Plan((sw.Step("unfault"),), fixed=CASE.fixed, spacing=120.0)


@pytest.fixture(autouse=True)
def closed():
    yield
    plt.close("all")


@pytest.fixture(scope="module")
def comparison():
    picks = CASE.interpretation
    first, second = picks.horizons
    wrong = sw.Interpretation(picks.faults, [sw.Horizon(first.pieces[0], second.pieces[1], name="H1")])
    refused = sw.Interpretation(picks.faults, [sw.Horizon(first.pieces[0])])
    named = {"right $1": picks, "wrong": wrong, "refused": refused}
    return sw.compare([sw.Hypothesis(CASE.section, one, PLAN, name) for name, one in named.items()])


def test_each_hypothesis_has_a_panel_of_one_scale(comparison):
    figure = sw.plot.hypotheses(comparison, columns=2)
    titles = [ax.get_title(loc="left") for ax in figure.axes]
    assert [title.split("\n")[0] for title in titles] == ["right $1", "wrong", "refused"]
    assert "correlation F1 1.00, bed change (%) 0.00" in titles[0]
    assert "undetermined" in titles[2]
    assert [len(ax.images) for ax in figure.axes] == [1, 1, 0]
    assert len({(ax.get_xlim(), ax.get_ylim()) for ax in figure.axes}) == 1
    assert len({image.get_clim() for ax in figure.axes for image in ax.images}) == 1


def test_two_hypotheses_and_their_difference_are_drawn_on_one_scale(comparison):
    right, wrong, refused = comparison.outcomes
    figure = sw.plot.difference(right, wrong)
    assert [ax.get_title(loc="left") for ax in figure.axes] == ["right $1", "wrong", "right $1 less wrong"]
    assert len({image.get_clim() for ax in figure.axes for image in ax.images}) == 1
    with pytest.raises(sw.SettingError, match="'refused' was refused: "):
        sw.plot.difference(right, refused)
    other = sw.synthetic.tilt()
    elsewhere = sw.compare([sw.Hypothesis(other.section, other.interpretation, sw.Plan(), "far")]).outcomes[0]
    with pytest.raises(sw.SettingError, match="'far' are on different sections"):
        sw.plot.difference(right, elsewhere)


def test_a_difference_is_taken_where_both_have_samples():
    amplitude = np.arange(30.0).reshape(5, 6)
    one, other = sw.Section(amplitude, 10, 5), sw.Section(amplitude + 2, 10, 5, x0=-20, z0=5)
    between = section_difference(one, other)
    assert between.extent == (0, 30, 5, 20)
    np.testing.assert_array_equal(between.amplitude, amplitude[1:, :4] - amplitude[:4, 2:] - 2)


def test_an_ensemble_is_drawn_as_bands_and_a_map():
    uncertainty = sw.Uncertainty(horizon=2, correlation_length=3000)
    ensemble = sw.ensemble(CASE.section, CASE.interpretation, PLAN, uncertainty, 3, executor=InThisThread())
    figure = sw.plot.ensemble(ensemble)
    horizons, spread, _ = figure.axes
    assert len(horizons.lines) == 2 * (3 + 1)
    (map_of_spread,) = spread.collections
    np.testing.assert_array_equal(map_of_spread.get_array().filled(np.nan), ensemble.ratio_spread)
    picks_only = sw.ensemble(CASE.section, CASE.interpretation, sw.Plan(steps=()), uncertainty, 2)
    with pytest.raises(sw.SettingError, match="no member was restored"):
        sw.plot.ensemble(picks_only)
