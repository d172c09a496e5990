"""Opening a section in the app: choice of the file, preview, fields for what the file does not state."""

from collections.abc import Callable
from functools import partial
from html import escape
from pathlib import Path
from typing import Any

from ipywidgets import HTML, Button, HBox, Layout, VBox
from traitlets import Bunch

from seiswidgets.errors import SeiswidgetsError
from seiswidgets.geology.section import Section
from seiswidgets.interaction.drawing import Drawing
from seiswidgets.io.info import SectionInfo
from seiswidgets.io.opening import kind_of, open_section, preview
from seiswidgets.io.session.sources import FILE, SectionSource
from seiswidgets.widgets.files.background_job import BackgroundJob, Report
from seiswidgets.widgets.files.file_field import FileField
from seiswidgets.widgets.files.header_bytes import HeaderBytes
from seiswidgets.widgets.files.picture_calibrator import PictureCalibrator
from seiswidgets.widgets.files.question import Question
from seiswidgets.widgets.files.section_fields import SectionFields
from seiswidgets.widgets.files.thumbnail import thumbnail
from seiswidgets.widgets.workspace import Workspace

KINDS = ".sgy,.segy,.seg,.png,.jpg,.jpeg,.tif,.tiff,.npy,.npz,.txt,.csv,.asc,.tsv"
HEADER = (
    "<details><summary>textual header</summary>"
    '<pre tabindex="0" style="line-height: 1.2; overflow: auto; max-height: 240px">{}</pre></details>'
)
KEEP, DROP, CANCEL = "Keep the picks", "Drop the picks", "Do not open"


class SectionOpener(VBox):
    """Previews a chosen file and opens it, both in the background; the app then shows its section.

    Parameters
    ----------
    workspace : Workspace

    Attributes
    ----------
    file : FileField
    summary, thumbnail : HTML
        Preview of the file.
    header_bytes : HeaderBytes
        Shown for SEG-Y.
    fields : SectionFields
    calibrator : PictureCalibrator
        Shown for pictures.
    open_button : Button
    job : BackgroundJob
        The preview or the opening in progress.
    notice : Question
        Questions and errors.
    """

    def __init__(self, workspace: Workspace):
        self._workspace, self._is_previewed = workspace, False
        self.file = FileField("section: path of a SEG-Y, picture, NumPy or text file", KINDS)
        self.header_bytes, self.fields, self.notice = HeaderBytes(), SectionFields(), Question()
        self.calibrator = PictureCalibrator(self._show_picture, lambda on: self.fields.offer_extent(not on))
        self.fields.rescale = self.calibrator.rescale
        self.job = BackgroundJob(self.notice, lambda: "Opening was cancelled; the section is as it was.")
        self.summary, self.thumbnail, self._page = HTML(), HTML(), VBox()
        self.open_button = Button(
            description="Open section", icon="folder-open", layout=Layout(width="auto"), disabled=True
        )
        super().__init__([self.file, self._page, HBox([self.open_button, self.job]), self.notice])
        self.file.observe(self._take_path, "path")
        self.file.observe(lambda change: self.notice.alert(change.new), "error")
        self.header_bytes.observe(lambda change: self._preview(), "entered")
        self.job.observe(lambda change: self._update_button(), "busy")
        self.open_button.on_click(lambda _: self.load())

    def load(self) -> None:
        """Open the chosen file with the choices in the fields, in the background."""
        self.notice.hint("")
        self.notice.attempt(lambda: self.job.begin(partial(self._read, self.file.path, self._choices())))

    def wait(self, timeout: float | None = None) -> bool:
        """Wait until no preview or opening is in progress; False after the timeout in seconds."""
        return self.job.wait(timeout)

    def end(self) -> None:
        """Cancel the job in progress, and delete uploads."""
        self.job.drop()
        self.file.end()

    def _choices(self) -> dict[str, Any]:
        return self.fields.choices() | self._corrections() | self.calibrator.choices()

    def _corrections(self) -> dict[str, Any]:
        """Keywords that correct the file's headers; none if they are not shown."""
        return self.header_bytes.chosen() if self.header_bytes in self._page.children else {}

    def _take_path(self, change: Bunch) -> None:
        self._page.children = ()
        self.header_bytes.reset()
        self.calibrator.reset()
        self._preview()

    def _preview(self) -> None:
        """Preview the file in the background."""
        self.notice.hint("")
        self.job.drop()
        self._is_previewed = False
        self._update_button()
        if self.file.path:
            self.notice.attempt(
                lambda: self.job.begin(partial(self._read_preview, self.file.path, self._corrections()))
            )

    def _read_preview(self, path: str, corrections: dict[str, Any], report: Report) -> Callable[[], None]:
        try:
            info = preview(path, **corrections)
        except SeiswidgetsError as error:
            if kind_of(path) != "SEG-Y":
                raise
            return partial(self._show_problem, error)
        return partial(self._show_preview, info, thumbnail(info, corrections, report))

    def _show_problem(self, error: SeiswidgetsError) -> None:
        """Show why a SEG-Y file cannot be read as it is, and what may correct its headers."""
        self._page.children = [self.header_bytes]
        self.notice.alert(error.text)

    def _show_preview(self, info: SectionInfo, picture: str) -> None:
        self.summary.value, self.thumbnail.value = _summary(info), picture
        self.fields.show(info)
        self._page.children = [
            self.summary,
            self.thumbnail,
            *[self.header_bytes] * (info.kind == "SEG-Y"),
            *[self.calibrator] * (info.kind == "picture"),
            self.fields,
        ]
        self._is_previewed = True
        self._update_button()

    def _show_picture(self) -> None:
        """Read the picture in the background, and show it to be calibrated."""
        self.notice.hint("")
        self.notice.attempt(lambda: self.job.begin(partial(self._read_picture, self.file.path)))

    def _read_picture(self, path: str, report: Report) -> Callable[[], None]:
        pixels = open_section(path, dx=1, dz=1, x0=0, z0=0, z_unit="m", progress=report)
        return partial(self.calibrator.show, pixels)

    def _update_button(self) -> None:
        self.open_button.disabled = self.job.busy or not self._is_previewed

    def _read(self, path: str, choices: dict[str, Any], report: Report) -> Callable[[], None]:
        """Read a section, on the job's thread."""
        section = open_section(path, **choices, progress=report)
        source = None  # an upload is temporary
        if not self.file.is_uploaded:
            source = SectionSource(FILE, str(Path(path).expanduser().absolute()), choices)
        return partial(self._take, section, source)

    def _take(self, section: Section, source: SectionSource | None) -> None:
        """Show a section; ask first what to do with the picks, if there are any."""
        drawing = self._workspace.drawing
        keep, drop = (partial(self._show, section, picks, source) for picks in (drawing, Drawing()))
        if not drawing.picks:
            drop()
            return
        answers = {KEEP: keep} if self._workspace.picks_fit(section) else {}
        fate = "lie on the new section too" if answers else "do not lie on the new section, and cannot be kept"
        text = f"The {len(drawing.picks)} picks {fate}. Undo brings the present section and its picks back."
        self.notice.ask(text, {**answers, DROP: drop, CANCEL: lambda: None})

    def _show(self, section: Section, drawing: Drawing, source: SectionSource | None) -> None:
        samples, traces = section.shape
        self.notice.hint(f"Opened: {section.name}, {traces:,} traces of {samples:,} samples.")
        self.notice.attempt(partial(self._workspace.open, section, drawing, source=source))


def _summary(info: SectionInfo) -> str:
    """HTML summary of a file; all text from the file is escaped."""
    header = HEADER.format(escape(info.header)) if info.header else ""
    return f'<div style="line-height: 1.4">{escape("; ".join(info.facts))}.</div>{header}'
