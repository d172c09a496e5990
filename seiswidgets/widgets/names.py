"""Names of controls for screen readers, where ipywidgets gives none."""

import anywidget
from ipywidgets import Layout

from seiswidgets.widgets.assets import asset


class Names(anywidget.AnyWidget):
    """Shows nothing; in the box that it is a child of, each control gets a name, that of its label or its tooltip."""

    _esm = asset("names.js")
    _css = asset("names.css")

    def __init__(self):
        super().__init__(layout=Layout(display="none"))
