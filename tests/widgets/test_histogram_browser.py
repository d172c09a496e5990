import time

from playwright.sync_api import expect

from tests.widgets.browser import keep_picture

CELL = """
import numpy as np
import seiswidgets as sw
random = np.random.default_rng(3)
heard = []
histogram = sw.DeformationHistogram(np.exp(random.normal(0.01, 0.06, 4000)), random.uniform(1, 2, 4000))
histogram.observe(lambda change: heard.append(change.new), "brush")
histogram
"""
WORK = 0.4  # seconds that the kernel is at work on each brush
SLOW = f"""
import time
histogram.observe(lambda change: time.sleep({WORK}), "brush")
histogram
"""
EDGES = "histogram.bars['edges']"
LEFT, RIGHT = 46, 22  # css pixels beside the bars
CHART = ".seiswidgets-histogram .chart"


def chart(opened, number=0):
    one = opened.page.locator(CHART).nth(number)
    one.locator(".bar").first.wait_for(state="attached")
    return one


def bar(opened, number):
    """The middle of a bar's column, on the page."""
    box = chart(opened).bounding_box()
    return box["x"] + LEFT + (number + 0.5) * (box["width"] - LEFT - RIGHT) / 41, box["y"] + box["height"] / 3


def is_brushed(opened, first, last):
    """Wait until the kernel's brush is these bars, and the page shows it."""
    opened.until(f"histogram.brush == [{EDGES}[{first}], {EDGES}[{last + 1}]]")
    views = opened.page.locator(CHART).count()
    expect(opened.page.locator(f"{CHART} .bar:not(.faded)")).to_have_count(views * (last - first + 1))


def shoot(opened, name):
    keep_picture(opened.page.locator(".seiswidgets-histogram").first, name)


def shoot_in_both_themes(opened, name):
    for dark in (True, False):
        opened.darken(dark)
        shoot(opened, f"{name}-{'dark' if dark else 'light'}")


def test_brushing_by_mouse(notebook):
    opened = notebook(CELL)
    chart(opened)
    shoot_in_both_themes(opened, "histogram")
    opened.page.mouse.move(*bar(opened, 25))
    opened.page.mouse.down()
    is_brushed(opened, 25, 25)
    opened.page.mouse.move(*bar(opened, 16), steps=20)
    is_brushed(opened, 16, 25)  # while the button is down
    opened.page.mouse.up()
    opened.page.mouse.move(*bar(opened, 5))
    is_brushed(opened, 16, 25)
    share = opened.ask("histogram.brushed")
    assert share.endswith("of the area")
    opened.page.get_by_text(share).wait_for()
    opened.ask("histogram.set_trait('mark', 1.05)")
    opened.page.locator(f"{CHART} .mark").wait_for(state="attached")
    shoot_in_both_themes(opened, "histogram-brushed")

    opened.page.keyboard.down("Shift")
    opened.page.mouse.click(*bar(opened, 12))
    opened.page.keyboard.up("Shift")
    is_brushed(opened, 12, 25)
    opened.page.mouse.dblclick(*bar(opened, 30))
    opened.until("histogram.brush == []")
    expect(opened.page.locator(f"{CHART} .faded")).to_have_count(0)


def test_brushing_by_keyboard(notebook):
    opened = notebook(CELL)
    chart(opened).focus()
    press = opened.page.keyboard.press
    press("ArrowRight")
    is_brushed(opened, 20, 20)  # the bar about 1
    press("ArrowRight")
    is_brushed(opened, 21, 21)
    for _ in range(3):
        press("Shift+ArrowLeft")
    is_brushed(opened, 18, 21)
    press("Shift+ArrowRight")
    is_brushed(opened, 19, 21)
    shoot(opened, "histogram-focused")
    press("ArrowLeft")
    is_brushed(opened, 18, 18)
    press("End")
    press("ArrowRight")
    is_brushed(opened, 40, 40)
    press("Shift+Home")
    is_brushed(opened, 0, 40)
    press("Escape")
    opened.until("histogram.brush == []")
    press("Tab")
    assert not chart(opened).evaluate("chart => chart === document.activeElement")


def test_a_brush_and_a_mark_from_code_are_shown(notebook):
    opened = notebook(CELL)
    chart(opened).focus()
    opened.page.keyboard.press("Home")
    is_brushed(opened, 0, 0)
    opened.ask(f"histogram.set_trait('brush', {EDGES}[10:14:3])")
    is_brushed(opened, 10, 12)
    opened.page.keyboard.press("Shift+ArrowRight")
    is_brushed(opened, 10, 13)  # it goes on from there
    mark = opened.page.locator(f"{CHART} .mark")
    for ratio, number in ((1.0, 20), (1e-3, 0), (1e3, 40)):
        opened.ask(f"histogram.set_trait('mark', {ratio})")
        expect(mark).to_have_attribute("data-bar", str(number))
    opened.ask("histogram.set_trait('mark', None)")
    mark.wait_for(state="detached")


def test_while_the_kernel_is_at_work_one_message_is_under_way(notebook):
    opened = notebook(CELL + SLOW)
    opened.page.mouse.move(*bar(opened, 20))
    opened.page.mouse.down()
    is_brushed(opened, 20, 20)
    frames, start = len(opened.sent), time.monotonic()
    for number in (0, 40, 7):
        opened.page.mouse.move(*bar(opened, number), steps=60)
    opened.page.mouse.up()
    most = (time.monotonic() - start) / WORK + 2
    assert len(opened.sent) - frames <= most
    is_brushed(opened, 7, 20)  # the newest is not lost
    assert opened.ask("len(heard)") <= most + 2


def test_two_views_agree_also_after_a_reload(notebook):
    opened = notebook(CELL, "histogram")
    chart(opened, 1)
    opened.page.mouse.click(*bar(opened, 30))
    opened.until(f"histogram.brush == [{EDGES}[30], {EDGES}[31]]")
    markup = "([...document.querySelectorAll('.seiswidgets-histogram')].map((one) => one.innerHTML))"
    same = f"(([one, other]) => one.replace(' by-pointer', '') === other)({markup})"
    opened.page.wait_for_function(same)
    expect(opened.page.locator(f"{CHART} .bar:not(.faded)")).to_have_count(2)
    opened.command("docmanager:save")
    opened.reload()
    chart(opened, 1)
    opened.page.wait_for_function(same)
    expect(opened.page.locator(f"{CHART} .bar:not(.faded)")).to_have_count(2)


def test_nothing_restored_yet(notebook):
    opened = notebook("import seiswidgets as sw\nhistogram = sw.DeformationHistogram()\nhistogram")
    opened.page.get_by_text("Nothing restored yet").wait_for()
    opened.page.locator(CHART).focus()
    opened.page.keyboard.press("ArrowRight")
    opened.page.locator(CHART).click()
    shoot(opened, "histogram-empty")
    opened.ask("histogram.show([0.99, 1.0, 1.01])")
    chart(opened)
    assert opened.ask("histogram.brush") == []


def test_in_a_narrow_place(notebook):
    opened = notebook(CELL + "histogram.layout.width = '320px'\nhistogram")
    chart(opened)
    inside = """() => {
      const room = document.querySelector(".seiswidgets-histogram").getBoundingClientRect();
      return [...document.querySelectorAll(".seiswidgets-histogram text")].every((text) => {
        const box = text.getBoundingClientRect();
        return box.left >= room.left - 1 && box.right <= room.right + 1 && box.bottom <= room.bottom + 1;
      });
    }"""
    opened.page.wait_for_function(inside)
    shoot(opened, "histogram-narrow")
