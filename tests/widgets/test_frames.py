"""Messages of a frame of a drag: vertices and lines, but no mesh that the page has."""

import json

import ipywidgets
import pytest

import seiswidgets as sw
from tests.widgets import hands

MOST = 30_000  # bytes of a frame


@pytest.fixture
def frames(monkeypatch):
    """For each message of a drag to come, the bytes sent, and the names of what was sent of the picture."""
    frames = []

    def note(widget, message, buffers=None):
        size = len(json.dumps(message)) + sum(memoryview(part).nbytes for part in buffers or ())
        frames.append((size, list(message.get("state", ())) if "stages" in message.get("state", ()) else []))

    case = sw.synthetic.faulted_fold()
    app = sw.RestorationApp(case.section, case.interpretation, fixed=case.fixed)
    hands.appear(app.panes.original, app.panes.restored)
    app.wait(60)
    app.picker.mode = "horizon"
    start = case.interpretation.horizons[0].pieces[0][20]
    hands.press(app.panes.original, start)
    hands.drag_to(app.panes.original, start + (0.0, 20.0))
    monkeypatch.setattr(ipywidgets.Widget, "_send", note)

    def drag_to(drop):
        frames.clear()
        hands.drag_to(app.panes.original, start + (0.0, drop))
        return sum(size for size, _ in frames), [name for _, names in frames for name in names]

    yield drag_to
    app.close()


def test_while_a_mesh_is_kept_only_its_vertices_travel(frames):
    frames(22.0)
    size, sent = frames(24.0)
    assert 5_000 < size < MOST
    assert "stages" in sent
    assert "triangles" not in sent
