"""The steps of a restoration, in a list: add, reorder, switch off, remove."""

from collections.abc import Callable, Iterable
from dataclasses import replace
from functools import partial
from html import escape
from typing import Any

import numpy as np
from ipywidgets import HTML, Button, Checkbox, Dropdown, HBox, Layout, Text, VBox
from traitlets import Bunch, Instance, Tuple, Unicode, observe, validate

from seiswidgets.errors import SettingError
from seiswidgets.geology import validation
from seiswidgets.geology.beyond import FREE, KEEP, LEVEL, TREND
from seiswidgets.geology.picks import Fault, Horizon, Interpretation
from seiswidgets.geology.plan import Plan
from seiswidgets.geology.stage import STRIP, UNERODE
from seiswidgets.geology.steps import FLATTEN, KINDS, UNFAULT, Step
from seiswidgets.geology.vertical_shear import LENGTH, VERTICAL_SHEAR
from seiswidgets.widgets.closing import WithParts
from seiswidgets.widgets.key_guard import KeyGuard

ALL = {UNFAULT: "all faults", FLATTEN: "first horizon", STRIP: "first horizon"}  # what a step without picks works on
ADDED = {kind: Step(kind, datum=0.0 if kind == UNERODE else None) for kind in KINDS}
WITH_DATUM = (FLATTEN, UNERODE)
SHEARS = {LENGTH: "keep its length", VERTICAL_SHEAR: "vertical shear"}
BEYOND_ENDS = {
    FREE: "the rest turns with it",
    KEEP: "keep: the rest stays",
    LEVEL: "level: extend it level",
    TREND: "trend: extend it along its trend",
}
ICONS = {"up": "arrow-up", "down": "arrow-down", "remove": "trash"}
TOOLTIPS = {"up": "Do this step earlier", "down": "Do this step later", "remove": "Remove this step"}
ALERT = '<span role="alert" style="color: var(--jp-error-color1, #b71c1c)">{}</span>'


class StepRow(VBox):
    """Controls of one step.

    Attributes
    ----------
    step : Step
    interpretation : Interpretation
        Faults and horizons to choose from.
    z_unit : str
        Unit of the datum.
    enabled, choice, datum, beyond, by, age : Checkbox, Dropdown, Text, Dropdown, Dropdown, Text
    up, down, remove : Button
        Buttons that the list acts on.
    error : HTML
        Why a datum was refused.
    """

    step = Instance(Step)
    interpretation = Instance(Interpretation)
    z_unit = Unicode("m")

    def __init__(self, step: Step, interpretation: Interpretation, z_unit: str):
        self.enabled = Checkbox(indent=False, tooltip="Do this step", layout=Layout(width="84px"))
        self.choice = Dropdown(
            tooltip="Picks that this step works on", layout=Layout(width="auto", min_width="96px", flex="1 1 96px")
        )
        self.datum = Text(
            placeholder="mean level",
            tooltip="Level to flatten to; if empty, the horizon's mean level",
            continuous_update=False,  # or a half-typed number would be used
            style={"description_width": "initial"},
            layout=Layout(width="176px"),
        )
        self.beyond = Dropdown(
            options=[(label, choice) for choice, label in BEYOND_ENDS.items()],
            description="beyond its ends",
            tooltip="What happens to the rock beyond the ends of a horizon that does not cross the section",
            style={"description_width": "initial"},
            layout=Layout(width="auto", min_width="0", max_width="100%"),
        )
        self.by = Dropdown(
            options=[(label, choice) for choice, label in SHEARS.items()],
            tooltip="How the horizon is brought to its level",
            layout=Layout(width="140px"),
        )
        self.age = Text(
            placeholder="age",
            description="Ma",
            tooltip="Age of the section after this step, in Ma; may be empty",
            continuous_update=False,
            style={"description_width": "initial"},
            layout=Layout(width="100px"),
        )
        self.error = HTML(layout=Layout(display="none"))
        self.up, self.down, self.remove = (_button(name) for name in ICONS)
        self.enabled.observe(lambda change: self._change(on=change.new), "value")
        self.choice.observe(lambda change: self._change(picks=change.new), "value")
        self.datum.observe(self._take_datum, "value")
        self.beyond.observe(lambda change: self._change(beyond=change.new), "value")
        self.by.observe(lambda change: self._change(by=change.new), "value")
        self.age.observe(self._take_age, "value")
        fields = [self.enabled, self.choice, self.datum, self.by, self.beyond, self.age]
        controls = [*fields, self.up, self.down, self.remove]
        line = HBox(controls, layout=Layout(flex_flow="row wrap"))
        super().__init__([line, self.error], step=step, interpretation=interpretation, z_unit=z_unit)

    def _change(self, **changes: Any) -> None:
        self.step = replace(self.step, **changes)

    def _take_datum(self, change: Bunch) -> None:
        text = change.new.strip()
        if text == _datum_value(self.step):
            return
        if not text and self.step.kind == UNERODE:
            self._show_error(f"Unerode needs a depth. {self._datum_text()} is kept.")
            return
        try:
            datum = validation.finite_number("datum", text) if text else None
        except SettingError as error:
            self._show_error(f"{error}; leave it empty for the mean level. {self._datum_text()} is kept.")
        else:
            self._show_error("")
            self._change(datum=datum)

    def _take_age(self, change: Bunch) -> None:
        text = change.new.strip()
        try:
            age = validation.finite_number("age", text) if text else None
        except SettingError as error:
            self._show_error(f"{error}; leave it empty if it is not known.")
        else:
            self._show_error("")
            self._change(age=age)

    def _datum_text(self) -> str:
        return "The mean level" if self.step.datum is None else f"{_datum_value(self.step)} {self.z_unit}"

    def _show_error(self, text: str) -> None:
        self.error.value = ALERT.format(escape(text)) if text else ""
        self.error.layout.display = "" if text else "none"

    @observe("step", "interpretation", "z_unit")
    def _show(self, change: Bunch) -> None:
        self.enabled.description, self.enabled.value = self.step.kind, self.step.on
        self._offer_picks()
        self.datum.description = f"datum ({self.z_unit})"
        kind, is_flat = self.step.kind, self.step.kind == FLATTEN
        in_time = self.step.age is not None or kind not in (UNFAULT, FLATTEN)
        shown = {
            self.choice: kind in ALL,
            self.datum: kind in WITH_DATUM,
            self.beyond: is_flat and self.step.by == LENGTH,
            self.by: is_flat and (in_time or self.step.by != LENGTH),
            self.age: in_time,
        }
        for control, is_shown in shown.items():
            control.layout.display = "" if is_shown else "none"
        self.beyond.value, self.by.value = self.step.beyond, self.step.by
        if change.name == "step" and change.new != change.old:  # else a datum may be half typed
            self.datum.value = _datum_value(self.step)
            self.datum.placeholder = "profile" if isinstance(self.step.datum, tuple) else "mean level"
            self.age.value = "" if self.step.age is None else _exact(self.step.age)
            self._show_error("")

    def _offer_picks(self) -> None:
        """Offer the picks to choose from, and the step's own choice even if those picks are missing."""
        step, all_picks = self.step, self.interpretation
        if step.kind not in ALL:
            return
        picks: Iterable[Fault | Horizon] = all_picks.faults if step.kind == UNFAULT else all_picks.horizons
        names = [pick.name for pick in picks]
        options = [(ALL[step.kind], ()), *((name, (name,)) for name in names)]
        if step.picks not in [chosen for _, chosen in options]:
            options.append((_label(step.picks, names), step.picks))
        if self.choice.options == tuple(options) and self.choice.value == step.picks:
            return
        with self.hold_trait_notifications(), self.choice.hold_sync():
            self.choice.options = options  # selects the first one: a change of the step that the next line undoes
            self.choice.value = step.picks


class StepList(WithParts, VBox):
    """The steps of a plan, one per row: on or off, its picks, its datum, and buttons to move and remove it.

    With the keyboard: Tab goes through a row's controls and on to the next row, Space or Enter presses a button; the
    focus follows a step that is moved. Enter, or leaving the field, accepts a datum.

    Parameters
    ----------
    steps : sequence of Step, optional
        If left out: unfault, then flatten.
    **settings
        Initial values of the other attributes.

    Attributes
    ----------
    steps : tuple of Step
        May be set.
    interpretation : Interpretation
        Faults and horizons to choose from. A step keeps picks that are not among them, and shows them as missing.
    z_unit : str
        Unit of the datum.
    rows : tuple of StepRow
        Rows of the steps.
    add_buttons : dict of str to Button
        Buttons that add a step, by its kind.

    Raises
    ------
    SettingError
        If a step is not a `Step`.
    TypeError
        If a keyword argument does not exist.
    """

    steps = Tuple()
    interpretation = Instance(Interpretation, ())
    z_unit = Unicode("m")

    def __init__(self, steps: Iterable[Step] | None = None, **settings: Any):
        self.check_settings(settings)
        self._rows: list[StepRow] = []  # spare ones of removed steps included
        self._table = VBox()
        self.add_buttons = {kind: _add_button(kind, self._add) for kind in KINDS}
        adders = HBox(list(self.add_buttons.values()), layout=Layout(flex_flow="row wrap"))
        super().__init__([KeyGuard(), self._table, adders], **settings)
        self.steps = Plan().steps if steps is None else tuple(steps)

    @property
    def rows(self) -> tuple[StepRow, ...]:
        """Rows of the steps."""
        return self._table.children

    @validate("steps")
    def _valid_steps(self, proposal: Bunch) -> tuple:
        wrong = [step for step in proposal.value if not isinstance(step, Step)]
        if wrong:
            raise SettingError(f"steps must be seiswidgets.Step, but one is {wrong[0]!r}")
        return proposal.value

    @observe("steps")
    def _show_steps(self, change: Bunch) -> None:
        """Show the steps in the existing rows, so that the focus stays where it is."""
        for row, step in zip(self._rows, self.steps, strict=False):
            row.step = step
        self._rows += [self._make_row(step) for step in self.steps[len(self._rows) :]]
        self._table.children = shown = self._rows[: len(self.steps)]
        for row in shown:
            row.up.disabled, row.down.disabled = row is shown[0], row is shown[-1]

    @observe("interpretation", "z_unit")
    def _pass_on(self, change: Bunch) -> None:
        for row in self._rows:
            setattr(row, change.name, change.new)

    def _make_row(self, step: Step) -> StepRow:
        row = StepRow(step, self.interpretation, self.z_unit)
        row.observe(partial(self._take_step, row), "step")
        row.up.on_click(lambda _: self._move(row, -1))
        row.down.on_click(lambda _: self._move(row, 1))
        row.remove.on_click(lambda _: self._remove(row))
        return row

    def _take_step(self, row: StepRow, change: Bunch) -> None:
        index = self._rows.index(row)
        if index < len(self.steps):  # else the row is a spare one
            self.steps = (*self.steps[:index], row.step, *self.steps[index + 1 :])

    def _add(self, kind: str) -> None:
        self.steps = (*self.steps, ADDED[kind])

    def _move(self, row: StepRow, offset: int) -> None:
        index = self._rows.index(row)
        steps = list(self.steps)
        steps.insert(index + offset, steps.pop(index))
        self.steps = tuple(steps)
        moved = self._rows[index + offset]
        buttons = (moved.up, moved.down) if offset < 0 else (moved.down, moved.up)
        next(button for button in buttons if not button.disabled).focus()

    def _remove(self, row: StepRow) -> None:
        index = self._rows.index(row)
        self.steps = (*self.steps[:index], *self.steps[index + 1 :])
        next_row = self._rows[min(index, len(self.steps) - 1)]
        (next_row.remove if self.steps else self.add_buttons[UNFAULT]).focus()


def _label(picks: Iterable[str], names: list[str]) -> str:
    return ", ".join(name if name in names else f"missing: {name}" for name in picks)


def _datum_value(step: Step) -> str:
    """Text of a step's datum; empty for none, and for a profile."""
    return "" if step.datum is None or isinstance(step.datum, tuple) else _exact(step.datum)


def _exact(value: float) -> str:
    """Write a number in plain decimals without losing digits."""
    return np.format_float_positional(value, trim="-")


def _button(name: str) -> Button:
    return Button(icon=ICONS[name], tooltip=TOOLTIPS[name], layout=Layout(width="32px", flex="0 0 auto"))


def _add_button(kind: str, add: Callable[[str], None]) -> Button:
    button = Button(description=f"Add {kind}", icon="plus", tooltip=f"Add a step at the end: {kind}")
    button.on_click(lambda _: add(kind))
    return button
