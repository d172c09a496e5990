"""Restoring a saved session without a notebook, and writing the restored section and the reports to files."""

import json
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

from seiswidgets import __version__
from seiswidgets.errors import DataError
from seiswidgets.geology.restoration import Restoration
from seiswidgets.io.exports.reports import report_as_dict
from seiswidgets.io.exports.sections import save_section
from seiswidgets.io.files import write_file
from seiswidgets.io.session.session import Session, open_session
from seiswidgets.io.session.sources import FILE, SectionSource

StepProgress = Callable[[int, int, int], None]
ENDINGS = "-restored.npz", "-report.txt", "-report.json"  # so that no result replaces the session


@dataclass(frozen=True)
class Replay:
    """A session, its restoration, and the files written: section, report as text and report as JSON."""

    session: Session
    restored: Restoration
    files: tuple[Path, Path, Path]


def replay_session(
    path: Path,
    folder: Path,
    name: str,
    progress: StepProgress | None = None,
    *,
    allow_outside: bool = False,
    allow_changed: bool = False,
) -> Replay:
    """Restore the session in a file and write the restored section and the reports into a folder.

    The files are ``name-restored.npz``, ``name-report.txt`` and ``name-report.json``.

    Parameters
    ----------
    path, folder : Path
    name : str
        Beginning of the file names.
    progress : callable(step, steps, iteration), optional
        Called after each iteration; steps and iterations are counted from 1.
    allow_outside, allow_changed : bool
        As for `open_session` and `Session.restore`.

    Raises
    ------
    SeiswidgetsError
        Any of its subclasses; DataError also if a result would replace the session's section.
    """
    session = open_session(path, allow_outside=allow_outside)
    section, text, report = (folder / f"{name}{ending}" for ending in ENDINGS)
    for file in (section, text, report):
        _check_is_not_section(file, session.source)
    steps = sum(step.on for step in session.plan.steps)
    counted = None if progress is None else _count_from_1(progress, steps)
    restored = session.restore(counted, allow_changed=allow_changed)
    save_section(restored, section)
    write_file(text, _report_as_text(path, session, restored).encode(errors="backslashreplace"))
    write_file(report, _report_as_json(path, session, restored).encode())
    return Replay(session, restored, (section, text, report))


def _check_is_not_section(file: Path, source: SectionSource) -> None:
    """Refuse to write a result over the section that it is made from."""
    if source.kind == FILE and file.exists() and file.samefile(source.name):
        raise DataError(f"{file} is the section of the session; choose another folder for the results")


def output_names(paths: Sequence[Path]) -> list[str]:
    """Beginning of the output names of each session: its own name, with its folder and a count where names repeat."""
    names: list[str] = []
    for path in paths:
        repeated = sum(other.stem == path.stem for other in paths) > 1
        wanted = f"{path.absolute().parent.name}-{path.stem}" if repeated else path.stem
        name, count = wanted, 2
        while name in names:
            name, count = f"{wanted}-{count}", count + 1
        names.append(name)
    return names


def _count_from_1(progress: StepProgress, steps: int) -> Callable[[int, int, float], None]:
    def report(step: int, iteration: int, energy: float) -> None:
        progress(step + 1, steps, iteration)

    return report


def _report_as_text(path: Path, session: Session, restored: Restoration) -> str:
    parts = [f"{path}: {restored.original!r}", restored.verdict]
    parts += [f"left out: {problem}" for problem in session.problems]
    parts += [str(stage.report) for stage in restored.stages] or ["no step had anything to work on"]
    return "\n\n".join(parts) + "\n"


def _report_as_json(path: Path, session: Session, restored: Restoration) -> str:
    header = {"session": str(path), "seiswidgets": __version__, "section_sha256": session.sha256}
    report = {**header, "left_out": session.problems, **report_as_dict(restored)}
    return json.dumps(report, indent=1, allow_nan=False) + "\n"
