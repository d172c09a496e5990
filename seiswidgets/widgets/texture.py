"""Pictures on canvases that are not shown, from which a pane draws: sent once, zoomed and panned in the browser."""

import numpy as np
from ipycanvas import Canvas

from seiswidgets.geology.section import Section
from seiswidgets.widgets.canvas import encoded, put
from seiswidgets.widgets.colours import Colouring, resampled
from seiswidgets.widgets.view import View, Window

MOST = 2_000_000  # pixels of a picture of the whole section


class Texture:
    """The picture of a window of a section.

    Parameters
    ----------
    section : Section
    window : tuple (x_min, x_max, z_min, z_max)
        In the section's units; cut to the section, and to whole cells.
    most : tuple (width, height)
        Pixels that it has at most; nor has it more than the section has cells there.
    """

    def __init__(self, section: Section, window: Window, most: tuple[int, int]):
        origin, cell = np.array([section.x0, section.z0]), np.array([section.dx, section.dz])
        corners = (np.reshape(window, (2, 2)).T - origin) / cell + 0.5
        low = np.clip(np.floor(corners[0]), 0, np.array(section.shape[::-1]) - 1)
        high = np.clip(np.ceil(corners[1]), low + 1, section.shape[::-1])
        self.size = tuple(np.maximum(1, np.minimum(high - low, most)).astype(int).tolist())
        self.amplitude = resampled(section.amplitude, (*low, *high), self.size)
        self.corners = np.array([low, high]) * cell + origin - cell / 2
        self.canvas = Canvas(width=self.size[0], height=self.size[1])
        self.picture = b""

    def paint(self, colouring: Colouring) -> None:
        """Encode it in some colours, and send it."""
        self.picture = encoded(colouring.levels(self.amplitude), colouring.palette)
        self.send()

    def send(self) -> None:
        """Send it, to a page that knows nothing yet."""
        put(self.canvas, self.picture)

    def draw_on(self, canvas: Canvas, view: View) -> None:
        """Draw it on a canvas of the view's backing store, in its place."""
        (left, top), (right, bottom) = view.to_backing(self.corners).tolist()
        canvas.draw_image(self.canvas, left, top, right - left, bottom - top)

    def is_coarse(self, view: View) -> bool:
        """Whether a view has more pixels for it than it has."""
        return bool((np.diff(view.to_backing(self.corners), axis=0)[0] > self.size).any())

    def close(self) -> None:
        """Free the browser's memory."""
        self.canvas.close()


def whole(section: Section, view: View) -> Texture:
    """The picture of a whole section, decimated if it is large."""
    nz, nx = section.shape
    share = min(1.0, np.sqrt(MOST / (nz * nx)))
    return Texture(section, view.whole, (max(1, int(nx * share)), max(1, int(nz * share))))


def detail(section: Section, view: View) -> Texture:
    """The picture of what a view shows, as sharp as its pixels allow."""
    return Texture(section, view.window, view.backing)
