"""Messages that a browser would send for gestures, sent to a pane without a browser."""

SIZE = {"kind": "size", "width": 800, "height": 400, "ratio": 1, "fresh": True}


def tell(pane, kind, **content):
    """One message."""
    pane.layer._handle_custom_msg({"kind": kind, **content}, [])


def appear(*panes):
    """Let panes be shown, each on 800 by 400 css pixels."""
    for pane in panes:
        tell(pane, **SIZE)


def press(pane, point, modifiers=()):
    """A button goes down at a point of the pane's section."""
    tell(pane, "press", modifiers=list(modifiers), **_at(pane, point))


def drag_to(pane, point):
    """The pointer goes on to a point, the button down."""
    tell(pane, "drag", **_at(pane, point))


def release(pane, point):
    """The button goes up."""
    tell(pane, "release", **_at(pane, point))


def click(pane, *points, modifiers=()):
    """Clicks, one after the other."""
    for point in points:
        press(pane, point, modifiers)
        release(pane, point)


def draw(pane, *points):
    """A line, finished by a double click on its last point."""
    click(pane, *points, points[-1])
    tell(pane, "double", **_at(pane, points[-1]))


def keys(pane, *names, modifiers=()):
    """Keys, one after the other."""
    for name in names:
        tell(pane, "key", key=name, modifiers=list(modifiers))


def _at(pane, point):
    x, y = pane.view.to_pixels(point).tolist()
    return {"x": x, "y": y}
