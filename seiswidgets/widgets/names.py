"""Names of controls for screen readers, where ipywidgets gives none."""

from pathlib import Path

import anywidget
from ipywidgets import Layout


class Names(anywidget.AnyWidget):
    """Shows nothing; in the box that it is a child of, each control gets a name, that of its label or its tooltip."""

    _esm = Path(__file__).with_name("names.js").read_text("utf-8")
    _css = Path(__file__).with_name("names.css").read_text("utf-8")

    def __init__(self):
        super().__init__(layout=Layout(display="none"))
