"""Commands for lecturers: ``assign`` makes a section for each student, ``grade`` grades their sessions."""

import argparse
import sys
from pathlib import Path

from seiswidgets.errors import DataError
from seiswidgets.geology.picks import Interpretation
from seiswidgets.geology.pooling import pool_picks
from seiswidgets.io.document import read_text
from seiswidgets.io.files import write_file
from seiswidgets.io.grading import Grade, Key, grade_files, grades_as_csv, make_assignments, read_key, session_files

ASSIGN = """Writes into a folder: key.json, which grades the class and must stay secret, and <name>.npz for each
student, a section to hand out. The same key and name always give the same section."""
GRADE = """Writes a table with a row for each file: points, errors of picks and throws, balance, and findings. A file
that cannot be graded gets a row with the reason. The truth is the key.json of 'assign', or a teacher's session of the
one section that all have interpreted."""


def add_teaching_commands(commands: "argparse._SubParsersAction[argparse.ArgumentParser]") -> None:
    """Add ``assign`` and ``grade`` to the command line."""
    assign = commands.add_parser("assign", help="make a section for each student, and a key", description=ASSIGN)
    assign.add_argument("names", type=Path, metavar="names.txt", help="a text file with a student's name on each line")
    assign.add_argument("--out", type=Path, required=True, metavar="DIR", help="folder for the key and the sections")
    assign.add_argument(
        "--course",
        metavar="TEXT",
        help="make the sections that sw.assignment(name, TEXT) makes in a notebook; by default, a secret is used",
    )
    assign.set_defaults(run=_assign)
    grade = commands.add_parser("grade", help="grade the sessions of a class", description=GRADE)
    grade.add_argument("files", nargs="+", type=Path, metavar="FILE", help="sessions, or folders of them")
    grade.add_argument("--truth", type=Path, required=True, metavar="KEY", help="key.json, or a teacher's session")
    grade.add_argument("--out", type=Path, required=True, metavar="CSV", help="the table; an older one is replaced")
    grade.add_argument("--figure", type=Path, metavar="PNG", help="also draw all interpretations of a shared section")
    grade.set_defaults(run=_grade)


def _assign(options: argparse.Namespace) -> int:
    names = [line.strip() for line in read_text(options.names).splitlines() if line.strip()]
    if not names:
        raise DataError(f"{options.names} has no names; write one on each line")
    path = make_assignments(names, options.out, options.course)
    sys.stderr.write(f"{len(names)} sections and {path}, which must stay secret\n")
    return 0


def _grade(options: argparse.Namespace) -> int:
    key, files = read_key(options.truth), session_files(options.files)
    truth = options.truth.resolve()
    found = list(grade_files([path for path in files if path.resolve() != truth], key))
    grades = [grade for grade, _ in found]
    if not grades:
        raise DataError("there is nothing to grade; give session files, or folders that contain some")
    write_file(options.out, grades_as_csv(grades).encode("utf-8-sig"))  # the mark makes spreadsheets read UTF-8
    missing = [grade for grade in grades if grade.points is None]
    sys.stderr.writelines(f"{grade.file}: {grade.remark}\n" for grade in missing)
    if options.figure:
        _draw(key, [picks for _, picks in found if picks], options.figure)
    sys.stderr.write(f"{_summary(grades)}, in {options.out}\n")
    return 1 if missing else 0


def _summary(grades: list[Grade]) -> str:
    points = sorted(grade.points for grade in grades if grade.points is not None)
    text = f"{len(points)} of {len(grades)} graded"
    return f"{text}, {points[0]:g} to {points[-1]:g} points" if points else text


def _draw(key: Key, interpretations: list[Interpretation], path: Path) -> None:
    if len(key.tasks) != 1 or not interpretations:
        raise DataError(
            "a figure pools interpretations of one section; grade with a teacher's session, or a key of one"
        )
    from matplotlib.figure import Figure  # takes a moment to load

    from seiswidgets.plot.comparison import pooled

    (task,) = key.tasks
    pool = pool_picks(task.section, interpretations, task.truth)
    pooled(task.section, pool, figure=Figure()).savefig(path, dpi=150)
