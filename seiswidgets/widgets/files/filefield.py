"""The file that something is read from: its path, or an upload."""

from pathlib import Path
from tempfile import TemporaryDirectory

from ipywidgets import FileUpload, HBox, Layout, Text
from traitlets import Unicode

from seiswidgets.errors import DataError
from seiswidgets.widgets.files.filenames import file_name

MOST_UPLOADED = 100 * 2**20  # bytes
TIP = (
    "send a file from your computer; most servers take up to 10 MB at once: put a larger one into their folder, and "
    "give its path"
)


class FileField(HBox):
    """A path to be typed, with a button to upload a file instead.

    Parameters
    ----------
    placeholder : str
        What kind of path is asked for.
    accept : str
        Suffixes that the browser offers for uploads, between commas.

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
        self._folder = None
        self.text = Text(placeholder=placeholder, continuous_update=False, layout=Layout(flex="1", width="auto"))
        self.upload = FileUpload(accept=accept, multiple=False, tooltip=TIP, layout=Layout(width="auto"))
        super().__init__([self.text, self.upload])
        self.text.observe(lambda change: self.set_trait("path", change.new.strip()), "value")
        self.upload.observe(self._take_upload, "value")

    @property
    def is_uploaded(self) -> bool:
        """Whether the file is an upload, which does not stay."""
        return self._folder is not None and Path(self.path).parent == Path(self._folder.name)

    def end(self) -> None:
        """Delete what was uploaded."""
        if self._folder is not None:
            self._folder.cleanup()
            self._folder = None

    def _take_upload(self, change):
        if not change.new:
            return
        (file,) = change.new
        self.upload.value = ()  # or its content would be kept, and the same file could not come again
        try:
            path = self._stored(file)
        except DataError as error:
            self.error = str(error)
            return
        self.error, self.text.value = "", ""
        self.path = str(path)

    def _stored(self, file):
        """The path of an upload's content; its name is a stranger's, and keeps only what is harmless."""
        name, content = str(file["name"]), file["content"]
        if len(content) > MOST_UPLOADED or len(content) != file["size"]:
            raise DataError(
                f"{name!r} has {len(content):,} of {file['size']:,} bytes; there may be {MOST_UPLOADED:,}: put it into "
                "the server's folder, and give its path"
            )
        if self._folder is None:
            self._folder = TemporaryDirectory(prefix="seiswidgets-")
        path = Path(self._folder.name) / file_name(name, "file")
        try:
            path.write_bytes(content)
        except OSError as error:
            raise DataError(f"{name!r} cannot be stored: {error.strerror or error}; make room") from error
        return path
