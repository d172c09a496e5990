"""The layer on top of a pane that owns every event, and draws axes, lines, marks, mesh and cursors in the browser."""

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import anywidget
from ipywidgets import CallbackDispatcher
from traitlets import Dict, Float, List, Unicode

from seiswidgets.interaction.gestures import REACH, DoubleClick, Gesture, Key, Move, Press, Release
from seiswidgets.interaction.viewport import Viewport

FINGER = 2.5  # times the reach of a mouse
LAYER = Path(__file__).parent / "layer"
SCRIPTS = ("svg", "plane", "axes", "lines", "marks", "mesh", "cursors", "carry", "lanes", "hand", "keys", "layer")
KINDS = ("size", "press", "drag", "release", "hover", "leave", "double", "wheel", "pinch", "rest", "key")
ANSWERED = ("drag", "hover", "wheel", "pinch")  # of these the browser sends none before the last is answered


def joined(*scripts: Path) -> str:
    """Scripts as one ES module: they share one scope, so that no build step is needed."""
    return "\n".join(script.read_text("utf-8") for script in scripts)


@dataclass(frozen=True)
class PointerMessage:
    """What the browser tells of; only what a kind needs is filled in.

    Attributes
    ----------
    kind : str
        One of `KINDS`. "size" is sent by each view as it appears (then it is ``fresh``) and when its size changes,
        "rest" a moment after the last wheel step or drag.
    x, y : float
        In css pixels of the plot area, as the kernel knows its size; of a pinch, the middle between the fingers.
    modifiers : frozenset of {"ctrl", "meta", "shift", "alt"}
    button : int
        0 is the main one, 1 the middle one.
    touch, cancelled : bool
        Whether a finger did it; whether the gesture was taken away, by the browser or by a second finger.
    pan : bool
        Whether a press, drag or release is of the middle button, or with Space held: it pans, whatever lies there.
    steps : float
        Of the wheel, positive away from the user.
    factor, dx, dz : float
        How far two fingers have spread since the last pinch, and gone, in css pixels.
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
    pan: bool = False
    steps: float = 0.0
    factor: float = 1.0
    dx: float = 0.0
    dz: float = 0.0
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

    All that it draws it draws in the browser, from points in the section's units and the window: zooming and panning
    send none of them again. Moves are throttled there: of drags and wheel steps one message is under way at most. Of
    several views of a layer each draws for its own size, and tells positions in the size that the kernel knows.

    Attributes
    ----------
    axes : dict
        "x" and "z", each with "title", "pixels" and "labels"; "left", the room left of the plot area; and "note", for
        the corner.
    window : list
        ``x_min, x_max, z_min, z_max`` of the plot area, in the section's units.
    size : list
        Width and height of the plot area that the kernel knows, in css pixels; those of the axes are of it.
    strokes, marks : list of dict
        See `Stroke.state` and `Mark.state`.
    rubber : list of [x, z]
        A dashed line, in the section's units, that goes on to the pointer, or else to the linked place.
    mesh : dict
        Empty, or see `mesh_state`.
    mesh_opacity : float
        0 to 1.
    chain : list of dict
        Maps that carry a point to another pane, one after the other; see `map_state`.
    carried, linked : dict
        Where the pointer is, carried by the chain, ``{"x", "z"}`` in the other pane's units or empty; and where to
        draw another pane's cursor. Link the one to the other with ``jslink``; the kernel never hears of either.
    hotkeys : list of str
        Those that the layer takes ("Enter", "Ctrl+z"); all others, Tab among them, keep their meaning. Space is
        always taken: held, it pans; let go without a drag, it is told as a key if it is among these.
    label : str
        What a screen reader says of it.
    """

    _esm = joined(*(LAYER / f"{name}.js" for name in SCRIPTS))
    _css = LAYER / "layer.css"

    axes = Dict().tag(sync=True)
    window = List().tag(sync=True)
    size = List().tag(sync=True)
    strokes = List().tag(sync=True)
    marks = List().tag(sync=True)
    rubber = List().tag(sync=True)
    mesh = Dict().tag(sync=True)
    mesh_opacity = Float(0.6).tag(sync=True)
    chain = List().tag(sync=True)
    carried = Dict().tag(sync=True)
    linked = Dict().tag(sync=True)
    hotkeys = List(Unicode()).tag(sync=True)
    label = Unicode("seismic section").tag(sync=True)

    def __init__(self, **traits):
        super().__init__(**traits)
        self._listeners = CallbackDispatcher()
        self.on_msg(self._receive)

    def on_pointer_message(self, callback: Callable[[PointerMessage], None], remove: bool = False) -> None:
        """Call a function with all that happens, or do so no more."""
        self._listeners.register_callback(callback, remove=remove)

    def _receive(self, _, content, buffers):
        try:
            self._listeners(_message(content))
        finally:
            if content.get("kind") in ANSWERED:
                self.send({"kind": "answer", "to": content["kind"]})


def _message(content):
    return PointerMessage(**{**content, "modifiers": frozenset(content.get("modifiers", ()))})


def gesture_of(message: PointerMessage, view: Viewport) -> Gesture | None:
    """What happened, as a value that knows nothing of Jupyter; None if it is no gesture."""
    at = {"pixel": message.pixel, "point": tuple(view.to_section(message.pixel).tolist())}
    at["modifiers"] = message.modifiers
    reach = REACH * FINGER if message.touch else REACH
    match message.kind:
        case "press":
            return Press(**at, button=message.button, reach=reach)
        case "drag" | "hover":
            return Move(**at)
        case "release":
            return Release(**at, cancelled=message.cancelled)
        case "double":
            return DoubleClick(**at, reach=reach)
        case "key":
            return Key(message.key, message.modifiers)
    return None


def axes_state(view: Viewport, left: float) -> dict:
    """The axes of a view as the layer in the browser knows them, with so much room on the left."""
    axes = zip("xz", view.ticks(), strict=True)
    x_and_z = {
        name: {
            "title": axis.title,
            "pixels": [round(pixel, 2) for pixel in axis.pixels],
            "labels": list(axis.labels),
        }
        for name, axis in axes
    }
    is_true = abs(view.exaggeration - 1) < 0.005
    return {**x_and_z, "left": left, "note": "true proportions" if is_true else f"V.E. {view.exaggeration:.3g}×"}
