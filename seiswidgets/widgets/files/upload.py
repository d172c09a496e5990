"""Files from the user's computer, piece by piece into a folder of their own."""

from pathlib import Path
from tempfile import TemporaryDirectory

import anywidget
from traitlets import Instance, Unicode

from seiswidgets.widgets.assets import asset
from seiswidgets.widgets.files.file_names import file_name

MOST = 4 * 2**30  # bytes
PART = ".part"  # what a file is called until it came whole: no other file can be called so


class Upload(anywidget.AnyWidget):
    """A button that sends a file of any size, and says how far it is; pressed again, it gives up.

    Parameters
    ----------
    accept : str
        Suffixes that the browser offers, between commas; all if left out.

    Attributes
    ----------
    path : Path or None
        Of the newest file that came whole. It lies in a folder of its own until `end`.
    error : str
        Why a file was not taken.
    """

    _esm = asset("upload.js")

    accept = Unicode().tag(sync=True)
    path = Instance(Path, allow_none=True)
    error = Unicode()

    def __init__(self, accept: str = ""):
        self._folder = self._file = self._id = None
        super().__init__(accept=accept)
        self.on_msg(self._take)

    def end(self) -> None:
        """Give up what is under way, and delete what came."""
        self._give_up()
        if self._folder is not None:
            self._folder.cleanup()
            self._folder = None

    def _take(self, _widget, content, buffers):
        """A message of the button: each is answered by where the next piece begins, None if there is none."""
        kind, sender = content["kind"], content["id"]
        try:
            if kind == "begin" and sender != self._id:
                self._begin(sender, str(content["name"]), int(content["size"]))
            elif kind == "piece" and sender == self._id:
                self._write(content["start"], buffers[0])
            elif kind == "stop" and sender == self._id:
                self._stop(content["reason"])
        except OSError as error:
            self._stop(f"it cannot be stored: {error.strerror or error}; make room")
        self.send({"id": sender, "next": self._file.tell() if self._file and sender == self._id else None})

    def _begin(self, sender, name, size):
        """Make room for a file."""
        self._give_up()
        self._id, self._name, self._size, self.error = sender, name, size, ""
        if size > MOST:
            self._stop(f"it has {size:,} bytes; there may be {MOST:,}: put it on the server's disk, and give its path")
            return
        if self._folder is None:
            self._folder = TemporaryDirectory(prefix="seiswidgets-")
        self._file = (Path(self._folder.name) / PART).open("wb", buffering=0)  # or its end could fail when it is closed
        self._end_if_whole()

    def _write(self, start, piece):
        if self._file and start == self._file.tell():  # else it was sent again, though it had come
            self._file.write(piece)
            self._end_if_whole()

    def _end_if_whole(self):
        """Give a file that came whole its name, which is a stranger's, and keeps only what is harmless."""
        if self._file.tell() >= self._size:
            self._file.close()
            path = Path(self._file.name).replace(Path(self._folder.name) / file_name(self._name, "file"))
            self._file = self.path = None  # that it is another file is news, even where it has the same path
            self.path = path

    def _stop(self, reason):
        self._give_up()
        self.error = f"{self._name!r} was not uploaded" + (f": {reason}" if reason else "")

    def _give_up(self):
        """Leave nothing of a file that is under way."""
        if self._file:
            self._file.close()
            Path(self._file.name).unlink(missing_ok=True)
            self._file = None
