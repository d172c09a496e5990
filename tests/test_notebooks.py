"""Contents of the notebooks; that they run is tested in JupyterLab, by tests/widgets/test_notebooks_browser.py."""

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


def test_notebooks_they_name_are_there():
    prose = " ".join(text for path in NOTEBOOKS for text in cells(path, "markdown"))
    named = set(re.findall(r"`(\d\d_\w+)`", prose))
    assert named
    assert named <= {path.stem for path in NOTEBOOKS}


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_sections_are_numbered_from_one(path):
    numbers = re.findall(r"^## (\d+)\.", "\n".join(cells(path, "markdown")), re.MULTILINE)
    assert numbers
    assert [int(number) for number in numbers] == [*range(1, len(numbers) + 1)]
