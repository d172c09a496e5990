"""What the wheel, a drag, two fingers and keys do to what a pane shows."""

from seiswidgets.interaction.messages import PointerMessage
from seiswidgets.interaction.viewport import Viewport

ZOOM = 1.2  # a step of the wheel
CLOSER = 1.5  # a key
STRIDE = 60  # css pixels that an arrow key pans
ARROWS = {"ArrowLeft": (1, 0), "ArrowRight": (-1, 0), "ArrowUp": (0, 1), "ArrowDown": (0, -1)}
ZOOMS = {"+": CLOSER, "=": CLOSER, "-": 1 / CLOSER, "_": 1 / CLOSER}
KEYS = ("0", *ZOOMS, *ARROWS)


class Navigation:
    """Makes a view of a view and what happens; in between it knows only where a drag has taken hold."""

    def __init__(self):
        self._grip = None

    @property
    def is_panning(self) -> bool:
        """Whether a drag is under way."""
        return self._grip is not None

    def moved(self, view: Viewport, message: PointerMessage) -> Viewport:
        """The view after what has happened, or the same one."""
        match message.kind:
            case "wheel":
                return view.zoomed(ZOOM**message.steps, message.pixel)
            case "pinch":
                return view.panned(message.dx, message.dz).zoomed(message.factor, message.pixel)
            case "double":
                return view.fitted()
            case "key":
                return _by_key(view, message.key)
            case "press":
                self._grip = message.pixel
            case "drag" | "release" if self.is_panning:
                return self._dragged(view, message)
        return view

    def _dragged(self, view, message):
        (x, y), self._grip = self._grip, None if message.kind == "release" else message.pixel
        return view if message.cancelled else view.panned(message.x - x, message.y - y)


def _by_key(view, key):
    if key == "0":
        return view.fitted()
    if key in ARROWS:
        return view.panned(*(STRIDE * way for way in ARROWS[key]))
    return view.zoomed(ZOOMS[key]) if key in ZOOMS else view
