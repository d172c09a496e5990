"""The app's layout in its page: room for the panes, the handle below them, and the full window."""

import shutil

import pytest
from playwright.sync_api import expect

from tests.widgets.appscreen import FEW, RESTORED, SHOWN, AppScreen
from tests.widgets.browser import ROOT, Page, settled
from tests.widgets.byhand import is_painted
from tests.widgets.test_app_elsewhere_browser import run_first_cell

FILLING = """
import numpy as np
import seiswidgets as sw
case = sw.synthetic.faulted_fold()
drawn = case.interpretation
app = sw.RestorationApp(case.section)
editor, panes = app.picker.editor, (app.panes.original, app.panes.restored)
"""
SMALL = {"width": 1366, "height": 768}
PARTS = (
    ".seiswidgets-layer >> nth=0",
    ".seiswidgets-layer >> nth=1",
    "[role=status]",
    ".widget-play",
    ".seiswidgets-pages > .widget-tab-contents",
)


@pytest.fixture
def filling(notebook):
    """A function that shows an app as high as its window lets it, in a notebook's cell."""

    def open_it(*code, **options):
        return AppScreen(notebook("".join([FILLING, *code, SHOWN]), **{**SMALL, **options}))

    return open_it


def boxes(page, parts):
    """Boxes of visible parts of the page, once they have come to rest."""
    found = [page.locator(part).locator("visible=true").first for part in parts]
    return settled(lambda: [one.bounding_box() for one in found])


def are_seen(page):
    """Assert that the panes, the verdict, the timeline and the open panel lie in the window, of a useful size."""
    for part, box in zip(PARTS, boxes(page, PARTS), strict=True):
        assert box["y"] >= 0, part
        assert box["y"] + box["height"] <= SMALL["height"], part
        assert box["height"] > (200 if "layer" in part else 15), part


def app_height(page):
    return boxes(page, [".seiswidgets-app"])[0]["height"]


def test_all_is_seen_at_once_in_lab_and_no_tab_changes_the_height(filling):
    screen = filling(RESTORED)
    page = screen.page
    page.locator(".seiswidgets-app").evaluate("one => one.scrollIntoView({ block: 'end' })")
    are_seen(page)
    one, other = boxes(page, PARTS[:2])
    assert one["width"] == other["width"] > 450
    height = app_height(page)
    for name in screen.ask("list(app.tabs.titles)"):
        screen.tab(name)
        assert app_height(page) == height


def test_all_is_seen_at_once_in_voila(other_server, chromium):
    shutil.copy(ROOT / "notebooks" / "dashboard.ipynb", other_server.folder)
    page = Page(chromium, other_server.address("dashboard.ipynb", "voila/render"), **SMALL)
    is_painted(page.page)
    are_seen(page.page)
    page.page.set_viewport_size({"width": 950, "height": 768})
    page.page.locator(".seiswidgets-narrow").wait_for()
    one, other = boxes(page.page, PARTS[:2])
    assert other["y"] >= one["y"] + one["height"]
    assert one["width"] == other["width"] > 700
    page.close()
    other_server.end_kernels()


def test_all_tabs_have_room(filling):
    screen = filling(width=1000)
    page, tabs = screen.page, screen.page.locator(".seiswidgets-pages").get_by_role("tab")
    expect(tabs).to_have_count(screen.ask("len(app.tabs.titles)"))
    bar = page.locator(".seiswidgets-pages").bounding_box()
    for tab in tabs.all():
        box, label = tab.bounding_box(), tab.locator(".lm-TabBar-tabLabel")
        assert bar["x"] - 1 <= box["x"] < box["x"] + box["width"] <= bar["x"] + bar["width"] + 1
        assert label.evaluate("one => one.scrollWidth <= one.clientWidth")


@pytest.mark.parametrize("start", [FILLING, FILLING.replace("section)", "section, height=340)")])
def test_the_handle_shares_the_height_by_mouse_and_keyboard(notebook, start):
    page = notebook(start + SHOWN, **SMALL).page
    is_painted(page)
    handle, parts = page.get_by_role("separator"), [".seiswidgets-panes", ".seiswidgets-below"]
    height = app_height(page)
    usual = [box["height"] for box in boxes(page, parts)]
    handle.scroll_into_view_if_needed()
    box = handle.bounding_box()
    x, y = box["x"] + box["width"] / 3, box["y"] + box["height"] / 2
    page.mouse.move(x, y)
    page.mouse.down()
    page.mouse.move(x, y - 40, steps=4)
    page.mouse.up()
    upper, lower = (box["height"] for box in boxes(page, parts))
    assert upper == pytest.approx(usual[0] - 40, abs=1.5)
    assert lower == pytest.approx(usual[1] + 40, abs=1.5)
    assert app_height(page) == pytest.approx(height, abs=1)
    expect(handle).to_have_attribute("aria-valuenow", str(round(100 * upper / (upper + lower))))
    handle.focus()
    page.keyboard.press("End")
    assert boxes(page, parts)[1]["height"] == pytest.approx(110, abs=1.5)
    page.keyboard.press("Enter")
    assert [box["height"] for box in boxes(page, parts)] == pytest.approx(usual, abs=1.5)


def maximises(page, has_room):
    """Assert that the app fills the window, whatever is around it, until Escape; the focus stays."""
    box = page.locator(".seiswidgets-app").bounding_box()
    button = page.get_by_title("Fill the window")
    button.click()
    page.locator(".seiswidgets-maximised").wait_for()
    (filled,) = boxes(page, [".seiswidgets-app"])
    assert filled == {"x": 0, "y": 0, **page.viewport_size}
    assert page.locator(".seiswidgets-maximise button").evaluate("one => one === document.activeElement")
    (plot,) = boxes(page, [".seiswidgets-layer .plot"])
    assert plot["height"] > has_room
    seen = "([x, y]) => document.elementFromPoint(x, y).closest('.seiswidgets-app') !== null"
    for at in ([5, 5], [page.viewport_size["width"] - 5, page.viewport_size["height"] - 5]):
        assert page.evaluate(seen, at)
    plot = page.locator(".seiswidgets-layer .plot").first
    page.get_by_role("button", name="Fault", exact=True).click()
    plot.focus()
    page.keyboard.press("Escape")  # back to Look
    expect(page.locator("button[data-value=look], button.mod-active").first).to_have_text("Look")
    assert page.locator(".seiswidgets-maximised").count() == 1
    page.keyboard.press("Escape")
    page.locator(".seiswidgets-maximised").wait_for(state="detached")
    assert plot.evaluate("one => one === document.activeElement")
    back = page.locator(".seiswidgets-app").bounding_box()
    assert [back[name] for name in ("x", "width", "height")] == [box[name] for name in ("x", "width", "height")]


def test_the_app_fills_labs_window(open_app):
    screen = open_app(FEW, height=700)
    screen.page.locator(".seiswidgets-app").evaluate("one => one.scrollIntoView({ block: 'start' })")
    maximises(screen.page, 250)


@pytest.mark.parametrize("place", ["voila/render", "notebooks"])
def test_the_app_fills_the_window_elsewhere(elsewhere, place):
    page = elsewhere(FILLING + SHOWN, place).page
    if place == "notebooks":
        page.locator(".jp-Notebook-ExecutionIndicator[data-status=idle]").wait_for(state="attached")
        run_first_cell(page)
    is_painted(page)
    maximises(page, 500)
