"""A slider with Play through the steps of a restoration."""

from collections.abc import Iterable, Sequence
from math import ceil
from typing import Any

import numpy as np
from ipywidgets import HTML, HBox, IntSlider, Label, Layout, Play, VBox, jslink
from traitlets import Bunch, Float, List, Unicode, observe, validate

from seiswidgets.errors import SettingError
from seiswidgets.widgets.closing import WithParts
from seiswidgets.widgets.key_guard import KeyGuard
from seiswidgets.widgets.section_view.live_picture import FRAMES

INTERVAL = 30  # ms between two frames
TICKS = '<div style="position: relative; height: 14px; font-size: 10px; line-height: 14px" aria-hidden="true">{}</div>'
TICK = '<span style="position: absolute; left: {:.2f}%; transform: translateX(-50%); white-space: nowrap">{}</span>'


class Timeline(WithParts, HBox):
    """A moment between the present-day section and the restored one, on a slider with Play.

    Play runs to the end once, from the present day if it is at the end. With the keyboard, Tab moves to Play and to the
    slider, and the arrows move by a frame.

    Parameters
    ----------
    labels : sequence of str
        Initial value of the attribute.
    **settings
        Initial values of the other attributes.

    Attributes
    ----------
    labels : list of str
        Names of the steps; when they change, time moves to the end.
    ages : list of float or None
        Ages after the steps, in Ma; empty if they have none. Set them before the labels.
    time : float
        From 0, the present day, to the number of steps; may be set.
    age : float or None
        The time in Ma; it runs evenly over the steps of one age.
    moment : str
        The time in words.
    play, slider, ticks, text : Play, IntSlider, HTML, Label
        The controls; the ticks show the ages.

    Raises
    ------
    SettingError
        If the time is set to before 0 or after the last step.
    """

    labels = List(Unicode())
    ages: List[Any] = List(Float(allow_none=True))
    time = Float()
    age = Float(None, allow_none=True)
    moment = Unicode()

    def __init__(self, labels: Iterable[str] = (), **settings: Any):
        self.check_settings(settings)
        self.play = Play(
            interval=INTERVAL,
            show_repeat=False,
            tooltip="Play from the present day to the end",
            layout=Layout(flex="0 0 88px"),
        )
        self.slider = IntSlider(
            description="Time",
            readout=False,
            style={"description_width": "initial"},
            layout=Layout(flex="1 1 auto", width="auto", min_width="0"),
        )
        self.text = Label(layout=Layout(flex="0 0 auto", min_width="104px"))
        self._link = jslink((self.play, "value"), (self.slider, "value"))
        self.slider.observe(self._take_slider, "value")
        self.ticks = HTML(layout=Layout(display="none", margin="0 0 0 44px"))
        track = VBox([self.slider, self.ticks], layout=Layout(flex="1 1 auto", min_width="0"))
        super().__init__([KeyGuard(), self.play, track, self.text])
        self._take_labels()
        self.labels = list(labels)
        for name, value in settings.items():
            setattr(self, name, value)

    @validate("time")
    def _valid_time(self, proposal: Bunch) -> float:
        count = len(self.labels)
        if not 0 <= proposal.value <= count:
            raise SettingError(f"time must be from 0 to {count}, the number of steps, but is {proposal.value:g}")
        return float(proposal.value)

    @observe("labels")
    def _take_labels(self, change: Bunch | None = None) -> None:
        count = len(self.labels)
        end = FRAMES * max(count, 1)  # a slider cannot run from 0 to 0
        for control in (self.play, self.slider):
            control.disabled = not count
            control.max = max(end, control.value)  # a smaller one would change the value, as if the user had
        self.time = float(count)
        for control in (self.play, self.slider):
            control.max = end
        self._show_ticks()
        self._show_moment()

    @observe("time")
    def _take_time(self, change: Bunch) -> None:
        for control in (self.play, self.slider):  # both, for pages that appear later
            control.value = _frame(self.time)
        self._show_moment()

    def _take_slider(self, change: Bunch) -> None:
        if change.new != _frame(self.time):  # else the slider has followed the time
            self.time = change.new / FRAMES

    def _show_moment(self) -> None:
        self.age = age_at(self.time, self.ages) if len(self.ages) == len(self.labels) else None
        when = "" if self.age is None else f"{self.age:.4g} Ma · "
        self.moment = self.text.value = when + _moment(self.time, self.labels)

    def _show_ticks(self) -> None:
        last = last_of_each_age(self.ages) if len(self.ages) == len(self.labels) else {}
        self.ticks.layout.display = "" if last else "none"
        self.ticks.value = TICKS.format(
            "".join(TICK.format(100 * count / len(self.labels), f"{age:.4g}") for age, count in last.items())
        )


def last_of_each_age(ages: Sequence[float | None]) -> dict[float, int]:
    """Number of steps carried out at each age, the present day included; empty if a step has no age."""
    if not ages or None in ages:
        return {}
    return {0.0: 0} | {age: count for count, age in enumerate(ages, 1) if age is not None}


def age_at(time: float, ages: Sequence[float | None]) -> float | None:
    """Age at a time in steps, in Ma; None if a step has none."""
    last = last_of_each_age(ages)
    if not last:
        return None
    counts = sorted(last.values())
    by_count = {count: age for age, count in last.items()}
    return float(np.interp(time, counts, [by_count[count] for count in counts]))


def _frame(time: float) -> int:
    return round(FRAMES * time)


def _moment(time: float, labels: list[str]) -> str:
    if not labels:
        return "nothing restored"
    if time in (0, len(labels)):
        return "restored" if time else "present day"
    step = ceil(time) - 1
    return f"{labels[step]} {time - step:.0%}"
