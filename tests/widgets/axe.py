"""Accessibility violations that axe-core finds on a page."""

from importlib import resources

AXE = (resources.files("axe_playwright_python") / "axe.min.js").read_text(encoding="utf-8")
NOT_OURS = [".jp-RenderedImage img"]  # to which JupyterLab gives no alternative text
FINDINGS = """async ([include, exclude]) => {
  const found = await axe.run({ include, exclude }, { resultTypes: ["violations"] });
  return found.violations
    .filter(({ impact }) => impact === "serious" || impact === "critical")
    .flatMap(({ id, nodes }) => nodes.map((node) => `${id}: ${node.html} ${node.failureSummary}`));
}"""


def serious(page, place="html"):
    """The serious and critical findings in the elements that a selector finds."""
    page.evaluate(AXE)
    return page.evaluate(FINDINGS, [[place], NOT_OURS])
