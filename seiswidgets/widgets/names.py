"""Names of controls for screen readers, where ipywidgets gives none."""

import anywidget
from ipywidgets import Layout

from seiswidgets.widgets.assets import asset


class Names(anywidget.AnyWidget):
    """A hidden child of a box: names each control in that box after its label or its tooltip."""

    _esm = asset("names.js")

    def __init__(self) -> None:
        super().__init__(layout=Layout(display="none"))
