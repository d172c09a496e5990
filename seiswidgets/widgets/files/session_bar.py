"""The line of the app that keeps its work in a session's file, and offers what it finds there."""

import contextlib
from functools import partial
from pathlib import Path
from weakref import WeakValueDictionary

from ipywidgets import Dropdown, Layout, VBox

from seiswidgets.errors import DataError, SettingError, Text
from seiswidgets.interaction.document import Document
from seiswidgets.interaction.drawing import FAULT, HORIZON, Drawing
from seiswidgets.io.files import user_path
from seiswidgets.io.session.autosave import Autosave, Version, find_versions, numbered_files, set_aside
from seiswidgets.io.session.saved_picks import SavedPick
from seiswidgets.io.session.session import Session, SessionWithSection, source_beside
from seiswidgets.io.session.sources import FILE, section_path, section_sha256
from seiswidgets.widgets.files.labels import counted
from seiswidgets.widgets.files.question import Question
from seiswidgets.widgets.jobs import Job, JobRunner
from seiswidgets.widgets.messages import in_words
from seiswidgets.widgets.workspace import Workspace

OPEN, PICKS_ONLY, ANEW = "Open", "Picks only", "Start anew"
SAFE = "What is drawn stays in memory meanwhile, and is saved as soon as that works."
UNSAVED = "Nothing is saved until you choose."

_in_use = WeakValueDictionary()  # the bars of this kernel, by the path that each keeps


class SessionBar(VBox):
    """Saves the work of an app after every finished edit, and asks first about earlier work that it finds.

    Parameters
    ----------
    workspace : Workspace

    Attributes
    ----------
    notice : Question
        What is said, and asked, when the app or its user begins something.
    news : Question
        That saving fails, or works again; not a part of the bar, as it comes while lines are drawn, and must not move
        what is below.
    """

    def __init__(self, workspace: Workspace):
        self.workspace, self._autosave, self._sha256 = workspace, None, None
        self._runner, self._has_work, self._left = JobRunner(), False, None
        self.notice, self.news = Question(), Question()
        self.versions = Dropdown(description="version", layout=Layout(width="auto", max_width="100%"))
        super().__init__([self.notice])
        workspace.observe(self._take_edit, ("document", "settled"))
        workspace.guard_section(self._leave_section)

    @property
    def path(self) -> Path | None:
        """Where the session is kept."""
        return self.workspace.session_path

    def keep(self, path: str | Path | None) -> None:
        """Keep the work under this path from now on, or nowhere.

        If there is work already, nothing is written until the user has chosen between that and what is on the screen.
        Another app that keeps its work there ends to do so.

        Raises
        ------
        SettingError
            If it does not end in .json.
        DataError
            If there is no such folder; or if the path is None, and what is not saved yet cannot be.
        """
        if path is None:
            self.end()
            return
        path = _checked(path)
        if path == self.path and self._autosave is not None:
            return
        with contextlib.suppress(DataError):  # whose remedy may be this path: all that is drawn is saved there
            self.end()
        self.news.hint("")
        if path in _in_use:
            _in_use[path].give_up()
        self.workspace.session_path, _in_use[path] = path, self
        versions = find_versions(path)
        if versions:
            self._offer(versions)
        elif numbered_files(path):
            self._ask(f"{path} has earlier versions, but none that can be opened. {UNSAVED}", {ANEW: self._start_anew})
        else:
            self._begin(path)

    def end(self) -> None:
        """Save what is not saved yet, and then keep the work nowhere; a DataError if it cannot be saved."""
        path, autosave = self.path, self._autosave
        self.workspace.session_path = self._autosave = None
        if _in_use.get(path) is self:
            del _in_use[path]
        self._runner.drop()
        self.notice.hint("")
        if autosave is not None:
            autosave.close()
        self.news.hint("")

    def give_up(self) -> None:
        """End, as another app keeps its work in the same file; what cannot be saved stays in memory."""
        path = self.path
        with contextlib.suppress(DataError):  # which is said already
            self.end()
        self.notice.hint(f"Another app keeps its work in {path} now; this one saves no more.")

    def _leave_section(self):
        """Set the work aside before another section is opened; a DataError, if it cannot be saved, prevents that."""
        path = self.path
        if self._autosave is None:
            return
        try:
            self.end()
            aside = set_aside(path)
        except DataError:
            self._begin(path)
            raise
        self._left = path, aside

    def wait(self, timeout: float | None = None) -> bool:
        """Wait until nothing is being opened; False if that took too long."""
        return self._runner.wait(timeout)

    def _begin(self, path):
        """Save under a path from now on."""
        self.workspace.session_path, _in_use[path] = path, self
        self._sha256 = section_sha256(self.workspace.section)
        self._autosave, self._has_work = Autosave(path, report=self._report), False
        self._take_edit()

    def _take_edit(self, change=None):
        """Have the work saved, from the first pick or held point on."""
        if self._left is not None:
            (path, aside), self._left = self._left, None
            self._begin(path)
            self.notice.hint(f"The work on the earlier section stays in {aside}." if aside else "")
            return
        document = self.workspace.document
        self._has_work = self._has_work or bool(document.drawing.picks) or document.plan.fixed is not None
        if self._autosave is not None and self._has_work and self.workspace.settled:
            self._autosave.save(session_of(document, self._sha256, self.path))

    def _report(self, error):
        """Say that saving fails, or works again; on the thread that saves."""
        if error is None:
            self.news.hint(f"Saved again in {self.path}.")
        else:
            self.news.alert(Text(error.text, ". ", SAFE))

    def _offer(self, versions):
        self.versions.options = [(_words(version), version) for version in versions]
        self.versions.value = versions[0]
        self._ask(
            f"{self.path} holds earlier work. {UNSAVED}",
            {OPEN: self._open, PICKS_ONLY: self._open_picks, ANEW: self._start_anew},
            self.versions,
        )

    def _ask(self, text, answers, *before):
        self._asked = text, answers, *before
        self.notice.ask(*self._asked)

    def _ask_again(self, error):
        _, answers, *before = self._asked
        self.notice.ask(f"{error}. {UNSAVED}", answers, *before)

    def _start_anew(self):
        try:
            aside = set_aside(self.path)
        except DataError as error:
            self._ask_again(error)
            return
        self._begin(self.path)
        if aside:
            self.notice.hint(f"The earlier work stays in {aside}.")

    def _open(self, read_outside=False):
        session = self.versions.value.session
        if session.sha256 == section_sha256(self.workspace.section):
            self._take(session, self.workspace.section)
        elif self._is_outside(session.source) and not read_outside:
            self.notice.ask(
                f"Its section is read from {session.source.name}, which lies outside the session's folder.",
                {"Read it": lambda: self._open(read_outside=True), "Back": lambda: self._ask(*self._asked)},
            )
        else:
            self.notice.hint(f"Opening the section from {session.source.kind} {session.source.name} ...")
            take, fail = partial(self._take, session), lambda error: self._ask_again(in_words(error))
            self._runner.submit(Job(lambda job: session.open_section(), take, fail))

    def _is_outside(self, source):
        if source.kind != FILE:
            return False
        try:
            section_path(self.path.parent, source.name, allow_outside=False)
        except DataError:
            return True
        return False

    def _open_picks(self):
        session, section = self.versions.value.session, self.workspace.section
        if not drawing_of(session).lies_on(section):
            self._ask_again("These picks do not lie on the section that is shown; Open opens theirs")
            return
        self._take(session, section, of_other=session.sha256 != section_sha256(section))

    def _take(self, session, section, of_other=False):
        """Show a session's work, and go on with it."""
        source = self.workspace.source if of_other else session.source
        path, version = self.path, self.versions.value.path
        self.workspace.open(section, drawing_of(session), source=source, plan=session.plan)
        self._begin(path)
        self.notice.hint(f"Opened {version}.")


def _checked(path):
    path = user_path(path).absolute()
    if path.suffix.lower() != ".json":
        raise SettingError(f"{path} must end in .json, as a session's file does")
    if not path.parent.is_dir():
        raise DataError(f"there is no folder {path.parent}; make it, or choose another")
    return path


def _words(version: Version) -> str:
    """A version in a line: when it was saved, and what it holds."""
    held = ", a point held" * (version.session.plan.fixed is not None)
    return f"{version.saved:%d %b %Y, %H:%M:%S}: {counted(version.session)}{held} ({version.path.name})"


def session_of(document: Document, sha256: str, path: Path) -> Session | SessionWithSection:
    """Session of a document, to be saved under a path; the draft line is left out.

    A section without a source is saved with it.
    """
    faults, horizons = (_saved(document.drawing, kind) for kind in (FAULT, HORIZON))
    source = document.source or source_beside(path, sha256)
    session = Session(source, sha256, faults, horizons, document.plan)
    return session if document.source else SessionWithSection(session, document.section)


def _saved(drawing, kind):
    picks = (pick for pick in drawing.picks if pick.kind == kind)
    return tuple(SavedPick(pick.name, pick.pieces, pick.colour, pick.visible) for pick in picks)


def drawing_of(session: Session) -> Drawing:
    """The picks of a session, with their looks, even those that cannot be used."""
    drawing = Drawing()
    for kind, picks in ((FAULT, session.faults), (HORIZON, session.horizons)):
        for pick in picks:
            drawing = drawing.with_pick(kind, pick.name, pick.pieces, pick.colour, pick.visible)
    return drawing
