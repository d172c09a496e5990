"""The app outside JupyterLab, and under fingers: in Notebook 7, in Voila, on a screen that is touched."""

import contextlib

import pytest
from playwright.sync_api import expect

from tests.widgets.appscreen import EMPTY, FEW, PICKS, SHOWN
from tests.widgets.byhand import is_painted

FAULT = [(0.46, 0.01), (0.53, 0.35), (0.62, 0.7), (0.74, 0.99)]  # shares of the plot area


def fault_places(page):
    box = page.locator(".seiswidgets-layer .plot").first.bounding_box()
    return [(box["x"] + x * box["width"], box["y"] + y * box["height"]) for x, y in FAULT]


def is_drawn(page):
    """The kernel has made a fault of it: both panes show it, and the list has it."""
    expect(page.locator(".seiswidgets-layer .name")).to_have_text(["F1", "F1"])
    expect(page.locator("input[title='name of this fault']")).to_have_value("F1")


@pytest.mark.parametrize("place", ["voila/render", "notebooks"])
def test_a_fault_is_drawn_in_voila_and_in_notebook_7(elsewhere, place):
    page = elsewhere(EMPTY + SHOWN, place).page
    if place == "notebooks":
        page.locator(".jp-Notebook-ExecutionIndicator[data-status=idle]").wait_for(state="attached")
        run_first_cell(page)
    is_painted(page)
    page.locator("button[data-value=Fault]").click()
    places = fault_places(page)
    for at in places[:-1]:
        page.mouse.click(*at)
    page.mouse.dblclick(*places[-1])
    is_drawn(page)


def run_first_cell(page):
    """Run it; a key that comes before the page listens is lost, so it is pressed until the cell has a number."""
    prompt = page.locator(".jp-CodeCell .jp-InputPrompt").first
    for _ in range(20):
        page.locator(".jp-CodeCell .cm-content").first.click()
        page.keyboard.press("Shift+Enter")
        with contextlib.suppress(AssertionError):
            expect(prompt).not_to_have_text("[ ]:", timeout=2000)
            return
    pytest.fail("the cell was never run")


def test_a_fault_is_drawn_by_taps(open_app):
    screen = open_app(touch=True)
    screen.page.locator("button[data-value=Fault]").tap()
    screen.until("app.picker.mode == 'fault'")
    places = fault_places(screen.page)
    for at in [*places, places[-1]]:  # twice on the last
        screen.page.touchscreen.tap(*at)
    is_drawn(screen.page)
    screen.becomes("len(app.interpretation.faults[0].points)", 4)


def test_a_long_press_opens_the_menu_and_puts_no_vertex(open_app):
    screen = open_app(FEW, touch=True)
    page, before = screen.page, screen.ask(PICKS)
    page.locator("button[data-value=Fault]").tap()
    screen.until("app.picker.mode == 'fault'")
    touch = page.context.new_cdp_session(page)
    x, y = screen.pixels([(3400, 1800)])[0]
    touch.send("Input.dispatchTouchEvent", {"type": "touchStart", "touchPoints": [{"x": float(x), "y": float(y)}]})
    item = page.get_by_role("menuitem", name="All gestures and keys")
    item.wait_for()
    touch.send("Input.dispatchTouchEvent", {"type": "touchEnd", "touchPoints": []})
    screen.until("not app.picker.dragging and editor.drawing.draft is None")
    assert screen.ask(PICKS) == before
    expect(page.get_by_role("menu")).to_have_count(1)  # opened once, and still open
    assert item.bounding_box()["height"] >= 24
    item.tap()
    page.locator(".seiswidgets-help").wait_for()
