"""Tabs whose pages come when they are wanted."""

from collections.abc import Callable

from ipywidgets import Layout, Tab, VBox, Widget


class Pages(Tab):
    """Tabs whose pages are made when they are first looked at, so that the app is there sooner.

    Parameters
    ----------
    **pages : callable() that returns a widget
        By the titles of the tabs.
    """

    def __init__(self, **pages: Callable[[], Widget]):
        self._makers = list(pages.values())
        super().__init__([VBox() for _ in pages], titles=list(pages), layout=Layout(min_width="0"))
        self.add_class("seiswidgets-pages")
        self.observe(lambda change: self._look(change.new), "selected_index")
        self._look(0)

    def _look(self, number):
        if number is not None and not self.children[number].children:
            self.children[number].children = [self._makers[number]()]
