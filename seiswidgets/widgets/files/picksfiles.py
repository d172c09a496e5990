"""Picks in and out of files, in the app."""

import warnings
from os.path import expanduser

from ipywidgets import Button, Checkbox, Dropdown, HBox, Layout, Text, VBox

from seiswidgets.errors import SeiswidgetsError
from seiswidgets.geology.section import METRES, SECONDS
from seiswidgets.io.picks import read_picks, write_picks
from seiswidgets.io.picks.files import EXPORTS
from seiswidgets.widgets.files.filefield import FileField
from seiswidgets.widgets.files.question import Question

STATED = "as the file says"
STYLE, WIDE = {"description_width": "110px"}, Layout(width="auto")


class PicksFiles(VBox):
    """Import of picks, which can be undone, and export.

    Parameters
    ----------
    app : RestorationApp

    Attributes
    ----------
    file, out : FileField, Text
        What is read, and the path that is written to.
    notice : Question
        What was done, or is wrong.
    """

    def __init__(self, app):
        self._app = app
        self.file, self.notice = FileField("picks: path of a .geojson, .csv or exported file"), Question()
        self.format = _chooser("format", {"by the suffix: GeoJSON or CSV": None, **{name: name for name in EXPORTS}})
        self.x_unit = _chooser("unit of x", {STATED: None, **{name: name for name in METRES}})
        self.z_unit = _chooser("unit of z", {STATED: None, **{name: name for name in (*METRES, *SECONDS)}})
        self.z_up = Checkbox(description="z grows upwards in the file", indent=False)
        self.along = _chooser("x is the", {"x of the section": None, "map's X": "x", "map's Y": "y"})
        self.line = Text(description="seismic line", placeholder="if there are several", style=STYLE, layout=WIDE)
        self._of_exports = VBox([self.along, self.line, self.z_up], layout=Layout(display="none"))
        self.out = Text(placeholder="picks.geojson or picks.csv", layout=Layout(flex="1", width="auto"))
        read = Button(description="Import picks", icon="sign-in", layout=Layout(width="auto", align_self="flex-start"))
        write = Button(description="Export picks", icon="sign-out", layout=Layout(width="auto"))
        units = [self.format, self.x_unit, self.z_unit, self._of_exports]
        super().__init__([self.file, *units, read, HBox([self.out, write]), self.notice])
        self.format.observe(self._take_format, "value")
        self.file.observe(lambda change: self.notice.alert(change.new), "error")
        read.on_click(lambda _: self._said(self.read))
        write.on_click(lambda _: self._said(self.write))

    def read(self) -> str:
        """Take the picks of the file instead of those that are drawn, and say what came.

        Raises
        ------
        DataError, SettingError
            As for `read_picks`.
        """
        exported = {"z_up": self.z_up.value, "along": self.along.value, "line": self.line.value.strip() or None}
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            picks = read_picks(
                expanduser(self.file.path),
                self._app.section,
                format=self.format.value,
                x_unit=self.x_unit.value,
                z_unit=self.z_unit.value,
                **exported if self.format.value else {},
            )
        self._app.interpretation = picks
        came = f"Read {len(picks.faults)} faults and {len(picks.horizons)} horizons; Undo brings back what was there."
        return " ".join([came, *(f"{warning.message}." for warning in caught)])

    def write(self) -> str:
        """Write the picks, and say where.

        Raises
        ------
        DataError, SettingError
            As for `write_picks`.
        """
        path = expanduser(self.out.value.strip())
        picks = self._app.interpretation
        write_picks(picks, path, self._app.section)
        left_out = len(self._app.picker.drawing.picks) - len(picks.faults) - len(picks.horizons)
        return f"Wrote {path}." + (f" {left_out} picks that cannot be used were left out." if left_out else "")

    def end(self) -> None:
        """Delete what was uploaded."""
        self.file.end()

    def _said(self, action):
        try:
            self.notice.hint(action())
        except SeiswidgetsError as error:
            self.notice.alert(str(error))

    def _take_format(self, change):
        self._of_exports.layout.display = "" if change.new else "none"


def _chooser(words, options):
    return Dropdown(options=list(options.items()), description=words, style=STYLE, layout=WIDE)
