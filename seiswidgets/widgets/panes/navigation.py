"""What the wheel, a drag, two fingers and keys do to what a pane shows."""

from seiswidgets.widgets.panes.pointer import Happening
from seiswidgets.widgets.panes.view import View

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

    def moved(self, view: View, happening: Happening) -> View:
        """The view after what has happened, or the same one."""
        match happening.kind:
            case "wheel":
                return view.zoomed(ZOOM**happening.steps, happening.pixel)
            case "pinch":
                return view.panned(happening.dx, happening.dz).zoomed(happening.factor, happening.pixel)
            case "double":
                return view.fitted()
            case "key":
                return _by_key(view, happening.key)
            case "press":
                self._grip = happening.pixel
            case "drag" | "release" if self.is_panning:
                return self._dragged(view, happening)
        return view

    def _dragged(self, view, happening):
        (x, y), self._grip = self._grip, None if happening.kind == "release" else happening.pixel
        return view if happening.cancelled else view.panned(happening.x - x, happening.y - y)


def _by_key(view, key):
    if key == "0":
        return view.fitted()
    if key in ARROWS:
        return view.panned(*(STRIDE * way for way in ARROWS[key]))
    return view.zoomed(ZOOMS[key]) if key in ZOOMS else view
