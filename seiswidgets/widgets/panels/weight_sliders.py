"""Weights of the energy's terms, on sliders."""

from dataclasses import dataclass, replace
from functools import partial
from typing import Any

from ipywidgets import HTML, Button, FloatLogSlider, HBox, Label, Layout, VBox
from traitlets import Bunch, Instance, observe

from seiswidgets.geology.weights import Weights
from seiswidgets.widgets.closing import WithParts
from seiswidgets.widgets.key_guard import KeyGuard

LOWEST, HIGHEST = -2, 3  # powers of 10
STEP = 0.05  # of the power: twenty steps per factor of ten


@dataclass(frozen=True)
class Term:
    """A weight: its field in `Weights`, its symbol in the paper, a plain name, and a sentence about it."""

    field: str
    symbol: str
    name: str
    meaning: str


GROUPS = {
    "Shapes": (
        Term("mean_value", "α", "mean value", "How strongly the rock keeps its shape inside the blocks."),
        Term("contour", "β", "contour", "How strongly the outlines of the blocks keep their bends."),
        Term("edge", "γ", "edges", "How strongly lengths are kept, everywhere in the rock."),
    ),
    "Unfaulting": (
        Term("slide", "ζ", "slide", "How strongly the two sides of a fault stay in contact as they slide."),
        Term("rotation", "", "rotation", "How strongly blocks are kept from turning; 0 in the paper: not at all."),
        Term("stitch", "λ", "stitch", "How strongly the cut-offs of a horizon are brought together at a fault."),
    ),
    "Flattening": (
        Term("flatten", "ζ", "flatten", "How strongly the horizon is brought to its datum."),
        Term("length", "λ", "length", "How strongly the horizon keeps its length while it is flattened."),
        Term(
            "bedding", "", "bedding", "How freely beds slip past each other, as in flexural-slip folds; 0 in the paper."
        ),
    ),
}


class WeightSliders(WithParts, VBox):
    """Logarithmic sliders from 0.01 to 1,000, labelled with the paper's symbols, and a button that resets them.

    A weight set from code that is off its slider's scale, such as 0, is kept until that slider is moved. With the
    keyboard: Tab goes from slider to slider, arrows and Page Up and Down move one.

    Parameters
    ----------
    weights : Weights, optional

    Attributes
    ----------
    weights : Weights
        May be set.
    sliders, readouts : dicts of FloatLogSlider and of Label
        Controls of each weight, by its field in `Weights`.
    reset_button : Button

    Raises
    ------
    TypeError
        If a keyword argument does not exist.
    """

    weights = Instance(Weights)

    def __init__(self, weights: Weights | None = None, **traits: Any):
        self.check_settings(traits)
        self.sliders: dict[str, FloatLogSlider] = {}
        self.readouts: dict[str, Label] = {}
        groups = [_group(title, [self._row(term) for term in terms]) for title, terms in GROUPS.items()]
        self.reset_button = Button(description="Reset", tooltip="Set all weights to the paper's", icon="undo")
        self.reset_button.on_click(lambda _: self.set_trait("weights", Weights()))
        super().__init__([KeyGuard(), *groups, self.reset_button], **traits)
        self.weights = Weights() if weights is None else weights

    def _row(self, term: Term) -> HBox:
        slider = self.sliders[term.field] = FloatLogSlider(
            min=LOWEST,
            max=HIGHEST,
            step=STEP,
            readout=False,
            description=f"{term.symbol} {term.name}".strip(),
            tooltip=term.meaning,
            style={"description_width": "100px"},
            layout=Layout(flex="1 1 auto", width="auto", min_width="0"),
        )
        slider.observe(partial(self._move, term.field), "value")
        self.readouts[term.field] = Label(layout=Layout(flex="0 0 52px"))
        return HBox([slider, self.readouts[term.field]])

    def _move(self, name: str, change: Bunch) -> None:
        if change.new != _on_scale(getattr(self.weights, name)):  # else the slider shows the weight already
            self.weights = replace(self.weights, **{name: change.new})

    @observe("weights")
    def _show(self, change: Bunch) -> None:
        for name, slider in self.sliders.items():
            weight = getattr(self.weights, name)
            slider.value = _on_scale(weight)
            self.readouts[name].value = f"{weight:.3g}" if weight < 1000 else f"{weight:,.0f}"


def _on_scale(weight: float) -> float:
    return min(max(float(weight), 10.0**LOWEST), 10.0**HIGHEST)


def _group(title: str, rows: list[HBox]) -> VBox:
    return VBox([HTML(f"<b>{title}</b>"), *rows], layout=Layout(width="100%"))
