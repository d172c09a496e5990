"""Key presses kept from the notebook around a widget."""

import anywidget
from ipywidgets import Layout

from seiswidgets.widgets.assets import asset


class KeyGuard(anywidget.AnyWidget):
    """A hidden child of a box: keys pressed anywhere in that box do not reach the notebook.

    Without it, x pressed on a button cuts the cell that shows it.
    """

    _esm = asset("key_guard.js")

    def __init__(self):
        super().__init__(layout=Layout(display="none"))
