"""Contents of the notebooks; that they run is tested in JupyterLab, by tests/widgets/test_notebooks_browser.py."""

import ast
import re
from itertools import pairwise
from pathlib import Path

import nbformat
import pytest

from tests.exercise_answers import ANSWERS
from tests.sections import real_section

ROOT = Path(__file__).parents[1]
NOTEBOOKS = sorted((ROOT / "notebooks").glob("[0-9]*.ipynb"))
DRAWS = ("plt", "plot", "questions")


def cells(path, kind):
    """The text of a notebook's cells of one kind."""
    return [cell.source for cell in nbformat.read(path, as_version=4).cells if cell.cell_type == kind]


def test_there_are_notebooks_and_answers_to_what_they_ask():
    assert NOTEBOOKS
    assert set(ANSWERS) == {path.stem for path in NOTEBOOKS}
    assert all(len(wrong) >= 2 for answers in ANSWERS.values() for _, wrong in answers)


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_the_last_cell_states_what_must_hold(path):
    last = ast.parse(cells(path, "code")[-1]).body
    assert any(isinstance(statement, ast.Assert) for statement in last)


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_it_ends_with_links_to_other_notebooks(path):
    prose = "\n".join(cells(path, "markdown"))
    assert not re.search(r"`\d\d_\w+`", prose), "name notebooks by links"
    read_next = re.search(r"Read next(.+?)(?=\n## |\Z)", prose, re.DOTALL)
    linked = set(re.findall(r"\]\((\d\d_\w+)\.ipynb\)", read_next[1]))
    assert linked
    assert linked <= {path.stem for path in NOTEBOOKS} - {path.stem}


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_sections_are_numbered_from_one(path):
    numbers = re.findall(r"^## (\d+)\.", "\n".join(cells(path, "markdown")), re.MULTILINE)
    assert numbers
    assert [int(number) for number in numbers] == [*range(1, len(numbers) + 1)]


def computed(path):
    """The variables of a notebook after its imports, functions and assignments, without figures and exercises."""
    kept = [
        statement
        for statement in ast.parse("\n".join(cells(path, "code"))).body
        if isinstance(statement, ast.Import | ast.ImportFrom | ast.FunctionDef | ast.Assign)
        and not any(word in ast.unparse(statement) for word in DRAWS)
    ]
    variables = {}
    exec(compile(ast.Module(kept, []), path.name, "exec"), variables)
    return variables


def test_the_readme_gives_the_figures_of_the_real_sections():
    real_section("teapot")  # skips where there are no data
    found = computed(next(path for path in NOTEBOOKS if path.stem == "06_real_sections"))
    readme = " ".join((ROOT / "README.md").read_text(encoding="utf-8").split())
    said = re.search(
        r"06_real_sections.ipynb\) converge in (\d+) or (\d+) iterations per stage and leave their cut-offs at "
        r"most ([\d.]+) m apart; the correlation across their three faults rises from (.+?), (.+?) and (.+?) to (.+?), "
        r"(.+?) and (.+?)\. ",
        readme,
    )
    fewest, most, misfit, *correlations = map(float, said.groups())
    for restored in (found["restored_teapot"], found["restored_f3"]):
        assert all(fewest <= stage.report.iterations <= most for stage in restored.stages)
    assert found["misfit"] == pytest.approx(misfit, abs=0.01)
    before, after = zip(*found["correlation"].values(), strict=True)
    assert [*before, *after] == pytest.approx(correlations, abs=0.03)  # 0.02 apart with the other mesher


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_prompts_to_think_first_have_a_folded_answer(path):
    prompts = [text for text in cells(path, "markdown") if re.search(r"\*\*(Before you|Question)", text)]
    assert prompts
    assert all("<details><summary>Answer</summary>\n\n" in text for text in prompts)


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_at_least_one_exercise_is_a_line_to_write(path):
    assert any("...  # write this line" in text and "check(question_" in text for text in cells(path, "code"))


FIGURE = re.compile(
    r"plt\.subplots|^ *sw\.plot\.|= sw\.plot\.|^compare\(|= side_by_side\(|^side_by_side\(|sw\.RestorationApp\(", re.M
)
DEFINES = {"02_how_it_works": 0, "07_limits": 1}  # cells that only define a function that draws


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_figures_have_an_alternative_text_of_their_own(path):
    code = [cell for cell in nbformat.read(path, as_version=4).cells if cell.cell_type == "code"]
    texts = [cell.metadata.get("mystnb", {}).get("image", {}).get("alt") for cell in code]
    drawing = [text for cell, text in zip(code, texts, strict=True) if FIGURE.search(cell.source)]
    assert drawing.count(None) == DEFINES.get(path.stem, 0)
    given = [text for text in texts if text]
    assert len(set(given)) == len(given)
    assert all(len(text) > 60 and text.endswith(".") for text in given)


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_the_first_cell_gives_objectives_needs_and_a_true_duration(path):
    book = nbformat.read(path, as_version=4).cells
    first = book[0].source
    assert all(f"> **{words}" in first for words in ("You will be able to**", "You need**", "Time:**"))
    words = sum(len(re.sub(r"\]\([^)]*\)", "", cell.source).split()) for cell in book if cell.cell_type == "markdown")
    code = "\n".join(cells(path, "code"))
    minutes = words / 150 + 3 * code.count("= questions.") + 5 * code.count("sw.RestorationApp(")
    (said,) = re.findall(r"about (\d+) minutes", first)
    assert abs(int(said) - minutes) <= 5


def test_the_course_is_read_in_order():
    order = ["01", "03", "04", "05", "06", "07"]
    named = {
        path.stem[:2]: re.search(r"Read next(.+?)(?=\n## |\Z)", "\n".join(cells(path, "markdown")), re.S)
        for path in NOTEBOOKS
    }
    for here, then in pairwise(order):
        assert re.search(r"\]\((\d\d)", named[here][1])[1] == then
    index = (ROOT / "docs" / "index.md").read_text(encoding="utf-8")
    listed = re.findall(r"notebooks/(\d\d)_\w+\.ipynb\)", index)
    assert listed[: len(order)] == order
