import re

import pytest
from playwright.sync_api import expect

CELL = """
import seiswidgets as sw
heard = []
timeline = sw.Timeline(["unfault", "flatten"])
timeline.observe(lambda change: heard.append(change.new), "time")
timeline
"""


def test_play_runs_once_to_the_end(notebook):
    opened = notebook(CELL)
    opened.page.get_by_text("restored", exact=True).wait_for()
    for start in (0.55, 2.0):
        opened.ask(f"timeline.set_trait('time', {start})")
        opened.page.get_by_text("restored" if start == 2 else "unfault 55%", exact=True).wait_for()
        opened.ask("heard.clear()")
        opened.page.locator(".widget-play button").first.click()
        opened.until("heard and timeline.time == 2 and not timeline.play.playing")
        heard = opened.ask("heard")
        assert heard == sorted(heard)
        assert heard[0] == pytest.approx(0 if start == 2 else start, abs=0.11)  # frames may be left out
        assert len(heard) > 5
        opened.page.get_by_text("restored", exact=True).wait_for()


def test_the_slider_keeps_its_place_after_a_reload(notebook):
    opened = notebook(CELL)
    opened.page.get_by_text("restored", exact=True).wait_for()
    opened.ask("timeline.set_trait('time', 0.3)")
    opened.page.get_by_text("unfault 30%").wait_for()
    opened.command("docmanager:save")
    opened.reload()
    handle = opened.page.locator(".noUi-handle")
    handle.wait_for()
    opened.page.get_by_text("unfault 30%").wait_for()
    expect(handle).to_have_attribute("aria-valuenow", re.compile(r"18(\.0)?"))
    handle.focus()
    opened.page.keyboard.press("ArrowRight")
    opened.until("timeline.time == 19 / 60")
    opened.until("timeline.play.value == 19")  # Play goes on from there
