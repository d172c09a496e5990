"""Texts that the user's browser keeps: they outlive the kernel, and nobody else who uses the server sees them."""

import anywidget
from ipywidgets import Layout
from traitlets import Dict, Instance, Unicode

from seiswidgets.widgets.assets import asset


class BrowserStorage(anywidget.AnyWidget):
    """Shows nothing; keeps texts in the browser, for the tab that shows it and for tabs that are opened later.

    Attributes
    ----------
    kept : dict of str to str
        Texts by name. A text that changes is written at once, one that is taken out is deleted in the browser.
    found : dict of str to str or None
        What the first page that came had kept before; None until then.
    trouble : str
        Why the browser cannot keep a text, in its own words; "" if it can.
    """

    _esm = asset("browser_storage.js")

    kept = Dict().tag(sync=True)
    found = Instance(dict, allow_none=True)
    trouble = Unicode()

    def __init__(self):
        super().__init__(layout=Layout(display="none"))
        self.on_msg(self._take)

    def _take(self, _widget, content, buffers):
        if content["kind"] == "trouble":
            self.trouble = str(content["text"])
        elif self.found is None:  # a page that comes later knows no more than this kernel does
            self.found = {name: text for name, text in content["texts"].items() if isinstance(text, str)}
