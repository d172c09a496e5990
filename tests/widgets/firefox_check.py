"""A short walk through the app in Firefox: open, draw, restore, zoom, reload. Run by `make test-firefox`."""

import ast
import json
import os
import shutil

import numpy as np
import pytest

import seiswidgets as sw
from tests.io.restored import restored
from tests.widgets.appscreen import EMPTY, PIXELS, SHOWN
from tests.widgets.browser import ASK, EXECUTE, READY, awaited, settled
from tests.widgets.firefox import Firefox

SIZE = 1200, 1000
BOX = """(index) => {
  const plot = document.querySelectorAll(".seiswidgets-layer .plot")[index];
  plot.scrollIntoView({ block: "nearest" });
  const { x, y } = plot.getBoundingClientRect();
  return [x, y];
}"""
BUTTON = """(name) => {
  const named = [...document.querySelectorAll("button")].find((one) => one.textContent.trim() === name);
  const { x, y, width, height } = named.getBoundingClientRect();
  return [x + width / 2, y + height / 2];
}"""
PICTURES = f"() => ({PIXELS})([...document.querySelectorAll('canvas.seiswidgets-plot')])"


@pytest.fixture
def firefox(tmp_path):
    """A running Firefox; skips where there is none, but never in CI."""
    path = shutil.which("firefox-esr") or shutil.which("firefox")
    if path is None:
        missing = "there is no Firefox here; on Debian: apt-get install firefox-esr"
        pytest.fail(missing) if os.environ.get("CI") else pytest.skip(missing)
    folder = tmp_path / "profile"
    folder.mkdir()
    browser = Firefox(path, folder, SIZE)
    try:
        yield browser
    finally:
        browser.end()


class Walk:
    """The app in a notebook, and a hand with a mouse."""

    def __init__(self, lab, firefox):
        self.firefox, self.address = firefox, lab.address(lab.write(["".join([EMPTY, SHOWN])]))
        self.load()
        self.command("notebook:run-all-cells")
        self.command("notebook:hide-all-cell-code")

    def load(self):
        """Load the page, or load it anew."""
        self.firefox.goto(self.address)
        awaited(lambda: self.firefox.evaluate("() => Boolean(window.jupyterapp)"), bool, "JupyterLab")
        self.firefox.evaluate("() => window.jupyterapp.restored.then(() => true)")
        self.command("application:toggle-left-area")
        awaited(lambda: self.firefox.evaluate(READY), bool, "a kernel at rest")

    def command(self, name):
        self.firefox.evaluate(EXECUTE, [name, {}])
        awaited(lambda: self.firefox.evaluate("() => window.done"), bool, name)

    def ask(self, code):
        """Value of an expression in the kernel."""
        told = self.firefox.evaluate(ASK, f"__import__('json').dumps({code})")
        assert told["status"] == "ok", told
        return json.loads(ast.literal_eval(told["data"]["text/plain"]))

    def becomes(self, code, value):
        awaited(lambda: self.ask(code), lambda found: found == value, f"{code} == {value}")

    def pictures(self):
        """Size, opacity and sum of the pixels of both panes, once they have not changed for a while."""
        return settled(
            lambda: self.firefox.evaluate(PICTURES),
            lambda pictures: len(pictures) == 2 and all(one[2] == 255 for one in pictures),
        )

    def press(self, name):
        self.firefox.click(*self.firefox.evaluate(BUTTON, name))

    def draw(self, points):
        """Click on points of the section, given as an expression, twice on the last."""
        corner = self.firefox.evaluate(BOX, 0)
        at = np.add(self.ask(f"panes[0].view.to_pixels({points}).tolist()"), corner).clip(1, None).tolist()
        for point in at[:-1]:
            self.firefox.click(*point)
        self.firefox.click(*at[-1], times=2)


def test_a_walk(lab, firefox):
    walk = Walk(lab, firefox)
    original, restored = walk.pictures()
    assert original[3] == restored[3]
    walk.press("Fault")
    walk.draw("drawn.faults[0].points[2:-1:5]")
    walk.becomes("len(app.interpretation.faults)", 1)
    walk.press("Horizon")
    for side in (0, 1):
        walk.draw(f"drawn.horizons[0].pieces[{side}][np.r_[0:70:8, -1]]")
        walk.becomes("[len(horizon.pieces) for horizon in app.interpretation.horizons]", [side + 1])
    walk.becomes("[stage.kind for stage in app.restoration.stages]", ["unfault", "flatten"])
    walk.becomes("app.wait(30)", True)
    after = walk.pictures()
    assert after[1][3] != restored[3]

    x, y = firefox.evaluate(BOX, 0)
    width = "float(np.diff(panes[0].view.window)[0])"
    whole = walk.ask(width)
    firefox.wheel(x + 100, y + 100, -120)
    awaited(lambda: walk.ask(width), lambda found: found < whole, "a closer look")
    zoomed = walk.pictures()
    assert zoomed[0][3] != after[0][3]

    walk.command("docmanager:save")
    walk.load()
    assert walk.pictures() == zoomed
    assert walk.ask("[len(app.interpretation.faults), len(app.restoration.stages)]") == [1, 2]
    assert firefox.errors == []


TIME = """(value) => {
  const slider = document.querySelector("input[type=range]");
  slider.value = value;
  slider.dispatchEvent(new Event("input"));
}"""


def test_a_handout_works_from_disk(firefox, tmp_path):
    path = tmp_path / "handout.html"
    sw.save_html(restored(), path)
    firefox.goto(path.as_uri())
    labels = "() => [...document.querySelectorAll('#restored .axes .label')].map((label) => label.textContent)"
    whole = awaited(lambda: firefox.evaluate(labels), lambda found: len(found) > 3, "axes")
    shown = settled(lambda: firefox.evaluate(PICTURES))
    assert len(shown) == 2
    assert shown[0] != shown[1]
    x, y = firefox.evaluate(BOX, 0)
    firefox.wheel(x + 100, y + 100, -300)
    zoomed = awaited(lambda: firefox.evaluate(labels), lambda found: found != whole, "other labels")
    assert zoomed
    firefox.evaluate(TIME, 0)
    awaited(lambda: firefox.evaluate(PICTURES), lambda found: found[0] == found[1], "the present day in both panes")
    assert firefox.errors == []
