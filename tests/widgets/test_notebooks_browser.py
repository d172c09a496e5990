"""Every notebook in JupyterLab, from its first cell to its exercises; in 01 a section is restored by mouse too."""

import shutil
import sys

import pytest

from tests.exercise_answers import ANSWERS
from tests.sections import real_section
from tests.test_notebooks import NOTEBOOKS
from tests.widgets.axe import serious
from tests.widgets.byhand import draw_faulted_fold, is_of_today, is_painted, is_restored
from tests.widgets.test_pane_browser import shoot

FIRST, *OTHERS = NOTEBOOKS
IN_DATA = {"06_real_sections", "09_through_time"}  # cannot go without the real sections
MOST_SECONDS, MOST_MEGABYTES = 60, 1000  # of the processor, and of memory
OUTPUTS = """() => window.jupyterapp.shell.currentWidget.content.widgets
  .flatMap((cell) => cell.model.outputs?.toJSON() ?? [])"""
PICTURE, WIDGET = "image/png", "application/vnd.jupyter.widget-view+json"  # an app's output is both
FORM = ".widget-vbox:has(> .widget-hbox + .widget-html [role=status])"
FEEDBACK = """[[vars(question.check(eval(given) if hasattr(question, "cases") else given)) for given in answers]
    for question, answers in zip(
    [value for name, value in globals().items() if name.startswith("question_")], {answers}, strict=True)]"""
USED = "[__import__('time').process_time(), __import__('resource').getrusage(0).ru_maxrss]"
UNIT = 2**20 if sys.platform == "darwin" else 2**10  # of the memory used, in a megabyte


@pytest.fixture
def walk(notebook, lab):
    """A function that takes a notebook's reader through it: all runs and is seen, the exercises know their answers."""

    def walk_through(path):
        if path.stem in IN_DATA:
            real_section("teapot")  # skips where there are no data
        shutil.copytree(path.parent, lab.folder, dirs_exist_ok=True)
        opened = notebook(path=path.name, height=1000)
        shown = has_run(opened)
        assert any(PICTURE in data for data in shown)
        if any({PICTURE, WIDGET} <= set(data) for data in shown):
            is_painted(opened.page)
        answers = ANSWERS[path.stem]
        knows_its_answers(opened, answers)
        forms = opened.page.locator(FORM)
        for number in range(len(answers)):
            forms.nth(number).wait_for()
        answer_by_hand(forms.first, *answers[0])
        assert serious(opened.page, ".jp-OutputArea-output") == []
        shoot(opened, path.stem)
        seconds, memory = opened.ask(USED)
        assert seconds < MOST_SECONDS
        assert memory / UNIT < MOST_MEGABYTES
        return opened

    return walk_through


def has_run(opened):
    """Outputs of the cells, all of which have run without an error or a warning."""
    outputs = opened.page.evaluate(OUTPUTS)
    assert outputs
    assert {output["output_type"] for output in outputs} <= {"display_data", "execute_result", "stream"}
    assert not [output for output in outputs if output.get("name") == "stderr"]
    return [output["data"] for output in outputs if "data" in output]


def knows_its_answers(opened, answers):
    """Each question takes the right answer, and refuses each wrong one with its hint."""
    given = [[right, *wrong] for right, wrong in answers]
    for (right, wrong), (first, *others) in zip(answers, opened.ask(FEEDBACK.format(answers=given)), strict=True):
        assert first["right"], f"{right!r} was refused: {first['text']}"
        for (one, hint), feedback in zip(wrong.items(), others, strict=True):
            assert not feedback["right"], f"{one!r} was accepted for {right!r}"
            assert hint in feedback["text"], f"{one!r} got: {feedback['text']}"


def answer_by_hand(form, right, wrong):
    """Give an exercise a wrong answer and the right one, and read what is said of them."""
    field, feedback = form.get_by_role("textbox"), form.get_by_role("status")
    form.get_by_role("button", name="Check", exact=True).wait_for()
    for given, said in ((next(iter(wrong)), "Not yet."), (right, "Right.")):
        field.fill(given) if field.count() else form.get_by_label(given, exact=True).check()
        form.get_by_role("button", name="Check", exact=True).click()
        feedback.filter(has_text=said).wait_for()


@pytest.mark.parametrize("path", OTHERS, ids=lambda path: path.stem)
def test_a_notebook_runs_and_checks_its_exercises(walk, path):
    walk(path)


def test_in_the_first_one_a_section_is_also_restored_by_mouse(walk):
    opened = walk(FIRST)
    is_restored(opened.page)
    opened.ask("[setattr(app, 'interpretation', sw.Interpretation()), setattr(app, 'fixed', None)]")
    opened.until("not app.restoration.stages")
    is_of_today(opened.page)
    draw_faulted_fold(opened.page)
    opened.until("[stage.kind for stage in app.restoration.stages] == ['unfault', 'flatten'] and app.wait(30)")
    is_restored(opened.page)
    (verdict,) = opened.ask("[verdict(horizon) for horizon in app.interpretation.horizons]")
    assert verdict.startswith("is right")
    assert opened.ask("app.fixed is not None")
    shoot(opened, "restored-by-mouse")
