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
    undo, redo = toolbar_button(app, "undo"), toolbar_button(app, "repeat")
    assert undo.disabled
    documents, labels = [app.workspace.document], []
    for edit in EDITS:
        edit(app, tmp_path)
        while app.workspace.history.undo_count > len(labels):  # a drawn line is several edits
            labels.append(app.workspace.history.next_undo.label)
            documents.append(None)
        documents[-1] = app.workspace.document
    assert labels[:2] == ["draft line", "draft line"]
    assert labels[2:] == [*EDITS.values()]
    after = [document for document in documents if document is not None]
    assert len(set(map(id, after))) == len(EDITS) + 1
    for document, label in zip(documents[-2::-1], labels[::-1], strict=True):
        assert undo.tooltip == f"undo: {label} (Ctrl+Z)"
        undo.click()
        assert document in (None, app.workspace.document)
    assert undo.disabled
    assert app.workspace.document == after[0]
    for document, label in zip(documents[1:], labels, strict=True):
        assert redo.tooltip.endswith(f": {label} (Ctrl+Y)")
        redo.click()
        assert document in (None, app.workspace.document)
    assert redo.disabled
    assert app.workspace.document == after[-1]
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
