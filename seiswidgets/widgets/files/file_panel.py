"""The app's tab File: open a section, import and export picks, export results, and choose the session's file."""

from html import escape
from pathlib import Path

from ipywidgets import HTML, Button, HBox, Layout, Text, VBox

from seiswidgets.io.files import user_path
from seiswidgets.io.session.autosave import next_version
from seiswidgets.widgets.files.depth_panel import DepthPanel
from seiswidgets.widgets.files.picks_files import PicksFiles
from seiswidgets.widgets.files.question import Question
from seiswidgets.widgets.files.result_files import ResultFiles
from seiswidgets.widgets.files.section_opener import SectionOpener
from seiswidgets.widgets.files.session_bar import SessionBar
from seiswidgets.widgets.messages import HINT
from seiswidgets.widgets.workspace import Workspace

HEADING = "<b>{}</b>"
SAVED = "Every edit is saved from now on: the next one in {}, and the last ten versions are kept."
ASKED = "There is earlier work in {}: choose above the section what to do with it."
NOT_SAVED = "Edits are not saved any more."
WHERE = "Files are on the computer that runs the notebook. A path that does not begin with / is relative to {}."


class FilePanel(VBox):
    """Everything that an app reads and writes.

    Parameters
    ----------
    workspace : Workspace
    session_bar : SessionBar

    Attributes
    ----------
    section, depth, picks, results, session : SectionOpener, DepthPanel, PicksFiles, ResultFiles, SessionFile
    """

    def __init__(self, workspace: Workspace, session_bar: SessionBar):
        self.section, self.picks = SectionOpener(workspace), PicksFiles(workspace)
        self.depth = DepthPanel(workspace)
        self.results, self.session = ResultFiles(workspace), SessionFile(session_bar)
        where = HTML(HINT.format(WHERE.format(escape(str(Path.cwd())))))
        parts = {
            "Section": self.section,
            "Depth": self.depth,
            "Picks": self.picks,
            "Results": self.results,
            "Session": self.session,
        }
        children = [child for title, part in parts.items() for child in (HTML(HEADING.format(title)), part)]
        super().__init__([where, *children])

    def wait(self, timeout: float | None = None) -> bool:
        """Wait until nothing is being opened, read or written; False after the timeout in seconds."""
        return all(part.wait(timeout) for part in (self.section, self.picks, self.results))

    def end(self) -> None:
        """Cancel the job in progress, and delete uploads."""
        for part in (self.section, self.picks, self.results):
            part.end()


class SessionFile(VBox):
    """Choice of the file that the app saves its work in.

    Parameters
    ----------
    session_bar : SessionBar

    Attributes
    ----------
    path, keep_button : Text, Button
    notice : Question
        The result, or an error.
    """

    def __init__(self, session_bar: SessionBar):
        self._bar, self.notice = session_bar, Question()
        layout = Layout(flex="1", width="auto")
        self.path = Text(placeholder="folder/name.json; if empty, edits are not saved", layout=layout)
        self.keep_button = Button(description="Save work here", icon="save", layout=Layout(width="auto"))
        super().__init__([HBox([self.path, self.keep_button]), self.notice])
        self.keep_button.on_click(lambda _: self.notice.attempt(self._keep_or_make))
        session_bar.workspace.observe(lambda change: self._take_path(), "session_path")
        session_bar.notice.observe(lambda change: self.notice.hint(""), "text")  # its question may be answered
        self._take_path()

    def keep(self) -> None:
        """Save the work under the path, and show that.

        Raises
        ------
        DataError, SettingError
            As for `SessionBar.keep`.
        """
        self._bar.keep(self.path.value.strip() or None)
        path = self._bar.path
        if path is None:
            self.notice.hint(NOT_SAVED)
        else:
            self.notice.hint(ASKED.format(path) if self._bar.notice.answers else SAVED.format(next_version(path)))

    def _keep_or_make(self) -> None:
        """Save the work under the path; if its folder is missing, offer to make it."""
        text = self.path.value.strip()
        if not text or self.notice.has_folder(user_path(text).absolute().parent, self.keep):
            self.keep()

    def _take_path(self) -> None:
        if self._bar.path is not None:
            self.path.value = str(self._bar.path)
