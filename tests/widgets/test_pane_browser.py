import re

import numpy as np
import pytest
from playwright.sync_api import expect

from tests.widgets.browser import keep_picture, settled

CELL = """
import numpy as np
import seiswidgets as sw
section = sw.synthetic.listric_fault().section
seen = []
pane = sw.SectionPane(section)
pane.layer.on_pointer_message(lambda message: seen.append(message.kind))
pane
"""
HALVES = """
import numpy as np
import seiswidgets as sw
amplitude = np.ones((40, 60)); amplitude[:, 30:] = -1
pane = sw.SectionPane(sw.Section(amplitude, dx=10, dz=10), clip=100)
pane
"""
LINKED = """
import ipywidgets
import numpy as np
import seiswidgets as sw
section = sw.synthetic.listric_fault().section
pane, other = sw.SectionPane(section, height=300), sw.SectionPane(section, height=300)
x_min, x_max, z_min, z_max = pane.view.whole
corners = np.array([[x_min, z_min], [x_max, z_min], [x_max, z_max], [x_min, z_max]])
triangles = [[0, 1, 2], [0, 2, 3]]
pane.carry([(corners, corners + [400, 200], triangles)])
other.carry([(corners + [400, 200], corners, triangles)])
pane.rubber = [(600, 200), (900, 300)]
other.rubber = [(1000, 400)]
ipywidgets.jslink((pane.layer, "carried"), (other.layer, "linked"))
ipywidgets.jslink((other.layer, "carried"), (pane.layer, "linked"))
heard = []
for layer in (pane.layer, other.layer):
    layer.observe(lambda change: heard.append(change.name), ["carried", "linked"])
ipywidgets.VBox([pane, other])
"""
PICKED = (
    CELL
    + """
from seiswidgets.interaction.overlay import Mark, Overlay, Stroke
x_min, x_max, z_min, z_max = pane.view.whole
w, h = x_max - x_min, z_max - z_min
at = lambda *points: np.array(points) * [w, h] + [x_min, z_min]
pane.draw_lines([
    Stroke(at((0.1, 0.1), (0.3, 0.5), (0.5, 0.8)), label="F1", dots=True, width=2.5, chosen=1),
    Stroke(at((0.02, 0.4), (0.25, 0.42)), colour="#1565c0", label="<img src=x onerror=alert(1)>", dots=True),
    Stroke(at((0.35, 0.55), (0.9, 0.5)), colour="#1565c0", dots=True, dash=(6, 4)),
])
pane.draw_marks([Mark(at((0.26, 0.42))[0], "cutoff", "1", "#1565c0"), Mark(at((0.7, 0.2))[0], "held", "", "#2e7d32"),
    Mark(at((0.8, 0.8))[0], "cursor")])
x, z = np.meshgrid(np.linspace(0.5, 1, 21), np.linspace(0, 1, 21))
n = np.arange(441).reshape(21, 21)
a, b, c, d = n[:-1, :-1].ravel(), n[:-1, 1:].ravel(), n[1:, 1:].ravel(), n[1:, :-1].ravel()
pane.mesh = at(*zip(x.ravel(), z.ravel())), np.vstack([np.stack([a, b, c], 1), np.stack([a, c, d], 1)])
palette = np.zeros((256, 4), np.uint8); palette[:, 0], palette[:, 3] = 255, np.arange(256)
levels = np.tile(np.linspace(0, 255, 64).astype(np.uint8), (32, 1))
pane.overlay = Overlay(levels, palette, (x_min + 0.6 * w, x_max, z_min, z_min + 0.5 * h))
pane
"""
)
WATCH = """() => {
  const canvas = document.querySelector("canvas.seiswidgets-plot");
  window.watched = [];
  const look = () => {
    if (!window.watched) return;
    const pixel = canvas.getContext("2d").getImageData(canvas.width / 2, canvas.height / 2, 1, 1).data;
    window.watched.push(Array.from(pixel));
    requestAnimationFrame(look);
  };
  look();
}"""
WATCHED = "() => { const seen = window.watched; window.watched = null; return seen; }"
MOVE = """
import time
pane.limit = 1.0
for step in range(12):
    size = 300 + step // 4  # so that canvases are resized now and then
    moved = sw.Section(np.full((size, size), np.cos(step)), dx=10, dz=10)
    pane.section = moved
    time.sleep(0.05)
"""
STILL = "[pane.view.window, pane.view.backing]"
PIXELS = """(number) => {
  const canvas = document.querySelectorAll("canvas.seiswidgets-plot")[number];
  const { width, height } = canvas;
  const data = canvas.getContext("2d").getImageData(0, 0, width, height).data;
  const at = (x, y) => {
    const start = 4 * (Math.floor(y * height) * width + Math.floor(x * width));
    return Array.from(data.slice(start, start + 4));
  };
  let sum = 0;
  for (let i = 0; i < data.length; i++) sum = (sum * 31 + data[i]) >>> 0;
  const box = canvas.getBoundingClientRect();
  const [left, right, top] = [at(0.25, 0.5), at(0.75, 0.5), at(0.9, 0.1)];
  return { width, height, css: [box.width, box.height], sum, left, right, top };
}"""


def painted(opened, number=0):
    """Pixels of the canvas, once it holds a picture."""
    opened.page.locator("canvas.seiswidgets-plot").nth(number).wait_for()
    return still(opened, lambda pixels: pixels["left"][3] == 255, number)


def still(opened, suits=lambda pixels: True, number=0):
    """Pixels of the canvas, once they have not changed for a while."""
    return settled(lambda: opened.page.evaluate(PIXELS, number), suits)


def plot_box(opened, number=0):
    return opened.page.locator("canvas.seiswidgets-plot").nth(number).bounding_box()


def place(opened, x, y):
    """The point of the section under a css pixel of the plot area."""
    return opened.ask(f"pane.view.to_section(({x}, {y})).tolist()")


def shoot(opened, name):
    keep_picture(opened.page, name)


@pytest.mark.parametrize("ratio", [1, 2])
def test_the_section_is_painted_where_it_belongs_and_sharply(notebook, ratio):
    opened = notebook(HALVES, ratio=ratio)
    pixels = painted(opened)
    assert pixels["left"] == [255, 255, 255, 255]
    assert pixels["right"] == [0, 0, 0, 255]
    np.testing.assert_allclose([pixels["width"], pixels["height"]], np.multiply(pixels["css"], ratio), atol=1)
    box = plot_box(opened)
    np.testing.assert_allclose(opened.ask("pane.view.size.tolist()"), [box["width"], box["height"]], atol=1)
    shoot(opened, f"halves-{ratio}x")


def shoot_in_both_themes(opened, name):
    for dark in (True, False):
        opened.darken(dark)
        shoot(opened, f"{name}-{'dark' if dark else 'light'}")


def test_wheel_drag_and_double_click(notebook):
    opened = notebook(CELL)
    first = painted(opened)
    shoot_in_both_themes(opened, "pane")
    box = plot_box(opened)
    at = round(box["x"] + 300), round(box["y"] + 120)
    shift = at[0] - box["x"], at[1] - box["y"]
    before = place(opened, *shift)
    per_pixel = opened.ask("pane.view.pixel.tolist()")
    opened.page.mouse.move(*at)
    opened.page.mouse.wheel(0, -400)
    opened.until("not pane.view.is_fitted")
    still(opened)
    assert (np.abs(np.subtract(place(opened, *shift), before)) <= per_pixel).all()

    opened.page.mouse.down()
    opened.page.mouse.move(at[0] + 60, at[1] + 30, steps=5)
    opened.page.mouse.up()
    opened.until("seen[-1] in ('rest', 'release')")
    assert (np.abs(np.subtract(place(opened, shift[0] + 60, shift[1] + 30), before)) <= per_pixel).all()
    zoomed = still(opened)
    assert zoomed["sum"] != first["sum"]
    shoot_in_both_themes(opened, "pane-zoomed")

    opened.page.mouse.dblclick(*at)
    opened.until("pane.view.is_fitted")
    assert still(opened)["sum"] == first["sum"]


def drawn(opened, number=0):
    """Pixels of the layer without the cursors, once they have not changed for a while."""
    plot = opened.page.locator(".seiswidgets-layer .plot").nth(number)
    parts = [plot.locator(f".{name}").first for name in ("mesh", "strokes", "marks")]
    return settled(lambda: [part.evaluate("one => one.outerHTML") for part in parts])


def test_a_page_that_is_reloaded_shows_the_same(notebook):
    opened = notebook(PICKED)
    plain = painted(opened)
    shoot_in_both_themes(opened, "picked")
    expect(opened.page.locator(".name")).to_have_text(["F1", "<img src=x onerror=alert(1)>"])
    opened.page.mouse.move(plot_box(opened)["x"] + 500, plot_box(opened)["y"] + 200)
    opened.page.mouse.wheel(0, -300)
    opened.until("not pane.view.is_fitted and seen[-1] == 'rest'")
    before, view = still(opened), opened.ask(STILL)
    assert before["sum"] != plain["sum"]
    shoot(opened, "picked-zoomed")
    lines = drawn(opened)
    opened.command("docmanager:save")
    opened.reload()
    painted(opened)
    opened.becomes(STILL, view)  # a page that is loaded has another width at first
    still(opened, lambda pixels: pixels["sum"] == before["sum"])
    assert drawn(opened) == lines


def test_a_second_view_shows_the_same_and_an_overlay_its_colours(notebook):
    opened = notebook(PICKED, "pane", height=1400)
    first, second = painted(opened), painted(opened, 1)
    assert first == second
    assert drawn(opened) == drawn(opened, 1)
    box = plot_box(opened, 1)
    opened.page.mouse.move(box["x"] + 500, box["y"] + 200)
    opened.page.mouse.wheel(0, -300)
    shoot(opened, "second-view")
    opened.until("'rest' in seen")
    first, second = still(opened), still(opened, number=1)
    assert first == second
    assert drawn(opened) == drawn(opened, 1)
    opened.ask("pane.fit()")
    covered = still(opened)["top"]
    opened.ask("setattr(pane, 'overlay', None)")
    bare = still(opened, lambda pixels: pixels["top"] != covered)["top"]
    share = 0.6 * 0.75  # the overlay's opacity, and that of its level three quarters from its left
    expected = np.multiply(bare[:3], 1 - share) + np.multiply([255, 0, 0], share)
    np.testing.assert_allclose(covered[:3], expected, atol=4)


def test_a_section_that_moves_never_leaves_the_pane_blank(notebook):
    opened = notebook(CELL)
    painted(opened)
    opened.page.evaluate(WATCH)
    opened.ask(f"exec({MOVE!r})")
    painted(opened)
    seen = opened.page.evaluate(WATCHED)
    assert len({tuple(pixel) for pixel in seen}) > 3
    assert {pixel[3] for pixel in seen} == {255}


def sent_by_a_sweep(opened):
    """Number of messages for 500 moves of the mouse."""
    box = plot_box(opened)
    opened.page.mouse.move(box["x"] + 20, box["y"] + 20)
    frames = len(opened.sent)
    opened.page.mouse.move(box["x"] + box["width"] - 20, box["y"] + box["height"] - 20, steps=500)
    return len(opened.sent) - frames


def test_moves_of_the_mouse_are_not_sent_one_by_one(notebook):
    opened = notebook(LINKED)
    painted(opened)
    assert any(sent_by_a_sweep(opened) <= 30 for _ in range(3))  # the mouse seems to rest whenever the machine does
    for cross in ("own", "linked"):
        expect(opened.page.locator(f".seiswidgets-layer .{cross} line")).to_have_count(4)
    assert opened.ask("heard") == []


def test_the_keyboard_zooms_and_tab_leaves(notebook):
    opened = notebook(CELL)
    painted(opened)
    plot = opened.page.locator(".seiswidgets-layer .plot")
    plot.focus()
    opened.page.keyboard.press("+")
    opened.until("not pane.view.is_fitted")
    shoot(opened, "pane-focused")
    opened.page.keyboard.press("0")
    opened.page.keyboard.press("0")  # in JupyterLab, twice 0 restarts the kernel
    opened.until("pane.view.is_fitted")
    assert opened.page.get_by_role("dialog").count() == 0
    assert re.search("zoom with", plot.get_attribute("aria-label"))
    opened.page.keyboard.press("Tab")
    assert not plot.evaluate("plot => plot === document.activeElement")


def test_linked_cursors_follow_while_the_kernel_is_busy(notebook):
    opened = notebook(LINKED)
    painted(opened), painted(opened, 1)
    ask = "pane.view.to_pixels(pane.view.to_section((100, 50)) {} [400, 200]).tolist()"
    at = [opened.ask(ask.format(sign)) for sign in "+-"]
    with opened.kernel_at_work():
        for number, (x, y) in zip((0, 1), at, strict=True):
            box, other = plot_box(opened, number), opened.page.locator(".seiswidgets-layer").nth(1 - number)
            opened.page.mouse.move(box["x"] + 100, box["y"] + 50)
            cross = other.locator(".linked line.cross").first
            cross.wait_for(state="attached")
            assert float(cross.get_attribute("x1")) == pytest.approx(x, abs=1)
            end = re.findall(r"[-.\d]+", other.locator(".rubber").get_attribute("d"))[-2:]
            assert [float(value) for value in end] == pytest.approx([x, y], abs=1)
