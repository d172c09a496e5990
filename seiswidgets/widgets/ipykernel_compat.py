"""The private name of ipykernel that seiswidgets relies on: the only module that uses one.

ipykernel 7.4 asks ``comm._reply_subshell_for`` which thread is to handle a widget's message, and has no public way to
choose it. A test fails when a new version asks something else.
"""

from collections.abc import Iterable

from ipywidgets import Widget

ROUTE = "_reply_subshell_for"


def keep_order(widget: Widget) -> None:
    """Handle the messages to a widget, and to its present and later children, one after the other.

    ipykernel 7.4 hands a message to the main thread or to a subshell's thread, whichever wrote to that widget last.
    While a cell ran, a click on a button waited for it but the clicks on a pane after that one did not, and were
    misunderstood. Here all messages go to the main thread; other versions of ipykernel keep the order anyway.
    """
    if not hasattr(widget.comm, ROUTE) or ROUTE in vars(widget.comm):
        return
    setattr(widget.comm, ROUTE, _to_main_thread)
    if widget.has_trait("children"):
        widget.observe(lambda change: _keep_order_of(change.new), "children")
        _keep_order_of(widget.children)


def _keep_order_of(widgets: Iterable[Widget]) -> None:
    for widget in widgets:
        keep_order(widget)


def _to_main_thread(data: object, default: object) -> None:
    """Return None, which means the main thread."""
