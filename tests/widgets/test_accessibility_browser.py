"""The app's own elements by axe-core, in JupyterLab: nothing serious, in either theme and on any of its tabs."""

from importlib import resources

import pytest

from tests.widgets.browser import SCREENSHOTS
from tests.widgets.byhand import is_painted, is_restored

AXE = (resources.files("axe_playwright_python") / "axe.min.js").read_text(encoding="utf-8")
CELL = """
import seiswidgets as sw
gallery = sw.Gallery(with_picks=True)
gallery
"""
TABS = ("Picks", "Weights", "Steps", "Solver", "Display", "Report")
FINDINGS = """async () => {
  const found = await axe.run(document.querySelector(".jp-OutputArea-output .widget-vbox"), { resultTypes: ["violations"] });
  return found.violations
    .filter(({ impact }) => impact === "serious" || impact === "critical")
    .flatMap(({ id, nodes }) => nodes.map((node) => `${id}: ${node.failureSummary} ${node.html}`));
}"""


@pytest.mark.parametrize("dark", [False, True])
def test_the_app_has_no_serious_finding(notebook, dark):
    opened = notebook(CELL, dark=dark, height=1200)
    is_painted(opened.page)
    is_restored(opened.page)
    opened.page.evaluate(AXE)
    findings = {}
    for tab in TABS:
        opened.page.get_by_role("tab", name=tab, exact=True).click()
        findings |= {finding: tab for finding in opened.page.evaluate(FINDINGS)}
    assert findings == {}
