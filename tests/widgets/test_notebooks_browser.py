"""Notebook 01 in JupyterLab: its cells run, its app is painted, and a section is restored by mouse."""

import shutil

import nbformat

from tests.widgets.browser import ROOT
from tests.widgets.byhand import PICTURES, draw_faulted_fold, is_painted, is_restored
from tests.widgets.test_pane_browser import shoot, until

NOTEBOOK = ROOT / "notebooks" / "01_restore_a_section.ipynb"
OUTPUTS = """() => window.jupyterapp.shell.currentWidget.content.widgets
  .flatMap((cell) => cell.model.outputs?.toJSON() ?? [])"""


def code_of(path):
    """The code cells of a notebook."""
    return [cell.source for cell in nbformat.read(path, as_version=4).cells if cell.cell_type == "code"]


def has_run(opened):
    """Wait until the last cell is done; no cell must have put out an error or a warning."""
    assert opened.ask("True")
    outputs = opened.page.evaluate(OUTPUTS)
    assert outputs
    assert {output["output_type"] for output in outputs} <= {"display_data", "execute_result", "stream"}
    assert not [output for output in outputs if output.get("name") == "stderr"]


def test_all_cells_run_and_a_section_is_restored_by_mouse(notebook, lab):
    shutil.copytree(NOTEBOOK.parent / "exercises", lab.folder / "exercises", dirs_exist_ok=True)
    opened = notebook(*code_of(NOTEBOOK), height=1000)
    has_run(opened)
    is_painted(opened.page)
    is_restored(opened.page)

    opened.ask("[setattr(app, 'interpretation', sw.Interpretation()), setattr(app, 'fixed', None)]")
    until(opened, "not app.restoration.stages")
    before = opened.page.evaluate(PICTURES)
    draw_faulted_fold(opened.page)
    until(opened, "[stage.kind for stage in app.restoration.stages] == ['unfault', 'flatten'] and app.wait(30)")
    is_restored(opened.page)
    assert opened.page.evaluate(PICTURES)[1] != before[1]
    (verdict,) = opened.ask("[verdict(horizon) for horizon in app.interpretation.horizons]")
    assert verdict.startswith("is right")
    assert opened.ask("app.fixed is not None")
    shoot(opened, "notebook-01")
