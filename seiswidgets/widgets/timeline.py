"""A slider with Play through the steps of a restoration."""

from collections.abc import Iterable
from math import ceil
from typing import Any

from ipywidgets import HBox, IntSlider, Label, Layout, Play, jslink
from traitlets import Bunch, Float, List, Unicode, observe, validate

from seiswidgets.errors import SettingError
from seiswidgets.widgets.closing import WithParts
from seiswidgets.widgets.key_guard import KeyGuard
from seiswidgets.widgets.section_view.live_picture import FRAMES

INTERVAL = 30  # ms between two frames


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
    time : float
        From 0, the present day, to the number of steps; may be set.
    moment : str
        The time in words.
    play, slider, text : Play, IntSlider, Label
        The controls.

    Raises
    ------
    SettingError
        If the time is set to before 0 or after the last step.
    """

    labels = List(Unicode())
    time = Float()
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
        super().__init__([KeyGuard(), self.play, self.slider, self.text])
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
        self.moment = self.text.value = _moment(self.time, self.labels)


def _frame(time: float) -> int:
    return round(FRAMES * time)


def _moment(time: float, labels: list[str]) -> str:
    if not labels:
        return "nothing restored"
    if time in (0, len(labels)):
        return "restored" if time else "present day"
    step = ceil(time) - 1
    return f"{labels[step]} {time - step:.0%}"
