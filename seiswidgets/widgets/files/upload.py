"""Upload of files from the user's computer, piece by piece, into a temporary folder."""

import re
from io import FileIO
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import anywidget
from ipywidgets import Widget
from traitlets import Instance, Unicode

from seiswidgets.widgets.section_view.pointer_layer import joined

MOST = 4 * 2**30  # bytes
PART = ".part"  # name of an incomplete file; safe_name never returns it
LONGEST = 80  # characters of a file name


class Upload(anywidget.AnyWidget):
    """A button that uploads a file of any size and shows the progress; pressed again, it cancels the upload.

    Parameters
    ----------
    accept : str
        Suffixes that the browser offers, separated by commas; all files if left out.

    Attributes
    ----------
    path : Path or None
        Path of the newest complete file, in a temporary folder that exists until `end`.
    error : str
        Why an upload failed.
    """

    _esm = joined(Path(__file__).with_name("upload.js"))

    accept = Unicode().tag(sync=True)
    path = Instance(Path, allow_none=True)
    error = Unicode()

    def __init__(self, accept: str = ""):
        self._folder: TemporaryDirectory | None = None
        self._file: FileIO | None = None
        self._id, self._name, self._size = None, "", 0
        super().__init__(accept=accept)
        self.on_msg(self._take)

    def end(self) -> None:
        """Cancel the upload in progress, and delete all uploads."""
        self._discard()
        if self._folder is not None:
            self._folder.cleanup()
            self._folder = None

    def _take(self, _widget: Widget, content: dict[str, Any], buffers: list[memoryview]) -> None:
        """Handle a message of the button; the answer is the offset of the next piece, None if there is none."""
        kind, sender = content["kind"], content["id"]
        try:
            if kind == "begin" and sender != self._id:
                self._begin(sender, str(content["name"]), int(content["size"]))
            elif kind == "piece" and sender == self._id:
                self._write(content["start"], buffers[0])
            elif kind == "stop" and sender == self._id:
                self._stop(content["reason"])
        except OSError as error:
            self._stop(f"it cannot be stored: {error.strerror or error}; free some space")
        self.send({"id": sender, "next": self._file.tell() if self._file and sender == self._id else None})

    def _begin(self, sender: Any, name: str, size: int) -> None:
        self._discard()
        self._id, self._name, self._size, self.error = sender, name, size, ""
        if size > MOST:
            self._stop(f"it has {size:,} bytes, more than {MOST:,}; copy it to the server's disk, and give its path")
            return
        if self._folder is None:
            self._folder = TemporaryDirectory(prefix="seiswidgets-")
        path = Path(self._folder.name) / PART
        self._file = path.open("wb", buffering=0)  # a buffer could fail to be written on closing
        self._end_if_complete()

    def _write(self, start: int, piece: memoryview) -> None:
        if self._file and start == self._file.tell():  # else the piece was sent twice
            self._file.write(piece)
            self._end_if_complete()

    def _end_if_complete(self) -> None:
        """Rename a complete file to a harmless form of its own name."""
        if self._file and self._folder and self._file.tell() >= self._size:
            self._file.close()
            path = Path(self._folder.name)
            path = (path / PART).replace(path / safe_name(self._name, "file"))
            self._file = self.path = None  # so that a second file of the same path is a change
            self.path = path

    def _stop(self, reason: str) -> None:
        self._discard()
        self.error = f"{self._name!r} was not uploaded" + (f": {reason}" if reason else "")

    def _discard(self) -> None:
        """Delete an incomplete file."""
        if self._file and self._folder:
            self._file.close()
            (Path(self._folder.name) / PART).unlink(missing_ok=True)
            self._file = None


def safe_name(name: str, default: str) -> str:
    """Harmless file name: the last part of a path, without special characters; the default if nothing is left."""
    last = re.split(r"[/\\]", name)[-1]
    return re.sub(r"[^\w .()+-]", "_", last)[-LONGEST:].strip(" .") or default
