"""Picks in and out of files, in the app."""

import warnings
from functools import partial

from ipywidgets import Button, Checkbox, Dropdown, HBox, Layout, Text, VBox

from seiswidgets.errors import SettingError
from seiswidgets.geology.picks import FAULT, HORIZON
from seiswidgets.geology.section import METRES, SECONDS
from seiswidgets.interaction.drawing import Drawing
from seiswidgets.io.files import user_path
from seiswidgets.io.picks import read_picks, write_picks
from seiswidgets.io.picks.files import EXPORTS
from seiswidgets.widgets.files.background_job import BackgroundJob
from seiswidgets.widgets.files.file_field import FileField
from seiswidgets.widgets.files.labels import LABELS, counted
from seiswidgets.widgets.files.line_map import points_of, segy_line
from seiswidgets.widgets.files.question import Question
from seiswidgets.widgets.jobs import UI_LOCK
from seiswidgets.widgets.workspace import Workspace

OURS = "by the suffix: GeoJSON or CSV"
UNCHOSEN = ""  # ipywidgets takes a None, chosen from a list, for nothing, and shows an empty field
STATED, NOT_STATED = "as the file says", "choose: the file does not say"
STATES = {  # of x and z
    UNCHOSEN: (STATED, STATED),
    "opendtect-horizons": (NOT_STATED, "as the file says, if it does"),
}
POINTS, SEGY = "points", "segy"
PLACES = {
    "choose: the file has places on a map": UNCHOSEN,
    "the map's X": "x",
    "the map's Y": "y",
    "the way along the line, as its SEG-Y file has it": SEGY,
    "the way along a line through these points": POINTS,
}
REPLACE, LEAVE = "Replace it", "Leave it"
STYLE, WIDE = {"description_width": "130px"}, {"width": "auto"}  # Layouts would be shared by all apps


class PicksFiles(VBox):
    """Import of picks, which can be undone, and export.

    Parameters
    ----------
    workspace : Workspace

    Attributes
    ----------
    file, out : FileField, Text
        What is read, and the path that is written to.
    job : BackgroundJob
        The reading that is under way.
    notice : Question
        What was done, or is wrong.
    """

    def __init__(self, workspace: Workspace):
        self._workspace = workspace
        self.file, self.notice = FileField("picks: path of a .geojson, .csv or exported file"), Question()
        self.job = BackgroundJob(self.notice, lambda: "The import was cancelled; the picks are as they were.")
        self.format = _chooser("format", {OURS: UNCHOSEN, **{name: name for name in EXPORTS}})
        self.x_unit, self.z_unit = (_chooser(f"unit of {axis}", {STATED: UNCHOSEN}) for axis in "xz")
        self.z_up = Checkbox(description="z grows upwards in the file", indent=False)
        self.along = _chooser(LABELS["along"], PLACES)
        self.points = _text("points of the line", "X Y of its first trace; X Y of its last, in the unit of x")
        self.line = _text(LABELS["line"], "its name, if there are several")
        self.keep = _chooser("picks drawn", {"stay, but for the same names": True, "make room": False})
        self._of_exports = VBox([self.along, self.points, self.line, self.z_up])
        layout = Layout(flex="1", width="auto")
        self.out = Text("picks.geojson", placeholder="picks.geojson or picks.csv", layout=layout)
        self._read = Button(description="Import picks", icon="sign-in", layout=WIDE)
        write = Button(description="Export picks", icon="sign-out", layout=WIDE)
        choices = [self.format, self.x_unit, self.z_unit, self._of_exports, self.keep]
        super().__init__([self.file, *choices, HBox([self._read, self.job]), HBox([self.out, write]), self.notice])
        self.format.observe(self._take_format, "value")
        self.along.observe(self._take_along, "value")
        self._take_format()
        self._take_along()
        self.file.observe(lambda change: self.notice.alert(change.new), "error")
        self.job.observe(lambda change: setattr(self._read, "disabled", change.new), "busy")
        self._read.on_click(lambda _: self.notice.attempt(self.read))
        write.on_click(lambda _: self.notice.attempt(self.write))

    def read(self) -> None:
        """Take the picks of the file, in the background.

        Raises
        ------
        DataError, SettingError
            If a choice is missing, or none.
        """
        if not self.file.path:
            raise SettingError("give the path of a file of picks, or upload one")
        said = {"format": self.format, "x_unit": self.x_unit, "z_unit": self.z_unit}
        choices = {name: chooser.value or None for name, chooser in said.items()}
        if self.format.value:
            along, line = self._along(), self.line.value.strip() or None
            choices |= {"z_up": self.z_up.value, "along": along, "line": line}
        self.notice.hint("Reading ...")
        self.job.begin(
            partial(self._picks_of, self.file.path, self._workspace.section, self._workspace.source, choices)
        )

    def write(self, replace: bool = False) -> None:
        """Write the picks, and say where; ask before another file is replaced.

        Raises
        ------
        DataError, SettingError
            As for `write_picks`.
        """
        path = user_path(self.out.value.strip())
        if path.is_file() and not replace:
            again = partial(self.notice.attempt, partial(self.write, replace=True))
            self.notice.ask(f"{path} exists already.", {REPLACE: again, LEAVE: lambda: None})
            return
        picks = self._workspace.interpretation
        write_picks(picks, path, self._workspace.section)
        left_out = len(self._workspace.drawing.picks) - len(picks.faults) - len(picks.horizons)
        these = f" {left_out} picks that cannot be used were left out." if left_out else ""
        self.notice.hint(f"Wrote {counted(picks)} to {path.absolute()}.{these}")

    def wait(self, timeout: float | None = None) -> bool:
        """Wait until nothing is being read; False if that took too long."""
        return self.job.wait(timeout)

    def end(self) -> None:
        """Give up what is under way, and delete what was uploaded."""
        self.job.drop()
        self.file.end()

    def _along(self):
        """Where on the section places of the file are, as `read_picks` takes it; or SEGY."""
        if self.along.value == UNCHOSEN:
            raise SettingError(f"the file has places (X, Y) on a map: choose what “{LABELS['along']}”")
        return points_of(self.points.value) if self.along.value == POINTS else self.along.value

    def _picks_of(self, path, section, source, choices, tell):
        """Read picks, on the job's thread."""
        if choices.get("along") == SEGY:
            choices["along"] = segy_line(source)
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            picks = read_picks(path, section, **choices)
        return partial(self._take, picks, [str(warning.message) for warning in caught])

    def _take(self, picks, warned):
        take = _added if self.keep.value else Drawing.with_interpretation
        with UI_LOCK:
            self._workspace.edit("import picks", drawing=take(self._workspace.drawing, picks))
        came = f"Read {counted(picks)}; Undo brings back what was there."
        self.notice.hint(" ".join([came, *(f"{text}." for text in warned)]))

    def _take_format(self, change=None):
        """Ask what the format does not say."""
        states_x, states_z = STATES.get(self.format.value, (NOT_STATED, NOT_STATED))
        self._of_exports.layout.display = "none" if self.format.value == UNCHOSEN else ""
        _offer(self.x_unit, {states_x: UNCHOSEN, **{name: name for name in METRES}})
        _offer(self.z_unit, {states_z: UNCHOSEN, **{name: name for name in (*METRES, *SECONDS)}})

    def _take_along(self, change=None):
        self.points.layout.display = "" if self.along.value == POINTS else "none"


def _added(drawing, picks):
    """A drawing with picks of a file beside its own, but for those of the same names."""
    for kind, found in ((FAULT, picks.faults), (HORIZON, picks.horizons)):
        for pick in found:
            pieces = (pick.points,) if kind == FAULT else pick.pieces
            add = drawing.with_pieces if pick.name in drawing.names(kind) else drawing.with_pick
            drawing = add(kind, pick.name, pieces)
    return drawing


def _offer(chooser, options):
    """Other options; what was chosen stays so."""
    place = list(options.values()).index(chooser.value)
    chooser.options = list(options.items())
    chooser.index = place


def _chooser(words, options):
    return Dropdown(options=list(options.items()), description=words, style=STYLE, layout=WIDE)


def _text(words, placeholder):
    return Text(description=words, placeholder=placeholder, style=STYLE, layout=Layout(width="auto"))
