"""Base of the public widgets: each closes together with its parts, so that the kernel can free its memory."""

from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import is_dataclass
from inspect import signature
from typing import Any

from ipywidgets import Widget

from seiswidgets.signatures import check_keywords
from seiswidgets.widgets.ipycanvas_compat import CANVAS_MANAGER

MOST_NESTED = 2  # containers within containers that are searched for widgets
NOT_SETTINGS = {"settings", "traits", "children", "comm", "keys", "log"}  # a widget sets these traits by itself
PACKAGE = __name__.rpartition(".")[0]  # its plain objects are searched for widgets too


class WithParts(Widget):
    """A widget that closes its parts with itself: ipywidgets keeps each open widget alive, layouts and styles too.

    Attributes
    ----------
    borrowed : tuple of Widget
        Parts that belong to another widget; they stay open.
    """

    borrowed: tuple[Widget, ...] = ()

    @classmethod
    def check_settings(cls, settings: Mapping[str, Any]) -> None:
        """Refuse keyword arguments that the class does not take, with a TypeError that suggests the right one."""
        names = {*cls.class_trait_names(), *signature(cls).parameters} - NOT_SETTINGS
        check_keywords(cls.__name__, settings, (name for name in names if not name.startswith("_")))

    def close(self) -> None:
        """Close this widget and all its parts; closing it again does nothing."""
        if self.comm is not None:  # else closed already, or never opened
            _close(super().close, parts(self, self.borrowed))


def close_with_parts(widget: Widget) -> None:
    """Close a widget of ipywidgets together with its layout, its style, and its parts."""
    _close(widget.close, parts(widget))


def _close(close_whole: Callable[[], None], held: Iterable[Widget]) -> None:
    close_whole()  # first, so that the page removes everything at once
    for part in held:
        part.close()


def parts(whole: Widget, borrowed: Iterable[Widget] = ()) -> list[Widget]:
    """Widgets that can be reached from one through attributes and traits, without itself and the borrowed ones."""
    seen = {id(one) for one in (whole, CANVAS_MANAGER, *borrowed)}  # all canvases share the manager
    widgets: list[Widget] = []
    waiting: list[object] = [whole]
    while waiting:
        for one in _held(vars(waiting.pop(0)), -1):
            if id(one) not in seen:
                seen.add(id(one))
                waiting.append(one)
                if isinstance(one, Widget):
                    widgets.append(one)
    return widgets


def _held(value: object, depth: int) -> Iterator[object]:
    """Yield the widgets in a value, and the plain objects of this package that may hold some."""
    if isinstance(value, Widget) or _is_holder(value):
        yield value
    elif depth <= MOST_NESTED and isinstance(value, dict | list | tuple):
        for one in value.values() if isinstance(value, dict) else value:
            yield from _held(one, depth + 1)


def _is_holder(value: object) -> bool:
    """Return whether a value is a plain object of this package; its dataclasses are values, and hold no widgets."""
    kind = type(value)
    return kind.__module__.startswith(PACKAGE) and hasattr(value, "__dict__") and not is_dataclass(kind)
