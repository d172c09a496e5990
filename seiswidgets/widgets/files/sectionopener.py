"""Opening a section in the app: what a file holds, what it does not say, and the opening itself."""

from functools import partial
from html import escape
from pathlib import Path

from ipywidgets import HTML, Button, FloatProgress, HBox, Layout, VBox

from seiswidgets.errors import Cancelled, SeiswidgetsError
from seiswidgets.io.info import SectionInfo
from seiswidgets.io.opening import open_section, preview
from seiswidgets.io.sources import FILE, SectionSource
from seiswidgets.widgets.files.filefield import FileField
from seiswidgets.widgets.files.question import Question
from seiswidgets.widgets.files.sectionfields import SectionFields
from seiswidgets.widgets.messages import in_words
from seiswidgets.widgets.picking.drawing import Drawing
from seiswidgets.widgets.restoring.worker import Worker

KINDS = ".sgy,.segy,.seg,.png,.jpg,.jpeg,.tif,.tiff,.npy,.npz,.txt,.csv,.asc,.tsv"
HEADER = (
    "<details><summary>textual header</summary>"
    '<pre style="line-height: 1.2; overflow: auto; max-height: 240px">{}</pre></details>'
)
KEEP, DROP, BACK = "Keep the picks", "Drop the picks", "Do not open"


class SectionOpener(VBox):
    """A file is chosen, previewed, and opened on a thread; the app then shows its section.

    Parameters
    ----------
    app : RestorationApp

    Attributes
    ----------
    file : FileField
    fields : SectionFields
    notice : Question
        What is wrong, or asked.
    """

    def __init__(self, app):
        self._app, self._worker = app, Worker()
        self.file = FileField("section: path of a SEG-Y, picture, NumPy or text file", KINDS)
        self.fields, self.notice = SectionFields(), Question()
        self._preview = HTML()
        self._bar = FloatProgress(min=0, max=1, layout=Layout(width="160px"))
        self._open = Button(description="Open section", icon="folder-open", layout=Layout(width="auto"), disabled=True)
        self._cancel = Button(description="Cancel", icon="stop", layout=Layout(width="auto"))
        self._progress = HBox([self._bar, self._cancel], layout=Layout(display="none"))
        super().__init__([self.file, self._preview, self.fields, HBox([self._open, self._progress]), self.notice])
        self.file.observe(self._look, "path")
        self.file.observe(lambda change: self.notice.alert(change.new), "error")
        self._open.on_click(lambda _: self.load())
        self._cancel.on_click(lambda _: self.cancel())

    def load(self) -> None:
        """Open the chosen file, as the fields say, in the background."""
        try:
            choices = self.fields.choices()
        except SeiswidgetsError as error:
            self.notice.alert(str(error))
            return
        self.notice.hint("")
        self._bar.value, self._progress.layout.display, self._open.disabled = 0, "", True
        self._worker.ask(partial(self._read, self.file.path, choices))

    def cancel(self) -> None:
        """Give up the opening that is under way."""
        self._worker.cancel()
        self._rest("Opening was cancelled; the section is as it was.")

    def wait(self, timeout: float | None = None) -> bool:
        """Wait until nothing is being opened; False if that took too long."""
        return self._worker.wait(timeout)

    def end(self) -> None:
        """Give up what is under way, and delete what was uploaded."""
        self._worker.cancel()
        self.file.end()

    def _look(self, change):
        """Show what the file holds."""
        self._worker.cancel()
        self.fields.children, self._preview.value = (), ""
        self._rest("")
        if not change.new:
            return
        try:
            info = preview(change.new)
        except SeiswidgetsError as error:
            self.notice.alert(str(error))
            return
        self._preview.value = _described(info)
        self.fields.show(info)
        self._open.disabled = False

    def _read(self, path, choices, wanted):
        """Read a section, on the worker's thread."""
        try:
            section = open_section(path, **choices, progress=partial(self._tell, wanted))
        except Cancelled:
            return
        except Exception as error:  # noqa: BLE001 - nobody else would hear of it on this thread
            self._end(wanted, self.notice.alert, in_words(error))
            return
        stays = not self.file.is_uploaded
        source = SectionSource(FILE, str(Path(path).expanduser().absolute()), choices) if stays else None
        self._end(wanted, self._take, section, source)

    def _tell(self, wanted, share):
        if wanted():
            self._bar.value = share
        return wanted()

    def _end(self, wanted, action, *arguments):
        if wanted():
            self._rest("")
            action(*arguments)

    def _rest(self, text):
        self._progress.layout.display, self._open.disabled = "none", not self._preview.value
        self.notice.hint(text)

    def _take(self, section, source):
        """Show a section, once it is agreed what becomes of the picks."""
        drawn = self._app.picker.drawing
        keep, drop = partial(self._show, section, drawn, source), partial(self._show, section, Drawing(), source)
        if not drawn.picks:
            drop()
            return
        answers = {KEEP: keep} if self._app.picks_fit(section) else {}
        fate = "lie on the new section too" if answers else "do not lie on the new section, and cannot be kept"
        text = f"The {len(drawn.picks)} picks {fate}. Dropped ones cannot be brought back by undo: export them first."
        self.notice.ask(text, {**answers, DROP: drop, BACK: lambda: None})

    def _show(self, section, drawing, source):
        try:
            self._app.begin(section, drawing, source=source)
        except SeiswidgetsError as error:
            self.notice.alert(str(error))
            return
        samples, traces = section.shape
        self.notice.hint(f"Opened: {section.name}, {traces} traces of {samples} samples.")


def _described(info: SectionInfo) -> str:
    """What a file holds, as HTML; all that comes from the file is escaped."""
    samples, traces = info.shape
    parts = [f"{info.kind} ({info.format}), {_size(info.size)}", f"{traces} traces of {samples} samples"]
    for name, lines in (("inlines", info.inlines), ("crosslines", info.crosslines)):
        parts += [f"{name} {lines[0]} to {lines[1]} ({lines[2]})"] if lines else []
    for name, value, unit in (("traces", info.dx, info.x_unit), ("samples", info.dz, "ms or m")):
        parts += [f"{name} {value:g} {unit} apart"] if value is not None else []
    header = HEADER.format(escape(info.header)) if info.header else ""
    return f'<div style="line-height: 1.4">{escape("; ".join(parts))}.</div>{header}'


def _size(size):
    return f"{size / 2**20:.1f} MiB" if size >= 2**20 else f"{size / 2**10:.1f} KiB"
