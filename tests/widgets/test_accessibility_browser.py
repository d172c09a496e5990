"""The app's own elements by axe-core, in JupyterLab: nothing serious, in either theme and on any of its tabs."""

from importlib import resources

import pytest
from playwright.sync_api import expect

from tests.widgets.byhand import is_painted, is_restored

AXE = (resources.files("axe_playwright_python") / "axe.min.js").read_text(encoding="utf-8")
CELL = """
import seiswidgets as sw
gallery = sw.Gallery(with_picks=True)
gallery
"""
TABS = ("Picks", "Weights", "Steps", "Solver", "Display", "Report")
FINDINGS = """async () => {
  const found = await axe.run(".jp-OutputArea-output > .widget-vbox", { resultTypes: ["violations"] });
  return found.violations
    .filter(({ impact }) => impact === "serious" || impact === "critical")
    .flatMap(({ id, nodes }) => nodes.map((node) => `${id}: ${node.html} ${node.failureSummary}`));
}"""


@pytest.mark.parametrize("dark", [False, True])
def test_axe_finds_nothing_serious_in_the_app(notebook, dark):
    opened = notebook(CELL, dark=dark, height=1200)
    is_painted(opened.page)
    is_restored(opened.page)
    opened.page.evaluate(AXE)
    for tab in TABS:
        opened.page.get_by_role("tab", name=tab, exact=True).click()
        opened.page.get_by_role("tabpanel").first.wait_for()
        assert opened.page.evaluate(FINDINGS) == [], tab
    opened.page.get_by_role("tab", name="File", exact=True).click()
    opened.page.get_by_placeholder("section: path of").wait_for()  # it is made when it is looked at
    assert opened.page.evaluate(FINDINGS) == []


def test_controls_are_found_by_the_names_that_are_seen_beside_them(notebook):
    opened = notebook(CELL, height=1200)
    is_restored(opened.page)
    opened.page.get_by_role("button", name="Play", exact=True).click()
    opened.page.get_by_role("button", name="Pause", exact=True).click()
    opened.page.get_by_role("slider", name="Time").wait_for()
    opened.page.get_by_role("tab", name="Weights").click()
    opened.page.get_by_role("slider", name="stitch").wait_for()
    opened.page.get_by_role("tab", name="Picks").click()
    fault = opened.page.get_by_role("textbox", name="name of this fault")
    expect(fault).to_have_value("F1")
    opened.ask("setattr(gallery, 'choice', 'graben')")
    opened.page.get_by_text("Two faults, and between them").wait_for()
    expect(fault).to_have_count(2)
