"""The status bar: it starts a restoration, shows its progress, and gives the verdict or what is wrong."""

from collections.abc import Callable
from html import escape

from ipywidgets import HTML, Box, Button, FloatProgress, HBox, Label, Layout, ToggleButton
from traitlets import Bool, Unicode

from seiswidgets.geology.findings import Finding
from seiswidgets.widgets.binding import bind_control
from seiswidgets.widgets.messages import HINT, TROUBLE, in_the_app
from seiswidgets.widgets.offers import Offer
from seiswidgets.widgets.restorer import Progress
from seiswidgets.widgets.severity import LOOKS, label
from seiswidgets.widgets.verdict import Verdict, title_of

BUSY = "Restoring…"
VERDICT = (  # at most two lines, for which there is space: the panes below must not jump
    '<div role="{role}" title="{whole}" style="display: flex; align-items: center; gap: 8px; line-height: 1.2; '
    'color: var(--jp-ui-font-color1, #212121)">{label}<span style="display: -webkit-box; -webkit-box-orient: vertical; '
    '-webkit-line-clamp: 2; overflow: hidden">{text}</span><span style="flex: none">{rest}</span></div>'
)
HALF_ITERATIONS = 4.0  # iterations after which a step's share of the bar is half full


class StatusBar(Box):
    """A line of text, and the progress with Cancel. The buttons Restore and Live are to be placed elsewhere.

    Parameters
    ----------
    restore, cancel : callable()
        Called by the buttons.
    offers : callable(Finding) -> list of Offer, optional
        The ways out of a finding that is shown, for each of which there is a button.

    Attributes
    ----------
    live : bool
        True if every change restores automatically.
    text : str
        The text shown.
    buttons : HBox
        Restore and Live.
    line, progress, label : HTML, HBox, Label
        The text as HTML; the progress, hidden while nothing is in progress; its text.
    """

    live = Bool(True)
    text = Unicode()

    def __init__(
        self,
        restore: Callable[[], None],
        cancel: Callable[[], None],
        offers: Callable[[Finding], list[Offer]] = lambda finding: [],
    ):
        self._find_offers, self._offers = offers, list[Offer]()
        auto = {"width": "auto"}
        button = Button(
            description="Restore", icon="play", button_style="primary", tooltip="Restore the section now", layout=auto
        )
        live = ToggleButton(description="Live", icon="bolt", tooltip="Restore after every change", layout=auto)
        self._bar = FloatProgress(min=0, max=1, layout=Layout(width="100px"))
        self.label = Label(layout=Layout(width="270px"))
        self._cancel = Button(
            description="Cancel", icon="stop", tooltip="Cancel the restoration in progress", layout=auto
        )
        self.progress = HBox([self._bar, self.label, self._cancel], layout=Layout(display="none"))
        self.line = HTML(layout=Layout(flex="1 1 0", min_width="0", margin="2px"))
        button.on_click(lambda _: restore())
        self._cancel.on_click(lambda _: cancel())
        self.buttons = HBox([button, live])
        self.offers = HBox(layout=Layout(display="none", flex_flow="row wrap"))
        parts = [self.line, self.offers, self.progress]
        super().__init__(parts, layout=Layout(align_items="center", min_height="36px"))
        bind_control(self, "live", live)

    def show_progress(self, progress: Progress | None) -> None:
        """Show the progress of a restoration; None when it has ended."""
        self.progress.layout.display = "none" if progress is None else ""
        if progress is None:
            return
        self._bar.value = (progress.step + progress.iteration / (progress.iteration + HALF_ITERATIONS)) / progress.steps
        self.label.value = f"{progress.kind}: iteration {progress.iteration}, energy {progress.energy:.3g} m²"

    def hint(self, text: str) -> None:
        """Show what to do next."""
        self._show(HINT, text)

    def alert(self, text: str) -> None:
        """Show what is wrong."""
        self._show(TROUBLE, text)

    def show_busy(self) -> None:
        """Show that a newer result is being computed, instead of the verdict on an older one."""
        self.hint(BUSY)

    def tell(self, finding: Finding) -> None:
        """Show one finding in full."""
        words = in_the_app(finding.text)
        self.text = text = f"{title_of(finding)}: {words}"
        look = LOOKS[finding.severity]
        self.line.value = VERDICT.format(
            role=look.role,
            whole=escape(text),
            label=label(finding.severity, title_of(finding)),
            text=escape(words),
            rest="",
        )
        self._offer(finding)

    def judge(self, verdict: Verdict) -> None:
        """Show the verdict on a restoration: its label, and one sentence."""
        self.text = str(verdict)
        self.line.value = VERDICT.format(
            role=LOOKS[verdict.severity].role,
            whole=escape(self.text),
            label=label(verdict.severity, verdict.title),
            text=escape(verdict.text),
            rest=escape(verdict.rest),
        )
        self._offer(*verdict.findings[:1])

    def _offer(self, *findings: Finding) -> None:
        """Show a button for each way out of some findings; none hides them."""
        self._offers = [offer for finding in findings for offer in self._find_offers(finding)]
        buttons = self.offers.children
        buttons += tuple(self._offer_button(index) for index in range(len(buttons), len(self._offers)))
        for button, offer in zip(buttons, self._offers, strict=False):
            button.description, button.tooltip = offer.label, offer.tooltip
        for index, button in enumerate(buttons):
            button.layout.display = "" if index < len(self._offers) else "none"
        self.offers.children, self.offers.layout.display = buttons, "" if self._offers else "none"

    def _offer_button(self, index: int) -> Button:
        button = Button(layout=Layout(width="auto"))
        button.on_click(lambda _: self._offers[index].act())
        return button

    def _show(self, style: str, text: str) -> None:
        self.text = text
        self.line.value = style.format(escape(text))
        self._offer()
