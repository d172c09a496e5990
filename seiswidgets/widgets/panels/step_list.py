"""The steps of a restoration, in a list that can be added to, reordered and switched off."""

from dataclasses import replace
from functools import partial
from html import escape

import numpy as np
from ipywidgets import HTML, Button, Checkbox, Dropdown, HBox, Layout, Text, VBox
from traitlets import Instance, Tuple, Unicode, observe, validate

from seiswidgets.errors import SettingError
from seiswidgets.geology import validation
from seiswidgets.geology.picks import Interpretation
from seiswidgets.geology.plan import FLATTEN, UNFAULT, Plan, Step
from seiswidgets.widgets.closing import WithParts
from seiswidgets.widgets.key_guard import KeyGuard

ALL = {UNFAULT: "all faults", FLATTEN: "first horizon"}  # what no picks mean
ICONS = {"up": "arrow-up", "down": "arrow-down", "remove": "trash"}
TIPS = {"up": "Do this step earlier", "down": "Do this step later", "remove": "Remove this step"}
ALERT = '<span role="alert" style="color: var(--jp-error-color1, #b71c1c)">{}</span>'


class StepRow(VBox):
    """One step, to be changed.

    Attributes
    ----------
    step : Step
    interpretation : Interpretation
        Whose faults or horizons there are to choose from.
    z_unit : str
        Of the datum.
    up, down, remove : Button
        What they do is the list's affair.
    """

    step = Instance(Step)
    interpretation = Instance(Interpretation)
    z_unit = Unicode("m")

    def __init__(self, step: Step, interpretation: Interpretation, z_unit: str):
        self._on = Checkbox(indent=False, tooltip="Whether this step is done", layout=Layout(width="84px"))
        self._choice = Dropdown(
            tooltip="What it works on", layout=Layout(width="auto", min_width="96px", flex="1 1 96px")
        )
        self._datum = Text(
            placeholder="mean level",
            tooltip="The level to flatten to; the horizon's mean level if empty",
            continuous_update=False,  # or a half-typed number would be restored to
            style={"description_width": "initial"},
            layout=Layout(width="176px"),
        )
        self._error = HTML(layout=Layout(display="none"))
        self.up, self.down, self.remove = (_button(name) for name in ICONS)
        self._on.observe(lambda change: self._change(on=change.new), "value")
        self._choice.observe(self._choose, "value")
        self._datum.observe(self._enter, "value")
        controls = [self._on, self._choice, self._datum, self.up, self.down, self.remove]
        line = HBox(controls, layout=Layout(flex_flow="row wrap"))
        super().__init__([line, self._error], step=step, interpretation=interpretation, z_unit=z_unit)

    def _change(self, **changes):
        self.step = replace(self.step, **changes)

    def _choose(self, change):
        self._change(picks=change.new)

    def _enter(self, change):
        text = change.new.strip()
        try:
            datum = validation.finite_number("datum", text) if text else None
        except SettingError as error:
            self._say(f"{error}; leave it empty for the mean level. {self._kept()} is kept.")
        else:
            self._say("")
            self._change(datum=datum)

    def _kept(self):
        return "The mean level" if self.step.datum is None else f"{_number(self.step.datum)} {self.z_unit}"

    def _say(self, error):
        self._error.value = ALERT.format(escape(error)) if error else ""
        self._error.layout.display = "" if error else "none"

    @observe("step", "interpretation", "z_unit")
    def _show(self, change):
        self._on.description, self._on.value = self.step.kind, self.step.on
        self._offer()
        self._datum.description = f"datum ({self.z_unit})"
        self._datum.layout.display = "" if self.step.kind == FLATTEN else "none"
        if change.name == "step":
            self._datum.value = "" if self.step.datum is None else _number(self.step.datum)
            self._say("")

    def _offer(self):
        """Fill in what there is to choose from, and the step's own choice, be it there or not."""
        picks = {UNFAULT: self.interpretation.faults, FLATTEN: self.interpretation.horizons}[self.step.kind]
        names = [pick.name for pick in picks]
        options = [(ALL[self.step.kind], ()), *((name, (name,)) for name in names)]
        if self.step.picks not in [picks for _, picks in options]:
            options.append((_label(self.step.picks, names), self.step.picks))
        self._choice.unobserve(self._choose, "value")  # with other options, a Dropdown goes through the first one
        with self._choice.hold_sync():
            if self._choice.options != tuple(options):
                self._choice.options = options
            self._choice.value = self.step.picks
        self._choice.observe(self._choose, "value")


class StepList(WithParts, VBox):
    """The steps of a plan, one a row: on or off, what it works on, the datum, and buttons to move and remove it.

    With the keyboard: Tab goes through a row's controls and on to the next, Space or Enter presses a button; the focus
    goes along with a step that is moved. A datum is taken by Enter or by leaving its field.

    Parameters
    ----------
    steps : sequence of Step, optional
        To unfault and then to flatten, if left out.

    Attributes
    ----------
    steps : tuple of Step
        May be set.
    interpretation : Interpretation
        Whose faults and horizons there are to choose from. A step whose picks are not among them keeps them, and is
        shown to miss them.
    z_unit : str
        Of the datum.

    Raises
    ------
    SettingError
        If a step is none.
    """

    steps = Tuple()
    interpretation = Instance(Interpretation, ())
    z_unit = Unicode("m")

    def __init__(self, steps=None, **traits):
        self._rows = []  # as many as there ever were steps
        self._table = VBox()
        adders = [_adder(kind, self._add) for kind in (UNFAULT, FLATTEN)]
        super().__init__([KeyGuard(), self._table, HBox(adders)], **traits)
        self._adder = adders[0]
        self.steps = Plan().steps if steps is None else tuple(steps)

    @validate("steps")
    def _valid_steps(self, proposal):
        wrong = [step for step in proposal.value if not isinstance(step, Step)]
        if wrong:
            raise SettingError(f"steps must be seiswidgets.Step, but one is {wrong[0]!r}")
        return proposal.value

    @observe("steps")
    def _show_steps(self, change):
        """Give the steps to the rows that are there, so that whoever is typing stays where they are."""
        for row, step in zip(self._rows, self.steps, strict=False):
            row.step = step
        self._rows += [self._new_row(step) for step in self.steps[len(self._rows) :]]
        self._table.children = shown = self._rows[: len(self.steps)]
        for row in shown:
            row.up.disabled, row.down.disabled = row is shown[0], row is shown[-1]

    @observe("interpretation", "z_unit")
    def _tell_rows(self, change):
        for row in self._rows:
            setattr(row, change.name, change.new)

    def _new_row(self, step):
        row = StepRow(step, self.interpretation, self.z_unit)
        row.observe(partial(self._take, row), "step")
        row.up.on_click(lambda _: self._move(row, -1))
        row.down.on_click(lambda _: self._move(row, 1))
        row.remove.on_click(lambda _: self._remove(row))
        return row

    def _take(self, row, change):
        number = self._rows.index(row)
        if number < len(self.steps) and self.steps[number] != row.step:  # else it is the row that follows the steps
            self.steps = (*self.steps[:number], row.step, *self.steps[number + 1 :])

    def _add(self, kind):
        self.steps = (*self.steps, Step(kind))

    def _move(self, row, way):
        number = self._rows.index(row)
        steps = list(self.steps)
        steps.insert(number + way, steps.pop(number))
        self.steps = tuple(steps)
        moved = self._rows[number + way]
        buttons = (moved.up, moved.down) if way < 0 else (moved.down, moved.up)
        next(button for button in buttons if not button.disabled).focus()

    def _remove(self, row):
        number = self._rows.index(row)
        self.steps = (*self.steps[:number], *self.steps[number + 1 :])
        next_row = self._rows[min(number, len(self.steps) - 1)]
        (next_row.remove if self.steps else self._adder).focus()


def _label(picks, names):
    return ", ".join(name if name in names else f"missing: {name}" for name in picks)


def _number(value):
    """A number as a person would write it, none of its digits lost."""
    return np.format_float_positional(value, trim="-")


def _button(name):
    return Button(icon=ICONS[name], tooltip=TIPS[name], layout=Layout(width="32px", flex="0 0 auto"))


def _adder(kind, add):
    button = Button(description=f"Add {kind}", icon="plus", tooltip=f"Add a step that will {kind}, at the end")
    button.on_click(lambda _: add(kind))
    return button
