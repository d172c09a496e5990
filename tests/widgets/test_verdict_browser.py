"""The verdict on a restoration as it is seen: good, and of picks that contradict each other."""

import numpy as np
import pytest

from tests.widgets.axe import serious

CELL = """
import seiswidgets as sw
case = sw.synthetic.planar_fault(throw=150.0)
picks = case.interpretation
(left, right), (low_left, _), (_, low_right) = (horizon.pieces for horizon in picks.horizons)
bad = sw.Interpretation(picks.faults, [sw.Horizon(left, right, name="A"), sw.Horizon(low_left, low_right, name="B")])
weights = sw.Weights(stitch=1, slide=0.1)  # stiff rock: no slip matches both beds
app = sw.RestorationApp(case.section, picks, fixed=case.fixed, height=300, steps=(sw.Step("unfault"),), weights=weights)
app
"""
APP = ".jp-OutputArea-output > .widget-vbox"
TOP = "() => document.querySelector('canvas.seiswidgets-plot').getBoundingClientRect().top + window.scrollY"
UNDER = """(badge) => {
  const { left, bottom } = badge.getBoundingClientRect();
  return document.elementFromPoint(left + 5, bottom - 3).closest(".seiswidgets-layer") !== null;
}"""
OVER = "({ scrollWidth, clientWidth }) => scrollWidth - clientWidth"


@pytest.mark.parametrize("dark", [False, True])
def test_a_verdict_is_seen_where_one_looks_and_moves_nothing(notebook, dark):
    opened = notebook(CELL, dark=dark, height=1150)
    page = opened.page
    page.get_by_role("status").get_by_text("Cut-offs meet").wait_for()
    top, badge = page.evaluate(TOP), page.locator(".seiswidgets-pane-badge span").first
    opened.ask("app.set_trait('interpretation', bad)")
    page.get_by_role("alert").get_by_text("(see Report)").wait_for()
    badge.wait_for()
    assert page.locator(".seiswidgets-pane-badge svg:visible").count() == 1
    assert badge.evaluate(UNDER)  # the mouse reaches the section through it
    frame, plot = badge.locator("..").bounding_box(), page.locator(".seiswidgets-layer .plot").nth(1).bounding_box()
    np.testing.assert_allclose(list(frame.values()), list(plot.values()), atol=1)
    for width in (1200, 900):
        page.set_viewport_size({"width": width, "height": 1150})
        assert page.locator(APP).evaluate(OVER) <= 0
    assert serious(page, APP) == []
    page.set_viewport_size({"width": 1200, "height": 1150})
    page.get_by_role("tab", name="Report", exact=True).click()
    page.get_by_role("tabpanel").get_by_text("cut-offs apart").first.wait_for()
    assert serious(page, APP) == []
    assert page.evaluate(TOP) == top
