"""The stratigraphy of a section in a table, and the plan of a sequential restoration made from it."""

import contextlib
from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import partial
from html import escape
from typing import Any

from ipywidgets import HTML, Button, Checkbox, Dropdown, FloatText, HBox, Layout, Text, VBox
from traitlets import Bunch, Instance, observe

from seiswidgets.errors import SeiswidgetsError
from seiswidgets.geology import validation
from seiswidgets.geology.flexure import Isostasy
from seiswidgets.geology.lithology import LITHOLOGIES
from seiswidgets.geology.picks import Horizon
from seiswidgets.geology.plan import Plan
from seiswidgets.geology.sequence import FaultActivity
from seiswidgets.geology.stratigraphy import Layer, Stratigraphy
from seiswidgets.widgets.key_guard import KeyGuard
from seiswidgets.widgets.messages import HINT, TROUBLE
from seiswidgets.widgets.workspace import Workspace

TOP = "top of the section"
STEP_OF_AGE = 5.0  # Ma, between two tops that a table is begun with
EXPLAINED = (
    "Layers from young to old: the horizon at the top, its age (Ma), the rock below it, and the depth of the water "
    "when it was the sea floor. Sequence replaces the steps: it strips, unfaults, expands and flattens layer by layer."
)
NARROW = {"width": "92px"}


class LayerRow(HBox):
    """Controls of one layer.

    Attributes
    ----------
    layer : Layer
    top, rock : Dropdown
    age : FloatText
    water : Text
        A number, or "profile" for a palaeobathymetry that was set from code.
    remove : Button
    """

    layer = Instance(Layer)

    def __init__(
        self, layer: Layer, tops: Sequence[str], z_unit: str, change: Callable[["LayerRow", Callable[[], Layer]], None]
    ):
        self._change, self._tops = change, tuple(tops)
        self.top = Dropdown(tooltip="Horizon at the top of the layer", layout=Layout(width="140px"))
        self.age = FloatText(step=1, tooltip="Age of the top, in Ma", layout=Layout(**NARROW))
        self.rock = Dropdown(tooltip="Rock of the layer", layout=Layout(width="130px"))
        self.water = Text(
            tooltip=f"Depth of the water at deposition ({z_unit})", continuous_update=False, layout=Layout(**NARROW)
        )
        self.remove = Button(icon="trash", tooltip="Remove this layer", layout=Layout(width="32px"))
        super().__init__([self.top, self.age, self.rock, self.water, self.remove], layer=layer)
        self.age.observe(lambda event: self._set(age=event.new), "value")
        self.water.observe(self._set_water, "value")

    @observe("layer")
    def _show(self, change: Bunch) -> None:
        layer = self.layer
        rock = layer.rock.name or "own"
        tops, rocks = dict.fromkeys([None, *self._tops, layer.top]), dict.fromkeys([*LITHOLOGIES, rock])
        _offer(self.top, [(name or TOP, name) for name in tops], layer.top, self._set_top)
        _offer(self.rock, [(name, name) for name in rocks], rock, self._set_rock)
        self.age.value = layer.age
        self.water.value = "profile" if isinstance(layer.water_depth, tuple) else f"{layer.water_depth:g}"

    def _set_top(self, change: Bunch) -> None:
        self._set(top=change.new)

    def _set_rock(self, change: Bunch) -> None:
        if change.new in LITHOLOGIES and change.new != self.layer.rock.name:
            self._set(lithology=LITHOLOGIES[change.new])

    def _set_water(self, change: Bunch) -> None:
        text = change.new.strip() or "0"
        if text != "profile" and text != f"{self.layer.water_depth}":
            self._change(self, partial(_with_water, self.layer, text))

    def _set(self, **changes: Any) -> None:
        if any(getattr(self.layer, name) != value for name, value in changes.items()):
            self._change(self, partial(replace, self.layer, **changes))


def _with_water(layer: Layer, text: str) -> Layer:
    return replace(layer, water_depth=validation.finite_number("water_depth", text))


class StratigraphyPanel(VBox):
    """The layers of a workspace's plan in a table, and a button that makes the steps of a sequential restoration.

    Each change of the table is one edit. What cannot be is said below the table, and nothing is lost: the row stays as
    it was entered until it makes sense.

    Parameters
    ----------
    workspace : Workspace

    Attributes
    ----------
    rows : tuple of LayerRow
    begin, add, sequence : Button
    decompact, isostasy : Checkbox
    elastic_thickness : FloatText
        In km.
    message, activity : HTML
    """

    def __init__(self, workspace: Workspace):
        self._workspace = workspace
        self.message, self.activity = HTML(), HTML()
        self._table = VBox()
        self.begin = _button("From horizons", "Fill the table with all horizons, by their depth", self._begin)
        self.add = _button("Add layer", "Add a layer below the last one", self._add)
        self.sequence = _button("Sequence", "Replace the steps by those of a sequential restoration", self._sequence)
        self.decompact = Checkbox(value=True, description="decompact", indent=False, layout=Layout(width="110px"))
        self.isostasy = Checkbox(value=False, description="isostasy", indent=False, layout=Layout(width="100px"))
        self.elastic_thickness = FloatText(
            value=0.0,
            description="elastic thickness (km)",
            tooltip="Effective elastic thickness of the crust; 0 is Airy isostasy",
            style={"description_width": "initial"},
            layout=Layout(width="230px"),
        )
        look = Layout(flex_flow="row wrap")
        buttons = HBox([self.begin, self.add, self.sequence], layout=look)
        choices = HBox([self.decompact, self.isostasy, self.elastic_thickness], layout=look)
        hint = HTML(HINT.format(EXPLAINED))
        super().__init__([KeyGuard(), hint, self._table, self.message, buttons, choices, self.activity])
        workspace.observe(self._take_document, "document")
        self._show()

    @property
    def rows(self) -> tuple[LayerRow, ...]:
        """Rows of the layers."""
        return self._table.children

    @property
    def _layers(self) -> tuple[Layer, ...]:
        stratigraphy = self._workspace.plan.stratigraphy
        return tuple(stratigraphy.layers) if stratigraphy else ()

    def _take_document(self, change: Bunch) -> None:
        old, new = change.old, change.new
        if (
            old.plan.stratigraphy != new.plan.stratigraphy
            or old.drawing.interpretation is not new.drawing.interpretation
        ):
            self._show()

    def _show(self) -> None:
        """Show the layers of the plan, in the rows that are there."""
        interpretation, section = self._workspace.interpretation, self._workspace.section
        tops = tuple(horizon.name for horizon in interpretation.horizons)
        layers, rows = self._layers, list(self.rows)
        if len(rows) != len(layers) or any(row._tops != tops for row in rows):
            for row in rows:
                row.close()
            self._table.children = [self._row(layer, tops, section.z_unit) for layer in layers]
        else:
            for row, layer in zip(rows, layers, strict=True):
                row.layer = layer
        self.add.disabled = self.sequence.disabled = not layers
        self.message.value = ""
        self.activity.value = self._activity_table()

    def _row(self, layer: Layer, tops: Sequence[str], z_unit: str) -> LayerRow:
        row = LayerRow(layer, tops, z_unit, self._change)
        row.remove.on_click(lambda _: self._remove(row))
        return row

    def _activity_table(self) -> str:
        if not self._layers:
            return ""
        try:
            activity = FaultActivity.of(Stratigraphy(self._layers), self._workspace.interpretation)
        except SeiswidgetsError as error:
            return TROUBLE.format(escape(str(error)))
        return activity._repr_html_() if activity.movements else ""

    def _edit(self, label: str, make: Callable[[], Sequence[Layer]]) -> None:
        """Replace the layers as one edit, or say why they cannot be."""
        try:
            layers = make()
            stratigraphy = Stratigraphy(layers) if layers else None
        except SeiswidgetsError as error:
            self.message.value = TROUBLE.format(escape(str(error)))
            return
        self.message.value = ""
        self._workspace.change_plan(label, stratigraphy=stratigraphy)

    def _change(self, row: LayerRow, make: Callable[[], Layer]) -> None:
        index = self.rows.index(row)
        self._edit("stratigraphy", lambda: [*self._layers[:index], make(), *self._layers[index + 1 :]])

    def _remove(self, row: LayerRow) -> None:
        index = self.rows.index(row)
        self._edit("remove a layer", lambda: [*self._layers[:index], *self._layers[index + 1 :]])

    def _add(self, _: Button) -> None:
        used = {layer.top for layer in self._layers}
        free = [pick.name for pick in by_depth(self._workspace.interpretation.horizons) if pick.name not in used]
        if not free:
            self.message.value = TROUBLE.format("every horizon is the top of a layer already; draw another one")
            return
        age = self._layers[-1].age + STEP_OF_AGE
        self._edit("add a layer", lambda: [*self._layers, Layer(free[0], age)])

    def _begin(self, _: Button) -> None:
        horizons = by_depth(self._workspace.interpretation.horizons)
        if not horizons:
            self.message.value = TROUBLE.format("there is no horizon yet; draw the tops of the layers first")
            return
        layers = [Layer(None, 0.0)]
        layers += [Layer(pick.name, STEP_OF_AGE * count) for count, pick in enumerate(horizons, 1)]
        self._edit("stratigraphy from horizons", lambda: layers)

    def _sequence(self, _: Button) -> None:
        plan = self._workspace.plan
        try:
            thickness = 1000 * self.elastic_thickness.value
            crust = Isostasy(elastic_thickness=thickness) if self.isostasy.value else None
            sequence = Plan.sequential(
                Stratigraphy(self._layers),
                self._workspace.interpretation,
                decompact=self.decompact.value,
                isostasy=crust,
            )
        except SeiswidgetsError as error:
            self.message.value = TROUBLE.format(escape(str(error)))
            return
        self.message.value = ""
        self._workspace.edit("sequence", plan=replace(plan, steps=sequence.steps, isostasy=sequence.isostasy))


def _offer(
    choice: Dropdown, options: Sequence[tuple[str, str | None]], value: str | None, take: Callable[[Bunch], None]
) -> None:
    """Set the options and the value of a choice, and have its later changes taken."""
    with contextlib.suppress(KeyError, ValueError):  # nothing is observed at first
        choice.unobserve(take, "value")  # new options select the first one for a moment
    choice.options, choice.value = options, value
    choice.observe(take, "value")


def by_depth(horizons: Sequence[Horizon]) -> list[Horizon]:
    """Horizons from the shallowest to the deepest, by their mean depth."""
    return sorted(
        horizons, key=lambda pick: sum(piece[:, 1].sum() for piece in pick.pieces) / sum(map(len, pick.pieces))
    )


def _button(label: str, tooltip: str, action: Callable[[Button], None]) -> Button:
    button = Button(description=label, tooltip=tooltip, layout=Layout(width="auto"))
    button.on_click(action)
    return button
