"""Conversion of the section and its picks from two-way time to depth, in the app's tab File."""

import re
from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import Any

import numpy as np
from ipywidgets import HTML, Button, Dropdown, HBox, Layout, Text, Textarea, VBox
from numpy.typing import ArrayLike

from seiswidgets.errors import SettingError
from seiswidgets.geology.picks import FAULT, HORIZON, Horizon
from seiswidgets.geology.plan import Plan
from seiswidgets.geology.section import Section
from seiswidgets.geology.slip_profile import SlipProfile
from seiswidgets.geology.stratigraphy import Profile
from seiswidgets.geology.validation import finite_number
from seiswidgets.geology.velocity import ConstantVelocity, LayerCake, LinearVelocity, TimeDepthTable, Velocity
from seiswidgets.interaction.alternatives import changed_alike
from seiswidgets.interaction.drawing import Drawing
from seiswidgets.widgets.files.question import Question
from seiswidgets.widgets.messages import HINT
from seiswidgets.widgets.workspace import Workspace

GRADIENT, TABLE, LAYERS, CONSTANT = "v0 + k z", "time-depth table", "layers between the horizons", "one velocity"
FIELDS = {GRADIENT: ("v0", "k"), TABLE: ("table",), LAYERS: ("velocities",), CONSTANT: ("velocity",)}
IN_DEPTH = "The section is in depth already."
IN_TIME = "In two-way time; shapes are measured in rock with {:g} m/s. Picks are converted with the section."
CONVERTED = "The section was {}."
STYLE, WIDE = {"description_width": "130px"}, {"width": "auto"}
NUMBER = re.compile(r"[^\s,;]+")


class DepthPanel(VBox):
    """Fields for a velocity model, and buttons that convert the section, its picks and its plan.

    Parameters
    ----------
    workspace : Workspace

    Attributes
    ----------
    model : Dropdown
    fields : dict of str to Text or Textarea
        Values of the model, and "source".
    convert_button, back_button : Button
    state : HTML
    notice : Question
        Errors.
    """

    def __init__(self, workspace: Workspace):
        self._workspace, self.notice, self.state = workspace, Question(), HTML()
        self.model = Dropdown(options=list(FIELDS), description="velocity model", style=STYLE, layout=Layout(**WIDE))
        look = {"style": STYLE, "layout": Layout(**WIDE)}
        self.fields: dict[str, Text | Textarea] = {
            "v0": Text("1800", description="v0 (m/s)", **look),
            "k": Text("0.6", description="k (m/s per m)", **look),
            "table": Textarea(description="rows", placeholder="two-way time (ms), depth (m): a pair a line", **look),
            "velocities": Text(description="velocities (m/s)", placeholder="from the top down: 1800, 2400", **look),
            "velocity": Text("2000", description="velocity (m/s)", **look),
            "source": Text(description="source", placeholder="such as “checkshots of well 1”", **look),
        }
        self.convert_button = Button(description="Convert to depth", icon="arrows-v", layout=Layout(**WIDE))
        self.back_button = Button(description="Back to time", icon="clock-o", layout=Layout(**WIDE))
        self._form = VBox([self.model, *self.fields.values(), HBox([self.convert_button, self.back_button])])
        super().__init__([self.state, self._form, self.notice])
        self.convert_button.on_click(lambda _: self.notice.attempt(self.convert))
        self.back_button.on_click(lambda _: self.notice.attempt(self.revert))
        self.model.observe(lambda change: self._update(), "value")
        workspace.observe(lambda change: self._update(), "document")
        self._update()

    @property
    def velocity(self) -> Velocity:
        """The model in the fields.

        Raises
        ------
        SettingError, PickError
            If they do not make one.
        """
        source, model = self.fields["source"].value.strip(), self.model.value
        if model == LAYERS:
            recorded = self._recorded
            return LayerCake(self._horizons(), self._numbers("velocities"), recorded.z_unit, recorded.x_unit, source)
        if model == TABLE:
            numbers = self._numbers("table")
            if len(numbers) % 2:
                raise SettingError("each row of the table must be a two-way time (ms) and a depth (m)")
            return TimeDepthTable(np.array(numbers[::2]), np.array(numbers[1::2]), source=source)
        number = {name: finite_number(self.fields[name].description, self.fields[name].value) for name in FIELDS[model]}
        if model == CONSTANT:
            return ConstantVelocity(number["velocity"], source)
        return LinearVelocity(number["v0"], number["k"], source)

    def convert(self) -> None:
        """Convert the section as it was recorded, the picks and the plan to depth.

        Raises
        ------
        SettingError, PickError, SectionError
            If the fields do not make a model, or the section cannot be converted with it.
        """
        self._show(self._recorded.to_depth(self.velocity), "convert to depth")

    def revert(self) -> None:
        """Show the section as it was recorded, with the picks and the plan in time."""
        self._show(self._recorded, "convert to time")

    def _show(self, section: Section, label: str) -> None:
        workspace, source = self._workspace, self._workspace.source
        before, after = workspace.section.conversion, section.conversion

        def through(what: Any) -> Any:
            recorded = before.to_time(what) if before else what
            return after.to_depth(recorded) if after else recorded

        def slip(name: str, profile: SlipProfile, drawing: Drawing) -> SlipProfile:
            points = np.array(drawing.pick(FAULT, name).pieces[0])
            points = _along(points[:: 1 if points[0, 1] <= points[-1, 1] else -1])
            return profile.carried(workspace.section.to_rock(points), section.to_rock(through(points)))

        def convert(drawing: Drawing, plan: Plan) -> tuple[Drawing, Plan]:
            names = drawing.names(FAULT)
            steps = tuple(
                replace(step, slip={name: slip(name, one, drawing) for name, one in step.slip.items() if name in names})
                for step in plan.steps
            )
            return through(drawing), _converted(replace(plan, steps=steps), through, section.x.mean())

        if source:
            source = replace(source, velocity=after.velocity if after else None, dz=after.dz if after else None)
        converted = replace(changed_alike(workspace.document, convert), section=section, source=source)
        workspace.edit(label, **vars(converted))

    @property
    def _recorded(self) -> Section:
        section = self._workspace.section
        return section.to_time() if section.conversion else section

    def _horizons(self) -> list[Horizon]:
        """The horizons as picked in time, from the top down."""
        picks, conversion = self._workspace.interpretation, self._workspace.section.conversion
        horizons = [conversion.to_time(one) for one in picks.horizons] if conversion else picks.horizons
        return sorted(horizons, key=lambda one: sum(piece[:, 1].mean() for piece in one.pieces) / len(one.pieces))

    def _numbers(self, name: str) -> list[float]:
        field = self.fields[name]
        return [finite_number(field.description, number) for number in NUMBER.findall(field.value)]

    def _update(self) -> None:
        section = self._workspace.section
        self._form.layout.display = "" if section.is_time or section.conversion else "none"
        self.back_button.layout.display = "" if section.conversion else "none"
        for name, field in self.fields.items():
            field.layout.display = "" if name in (*FIELDS[self.model.value], "source") else "none"
        state = CONVERTED.format(section.conversion) if section.conversion else IN_DEPTH
        names = ", ".join(self._workspace.drawing.names(HORIZON)) or "none picked yet"
        layers = f" Layers are bounded by {names}." if self.model.value == LAYERS else ""
        self.state.value = HINT.format((IN_TIME.format(section.velocity) if section.is_time else state) + layers)


def _along(line: np.ndarray, parts: int = 16) -> np.ndarray:
    """A line with each segment divided into equal parts, shape (n, 2)."""
    at = np.linspace(0, len(line) - 1, parts * (len(line) - 1) + 1)
    return np.column_stack([np.interp(at, np.arange(len(line)), column) for column in line.T])


def _converted(plan: Plan, convert: Callable[[ArrayLike], np.ndarray], x: float) -> Plan:
    """A plan with its held points and levels converted, the levels at one position."""

    def level(z: float | None) -> float | None:
        return None if z is None else float(convert((x, z))[1])

    def points(rows: Sequence[tuple[float, float]]) -> tuple[tuple[float, float], ...]:
        return tuple((float(x), float(z)) for x, z in convert(rows)) if rows else ()

    def datum(value: float | Profile | None) -> float | Profile | None:
        return points(value) if isinstance(value, tuple) else level(value)

    regional = plan.regional
    return replace(
        plan,
        steps=tuple(replace(step, datum=datum(step.datum)) for step in plan.steps),
        fixed=points([plan.fixed])[0] if plan.fixed else None,
        pins=points(plan.pins),
        regional=level(regional) if isinstance(regional, float | None) else points(regional),
    )
