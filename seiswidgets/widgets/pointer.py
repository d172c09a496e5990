"""The layer on top of a pane that owns every event, and draws axes, cursors and the rubber band in the browser."""

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import anywidget
from ipywidgets import CallbackDispatcher
from traitlets import Dict, List, Unicode

from seiswidgets.widgets.gestures import REACH, DoubleClick, Gesture, Key, Move, Press, Release
from seiswidgets.widgets.view import View

FINGER = 2.5  # times the reach of a mouse
HERE = Path(__file__).parent
KINDS = ("size", "press", "drag", "release", "hover", "leave", "double", "wheel", "rest", "key")
ANSWERED = ("drag", "hover", "wheel")  # kinds of which the browser sends no second one before the first is answered


@dataclass(frozen=True)
class Happening:
    """What the browser tells of; only what a kind needs is filled in.

    Attributes
    ----------
    kind : str
        One of `KINDS`. "size" is sent by each view as it appears (then it is ``fresh``) and when its size changes,
        "rest" a moment after the last wheel step or drag.
    x, y : float
        In css pixels of the plot area.
    modifiers : frozenset of {"ctrl", "meta", "shift", "alt"}
    button : int
        0 is the main one, 1 the middle one.
    touch, cancelled : bool
        Whether a finger did it; whether the browser took the gesture away.
    steps : float
        Of the wheel, positive away from the user.
    key : str
        By the name that browsers give it.
    width, height, ratio : float
        Of the plot area, in css pixels, and device pixels in one of them.
    fresh : bool
        Whether a view has just appeared.
    """

    kind: str
    x: float = 0.0
    y: float = 0.0
    modifiers: frozenset = frozenset()
    button: int = 0
    touch: bool = False
    cancelled: bool = False
    steps: float = 0.0
    key: str = ""
    width: float = 0.0
    height: float = 0.0
    ratio: float = 1.0
    fresh: bool = False

    @property
    def pixel(self) -> tuple[float, float]:
        """Where it happened, in css pixels of the plot area."""
        return self.x, self.y


class PointerLayer(anywidget.AnyWidget):
    """A transparent layer over a canvas, in the same area of a CSS grid.

    Moves are drawn in the browser and throttled there: of drags and wheel steps one message is under way at most.

    Attributes
    ----------
    axes : dict
        "x" and "z", each with "title", "pixels" and "labels"; "left", the room left of the plot area; and "note", for
        the corner.
    window : list
        ``x_min, x_max, z_min, z_max`` of the plot area, in the section's units; for the cursors.
    cursor, linked : dict
        Where the pointer is, ``{"x", "z"}`` in the section's units or empty, and where to draw another pane's cursor.
        Link the one to the other with ``jslink``; the kernel never hears of either.
    rubber : list of [x, y]
        Css pixels of a line that ends at the pointer.
    hotkeys : list of str
        Those that the layer takes ("Enter", "Ctrl+z"); all others, Tab among them, keep their meaning.
    label : str
        What a screen reader says of it.
    """

    _esm = HERE / "pointer.js"
    _css = HERE / "pointer.css"

    axes = Dict().tag(sync=True)
    window = List().tag(sync=True)
    cursor = Dict().tag(sync=True)
    linked = Dict().tag(sync=True)
    rubber = List().tag(sync=True)
    hotkeys = List(Unicode()).tag(sync=True)
    label = Unicode("seismic section").tag(sync=True)

    def __init__(self, **traits):
        super().__init__(**traits)
        self._happenings = CallbackDispatcher()
        self.on_msg(self._receive)

    def on_happening(self, callback: Callable[[Happening], None], remove: bool = False) -> None:
        """Call a function with all that happens, or do so no more."""
        self._happenings.register_callback(callback, remove=remove)

    def _receive(self, _, content, buffers):
        try:
            self._happenings(_happening(content))
        finally:
            if content.get("kind") in ANSWERED:
                self.send({"kind": "answer", "to": content["kind"]})


def _happening(content):
    return Happening(**{**content, "modifiers": frozenset(content.get("modifiers", ()))})


def gesture_of(happening: Happening, view: View) -> Gesture | None:
    """What happened, as a value that knows nothing of Jupyter; None if it is no gesture."""
    at = {"pixel": happening.pixel, "point": tuple(view.to_section(happening.pixel).tolist())}
    at["modifiers"] = happening.modifiers
    reach = REACH * FINGER if happening.touch else REACH
    match happening.kind:
        case "press":
            return Press(**at, button=happening.button, reach=reach)
        case "drag" | "hover":
            return Move(**at)
        case "release":
            return Release(**at)
        case "double":
            return DoubleClick(**at, reach=reach)
        case "key":
            return Key(happening.key, happening.modifiers)
    return None
