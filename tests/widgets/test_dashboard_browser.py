"""The dashboard through Voila, as behind Binder's link."""

import re
import shutil

import pytest
from playwright.sync_api import expect

from tests.widgets.axe import serious
from tests.widgets.browser import IGNORED, ROOT, RUN, keep_picture
from tests.widgets.byhand import draw_faulted_fold, is_of_today, is_painted, is_restored

# What Voila's page itself takes from elsewhere, an extension of Jupyter Notebook, where that is installed too, and the
# page's wish to end its kernel when it is left, which the server refuses; and a message to the kernel from a page that
# is being left, which its kernel connection refuses.
FOREIGN = re.compile(
    "https://cdn|@jupyter-notebook/lab-extension|voila/api/shutdown|^Cannot send$"
    "|Failed to initialize model"  # anywidget says so after 2 s on a busy machine; the tests assert what must be seen
)
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
def open_dashboard(other_server, chromium):
    """A function that opens the dashboard in a tab of one browser; at the end its console must hold no error."""
    shutil.copy(ROOT / "notebooks" / "dashboard.ipynb", other_server.folder)
    context, errors = chromium.new_context(viewport={"width": 1200, "height": 1000}), []

    def open_it(before=""):
        page = context.new_page()
        page.set_default_timeout(RUN * 1000)
        page.on("console", lambda message: errors.append(_told(message)) if message.type == "error" else None)
        page.on("pageerror", lambda error: errors.append(str(error)))
        page.add_init_script(before)
        page.goto(other_server.address("dashboard.ipynb", "voila/render"))
        return page

    yield open_it
    context.close()
    other_server.end_kernels()
    assert [error for error in errors if not (IGNORED.search(error) or FOREIGN.search(error))] == []


def _told(message):
    return f"{message.text} ({message.location.get('url')})"


@pytest.fixture
def dashboard(open_dashboard):
    return open_dashboard()


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


BACK = "Your drawing on this section is back; Start over clears it."
FULL = """Storage.prototype.setItem = () => { throw new DOMException("no room is left", "QuotaExceededError"); };"""
FORBIDDEN = """for (const name of ["localStorage", "sessionStorage"])
  Object.defineProperty(window, name, { get() { throw new DOMException("denied", "SecurityError"); } });"""


def names(page):
    """Names of the picks in the app's list."""
    return page.locator("input[title^='name of this']")


def draw_fault(page, shares):
    """Draw a fault through points given as shares of the section's picture."""
    is_painted(page)
    page.get_by_role("button", name="Fault", exact=True).click()
    box = page.locator(".seiswidgets-layer .plot").first.bounding_box()
    places = [(box["x"] + x * box["width"], box["y"] + y * box["height"]) for x, y in shares]
    for place in places[:-1]:
        page.mouse.click(*place)
    page.mouse.dblclick(*places[-1])


def is_kept(page, text):
    """Wait until the browser has a text in what it keeps."""
    page.wait_for_function("(text) => Object.values(sessionStorage).some((kept) => kept.includes(text))", arg=text)


def rename(page, name):
    names(page).first.fill(name)
    names(page).first.press("Enter")
    is_kept(page, f'"{name}"')


def line(page):
    """The first line drawn on the present-day section."""
    return page.locator(".seiswidgets-layer .plot").first.locator(".stroke .line").first.get_attribute("d")


def test_a_reload_brings_back_what_was_drawn_on_each_section(dashboard):
    draw_fault(dashboard, [(0.46, 0.1), (0.53, 0.5), (0.62, 0.9)])
    rename(dashboard, "dome's")
    drawn = line(dashboard)
    dashboard.get_by_label("Section", exact=True).select_option("Graben")
    dashboard.get_by_text("Two faults, and between them").wait_for()
    expect(names(dashboard)).to_have_count(0)
    draw_fault(dashboard, [(0.3, 0.1), (0.4, 0.5)])
    rename(dashboard, "graben's")

    dashboard.reload()
    dashboard.get_by_text(BACK).wait_for()
    expect(names(dashboard)).to_have_value("graben's")
    dashboard.get_by_label("Section", exact=True).select_option("Dome, cut by a fault")
    expect(names(dashboard)).to_have_value("dome's")
    is_painted(dashboard)
    assert line(dashboard) == drawn
    dashboard.get_by_text(BACK).wait_for()

    dashboard.get_by_role("button", name="Start over").click()
    expect(names(dashboard)).to_have_count(0)
    dashboard.get_by_role("button", name="Bring it back").click()
    expect(names(dashboard)).to_have_value("dome's")
    dashboard.get_by_role("button", name="Start over").click()
    dashboard.wait_for_function("!Object.values(sessionStorage).some((kept) => kept.includes(`dome's`))")
    dashboard.reload()
    dashboard.get_by_text("Unfault it, then flatten it").wait_for()
    is_painted(dashboard)
    expect(names(dashboard)).to_have_count(0)


def test_each_tab_keeps_its_own_and_a_new_one_gets_the_last(open_dashboard):
    one = open_dashboard()
    draw_fault(one, [(0.46, 0.1), (0.62, 0.9)])
    rename(one, "first tab")
    other = open_dashboard()
    expect(names(other)).to_have_value("first tab")
    rename(other, "second tab")
    one.bring_to_front()
    one.reload()
    expect(names(one)).to_have_value("first tab")
    expect(names(open_dashboard())).to_have_value("second tab")


@pytest.mark.parametrize(
    ("forbid", "reason"), [(FULL, "no room is left"), (FORBIDDEN, "it does not let this page store anything")]
)
def test_a_browser_that_keeps_nothing_is_said(open_dashboard, forbid, reason):
    page = open_dashboard(forbid)
    draw_fault(page, [(0.46, 0.1), (0.62, 0.9)])
    page.get_by_text(f"Your browser cannot keep your drawing ({reason})").wait_for()
    expect(names(page)).to_have_value("F1")
