"""What the notebooks say; that they run is tested in JupyterLab, by tests/widgets/test_notebooks_browser.py."""

import ast
import re
from pathlib import Path

import nbformat
import pytest

from tests.exercise_answers import ANSWERS

NOTEBOOKS = sorted((Path(__file__).parents[1] / "notebooks").glob("[0-9]*.ipynb"))


def cells(path, kind):
    """The text of a notebook's cells of one kind."""
    return [cell.source for cell in nbformat.read(path, as_version=4).cells if cell.cell_type == kind]


def test_there_are_notebooks_and_answers_to_what_they_ask():
    assert NOTEBOOKS
    assert set(ANSWERS) == {path.stem for path in NOTEBOOKS}
    assert all(len(wrong) >= 3 for answers in ANSWERS.values() for _, wrong in answers)


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_the_last_cell_states_what_must_hold(path):
    last = ast.parse(cells(path, "code")[-1]).body
    assert any(isinstance(statement, ast.Assert) for statement in last)


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_notebooks_it_names_are_there(path):
    prose = " ".join(cells(path, "markdown"))
    assert set(re.findall(r"`(\d\d_\w+)`", prose)) <= {other.stem for other in NOTEBOOKS}


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_no_section_is_missing(path):
    numbers = re.findall(r"^## (\d+)\.", "\n".join(cells(path, "markdown")), re.MULTILINE)
    assert [int(number) for number in numbers] == [*range(1, len(numbers) + 1)]
