"""Hypotheses in the app."""

import pytest

import seiswidgets as sw
from seiswidgets.widgets.app import RestorationApp
from seiswidgets.widgets.panels.hypotheses import BLINK, DIFFERENCE, SIDE_BY_SIDE

LONG = 60  # seconds
CASE = sw.synthetic.planar_fault(throw=60.0, width=1500.0, depth=1000.0, horizons=(400.0, 600.0))


@pytest.fixture
def app():
    app = RestorationApp(CASE.section, CASE.interpretation, fixed=CASE.fixed, live=False)
    app.workspace.change_plan("mesh", spacing=120.0)
    yield app
    app.close()


@pytest.fixture
def panel(app):
    return app.hypotheses_panel


def press(app, key):
    app._hotkeys[key]()


def names(panel):
    return [row["name"] for row in panel.table.rows]


def wrong_match(app):
    """Match the first horizon left of the fault with the second one right of it."""
    first, second = CASE.interpretation.horizons
    app.interpretation = sw.Interpretation(
        CASE.interpretation.faults, [sw.Horizon(first.pieces[0], second.pieces[1], name="H1")]
    )


def test_a_copy_is_edited_and_a_key_goes_back_to_the_first(app, panel):
    panel.buttons["Duplicate"].click()
    wrong_match(app)
    assert names(panel) == ["A", "B"]
    assert [len(one.interpretation.horizons) for one in app.hypotheses] == [2, 1]
    press(app, "n")
    assert (app.workspace.document.name, len(app.interpretation.horizons)) == ("A", 2)
    press(app, "N")
    assert (app.workspace.document.name, len(app.interpretation.horizons)) == ("B", 1)
    app.workspace.history.undo()
    app.workspace.history.undo()
    assert [row["chosen"] for row in panel.table.rows] == [False, True]
    app.workspace.history.undo()
    assert len(app.interpretation.horizons) == 2


def test_they_are_renamed_reordered_and_deleted(app, panel):
    panel.buttons["Duplicate"].click()
    panel.name.value = "steep"
    assert [one.name for one in app.hypotheses] == ["A", "steep"]
    panel.name.value = "A"
    assert "called 'A' already" in panel.message.value.replace("&#x27;", "'")
    assert panel.name.value == "steep"
    panel.buttons["Up"].click()
    assert names(panel) == ["steep", "A"]
    panel.buttons["Delete"].click()
    assert (names(panel), panel.buttons["Delete"].disabled) == (["A"], True)


def test_the_table_compares_them_and_sorts_by_any_column(app, panel):
    panel.buttons["Duplicate"].click()
    wrong_match(app)
    panel.compare_button.click()
    assert panel.wait(LONG)
    column = panel.table.headings.index("correlation F1")
    panel.table._receive(None, {"kind": "sort", "column": column}, None)
    assert (names(panel), panel.table.sorted) == (["B", "A"], [column, False])
    panel.table._receive(None, {"kind": "sort", "column": column}, None)
    assert (names(panel), panel.table.sorted) == (["A", "B"], [column, True])
    expected = sw.compare(app.hypotheses).outcomes
    assert [row["cells"][column - 1] for row in panel.table.rows] == [
        f"{one.values['correlation F1']:.2f}" for one in expected
    ]
    panel.table._receive(None, {"kind": "choose", "name": "A"}, None)
    assert app.workspace.document.name == "A"
    app.workspace.change_plan("mesh", spacing=130.0)
    assert [row["dim"] for row in panel.table.rows] == [True, False]
    assert "out of date" in panel.table.rows[0]["title"]


def test_what_was_compared_stays_known_under_another_name(app, panel):
    panel.buttons["Duplicate"].click()
    wrong_match(app)
    panel.compare_button.click()
    assert panel.wait(LONG)
    panel.name.value = "steep"
    assert [outcome.name for outcome in panel.comparison.outcomes] == ["A", "steep"]
    app.workspace.history.undo()
    assert [outcome.name for outcome in panel.comparison.outcomes] == ["A", "B"]
    assert not any(row["dim"] for row in panel.table.rows)


def test_two_are_viewed_together(app, panel):
    panel.buttons["Duplicate"].click()
    wrong_match(app)
    for view, images in ((SIDE_BY_SIDE, 1), (BLINK, 2), (DIFFERENCE, 1)):
        panel.view.value = view
        assert panel.wait(LONG)
        assert panel.picture.value.count("data:image/png") == images, panel.message.value


def test_hypotheses_from_code(app):
    steep = sw.Hypothesis(CASE.section, CASE.interpretation, sw.Plan(spacing=90.0), "steep")
    flat = sw.Hypothesis(CASE.section, sw.Interpretation(), sw.Plan(), "flat")
    app.hypotheses = [steep, flat]
    assert [(one.name, one.plan.spacing) for one in app.hypotheses] == [("steep", 90.0), ("flat", None)]
    assert len(app.interpretation.horizons) == 2
    with pytest.raises(sw.SettingError, match="each with a name of its own"):
        app.hypotheses = [steep, steep]
    with pytest.raises(sw.SettingError, match="of another section"):
        app.hypotheses = [sw.Hypothesis(sw.synthetic.tilt().section, sw.Interpretation())]


def test_a_session_brings_all_of_them_back(app, tmp_path):
    app.session_path = tmp_path / "line.json"
    app.hypotheses_panel.buttons["Duplicate"].click()
    wrong_match(app)
    app.session_bar.wait(LONG)
    app.session_bar.end()
    again = RestorationApp(CASE.section, live=False, session=tmp_path / "line.json")
    again.session_bar.keep_newest(tmp_path / "line.json")
    assert again.wait(LONG)
    assert [(one.name, len(one.interpretation.horizons)) for one in again.hypotheses] == [("A", 2), ("B", 1)]
    again.close()
