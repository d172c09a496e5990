"""Zooming and panning of a pane by the wheel, drags, two fingers and keys."""

from seiswidgets.interaction.messages import PointerMessage
from seiswidgets.interaction.viewport import Viewport

WHEEL_ZOOM = 1.2  # factor per step
KEY_ZOOM = 1.5
STRIDE = 60  # css pixels that an arrow key pans
ARROWS = {"ArrowLeft": (1, 0), "ArrowRight": (-1, 0), "ArrowUp": (0, 1), "ArrowDown": (0, -1)}
ZOOMS = {"+": KEY_ZOOM, "=": KEY_ZOOM, "-": 1 / KEY_ZOOM, "_": 1 / KEY_ZOOM}
KEYS = ("0", *ZOOMS, *ARROWS)


class Navigation:
    """Zoom and pan views by messages; between them it keeps only the pointer's last position in a drag."""

    def __init__(self) -> None:
        self._grip: tuple[float, float] | None = None

    @property
    def is_panning(self) -> bool:
        """True while a drag is in progress."""
        return self._grip is not None

    def navigate(self, view: Viewport, message: PointerMessage) -> Viewport:
        """Return the view after a message, the same one if it changes nothing."""
        match message.kind:
            case "wheel":
                return view.zoomed(WHEEL_ZOOM**message.steps, message.pixel)
            case "pinch":
                return view.panned(message.dx, message.dz).zoomed(message.factor, message.pixel)
            case "double":
                return view.fitted()
            case "key":
                return _navigated_by_key(view, message.key)
            case "press":
                self._grip = message.pixel
            case "drag" | "release":
                return self._dragged(view, message)
        return view

    def _dragged(self, view: Viewport, message: PointerMessage) -> Viewport:
        if self._grip is None:
            return view
        (x, y), self._grip = self._grip, None if message.kind == "release" else message.pixel
        return view if message.cancelled else view.panned(message.x - x, message.y - y)


def _navigated_by_key(view: Viewport, key: str) -> Viewport:
    if key == "0":
        return view.fitted()
    if key in ARROWS:
        x, y = ARROWS[key]
        return view.panned(STRIDE * x, STRIDE * y)
    return view.zoomed(ZOOMS[key]) if key in ZOOMS else view
