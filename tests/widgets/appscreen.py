"""A restoration app in a notebook, and a hand that works it by mouse and keyboard."""

import numpy as np

from tests.widgets.browser import keep_picture, settled

EMPTY = """
import numpy as np
import seiswidgets as sw
case = sw.synthetic.faulted_fold()
drawn = case.interpretation
app = sw.RestorationApp(case.section, height=340)
editor, panes = app.picker.editor, (app.panes.original, app.panes.restored)
"""
FEW = """
fault = sw.Fault(drawn.faults[0].points[[0, 10, 20, 30]], "F1")
pieces = [piece[np.linspace(0, len(piece) - 1, 5).astype(int)] for piece in drawn.horizons[0].pieces]
app.live = False
app.interpretation = sw.Interpretation([fault], [sw.Horizon(*pieces, name="H1")])
"""
RESTORED = "app.interpretation, app.fixed = drawn, case.fixed\n"
SHOWN = "app\n"

PICKS = "[[pick.name, [[[*at] for at in piece] for piece in pick.pieces]] for pick in editor.drawing.picks]"
DRAFT = "editor.drawing.draft.points if editor.drawing.draft else []"
PIXELS = """(canvases) => canvases.map((canvas) => {
  const { width, height } = canvas;
  const data = canvas.getContext("2d").getImageData(0, 0, width, height).data;
  let sum = 0;
  for (let i = 0; i < data.length; i++) sum = (sum * 31 + data[i]) >>> 0;
  return [width, height, data[4 * (Math.floor(height / 2) * width + Math.floor(width / 2)) + 3], sum];
})"""


class AppScreen:
    """Operate the app by hand, and read what it shows.

    Parameters
    ----------
    opened : Notebook
        That shows an app by the name of ``app``, made by one of the cells above.
    """

    def __init__(self, opened):
        self.opened, self.page = opened, opened.page
        self.ask, self.until, self.becomes = opened.ask, opened.until, opened.becomes
        self.plots = self.page.locator(".seiswidgets-layer .plot")
        self.pictures()

    def button(self, name):
        """A button of the toolbar or the status bar, by its text or its accessible name."""
        return self.page.locator(f"button:has-text('{name}'), button[title*='{name}']").first

    def tab(self, name):
        """Open one of the tabs, and wait for its page, which is made when it is first looked at."""
        self.page.get_by_role("tab", name=name, exact=True).click()
        shown = self.page.get_by_role("tabpanel").locator("button, input, select, table, .widget-html-content")
        shown.locator("visible=true").first.wait_for()

    def pictures(self, suits=lambda pictures: True):
        """Size, opacity and sum of the pixels of all panes' canvases, once they have not changed for a while."""
        self.plots.nth(1).wait_for()
        return settled(
            lambda: self.page.eval_on_selector_all("canvas.seiswidgets-plot", PIXELS),
            lambda pictures: all(one[2] == 255 for one in pictures) and suits(pictures),
        )

    def lines(self, number=0):
        """Pixels of a pane's layer without the cursors, once they have not changed for a while."""
        parts = [self.plots.nth(number).locator(f".{name}").first for name in ("mesh", "strokes", "marks")]
        return settled(lambda: [part.evaluate("one => one.outerHTML") for part in parts])

    def paths(self, number=0):
        """The SVG paths of all lines in a pane, also of their thin parts near cut-offs."""
        return (
            self.plots.nth(number)
            .locator(".stroke :is(.line, .thin)")
            .evaluate_all("all => all.map((one) => one.getAttribute('d'))")
        )

    def pixels(self, points, number=0):
        """Positions of points of a pane's section on the page, in CSS pixels, shape (n, 2)."""
        box = self.plots.nth(number).bounding_box()
        at = self.ask(f"panes[{number % 2}].view.to_pixels({np.asarray(points).tolist()}).tolist()")
        return np.add(at, [box["x"], box["y"]]).clip(  # a click on the very border may miss
            [box["x"] + 1, box["y"] + 1], [box["x"] + box["width"] - 1, box["y"] + box["height"] - 1]
        )

    def points(self, code):
        """Points of the section that an expression gives in the kernel, shape (n, 2)."""
        return np.array(self.ask(f"np.asarray({code}).tolist()"))

    def click(self, *points, number=0, modifiers=()):
        """Click on points of a pane's section, and give back where that was on the page."""
        at = self.pixels(points, number)
        for key in modifiers:
            self.page.keyboard.down(key)
        for x, y in at:
            self.page.mouse.click(x, y)
        for key in modifiers:
            self.page.keyboard.up(key)
        return at

    def draw(self, *points, number=0):
        """Click on points, twice on the last."""
        at = self.pixels(points, number)
        for x, y in at[:-1]:
            self.page.mouse.click(x, y)
        self.page.mouse.dblclick(*at[-1])
        return at

    def drag(self, start, end, number=0, drop=True):
        """Drag from one point of the section to another."""
        (x, y), to = self.pixels([start, end], number)
        self.page.mouse.move(x, y)
        self.page.mouse.down()
        self.page.mouse.move(*to, steps=6)
        if drop:
            self.page.mouse.up()

    def press(self, *keys):
        """Keys, one after the other."""
        for key in keys:
            self.page.keyboard.press(key)

    def nears(self, code, value, atol=1e-9):
        """Wait until an expression of numbers is about a value in the kernel."""
        self.until(
            f"np.shape({code}) == {np.shape(value)} and np.allclose({code}, {np.asarray(value).tolist()}, 0, {atol})"
        )

    def shoot(self, name):
        """A screenshot, to be looked at."""
        keep_picture(self.page, name)
