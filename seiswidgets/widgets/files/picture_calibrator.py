"""Calibrating and cropping a scanned picture in the app: by clicks on it, or by typed pixels."""

from collections.abc import Callable
from html import escape
from typing import Any

import numpy as np
from ipywidgets import HTML, Button, Checkbox, HBox, Label, Layout, Text, ToggleButtons, VBox, Widget
from traitlets import Bunch

from seiswidgets.errors import SeiswidgetsError, SettingError
from seiswidgets.geology.section import Section
from seiswidgets.geology.validation import finite_number
from seiswidgets.interaction.gestures import Gesture, Move, Press, Release
from seiswidgets.interaction.overlay import Mark, Stroke
from seiswidgets.io.rasters.calibration import ROTATED, Calibration, Window, checked_window
from seiswidgets.widgets.closing import close_with_parts
from seiswidgets.widgets.files.labels import in_labels
from seiswidgets.widgets.messages import HINT, TROUBLE
from seiswidgets.widgets.section_view.pane import SectionPane

LOOK, CROP = "look", "crop"
POINTS = {
    "x1": "horizontal axis, first point",
    "x2": "horizontal axis, second point",
    "z1": "vertical axis, first point",
    "z2": "vertical axis, second point",
}
PARTS = ("column", "row", "value")
EDGES = {"left": "first column", "right": "last column", "top": "first row", "bottom": "last row"}
COLOURS = {"x": "#d81b60", "z": "#1e88e5", CROP: "#2e7d32"}
HOW = (
    "Choose a point, click it on the picture (drag to correct, turn the wheel to zoom), and type its value, in the "
    "units below; two on each axis. Crop: drag a rectangle. Or type columns and rows."
)
NARROW = {"width": "92px"}
HEIGHT = 260  # css pixels of the picture


class PictureCalibrator(VBox):
    """A picture on which two points of each axis and a rectangle can be chosen.

    Parameters
    ----------
    read : callable()
        Called when the picture is wanted; it leads to a call of ``show``.
    used : callable(bool)
        Called with True once a point of an axis is given, with False when there is none.

    Attributes
    ----------
    open_button, close_button : Button
    tools : ToggleButtons
        What a click or a drag on the picture does.
    points : dict of (str, str) to Text
        Column, row and value of each point, such as ("x1", "column").
    edges : dict of str to Text
        First and last column, and first and last row, to keep.
    straighten : Checkbox
    state : HTML
        What is missing, or what follows.
    pane : SectionPane or None
        The picture, while it is shown.
    """

    def __init__(self, read: Callable[[], None], used: Callable[[bool], None]):
        self._used, self._shape = used, (2, 2)
        self._start: tuple[float, float] | None = None  # of a drag
        self.pane: SectionPane | None = None
        auto = Layout(width="auto")
        self.open_button = Button(description="Calibrate and crop on the picture", icon="crosshairs", layout=auto)
        self.close_button = Button(description="Type the edges instead", icon="times", layout=auto)
        self.tools = ToggleButtons(
            options=[("Look", LOOK), *((name, name) for name in POINTS), ("Crop", CROP)],
            tooltips=["Zoom and pan", *POINTS.values(), "Drag a rectangle around the section"],
            style={"button_width": "auto"},
        )
        self.points = {
            (name, part): Text(placeholder=part, tooltip=f"{part} of the {point}", layout=Layout(**NARROW))
            for name, point in POINTS.items()
            for part in PARTS
        }
        self.edges = {
            name: Text(placeholder=edge, tooltip=f"{edge} to keep", layout=Layout(**NARROW))
            for name, edge in EDGES.items()
        }
        self.straighten = Checkbox(description="straighten the picture", indent=False, layout=auto)
        self.state = HTML()
        self._above, self._below = [HTML(HINT.format(HOW)), self.tools], self._make_rows()
        super().__init__([self.open_button])
        self.open_button.on_click(lambda _: read())
        self.close_button.on_click(lambda _: self.reset())
        for field in (*self.points.values(), *self.edges.values(), self.straighten):
            field.observe(self._take_field, "value")

    def show(self, pixels: Section) -> None:
        """Show a picture whose columns and rows are x and z of a section."""
        self.reset()
        self._shape = pixels.shape
        titles = "column of pixels", "row of pixels"
        self.pane = SectionPane(pixels, height=HEIGHT, clip=100.0, titles=titles)
        self.pane.on_gesture(self._take_gesture)
        self.tools.value = "x1"
        self.children = [*self._above, self.pane, *self._below]
        self._update()

    def _make_rows(self) -> list[Widget]:
        fields = {point: [self.points[name, part] for part in PARTS] for name, point in POINTS.items()}
        fields["crop to"] = [*self.edges.values()]
        rows = [HBox([Label(label, layout=Layout(width="190px")), *row]) for label, row in fields.items()]
        for row in rows:
            row.layout.flex_flow = "row wrap"
        return [*rows, self.state, HBox([self.straighten, self.close_button])]

    def reset(self) -> None:
        """Forget everything, and hide the picture."""
        self.children, pane = [self.open_button], self.pane
        self.pane = self._start = None
        for field in (*self.points.values(), *self.edges.values()):
            field.value = ""
        self.straighten.value = False
        self._used(False)
        if pane is not None:
            close_with_parts(pane)

    def rescale(self, axis: str, factor: float) -> None:
        """Convert the values on an axis, "x" or "z", to another unit."""
        for (name, part), field in self.points.items():
            if part == "value" and name.startswith(axis):
                number = _number(field)
                field.value = field.value if number is None else f"{number * factor:.12g}"

    def choices(self) -> dict[str, Any]:
        """Keywords of `open_section`: the calibration and the crop, as far as they are given.

        Raises
        ------
        SettingError
            If one is incomplete or impossible.
        """
        choices: dict[str, Any] = {}
        if self._is_calibrated:
            choices["calibration"] = self._calibration()
            Calibration.of(choices["calibration"])
        if any(field.value.strip() for field in self.edges.values()):
            choices["crop"] = list(self._window())
        return choices

    @property
    def _is_calibrated(self) -> bool:
        return any(field.value.strip() for field in self.points.values())

    def _calibration(self) -> dict[str, Any]:
        numbers = {key: _number(field) for key, field in self.points.items()}
        missing = [f"the {part} of the {POINTS[name]}" for (name, part), value in numbers.items() if value is None]
        if missing:
            more = f" and {len(missing) - 1} more" if missing[1:] else ""
            raise SettingError(f"the calibration needs {missing[0]}{more}")
        points = {axis: [[numbers[f"{axis}{end}", part] for part in PARTS] for end in (1, 2)] for axis in "xz"}
        return {**points, "deskew": True} if self.straighten.value else dict(points)

    def _window(self) -> Window:
        """The columns and rows that are kept; an empty field keeps all on its side."""
        rows, columns = self._shape
        whole = {"left": 0, "right": columns - 1, "top": 0, "bottom": rows - 1}
        kept = [
            finite_number(f"the {EDGES[name]} to keep", field.value) if field.value.strip() else whole[name]
            for name, field in self.edges.items()
        ]
        return checked_window(kept, self._shape)

    def _take_gesture(self, gesture: Gesture) -> bool:
        """Put the chosen point, or draw the rectangle, while the button is down; then go on to the next point."""
        tool = self.tools.value
        if tool == LOOK or not isinstance(gesture, Press | Move | Release):
            return False
        if isinstance(gesture, Press):
            self._start = gesture.point if gesture.button == 0 else None
        if self._start is None:
            return False
        if tool == CROP:
            self._crop(self._start, gesture.point)
        else:
            self._put(tool, gesture.point)
        if isinstance(gesture, Release):
            self._start = None
            self._go_on(tool)
        return True

    def _put(self, name: str, point: tuple[float, float]) -> None:
        limits = np.array(self._shape[::-1]) - 1
        for part, pixel in zip(PARTS, np.clip(point, 0, limits).tolist(), strict=False):
            self.points[name, part].value = f"{pixel:.1f}".removesuffix(".0")

    def _crop(self, start: tuple[float, float], end: tuple[float, float]) -> None:
        corners = np.clip(np.rint(np.sort([start, end], axis=0)), 0, np.array(self._shape[::-1]) - 1)
        for name, pixel in zip(EDGES, corners.T.ravel().astype(int).tolist(), strict=True):
            self.edges[name].value = str(pixel)

    def _go_on(self, tool: str) -> None:
        """Ask for the value of a point that was put, and choose the next one."""
        if tool == CROP:
            return
        self.points[tool, "value"].focus()
        left = [name for name in POINTS if not self.points[name, "column"].value]
        self.tools.value = left[0] if left else LOOK

    def _take_field(self, change: Bunch) -> None:
        if self.pane is not None:
            self._update()

    def _update(self) -> None:
        """Show what the fields say on the picture and in words."""
        self._used(self._is_calibrated)
        try:
            choices = self.choices()
            window = self._window()
        except SeiswidgetsError as error:
            given = all(field.value.strip() for field in self.points.values())
            self.state.value = (TROUBLE if given else HINT).format(escape(in_labels(error.text)))
        else:
            calibration = choices.get("calibration")
            self.state.value = HINT.format(_words(Calibration.of(calibration), window) if calibration else "")
        self._draw()

    def _draw(self) -> None:
        if self.pane is None:
            return
        numbers = {key: _number(field) for key, field in self.points.items()}
        at = {name: (numbers[name, "column"], numbers[name, "row"]) for name in POINTS}
        marks = {name: (x, z) for name, (x, z) in at.items() if x is not None and z is not None}
        self.pane.draw_marks([Mark(point, "cutoff", name, COLOURS[name[0]]) for name, point in marks.items()])
        axes = [
            Stroke(np.array([marks[f"{axis}1"], marks[f"{axis}2"]]), COLOURS[axis])
            for axis in "xz"
            if {f"{axis}1", f"{axis}2"} <= marks.keys()
        ]
        self.pane.draw_lines([*axes, *self._rectangle()])

    def _rectangle(self) -> list[Stroke]:
        try:
            left, right, top, bottom = self._window()
        except SettingError:
            return []
        corners = [(left, top), (right, top), (right, bottom), (left, bottom), (left, top)]
        return [Stroke(np.array(corners, float), COLOURS[CROP], dash=(6, 4))]


def _number(field: Text) -> float | None:
    """The number in a field; None if it is empty or not one yet."""
    try:
        return finite_number(field.tooltip, field.value) if field.value.strip() else None
    except SettingError:
        return None


def _words(calibration: Calibration, window: Window) -> str:
    """The axes that follow from a calibration, and a word on axes that are rotated."""
    axes, (nz, nx) = calibration.grid(window)
    x_max, z_max = axes["x0"] + (nx - 1) * axes["dx"], axes["z0"] + (nz - 1) * axes["dz"]
    text = (
        f"x from {axes['x0']:.6g} to {x_max:.6g}, {nx:,} traces {axes['dx']:.4g} apart; z from {axes['z0']:.6g} to "
        f"{z_max:.6g}, {nz:,} samples {axes['dz']:.4g} apart."
    )
    angle = calibration.rotation
    if abs(angle) > ROTATED and not calibration.deskew:
        text += f" The axes are rotated by {angle:.1f}°: tick “straighten the picture”, or put both points on one line."
    return text
