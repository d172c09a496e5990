"""The private names of ipycanvas that seiswidgets relies on: the only module that uses them.

ipycanvas 0.14 sends all drawing through one manager, which has no public interface. It is needed for three things:

- to hold messages so that an exception does not stop all later drawing (``hold_canvas`` has no ``finally``);
- to name the canvas anew in each message, since a page that was reloaded has forgotten it;
- to send a picture in an encoding of our choice (``put_image_data`` encodes it itself).

Tests fail when a new version changes this, and ``pyproject.toml`` excludes versions that have not been tried.
"""

from collections.abc import Iterator
from contextlib import contextmanager

from ipycanvas import Canvas
from ipycanvas.canvas import _CANVAS_MANAGER, COMMANDS

from seiswidgets.widgets.jobs import UI_LOCK

CANVAS_MANAGER = _CANVAS_MANAGER


@contextmanager
def hold_canvases() -> Iterator[None]:
    """Send everything drawn inside as one message, or nothing after an exception. Holds may be nested."""
    with UI_LOCK:
        if CANVAS_MANAGER._caching:
            yield
            return
        CANVAS_MANAGER._caching = True
        try:
            yield
            CANVAS_MANAGER.flush()
        finally:
            CANVAS_MANAGER._caching = False
            CANVAS_MANAGER._commands_cache, CANVAS_MANAGER._buffers_cache = [], []
            CANVAS_MANAGER._current_canvas = None  # so that the next message names its canvas


def put_picture(canvas: Canvas, picture: bytes) -> None:
    """Replace the content of a canvas by an encoded picture of its size."""
    canvas.clear_rect(0, 0, canvas.width, canvas.height)
    CANVAS_MANAGER.send_draw_command(canvas, COMMANDS["putImageData"], [0, 0], [picture])
