"""Results of a restoration as files in a folder, from the app."""

from collections.abc import Callable
from pathlib import Path

from ipywidgets import Button, Checkbox, GridBox, HBox, Layout, Text, VBox

from seiswidgets import plot
from seiswidgets.errors import DataError, SeiswidgetsError, SettingError
from seiswidgets.io.choices import OF_SEGY
from seiswidgets.io.meshes import save_mesh
from seiswidgets.io.reports import save_report
from seiswidgets.io.results import save_section
from seiswidgets.io.sources import FILE
from seiswidgets.io.writing import written
from seiswidgets.io.xarrays import displacement
from seiswidgets.widgets.files.filenames import file_name
from seiswidgets.widgets.files.question import Question

DPI = 300  # of a picture of dots: print quality
STYLE = {"description_width": "60px"}


class ResultFiles(VBox):
    """Which results are written, into which folder, under which name.

    Parameters
    ----------
    app : RestorationApp

    Attributes
    ----------
    folder, stem : Text
        Where, and what their names begin with.
    kinds : dict of str to Checkbox
        By the endings of the files.
    replace : Checkbox
        Whether files that are there may be replaced.
    written : tuple of Path
        By the last export.
    notice : Question
        What was written, or is wrong.
    """

    def __init__(self, app):
        self._app, self.written, self.notice = app, (), Question()
        self.folder = Text(description="folder", placeholder="of your own, as results", style=STYLE)
        self.stem = Text(description="name", placeholder="of the section", style=STYLE)
        self.kinds = {
            ending: Checkbox(ending in WRITERS_AT_FIRST, description=words, indent=False, layout=Layout(width="auto"))
            for ending, (words, _) in WRITERS.items()
        }
        self.replace = Checkbox(description="replace files of the same names", indent=False)
        export = Button(description="Export results", icon="download")
        export.layout = Layout(width="auto", align_self="flex-start")
        export.on_click(lambda _: self._said())
        columns = Layout(grid_template_columns="repeat(auto-fit, minmax(180px, 1fr))")
        for field in (self.folder, self.stem):
            field.layout = Layout(width="auto", flex="1 1 160px")
        where = HBox([self.folder, self.stem], layout=Layout(flex_flow="row wrap"))
        super().__init__([where, GridBox(list(self.kinds.values()), layout=columns), self.replace, export, self.notice])

    def export(self) -> None:
        """Write what is chosen; those written are in ``written`` even if a later one fails.

        Raises
        ------
        SettingError
            If nothing has been restored, or nothing is chosen.
        DataError
            If a file is there already, or cannot be written.
        """
        self.written = ()
        restoration = self._app.restoration
        chosen = [ending for ending, box in self.kinds.items() if box.value]
        if not restoration.stages or not chosen:
            raise SettingError(
                "choose what to export" if restoration.stages else "there is no result yet: restore the section first"
            )
        folder = _made(self.folder.value.strip())
        paths = {ending: folder / f"{self._stem()}-{ending}" for ending in chosen}
        there = [str(path) for path in paths.values() if path.exists()]
        if there and not self.replace.value:
            raise DataError(f"{', '.join(there)} exist already; choose another name, or allow them to be replaced")
        for ending, path in paths.items():
            WRITERS[ending][1](self._app, path)
            self.written = (*self.written, path)

    def _stem(self):
        """The name that was given, or the section's with nothing in it that no file's name may hold."""
        given = self.stem.value.strip()
        if given != Path(given).name or given in (".", ".."):
            raise SettingError(f"the name must be a name without folders, but is {given!r}; give those as the folder")
        return given or file_name(self._app.section.name, "section")

    def _said(self):
        self.notice.hint("Writing ...")
        trouble = ""
        try:
            self.export()
        except SeiswidgetsError as error:
            trouble = str(error)
        done = f"Wrote {', '.join(map(str, self.written))}." if self.written else ""
        (self.notice.alert if trouble else self.notice.hint)(f"{trouble} {done}".strip())


def _made(folder):
    """A folder, made if its parent is there."""
    if not folder:
        raise SettingError("give the folder that the files shall be written into")
    path = Path(folder).expanduser()
    try:
        path.mkdir(exist_ok=True)
    except (OSError, ValueError) as error:
        raise DataError(f"the folder {folder!r} cannot be made: {error}; choose another") from error
    return path


def _write_figure(app, path):
    from matplotlib import pyplot as plt  # slow to load: the app's first paint need not wait for it

    figure = plot.workflow(app.restoration, app.interpretation)
    try:
        with written(path) as draft:
            figure.savefig(draft, dpi=DPI)
    finally:
        plt.close(figure)


def _write_displacement(app, path):
    fields = displacement(app.restoration)
    with written(path) as draft:
        fields.to_netcdf(draft)


def _write_segy(app, path):
    """With the headers of the file that the section came from, if that is SEG-Y."""
    source, line = app.source, {}
    if source is not None and source.kind == FILE and Path(source.name).suffix.lower() in (".sgy", ".segy", ".seg"):
        line = {name: value for name, value in source.keywords.items() if name in OF_SEGY}
        line |= {"like": source.name, "x0": app.section.x0}
    save_section(app.restoration, path, **line)


def _of_restoration(save: Callable) -> Callable:
    return lambda app, path: save(app.restoration, path)


WRITERS = {
    "restored.npz": ("section, NumPy (.npz)", _of_restoration(save_section)),
    "restored.sgy": ("section, SEG-Y (.sgy)", _write_segy),
    "figure.png": ("figure (.png, 300 dpi)", _write_figure),
    "figure.svg": ("figure (.svg)", _write_figure),
    "mesh.vtu": ("mesh for ParaView (.vtu)", _of_restoration(save_mesh)),
    "report.json": ("report (.json)", _of_restoration(save_report)),
    "report.html": ("report (.html)", _of_restoration(save_report)),
    "displacement.nc": ("displacement (.nc)", _write_displacement),
}
WRITERS_AT_FIRST = ("restored.npz", "figure.png", "report.html")
