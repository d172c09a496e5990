"""Choice of a file to read: a path on the server, or an upload."""

import os
from html import escape
from itertools import islice

from ipywidgets import HTML, Combobox, HBox, Layout, VBox
from traitlets import Bunch, Unicode

from seiswidgets.widgets.files.upload import Upload
from seiswidgets.widgets.messages import HINT

MOST_LISTED = 500  # entries of a folder


class FileField(VBox):
    """A text field for a path, which offers the files of the folder typed so far, and a button to upload a file.

    Parameters
    ----------
    placeholder : str
        Description of the path in the empty field.
    accept : str
        Suffixes of the files to offer, separated by commas; all files if left out.

    Attributes
    ----------
    path : str
        Path of the file; "" if there is none. An upload stays in a temporary folder until `end`.
    error : str
        Why an upload failed.
    text, upload : Combobox, Upload
        Controls.
    status : HTML
        Name of the uploaded file.
    """

    path = Unicode()
    error = Unicode()

    def __init__(self, placeholder: str, accept: str = ""):
        layout = Layout(flex="1", width="auto")
        self.text = Combobox(placeholder=placeholder, continuous_update=False, layout=layout)
        self.upload, self.status = Upload(accept), HTML(layout=Layout(display="none"))
        super().__init__([HBox([self.text, self.upload]), self.status])
        self.text.observe(self._take_text, "value")
        self.upload.observe(self._take_upload, "path")
        self.upload.observe(lambda change: self.set_trait("error", change.new), "error")
        self._offer("")

    @property
    def is_uploaded(self) -> bool:
        """True if the file is an upload, which is temporary."""
        return self.upload.path is not None and self.path == str(self.upload.path)

    def end(self) -> None:
        """Delete the upload."""
        self.upload.end()

    def _take_text(self, change: Bunch) -> None:
        if change.new or not self.is_uploaded:
            self._show_status("")
            self._offer(change.new.strip())
            self.path = change.new.strip()

    def _take_upload(self, change: Bunch) -> None:
        self.path = ""  # so that a file uploaded again under the same name is a change
        if change.new is not None:
            self.path, self.text.value = str(change.new), ""
            self._show_status(f"Uploaded: {change.new.name}")

    def _show_status(self, text: str) -> None:
        self.status.value, self.status.layout.display = HINT.format(escape(text)), "" if text else "none"

    def _offer(self, typed: str) -> None:
        """Offer the files in the folder that was typed, or in the folder of the file that was typed."""
        folder = typed if os.path.isdir(os.path.expanduser(typed)) else os.path.dirname(typed)
        names = _file_names(os.path.expanduser(folder) or ".", tuple(self.upload.accept.split(",")))
        self.text.options = [os.path.join(folder, name) for name in names]


def _file_names(folder: str, suffixes: tuple[str, ...]) -> list[str]:
    """Names of the subfolders of a folder and of its files with one of the suffixes; empty if it cannot be read."""
    try:
        with os.scandir(folder) as entries:
            visible = [entry for entry in islice(entries, MOST_LISTED) if not entry.name.startswith(".")]
            names = [entry.name + os.sep * entry.is_dir() for entry in visible]
    except (OSError, ValueError):
        return []
    return sorted(name for name in names if name.endswith(os.sep) or name.lower().endswith(suffixes))
