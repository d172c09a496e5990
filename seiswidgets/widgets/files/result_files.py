"""Results of a restoration as files in a folder, from the app."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from pathlib import Path

from ipywidgets import Button, Checkbox, GridBox, HBox, Layout, Text, VBox

from seiswidgets import plot
from seiswidgets.errors import DataError, Keyword, SeiswidgetsError, SettingError
from seiswidgets.errors import Text as Message
from seiswidgets.geology.picks import Interpretation
from seiswidgets.geology.restoration import Restoration
from seiswidgets.io.exports.meshes import save_mesh
from seiswidgets.io.exports.reports import save_report
from seiswidgets.io.exports.sections import save_section
from seiswidgets.io.exports.xarrays import displacement
from seiswidgets.io.files import atomic_write, user_path
from seiswidgets.io.session.sources import SectionSource
from seiswidgets.widgets.files.background_job import BackgroundJob
from seiswidgets.widgets.files.file_names import file_name
from seiswidgets.widgets.files.line_map import of_segy
from seiswidgets.widgets.files.question import Question
from seiswidgets.widgets.workspace import Workspace

DPI = 300  # of a picture of dots: print quality
REPLACE, LEAVE = "Replace them", "Leave them"
STYLE = {"description_width": "60px"}


@dataclass(frozen=True, eq=False)
class Result:
    """What is exported, as it was when that was asked for; the user goes on meanwhile."""

    restoration: Restoration
    interpretation: Interpretation
    source: SectionSource | None


class ResultFiles(VBox):
    """Which results are written, into which folder, under which name.

    Parameters
    ----------
    workspace : Workspace

    Attributes
    ----------
    folder, stem : Text
        Where, and what their names begin with.
    kinds : dict of str to Checkbox
        By the endings of the files.
    written : tuple of Path
        By the last export.
    job : BackgroundJob
        The export that is under way.
    notice : Question
        What was written, or is wrong.
    """

    def __init__(self, workspace: Workspace):
        self._workspace, self.written, self.notice = workspace, (), Question()
        self.job = BackgroundJob(self.notice, lambda: f"The export was cancelled. {self._done()}")
        look = {"style": STYLE, "layout": {"width": "auto", "flex": "1 1 160px"}}
        self.folder = Text("results", description="folder", placeholder="a folder, as results", **look)
        self.stem = Text(description="name", placeholder="that of the section", **look)
        self.kinds = {
            ending: Checkbox(ending in WRITERS_AT_FIRST, description=words, indent=False, layout=Layout(width="auto"))
            for ending, (words, _) in WRITERS.items()
        }
        self._export = Button(description="Export results", icon="download", layout=Layout(width="auto"))
        self._export.on_click(lambda _: self.notice.attempt(self.export))
        self.job.observe(lambda change: setattr(self._export, "disabled", change.new), "busy")
        columns = Layout(grid_template_columns="repeat(auto-fit, minmax(180px, 1fr))")
        where = HBox([self.folder, self.stem], layout=Layout(flex_flow="row wrap"))
        kinds = GridBox(list(self.kinds.values()), layout=columns)
        super().__init__([where, kinds, HBox([self._export, self.job]), self.notice])

    def export(self, replace: bool = False) -> None:
        """Write what is chosen, in the background; ask before files are replaced.

        Raises
        ------
        SettingError
            If nothing has been restored, or nothing is chosen.
        DataError
            If the folder cannot be made.
        """
        chosen = [ending for ending, box in self.kinds.items() if box.value]
        if not self._workspace.restoration.stages or not chosen:
            raise SettingError(
                "choose what to export"
                if self._workspace.restoration.stages
                else "there is no result yet: restore first"
            )
        stem, folder = self._stem(), _made(self.folder.value.strip())
        paths = {ending: folder / f"{stem}-{ending}" for ending in chosen}
        there = [path.name for path in paths.values() if path.exists()]
        if there and not replace:
            again = partial(self.notice.attempt, partial(self.export, replace=True))
            self.notice.ask(f"There are already: {', '.join(there)}.", {REPLACE: again, LEAVE: lambda: None})
            return
        self.written = ()
        result = Result(self._workspace.restoration, self._workspace.interpretation, self._workspace.source)
        self.job.begin(partial(self._write, result, paths))

    def wait(self, timeout: float | None = None) -> bool:
        """Wait until nothing is being written; False if that took too long."""
        return self.job.wait(timeout)

    def end(self) -> None:
        """Write no more than the file that is under way."""
        self.job.drop()

    def _write(self, result, paths, tell):
        """Write file after file, each of them whole; one that cannot be written does not keep others from it."""
        trouble: list[str | Keyword] = []
        for count, (ending, path) in enumerate(paths.items()):
            if not tell(count / len(paths)):
                break
            self.notice.hint(f"Writing {path.name} ...")
            try:
                WRITERS[ending][1](result, path)
                self.written = (*self.written, path)
            except SeiswidgetsError as error:
                trouble += [error.text, ". "]
        if trouble:
            return partial(self.notice.alert, Message(*trouble, self._done()))
        return lambda: self.notice.hint(self._done())

    def _done(self):
        """What was written, in words."""
        if not self.written:
            return "Nothing was written."
        return f"Wrote into {self.written[0].parent.absolute()}: {', '.join(path.name for path in self.written)}."

    def _stem(self):
        """The name that was given, or the section's with nothing in it that no file's name may hold."""
        given = self.stem.value.strip()
        if given != Path(given).name or given in (".", ".."):
            raise SettingError(f"the name must be a name without folders, but is {given!r}; give those as the folder")
        return given or file_name(self._workspace.section.name, "section")


def _made(folder):
    """A folder, made if its parent is there."""
    if not folder:
        raise SettingError("give the folder that the files shall be written into")
    path = user_path(folder)
    try:
        path.mkdir(exist_ok=True)
    except (OSError, ValueError) as error:
        raise DataError(f"the folder {folder!r} cannot be made: {error}; choose another") from error
    return path


def _write_figure(result, path):
    """On a figure of its own: pyplot's are the user's, on another thread."""
    from matplotlib.figure import Figure  # slow to load: the app's first paint need not wait for it

    figure = plot.workflow(result.restoration, result.interpretation, figure=Figure())
    with atomic_write(path) as draft:
        figure.savefig(draft, dpi=DPI)


def _write_displacement(result, path):
    fields = displacement(result.restoration)
    with atomic_write(path) as draft:
        fields.to_netcdf(draft)


def _write_segy(result, path):
    """With the headers of the file that the section came from, if that is SEG-Y."""
    line = of_segy(result.source)
    like = {} if line is None else {"like": result.source.name, "x0": result.restoration.original.x0, **line}
    save_section(result.restoration, path, **like)


def _of_restoration(save: Callable) -> Callable:
    return lambda result, path: save(result.restoration, path)


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
