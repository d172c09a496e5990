"""Grading a class's sessions against the truth: a row for each file, whatever is in it."""

import csv
import io
import math
import re
import secrets
from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from dataclasses import asdict, dataclass, fields, replace
from pathlib import Path

from seiswidgets.errors import DataError, SeiswidgetsError
from seiswidgets.geology.assignment import assigned_case, file_stem
from seiswidgets.geology.comparison import PickComparison, compare_picks
from seiswidgets.geology.picks import FAULT, HORIZON, Interpretation
from seiswidgets.geology.plan import Plan
from seiswidgets.geology.restoration import Restoration
from seiswidgets.geology.section import Section
from seiswidgets.io.document import json_text, read_json
from seiswidgets.io.exports.sections import save_section
from seiswidgets.io.files import make_folder, write_file
from seiswidgets.io.picks.table import guarded
from seiswidgets.io.session.session import Session, open_session
from seiswidgets.io.session.sources import section_sha256

VERSION = re.compile(r"(?<=\.)\d{6}\.(?=json$)")  # in the names of automatically saved versions
KEY_FORMAT, KEY_VERSION = "seiswidgets key", 1
MOST_STUDENTS, MOST_POINTS, MOST_STEPS, MOST_ITERATIONS = 1000, 20_000, 8, 60
SCALE = {  # marks, the error that still gets all of them, and the error that gets none
    "fault": (20, 1.5, 8.0),  # in traces
    "horizon": (30, 1.5, 10.0),  # in samples
    "throw": (25, 0.05, 0.4),  # relative
    "balance": (15, 0.005, 0.05),  # relative change of a bed's length
}
FINDINGS = {"problem": 5, "warning": 2}  # marks lost for each, of the ten for a restoration without any
NO_FINDINGS = 10


@dataclass(frozen=True)
class Grade:
    """A row of the table of grades; numbers are None where a session could not be graded.

    Attributes
    ----------
    file, student : str
    points : float
        Out of 100.
    fault_error, horizon_error : float
        RMS distance of the picks from the truth, in metres of rock.
    picked : float
        Share of the true faults and horizons that was picked, in percent.
    throw_error : float
        Mean error of the throws, in percent.
    throws : str
        Each throw as picked, with the true one in brackets.
    balance : float
        Largest change of a bed's length in the restoration, in percent.
    findings, remark : str
        Warnings and problems of the restoration, and the reason why something could not be graded.
    """

    file: str
    student: str = ""
    points: float | None = None
    fault_error: float | None = None
    horizon_error: float | None = None
    picked: float | None = None
    throw_error: float | None = None
    throws: str = ""
    balance: float | None = None
    findings: str = ""
    remark: str = ""


@dataclass(frozen=True, eq=False)
class Task:
    """The section of an assignment, the hash by which it is recognised, its true picks, and whose it is."""

    student: str
    section: Section
    sha256: str
    truth: Interpretation


@dataclass(frozen=True, eq=False)
class Key:
    """The truth by which sessions are graded: a task for each student, or one for all."""

    tasks: tuple[Task, ...]
    shared: bool

    def task(self, session: Session, path: Path) -> tuple[Task, str]:
        """The task of a session, recognised by its section or else by its file's name, and a remark.

        Raises
        ------
        DataError
            If it is nobody's.
        """
        for task in self.tasks:
            if session.sha256 == task.sha256:
                return task, ""
        if self.shared:
            raise DataError(f"{path.name} was made on another section than the key")
        for task in self.tasks:
            if path.stem.casefold().startswith(file_stem(task.student)):
                return task, "recognised by the file's name only: its section differs from the key's"
        raise DataError(f"{path.name} was made on a section of nobody in the key; is the student's name on the list?")


def make_assignments(names: Sequence[str], folder: Path, course: str | None = None) -> Path:
    """Write a key, and a section for each student, into a folder; return the key's path.

    Parameters
    ----------
    names : sequence of str
    folder : Path
    course : str, optional
        If left out, a secret one is made, so that nobody without the key can make the sections.

    Raises
    ------
    DataError
        If names repeat or a file cannot be written, or a key is there already.
    SettingError
        If a name is empty.
    """
    stems = Counter(file_stem(name) for name in names)
    repeated = [stem for stem, count in stems.items() if count > 1]
    if repeated:
        raise DataError(f"two students are called {repeated[0]!r}; add a middle name or a number")
    make_folder(folder)
    path = folder / "key.json"
    if path.exists():
        raise DataError(f"{path} is there already, and grades depend on it; choose another folder or remove it")
    course = secrets.token_hex(8) if course is None else course
    for name in names:
        save_section(assigned_case(name, course).section, folder / f"{file_stem(name)}.npz")
    content = {"format": KEY_FORMAT, "version": KEY_VERSION, "course": course, "names": list(names)}
    write_file(path, json_text(content).encode())
    return path


def read_key(path: Path) -> Key:
    """Read a key: the file that `make_assignments` writes, or a teacher's session.

    Raises
    ------
    DataError
        If it is neither, or cannot be read.
    """
    document = read_json(path)
    if document.members().get("format") != KEY_FORMAT:
        session = open_session(path, allow_outside=True)
        section = session.open_section()
        return Key((Task("", section, section_sha256(section), session.interpretation),), shared=True)
    if document["version"].number() > KEY_VERSION:
        raise DataError(f"{path} comes from a newer version of seiswidgets; update it")
    names = [entry.text() for entry in document["names"].items()]
    if len(names) > MOST_STUDENTS:
        raise DataError(f"{path} lists {len(names)} students, but the limit is {MOST_STUDENTS}; split it")
    course = document["course"].text()
    return Key(tuple(_assigned_task(name, course) for name in names), shared=False)


def _assigned_task(name: str, course: str) -> Task:
    case = assigned_case(name, course)
    return Task(name, case.section, section_sha256(case.section), case.interpretation)


def session_files(paths: Sequence[Path]) -> list[Path]:
    """Files to grade: those given, and those of the folders given; of a work's numbered versions, the newest."""
    found = [sorted(path.glob("*.json")) if path.is_dir() else [path] for path in paths]
    newest = {VERSION.sub("", str(path)): path for group in found for path in group}
    return list(newest.values())


def grade_files(
    paths: Sequence[Path], key: Key, progress: Callable[[int, Path], None] | None = None
) -> Iterator[tuple[Grade, Interpretation | None]]:
    """Grade each file; its grade and its picks, which are None if it could not be read.

    Parameters
    ----------
    paths : sequence of Path
    key : Key
    progress : callable(index, path), optional
        Called before each file.
    """
    seen: dict[str, str] = {}
    for index, path in enumerate(paths):
        if progress:
            progress(index, path)
        grade, picks = _graded(path, key)
        if grade.student and picks:
            if grade.student in seen:
                grade = replace(grade, remark=_joined(grade.remark, f"same student as {seen[grade.student]}"))
            seen.setdefault(grade.student, path.name)
        yield grade, picks


def _graded(path: Path, key: Key) -> tuple[Grade, Interpretation | None]:
    try:
        session = open_session(path, allow_outside=True)
        task, remark = key.task(session, path)
        return _grade_session(path, session, task, remark), session.interpretation
    except SeiswidgetsError as error:
        return Grade(path.name, remark=f"not graded: {str(error).replace(str(path), path.name)}"), None
    except Exception as error:  # noqa: BLE001 - one damaged file must not stop the others
        return Grade(path.name, remark=f"not graded: {error!r}, which is a bug in seiswidgets"), None


def _grade_session(path: Path, session: Session, task: Task, remark: str) -> Grade:
    drawn = sum(len(piece) for pick in (*session.faults, *session.horizons) for piece in pick.pieces)
    if drawn > MOST_POINTS:
        raise DataError(f"{path.name} has {drawn} points, more than the {MOST_POINTS} that are graded")
    picks = session.interpretation
    compared = compare_picks(task.section, picks, task.truth)
    restored, trouble = _restored(session, task.section)
    changes = [abs(bed.length_change) for stage in restored.stages for bed in stage.report.beds] if restored else []
    findings = [one for one in restored.findings if one.severity in FINDINGS] if restored else []
    balance = max(changes) if changes else None
    return Grade(
        file=path.name,
        student=task.student or path.stem,
        points=round(_points(compared, task.section, balance, [one.severity for one in findings]), 1),
        fault_error=_rounded(compared.error(FAULT)),
        horizon_error=_rounded(compared.error(HORIZON)),
        picked=_rounded(50 * (compared.coverage(FAULT) + compared.coverage(HORIZON))),
        throw_error=_rounded(100 * compared.throw_error),
        throws="; ".join(
            f"{one.horizon} {'none' if one.picked is None else f'{one.picked:.0f}'} ({one.true:.0f})"
            for one in compared.throws
        ),
        balance=None if balance is None else round(100 * balance, 2),
        findings="; ".join(f"{one.severity}: {one.text}" for one in findings),
        remark=_joined(remark, trouble, *session.problems),
    )


def _restored(session: Session, section: Section) -> tuple[Restoration | None, str]:
    """The session's steps on the key's section and a standard mesh, or None and the reason."""
    steps = tuple(step for step in session.plan.steps if step.on)
    if len(steps) > MOST_STEPS:
        return None, f"not restored: {len(steps)} steps, more than {MOST_STEPS}"
    try:
        plan = Plan(steps, fixed=session.fixed, max_iterations=MOST_ITERATIONS)
        restored = plan.restore(section, session.interpretation)
    except SeiswidgetsError as error:
        return None, f"not restored: {error}"
    return (restored, "") if restored.stages else (None, "not restored: no step has anything to work on")


def _points(compared: PickComparison, section: Section, balance: float | None, severities: list[str]) -> float:
    """Points out of 100: for faults, horizons, throws, balance, and a restoration without findings."""
    trace, sample = section.dx * section.metres[0], section.dz * section.metres[1]
    points = _share("fault", compared.error(FAULT) / trace) * compared.coverage(FAULT)
    points += _share("horizon", compared.error(HORIZON) / sample) * compared.coverage(HORIZON)
    found = [_share("throw", score.error) for score in compared.throws] or [0.0]
    points += sum(found) / len(found)
    if balance is not None:
        unspoilt = max(0, NO_FINDINGS - sum(FINDINGS[severity] for severity in severities))
        points += (_share("balance", balance) + unspoilt) * compared.coverage(HORIZON)
    return float(points)


def _share(kind: str, error: float) -> float:
    """Marks for an error: all up to a first limit, none from a second one on, and linear between."""
    marks, good, bad = SCALE[kind]
    return 0.0 if math.isnan(error) else marks * min(1.0, max(0.0, (bad - error) / (bad - good)))


def _rounded(value: float) -> float | None:
    return round(value, 1) if math.isfinite(value) else None


def _joined(*parts: str) -> str:
    return "; ".join(part for part in parts if part)


def grades_as_csv(grades: Sequence[Grade]) -> str:
    """The table of grades, a row for each file."""
    table = io.StringIO()
    writer = csv.writer(table, lineterminator="\n")
    writer.writerow(field.name for field in fields(Grade))
    for grade in grades:
        writer.writerow(guarded(value) if isinstance(value, str) else value for value in asdict(grade).values())
    return table.getvalue()
