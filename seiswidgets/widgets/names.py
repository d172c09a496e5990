"""Names of controls for screen readers, where ipywidgets gives none."""

from pathlib import Path

import anywidget
from ipywidgets import Layout


class Names(anywidget.AnyWidget):
    """A hidden child of a box: names each control in that box after its label or its tooltip."""

    _esm = Path(__file__).with_name("names.js").read_text("utf-8")
    _css = Path(__file__).with_name("names.css").read_text("utf-8")

    def __init__(self) -> None:
        super().__init__(layout=Layout(display="none"))
