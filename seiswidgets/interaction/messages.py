"""Messages from the browser side of a pane, and the gestures that they stand for."""

from dataclasses import dataclass

from seiswidgets.interaction.gestures import REACH, DoubleClick, Gesture, Key, Move, Press, Release
from seiswidgets.interaction.projection import PaneProjection
from seiswidgets.interaction.viewport import Viewport

FINGER = 2.5  # times the reach of a mouse
KINDS = ("size", "press", "drag", "release", "hover", "leave", "double", "wheel", "pinch", "rest", "key")


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


class GestureReader:
    """Turn a pane's messages into gestures in present-day coordinates.

    From a press to its release the pane is read as it was at the press: a drag changes the restoration, and with it the
    picture under the pointer.
    """

    def __init__(self):
        self._held: PaneProjection | None = None

    def read(self, message: PointerMessage, projection: PaneProjection) -> Gesture | None:
        """Return the gesture that a message stands for, or None if it is not a gesture."""
        if message.kind == "press":
            self._held = projection
        projection = self._held or projection
        if message.kind == "release":
            self._held = None
        return _gesture(message, projection)


def _gesture(message: PointerMessage, projection: PaneProjection) -> Gesture | None:
    if message.kind == "key":
        return Key(message.key, projection, message.modifiers)
    pixel, modifiers = message.pixel, message.modifiers
    point = projection.to_original(projection.view.to_section(pixel))
    reach = REACH * FINGER if message.touch else REACH
    match message.kind:
        case "press":
            return Press(point, pixel, projection, message.button, modifiers, reach)
        case "drag" | "hover":
            return Move(point, pixel, projection, modifiers)
        case "release":
            return Release(point, pixel, projection, modifiers, message.cancelled)
        case "double":
            return DoubleClick(point, pixel, projection, modifiers, reach)
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
