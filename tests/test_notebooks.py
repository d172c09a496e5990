"""Every notebook runs from top to bottom, and checks the answers to its exercises."""

import asyncio
import json
import os
import re
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import nbformat
import pytest
from nbclient import NotebookClient
from nbformat.v4 import new_code_cell

from tests.exercise_answers import ANSWERS
from tests.sections import real_section

NOTEBOOKS = sorted((Path(__file__).parents[1] / "notebooks").glob("*.ipynb"))
IN_DATA = {"06_real_sections"}  # cannot go without the real sections
MOST_SECONDS, MOST_MEGABYTES = 60, 1000  # of the processor, and of memory

# The last cell that is run: it answers the exercises, and says what the notebook took.
ANSWERING = """
import json, resource, sys, time
questions = [value for name, value in globals().items() if name.startswith("question_")]
used = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / (2**20 if sys.platform == "darwin" else 2**10)
feedback = [[vars(question.check(given)) for given in answers] for question, answers in zip(questions, {answers!r})]
print(json.dumps(dict(seconds=time.process_time(), megabytes=used, questions=len(questions), feedback=feedback)))
"""


def test_there_are_notebooks():
    assert NOTEBOOKS


def test_all_answers_are_asked_for():
    assert set(ANSWERS) <= {path.stem for path in NOTEBOOKS}
    assert all(len(wrong) >= 3 for answers in ANSWERS.values() for _, wrong in answers)


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_notebook_runs_and_checks_its_exercises(path):
    if path.stem in IN_DATA:
        real_section("teapot")  # skips where there are no data
    answers = ANSWERS.get(path.stem, [])
    cells = run(path, ANSWERING.format(answers=[[right, *wrong] for right, wrong in answers]))
    assert any("image/png" in output.get("data", {}) for cell in cells for output in cell.get("outputs", ()))
    told = json.loads(cells[-1].outputs[0].text)
    assert told["seconds"] < MOST_SECONDS
    assert told["megabytes"] < MOST_MEGABYTES
    assert told["questions"] == len(answers)
    for (right, wrong), (first, *others) in zip(answers, told["feedback"], strict=True):
        assert first["right"], f"{right!r} was refused: {first['text']}"
        for (given, hint), feedback in zip(wrong.items(), others, strict=True):
            assert not feedback["right"], f"{given!r} was accepted for {right!r}"
            assert hint in feedback["text"], f"{given!r} got: {feedback['text']}"


def run(path, code):
    """The notebook's cells after they have run, and after them a cell of some more code."""
    notebook = nbformat.read(path, as_version=4)
    notebook.cells.append(new_code_cell(code))
    environment = {name: value for name, value in os.environ.items() if name != "MPLBACKEND"}  # its pictures are drawn
    client = NotebookClient(notebook, timeout=120, resources={"metadata": {"path": path.parent}})
    with ThreadPoolExecutor(1) as alone:  # where no event loop runs: nbclient's own way would leave one open
        alone.submit(asyncio.run, client.async_execute(env=environment)).result()
    return notebook.cells


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_notebooks_it_names_are_there(path):
    prose = " ".join(cell.source for cell in nbformat.read(path, as_version=4).cells if cell.cell_type == "markdown")
    assert set(re.findall(r"`(\d\d_\w+)`", prose)) <= {other.stem for other in NOTEBOOKS}
