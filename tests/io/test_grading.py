"""Grading a class from the command line."""

import csv
import json

import numpy as np
import pytest

import seiswidgets as sw
from seiswidgets.__main__ import main
from seiswidgets.geology.assignment import assigned_case, file_stem

NAMES = ["Ada Lovelace", "Zoë Müller", "Inge Lehmann", "=Mary Anning"]
PICKS = {
    "well": lambda true: shifted(true, 2, 0),
    "badly": lambda true: shifted(true, 5, 75),
    "partly": lambda true: sw.Interpretation(true.faults, true.horizons[:1]),
    "empty": lambda true: sw.Interpretation(),
}


def shifted(true, down, right):
    """The true picks shifted down (m), the pieces in the hanging wall by more."""
    beds = [
        sw.Horizon(bed.pieces[0] + [0, down], bed.pieces[1] + [0, down + right], name=bed.name) for bed in true.horizons
    ]
    return sw.Interpretation(true.faults, beds)


@pytest.fixture(scope="module")
def course(tmp_path_factory):
    """A folder with a list of names, and in it the key and the sections of a class."""
    folder = tmp_path_factory.mktemp("course")
    (folder / "names.txt").write_text("\n".join(NAMES), encoding="utf-8")
    assert main(["assign", str(folder / "names.txt"), "--out", str(folder / "class"), "--course", "2026"]) == 0
    return folder


def hand_in(course, folder, name, how, stem=None):
    """A student's session, saved in a folder."""
    case = assigned_case(name, "2026")
    source = sw.SectionSource("file", str(course / "class" / f"{file_stem(name)}.npz"))
    plan = sw.Plan([sw.Step("unfault")], fixed=case.fixed)
    session = sw.Session.of(source.open(), source, PICKS[how](case.interpretation), plan=plan)
    session.save(folder / f"{stem or file_stem(name)}.json")
    return session


def graded(*arguments):
    """The exit status, and the rows of the table by file."""
    *_, out = arguments
    status = main(["grade", *map(str, arguments[:-1]), "--out", str(out)])
    with out.open(encoding="utf-8-sig", newline="") as file:
        return status, {row["file"]: row for row in csv.DictReader(file)}


def test_a_class_of_thirty_is_graded_whatever_it_hands_in(course, tmp_path, capsys):
    for name, how in zip(NAMES, PICKS, strict=True):
        hand_in(course, tmp_path, name, how)
    whole = (tmp_path / "ada-lovelace.json").read_text()
    damaged = {"void": "", "list": "[1, 2]", "torn": whole[:700], "text": "not a session", "key": "{}", "nan": "NaN"}
    for number in range(26):
        stem, content = list(damaged.items())[number % len(damaged)]
        (tmp_path / f"{stem}{number}.json").write_text(content)
    status, rows = graded(tmp_path, "--truth", course / "class" / "key.json", tmp_path / "grades.csv")
    assert (status, len(rows)) == (1, 30)
    points = {name: float(rows[f"{file_stem(name)}.json"]["points"]) for name in NAMES}
    assert points["Ada Lovelace"] > 95
    assert 30 < points["Zoë Müller"] < 50
    assert 40 < points["Inge Lehmann"] < 60
    assert points["=Mary Anning"] == 0
    refused = [row for row in rows.values() if not row["points"]]
    assert len(refused) == 26
    assert all(row["remark"].startswith("not graded: ") and "bug" not in row["remark"] for row in refused)
    assert rows["mary-anning.json"]["student"] == "'=Mary Anning"
    assert "4 of 30 graded" in capsys.readouterr().err


def test_a_row_says_how_far_off_a_student_is(course, tmp_path):
    hand_in(course, tmp_path, "Zoë Müller", "badly")
    status, rows = graded(tmp_path, "--truth", course / "class" / "key.json", tmp_path / "grades.csv")
    (row,) = rows.values()
    true = assigned_case("Zoë Müller", "2026").interpretation
    throw = sw.throw(true.faults[0], true.horizon("H1"))
    assert status == 0
    picked = float(row["throws"].split()[1])
    assert f"({throw:.0f})" in row["throws"]
    assert picked - throw == pytest.approx(75, abs=6)  # the fault is not vertical
    assert float(row["fault_error"]) == 0
    assert float(row["horizon_error"]) > 40
    assert float(row["picked"]) > 97
    assert float(row["balance"]) < 1


def test_files_are_recognised_by_their_section_or_their_name(course, tmp_path):
    session = hand_in(course, tmp_path, "Ada Lovelace", "well", "homework(2)")
    content = json.loads((tmp_path / "homework(2).json").read_text())
    content["section"]["sha256"] = "0" * 64
    (tmp_path / "ada-lovelace-final.json").write_text(json.dumps(content))
    (tmp_path / "nobody.json").write_text(json.dumps(content))
    _, rows = graded(tmp_path, "--truth", course / "class" / "key.json", tmp_path / "grades.csv")
    assert session.sha256 != "0" * 64
    assert rows["homework(2).json"]["student"] == "Ada Lovelace"
    assert "by the file's name only" in rows["ada-lovelace-final.json"]["remark"]
    assert "same student as ada-lovelace-final.json" in rows["homework(2).json"]["remark"]
    assert "nobody in the key" in rows["nobody.json"]["remark"]


def test_a_teachers_session_is_a_key_and_a_class_is_pooled(course, tmp_path):
    for stem, how in (("teacher", "well"), ("one", "well"), ("two", "badly")):
        hand_in(course, tmp_path, "Ada Lovelace", how, stem)
    hand_in(course, tmp_path, "Inge Lehmann", "well", "other")
    figure = tmp_path / "pooled.png"
    status, rows = graded(tmp_path, "--truth", tmp_path / "teacher.json", "--figure", figure, tmp_path / "grades.csv")
    assert status == 1
    assert sorted(rows) == ["one.json", "other.json", "two.json"]
    assert float(rows["one.json"]["points"]) > 98 > float(rows["two.json"]["points"])
    assert "another section than the key" in rows["other.json"]["remark"]
    assert figure.stat().st_size > 10_000


def test_the_section_made_in_a_notebook_is_that_of_the_key(course):
    for name in NAMES:
        handed_out = sw.open_section(course / "class" / f"{file_stem(name)}.npz")
        assert np.array_equal(handed_out.amplitude, sw.assignment(name, "2026").amplitude)


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["assign", "names.txt", "--out", "class"], "is there already, and grades depend on it"),
        (["assign", "twice.txt", "--out", "new"], "two students are called 'ada'"),
        (["assign", "void.txt", "--out", "new"], "has no names"),
        (["grade", "void", "--truth", "class/key.json", "--out", "x.csv"], "nothing to grade"),
        (["grade", "names.txt", "--truth", "names.txt", "--out", "x.csv"], "is not valid JSON"),
        (["grade", "names.txt", "--truth", "missing.json", "--out", "x.csv"], "there is no file"),
        (["grade", "names.txt", "--truth", "class/key.json", "--out", "x.csv", "--figure", "y.png"], "of one section"),
    ],
)
def test_a_command_that_cannot_be_done_says_why(course, monkeypatch, capsys, arguments, said):
    monkeypatch.chdir(course)
    (course / "twice.txt").write_text("Ada\nada\n")
    (course / "void.txt").write_text("\n")
    (course / "void").mkdir(exist_ok=True)
    assert main(arguments) == 1
    assert said in capsys.readouterr().err


def test_without_a_course_the_key_is_secret(tmp_path):
    (tmp_path / "names.txt").write_text("Ada\n")
    courses = set()
    for folder in ("one", "two"):
        assert main(["assign", str(tmp_path / "names.txt"), "--out", str(tmp_path / folder)]) == 0
        courses.add(json.loads((tmp_path / folder / "key.json").read_text())["course"])
    assert len(courses) == 2
