"""Key presses kept from the notebook around a widget."""

from collections.abc import Callable, Mapping
from typing import Any

import anywidget
from ipywidgets import Layout, Widget
from traitlets import List, Unicode

from seiswidgets.widgets.assets import asset


class KeyGuard(anywidget.AnyWidget):
    """A hidden child of a box: keys pressed anywhere in that box do not reach the notebook, and the focus stays in it.

    Without it, x pressed on a button cuts the cell that shows it.

    Parameters
    ----------
    actions : dict of str to callable(), optional
        What some keys do wherever the focus is in the box, such as "Ctrl+z". A field that is being typed in keeps its
        own undo, and panes handle their keys themselves.
    """

    _esm = asset("key_guard.js")

    names = List(Unicode()).tag(sync=True)

    def __init__(self, actions: Mapping[str, Callable[[], object]] | None = None):
        self._actions = dict(actions or {})
        super().__init__(names=list(self._actions), layout=Layout(display="none"))
        self.on_msg(self._receive)

    def _receive(self, _: Widget, content: dict[str, Any], buffers: list[memoryview]) -> None:
        self._actions[content["name"]]()
