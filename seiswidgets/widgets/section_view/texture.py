"""Pictures on hidden canvases, from which a pane draws: sent once, then zoomed and panned in the browser."""

import numpy as np
from ipycanvas import Canvas

from seiswidgets.geology.section import Section
from seiswidgets.interaction.colour import encode_png, resampled
from seiswidgets.interaction.viewport import Viewport, Window
from seiswidgets.widgets.ipycanvas_compat import put_picture

MOST_PIXELS = 2_000_000  # in a picture of a whole section

Size = tuple[int, int]  # width and height
Sample = tuple[np.ndarray, Window]  # amplitudes, and the window that they cover


class Texture:
    """A hidden canvas with the picture of a window on it; without a picture at first.

    One canvas serves picture after picture: creating and closing canvases costs the browser more than drawing on them.

    Attributes
    ----------
    size : tuple (width, height)
        Size of the picture.
    picture : bytes
        The encoded picture; empty if there is none.
    """

    def __init__(self) -> None:
        self._canvas: Canvas | None = None
        self._window: Window = 0.0, 1.0, 0.0, 1.0
        self.size, self.picture = (0, 0), b""

    def paint(self, levels: np.ndarray, palette: np.ndarray, window: Window) -> None:
        """Encode levels in the colours of a palette, and send them; see `encode_png`."""
        self.size, self._window = levels.shape[::-1], window
        self.picture = encode_png(levels, palette)
        self.send()

    def send(self) -> None:
        """Send the picture, if there is one."""
        if self.picture:
            self._canvas = self._canvas or Canvas(width=self.size[0], height=self.size[1])
            resize(self._canvas, *self.size)
            put_picture(self._canvas, self.picture)

    def forget(self) -> None:
        """Drop the picture."""
        self.picture = b""

    def draw_on(self, canvas: Canvas, view: Viewport) -> None:
        """Draw the picture, if there is one, on a canvas of the size of the view's backing store."""
        if self.picture:
            (left, top), (right, bottom) = self._corners(view).tolist()
            canvas.draw_image(self._canvas, left, top, right - left, bottom - top)

    def is_coarse(self, view: Viewport) -> bool:
        """Return True if a view has more pixels for the picture than the picture has."""
        return bool((np.diff(self._corners(view), axis=0)[0] > self.size).any())

    def _corners(self, view: Viewport) -> np.ndarray:
        return view.to_backing(np.reshape(self._window, (2, 2)).T)


def resize(canvas: Canvas, width: int, height: int) -> None:
    """Resize a canvas in one message, unless it has that size already; it is empty afterwards."""
    if (canvas.width, canvas.height) != (width, height):
        with canvas.hold_sync():
            canvas.width, canvas.height = width, height


def whole(section: Section, view: Viewport) -> Sample:
    """All amplitudes of a section, averaged if there are many."""
    return _sample(section, view.covered, _reduced(section.shape[::-1], MOST_PIXELS))


def detail(section: Section, view: Viewport) -> Sample:
    """Amplitudes in a view, as fine as its pixels allow."""
    return _sample(section, view.window, view.backing)


def _sample(section: Section, window: Window, most: Size) -> Sample:
    """Amplitudes of the cells that cover a window, averaged onto ``most`` pixels or fewer, and the cells' window."""
    origin, cell = np.array([section.x0, section.z0]), np.array([section.dx, section.dz])
    corners = (np.reshape(window, (2, 2)).T - origin) / cell + 0.5
    low = np.clip(np.floor(corners[0]), 0, np.array(section.shape[::-1]) - 1).astype(int)
    high = np.clip(np.ceil(corners[1]), low + 1, section.shape[::-1]).astype(int)
    width, height = np.maximum(1, np.minimum(high - low, most)).tolist()
    amplitude = resampled(section.amplitude[low[1] : high[1], low[0] : high[0]], (width, height))
    (x_min, z_min), (x_max, z_max) = (np.array([low, high]) * cell + origin - cell / 2).tolist()
    return amplitude, (x_min, x_max, z_min, z_max)


def _reduced(size: Size, most: int) -> Size:
    """Size of the same proportions with ``most`` pixels or fewer."""
    share = min(1.0, np.sqrt(most / (size[0] * size[1])))
    return max(1, int(size[0] * share)), max(1, int(size[1] * share))
