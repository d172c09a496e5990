"""A person's mouse on the app, in whatever page it is shown."""

import numpy as np

import seiswidgets as sw

CASE = sw.synthetic.faulted_fold()
PAINTED = """() => {
  const canvases = [...document.querySelectorAll("canvas.seiswidgets-plot")];
  return canvases.length === 2 && canvases.every((canvas) => {
    const { width, height } = canvas;
    return width > 1 && canvas.getContext("2d").getImageData(width / 2, height / 2, 1, 1).data[3] === 255;
  });
}"""
ALIKE = """(alike) => {
  const [one, other] = [...document.querySelectorAll("canvas.seiswidgets-plot")].map((canvas) => {
    const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
    return data.reduce((sum, value) => (sum * 31 + value) >>> 0, 0);
  });
  return (one === other) === alike;
}"""

TICKS = """() => {
  const ticks = [...document.querySelector(".seiswidgets-layer").querySelectorAll(".tick")].map((tick) => {
    const { left, top, height } = tick.getBoundingClientRect();
    return { at: Number(tick.nextElementSibling.textContent), isX: height > 0, pixel: height > 0 ? left : top };
  });
  return [ticks.filter((tick) => tick.isX), ticks.filter((tick) => !tick.isX)];
}"""


def is_painted(page):
    """Wait until both sections of the app are on the screen."""
    page.locator("canvas.seiswidgets-plot").first.scroll_into_view_if_needed()  # or JupyterLab may not paint them
    page.wait_for_function(PAINTED)


def draw_faulted_fold(page):
    """Draw what an interpreter would: the fault, both pieces of the first horizon, and the block to hold."""
    _choose(page, "Fault")
    fault = CASE.interpretation.faults[0].points
    _draw(page, fault[[*range(0, len(fault) - 2, 4), -1]])
    _choose(page, "Horizon")
    for piece in CASE.interpretation.horizon("H1").pieces:
        _draw(page, piece[[*range(0, len(piece) - 4, 8), -1]])
    _choose(page, "Hold")
    _draw(page, [CASE.fixed], finished=False)
    _choose(page, "Look")


def is_of_today(page):
    """Wait until the restored pane shows the section as it is today."""
    page.wait_for_function(ALIKE, arg=True)


def is_restored(page):
    """Wait until the app says so, and the restored pane shows something else than the section of today."""
    page.locator(".widget-label").get_by_text("restored", exact=True).wait_for()
    page.wait_for_function(ALIKE, arg=False)


def _choose(page, tool):
    page.get_by_role("button", name=tool, exact=True).click()


def _draw(page, points, finished=True):
    """Click on points of the section of today, in its units; a double click on the last one finishes the line."""
    places = _on_page(page, np.asarray(points)).tolist()
    for place in places[:-1] if finished else places:
        page.mouse.click(*place)
    if finished:
        page.mouse.dblclick(*places[-1])


def _on_page(page, points):
    """Positions of points on the page, read off the axes as a person would: not every page has a kernel to ask."""
    plot = page.locator("canvas.seiswidgets-plot").first
    plot.scroll_into_view_if_needed()
    box, ticks = plot.bounding_box(), page.evaluate(TICKS)
    scales = [np.polyfit([tick["at"] for tick in axis], [tick["pixel"] for tick in axis], 1) for axis in ticks]
    places = np.column_stack([np.polyval(scale, along) for scale, along in zip(scales, points.T, strict=True)])
    corner, size = np.array([box["x"], box["y"]]), np.array([box["width"], box["height"]])
    return places.clip(corner + 2, corner + size - 2)
