"""Controls for the display of sections and for the solver."""

import math
from typing import Any

from ipywidgets import (
    BoundedFloatText,
    Button,
    Checkbox,
    Dropdown,
    FloatLogSlider,
    FloatSlider,
    HBox,
    Layout,
    VBox,
    Widget,
)
from traitlets import Bunch, Enum, Float, HasTraits

from seiswidgets.geology.restoration import Restoration
from seiswidgets.geology.solve import MOST_ITERATIONS
from seiswidgets.interaction.colour import RatioColouring
from seiswidgets.widgets.binding import bind, bind_control
from seiswidgets.widgets.linked_panes import LinkedPanes
from seiswidgets.widgets.section_view.pane import SectionPane
from seiswidgets.widgets.workspace import Workspace

COLOURS = ("greys", "red-white-blue", "seismic", "bwr", "PuOr", "BrBG", "Spectral", "cividis")
POLARITIES = [("normal: peaks are positive", 1), ("reversed", -1)]
SOLVERS = {"gauss-newton": "Gauss-Newton (ours)", "fixed-point": "fixed point (the paper's)"}
RANGE = 4.0  # largest ratio of the mesh spacing to the default one, and its inverse the smallest
STYLE = {"description_width": "130px"}
LOOK: dict[str, Any] = {
    "layout": {"width": "auto"},
    "style": STYLE,
}  # dicts, since a Layout made here would be shared by all apps


class DisplayControls(VBox):
    """Controls for the display of two linked panes.

    Parameters
    ----------
    panes : LinkedPanes
    """

    def __init__(self, panes: LinkedPanes):
        first = panes.original
        colours = sorted({*COLOURS, first.colours}, key=_colours_index)
        rows: list[tuple[HasTraits, str, Widget]] = [
            (first, "colours", Dropdown(options=colours, description="colours", **LOOK)),
            (first, "clip", FloatSlider(min=50, max=100, step=0.5, description="clip (percentile)", **LOOK)),
            (first, "gain", FloatLogSlider(min=-1, max=1, step=0.02, description="gain", readout_format=".2f", **LOOK)),
            (first, "polarity", Dropdown(options=POLARITIES, description="polarity", **LOOK)),
            (panes, "deformation", FloatSlider(min=0, max=1, step=0.05, description="deformation", **LOOK)),
            (panes, "mesh", FloatSlider(min=0, max=1, step=0.05, description="mesh", **LOOK)),
            (panes, "zoom_linked", Checkbox(description="both panes zoom together", indent=False, **LOOK)),
        ]
        for owner, name, widget in rows:
            bind_control(owner, name, widget)
        super().__init__([_exaggeration(first), *(widget for _, _, widget in rows), _scale(panes)])


def _scale(panes: LinkedPanes) -> HBox:
    """Field of the percentage at which the colours of the area ratio end, and a button that fits it to the rock."""
    look = {"style": STYLE, "layout": {"flex": "1", "width": "auto"}}
    text = BoundedFloatText(min=0.1, max=400, step=1, description="colours end at (%)", **look)
    fit = Button(
        description="Fit", tooltip="Fit the scale of the colours to this restoration", layout={"width": "auto"}
    )

    def percentage() -> float:
        return float(f"{100 * (panes.span - 1):.3g}")

    def enter(change: Bunch) -> None:
        if change.new != percentage():
            panes.span = 1 + change.new / 100

    text.value = percentage()
    text.observe(enter, "value")
    panes.observe(lambda change: setattr(text, "value", percentage()), "span")
    fit.on_click(lambda _: panes.set_trait("span", RatioColouring.of(panes.shown.ratio).span))
    return HBox([text, fit])


def _exaggeration(pane: SectionPane) -> BoundedFloatText:
    """Field of the vertical exaggeration to three digits; showing it rounded does not change the pane's own."""
    text = BoundedFloatText(min=0.01, max=1000, step=0.1, description="vertical exagg. (×)", **LOOK)

    def rounded() -> float:
        return float(f"{pane.exaggeration:.3g}")

    def enter(change: Bunch) -> None:
        if change.new != rounded():
            pane.exaggeration = change.new

    text.value = rounded()
    text.observe(enter, "value")
    pane.observe(lambda change: setattr(text, "value", rounded()), "exaggeration")
    return text


class SolverControls(VBox):
    """The mesh spacing and the solver of a workspace's plan.

    Parameters
    ----------
    workspace : Workspace

    Attributes
    ----------
    spacing : float or None
        Mesh spacing, in metres of rock; None for the default of about 2,500 vertices.
    solver : {"gauss-newton", "fixed-point"}
    slider, default_button : FloatLogSlider, Button
        Controls of the spacing.
    """

    spacing = Float(default_value=None, allow_none=True)
    solver = Enum(tuple(MOST_ITERATIONS), "gauss-newton")

    def __init__(self, workspace: Workspace):
        self._workspace = workspace
        self.slider = FloatLogSlider(description="mesh spacing (m)", layout=Layout(flex="1"), style=STYLE, step=0.01)
        self.slider.readout_format = ".3g"
        self.default_button = Button(
            icon="undo", tooltip="default spacing, for about 2,500 vertices", layout=Layout(width="36px")
        )
        solver = Dropdown(options=[(name, key) for key, name in SOLVERS.items()], description="solver", **LOOK)
        super().__init__([HBox([self.slider, self.default_button]), solver])
        bind(self, "spacing", workspace, lambda document: document.plan.spacing, self._change_spacing)
        bind(self, "solver", workspace, lambda document: document.plan.solver, self._change_solver)
        bind_control(self, "solver", solver)
        workspace.observe(self._take_document, "document")
        self.observe(lambda change: self._show(), "spacing")
        self._show()
        self.slider.observe(self._take_slider, "value")
        self.default_button.on_click(lambda _: self.set_trait("spacing", None))

    def _change_spacing(self, spacing: float | None) -> None:
        self._workspace.change_plan("mesh spacing", spacing=spacing)

    def _change_solver(self, solver: str) -> None:
        self._workspace.change_plan("solver", solver=solver)

    def _take_document(self, change: Bunch) -> None:
        if change.old.section is not change.new.section:
            self._show()

    def _take_slider(self, change: Bunch) -> None:
        moved = abs(math.log10(change.new / (self.spacing or self._default_spacing())))
        if moved > 0.501 * self.slider.step:  # less is the page rounding the value it was given
            self.spacing = change.new

    def _default_spacing(self) -> float:
        return Restoration(self._workspace.section).domain.spacing

    def _show(self) -> None:
        default = self._default_spacing()
        value = self.spacing or default
        low = math.log10(min(default / RANGE, value))
        high = math.log10(max(default * RANGE, value))
        slider = self.slider
        slider.min, slider.max = min(slider.min, low), max(slider.max, high)  # both values must be in the range
        slider.value = value
        slider.min, slider.max = low, high


def _colours_index(name: str) -> int:
    return COLOURS.index(name) if name in COLOURS else -1
