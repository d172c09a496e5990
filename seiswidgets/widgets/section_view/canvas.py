"""What ipycanvas lacks: holds that survive an exception, and pictures in the encoding that suits."""

from contextlib import contextmanager
from io import BytesIO

import numpy as np
from ipycanvas import Canvas
from ipycanvas.canvas import _CANVAS_MANAGER, COMMANDS
from PIL import Image

from seiswidgets.widgets.jobs import UI_LOCK


@contextmanager
def held():
    """Send all that is drawn inside in one message; nothing of it after an exception. Holds may be nested."""
    with UI_LOCK:
        if _CANVAS_MANAGER._caching:
            yield
            return
        _CANVAS_MANAGER._caching = True
        try:
            yield
            _CANVAS_MANAGER.flush()
        finally:
            _CANVAS_MANAGER._caching = False
            _forget()


def _forget():
    """Drop what is queued; and name the canvas at the start of each message, as a page that was reloaded knows none."""
    _CANVAS_MANAGER._commands_cache, _CANVAS_MANAGER._buffers_cache = [], []
    _CANVAS_MANAGER._current_canvas = None


def encoded(levels: np.ndarray, palette: np.ndarray, quick: bool = False) -> bytes:
    """A picture as a PNG with a palette, which keeps every colour and what is transparent.

    A JPEG is a third of the size but takes as long to encode (measured at 450 x 300 and 900 x 600), and knows nothing
    transparent: where there are no data it would flicker between moving and still.

    Parameters
    ----------
    levels : array of uint8, shape (height, width)
    palette : array of uint8, shape (256, 4)
        Red, green, blue and opacity.
    quick : bool
        Whether time counts more than size.
    """
    picture = Image.fromarray(levels)
    picture.putpalette(palette[:, :3].tobytes())
    file = BytesIO()
    picture.save(file, "PNG", transparency=palette[:, 3].tobytes(), compress_level=1 if quick else 3)
    return file.getvalue()


def resize(canvas: Canvas, width: int, height: int) -> None:
    """Give a canvas a size, in one message, if it has another; it is empty afterwards."""
    if (canvas.width, canvas.height) != (width, height):
        with canvas.hold_sync():
            canvas.width, canvas.height = width, height


def put(canvas: Canvas, picture: bytes) -> None:
    """Replace what is on a canvas by an encoded picture of its size."""
    canvas.clear_rect(0, 0, canvas.width, canvas.height)
    _CANVAS_MANAGER.send_draw_command(canvas, COMMANDS["putImageData"], [0, 0], [picture])
