"""The file that something is read from: its path, or an upload."""

import os
from html import escape
from itertools import islice

from ipywidgets import HTML, Combobox, HBox, Layout, VBox
from traitlets import Unicode

from seiswidgets.widgets.files.upload import Upload
from seiswidgets.widgets.messages import HINT

MOST_LISTED = 500  # entries of a folder that are looked at


class FileField(VBox):
    """A path to be typed, or chosen of those in a folder that was typed, with a button to upload a file instead.

    Parameters
    ----------
    placeholder : str
        What kind of path is asked for.
    accept : str
        Suffixes of the files that are offered, between commas; all if left out.

    Attributes
    ----------
    path : str
        Of the file; "" as long as there is none. Uploads lie in a folder of their own until `end`.
    error : str
        Why an upload was not taken.
    """

    path = Unicode()
    error = Unicode()

    def __init__(self, placeholder: str, accept: str = ""):
        layout = Layout(flex="1", width="auto")
        self.text = Combobox(placeholder=placeholder, continuous_update=False, layout=layout)
        self.upload, self._sent = Upload(accept), HTML(layout=Layout(display="none"))
        super().__init__([HBox([self.text, self.upload]), self._sent])
        self.text.observe(self._take_text, "value")
        self.upload.observe(self._take_upload, "path")
        self.upload.observe(lambda change: self.set_trait("error", change.new), "error")
        self._offer("")

    @property
    def is_uploaded(self) -> bool:
        """Whether the file is an upload, which does not stay."""
        return self.upload.path is not None and self.path == str(self.upload.path)

    def end(self) -> None:
        """Delete what was uploaded."""
        self.upload.end()

    def _take_text(self, change):
        if change.new or not self.is_uploaded:
            self._say("")
            self._offer(change.new.strip())
            self.path = change.new.strip()

    def _take_upload(self, change):
        self.path = ""  # a file that was sent again may hold something else
        if change.new is not None:
            self.path, self.text.value = str(change.new), ""
            self._say(f"Uploaded: {change.new.name}")

    def _say(self, text):
        self._sent.value, self._sent.layout.display = HINT.format(escape(text)), "" if text else "none"

    def _offer(self, typed):
        """Offer what there is in the folder that was typed, or that the file is in."""
        folder = typed if os.path.isdir(os.path.expanduser(typed)) else os.path.dirname(typed)
        names = _names(os.path.expanduser(folder) or ".", tuple(self.upload.accept.split(",")))
        self.text.options = [os.path.join(folder, name) for name in names]


def _names(folder, suffixes):
    """Of the folders in a folder, and of its files with one of the suffixes; nothing of one that cannot be read."""
    try:
        with os.scandir(folder) as entries:
            kept = [entry for entry in islice(entries, MOST_LISTED) if not entry.name.startswith(".")]
            named = [entry.name + os.sep * entry.is_dir() for entry in kept]
    except (OSError, ValueError):
        return []
    return sorted(name for name in named if name.endswith(os.sep) or name.lower().endswith(suffixes))
