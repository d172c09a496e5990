"""The pointer layer alone in Chromium: what it draws where, and what it tells of mouse, keys and fingers."""

import re

import numpy as np
import pytest

from seiswidgets.core.mapping import PiecewiseAffineMap
from seiswidgets.core.mesh import Mesh
from seiswidgets.core.point_location import TOLERANCE
from seiswidgets.interaction.overlay import Mark, Stroke, map_state, mesh_state
from tests.widgets.bare import CORNER

IMG = "<img src=x onerror=alert(1)>"
ROWS, COLUMNS = 9, 13
MIDDLE = COLUMNS // 2


def pixels(d):
    """All places in the d of a path, as rows."""
    return np.array(re.findall(r"[ML](-?[\d.]+),(-?[\d.]+)", d), float)


def states(*values):
    return [value.state() for value in values]


def cut_mesh():
    """A mesh of the window 0 to 300 by 0 to 100, with some noise, cut from above to below."""
    x, z = np.meshgrid(np.linspace(0, 300, COLUMNS), np.linspace(0, 100, ROWS))
    inside = np.s_[1:-1, 1:-1]
    rng = np.random.default_rng(3)
    x[inside] += rng.uniform(-5, 5, x[inside].shape) * (np.arange(1, COLUMNS - 1) != MIDDLE)
    z[inside] += rng.uniform(-3, 3, x[inside].shape)
    number = np.arange(ROWS * COLUMNS).reshape(ROWS, COLUMNS)
    corners = [number[:-1, :-1], number[:-1, 1:], number[1:, 1:], number[1:, :-1]]
    a, b, c, d = (corner.ravel() for corner in corners)
    mesh = Mesh(np.column_stack([x.ravel(), z.ravel()]), np.vstack([np.stack([a, b, c], 1), np.stack([a, c, d], 1)]))
    cut = mesh.cut(np.column_stack([number[:-1, MIDDLE], number[1:, MIDDLE]]))
    return cut.mesh


def unfaulted(mesh):
    """Maps that move the right of the cut down by 20 and stretch that; and then all of it."""
    centres = mesh.vertices[mesh.triangles].mean(axis=1)
    right = np.unique(mesh.triangles[centres[:, 0] > 150])
    first = mesh.vertices.copy()
    first[right] = first[right] * [1, 1.1] + [7, 20]
    second = first * [0.5, 2] + np.sin(first / 50)
    steps = (mesh.vertices, first), (first, second)
    return [PiecewiseAffineMap(source, target, mesh.triangles) for source, target in steps]


def chained(maps):
    return [map_state(one.source, one.target, one.triangles) for one in maps]


def test_lines_labels_and_marks_lie_where_they_belong(bare_layer):
    points = [[30, 20], [60, 40], [np.nan, 0], [90, 30], [1200, 30]]
    line = Stroke(points, colour="#00ff00", width=3, dots=True, dash=(5, 2), label=IMG, chosen=1)
    corner = Stroke([[299, 1], [250, 50]], label="at the corner")
    passing = Stroke([[-50, 50], [500, 50]], label="through")
    gone = Stroke([[-50, -50], [-60, 50]], label="unseen")
    marks = Mark((150, 50), "cutoff", "12"), Mark((30, 75), "held"), Mark((270, 75), "cursor")
    layer = bare_layer(strokes=states(line, corner, passing, gone), marks=states(*marks))
    (d, width, colour, dash), *_ = layer.attributes(".line", "d", "stroke-width", "stroke", "stroke-dasharray")
    expected = [[60, 80], [120, 160], [180, 120], [2400, 120]]
    np.testing.assert_allclose(pixels(d), expected, atol=0.01)
    assert re.findall("[ML]", d) == ["M", "L", "M", "L"]
    assert (width, colour, dash) == ("3", "#00ff00", "5 2")
    np.testing.assert_allclose(pixels(layer.attributes(".dots", "d")[0][0]), expected, atol=0.01)
    assert layer.attributes(".stroke .halo", "stroke-width")[0] == ["6"]
    assert pixels(layer.attributes(".thin", "d")[0][0]).tolist() == [[286, 200], [314, 200]]  # 14 css pixels about "12"
    assert layer.attributes(".chosen", "cx", "cy") == [["120", "160"]]
    names = layer.page.locator(".seiswidgets-layer .name")
    assert names.all_text_contents() == [IMG, "at the corner", "through"]
    assert layer.page.locator("img").count() == 0
    plot = layer.page.locator(".seiswidgets-layer .plot").bounding_box()
    for box in (name.bounding_box() for name in names.all()):
        assert plot["x"] <= box["x"]
        assert box["x"] + box["width"] <= plot["x"] + plot["width"]
        assert plot["y"] <= box["y"]
    places = layer.attributes(".mark", "class", "transform")
    assert places[0] == ["mark cutoff", "translate(300 200)"]
    assert places[1:] == [["mark held", "translate(60 300)"], ["mark cursor", "translate(540 300)"]]
    assert layer.attributes(".cutoff .disc", "r") == [["3.5"]]
    layer.move(309, 203)
    assert layer.attributes(".grown .disc", "cx", "cy", "r") == [["300", "200", "8"]]
    assert layer.page.locator(".seiswidgets-layer .number").all_text_contents() == ["12"]
    layer.move(121, 158)
    assert layer.attributes(".grown .disc", "cx", "cy", "r") == [["120", "160", "5.5"]]
    layer.move(90, 30)
    assert layer.attributes(".grown *", "r") == []

    layer.set(window=[0, 150, 0, 50])
    np.testing.assert_allclose(pixels(layer.attributes(".line", "d")[0][0]), np.multiply(expected, 2), atol=0.01)

    colours = ["#f0e442", "#0072b2", "yellow", "none"]
    named = [Stroke([[30, 20], [60, 40]], colour=colour, label=colour) for colour in colours]
    layer.set(strokes=states(*named), marks=states(Mark((75, 25), "cutoff", "7", colour="#f0e442")))
    layer.move(300, 200)
    pale = layer.page.locator(".seiswidgets-layer .pale")
    assert pale.all_text_contents() == ["#f0e442", "yellow", "7"]

    layer.set(strokes=[], marks=[])
    assert layer.attributes(".stroke, .mark, .name, .grown *", "class") == []


def test_v_hides_what_is_drawn_while_it_is_held(bare_layer):
    line, mark = Stroke([[30, 20], [60, 40]], dots=True, label="F1"), Mark((150, 50), "cutoff", "1")
    layer = bare_layer(strokes=states(line), marks=states(mark))
    shown = layer.page.locator(".seiswidgets-layer :is(.line, .dots, .name, .disc):visible")
    layer.page.locator(".plot").focus()
    assert shown.count() == 4
    for leave in (lambda: layer.page.keyboard.up("v"), lambda: layer.page.evaluate("document.activeElement.blur()")):
        layer.page.locator(".plot").focus()
        layer.page.keyboard.down("v")
        layer.page.evaluate("frame()")
        assert shown.count() == 0
        leave()
        layer.page.evaluate("frame()")
        assert shown.count() == 4
    assert layer.sent("key") == []


def test_the_mesh_is_drawn_where_it_is_in_sight(bare_layer):
    mesh = cut_mesh()
    layer = bare_layer(mesh=mesh_state(mesh.vertices, mesh.triangles), mesh_opacity=0.4)
    ((d, scale, opacity),) = layer.attributes(".mesh", "d", "transform", "stroke-opacity")
    assert (scale, opacity) == ("scale(0.1)", "0.4")
    drawn = pixels(d).reshape(-1, 2, 2) / 10
    np.testing.assert_allclose(drawn, mesh.vertices[mesh.edges] * [2, 4], atol=0.051)
    layer.set(window=[100, 130, 40, 50])
    few = pixels(layer.attributes(".mesh", "d")[0][0]).reshape(-1, 2, 2) / 10
    assert 0 < len(few) < len(drawn) / 4
    layer.set(mesh={})
    assert layer.attributes(".mesh", "d") == [[""]]


def test_the_pointer_is_carried_as_the_maps_say(bare_layer):
    maps = unfaulted(cut_mesh())
    layer = bare_layer(chain=chained(maps))
    rng = np.random.default_rng(5)
    places = np.vstack([rng.uniform(0, 1, (40, 2)) * [600, 400], [[299.9, 100], [300.1, 100], [0, 0], [600, 400]]])
    # without a mouse, which comes to whole pixels only
    carried = layer.page.evaluate(CARRY, places.tolist())
    expected = maps[1].forward(maps[0].forward(places / [2, 4]))
    np.testing.assert_allclose([[at["x"], at["z"]] for at in carried], expected, rtol=1e-12)
    assert abs(expected[-4] - expected[-3])[1] > 20  # across the cut

    layer.set(window=[-100, 200, 0, 100])
    layer.move(50, 50)
    assert layer.get("carried") == {}  # outside of the mesh
    layer.set(chain=[])
    layer.move(60, 40)
    assert layer.get("carried") == {"x": -70, "z": 10}
    layer.page.mouse.move(0, 0)
    assert layer.get("carried") == {}


CARRY = """async (places) => {
  const plot = document.querySelector(".seiswidgets-layer .plot");
  const box = plot.getBoundingClientRect();
  const found = [];
  for (const [x, y] of places) {
    const at = { clientX: box.left + x, clientY: box.top + y, pointerType: "mouse", pointerId: 1 };
    plot.dispatchEvent(new PointerEvent("pointermove", at));
    found.push(model.get("carried"));
  }
  return found;
}"""


@pytest.mark.parametrize(("beyond", "is_inside"), [(0.0, True), (0.5 * TOLERANCE, True), (2 * TOLERANCE, False)])
def test_a_point_outside_by_rounding_belongs_to_the_triangle(bare_layer, beyond, is_inside):
    triangle = np.array([[0.0, 0.0], [200.0, 0.0], [0.0, 100.0]])
    layer = bare_layer(chain=[map_state(triangle, triangle + 1000, [[0, 1, 2]])])
    layer.page.evaluate(CARRY, [[200, 200 - 0.001]])
    layer.set(window=[0, 300, 100 * beyond, 100 + 100 * beyond])
    (carried,) = layer.page.evaluate(CARRY, [[200, 200]])  # on the long side, but for the shift of the window
    assert (carried != {}) == is_inside


def test_the_rubber_band_ends_at_the_pointer_or_at_the_linked_place(bare_layer):
    layer = bare_layer(rubber=[[30, 20], [60, 40]])
    assert layer.attributes(".rubber", "d") == []
    layer.set(linked={"x": 90, "z": 50})
    np.testing.assert_allclose(pixels(layer.attributes(".rubber", "d")[0][0]), [[60, 80], [120, 160], [180, 200]])
    assert layer.attributes(".linked .cross", "x1", "y1")[0] == ["180", "0"]
    layer.move(333, 222)
    np.testing.assert_allclose(pixels(layer.attributes(".rubber", "d")[0][0])[-1], [333, 222])
    layer.set(rubber=[])
    assert layer.attributes(".rubber", "d") == []


def test_a_view_of_another_size_draws_and_tells_in_proportion(bare_layer):
    axis = {"title": "Distance (m)", "pixels": [100, 200], "labels": ["1", "2"]}
    axes = {"x": axis, "z": {**axis, "pixels": [150, 300]}, "left": 64, "note": ""}
    layer = bare_layer(size=(300, 800), axes=axes, strokes=states(Stroke([[30, 20], [60, 40]])))
    assert layer.attributes(".tick", "x1")[:2] == [["50"], ["100"]]
    assert layer.attributes(".tick", "y1")[2:] == [["300"], ["600"]]
    np.testing.assert_allclose(pixels(layer.attributes(".line", "d")[0][0]), [[30, 160], [60, 320]])
    layer.move(100, 200)
    layer.page.mouse.down()
    (press,) = layer.sent("press")
    assert (press["x"], press["y"]) == (200, 100)  # in the size that the kernel knows
    assert layer.get("carried") == {"x": 100, "z": 25}


@pytest.mark.parametrize("style", ["transform: scale(0.8)", "zoom: 1.25"])
def test_in_a_page_scaled_afterwards_a_press_is_where_it_is_seen(bare_layer, style):
    layer = bare_layer()
    layer.page.evaluate("(style) => { document.body.style = `${style}; transform-origin: 0 0`; }", style)
    box = layer.page.locator(".seiswidgets-layer .plot").bounding_box()
    assert box["width"] != pytest.approx(600)
    layer.page.mouse.click(box["x"] + 0.25 * box["width"], box["y"] + 0.5 * box["height"])
    (pressed,) = layer.sent("press")
    assert (pressed["x"], pressed["y"]) == pytest.approx((150, 200), abs=1)


def test_space_and_the_middle_button_pan(bare_layer):
    layer = bare_layer(hotkeys=[" ", "Escape"])
    mouse, keyboard = layer.page.mouse, layer.page.keyboard
    cursor = "() => getComputedStyle(document.querySelector('.seiswidgets-layer .plot')).cursor"
    layer.move(100, 100)
    mouse.down()
    keyboard.press("Escape")  # in the midst of a drag
    mouse.up()
    keyboard.down(" ")
    assert layer.page.evaluate(cursor) == "grab"
    mouse.down()
    assert layer.page.evaluate(cursor) == "grabbing"
    layer.move(150, 120)
    mouse.up()
    keyboard.up(" ")
    assert layer.page.evaluate(cursor) == "crosshair"
    keyboard.press(" ")
    mouse.down(button="middle")
    layer.move(160, 130)
    mouse.up(button="middle")
    assert [message["key"] for message in layer.sent("key")] == ["Escape", " "]
    assert [message.get("pan", False) for message in layer.sent("press")] == [False, True, True]
    assert [message.get("pan", False) for message in layer.sent("release")] == [False, True, True]
    assert all(message["pan"] for message in layer.sent("drag"))
    kinds = [message["kind"] for message in layer.sent() if message["kind"] in ("key", "press", "release")]
    assert kinds == ["press", "key", "release", "press", "release", "key", "press", "release"]


def test_space_is_no_key_unless_it_is_asked_for(bare_layer):
    layer = bare_layer(hotkeys=["0"])
    layer.page.locator(".seiswidgets-layer .plot").focus()
    layer.page.keyboard.press(" ")
    layer.page.keyboard.press("0")
    assert [message["key"] for message in layer.sent("key")] == ["0"]


def test_one_finger_presses_drags_and_taps_twice(bare_layer):
    layer = bare_layer(touch=True)
    layer.touch("start", (100, 100))
    layer.touch("move", (140, 130))
    layer.touch("move", (180, 160))
    layer.touch("end")
    (press,), (release,) = layer.sent("press"), layer.sent("release")
    assert press["touch"]
    assert (press["x"], press["y"], release["x"], release["y"]) == (100, 100, 180, 160)
    assert not release["cancelled"]
    assert layer.sent("drag")
    assert layer.get("carried") == {}
    assert layer.sent("leave")
    for _ in range(2):
        layer.touch("start", (300, 200))
        layer.touch("end")
    (double,) = layer.sent("double")
    assert (double["x"], double["y"], double["touch"]) == (300, 200, True)
    kinds = [message["kind"] for message in layer.sent() if message["kind"] in ("press", "release", "double")]
    assert kinds == ["press", "release"] * 3 + ["double"]


def test_two_fingers_pinch(bare_layer):
    layer = bare_layer(touch=True)
    layer.touch("start", (100, 100))
    layer.touch("start", (100, 100), (200, 100))
    for step in range(1, 5):
        layer.touch("move", (100, 100), (200 + 50 * step, 100))
        layer.page.evaluate("model.answer('pinch')")
    pinched = "sent.filter((one) => one.kind === 'pinch').reduce((factor, one) => factor * one.factor, 1)"
    layer.page.wait_for_function(f"{pinched} > 2.9")
    layer.touch("end", (100, 100))
    layer.touch("move", (50, 50))  # the finger that is left does nothing
    layer.touch("end")
    (press,), (release,), pinches = layer.sent("press"), layer.sent("release"), layer.sent("pinch")
    assert release["cancelled"]
    assert (release["x"], release["y"]) == (press["x"], press["y"])
    assert np.prod([pinch["factor"] for pinch in pinches]) == pytest.approx(3)
    assert sum(pinch["dx"] for pinch in pinches) == pytest.approx(100)
    assert sum(pinch["dz"] for pinch in pinches) == 0
    assert (pinches[-1]["x"], pinches[-1]["y"]) == (250, 100)
    assert layer.sent("drag", "double", "hover") == []


def test_a_double_click_is_told_once(bare_layer):
    layer = bare_layer()
    layer.move(100, 100)
    layer.page.mouse.dblclick(200, 150)
    kinds = [message["kind"] for message in layer.sent() if message["kind"] in ("press", "release", "double")]
    assert kinds == ["press", "release", "press", "release", "double"]


def test_a_findings_flag_is_clicked_by_mouse_and_keyboard_and_is_no_press(bare_layer):
    flag = Mark((150, 50), "finding", "H1 is <b>apart</b>", "#d32f2f", "M4 4L12 12")
    layer = bare_layer(marks=[flag.state()])
    button = layer.page.get_by_role("button", name="H1 is <b>apart</b>")
    button.click()
    button.press("Enter")
    assert [message["key"] for message in layer.sent("finding")] == ["0", "0"]
    assert layer.sent("press", "key") == []


def test_the_menu_opens_by_mouse_and_key_and_is_worked_by_keyboard(bare_layer):
    layer = bare_layer()
    layer.page.mouse.click(CORNER[0] + 50, CORNER[1] + 60, button="right")
    (asked,) = layer.sent("menu")
    assert (asked["x"], asked["y"]) == (50, 60)
    layer.page.evaluate("(menu) => model.receive(menu)", {"kind": "menu", "labels": ["One", "Two"], "x": 50, "y": 60})
    items = layer.page.get_by_role("menuitem")
    assert items.all_inner_texts() == ["One", "Two"]
    layer.page.keyboard.press("ArrowDown")
    layer.page.keyboard.press("Enter")
    assert [message["key"] for message in layer.sent("choose")] == ["1"]
    assert items.count() == 0
    layer.page.keyboard.press("Shift+F10")
    assert len(layer.sent("menu")) == 2


def test_a_long_menu_reaches_beyond_its_pane_but_not_beyond_the_window(bare_layer):
    layer = bare_layer()
    labels = [f"Item {number}" for number in range(20)]
    layer.page.locator(".seiswidgets-layer").evaluate("one => { one.parentElement.style.overflow = 'hidden'; }")
    for x, y in ((5, 5), (500, 390)):
        layer.page.evaluate("(menu) => model.receive(menu)", {"kind": "menu", "labels": labels, "x": x, "y": y})
        box, window = layer.page.get_by_role("menu").bounding_box(), layer.page.viewport_size
        assert box["height"] > 400
        assert (box["x"], box["y"]) == (CORNER[0] + x, min(CORNER[1] + y, window["height"] - box["height"]))
