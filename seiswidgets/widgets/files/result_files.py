"""Export of a restoration's results to files, in the app."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

from ipywidgets import Button, Checkbox, GridBox, HBox, Layout, Text, VBox
from traitlets import Float

from seiswidgets import plot
from seiswidgets.core.deformation import USUAL_SPAN
from seiswidgets.errors import Keyword, SeiswidgetsError, SettingError
from seiswidgets.errors import Text as Message
from seiswidgets.geology.balance import balance
from seiswidgets.geology.fault_history import fault_growth, fault_throws
from seiswidgets.geology.histories import extension_history
from seiswidgets.geology.pick_colours import PickColours
from seiswidgets.geology.picks import Interpretation
from seiswidgets.geology.restoration import Restoration
from seiswidgets.geology.stratigraphy import Stratigraphy
from seiswidgets.geology.tables import Table
from seiswidgets.io.exports.meshes import save_mesh
from seiswidgets.io.exports.reports import save_report
from seiswidgets.io.exports.sections import save_section
from seiswidgets.io.exports.tables import save_table
from seiswidgets.io.exports.xarrays import displacement
from seiswidgets.io.files import atomic_write, make_folder, user_path
from seiswidgets.io.session.sources import SectionSource
from seiswidgets.widgets.files.background_job import BackgroundJob, Report
from seiswidgets.widgets.files.line_map import segy_keywords
from seiswidgets.widgets.files.question import Question
from seiswidgets.widgets.files.upload import safe_name
from seiswidgets.widgets.workspace import Workspace

DPI = 300  # of raster figures: print quality
REPLACE, LEAVE = "Replace them", "Leave them"
STYLE = {"description_width": "60px"}


@dataclass(frozen=True, eq=False)
class Result:
    """The results to export, unaffected by what the user does during the export."""

    restoration: Restoration
    interpretation: Interpretation
    source: SectionSource | None
    colours: PickColours
    span: float
    stratigraphy: Stratigraphy | None = None


Writer = Callable[[Result, Path], None]


class ResultFiles(VBox):
    """Choice of the results to export, the folder and the name.

    Parameters
    ----------
    workspace : Workspace

    Attributes
    ----------
    folder, stem : Text
        Folder of the files, and beginning of their names.
    kinds : dict of str to Checkbox
        Results to export, by the ends of the files' names.
    span : float
        The colours of the area ratio in figures run from 1 / span to span.
    written : tuple of Path
        Files written by the last export.
    export_button : Button
    job : BackgroundJob
        The export in progress.
    notice : Question
        Results and errors.
    """

    span = Float(USUAL_SPAN)

    def __init__(self, workspace: Workspace):
        self._workspace, self.notice = workspace, Question()
        self.written: tuple[Path, ...] = ()
        self.job = BackgroundJob(self.notice, lambda: f"The export was cancelled. {self._summary()}")
        look: dict[str, Any] = {"style": STYLE, "layout": {"width": "auto", "flex": "1 1 160px"}}
        self.folder = Text("results", description="folder", placeholder="a folder, such as results", **look)
        self.stem = Text(description="name", placeholder="name of the section", **look)
        self.kinds = {
            ending: Checkbox(ending in DEFAULTS, description=label, indent=False, layout=Layout(width="auto"))
            for ending, (label, _) in WRITERS.items()
        }
        self.export_button = Button(description="Export results", icon="download", layout=Layout(width="auto"))
        self.export_button.on_click(lambda _: self.notice.attempt(self.export))
        self.job.observe(lambda change: setattr(self.export_button, "disabled", change.new), "busy")
        columns = Layout(grid_template_columns="repeat(auto-fit, minmax(180px, 1fr))")
        where = HBox([self.folder, self.stem], layout=Layout(flex_flow="row wrap"))
        kinds = GridBox(list(self.kinds.values()), layout=columns)
        super().__init__([where, kinds, HBox([self.export_button, self.job]), self.notice])

    def export(self, replace: bool = False) -> None:
        """Export the chosen results in the background; ask before replacing files.

        Raises
        ------
        SettingError
            If there is no restoration, or nothing is chosen.
        DataError
            If the folder cannot be created.
        """
        chosen = [ending for ending, box in self.kinds.items() if box.value]
        if not self._workspace.restoration.stages:
            raise SettingError("there is no result yet: restore first")
        if not chosen:
            raise SettingError("choose what to export")
        stem, folder = self._stem(), self._folder()
        if not self.notice.has_folder(folder.parent, self.export):
            return
        make_folder(folder)
        paths = {ending: folder / f"{stem}-{ending}" for ending in chosen}
        existing = [path.name for path in paths.values() if path.exists()]
        if existing and not replace:
            again = partial(self.notice.attempt, partial(self.export, replace=True))
            self.notice.ask(f"These files exist already: {', '.join(existing)}.", {REPLACE: again, LEAVE: lambda: None})
            return
        self.written = ()
        shown = self._workspace
        result = Result(
            shown.restoration,
            shown.interpretation,
            shown.source,
            shown.drawing.colours,
            self.span,
            shown.plan.stratigraphy,
        )
        self.job.begin(partial(self._write, result, paths))

    def wait(self, timeout: float | None = None) -> bool:
        """Wait until no export is in progress; False after the timeout in seconds."""
        return self.job.wait(timeout)

    def end(self) -> None:
        """Stop after the file that is being written."""
        self.job.drop()

    def _write(self, result: Result, paths: dict[str, Path], report: Report) -> Callable[[], None]:
        """Write one complete file after the other; if one cannot be written, continue with the next."""
        errors: list[str | Keyword] = []
        for count, (ending, path) in enumerate(paths.items()):
            if not report(count / len(paths)):
                break
            self.notice.hint(f"Writing {path.name} ...")
            try:
                WRITERS[ending][1](result, path)
                self.written = (*self.written, path)
            except SeiswidgetsError as error:
                errors += [error.text, ". "]
        if errors:
            return partial(self.notice.alert, Message(*errors, self._summary()))
        return lambda: self.notice.hint(self._summary())

    def _summary(self) -> str:
        if not self.written:
            return "Nothing was written."
        return f"Wrote into {self.written[0].parent.absolute()}: {', '.join(path.name for path in self.written)}."

    def _folder(self) -> Path:
        """The folder that was entered."""
        if not self.folder.value.strip():
            raise SettingError("give the folder for the files")
        return user_path(self.folder.value.strip()).absolute()

    def _stem(self) -> str:
        """The name that was entered, or a harmless form of the section's name."""
        given = self.stem.value.strip()
        if given != Path(given).name or given in (".", ".."):
            raise SettingError(f"the name must be a name without folders, but is {given!r}; enter those as the folder")
        return given or safe_name(self._workspace.section.name, "section")


def _write_figure(result: Result, path: Path) -> None:
    """Write a figure made without pyplot, whose figures belong to the user and to another thread."""
    from matplotlib.figure import Figure  # slow to import: the app appears sooner without it

    look = {"colours": result.colours, "span": result.span}
    figure = plot.workflow(result.restoration, result.interpretation, **look, figure=Figure())
    with atomic_write(path) as draft:
        figure.savefig(draft, dpi=DPI)


def _write_storyboard(result: Result, path: Path) -> None:
    from matplotlib.figure import Figure

    look = {"colours": result.colours, "stratigraphy": result.stratigraphy}
    figure = plot.storyboard(result.restoration, result.interpretation, **look, figure=Figure())
    with atomic_write(path) as draft:
        figure.savefig(draft, dpi=DPI)


def _write_report(result: Result, path: Path) -> None:
    save_report(result.restoration, path, result.interpretation, colours=result.colours, span=result.span)


def _write_handout(result: Result, path: Path) -> None:
    from seiswidgets.widgets.handout.page import save_html  # imports pyplot

    save_html(result.restoration, path, result.interpretation, colours=result.colours, span=result.span)


def _write_displacement(result: Result, path: Path) -> None:
    fields = displacement(result.restoration)
    with atomic_write(path) as draft:
        fields.to_netcdf(draft)


def _write_segy(result: Result, path: Path) -> None:
    """Write the section with the headers of the SEG-Y file that it came from, if any."""
    source, keywords = result.source, segy_keywords(result.source)
    if source is None or keywords is None:
        save_section(result.restoration, path)
    else:
        save_section(result.restoration, path, like=source.name, x0=result.restoration.original.x0, **keywords)


def _restored(result: Result) -> tuple[Restoration, Interpretation]:
    return result.restoration, result.interpretation


def _throws(result: Result) -> Table:
    return fault_throws(result.restoration.original, result.interpretation, result.stratigraphy)


def _growth(result: Result) -> Table:
    return fault_growth(result.restoration.original, result.interpretation, result.stratigraphy)


def _of_table(measure: Callable[[Result], Table]) -> Writer:
    return lambda result, path: save_table(measure(result), path)


def _of_restoration(save: Callable[[Restoration, Path], None]) -> Writer:
    return lambda result, path: save(result.restoration, path)


WRITERS: dict[str, tuple[str, Writer]] = {
    "restored.npz": ("section, NumPy (.npz)", _of_restoration(save_section)),
    "restored.sgy": ("section, SEG-Y (.sgy)", _write_segy),
    "figure.png": ("figure (.png, 300 dpi)", _write_figure),
    "figure.svg": ("figure (.svg)", _write_figure),
    "storyboard.png": ("storyboard (.png, 300 dpi)", _write_storyboard),
    "mesh.vtu": ("mesh for ParaView (.vtu)", _of_restoration(save_mesh)),
    "report.json": ("report (.json)", _write_report),
    "report.html": ("report (.html)", _write_report),
    "handout.html": ("handout, with live panes (.html)", _write_handout),
    "displacement.nc": ("displacement (.nc)", _write_displacement),
    "throw.csv": ("throw along faults (.csv)", _of_table(_throws)),
    "growth.csv": ("growth of faults (.csv)", _of_table(_growth)),
    "balance.csv": ("balance of beds (.csv)", _of_table(lambda result: balance(*_restored(result)).tables[0])),
    "extension.csv": ("extension by step (.csv)", _of_table(lambda result: extension_history(*_restored(result)))),
}
DEFAULTS = ("restored.npz", "figure.png", "report.html")
