"""The dashboard through Voila, as behind Binder's link."""

import re
import shutil

import pytest
from playwright.sync_api import expect

from tests.widgets.axe import serious
from tests.widgets.browser import IGNORED, ROOT, RUN, keep_picture
from tests.widgets.byhand import draw_faulted_fold, is_of_today, is_painted, is_restored

# What Voila's page itself takes from elsewhere, and an extension of Jupyter Notebook, where that is installed too.
FOREIGN = re.compile("https://cdn|@jupyter-notebook/lab-extension")
AXES_SEEN = """() => [...document.querySelectorAll(".seiswidgets-layer .label")].every((label) => {
  const { left, width, top, height } = label.getBoundingClientRect();
  label.style.pointerEvents = "auto";
  const seen = document.elementFromPoint(left + width / 2, top + height / 2) === label;
  label.style.pointerEvents = "";
  return seen;
})"""
TABS_CUT = """() => [...document.querySelectorAll(".seiswidgets-pages .lm-TabBar-tabLabel")]
  .filter((label) => label.scrollWidth > label.clientWidth).map((label) => label.textContent)"""


@pytest.fixture
def dashboard(other_server, chromium):
    """The page of the dashboard; at the end the console must hold no error."""
    shutil.copy(ROOT / "notebooks" / "dashboard.ipynb", other_server.folder)
    context, errors = chromium.new_context(viewport={"width": 1200, "height": 1000}), []
    page = context.new_page()
    page.set_default_timeout(RUN * 1000)
    page.on("console", lambda message: errors.append(_told(message)) if message.type == "error" else None)
    page.on("pageerror", lambda error: errors.append(str(error)))
    page.goto(other_server.address("dashboard.ipynb", "voila/render"))
    yield page
    context.close()
    other_server.end_kernels()
    assert [error for error in errors if not (IGNORED.search(error) or FOREIGN.search(error))] == []


def _told(message):
    return f"{message.text} ({message.location.get('url')})"


def test_a_section_is_chosen_and_restored_by_mouse(dashboard):
    is_painted(dashboard)
    assert dashboard.evaluate(AXES_SEEN)
    is_of_today(dashboard)
    draw_faulted_fold(dashboard)
    is_restored(dashboard)
    keep_picture(dashboard, "dashboard")

    dashboard.get_by_label("with an interpreter's picks").check()
    dashboard.get_by_label("Section", exact=True).select_option("Graben")
    dashboard.get_by_text("Two faults, and between them").wait_for()
    is_painted(dashboard)
    is_restored(dashboard)
    expect(dashboard.locator("canvas.seiswidgets-plot")).to_have_count(2)
    assert serious(dashboard) == []
    keep_picture(dashboard, "dashboard-graben")

    dashboard.set_viewport_size({"width": 900, "height": 700})
    dashboard.wait_for_function("document.querySelector('.seiswidgets-pages').clientWidth < 450")
    assert dashboard.evaluate(TABS_CUT) == []
