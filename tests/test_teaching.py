"""The lecturer's pack: solutions, the table of points, and the blank assignment."""

import re
from pathlib import Path

import matplotlib.pyplot as plt
import pytest
from exercises.units import read_quantity

import seiswidgets as sw
from seiswidgets.__main__ import main
from seiswidgets.geology.assignment import assigned_case
from seiswidgets.io.grading import FINDINGS, NO_FINDINGS, SCALE
from tests.exercise_answers import ANSWERS
from tests.test_notebooks import NOTEBOOKS, ROOT, cells

SOLUTIONS = (ROOT / "teaching" / "solutions.md").read_text(encoding="utf-8")
LAB = ROOT / "notebooks" / "lab.ipynb"


def agrees(item, answered):
    """True if the answer in an item of the solutions is the student's right one, in any unit; code is not compared."""
    found = re.search(r"\*\*(.+?)\*\*|`(return .+?)`", item)
    tolerance = re.search(r"\(To within ([\d.]+) ?(.*?)\.\)", item)
    if not tolerance:
        return answered.startswith("lambda") if found[2] else found[1] == answered
    (solved, *_), given = (read_quantity(text, tolerance[2]) for text in (found[1], answered))
    return any(abs(one.value - solved.value) <= 1.1 * float(tolerance[1]) for one in given)


@pytest.mark.parametrize("stem", [path.stem for path in NOTEBOOKS])
def test_the_solutions_are_those_that_the_exercises_accept(stem):
    (part,) = re.findall(rf"\(\.\./notebooks/{stem}\.ipynb\)\n\n(.*?)(?=\n## |\Z)", SOLUTIONS, re.DOTALL)
    items = [" ".join(item.split()) for item in re.split(r"^\d+\. ", part, flags=re.MULTILINE)[1:]]
    assert len(items) == len(ANSWERS[stem])
    for item, (right, _) in zip(items, ANSWERS[stem], strict=True):
        assert agrees(item, right), f"{item} is not {right}"


def test_the_guide_gives_the_points_as_they_are():
    guide = (ROOT / "teaching" / "README.md").read_text(encoding="utf-8")
    rows = re.findall(r"^\| (?:the|a) [\w ]+ \| (\d+) \| ([\d.]*)[^|\n]*\| ([\d.]*)", guide, re.MULTILINE)
    percent = {"throw", "balance"}
    stated = [
        (str(marks), f"{good * (100 if kind in percent else 1):g}", f"{bad * (100 if kind in percent else 1):g}")
        for kind, (marks, good, bad) in SCALE.items()
    ]
    assert rows[:4] == stated
    assert rows[4] == (str(NO_FINDINGS), "", str(FINDINGS["problem"]))
    assert f"{FINDINGS['warning']} less for a warning" in guide
    assert sum(marks for marks, _, _ in SCALE.values()) + NO_FINDINGS == 100


def run_lab(name, draw):
    """The variables of the assignment's notebook, filled in by a student, and what its last cell prints."""
    variables = {}
    for source in cells(LAB, "code"):
        exec(compile(source.replace('NAME = "Your Name"', f"NAME = {name!r}"), "lab", "exec"), variables)
        if "app" in variables:
            draw(variables["app"])
    plt.close("all")
    return variables


def test_an_assignment_is_handed_in_and_graded(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    case = assigned_case("Ada Lovelace", "practice")
    (tmp_path / "names.txt").write_text("Ada Lovelace\n")

    def draw(app):
        app.fixed, app.interpretation = case.fixed, case.interpretation

    app = run_lab("Ada Lovelace", draw)["app"]
    assert "Complete. Hand in ada-lovelace-hand-in.json." in capsys.readouterr().out
    app.close()
    assert main(["assign", "names.txt", "--out", "class", "--course", "practice"]) == 0
    arguments = ["grade", "ada-lovelace-hand-in.json", "--truth", "class/key.json", "--out", "grades.csv"]
    assert main(arguments) == 0, capsys.readouterr().err
    assert "1 of 1 graded, 100 to 100 points" in capsys.readouterr().err


def test_an_empty_assignment_says_what_is_missing(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    variables = run_lab("Your Name", lambda app: None)
    said = capsys.readouterr().out
    assert all(task in said for task in ("write your name", "draw the fault", "draw 3 more horizons", "hold"))
    variables["app"].close()


def test_the_assignment_knows_no_truth():
    source = "\n".join(cells(LAB, "code"))
    assert "case" not in source.replace("casefold", "")
    assert isinstance(sw.assignment("Ada"), sw.Section)
    assert not list(Path(LAB).parent.glob("*.npz"))
