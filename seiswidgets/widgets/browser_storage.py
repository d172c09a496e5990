"""Texts kept in the user's browser: they outlive the kernel, and other users of the server do not see them."""

from pathlib import Path
from typing import Any

import anywidget
from ipywidgets import Layout, Widget
from traitlets import Dict, Instance, Unicode


class BrowserStorage(anywidget.AnyWidget):
    """A hidden widget that keeps texts in the browser, for the tab that shows it and for tabs opened later.

    Attributes
    ----------
    kept : dict of str to str
        Texts by name. A changed text is written at once; a removed one is deleted in the browser.
    found : dict of str to str or None
        Texts that the first page to connect had kept before; None until then.
    trouble : str
        Why the browser cannot keep a text, in its own words; "" if it can.
    """

    _esm = Path(__file__).with_name("browser_storage.js").read_text("utf-8")

    kept = Dict().tag(sync=True)
    found = Instance(dict, allow_none=True)
    trouble = Unicode()

    def __init__(self) -> None:
        super().__init__(layout=Layout(display="none"))
        self.on_msg(self._take)

    def _take(self, _widget: Widget, content: dict[str, Any], buffers: list[memoryview]) -> None:
        if content["kind"] == "trouble":
            self.trouble = str(content["text"])
        elif self.found is None:  # a page that connects later has nothing that this kernel does not have
            self.found = {name: text for name, text in content["texts"].items() if isinstance(text, str)}
