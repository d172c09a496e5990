"""Messages from the page, in the order in which they were sent."""

from ipywidgets import Widget

ROUTE = "_reply_subshell_for"  # by which ipykernel 7.4 chooses the thread for a widget's message


def keep_order(widget: Widget) -> None:
    """Have the messages to a widget, and to all that it holds or will hold, handled one after the other.

    ipykernel 7.4 hands them to the main thread or to another, whichever wrote to that widget last. While a cell ran, a
    click on a button waited for it, and the clicks on a pane after that one did not, and were taken for something else.
    All of them are for the main thread here; other versions of ipykernel keep the order by themselves.
    """
    if not hasattr(widget.comm, ROUTE) or ROUTE in vars(widget.comm):
        return
    setattr(widget.comm, ROUTE, _to_main_thread)
    if widget.has_trait("children"):
        widget.observe(lambda change: _keep_order_of(change.new), "children")
        _keep_order_of(widget.children)


def _keep_order_of(widgets):
    for widget in widgets:
        keep_order(widget)


def _to_main_thread(data, default):
    return None
