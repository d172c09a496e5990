"""Messages from the browser side of a pane, and their conversion to gestures."""

from dataclasses import dataclass, replace
from typing import Any

from seiswidgets.interaction.gestures import REACH, DoubleClick, Gesture, Key, Move, Press, Release
from seiswidgets.interaction.projection import PaneProjection
from seiswidgets.interaction.viewport import Axis, Viewport

TOUCH_FACTOR = 2.5  # reach of a finger, in reaches of a mouse


@dataclass(frozen=True)
class PointerMessage:
    """A message about the pointer, a key or the size of a view; only the fields that its kind needs are filled in.

    Attributes
    ----------
    kind : str
        "size" (each view sends it when it appears, with ``fresh``, and when its size changes), "press", "drag",
        "release", "hover", "leave", "double", "wheel", "pinch", "rest" (a moment after the last wheel step or drag),
        "key", "menu" (a right click, a long press or the menu key), "choose" (an item of that menu, ``key`` being its
        index), or "finding" (a click on a flag, ``key`` being its index among the flags).
    x, y : float
        Position in css pixels of the plot area, as the kernel knows its size; for a pinch, midway between the fingers.
    modifiers : frozenset of {"ctrl", "meta", "shift", "alt"}
    button : int
        0 is the main button, 1 the middle one.
    touch, cancelled : bool
        True for a finger; true if the browser, or a second finger, ended the gesture.
    pan : bool
        True for a press, drag or release that pans whatever lies under it: of the middle button, or with Space held.
    steps : float
        Steps of the wheel, positive away from the user.
    factor, dx, dz : float
        Spread and movement of two fingers since the last pinch message, the latter in css pixels.
    key : str
        By the name that browsers give it.
    width, height, ratio : float
        Size of the plot area in css pixels, and device pixels per css pixel.
    fresh : bool
        True for a view that has just appeared.
    """

    kind: str
    x: float = 0.0
    y: float = 0.0
    modifiers: frozenset[str] = frozenset()
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
        """Position in css pixels of the plot area."""
        return self.x, self.y


class GestureReader:
    """Convert a pane's messages to gestures in present-day coordinates.

    From a press to its release all messages use the projection at the press: a drag changes the restoration, and with
    it the picture under the pointer.
    """

    def __init__(self) -> None:
        self._projection: PaneProjection | None = None

    def read(self, message: PointerMessage, projection: PaneProjection) -> Gesture | None:
        """Return the gesture of a message, or None if it is not a gesture."""
        if message.kind == "press":
            self._projection = projection
        projection = self._projection or projection
        if message.kind == "release":
            self._projection = None
        return _gesture(message, projection)


def _gesture(message: PointerMessage, projection: PaneProjection) -> Gesture | None:
    if message.kind == "key":
        return Key(message.key, projection, message.modifiers)
    pixel, modifiers = message.pixel, message.modifiers
    point = projection.to_original(projection.view.to_section(pixel))
    reach = REACH * TOUCH_FACTOR if message.touch else REACH
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


def press_at(message: PointerMessage, projection: PaneProjection) -> Press:
    """Press of the main button at the position of a message."""
    pixel = message.pixel
    reach = REACH * TOUCH_FACTOR if message.touch else REACH
    return Press(projection.to_original(projection.view.to_section(pixel)), pixel, projection, reach=reach)


def axes_state(view: Viewport, left: float, note: str = "", titles: tuple[str, str] | None = None) -> dict[str, Any]:
    """Convert the axes of a view to what the pointer layer draws, with ``left`` css pixels left of the plot area.

    ``titles`` replace the names of the section's axes.
    """
    x, z = view.ticks()
    if titles:
        x, z = (replace(axis, title=title) for axis, title in zip((x, z), titles, strict=True))
    is_true = abs(view.exaggeration - 1) < 0.005
    scale = "true proportions" if is_true else f"V.E. {view.exaggeration:.3g}×"
    corner = f"{scale} · {note}" if note else scale
    return {"x": _axis_state(x), "z": _axis_state(z), "left": left, "note": corner}


def _axis_state(axis: Axis) -> dict[str, Any]:
    pixels = [round(pixel, 2) for pixel in axis.pixels]
    return {"title": axis.title, "pixels": pixels, "labels": list(axis.labels)}
