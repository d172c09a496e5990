"""The curve of the tab Match in a browser: by mouse and keyboard, in both themes, and for screen readers."""

import re

from playwright.sync_api import expect

from tests.widgets.axe import serious
from tests.widgets.browser import keep_picture

CELL = """
import seiswidgets as sw
case = sw.synthetic.faulted_fold(noise=0.2)
picks = case.interpretation
one, two, _ = picks.horizons
drawn = sw.Interpretation(picks.faults, [one, sw.Horizon(two.pieces[0], name="H2")])
app = sw.RestorationApp(case.section, drawn, fixed=case.fixed)
app
"""
CHART = ".seiswidgets-match .chart"
APP = ".jp-OutputArea-output > .widget-vbox"


def test_a_slip_is_chosen_on_the_curve(notebook):
    opened = notebook(CELL, height=1100)
    page = opened.page
    page.get_by_role("tab", name="Match", exact=True).click()
    chart = page.locator(CHART)
    chart.locator(".curve").wait_for()
    slider = page.get_by_role("slider", name="Slip of the fault")
    chart.locator(".match").wait_for(state="attached")  # a line has no width
    page.get_by_role("button", name=re.compile("Suggest$")).click()
    page.get_by_text("H2 in the hanging wall of F1").wait_for()
    for dark in (True, False):
        opened.darken(dark)
        assert serious(page, APP) == [], dark
        keep_picture(page.locator(APP).first, f"match-{'dark' if dark else 'light'}")
    box = chart.locator(".peak.first").bounding_box()
    page.mouse.click(box["x"] + box["width"] / 2, box["y"] + box["height"] / 2)
    opened.until("app.steps[0].slip and app.steps[0].slip['F1'] == app.match.scan.profile")
    expect(slider).to_have_attribute("aria-valuetext", "174 m, correlation 0.98", timeout=20_000)
    slider.focus()
    page.keyboard.press("ArrowLeft")
    opened.until("abs(app.match.chart.slip - app.match.scan.peaks[0].slip + 5) < 1e-6")
    opened.until("app.workspace.history.next_undo.label == 'slip of F1' and app.workspace.settled")
    page.get_by_role("button", name="Accept").click()
    opened.until("len(app.interpretation.horizon('H2').pieces) == 2")
