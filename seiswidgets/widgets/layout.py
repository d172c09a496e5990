"""Layout of the app in its page: the handle between panes and panels, and the button that fills the window."""

import anywidget
from ipywidgets import Layout
from traitlets import Float

from seiswidgets.widgets.assets import asset


class Divider(anywidget.AnyWidget):
    """A handle between two boxes, one above the other, that shares their height between them.

    Attributes
    ----------
    share : float or None
        Share of the upper box, from 0 to 1; None for that of the style sheet.
    """

    _esm = asset("divider.js")
    _css = asset("app.css")

    share = Float(None, allow_none=True).tag(sync=True)


class MaximiseButton(anywidget.AnyWidget):
    """A button that lets the app around it fill the window of the browser, and Escape leaves that again."""

    _esm = asset("maximise.js")

    def __init__(self) -> None:
        super().__init__(layout=Layout(width="auto"))

    def leave(self) -> None:
        """Let the app return to its place in the page, if it fills the window."""
        self.send({"kind": "leave"})
