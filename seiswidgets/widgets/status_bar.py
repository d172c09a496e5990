"""The line of the app that starts a restoration, says how far it is, and what is wrong."""

from collections.abc import Callable
from html import escape

from ipywidgets import HTML, Box, Button, FloatProgress, HBox, Label, Layout, ToggleButton
from traitlets import Bool, Unicode

from seiswidgets.widgets.binding import bind_control
from seiswidgets.widgets.messages import HINT, TROUBLE
from seiswidgets.widgets.severity import LOOKS, label
from seiswidgets.widgets.verdict import Verdict

BUSY = "Restoring…"
VERDICT = (  # two lines at most, for which there is room: the panes below must not jump
    '<div role="{role}" title="{whole}" style="display: flex; align-items: center; gap: 8px; line-height: 1.2; '
    'color: var(--jp-ui-font-color1, #212121)">{label}<span style="display: -webkit-box; -webkit-box-orient: vertical; '
    '-webkit-line-clamp: 2; overflow: hidden">{text}</span><span style="flex: none">{rest}</span></div>'
)
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
        auto = {"width": "auto"}
        button = Button(
            description="Restore", icon="play", button_style="primary", tooltip="restore the section now", layout=auto
        )
        live = ToggleButton(
            description="Live", icon="bolt", tooltip="restore by itself after every change", layout=auto
        )
        self._bar = FloatProgress(min=0, max=1, layout=Layout(width="100px"))
        self._label = Label(layout=Layout(width="270px"))
        self._cancel = Button(
            description="Cancel", icon="stop", tooltip="give up the restoration that is under way", layout=auto
        )
        self._progress = HBox([self._bar, self._label, self._cancel], layout=Layout(display="none"))
        self._line = HTML(layout=Layout(flex="1 1 0", min_width="0", margin="2px"))
        button.on_click(lambda _: restore())
        self._cancel.on_click(lambda _: cancel())
        self.buttons = HBox([button, live])
        super().__init__([self._line, self._progress], layout=Layout(align_items="center", min_height="42px"))
        bind_control(self, "live", live)

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

    def show_busy(self) -> None:
        """Say that a newer result is on its way, in the place of the verdict on an older one."""
        self.hint(BUSY)

    def judge(self, verdict: Verdict) -> None:
        """Show the verdict on a restoration: its label, and one sentence."""
        self.text = str(verdict)
        self._line.value = VERDICT.format(
            role=LOOKS[verdict.severity].role,
            whole=escape(self.text),
            label=label(verdict.severity, verdict.title),
            text=escape(verdict.text),
            rest=escape(verdict.rest),
        )

    def _say(self, look, text):
        self.text = text
        self._line.value = look.format(escape(text))
