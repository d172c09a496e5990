"""Controls of how sections are shown and how they are solved."""

import math

from ipywidgets import BoundedFloatText, Button, Checkbox, Dropdown, FloatLogSlider, FloatSlider, HBox, Layout, VBox
from traitlets import Enum, Float

from seiswidgets.geology.restoration import Restoration
from seiswidgets.geology.solve import MOST_ITERATIONS
from seiswidgets.widgets.binding import bind, bind_control
from seiswidgets.widgets.linked_panes import LinkedPanes
from seiswidgets.widgets.workspace import Workspace

COLOURS = ("greys", "red-white-blue", "seismic", "bwr", "PuOr", "BrBG", "Spectral", "cividis")
POLARITIES = [("normal: peaks are positive", 1), ("reversed", -1)]
SOLVERS = {"gauss-newton": "Gauss-Newton (ours)", "fixed-point": "fixed point (the paper's)"}
RANGE = 4.0  # times the usual mesh spacing, either way
STYLE = {"description_width": "130px"}
LOOK = {"layout": {"width": "auto"}, "style": STYLE}  # as dicts: a Layout made here would be shared by all apps


class DisplayControls(VBox):
    """How two linked panes show their sections.

    Parameters
    ----------
    panes : LinkedPanes
    """

    def __init__(self, panes: LinkedPanes):
        first = panes.original
        colours = sorted({*COLOURS, first.colours}, key=_place)
        rows = [
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
        super().__init__([_exaggeration(first), *(widget for _, _, widget in rows)])


def _exaggeration(pane):
    """The vertical exaggeration, to three digits; the pane's own is changed only by who types another."""
    text = BoundedFloatText(min=0.01, max=1000, step=0.1, description="vertical exagg. (×)", **LOOK)

    def rounded():
        return float(f"{pane.exaggeration:.3g}")

    def enter(change):
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
        Of the mesh, in metres of rock; None for that of about 2,500 vertices.
    solver : {"gauss-newton", "fixed-point"}
    """

    spacing = Float(None, allow_none=True)
    solver = Enum(tuple(MOST_ITERATIONS), "gauss-newton")

    def __init__(self, workspace: Workspace):
        self._workspace = workspace
        self._slider = FloatLogSlider(description="mesh spacing (m)", layout=Layout(flex="1"), style=STYLE, step=0.01)
        self._slider.readout_format = ".3g"
        self._usual = Button(
            icon="undo", tooltip="the usual spacing, of about 2,500 vertices", layout=Layout(width="36px")
        )
        solver = Dropdown(options=[(name, key) for key, name in SOLVERS.items()], description="solver", **LOOK)
        super().__init__([HBox([self._slider, self._usual]), solver])
        bind(self, "spacing", workspace, lambda document: document.plan.spacing, self._change_spacing)
        bind(self, "solver", workspace, lambda document: document.plan.solver, self._change_solver)
        bind_control(self, "solver", solver)
        workspace.observe(self._take_document, "document")
        self.observe(lambda change: self._show(), "spacing")
        self._show()
        self._slider.observe(self._on_slider, "value")
        self._usual.on_click(lambda _: self.set_trait("spacing", None))

    def _change_spacing(self, spacing):
        self._workspace.change_plan("mesh spacing", spacing=spacing)

    def _change_solver(self, solver):
        self._workspace.change_plan("solver", solver=solver)

    def _take_document(self, change):
        if change.old.section is not change.new.section:
            self._show()

    def _on_slider(self, change):
        moved = abs(math.log10(change.new / self._value()))
        if moved > 0.501 * self._slider.step:  # less is the page's rounding of the value it was given
            self.spacing = change.new

    def _value(self):
        return self.spacing or Restoration(self._workspace.section).domain.spacing

    def _show(self):
        value, usual = self._value(), Restoration(self._workspace.section).domain.spacing
        low = math.log10(min(usual / RANGE, value))
        high = math.log10(max(usual * RANGE, value))
        slider = self._slider
        slider.min, slider.max = min(slider.min, low), max(slider.max, high)  # holds the old value and the new one
        slider.value = value
        slider.min, slider.max = low, high


def _place(name):
    return COLOURS.index(name) if name in COLOURS else -1
