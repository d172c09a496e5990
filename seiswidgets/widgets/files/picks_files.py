"""Import and export of picks in the app."""

import warnings
from collections.abc import Callable
from functools import partial
from typing import Any

from ipywidgets import Button, Checkbox, Dropdown, HBox, Layout, Text, VBox

from seiswidgets.errors import SettingError
from seiswidgets.geology.picks import Interpretation
from seiswidgets.geology.section import METRES, SECONDS, Section
from seiswidgets.interaction.drawing import Drawing
from seiswidgets.io.files import user_path
from seiswidgets.io.picks import read_picks, write_picks
from seiswidgets.io.picks.files import EXPORTS
from seiswidgets.io.session.sources import SectionSource
from seiswidgets.widgets.files.background_job import BackgroundJob, Report
from seiswidgets.widgets.files.file_field import FileField
from seiswidgets.widgets.files.labels import LABELS, counted
from seiswidgets.widgets.files.line_map import points_of, segy_line
from seiswidgets.widgets.files.question import Question
from seiswidgets.widgets.jobs import UI_LOCK
from seiswidgets.widgets.workspace import Workspace

BY_SUFFIX = "by the suffix: GeoJSON or CSV"
UNCHOSEN = ""  # not None, for which ipywidgets shows an empty field
STATED, IF_STATED, NOT_STATED = "as in the file", "as in the file, if stated", "choose: not in the file"
KINDS = ("horizons", "faults")  # of exports
UNITS_STATED = {  # units of x and z, by format
    UNCHOSEN: (STATED, STATED),
    **dict.fromkeys(("iesx-horizons", "iesx-faults", "petrel-points"), (IF_STATED, IF_STATED)),
    **{f"{family}-horizons": (NOT_STATED, IF_STATED) for family in ("opendtect", "earthvision", "dug")},
    **{f"{family}-{kind}": (NOT_STATED, IF_STATED) for family in ("kingdom", "geographix") for kind in KINDS},
}
POINTS, SEGY = "points", "segy"
ALONG = {
    "choose: the file has map coordinates": UNCHOSEN,
    "the map's X": "x",
    "the map's Y": "y",
    "the distance along the line in its SEG-Y file": SEGY,
    "the distance along a line through these points": POINTS,
}
REPLACE, LEAVE = "Replace it", "Leave it"
STYLE, WIDE = {"description_width": "130px"}, {"width": "auto"}  # not Layouts, which all apps would share


class PicksFiles(VBox):
    """Import of picks, which can be undone, and export.

    Parameters
    ----------
    workspace : Workspace

    Attributes
    ----------
    file, import_button : FileField, Button
    out, export_button : Text, Button
        Path to write to.
    format, x_unit, z_unit, along, keep : Dropdown
    points, line, z_up : Text, Text, Checkbox
        Choices for the import.
    map_fields : VBox
        Choices for exports of other programs only.
    job : BackgroundJob
        The import in progress.
    notice : Question
        Results and errors.
    """

    def __init__(self, workspace: Workspace):
        self._workspace = workspace
        self.file, self.notice = FileField("picks: path of a .geojson, .csv or exported file"), Question()
        self.job = BackgroundJob(self.notice, lambda: "The import was cancelled; the picks are as they were.")
        self.format = _chooser("format", {BY_SUFFIX: UNCHOSEN, **{name: name for name in EXPORTS}})
        self.x_unit, self.z_unit = (_chooser(f"unit of {axis}", {STATED: UNCHOSEN}) for axis in "xz")
        self.z_up = Checkbox(description="z increases upwards in the file", indent=False)
        self.along = _chooser(LABELS["along"], ALONG)
        self.points = _text("points of the line", "X Y of its first trace; X Y of its last, in the unit of x")
        self.line = _text(LABELS["line"], "its name, if there are several")
        self.keep = _chooser("picks drawn", {"stay, except those of the same names": True, "are replaced": False})
        self.map_fields = VBox([self.along, self.points, self.line, self.z_up])
        layout = Layout(flex="1", width="auto")
        self.out = Text("picks.geojson", placeholder="picks.geojson or picks.csv", layout=layout)
        self.import_button = Button(description="Import picks", icon="sign-in", layout=WIDE)
        self.export_button = Button(description="Export picks", icon="sign-out", layout=WIDE)
        choices = [self.format, self.x_unit, self.z_unit, self.map_fields, self.keep]
        rows = [HBox([self.import_button, self.job]), HBox([self.out, self.export_button])]
        super().__init__([self.file, *choices, *rows, self.notice])
        self.format.observe(lambda change: self._update_choices(), "value")
        self.along.observe(lambda change: self._update_choices(), "value")
        self._update_choices()
        self.file.observe(lambda change: self.notice.alert(change.new), "error")
        self.job.observe(lambda change: setattr(self.import_button, "disabled", change.new), "busy")
        self.import_button.on_click(lambda _: self.notice.attempt(self.read))
        self.export_button.on_click(lambda _: self.notice.attempt(self.write))

    def read(self) -> None:
        """Import the picks of the file, in the background.

        Raises
        ------
        DataError, SettingError
            If a choice is missing, or not valid.
        """
        if not self.file.path:
            raise SettingError("give the path of a file with picks, or upload one")
        choosers = {"format": self.format, "x_unit": self.x_unit, "z_unit": self.z_unit}
        choices = {name: chooser.value or None for name, chooser in choosers.items()}
        if self.format.value:
            along, line = self._along(), self.line.value.strip() or None
            choices |= {"z_up": self.z_up.value, "along": along, "line": line}
        self.notice.hint("Reading ...")
        section, source = self._workspace.section, self._workspace.source
        self.job.begin(partial(self._read, self.file.path, section, source, choices))

    def write(self, replace: bool = False) -> None:
        """Export the picks, and show where; ask before replacing another file.

        Raises
        ------
        DataError, SettingError
            As for `write_picks`.
        """
        path = user_path(self.out.value.strip()).absolute()
        if not self.notice.has_folder(path.parent, self.write):
            return
        if path.is_file() and not replace:
            again = partial(self.notice.attempt, partial(self.write, replace=True))
            self.notice.ask(f"{path} exists already.", {REPLACE: again, LEAVE: lambda: None})
            return
        picks = self._workspace.interpretation
        write_picks(picks, path, self._workspace.section)
        left_out = len(self._workspace.drawing.picks) - len(picks.faults) - len(picks.horizons)
        unusable = f" {left_out} picks that cannot be used were left out." if left_out else ""
        self.notice.hint(f"Wrote {counted(picks)} to {path.absolute()}.{unusable}")

    def wait(self, timeout: float | None = None) -> bool:
        """Wait until no import is in progress; False after the timeout in seconds."""
        return self.job.wait(timeout)

    def end(self) -> None:
        """Cancel the import in progress, and delete uploads."""
        self.job.drop()
        self.file.end()

    def _along(self) -> str | list[tuple[float, float]]:
        """The keyword ``along`` of `read_picks`, or SEGY."""
        if self.along.value == UNCHOSEN:
            raise SettingError(f"the file has map coordinates (X, Y): choose what “{LABELS['along']}”")
        return points_of(self.points.value) if self.along.value == POINTS else self.along.value

    def _read(
        self, path: str, section: Section, source: SectionSource | None, choices: dict[str, Any], report: Report
    ) -> Callable[[], None]:
        """Read picks, on the job's thread."""
        if choices.get("along") == SEGY:
            choices["along"] = segy_line(source)
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            picks = read_picks(path, section, **choices)
        return partial(self._take, picks, [str(warning.message) for warning in caught])

    def _take(self, picks: Interpretation, warned: list[str]) -> None:
        combine = _with_added if self.keep.value else Drawing.with_interpretation
        with UI_LOCK:
            self._workspace.edit("import picks", drawing=combine(self._workspace.drawing, picks))
        text = f"Read {counted(picks)}; Undo brings the earlier picks back."
        self.notice.hint(" ".join([text, *(f"{warning}." for warning in warned)]))

    def _update_choices(self) -> None:
        """Show the choices that the format needs."""
        states_x, states_z = UNITS_STATED.get(self.format.value, (NOT_STATED, NOT_STATED))
        self.map_fields.layout.display = "none" if self.format.value == UNCHOSEN else ""
        _offer(self.x_unit, {states_x: UNCHOSEN, **{name: name for name in METRES}})
        _offer(self.z_unit, {states_z: UNCHOSEN, **{name: name for name in (*METRES, *SECONDS)}})
        self.points.layout.display = "" if self.along.value == POINTS else "none"


def _with_added(drawing: Drawing, picks: Interpretation) -> Drawing:
    """Add picks to a drawing; they replace those of the same names."""
    for new in Drawing().with_interpretation(picks).picks:
        if new.name in drawing.names(new.kind):
            drawing = drawing.with_pieces(new.kind, new.name, new.pieces)
        else:
            pieces, use = new.pieces, new.use
            drawing = drawing.with_pick(new.kind, new.name, pieces, use=use, ends=new.ends, body=new.body)
    return drawing


def _offer(chooser: Dropdown, options: dict[str, str]) -> None:
    """Offer other options, and keep the chosen value."""
    index = list(options.values()).index(chooser.value)
    chooser.options = list(options.items())
    chooser.index = index


def _chooser(label: str, options: dict[str, Any]) -> Dropdown:
    return Dropdown(options=list(options.items()), description=label, style=STYLE, layout=WIDE)


def _text(label: str, placeholder: str) -> Text:
    return Text(description=label, placeholder=placeholder, style=STYLE, layout=Layout(width="auto"))
