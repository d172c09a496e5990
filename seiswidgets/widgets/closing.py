"""Closing a widget together with everything that it is made of, so that the kernel can free it."""

from collections.abc import Iterable, Iterator
from dataclasses import is_dataclass

from ipycanvas.canvas import _CANVAS_MANAGER
from ipywidgets import Widget

DEEPEST = 2  # containers within containers in which an attribute may hold widgets
OURS = __name__.rpartition(".")[0]  # the package whose plain objects may hold widgets too


class WithParts:
    """A widget that closes its parts with itself: ipywidgets keeps each open widget alive, layouts and styles too.

    Attributes
    ----------
    borrowed : tuple of Widget
        Widgets that it holds but that belong to somebody else; they stay open.
    """

    borrowed: tuple[Widget, ...] = ()

    def close(self) -> None:
        """Close this widget and all its parts; closing it again does nothing."""
        if self.comm is not None:  # else it was closed before, or never opened
            _close(super().close, parts(self, self.borrowed))


def close_with_parts(widget: Widget) -> None:
    """Close a widget of ipywidgets together with its layout, its style, and all else that it holds."""
    _close(widget.close, parts(widget))


def _close(close_whole, held):
    close_whole()  # first, so that the page drops everything at once
    for part in held:
        part.close()


def parts(whole: Widget, borrowed: Iterable[Widget] = ()) -> list[Widget]:
    """Every widget that can be reached from one through attributes and traits, without itself and the borrowed ones."""
    seen = {id(one) for one in (whole, _CANVAS_MANAGER, *borrowed)}  # all canvases share the manager
    found, waiting = [], [whole]
    while waiting:
        for one in _held(vars(waiting.pop(0)), -1):
            if id(one) not in seen:
                seen.add(id(one))
                waiting.append(one)
                if isinstance(one, Widget):
                    found.append(one)
    return found


def _held(value, depth: int) -> Iterator[object]:
    """The widgets in a value, and the objects of ours that may hold some."""
    if isinstance(value, Widget) or _is_holder(value):
        yield value
    elif depth <= DEEPEST and isinstance(value, dict | list | tuple):
        for one in value.values() if isinstance(value, dict) else value:
            yield from _held(one, depth + 1)


def _is_holder(value):
    """Whether it is a plain object of these modules; our dataclasses are values, and hold numbers only."""
    kind = type(value)
    return kind.__module__.startswith(OURS) and hasattr(value, "__dict__") and not is_dataclass(kind)
