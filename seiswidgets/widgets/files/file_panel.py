"""The app's tab of files: a section in, picks in and out, results out, and the session."""

from html import escape
from pathlib import Path

from ipywidgets import HTML, Button, HBox, Layout, Text, VBox

from seiswidgets.widgets.files.picks_files import PicksFiles
from seiswidgets.widgets.files.question import Question
from seiswidgets.widgets.files.result_files import ResultFiles
from seiswidgets.widgets.files.section_opener import SectionOpener
from seiswidgets.widgets.files.session_bar import SessionBar
from seiswidgets.widgets.messages import HINT
from seiswidgets.widgets.workspace import Workspace

HEADING = "<b>{}</b>"
KEPT = "Every edit is saved in {} from now on."
ASKED = "There is earlier work in {}: choose above the section what becomes of it."
UNKEPT = "Nothing is saved by itself now."
WHERE = "Files are on the computer that runs the notebook. A path that begins with no / begins in {}."


class FilePanel(VBox):
    """All that an app reads and writes.

    Parameters
    ----------
    workspace : Workspace
    keeper : SessionBar

    Attributes
    ----------
    section, picks, results, session : SectionOpener, PicksFiles, ResultFiles, SessionFile
        The parts.
    """

    def __init__(self, workspace: Workspace, keeper: SessionBar):
        self.section, self.picks = SectionOpener(workspace), PicksFiles(workspace)
        self.results, self.session = ResultFiles(workspace), SessionFile(keeper)
        where = HTML(HINT.format(WHERE.format(escape(str(Path.cwd())))))
        parts = {"Section": self.section, "Picks": self.picks, "Results": self.results, "Session": self.session}
        children = [child for title, part in parts.items() for child in (HTML(HEADING.format(title)), part)]
        super().__init__([where, *children])

    def wait(self, timeout: float | None = None) -> bool:
        """Wait until nothing is being opened, read or written; False if that took too long."""
        return all(part.wait(timeout) for part in (self.section, self.picks, self.results))

    def end(self) -> None:
        """Give up what is under way, and delete what was uploaded."""
        for part in (self.section, self.picks, self.results):
            part.end()


class SessionFile(VBox):
    """Where the app keeps its work by itself.

    Parameters
    ----------
    keeper : SessionBar

    Attributes
    ----------
    path : Text
    notice : Question
        What is wrong.
    """

    def __init__(self, keeper: SessionBar):
        self._keeper, self.notice = keeper, Question()
        layout = Layout(flex="1", width="auto")
        self.path = Text(placeholder="folder/name.json; without, nothing is saved by itself", layout=layout)
        keep = Button(description="Keep work here", icon="save", layout=Layout(width="auto"))
        super().__init__([HBox([self.path, keep]), self.notice])
        keep.on_click(lambda _: self.notice.attempt(self.keep))
        keeper.workspace.observe(lambda change: self._take_path(), "session_path")
        keeper.notice.observe(lambda change: self.notice.hint(""), "text")  # as when its question was answered
        self._take_path()

    def keep(self) -> None:
        """Keep the work in the file of that path, and say so.

        Raises
        ------
        DataError, SettingError
            If that cannot be.
        """
        self._keeper.keep(self.path.value.strip() or None)
        path = self._keeper.workspace.session_path
        kept = ASKED if self._keeper.notice.answers else KEPT if path else UNKEPT
        self.notice.hint(kept.format(path))

    def _take_path(self):
        if self._keeper.workspace.session_path is not None:
            self.path.value = str(self._keeper.workspace.session_path)
