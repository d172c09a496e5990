from importlib.metadata import version
from io import BytesIO

import ipycanvas.canvas
import numpy as np
import pytest
from ipycanvas import Canvas, MultiCanvas
from PIL import Image

from seiswidgets.widgets.ipycanvas_compat import CANVAS_MANAGER, hold_canvases, put_picture


@pytest.fixture(autouse=True)
def no_current_canvas():
    """As after a message of ours: the next one names its canvas."""
    with hold_canvases():
        pass


def test_the_private_names_of_ipycanvas_are_still_there():
    """If this fails, see what a new version has changed, adapt `ipycanvas_compat`, and move the upper pin."""
    assert version("ipycanvas").startswith("0.14.")
    assert ipycanvas.canvas._CANVAS_MANAGER is CANVAS_MANAGER
    assert {"_caching", "_commands_cache", "_buffers_cache", "_current_canvas"} <= set(vars(CANVAS_MANAGER))
    assert {"switchCanvas", "putImageData"} <= set(ipycanvas.canvas.COMMANDS)


def test_a_hold_sends_one_message_that_names_each_canvas(sent):
    first, second = MultiCanvas(2, width=4, height=3)
    with hold_canvases():
        first.fill_rect(0, 0, 1, 1)
        with hold_canvases():
            second.fill_rect(0, 0, 1, 1)
        second.stroke_rect(0, 0, 1, 1)
        assert not sent
    assert [message.names for message in sent] == [
        ["switchCanvas", "fillRect", "switchCanvas", "fillRect", "strokeRect"]
    ]


def test_each_message_names_its_canvas_for_a_page_that_was_reloaded(sent):
    canvas = Canvas()
    for _ in range(2):
        with hold_canvases():
            canvas.fill_rect(0, 0, 1, 1)
    assert [message.names for message in sent] == [["switchCanvas", "fillRect"]] * 2


def test_after_an_exception_nothing_of_a_hold_is_sent_and_drawing_goes_on(sent):
    canvas = Canvas()
    with pytest.raises(ValueError, match="inside"), hold_canvases():  # noqa: PT012
        canvas.fill_rect(0, 0, 1, 1)
        raise ValueError("inside")
    assert not sent
    canvas.stroke_rect(0, 0, 1, 1)
    assert [message.names for message in sent] == [["switchCanvas"], ["strokeRect"]]


def test_a_picture_is_sent_as_it_was_encoded(sent):
    pixels = np.arange(2 * 3 * 4, dtype=np.uint8).reshape(2, 3, 4)
    file = BytesIO()
    Image.fromarray(pixels).save(file, "PNG")
    with hold_canvases():
        put_picture(Canvas(width=3, height=2), file.getvalue())
    assert sent[0].names == ["switchCanvas", "clearRect", "putImageData"]
    assert bytes(sent[0].pictures[0]) == file.getvalue()
    assert (sent[0].image() == pixels).all()
