"""What ipycanvas lacks: holds that survive an exception, and pictures in the encoding that suits."""

from contextlib import contextmanager
from io import BytesIO
from threading import RLock

import numpy as np
from ipycanvas import Canvas
from ipycanvas.canvas import _CANVAS_MANAGER, COMMANDS
from PIL import Image

LOCK = RLock()  # callbacks may run on several threads, and all canvases share one manager
JPEG_QUALITY = 80


@contextmanager
def held():
    """Send all that is drawn inside in one message; nothing of it after an exception. Holds may be nested."""
    with LOCK:
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


def encoded(levels: np.ndarray, palette: np.ndarray, moving: bool = False) -> bytes:
    """A picture as a PNG with a palette whose colour 0 is transparent, or while it moves as a JPEG, which is faster.

    Parameters
    ----------
    levels : array of uint8, shape (height, width)
    palette : array of uint8, shape (256, 3)
    moving : bool
    """
    file = BytesIO()
    if moving:
        Image.fromarray(palette[levels]).save(file, "JPEG", quality=JPEG_QUALITY)
    else:
        picture = Image.fromarray(levels)
        picture.putpalette(palette.tobytes())
        picture.save(file, "PNG", transparency=0, compress_level=3)
    return file.getvalue()


def put(canvas: Canvas, picture: bytes) -> None:
    """Replace what is on a canvas by an encoded picture of its size."""
    canvas.clear_rect(0, 0, canvas.width, canvas.height)
    _CANVAS_MANAGER.send_draw_command(canvas, COMMANDS["putImageData"], [0, 0], [picture])
