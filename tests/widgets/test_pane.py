import json

import numpy as np
import pytest
from comm import DummyComm

import seiswidgets as sw
from seiswidgets.interaction.gestures import DoubleClick, Key, Move, Press, Release
from seiswidgets.interaction.overlay import Mark, Overlay, Stroke, stroke_points
from seiswidgets.widgets.section_view.texture import MOST_PIXELS

SIZE = {"kind": "size", "width": 800, "height": 400, "ratio": 2, "fresh": True}
QUIET = 2000  # bytes that a step of zooming or panning may send


@pytest.fixture
def published(monkeypatch):
    """All that any widget sends: the kind of the message, its data, and its size in bytes."""
    messages = []

    def publish(self, kind, data=None, metadata=None, buffers=None, **keys):
        size = len(json.dumps(data)) + sum(memoryview(buffer).nbytes for buffer in buffers or ())
        messages.append((kind, data, size))

    monkeypatch.setattr(DummyComm, "publish_msg", publish)
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


def test_nothing_is_drawn_for_nobody(section, sent):
    pane = sw.SectionPane(section)
    pane.colours = "red-white-blue"
    pane.view = pane.view.zoomed(2)
    assert not sent


def test_a_page_that_comes_is_sent_everything_in_one_message(section, sent):
    pane = shown(section)
    assert len(sent) == 1
    assert {"putImageData", "drawImage"} <= set(sent[0].names)
    assert sent[0].names[0] == "switchCanvas"
    assert pane.view.backing == (1600, 800)
    assert (pane._painter.canvas.width, pane._painter.canvas.height) == (1600, 800)


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


def test_zooming_and_panning_send_little(section, published):
    pane, rng = shown(section), np.random.default_rng(2)
    pane.draw_lines([Stroke(rng.uniform(0, 1000, (100, 2)), dots=True, label=f"H{k}") for k in range(10)])
    pane.draw_marks([Mark(point, "cutoff", "1") for point in rng.uniform(0, 1000, (10, 2))])
    pane.mesh = rng.uniform(0, 1000, (30, 2)), rng.integers(0, 30, (60, 3))
    pane.overlay = Overlay(np.zeros((90, 90), np.uint8), np.zeros((256, 4), np.uint8), (0, 1000, 0, 900))
    steps = [("wheel", {"steps": 1}), ("pinch", {"factor": 1.1, "dx": 3, "dz": 2}), ("press", {}), ("drag", {})]
    for kind, more in [*steps, ("release", {}), ("key", {"key": "+"})]:
        published.clear()
        tell(pane, kind, x=100 + 10 * len(kind), y=100, **more)
        assert sum(size for _, _, size in published) < QUIET
    assert not pane.view.is_fitted


def test_drags_are_answered_even_if_they_fail(section, sent, monkeypatch):
    pane, answers = shown(section), []
    monkeypatch.setattr(pane.layer, "send", lambda content, buffers=None: answers.append(content))
    pane.on_gesture(lambda gesture: 1 / 0)
    with pytest.raises(ZeroDivisionError):
        tell(pane, "drag", x=1, y=1)
    assert [(answer["kind"], answer["to"]) for answer in answers] == [("answer", "drag")]
    assert answers[0]["took"] >= 0
    assert "ZeroDivisionError" in pane.message


def test_an_error_is_said_below_the_pane_with_its_names_escaped(section, sent):
    def fail(gesture):
        raise sw.PickError("fault '<img src=x>' crosses itself")

    pane = shown(section)
    pane.on_gesture(fail)
    tell(pane, "press", x=1, y=1)
    assert pane.message.startswith("fault '<img")
    assert "&lt;img" in pane.message_line.value
    assert "<img" not in pane.message_line.value
    assert pane.message_line.layout.display == ""


def test_gestures_that_are_consumed_do_not_pan(section, sent):
    pane, seen = shown(section), []
    pane.on_gesture(lambda gesture: seen.append(gesture) or True)
    for kind in ("press", "drag", "release", "double"):
        tell(pane, kind, x=300, y=100, modifiers=["ctrl"])
    tell(pane, "key", key="0")
    assert pane.view.is_fitted
    assert isinstance(seen[0], Press)
    assert isinstance(seen[3], DoubleClick)
    assert (type(seen[4]), seen[4].name) == (Key, "0")
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


@pytest.mark.parametrize(
    "change", [{"colours": "seismic"}, {"clip": 50.0}, {"gain": 2.0}, {"polarity": -1}, {"limit": 0.5}]
)
def test_other_colours_send_another_picture(section, sent, change):
    pane = shown(section)
    for name, value in change.items():
        setattr(pane, name, value)
    assert len(sent) == 2
    assert sent[1].pictures != sent[0].pictures


def test_a_large_section_is_decimated_and_sharpened(sent):
    pane = shown(sw.Section(np.random.default_rng(0).normal(size=(2000, 3000)).astype(np.float32), dx=1, dz=1))
    assert sent[-1].image().size / 4 <= MOST_PIXELS
    tell(pane, "wheel", x=400, y=200, steps=12)
    assert not sent[-1].pictures
    tell(pane, "rest")
    cells = np.diff(np.reshape(pane.view.window, (2, 2))).ravel()
    assert np.subtract(sent[-1].image().shape[1::-1], cells) == pytest.approx(1, abs=1)  # each cell that is seen
    before = len(sent)
    tell(pane, "rest")
    assert len(sent) == before


def test_another_section_keeps_the_window_unless_all_of_it_was_shown(section, sent):
    pane = shown(section)
    pane.section = shallow = sw.Section(section.amplitude[:50], dx=10, dz=5)
    assert pane.view.is_fitted
    tell(pane, "wheel", x=200, y=100, steps=3)
    window = pane.view.window
    pane.section = section
    assert pane.view.window == window
    pane.section = shallow
    assert pane.view.window == window
    pane.section = sw.Section(section.amplitude, dx=10, dz=5, z_unit="ms", velocity=2000)
    assert pane.view.is_fitted


def test_a_frame_is_what_fits(section, sent):
    pane = shown(section)
    pane.frame = -500, 4000, -100, 1500
    assert pane.view.window == (-500, 4000, -100, 1500)
    pane.section = sw.Section(section.amplitude[:50], dx=10, dz=5)
    assert pane.view.window == (-500, 4000, -100, 1500)
    tell(pane, "wheel", x=200, y=100, steps=3)
    window = pane.view.window
    pane.frame = None
    assert pane.view.window == window
    pane.fit()
    assert pane.view.window == (-5, 2995, -2.5, 247.5)
    with pytest.raises(sw.SettingError, match=r"frame must be \(x_min"):
        pane.frame = 1, 0, 0, 1


def test_a_canvas_is_resized_before_it_is_painted(section, published):
    pane = shown(section)
    published.clear()
    pane.section = sw.Section(section.amplitude[:50], dx=10, dz=5)
    data = [data for _, data, _ in published]
    assert {"height": 50} in [message["state"] for message in data[:-1]]
    assert data[-1]["method"] == "custom"


def test_an_overlay_lies_over_the_section(section, sent):
    pane = shown(section)
    palette = np.random.default_rng(0).integers(0, 256, (256, 4), np.uint8)
    levels = np.arange(240, dtype=np.uint8).reshape(12, 20)
    pane.overlay = Overlay(levels, palette, (0, 1000, 0, 500))
    drawing = sent[-1]
    assert (drawing.image() == palette[levels]).all()
    (left, top), (right, bottom) = pane.view.to_backing([(0, 0), (1000, 500)])
    np.testing.assert_allclose(drawing.commands[-1][1][1:], [left, top, right - left, bottom - top])
    assert drawing.commands[-2] == ("set", [drawing.commands[-2][1][0], 0.6])
    assert drawing.names.count("drawImage") == 2
    pane.overlay = Overlay(levels, palette[::-1], (0, 1000, 0, 500))
    assert (sent[-1].image() == palette[::-1][levels]).all()
    assert len(sent[-1].pictures) == 1
    pane.overlay_opacity = 0.2
    assert not sent[-1].pictures
    tell(pane, **SIZE)
    assert len(sent[-1].pictures) == 2  # to a page that knows nothing
    pane.overlay = None
    assert sent[-1].names.count("drawImage") == 1
    with pytest.raises(sw.SettingError, match="overlay_opacity must be from 0 to 1, but is 2"):
        pane.overlay_opacity = 2


def test_what_the_layer_draws_it_is_told_in_the_units_of_the_section(section):
    pane = sw.SectionPane(section)
    pane.draw_lines([Stroke([[0, 0], [np.nan, 1], [1e9, 0]], dash=(3, 2), label="<b>", chosen=2)])
    (stroke,) = pane.layer.strokes
    np.testing.assert_array_equal(stroke_points(stroke), [[0, 0], [np.nan] * 2, [1e9, 0]])
    assert (stroke["dash"], stroke["label"], stroke["chosen"], stroke["dots"]) == ([3, 2], "<b>", 2, False)
    pane.draw_marks([Mark((1, 2), "cutoff", "7"), Mark((np.nan, 2), "held")])
    assert pane.layer.marks == [{"x": 1, "z": 2, "kind": "cutoff", "text": "7", "colour": "#212121", "path": ""}]
    pane.rubber = np.array([[1, 2], [np.nan, 3], [4, 5]])
    assert pane.layer.rubber == [[1, 2], [4, 5]]
    assert pane.rubber == ((1, 2), (4, 5))
    pane.rubber = ()
    assert pane.layer.rubber == []


def test_a_mesh_and_maps_are_sent_as_bytes(section):
    pane = sw.SectionPane(section, mesh_opacity=0.3)
    vertices, triangles = [[0, 0], [1, 0], [0, 1], [1, 1]], [[0, 1, 2], [1, 3, 2]]
    pane.mesh = vertices, triangles
    edges = np.frombuffer(pane.layer.mesh["edges"], np.uint32).reshape(-1, 2)
    assert {tuple(edge) for edge in edges} == {(0, 1), (0, 2), (1, 2), (1, 3), (2, 3)}
    assert np.frombuffer(pane.layer.mesh["vertices"]).tolist() == [0, 0, 1, 0, 0, 1, 1, 1]
    assert pane.layer.mesh_opacity == 0.3
    pane.mesh = None
    assert pane.layer.mesh == {}
    pane.carry([(vertices, np.add(vertices, 0.5), triangles)])
    (piece,) = pane.layer.chain
    assert np.frombuffer(piece["target"]).tolist() == [0.5, 0.5, 1.5, 0.5, 0.5, 1.5, 1.5, 1.5]
    assert np.frombuffer(piece["triangles"], np.uint32).tolist() == [0, 1, 2, 1, 3, 2]
    pane.carry([])
    assert pane.layer.chain == []


def test_colours_end_where_they_are_told_to(sent):
    amplitude = [[0.0, 1.0, 2.0, -4.0]] * 2
    pane = shown(sw.Section(amplitude, dx=1, dz=1), limit=4.0)
    assert sent[-1].image()[0, :, 0].tolist() == pytest.approx([128, 160, 191, 0], abs=1)
    pane.gain = 2.0
    assert sent[-1].image()[0, :, 0].tolist() == pytest.approx([128, 191, 255, 0], abs=1)
    with pytest.raises(sw.SettingError, match="limit must be"):
        pane.limit = -1.0


def test_pans_are_not_told_as_gestures(section, sent):
    pane, seen = shown(section), []
    pane.on_gesture(lambda gesture: seen.append(gesture) or True)
    tell(pane, "wheel", x=400, y=200, steps=4)
    grasped = pane.view.to_section((400, 200))
    for kind, x in (("press", 400), ("drag", 420), ("release", 440)):
        tell(pane, kind, x=x, y=200, pan=True, button=1)
    assert pane.view.to_section((440, 200)) == pytest.approx(grasped)
    assert not seen
    tell(pane, "press", x=1, y=1)
    tell(pane, "release", x=9, y=9, cancelled=True)
    assert [type(gesture) for gesture in seen] == [Press, Release]
    tell(pane, "pinch", x=1, y=1, factor=1.5, dx=3, dz=3)
    assert len(seen) == 2


def test_listeners_hear_where_the_pointer_is(section, sent):
    pane, seen = shown(section), []
    pane.on_hover(seen.append)
    for kind in ("hover", "drag", "leave"):
        tell(pane, kind, x=400, y=100)
    assert seen[0] == pytest.approx((1495, 247.5))
    assert seen[1:] == [seen[0], None]


def test_other_keys_are_told_and_do_nothing_themselves(section, sent):
    pane, seen = shown(section), []
    pane.take_keys(["Enter", "0", "Escape"])
    pane.take_keys(["Enter", " "])
    assert pane.layer.hotkeys[-3:] == ["Enter", "Escape", " "]
    assert pane.layer.hotkeys.count("0") == 1
    pane.on_gesture(seen.append)
    for name in ("Enter", " ", "Escape"):
        tell(pane, "key", key=name)
    assert pane.view.is_fitted
    assert [gesture.name for gesture in seen] == ["Enter", " ", "Escape"]
    tell(pane, "hover", x=1, y=1)
    assert isinstance(seen[-1], Move)


def test_a_section_with_little_data_is_drawn(sent):
    shown(sw.Section([[0.0, np.nan], [0.0, np.nan]], dx=1, dz=1))
    assert sent[-1].image()[..., 3].tolist() == [[255, 0], [255, 0]]
    assert sent[-1].image()[0, 0].tolist() == [128, 128, 128, 255]
