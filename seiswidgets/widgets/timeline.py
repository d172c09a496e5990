"""A slider through the steps of a restoration, which plays."""

from math import ceil

from ipywidgets import HBox, IntSlider, Label, Layout, Play, jslink
from traitlets import Float, List, Unicode, observe, validate

from seiswidgets.errors import SettingError
from seiswidgets.widgets.closing import WithParts
from seiswidgets.widgets.key_guard import KeyGuard

FRAMES = 20  # a step
INTERVAL = 100  # ms from frame to frame


class Timeline(WithParts, HBox):
    """A moment between the section of today and the restored one, on a slider with Play.

    Play runs to the end once, from today if it is at the end. With the keyboard: Tab goes to Play and to the slider,
    arrows move by a frame.

    Parameters
    ----------
    labels : sequence of str

    Attributes
    ----------
    labels : list of str
        What each step is called; when they change, time is at the end.
    time : float
        From 0, today, to the number of steps; may be set.
    moment : str
        The time in words.

    Raises
    ------
    SettingError
        If the time is set to before 0 or after the last step.
    """

    labels = List(Unicode())
    time = Float()
    moment = Unicode()

    def __init__(self, labels=(), **traits):
        self._play = Play(
            interval=INTERVAL, show_repeat=False, tooltip="Play from today to the end", layout=Layout(flex="0 0 88px")
        )
        self._slider = IntSlider(
            description="Time",
            readout=False,
            style={"description_width": "initial"},
            layout=Layout(flex="1 1 auto", width="auto", min_width="0"),
        )
        self._text = Label(layout=Layout(flex="0 0 auto", min_width="104px"))
        self._link = jslink((self._play, "value"), (self._slider, "value"))
        self._slider.observe(self._follow, "value")
        super().__init__([KeyGuard(), self._play, self._slider, self._text], **traits)
        self.labels = list(labels)
        self._take_labels()

    @validate("time")
    def _valid_time(self, proposal):
        count = len(self.labels)
        if not 0 <= proposal.value <= count:
            raise SettingError(f"time must be from 0 to {count}, the number of steps, but is {proposal.value:g}")
        return proposal.value

    @observe("labels")
    def _take_labels(self, change=None):
        count = len(self.labels)
        most = FRAMES * max(count, 1)  # a slider from 0 to 0 cannot be
        for control in (self._play, self._slider):
            control.disabled = not count
            control.max = max(most, control.value)  # or it would move, and be taken for moved by the user
        self.time = float(count)
        for control in (self._play, self._slider):
            control.max = most
        self._say()

    @observe("time")
    def _take_time(self, change):
        for control in (self._play, self._slider):  # both, for pages that have yet to come
            control.value = _frame(self.time)
        self._say()

    def _follow(self, change):
        if change.new != _frame(self.time):  # else it is the slider that follows the time
            self.time = change.new / FRAMES

    def _say(self):
        self.moment = self._text.value = _moment(self.time, self.labels)


def _frame(time):
    return round(FRAMES * time)


def _moment(time, labels):
    if not labels:
        return "nothing restored"
    if time in (0, len(labels)):
        return "restored" if time else "today"
    step = ceil(time) - 1
    return f"{labels[step]} {time - step:.0%}"
