"""The page of an app without a section: open or drop a file, continue a session, or take a built-in section."""

from collections.abc import Callable
from functools import partial
from pathlib import Path

from ipywidgets import HTML, Button, Dropdown, HBox, Layout, VBox

from seiswidgets.geology.section import Section
from seiswidgets.interaction.drawing import Drawing
from seiswidgets.io.session.autosave import find_sessions
from seiswidgets.widgets.exhibits import EXHIBITS, Exhibit
from seiswidgets.widgets.files.background_job import BackgroundJob, Report
from seiswidgets.widgets.files.question import Question
from seiswidgets.widgets.files.section_opener import SectionOpener
from seiswidgets.widgets.messages import HINT
from seiswidgets.widgets.workspace import Workspace

MOST_SESSIONS = 8
HEADING = "<b>{}</b>"
AUTO = {"width": "auto"}


class StartPage(VBox):
    """Ways to a section; the app shows it as soon as one is open.

    Parameters
    ----------
    workspace : Workspace
    continue_session : callable(Path)
        Opens the newest version of a session.

    Attributes
    ----------
    opener : SectionOpener
    sessions : dict of Path to Button
        Sessions in the working folder and its subfolders, newest first.
    chooser, open_button : Dropdown, Button
        Built-in sections.
    job : BackgroundJob
        The loading of a built-in section.
    notice : Question
    """

    def __init__(self, workspace: Workspace, continue_session: Callable[[Path], None]):
        self._workspace, self.notice = workspace, Question()
        self.job = BackgroundJob(self.notice, lambda: "Opening was cancelled.")
        self.opener = SectionOpener(workspace)
        self.sessions = {path: _button(path, continue_session) for path in find_sessions(Path.cwd())[:MOST_SESSIONS]}
        options = [(exhibit.title, name) for name, exhibit in EXHIBITS.items()]
        self.chooser = Dropdown(options=options, description="section", layout=AUTO)
        self.open_button = Button(description="Open", icon="folder-open", layout=AUTO)
        self.open_button.on_click(lambda _: self.load())
        parts = {
            "Open a file, or drop one here": [self.opener],
            "Go on with a session": [HBox(list(self.sessions.values()), layout=Layout(flex_flow="row wrap"))],
            "Take a built-in section": [HBox([self.chooser, self.open_button, self.job]), self.notice],
        }
        if not self.sessions:
            parts["Go on with a session"] = [HTML(HINT.format("None in this folder yet: the tab File saves one."))]
        super().__init__([child for title, rows in parts.items() for child in (HTML(HEADING.format(title)), *rows)])
        self.add_class("seiswidgets-drop")

    def load(self) -> None:
        """Open the chosen built-in section, in the background."""
        self.job.begin(partial(self._read, EXHIBITS[self.chooser.value]))

    def wait(self, timeout: float | None = None) -> bool:
        """Wait until nothing is being opened; False after the timeout in seconds."""
        return self.opener.wait(timeout) and self.job.wait(timeout)

    def end(self) -> None:
        """Cancel the job in progress, and delete uploads."""
        self.opener.end()
        self.job.drop()

    def _read(self, exhibit: Exhibit, report: Report) -> Callable[[], None]:
        loaded = exhibit.load()
        section = loaded if isinstance(loaded, Section) else loaded.section
        return partial(self._workspace.open, section, Drawing(), source=exhibit.source)


def _button(path: Path, continue_session: Callable[[Path], None]) -> Button:
    button = Button(description=path.stem, icon="file", tooltip=str(path), layout=AUTO)
    button.on_click(lambda _: continue_session(path))
    return button
