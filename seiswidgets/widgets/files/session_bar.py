"""Line of the app that saves its work in a session's file, and offers earlier work found there."""

import contextlib
from collections.abc import Callable, Mapping
from dataclasses import replace
from functools import partial
from os import PathLike
from pathlib import Path
from weakref import WeakValueDictionary

from ipywidgets import Dropdown, Layout, VBox, Widget
from traitlets import Bunch

from seiswidgets.errors import DataError, SettingError, Text
from seiswidgets.geology.bodies import BODY
from seiswidgets.geology.picks import FAULT, HORIZON
from seiswidgets.geology.section import Section
from seiswidgets.interaction.document import Alternative, Document
from seiswidgets.interaction.drawing import Drawing
from seiswidgets.io.files import user_path, write_file
from seiswidgets.io.session.autosave import Autosave, Version, find_versions, next_version, numbered_files, set_aside
from seiswidgets.io.session.ownership import Owner, claim, other_owner, release
from seiswidgets.io.session.saved_picks import SavedHypothesis, SavedPick
from seiswidgets.io.session.session import Session, SessionWithSection, source_beside
from seiswidgets.io.session.sources import FILE, SectionSource, section_path, section_sha256
from seiswidgets.widgets.files.labels import counted
from seiswidgets.widgets.files.question import Question
from seiswidgets.widgets.jobs import Job, JobRunner
from seiswidgets.widgets.messages import in_words
from seiswidgets.widgets.workspace import OtherHypotheses, Workspace

OPEN, PICKS_ONLY, START_ANEW = "Open", "Picks only", "Start anew"
READ, BACK = "Read it", "Back"
TAKE_OVER, COPY, TAKE_BACK = "Take over", "Open a copy", "Take it back"
STAYS_IN_MEMORY = "Your edits stay in memory, and are saved as soon as possible."
UNSAVED = "Nothing is saved until you choose."

Answers = Mapping[str, Callable[[], None]]

_in_use: WeakValueDictionary[Path, "SessionBar"] = WeakValueDictionary()  # bars of this kernel, by path


class SessionBar(VBox):
    """Saves a workspace after every finished edit, and first asks about earlier work under the same path.

    Parameters
    ----------
    workspace : Workspace

    Attributes
    ----------
    notice : Question
        Questions and news about the session.
    news : Question
        News that saving fails, or works again. To be placed below the panes: it appears while lines are drawn, and
        must not move them.
    versions : Dropdown
        Versions of earlier work to choose from.
    """

    def __init__(self, workspace: Workspace):
        self.workspace, self._runner = workspace, JobRunner()
        self._autosave: Autosave | None = None  # None as long as nothing is saved
        self._section: Section | None = None  # whose work is saved
        self._sha256, self._has_work = "", False
        self._aside: Path | None = None  # work on the section shown before
        self._question: tuple[str, Answers, tuple[Widget, ...]] = "", {}, ()
        self.notice, self.news = Question(), Question()
        self.versions = Dropdown(description="version", layout=Layout(width="auto", max_width="100%"))
        super().__init__([self.notice])
        workspace.observe(self._take_edit, ("document", "settled"))
        workspace.guard_section(self._leave_section)

    @property
    def path(self) -> Path | None:
        """Path of the session; None if there is none."""
        return self.workspace.session_path

    @property
    def is_saved(self) -> bool:
        """True if all finished edits are in the session's file."""
        return self._autosave is not None and self._autosave.pending is None

    def keep(self, path: str | PathLike | None) -> None:
        """Save the work under a path from now on, or nowhere.

        If there is earlier work under the path, nothing is written until the user has chosen between that and the work
        on the screen. If another app saves its work there, it stops doing so.

        Raises
        ------
        SettingError
            If the path does not end in .json.
        DataError
            If the folder does not exist, or if the path is None and unsaved edits cannot be saved.
        """
        if path is None:
            self.end()
            return
        path = _checked(path)
        if path == self.path and self._autosave is not None:
            return
        with contextlib.suppress(DataError):  # the new path may be the remedy: all edits are saved there
            self.end()
        if path in _in_use:
            _in_use[path].give_up()
        self.news.hint("")
        self.workspace.session_path, _in_use[path] = path, self
        owner = other_owner(path)
        if owner is None:
            self._continue(path)
            return
        answers = {TAKE_OVER: partial(self._continue, path), COPY: partial(self._open_copy, path)}
        self._ask(f"{path} is open in another notebook ({owner}). {UNSAVED}", answers)

    def _continue(self, path: Path) -> None:
        """Save under a path, or ask what to do with the earlier work there."""
        versions = find_versions(path)
        if versions:
            self._offer(path, versions)
        elif numbered_files(path):
            text = f"{path} has earlier versions, but none that can be opened. {UNSAVED}"
            self._ask(text, {START_ANEW: partial(self._start_anew, path)})
        else:
            self._begin(path)

    def keep_newest(self, path: Path) -> None:
        """Continue the newest version under a path, without asking which."""
        self.keep(path)
        if OPEN in self.notice.answers:
            self._open()

    def end(self) -> None:
        """Save unsaved edits, and stop saving; a DataError if they cannot be saved."""
        path, autosave = self.path, self._autosave
        self.workspace.session_path = self._autosave = self._section = None
        if path is not None and _in_use.get(path) is self:
            del _in_use[path]
            release(path)
        self._runner.drop()
        self.notice.hint("")
        if autosave is not None:
            autosave.close()
        self.news.hint("")

    def give_up(self) -> None:
        """Stop saving, since another app saves its work in the same file; unsaved edits may stay in memory."""
        path = self.path
        with contextlib.suppress(DataError):  # shown already
            self.end()
        self.notice.hint(f"Another app saves its work in {path} now; this one no longer does.")

    def _open_copy(self, path: Path) -> None:
        """Continue the newest work under a path, or the present work, under another name."""
        copy = _free_path(path)
        versions = find_versions(path)
        if not versions:
            self.keep(copy)
            return
        try:
            write_file(next_version(copy), versions[0].path.read_bytes())
        except (DataError, OSError) as error:
            self._ask_again(str(error))
            return
        self.keep(copy)
        self._open()

    def _lose(self, path: Path, owner: Owner) -> None:
        """Stop saving under a path that another process has taken over, and offer to continue elsewhere."""
        with contextlib.suppress(DataError):  # the copy, or the path taken back, gets all edits
            self.end()
        answers = {COPY: partial(self.keep, _free_path(path)), TAKE_BACK: partial(self._take_back, path)}
        self._ask(f"Another notebook has taken over {path} ({owner}): nothing is saved here any more.", answers)

    def _take_back(self, path: Path) -> None:
        self.workspace.session_path, _in_use[path] = path, self
        self._begin(path)

    def wait(self, timeout: float | None = None) -> bool:
        """Wait until nothing is being opened; False after the timeout in seconds."""
        return self._runner.wait(timeout)

    def _begin(self, path: Path) -> None:
        """Save the present section's work under a path from now on."""
        self.workspace.session_path, _in_use[path] = path, self
        claim(path)
        self._section, self._has_work = self.workspace.section, False
        self._sha256 = section_sha256(self._section)
        self._autosave = Autosave(path, report=partial(self._report, path))
        self._save(path)

    def _take_edit(self, change: Bunch) -> None:
        path = self.path
        if path is None or self._section is None:
            return
        owner = other_owner(path)
        if owner is not None:
            self._lose(path, owner)
        elif self.workspace.section is not self._section:
            self._begin(path)
            self.notice.hint(f"The work on the other section stays in {self._aside}." if self._aside else "")
        else:
            self._save(path)

    def _save(self, path: Path) -> None:
        """Save the document if it is settled, from the first pick or held point on."""
        document = self.workspace.document
        self._has_work = self._has_work or bool(document.drawing.picks) or document.plan.fixed is not None
        if self._autosave is not None and self._has_work and self.workspace.settled:
            self._autosave.save(_to_save(document, self._sha256, path))

    def _leave_section(self) -> None:
        """Set the work aside before another section is shown.

        Raises
        ------
        DataError
            If it cannot be saved; the section must then stay.
        """
        path, autosave = self.path, self._autosave
        if path is None or autosave is None:
            return
        try:
            autosave.close()
            self._aside = set_aside(path) if self._has_work else None
        except DataError as error:
            self._autosave = Autosave(path, report=partial(self._report, path))
            self._save(path)
            self.notice.alert(Text("This section stays, because its work cannot be saved: ", error.text))
            raise

    def _report(self, path: Path, error: DataError | None) -> None:
        """Show that saving fails, or works again; called on the thread that saves."""
        if error is None:
            written = self._autosave and self._autosave.newest
            self.news.hint(f"Saved again in {written or path}.")
        else:
            self.news.alert(Text(error.text, ". ", STAYS_IN_MEMORY))

    def _offer(self, path: Path, versions: list[Version]) -> None:
        self.versions.options = [(_summary(version), version) for version in versions]
        self.versions.value = versions[0]
        answers: Answers = {OPEN: self._open, PICKS_ONLY: self._open_picks, START_ANEW: partial(self._start_anew, path)}
        self._ask(f"{versions[0].path} holds earlier work. {UNSAVED}", answers, self.versions)

    def _ask(self, text: str, answers: Answers, *before: Widget) -> None:
        self._question = text, answers, before
        self.notice.ask(text, answers, *before)

    def _ask_again(self, reason: str | None = None) -> None:
        """Ask the last question again, after an answer that failed for a reason."""
        text, answers, before = self._question
        self.notice.ask(text if reason is None else f"{reason}. {UNSAVED}", answers, *before)

    def _start_anew(self, path: Path) -> None:
        try:
            aside = set_aside(path)
        except DataError as error:
            self._ask_again(str(error))
            return
        self._begin(path)
        if aside:
            self.notice.hint(f"The earlier work stays in {aside}.")

    def _open(self, read_outside: bool = False) -> None:
        version: Version = self.versions.value
        session = version.session
        if session.sha256 == section_sha256(self.workspace.section):
            self._take(version, session.source, self.workspace.section)
        elif _is_outside(version.path.parent, session.source) and not read_outside:
            self.notice.ask(
                f"Its section is read from {session.source.name}, which lies outside the session's folder.",
                {READ: partial(self._open, read_outside=True), BACK: self._ask_again},
            )
        else:
            self.notice.hint(f"Opening the section from {session.source.kind} {session.source.name} ...")
            take = partial(self._take, version, session.source)
            self._runner.submit(
                Job(lambda job: session.open_section(), take, lambda error: self._ask_again(in_words(error)))
            )

    def _open_picks(self) -> None:
        version: Version = self.versions.value
        section, session = self.workspace.section, version.session
        if not drawing_of(session).lies_on(section):
            self._ask_again(f"These picks do not lie on the section that is shown; {OPEN} opens theirs")
            return
        is_theirs = session.sha256 == section_sha256(section)
        self._take(version, session.source if is_theirs else self.workspace.source, section)

    def _take(self, version: Version, source: SectionSource | None, section: Section) -> None:
        """Show a version's work on a section, and continue with it."""
        path, session = self.path, version.session
        if path is not None:
            self.workspace.open(section, drawing_of(session), source=source, plan=session.plan, **others_of(session))
            self._begin(path)
            self.notice.hint(f"Opened {version.path}.")


def _is_outside(folder: Path, source: SectionSource) -> bool:
    """Return whether a session in a folder reads its section from a file outside that folder."""
    if source.kind != FILE:
        return False
    try:
        section_path(folder, source.name, allow_outside=False)
    except DataError:
        return True
    return False


def _checked(path: str | PathLike) -> Path:
    path = user_path(path).absolute()
    if path.suffix.lower() != ".json":
        raise SettingError(f"{path} must end in .json, as a session's file does")
    if not path.parent.is_dir():
        raise DataError(f"the folder {path.parent} does not exist; make it, or choose another")
    return path


def _free_path(path: Path) -> Path:
    """First of ``name-2.json``, ``name-3.json``, ... under which nothing is saved."""
    paths = (path.with_name(f"{path.stem}-{count}{path.suffix}") for count in range(2, 10**6))
    return next(free for free in paths if not (free.exists() or numbered_files(free) or free in _in_use))


def _summary(version: Version) -> str:
    """Describe a version in a line: when it was saved, and what it contains."""
    held = ", a point held" * (version.session.plan.fixed is not None)
    return f"{version.saved:%d %b %Y, %H:%M:%S}: {counted(version.session)}{held} ({version.path.name})"


def _to_save(document: Document, sha256: str, path: Path) -> Session | SessionWithSection:
    """Session of a document under a path; a section without a source is saved beside it."""
    if document.source is not None:
        return session_of(document, document.source, sha256)
    source, recorded = source_beside(path, sha256), document.section
    if recorded.conversion:
        source = replace(source, velocity=recorded.conversion.velocity, dz=recorded.dz)
        recorded = recorded.to_time()
    return SessionWithSection(session_of(document, source, sha256), recorded)


def session_of(document: Document, source: SectionSource, sha256: str) -> Session:
    """Session of a document whose section has a known source and hash, without the draft line."""
    faults, horizons, bodies = (_saved_picks(document.drawing, kind) for kind in (FAULT, HORIZON, BODY))
    before, after = (tuple(map(_saved_hypothesis, others)) for others in (document.before, document.after))
    own = Session(source, sha256, faults, horizons, document.plan, bodies=bodies)
    return replace(own, name=document.name, before=before, after=after)


def _saved_hypothesis(one: Alternative) -> SavedHypothesis:
    faults, horizons, bodies = (_saved_picks(one.drawing, kind) for kind in (FAULT, HORIZON, BODY))
    return SavedHypothesis(one.name, faults, horizons, one.plan, bodies)


def others_of(session: Session) -> OtherHypotheses:
    """The name of a session's own hypothesis, and the others."""
    before, after = (
        tuple(Alternative(one.name, drawing_of(one), one.plan) for one in others)
        for others in (session.before, session.after)
    )
    return {"name": session.name, "before": before, "after": after}


def _saved_picks(drawing: Drawing, kind: str) -> tuple[SavedPick, ...]:
    picks = (pick for pick in drawing.picks if pick.kind == kind)
    return tuple(
        SavedPick(pick.name, pick.pieces, pick.colour, pick.visible, pick.use, pick.ends, pick.body) for pick in picks
    )


def drawing_of(session: Session | SavedHypothesis) -> Drawing:
    """Picks of a session, or of one of its other hypotheses, with their styles, unusable ones included."""
    drawing = Drawing()
    for kind, picks in ((FAULT, session.faults), (HORIZON, session.horizons), (BODY, session.bodies)):
        for pick in picks:
            looks = pick.colour, pick.visible, pick.use, pick.ends, pick.body
            drawing = drawing.with_pick(kind, pick.name, pick.pieces, *looks)
    return drawing
