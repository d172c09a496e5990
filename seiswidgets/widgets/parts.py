"""What a widget is made of, to be closed with it."""

from collections.abc import Iterator

from ipywidgets import DOMWidget, Widget
from ipywidgets.widgets.widget_link import Link


def close_whole(widget: Widget) -> None:
    """Close a widget and all that it holds, shown or not, which ipywidgets would keep in the kernel and in the page.

    Layouts and styles stay: they are small, and some are shared.
    """
    whole = [widget]
    for part in whole:  # which grows meanwhile
        whole += (one for one in _widgets_in(vars(part)) if one not in whole)
    for part in whole:
        Widget.close(part)


def _widgets_in(value) -> Iterator[Widget]:
    """The widgets that a value is, or that its lists and dictionaries hold."""
    if isinstance(value, DOMWidget | Link):
        yield value
    elif isinstance(value, list | tuple | dict):
        for one in value.values() if isinstance(value, dict) else value:
            yield from _widgets_in(one)
