"""Help in the app: a table of all gestures and keys, and a line that says what a click will do."""

from collections.abc import Callable
from html import escape

from ipywidgets import HTML, Button, Layout, VBox

from seiswidgets.interaction.gesture_table import GESTURES
from seiswidgets.widgets.key_guard import KeyGuard

ROW = '<tr><th scope="row" style="text-align: left; vertical-align: top; padding-right: 12px">{}</th><td>{}</td></tr>'
TABLE = '<table style="line-height: 1.35"><caption style="text-align: left"><b>{}</b></caption>{}</table>'
LINE = (  # no live region: it changes with every move of the pointer
    '<div style="white-space: nowrap; overflow: hidden; text-overflow: ellipsis; min-height: 1.4em; line-height: 1.4; '
    'color: var(--jp-ui-font-color2, #616161)">{}</div>'
)


class GestureHelp(VBox):
    """All gestures and keys, over the app while it is open; Escape, ? or its button close it.

    Attributes
    ----------
    is_open : bool
    """

    def __init__(self) -> None:
        self._close_button = Button(description="Close", icon="times", layout=Layout(width="auto"))
        self._close_button.on_click(lambda _: self.toggle())
        super().__init__(
            [KeyGuard({"Escape": self.toggle}), self._close_button, HTML(_tables())], layout=Layout(display="none")
        )
        self.add_class("seiswidgets-help")

    @property
    def is_open(self) -> bool:
        """True while the help is shown."""
        return self.layout.display != "none"

    def toggle(self) -> None:
        """Open or close it."""
        self.layout.display = "none" if self.is_open else ""
        if self.is_open:
            self._close_button.focus()


class ClickLine(HTML):
    """A line that says what a click will do.

    Parameters
    ----------
    read : callable() -> str
    """

    def __init__(self, read: Callable[[], str]):
        self._read = read
        super().__init__(layout=Layout(margin="0 2px", min_width="0"))

    def update(self) -> None:
        """Show what a click will do now."""
        self.value = LINE.format(escape(self._read()))


def _tables() -> str:
    return "".join(
        TABLE.format(escape(title), "".join(ROW.format(*map(escape, row)) for row in rows))
        for title, rows in GESTURES.items()
    )
