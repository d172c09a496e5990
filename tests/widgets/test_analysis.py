"""The tab Analysis follows the picks and the restoration."""

import re

import pytest

import seiswidgets as sw
from seiswidgets.widgets.app import RestorationApp


@pytest.fixture
def app():
    case = sw.synthetic.planar_fault(throw=90)
    app = RestorationApp(case.section, case.interpretation, fixed=case.fixed)
    app.solving.spacing = 150.0
    yield app
    app.close()


def shown(app, choice):
    app.analysis.choice.value = choice
    assert app.wait(60)
    return app.analysis.page.value


def test_the_throw_at_each_horizon_is_drawn_and_listed(app):
    page = shown(app, "Throw")
    assert re.findall(r">(9\d|8\d\.\d+)</td>", page)
    assert 'aria-label="Throw against depth at F1' in page


@pytest.mark.parametrize(
    ("choice", "words"),
    [("Growth", "expansion index"), ("Balance", "heave closed (m)"), ("Extension", "extension since (m)")],
)
def test_each_page_has_its_table(app, choice, words):
    assert words in shown(app, choice)


def test_it_follows_the_picks(app):
    assert "F1" in shown(app, "Throw")
    app.interpretation = sw.Interpretation()
    assert app.wait(60)
    assert "No horizon meets a fault" in app.analysis.page.value
    assert "Nothing has been restored" in shown(app, "Balance")


def test_a_closed_app_measures_nothing_more(app):
    page = app.analysis
    workspace = app.workspace
    app.close()
    workspace.edit("drop", drawing=type(workspace.drawing)())
    assert page.wait(1)
