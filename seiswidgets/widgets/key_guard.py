"""Key presses kept from the notebook around a widget."""

from pathlib import Path

import anywidget
from ipywidgets import Layout

from seiswidgets.widgets.section_view.pointer_layer import KEEP_KEYS, joined


class KeyGuard(anywidget.AnyWidget):
    """A hidden child of a box: keys pressed anywhere in that box do not reach the notebook.

    Without it, x pressed on a button cuts the cell that shows it.
    """

    _esm = joined(KEEP_KEYS, Path(__file__).with_name("key_guard.js"))

    def __init__(self):
        super().__init__(layout=Layout(display="none"))
