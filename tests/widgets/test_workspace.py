"""One history undoes every edit of the app, whatever panel it was made in."""

import pytest
from ipywidgets import Button

import seiswidgets as sw
from seiswidgets.widgets.app import RestorationApp
from seiswidgets.widgets.closing import parts
from tests.widgets.files import line
from tests.widgets.hands import appear, click, draw, keys

LONG = 60  # seconds


@pytest.fixture
def app():
    app = RestorationApp(sw.synthetic.faulted_fold().section, live=False)
    appear(app.panes.original, app.panes.restored)
    yield app
    app.close()
    assert app.wait(LONG)


def toolbar_button(app, icon):
    (button,) = (one for one in parts(app.picker.toolbar) if isinstance(one, Button) and one.icon == icon)
    return button


def draw_fault(app, tmp_path):
    app.picker.mode = "fault"
    draw(app.panes.original, (2000.0, 200.0), (2400.0, 1200.0))


def hold(app, tmp_path):
    app.picker.mode = "block"
    click(app.panes.original, (1000.0, 500.0))


def move_slider(app, tmp_path):
    app.sliders.sliders["edge"].value = 10.0


def add_step(app, tmp_path):
    app.step_list.add_buttons["flatten"].click()


def change_spacing(app, tmp_path):
    app.solving.slider.value *= 2


def change_solver(app, tmp_path):
    app.solving.solver = "fixed-point"


def import_picks(app, tmp_path):
    picks = sw.Interpretation([], [sw.Horizon([(100.0, 300.0), (900.0, 320.0)], name="H1")])
    sw.write_picks(picks, tmp_path / "picks.geojson", app.section)
    app.files.picks.file.text.value = str(tmp_path / "picks.geojson")
    app.files.picks.import_button.click()
    assert app.wait(LONG)


def open_section(app, tmp_path):
    opener = app.files.section
    opener.file.text.value = str(line(tmp_path / "line.sgy"))
    assert opener.wait(LONG)
    opener.open_button.click()
    assert opener.wait(LONG)
    opener.notice.answers["Drop the picks"].click()


EDITS = {
    draw_fault: "draw F1",
    hold: "held point",
    move_slider: "weights",
    add_step: "steps",
    change_spacing: "mesh spacing",
    change_solver: "solver",
    import_picks: "import picks",
    open_section: "open line.sgy",
}


def test_one_of_each_edit_is_undone_and_redone(app, tmp_path):
    undo, redo, history = toolbar_button(app, "undo"), toolbar_button(app, "repeat"), app.workspace.history
    assert undo.disabled
    documents, counts = [app.workspace.document], [0]
    for edit, label in EDITS.items():
        edit(app, tmp_path)
        documents.append(app.workspace.document)
        counts.append(history.undo_count)
        assert undo.tooltip == f"Undo: {label} (Ctrl+Z)"
    assert (counts[1], counts[-1] - counts[1]) == (1, len(EDITS) - 1)
    for index in range(len(EDITS), 0, -1):
        for _ in range(counts[index] - counts[index - 1]):
            undo.click()
        assert app.workspace.document == documents[index - 1]
    assert undo.disabled
    assert redo.tooltip.endswith(": draw F1 (Ctrl+Y)")
    for index in range(1, len(documents)):
        for _ in range(counts[index] - counts[index - 1]):
            redo.click()
        assert app.workspace.document == documents[index]
    assert redo.disabled
    assert app.section.name == "line"


def test_controls_follow_undo_by_key(app, tmp_path):
    for edit in (move_slider, add_step, change_spacing, change_solver):
        edit(app, tmp_path)
    keys(app.panes.original, *"zzzz", modifiers=["ctrl"])
    assert app.weights == app.sliders.weights == sw.Weights()
    assert app.sliders.sliders["edge"].value == sw.Weights().edge
    assert app.step_list.steps == sw.Plan().steps
    assert (app.solving.spacing, app.solving.solver) == (None, "gauss-newton")
    assert app.workspace.history.redo_count == 4


def test_an_edit_that_changes_nothing_is_no_edit(app):
    app.weights, app.steps, app.fixed = app.weights, app.steps, app.fixed
    app.interpretation = app.interpretation
    app.workspace.change_plan("weights", weights=sw.Weights())
    assert app.workspace.history.undo_count == 0


def test_undo_names_what_the_mouse_did_to_a_pick(app, tmp_path):
    draw_fault(app, tmp_path)
    pane, labels = app.panes.original, []
    for points, modifiers in (([(2200.0, 700.0)], []), ([(2200.0, 700.0)], ["ctrl"]), ([(2000.0, 200.0)], ["ctrl"])):
        click(pane, *points, modifiers=modifiers)
        labels.append(app.workspace.history.next_undo.label)
    assert labels == ["add to F1", "delete a vertex of F1", "delete F1"]
