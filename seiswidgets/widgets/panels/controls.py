"""Controls of how sections are shown and how they are solved."""

import math

from ipywidgets import BoundedFloatText, Button, Checkbox, Dropdown, FloatLogSlider, FloatSlider, HBox, Layout, VBox
from traitlets import Enum, Float, observe

from seiswidgets.geology.restoration import Restoration
from seiswidgets.geology.section import Section
from seiswidgets.geology.solve import MOST_ITERATIONS
from seiswidgets.widgets.linked_panes import LinkedPanes
from seiswidgets.widgets.ties import tie

COLOURS = ("greys", "red-white-blue", "seismic", "bwr", "PuOr", "BrBG", "Spectral", "cividis")
POLARITIES = [("normal: peaks are positive", 1), ("reversed", -1)]
SOLVERS = {"gauss-newton": "Gauss-Newton (ours)", "fixed-point": "fixed point (the paper's)"}
RANGE = 4.0  # times the usual mesh spacing, either way
WIDE, STYLE = Layout(width="auto"), {"description_width": "130px"}


class DisplayControls(VBox):
    """How two linked panes show their sections.

    Parameters
    ----------
    panes : LinkedPanes
    """

    def __init__(self, panes: LinkedPanes):
        first = panes.original
        colours = Dropdown(options=sorted({*COLOURS, first.colours}, key=_place), description="colours")
        rows = [
            (first, "colours", colours),
            (first, "clip", FloatSlider(min=50, max=100, step=0.5, description="clip (percentile)")),
            (first, "gain", FloatLogSlider(min=-1, max=1, step=0.02, description="gain", readout_format=".2f")),
            (first, "polarity", Dropdown(options=POLARITIES, description="polarity")),
            (panes, "deformation", FloatSlider(min=0, max=1, step=0.05, description="deformation")),
            (panes, "mesh", FloatSlider(min=0, max=1, step=0.05, description="mesh")),
            (panes, "zoom_linked", Checkbox(description="both panes zoom together", indent=False)),
        ]
        for owner, name, widget in rows:
            widget.layout, widget.style = WIDE, STYLE
            tie(owner, name, widget)
        super().__init__([_exaggeration(first), *(widget for _, _, widget in rows)])


def _exaggeration(pane):
    """The vertical exaggeration, to three digits; the pane's own is changed only by who types another."""
    text = BoundedFloatText(min=0.01, max=1000, step=0.1, description="vertical exagg. (×)", layout=WIDE, style=STYLE)

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
    """The mesh spacing and the solver.

    Parameters
    ----------
    section : Section
        Whose usual mesh spacing is in the middle of the slider.

    Attributes
    ----------
    spacing : float or None
        Of the mesh, in metres of rock; None for that of about 2,500 vertices.
    solver : {"gauss-newton", "fixed-point"}
    """

    spacing = Float(None, allow_none=True)
    solver = Enum(tuple(MOST_ITERATIONS), "gauss-newton")

    def __init__(self, section: Section, **settings):
        self._slider = FloatLogSlider(description="mesh spacing (m)", layout=Layout(flex="1"), style=STYLE, step=0.01)
        self._slider.readout_format = ".3g"
        self._usual = Button(
            icon="undo", tooltip="the usual spacing, of about 2,500 vertices", layout=Layout(width="36px")
        )
        solver = Dropdown(options=[(name, key) for key, name in SOLVERS.items()], description="solver", layout=WIDE)
        solver.style = STYLE
        self._quiet = False
        self.take(section)
        super().__init__([HBox([self._slider, self._usual]), solver], **settings)
        tie(self, "solver", solver)
        self._slider.observe(self._on_slider, "value")
        self._usual.on_click(lambda _: self.set_trait("spacing", None))

    def take(self, section: Section) -> None:
        """Take the usual spacing of another section as the slider's middle."""
        self._middle = Restoration(section).domain.spacing
        self._show()

    def _on_slider(self, change):
        moved = abs(math.log10(change.new) - math.log10(self.spacing or self._middle))
        if not self._quiet and moved > 0.501 * self._slider.step:  # else the page has but rounded what it was given
            self.spacing = change.new

    @observe("spacing")
    def _show(self, change=None):
        value = self.spacing or self._middle
        self._quiet = True
        try:
            low, high = (math.log10(self._middle * factor) for factor in (1 / RANGE, RANGE))
            self._slider.max = max(self._slider.max, high)  # first: the other end must never lie beyond it
            self._slider.min, self._slider.max = low, high
            self._slider.value = value
        finally:
            self._quiet = False


def _place(name):
    return COLOURS.index(name) if name in COLOURS else -1
