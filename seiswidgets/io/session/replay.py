"""Replaying a session's file without a notebook: the restored section and the report, as files."""

import json
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

from seiswidgets import __version__
from seiswidgets.errors import DataError
from seiswidgets.geology.restoration import Restoration
from seiswidgets.io.exports.reports import report_as_dict
from seiswidgets.io.exports.sections import save_section
from seiswidgets.io.files import write_whole
from seiswidgets.io.session.session import Session, open_session
from seiswidgets.io.session.sources import FILE


@dataclass(frozen=True)
class Replay:
    """What a session came to."""

    session: Session
    restored: Restoration
    files: tuple[Path, ...]


def replayed(
    path: Path,
    folder: Path,
    name: str,
    progress: Callable[[int, int, int], None] | None = None,
    *,
    allow_outside: bool = False,
    allow_changed: bool = False,
) -> Replay:
    """Restore the session in a file and write its restored section and its reports into a folder.

    These are ``name-restored.npz``, ``name-report.txt`` and ``name-report.json``.

    Parameters
    ----------
    path, folder : Path
    name : str
        Of the files.
    progress : callable(step, steps, iteration), optional
        Called after each iteration, steps and iterations counted from 1.
    allow_outside, allow_changed : bool
        As for `open_session` and `Session.restore`.

    Raises
    ------
    SeiswidgetsError
        Any of ours; a DataError too where a result would replace the session's section.
    """
    session = open_session(path, allow_outside=allow_outside)
    endings = "-restored.npz", "-report.txt", "-report.json"  # which keep off the session
    section, text, report = files = tuple(folder / f"{name}{ending}" for ending in endings)
    _keep_off(session.source, files)
    steps = sum(step.on for step in session.plan.steps)
    counted = None if progress is None else _counted(progress, steps)
    restored = session.restore(counted, allow_changed=allow_changed)
    save_section(restored, section)
    write_whole(text, _text(path, session, restored).encode(errors="backslashreplace"))
    write_whole(report, _json(path, session, restored).encode())
    return Replay(session, restored, files)


def _keep_off(source, files):
    """Refuse to write a result over the section that it is made from."""
    for file in files:
        if source.kind == FILE and file.exists() and file.samefile(source.name):
            raise DataError(f"{file} is the section that the session is of; choose another folder for the results")


def output_names(paths: Sequence[Path]) -> list[str]:
    """A name for the output of each session: its own, with its folder's and a number where it is not the only one."""
    names = []
    for path in paths:
        several = sum(other.stem == path.stem for other in paths) > 1
        wanted = f"{path.absolute().parent.name}-{path.stem}" if several else path.stem
        name, count = wanted, 2
        while name in names:
            name, count = f"{wanted}-{count}", count + 1
        names.append(name)
    return names


def _counted(progress, steps):
    def told(step, iteration, energy):
        progress(step + 1, steps, iteration)

    return told


def _text(path, session, restored):
    parts = [f"{path}: {restored.original!r}", *(f"left out: {problem}" for problem in session.problems)]
    parts += [str(stage.report) for stage in restored.stages] or ["no step had anything to work on"]
    return "\n\n".join(parts) + "\n"


def _json(path, session, restored):
    about = {"session": str(path), "seiswidgets": __version__, "section_sha256": session.sha256}
    report = {**about, "left_out": session.problems, **report_as_dict(restored)}
    return json.dumps(report, indent=1, allow_nan=False) + "\n"
