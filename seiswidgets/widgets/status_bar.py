"""The line of the app that starts a restoration, says how far it is, and what is wrong."""

from collections.abc import Callable
from html import escape

from ipywidgets import HTML, Box, Button, FloatProgress, HBox, Label, Layout, ToggleButton
from traitlets import Bool, Unicode

from seiswidgets.widgets.messages import HINT, TROUBLE
from seiswidgets.widgets.ties import tie

HALF = 4.0  # iterations after which the bar of a step has come half its way


class StatusBar(Box):
    """One line of text, and the progress with Cancel; the buttons Restore and Live, to be placed elsewhere.

    Parameters
    ----------
    restore, cancel : callable()
        What the buttons do.

    Attributes
    ----------
    live : bool
        Whether every change restores by itself.
    text : str
        What is said.
    """

    live = Bool(True)
    text = Unicode()

    def __init__(self, restore: Callable[[], None], cancel: Callable[[], None]):
        button = Button(description="Restore", icon="play", button_style="primary", tooltip="restore the section now")
        live = ToggleButton(description="Live", icon="bolt", tooltip="restore by itself after every change")
        self._bar = FloatProgress(min=0, max=1, layout=Layout(width="100px"))
        self._label = Label(layout=Layout(width="270px"))
        self._cancel = Button(description="Cancel", icon="stop", tooltip="give up the restoration that is under way")
        for widget in (button, live, self._cancel):
            widget.layout = Layout(width="auto")
        self._progress = HBox([self._bar, self._label, self._cancel], layout=Layout(display="none"))
        self._line = HTML(layout=Layout(flex="1 1 0", min_width="0", margin="2px"))
        button.on_click(lambda _: restore())
        self._cancel.on_click(lambda _: cancel())
        self.buttons = HBox([button, live])
        super().__init__([self._line, self._progress], layout=Layout(align_items="center", min_height="36px"))
        tie(self, "live", live)

    def tell(self, progress) -> None:
        """Show how far a restoration is; None when none is under way."""
        self._progress.layout.display = "none" if progress is None else ""
        if progress is None:
            return
        self._bar.value = (progress.step + progress.iteration / (progress.iteration + HALF)) / progress.steps
        self._label.value = f"{progress.kind}: iteration {progress.iteration}, energy {progress.energy:.3g} m²"

    def hint(self, text: str) -> None:
        """Say what to do next."""
        self._say(HINT, text)

    def alert(self, text: str) -> None:
        """Say what is wrong."""
        self._say(TROUBLE, text)

    def _say(self, look, text):
        self.text = text
        self._line.value = look.format(escape(text))
