"""Outputs that are scaled, moved, hidden or shown twice: clicks land where they are seen, and pictures fit."""

import numpy as np
import pytest
from playwright.sync_api import expect

from tests.widgets.appscreen import FEW, PICKS, RESTORED
from tests.widgets.browser import settled

SCALES = {
    "transform": "document.querySelector('.jp-Notebook').style = 'transform: scale(1.5); transform-origin: 0 0'",
    "zoom": "document.body.style.zoom = '1.25'",
}
BACK = "document.body.style.zoom = document.querySelector('.jp-Notebook').style = ''"
PIXELS = """() => {
  const shown = [...document.querySelectorAll("canvas.seiswidgets-plot")].filter((one) => one.offsetParent);
  return shown.map((one) => [one, one.getBoundingClientRect()])
    .map(([{ width, height }, box]) => [width / box.width, height / box.height]);
}"""
NOTEBOOK = """() => {  // whose kernel is asked, whatever was clicked last
  const { shell } = jupyterapp;
  shell.activateById([...shell.widgets("main")].find((one) => one.sessionContext).id);
}"""
SHARES, OTHERS = [(0.3, 0.1), (0.4, 0.5), (0.5, 0.9)], [(0.7, 0.1), (0.75, 0.5), (0.8, 0.9)]


def draws_where_it_is_seen(screen, plot, shares=SHARES):
    """Draw a fault by shares of a plot as it is on the page, and compare with the same shares of the pane's window."""
    box = settled(plot.bounding_box)
    places = [(box["x"] + x * box["width"], box["y"] + y * box["height"]) for x, y in shares]
    screen.page.evaluate(NOTEBOOK)
    count = screen.ask("len(app.interpretation.faults)")
    screen.ask("app.picker.set_trait('mode', 'fault')")
    for at in places[:-1]:
        screen.page.mouse.click(*at)
    screen.page.mouse.dblclick(*places[-1])
    screen.page.evaluate(NOTEBOOK)
    screen.until(f"len(app.interpretation.faults) == {count + 1}")
    left, right, top, bottom = screen.ask("list(map(float, panes[0].view.window))")
    wanted = [(left + x * (right - left), top + z * (bottom - top)) for x, z in shares]
    drawn = screen.points("editor.drawing.picks[-1].pieces[0]")
    np.testing.assert_allclose(drawn, wanted, atol=0.002 * (right - left))


def is_sharp(page, ratio=1):
    """Wait until each picture has as many pixels as the screen gives it."""
    settled(lambda: page.evaluate(PIXELS), lambda found: found and np.allclose(found, ratio, atol=0.02))


def test_the_browser_zooms(open_app):
    screen = open_app(FEW, "app.interpretation = sw.Interpretation()\n")
    session = screen.page.context.new_cdp_session(screen.page)
    metrics = {"width": 960, "height": 920, "deviceScaleFactor": 1.25, "mobile": False}
    session.send("Emulation.setDeviceMetricsOverride", metrics)
    try:
        is_sharp(screen.page, 1.25)
        draws_where_it_is_seen(screen, screen.plots.first)
    finally:
        session.send("Emulation.clearDeviceMetricsOverride")


@pytest.mark.parametrize("scale", SCALES)
def test_a_page_is_scaled_after_layout(open_app, scale):
    screen = open_app(FEW, "app.interpretation = sw.Interpretation()\n")
    page = screen.page
    try:
        page.evaluate(SCALES[scale])
        plot = screen.plots.first
        plot.hover(position={"x": 100, "y": 60})  # nothing tells the page that it is scaled
        is_sharp(page)
        draws_where_it_is_seen(screen, plot)
    finally:
        page.evaluate(BACK)


def test_the_histogram_is_brushed_on_a_scaled_page(open_app):
    screen = open_app(RESTORED)
    screen.until("app.wait(60) and app.histogram.bars")
    try:
        screen.page.evaluate(SCALES["transform"].replace("1.5", "0.7"))  # larger, it would lie below the window
        screen.page.locator(".seiswidgets-histogram .column").nth(20).click()
        screen.nears("app.histogram.brush", screen.ask("app.histogram.bars['edges'][20:22]"))
    finally:
        screen.page.evaluate(BACK)


def test_a_cell_is_moved_and_its_output_hidden_and_shown(open_app):
    screen = open_app(FEW, "app.interpretation = sw.Interpretation()\n", more=["b = 2"])
    screen.opened.command("notebook:move-cell-down")
    screen.pictures()
    draws_where_it_is_seen(screen, screen.plots.first)
    app = screen.page.locator(".seiswidgets-app")
    app.evaluate("one => one.parentElement.style.display = 'none'")
    screen.page.set_viewport_size({"width": 1000, "height": 1150})  # while nothing is seen
    app.evaluate("one => one.parentElement.style.display = ''")
    is_sharp(screen.page)
    draws_where_it_is_seen(screen, screen.plots.first, OTHERS)


def test_a_new_view_of_the_output_is_drawn_in(open_app):
    screen = open_app(FEW, "app.interpretation = sw.Interpretation()\n")
    screen.opened.command("notebook:create-output-view")
    views = screen.page.locator(".jp-LinkedOutputView .seiswidgets-layer .plot")
    expect(views).to_have_count(2)
    is_sharp(screen.page)
    draws_where_it_is_seen(screen, views.first)
    before = screen.ask(PICKS)
    draws_where_it_is_seen(screen, screen.plots.first, OTHERS)
    assert screen.ask(PICKS)[: len(before)] == before
