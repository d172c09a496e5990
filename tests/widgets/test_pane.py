import json

import ipywidgets
import numpy as np
import pytest
from ipycanvas.canvas import _CANVAS_MANAGER, COMMANDS

import seiswidgets as sw
from seiswidgets.widgets.canvas import held
from seiswidgets.widgets.gestures import DoubleClick, Key, Press
from seiswidgets.widgets.overlay import Stroke

NAMES = {number: name for name, number in COMMANDS.items()}
SIZE = {"kind": "size", "width": 800, "height": 400, "ratio": 2, "fresh": True}
QUIET = 2000  # bytes that a step of zooming or panning may send


@pytest.fixture(autouse=True)
def loud_callbacks(monkeypatch):
    """Callbacks that fail, fail the test: ipywidgets would log that and go on."""

    def call(self, *args, **kwargs):
        return [callback(*args, **kwargs) for callback in self.callbacks]

    monkeypatch.setattr(ipywidgets.CallbackDispatcher, "__call__", call)


@pytest.fixture
def sent(monkeypatch):
    """All messages to canvases: their commands' names and arguments, and their size in bytes."""
    messages = []

    def send(content, buffers=None):
        commands = json.loads(bytes(buffers[0]))
        commands = commands if isinstance(commands[0], list) else [commands]
        size = sum(memoryview(buffer).nbytes for buffer in buffers)
        messages.append(([(NAMES[command[0]], *command[1:2]) for command in commands], size))

    monkeypatch.setattr(_CANVAS_MANAGER, "send", send)
    return messages


@pytest.fixture
def section():
    amplitude = np.sin(np.arange(200) / 7)[:, None] * np.ones(300)
    return sw.Section(amplitude, dx=10, dz=5, name="stripes")


def tell(pane, kind, **content):
    pane.layer._handle_custom_msg({"kind": kind, **content}, [])


def shown(section, **settings):
    pane = sw.SectionPane(section, **settings)
    pane.layer._handle_custom_msg(SIZE, [])
    return pane


def names(message):
    return [command[0] for command in message[0]]


def test_nothing_is_drawn_for_nobody(section, sent):
    pane = sw.SectionPane(section)
    pane.colours = "red-white-blue"
    pane.view = pane.view.zoomed(2)
    assert not sent


def test_a_page_that_comes_is_sent_everything_in_one_message(section, sent):
    pane = shown(section)
    assert len(sent) == 1
    assert {"putImageData", "drawImage"} <= set(names(sent[0]))
    assert names(sent[0])[0] == "switchCanvas"
    assert pane.view.backing == (1600, 800)
    assert (pane._canvas.width, pane._canvas.height) == (1600, 800)


def test_the_wheel_zooms_at_the_pointer(section, sent):
    pane = shown(section)
    before = pane.view.to_section((200, 100))
    tell(pane, "wheel", x=200, y=100, steps=3)
    np.testing.assert_allclose(pane.view.to_section((200, 100)), before)
    assert pane.view.pixel[0] < pane.view.fitted().pixel[0]


def test_a_drag_pans_and_a_double_click_fits(section, sent):
    pane = shown(section)
    tell(pane, "wheel", x=400, y=200, steps=4)
    grasped = pane.view.to_section((400, 200))
    tell(pane, "press", x=400, y=200)
    tell(pane, "drag", x=420, y=210)
    tell(pane, "release", x=440, y=190)
    np.testing.assert_allclose(pane.view.to_section((440, 190)), grasped)
    tell(pane, "hover", x=500, y=300)
    np.testing.assert_allclose(pane.view.to_section((440, 190)), grasped)
    tell(pane, "double", x=400, y=200)
    assert pane.view.is_fitted


@pytest.mark.parametrize(("key", "closer"), [("+", True), ("=", True), ("-", False)])
def test_keys_zoom_and_0_fits(section, sent, key, closer):
    pane = shown(section)
    tell(pane, "key", key=key)
    assert (pane.view.pixel[0] < pane.view.fitted().pixel[0]) == closer
    tell(pane, "key", key="0")
    assert pane.view.is_fitted


def test_zooming_and_panning_send_little(section, sent):
    pane = shown(section)
    updates = []
    pane.layer.observe(lambda change: updates.append(len(json.dumps(change.new))), ["axes", "window"])
    for kind in ("wheel", "press", "drag", "release"):
        sent.clear(), updates.clear()
        tell(pane, kind, x=100 + 10 * len(kind), y=100, **({"steps": 1} if kind == "wheel" else {}))
        assert sum(size for _, size in sent) + sum(updates) < QUIET
        assert "putImageData" not in [name for message in sent for name in names(message)]


def test_drags_are_answered_even_if_they_fail(section, sent, monkeypatch):
    pane, answers = shown(section), []
    monkeypatch.setattr(pane.layer, "send", lambda content, buffers=None: answers.append(content))
    pane.on_gesture(lambda gesture: 1 / 0)
    with pytest.raises(ZeroDivisionError):
        tell(pane, "drag", x=1, y=1)
    assert answers == [{"kind": "answer", "to": "drag"}]
    assert "ZeroDivisionError" in pane.message


def test_an_error_is_said_below_the_pane_with_its_names_escaped(section, sent):
    def fail(gesture):
        raise sw.PickError("fault '<img src=x>' crosses itself")

    pane = shown(section)
    pane.on_gesture(fail)
    tell(pane, "press", x=1, y=1)
    assert pane.message.startswith("fault '<img")
    assert "&lt;img" in pane._line.value
    assert "<img" not in pane._line.value
    assert pane._line.layout.display == ""


def test_gestures_that_are_consumed_do_not_pan(section, sent):
    pane, seen = shown(section), []
    pane.on_gesture(lambda gesture: seen.append(gesture) or True)
    for kind in ("press", "drag", "release", "double"):
        tell(pane, kind, x=300, y=100, modifiers=["ctrl"])
    tell(pane, "key", key="0")
    assert pane.view.is_fitted
    assert isinstance(seen[0], Press)
    assert isinstance(seen[3], DoubleClick)
    assert seen[4] == Key("0")
    assert seen[0].modifiers == {"ctrl"}
    np.testing.assert_allclose(seen[0].point, pane.view.to_section((300, 100)))


def test_settings_are_checked(section):
    pane = sw.SectionPane(section)
    with pytest.raises(sw.SettingError, match="clip must be a percentile"):
        pane.clip = 101
    with pytest.raises(sw.SettingError, match="gain must be"):
        pane.gain = 0
    with pytest.raises(sw.SettingError, match="'rainbowish'"):
        pane.colours = "rainbowish"
    with pytest.raises(sw.SettingError, match="exaggeration"):
        pane.exaggeration = -1.0


def test_exaggeration_follows_the_view_and_the_view_follows_it(section, sent):
    pane = shown(section)
    pane.exaggeration = 3.0
    assert pane.view.exaggeration == pytest.approx(3)
    assert "3" in pane.layer.axes["note"]
    pane.fit()
    assert pane.exaggeration == pytest.approx(pane.view.exaggeration)


@pytest.mark.parametrize("change", [{"colours": "seismic"}, {"clip": 50.0}, {"gain": 2.0}, {"polarity": -1}])
def test_other_colours_send_another_picture(section, sent, change):
    pane = shown(section)
    before = pane._texture.picture
    for name, value in change.items():
        setattr(pane, name, value)
    assert pane._texture.picture != before
    assert "putImageData" in names(sent[-1])


def test_a_large_section_is_decimated_and_sharpened(sent):
    pane = shown(sw.Section(np.random.default_rng(0).normal(size=(2000, 3000)).astype(np.float32), dx=1, dz=1))
    assert np.prod(pane._texture.size) <= 2_000_000
    tell(pane, "wheel", x=400, y=200, steps=12)
    assert pane._detail is None
    tell(pane, "rest")
    assert pane._detail is not None
    assert not pane._detail.is_coarse(pane.view) or pane._detail.size[0] >= 3000 * 800 * pane.view.pixel[0] / 3000


def test_another_section_of_the_same_size_keeps_the_window(section, sent):
    pane = shown(section)
    tell(pane, "wheel", x=200, y=100, steps=3)
    window = pane.view.window
    pane.section = sw.Section(-section.amplitude, dx=10, dz=5)
    assert pane.view.window == window
    pane.section = sw.Section(section.amplitude[:50], dx=10, dz=5)
    assert pane.view.is_fitted


def test_lines_with_gaps_are_drawn_without_them(section, sent):
    pane = shown(section)
    points = [[0, 0], [100, 100], [np.nan, np.nan], [500, 200], [600, 300], [1e9, 0]]
    pane.draw_lines([Stroke(points, dots=True)])
    assert names(sent[-1]).count("strokeLines") == 4
    assert "NaN" not in json.dumps(sent[-1][0])


def test_a_hold_survives_an_exception(section, sent):
    pane = shown(section)
    sent.clear()
    with pytest.raises(ValueError, match="inside"), held():  # noqa: PT012
        pane._canvas[0].fill_rect(0, 0, 1, 1)
        raise ValueError("inside")
    assert not sent
    assert not _CANVAS_MANAGER._caching
    pane._canvas[0].fill_rect(0, 0, 1, 1)
    assert [names(message) for message in sent] == [["switchCanvas"], ["fillRect"]]


def test_a_section_with_little_data_is_drawn(sent):
    pane = shown(sw.Section([[0.0, np.nan], [0.0, np.nan]], dx=1, dz=1))
    assert "drawImage" in names(sent[-1])
    assert pane._colouring().levels(pane._texture.amplitude).tolist() == [[128, 0], [128, 0]]
