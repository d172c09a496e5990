import re
import time

import numpy as np
import pytest

from tests.widgets.browser import SCREENSHOTS, chromium, lab, notebook  # noqa: F401

CELL = """
import numpy as np
import seiswidgets as sw
section = sw.synthetic.listric_fault().section
seen = []
pane = sw.SectionPane(section)
pane.layer.on_happening(lambda happening: seen.append(happening.kind))
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
import seiswidgets as sw
section = sw.synthetic.listric_fault().section
pane, other = sw.SectionPane(section, height=300), sw.SectionPane(section, height=300)
link = ipywidgets.jslink((pane.layer, "cursor"), (other.layer, "linked"))
ipywidgets.VBox([pane, other])
"""
SLEEP = """(code) => {
  window.jupyterapp.shell.currentWidget.sessionContext.session.kernel.requestExecute({ code });
}"""
STILL = "[pane.view.window, pane.view.backing]"
PIXELS = """() => {
  const canvas = document.querySelector("canvas.seiswidgets-plot");
  const { width, height } = canvas;
  const data = canvas.getContext("2d").getImageData(0, 0, width, height).data;
  const at = (x, y) => {
    const start = 4 * (Math.floor(y * height) * width + Math.floor(x * width));
    return Array.from(data.slice(start, start + 4));
  };
  let sum = 0;
  for (let i = 0; i < data.length; i++) sum = (sum * 31 + data[i]) >>> 0;
  const box = canvas.getBoundingClientRect();
  return { width, height, css: [box.width, box.height], sum, left: at(0.25, 0.5), right: at(0.75, 0.5) };
}"""


def painted(opened):
    """What is on the canvas, once it holds a picture."""
    plot = opened.page.locator("canvas.seiswidgets-plot").first
    plot.wait_for()
    return settled(opened, lambda pixels: pixels["left"][3] == 255)


def settled(opened, suits=lambda pixels: True):
    """What is on the canvas, once that has not changed for a while."""
    last = None
    for _ in range(100):
        pixels = opened.page.evaluate(PIXELS)
        if suits(pixels) and last and pixels["sum"] == last["sum"]:
            return pixels
        last = pixels
        time.sleep(0.3)
    pytest.fail(f"the canvas did not settle: {last}")


def plot_box(opened):
    return opened.page.locator("canvas.seiswidgets-plot").first.bounding_box()


def place(opened, x, y):
    """The point of the section under a css pixel of the plot area."""
    return opened.ask(f"pane.view.to_section(({x}, {y})).tolist()")


def until(opened, code):
    """Wait until an expression is true in the kernel."""
    for _ in range(50):
        if opened.ask(f"bool({code})"):
            return
        time.sleep(0.1)
    pytest.fail(f"never true: {code}")


def shoot(opened, name):
    SCREENSHOTS.mkdir(exist_ok=True)
    opened.page.screenshot(path=SCREENSHOTS / f"{name}.png")


@pytest.mark.parametrize("ratio", [1, 2])
def test_the_section_is_painted_where_it_belongs_and_sharply(notebook, ratio):  # noqa: F811
    opened = notebook(HALVES, ratio=ratio)
    pixels = painted(opened)
    assert pixels["left"] == [255, 255, 255, 255]
    assert pixels["right"] == [0, 0, 0, 255]
    np.testing.assert_allclose([pixels["width"], pixels["height"]], np.multiply(pixels["css"], ratio), atol=1)
    box = plot_box(opened)
    np.testing.assert_allclose(opened.ask("pane.view.size.tolist()"), [box["width"], box["height"]], atol=1)
    shoot(opened, f"halves-{ratio}x")


@pytest.mark.parametrize("dark", [False, True])
def test_wheel_drag_and_double_click(notebook, dark):  # noqa: F811
    opened = notebook(CELL, dark=dark)
    first = painted(opened)
    shoot(opened, f"pane-{'dark' if dark else 'light'}")
    box = plot_box(opened)
    at = round(box["x"] + 300), round(box["y"] + 120)
    shift = at[0] - box["x"], at[1] - box["y"]
    before = place(opened, *shift)
    per_pixel = opened.ask("pane.view.pixel.tolist()")
    opened.page.mouse.move(*at)
    opened.page.mouse.wheel(0, -400)
    until(opened, "not pane.view.is_fitted")
    settled(opened)
    assert (np.abs(np.subtract(place(opened, *shift), before)) <= per_pixel).all()

    opened.page.mouse.down()
    opened.page.mouse.move(at[0] + 60, at[1] + 30, steps=5)
    opened.page.mouse.up()
    until(opened, "seen[-1] in ('rest', 'release')")
    assert (np.abs(np.subtract(place(opened, shift[0] + 60, shift[1] + 30), before)) <= per_pixel).all()
    zoomed = settled(opened)
    assert zoomed["sum"] != first["sum"]
    shoot(opened, f"pane-zoomed-{'dark' if dark else 'light'}")

    opened.page.mouse.dblclick(*at)
    until(opened, "pane.view.is_fitted")
    assert settled(opened)["sum"] == first["sum"]


def test_a_page_that_is_reloaded_shows_the_same(notebook):  # noqa: F811
    opened = notebook(CELL)
    painted(opened)
    opened.page.mouse.move(plot_box(opened)["x"] + 200, plot_box(opened)["y"] + 200)
    opened.page.mouse.wheel(0, -300)
    until(opened, "not pane.view.is_fitted")
    before, view = settled(opened), opened.ask(STILL)
    opened.command("docmanager:save")
    opened.reload()
    after = painted(opened)
    assert opened.ask(STILL) == view
    assert after["sum"] == before["sum"]


def test_moves_of_the_mouse_are_not_sent_one_by_one(notebook):  # noqa: F811
    opened = notebook(CELL)
    painted(opened)
    box = plot_box(opened)
    opened.page.mouse.move(box["x"] + 20, box["y"] + 20)
    opened.ask("seen.clear()")
    frames = len(opened.sent)
    opened.page.mouse.move(box["x"] + box["width"] - 20, box["y"] + box["height"] - 20, steps=500)
    assert len(opened.sent) - frames <= 30
    assert opened.ask("seen.count('hover')") <= 30
    assert opened.page.locator(".seiswidgets-layer .own line").count() == 4


def test_the_keyboard_zooms_and_tab_leaves(notebook):  # noqa: F811
    opened = notebook(CELL)
    painted(opened)
    plot = opened.page.locator(".seiswidgets-layer .plot")
    plot.focus()
    opened.page.keyboard.press("+")
    until(opened, "not pane.view.is_fitted")
    shoot(opened, "pane-focused")
    opened.page.keyboard.press("0")
    opened.page.keyboard.press("0")  # in JupyterLab, twice 0 restarts the kernel
    until(opened, "pane.view.is_fitted")
    assert opened.page.get_by_role("dialog").count() == 0
    assert re.search("zoom with", plot.get_attribute("aria-label"))
    opened.page.keyboard.press("Tab")
    assert not plot.evaluate("plot => plot === document.activeElement")


def test_linked_cursors_follow_while_the_kernel_is_busy(notebook):  # noqa: F811
    opened = notebook(LINKED)
    painted(opened)
    opened.page.evaluate(SLEEP, "import time; time.sleep(4)")
    box = plot_box(opened)
    opened.page.mouse.move(box["x"] + 100, box["y"] + 50)
    at = opened.page.locator(".seiswidgets-layer .linked line.cross").first
    at.wait_for(state="attached", timeout=2000)
    assert float(at.get_attribute("x1")) == pytest.approx(100, abs=1.5)
