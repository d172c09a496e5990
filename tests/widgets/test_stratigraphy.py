"""The stratigraphy in a table, and time in Ma."""

import pytest

import seiswidgets as sw
from seiswidgets.widgets.panels.stratigraphy import StratigraphyPanel


@pytest.fixture
def case():
    return sw.synthetic.growth_fault(dx=50, dz=20)


@pytest.fixture
def app(case):
    app = sw.RestorationApp(case.section, case.interpretation, live=False)
    yield app
    app.close()


@pytest.fixture
def panel(app):
    return StratigraphyPanel(app.workspace)


def test_a_table_begins_with_the_horizons_by_their_depth(app, panel):
    assert panel.rows == ()
    panel.begin.click()
    layers = app.plan.stratigraphy.layers
    assert [layer.top for layer in layers] == [None, "H1", "H2", "H3", "H4"]
    assert [row.top.value for row in panel.rows] == [None, "H1", "H2", "H3", "H4"]
    app.workspace.history.undo()
    assert app.plan.stratigraphy is None
    assert panel.rows == ()


def test_each_field_is_one_edit(app, panel):
    panel.begin.click()
    edits = []
    app.workspace.observe(lambda change: edits.append(change.new.plan.stratigraphy.layers[1]), "document")
    row = panel.rows[1]
    row.rock.value, row.age.value, row.water.value = "chalk", 7.0, "120"
    assert len(edits) == 3
    assert edits[-1] == sw.Layer("H1", 7.0, "chalk", 120.0)
    assert panel.rows[1] is row


def test_what_cannot_be_is_said_and_nothing_is_lost(app, panel):
    panel.begin.click()
    before = app.plan.stratigraphy
    panel.rows[1].age.value = 99.0
    assert "ages must rise from young to old" in panel.message.value
    assert app.plan.stratigraphy == before
    assert panel.rows[1].age.value == 99.0
    panel.rows[1].water.value = "deep"
    assert "water_depth must be a finite number" in panel.message.value


def test_layers_are_removed_and_added(app, panel):
    panel.begin.click()
    panel.rows[4].remove.click()
    assert len(panel.rows) == 4
    panel.add.click()
    assert app.plan.stratigraphy.layers[-1].top == "H4"
    panel.add.click()
    assert "every horizon is the top of a layer already" in panel.message.value


def test_a_sequence_becomes_the_steps_and_time_runs_in_ma(app, panel):
    panel.begin.click()
    panel.decompact.value, panel.isostasy.value, panel.elastic_thickness.value = False, True, 5.0
    panel.sequence.click()
    assert {step.kind for step in app.steps} == {"strip", "unfault", "isostasy", "flatten"}
    assert app.plan.isostasy.elastic_thickness == 5000
    assert "moved" in panel.activity.value
    app.steps = tuple(step for step in app.steps if step.kind in ("strip", "flatten"))[:4]
    app.restore()
    assert app.wait(60)
    assert app.timeline.ages == [5, 5, 10, 10]
    app.timeline.time = 1.0
    assert app.timeline.age == 2.5
    assert app.timeline.moment == "2.5 Ma · strip 100%"
    assert app.timeline.ticks.value.count("<span") == 3
    assert [row.age.value for row in app.step_list.rows] == ["5", "5", "10", "10"]
