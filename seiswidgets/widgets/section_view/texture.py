"""Pictures on canvases that are not shown, from which a pane draws: sent once, zoomed and panned in the browser."""

import numpy as np
from ipycanvas import Canvas

from seiswidgets.geology.section import Section
from seiswidgets.interaction.colour import resampled
from seiswidgets.interaction.viewport import Viewport, Window
from seiswidgets.widgets.section_view.canvas import encoded, put, resize

MOST = 2_000_000  # pixels of a picture of a whole section
FEW = 150_000  # of one that moves: more take longer to encode than a drag may


class Texture:
    """A canvas that is not shown, and the picture of a window on it; there is none at first.

    One canvas serves picture after picture: making and closing canvases costs the browser more than drawing on them.

    Attributes
    ----------
    size : tuple (width, height)
        Of the picture.
    picture : bytes
        Encoded; empty if there is none.
    """

    def __init__(self):
        self._canvas, self._window = None, None
        self.size, self.picture = (0, 0), b""

    def paint(self, levels: np.ndarray, palette: np.ndarray, window: Window, quick: bool = False) -> None:
        """Encode levels in the colours of a palette, and send them; see `encoded`."""
        self.size, self._window = levels.shape[::-1], window
        self.picture = encoded(levels, palette, quick)
        self.send()

    def send(self) -> None:
        """Send the picture, if there is one, to a page that may know nothing yet."""
        if self.picture:
            self._canvas = self._canvas or Canvas(width=self.size[0], height=self.size[1])
            resize(self._canvas, *self.size)
            put(self._canvas, self.picture)

    def forget(self) -> None:
        """Have no picture until the next one is painted."""
        self.picture = b""

    def draw_on(self, canvas: Canvas, view: Viewport) -> None:
        """Draw the picture, if there is one, on a canvas of the view's backing store, in its place."""
        if self.picture:
            (left, top), (right, bottom) = self._corners(view).tolist()
            canvas.draw_image(self._canvas, left, top, right - left, bottom - top)

    def is_coarse(self, view: Viewport) -> bool:
        """Whether a view has more pixels for the picture than it has."""
        return bool((np.diff(self._corners(view), axis=0)[0] > self.size).any())

    def _corners(self, view):
        return view.to_backing(np.reshape(self._window, (2, 2)).T)


def whole(section: Section, view: Viewport) -> tuple[np.ndarray, Window]:
    """All amplitudes of a section, decimated if they are many, and the window that they cover."""
    return _sample(section, view.covered, _fewer(section.shape[::-1], MOST))


def detail(section: Section, view: Viewport) -> tuple[np.ndarray, Window]:
    """What a view shows of a section, as fine as its pixels allow, and the window of that."""
    return _sample(section, view.window, view.backing)


def preview(section: Section, view: Viewport) -> tuple[np.ndarray, Window]:
    """What a view shows of a section, as coarse as must be to follow a drag, and the window of that."""
    return _sample(section, view.window, _fewer(view.backing, FEW))


def _sample(section, window, most):
    """Amplitudes of the whole cells in a window, averaged onto so many pixels at most, and the cells' own window."""
    origin, cell = np.array([section.x0, section.z0]), np.array([section.dx, section.dz])
    corners = (np.reshape(window, (2, 2)).T - origin) / cell + 0.5
    low = np.clip(np.floor(corners[0]), 0, np.array(section.shape[::-1]) - 1).astype(int)
    high = np.clip(np.ceil(corners[1]), low + 1, section.shape[::-1]).astype(int)
    size = tuple(np.maximum(1, np.minimum(high - low, most)).tolist())
    amplitude = resampled(section.amplitude[low[1] : high[1], low[0] : high[0]], size)
    return amplitude, tuple((np.array([low, high]) * cell + origin - cell / 2).T.ravel().tolist())


def _fewer(size, most):
    """A size of the same proportions with so many pixels at most."""
    share = min(1.0, np.sqrt(most / (size[0] * size[1])))
    return tuple(max(1, int(length * share)) for length in size)
