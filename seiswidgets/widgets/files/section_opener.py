"""Opening a section in the app: what a file holds, what it does not say, and the opening itself."""

from functools import partial
from html import escape
from pathlib import Path

from ipywidgets import HTML, Button, HBox, Layout, VBox

from seiswidgets.interaction.drawing import Drawing
from seiswidgets.io.info import SectionInfo
from seiswidgets.io.opening import open_section, preview
from seiswidgets.io.session.sources import FILE, SectionSource
from seiswidgets.widgets.files.background_job import BackgroundJob
from seiswidgets.widgets.files.file_field import FileField
from seiswidgets.widgets.files.header_bytes import HeaderBytes
from seiswidgets.widgets.files.question import Question
from seiswidgets.widgets.files.section_fields import SectionFields
from seiswidgets.widgets.files.thumbnail import thumbnail
from seiswidgets.widgets.workspace import Workspace

KINDS = ".sgy,.segy,.seg,.png,.jpg,.jpeg,.tif,.tiff,.npy,.npz,.txt,.csv,.asc,.tsv"
HEADER = (
    "<details><summary>textual header</summary>"
    '<pre tabindex="0" style="line-height: 1.2; overflow: auto; max-height: 240px">{}</pre></details>'
)
KEEP, DROP, BACK = "Keep the picks", "Drop the picks", "Do not open"


class SectionOpener(VBox):
    """A file is chosen, previewed, and opened, both on a thread; the app then shows its section.

    Parameters
    ----------
    workspace : Workspace

    Attributes
    ----------
    file : FileField
    header_bytes : HeaderBytes
        Of SEG-Y.
    fields : SectionFields
    job : BackgroundJob
        The preview or the opening that is under way.
    notice : Question
        What is wrong, or asked.
    """

    def __init__(self, workspace: Workspace):
        self._workspace, self._is_known = workspace, False
        self.file = FileField("section: path of a SEG-Y, picture, NumPy or text file", KINDS)
        self.header_bytes, self.fields, self.notice = HeaderBytes(), SectionFields(), Question()
        self.job = BackgroundJob(self.notice, lambda: "Opening was cancelled; the section is as it was.")
        self._preview, self._thumbnail, self._page = HTML(), HTML(), VBox()
        self._open = Button(description="Open section", icon="folder-open", layout=Layout(width="auto"), disabled=True)
        super().__init__([self.file, self._page, HBox([self._open, self.job]), self.notice])
        self.file.observe(self._take_path, "path")
        self.file.observe(lambda change: self.notice.alert(change.new), "error")
        self.header_bytes.observe(self._look, "said")
        self.job.observe(self._take_busy, "busy")
        self._open.on_click(lambda _: self.load())

    def load(self) -> None:
        """Open the chosen file, as the fields say, in the background."""
        self.notice.hint("")
        self.notice.attempt(lambda: self.job.begin(partial(self._read, self.file.path, self._choices())))

    def wait(self, timeout: float | None = None) -> bool:
        """Wait until nothing is being looked at or opened; False if that took too long."""
        return self.job.wait(timeout)

    def end(self) -> None:
        """Give up what is under way, and delete what was uploaded."""
        self.job.drop()
        self.file.end()

    def _choices(self):
        choices, header_bytes = self.fields.choices(), self._header_bytes()
        return choices | ({"header_bytes": header_bytes} if header_bytes else {})

    def _header_bytes(self):
        """Those that were chosen, None if they are not shown."""
        return self.header_bytes.chosen() if self.header_bytes in self._page.children else None

    def _take_path(self, change):
        self._page.children = ()
        self.header_bytes.rest()
        self._look()

    def _look(self, change=None):
        """Show what the file holds, once that is known."""
        self.notice.hint("")
        self.job.drop()
        self._is_known = False
        self._take_busy()
        if self.file.path:
            self.notice.attempt(lambda: self.job.begin(partial(self._preview_of, self.file.path, self._header_bytes())))

    def _preview_of(self, path, header_bytes, tell):
        info = preview(path, header_bytes=header_bytes)
        return partial(self._show_preview, info, thumbnail(info, header_bytes, tell))

    def _show_preview(self, info, picture):
        self._preview.value, self._thumbnail.value = _described(info), picture
        self.fields.show(info)
        self._page.children = [
            self._preview,
            self._thumbnail,
            *[self.header_bytes] * (info.kind == "SEG-Y"),
            self.fields,
        ]
        self._is_known = True
        self._take_busy()

    def _take_busy(self, change=None):
        self._open.disabled = self.job.busy or not self._is_known

    def _read(self, path, choices, tell):
        """Read a section, on the job's thread."""
        section = open_section(path, **choices, progress=tell)
        stays = not self.file.is_uploaded
        source = SectionSource(FILE, str(Path(path).expanduser().absolute()), choices) if stays else None
        return partial(self._take, section, source)

    def _take(self, section, source):
        """Show a section, once it is agreed what becomes of the picks."""
        drawn = self._workspace.drawing
        keep, drop = (partial(self._show, section, picks, source) for picks in (drawn, Drawing()))
        if not drawn.picks:
            drop()
            return
        answers = {KEEP: keep} if self._workspace.picks_fit(section) else {}
        fate = "lie on the new section too" if answers else "do not lie on the new section, and cannot be kept"
        text = f"The {len(drawn.picks)} picks {fate}. Undo brings the present section and its picks back."
        self.notice.ask(text, {**answers, DROP: drop, BACK: lambda: None})

    def _show(self, section, drawing, source):
        samples, traces = section.shape
        self.notice.hint(f"Opened: {section.name}, {traces:,} traces of {samples:,} samples.")
        self.notice.attempt(partial(self._workspace.open, section, drawing, source=source))


def _described(info: SectionInfo) -> str:
    """What a file holds, as HTML; all that comes from the file is escaped."""
    samples, traces = info.shape
    parts = [f"{info.kind} ({info.format}), {_size(info.size)}", f"{traces:,} traces of {samples:,} samples"]
    for name, lines in (("inlines", info.inlines), ("crosslines", info.crosslines)):
        parts += [f"{lines[2]:,} {name}, {lines[0]} to {lines[1]}"] if lines else []
    where = " along the first line" if info.inlines else ""
    parts += [f"traces {info.dx:g} {info.x_unit} apart{where}"] if info.dx is not None else []
    parts += [f"samples {info.dz:g} ms (or m) apart"] if info.dz is not None else []
    header = HEADER.format(escape(info.header)) if info.header else ""
    return f'<div style="line-height: 1.4">{escape("; ".join(parts))}.</div>{header}'


def _size(size):
    return f"{size / 2**20:.1f} MiB" if size >= 2**20 else f"{size / 2**10:.1f} KiB"
