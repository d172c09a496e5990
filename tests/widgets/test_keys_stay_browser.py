"""Keys pressed in a widget: the notebook around it takes none of them, and they keep their meaning inside."""

from dataclasses import fields

import pytest
from playwright.sync_api import expect

import seiswidgets as sw
from tests.widgets.appscreen import EMPTY, FEW, RESTORED, SHOWN
from tests.widgets.browser import settled
from tests.widgets.byhand import is_painted
from tests.widgets.test_app_elsewhere_browser import run_first_cell

GALLERY = """
import ipywidgets, numpy as np
import seiswidgets as sw
sw.Gallery(with_picks=True)
"""
PARTS = """
case = sw.synthetic.faulted_fold()
histogram = sw.DeformationHistogram(np.geomspace(0.5, 2, 100))
panes = sw.SectionPane(case.section, height=200), sw.LinkedPanes(case.section, height=200)
lists = sw.Picker(case.section, interpretation=case.interpretation), sw.StepList(), sw.WeightSliders()
ipywidgets.VBox([*panes, *lists, histogram, sw.Timeline(["unfault"])])
"""
TABS = ("Picks", "Weights", "Steps", "Solver", "Display", "Report", "File")
# They cut, delete, merge, change, add, show and run cells, interrupt and restart the kernel, save, and open a side bar.
KEYS = [*"xddmryaboclvz1ii00", "Shift+L", "Shift+M", "Shift+V", "Escape"]
KEYS += ["Shift+Enter", "Control+Enter", "Alt+Enter", "Control+b", "Control+s"]
OF_BROWSER = ("Control+r", "F5", "F12", "Control+c", "Control+v", "Control+t", "Tab", "Shift+Tab")

# Note what gets out of the widgets: shortcuts that were executed, and keys that the document sees after them.
LISTEN = """() => {
  window.escaped = [];
  window.listening = new AbortController();
  const { signal } = listening;
  document.addEventListener("keydown", (event) => escaped.push(event.key), { signal });
  jupyterapp.commands.commandExecuted.connect((_, { id, args }) => {
    if (args?._luminoEvent?.type === "keybinding") escaped.push(id);
  });
  const block = (event) => {
    if (!window.isWalking) return; // else the keys would press the buttons too, and change the widgets on the way
    event.preventDefault();
    event.stopImmediatePropagation();
  };
  for (const type of ["click", "input", "change"]) window.addEventListener(type, block, { capture: true, signal });
}"""
CELLS = """() => {
  const { widgets, activeCellIndex, mode } = jupyterapp.shell.currentWidget.content;
  return [mode, ...widgets.map(({ model }) => [model.id, model.type, model.executionCount])];
}"""
# What takes the focus now and did not before, in any output; a tab only while it is open, as Enter would open another.
FOUND = """() => {
  window.known ??= new Set();
  window.found = [...document.querySelectorAll(".jp-OutputArea-output *")].filter((one) => {
    const canTakeFocus = one.tabIndex >= 0 || one.hasAttribute("tabindex");
    if (known.has(one) || !canTakeFocus || one.matches("[aria-selected=false]")) return false;
    one.focus();
    return document.activeElement === one;
  });
  found.forEach((one) => known.add(one));
  return found.length;
}"""
FOCUS = """(number) => {
  found[number].focus();
  const { tagName, title, className, ariaLabel } = document.activeElement;
  return `${tagName} ${title || ariaLabel || className}`;
}"""
HELD = "(number) => [escaped, document.activeElement === found[number]]"
KEPT = "document.activeElement.closest('.seiswidgets-app') !== null"


def walk(page):
    """Press all keys in everything that takes the focus and was not met before; give back how many that are."""
    page.evaluate("window.isWalking = true")
    count = page.evaluate(FOUND)
    for number in range(count):
        name = page.evaluate(FOCUS, number)
        for key in KEYS:
            page.keyboard.press(key)
        assert page.evaluate(HELD, number) == [[], True], name
    page.evaluate("window.isWalking = false")
    return count


def open_tab(page, name):
    """Open a tab of the app, and wait for the whole of its page, which is made when it is first looked at."""
    page.get_by_role("tab", name=name, exact=True).click()
    shown = page.locator(".seiswidgets-pages > .widget-tab-contents > *").locator("visible=true")
    shown.locator("*").nth(3).wait_for(state="attached")
    settled(shown.locator("*").count)


def test_no_key_in_any_focusable_part_reaches_the_notebook(notebook):
    page = notebook("a = 1", GALLERY, PARTS, "b = 2", height=1200).page
    page.locator(".widget-label").get_by_text("restored", exact=True).first.wait_for()
    expect(page.locator(".noUi-handle")).to_have_count(2 + len(fields(sw.Weights)))  # of two timelines and the weights
    page.evaluate("document.activeElement.blur()")
    page.evaluate(LISTEN)
    before, met = page.evaluate(CELLS), {}
    for tab in TABS:
        open_tab(page, tab)
        met[tab] = walk(page)
    page.evaluate("listening.abort()")
    assert page.evaluate(CELLS) == before
    assert met["Picks"] > 60  # the toolbar, panes, histogram and timeline, and the parts alone
    assert min(met[tab] for tab in TABS if tab != "Report") > 3
    assert met["File"] > 20


def test_a_part_that_goes_or_takes_no_focus_leaves_no_key_to_the_notebook(open_app):
    screen = open_app(FEW, more=["b = 2"])
    page, before = screen.page, screen.page.evaluate(CELLS)
    screen.button("delete this fault").focus()
    screen.press("Enter")
    screen.becomes("len(app.interpretation.faults)", 0)
    page.wait_for_function(KEPT)
    screen.press("x", "d", "d", "m")
    undo = screen.button("Undo")
    undo.focus()
    screen.press("Enter", "Enter")
    expect(undo).to_be_disabled()
    page.wait_for_function(KEPT)
    screen.press("x", "d", "d", "m")
    for place in (page.get_by_text("Present day", exact=True), undo):  # a click on neither moves the focus to it
        place.click(force=True)
        screen.press("x", "d", "d", "m")
        assert page.evaluate(KEPT)
    assert page.evaluate(CELLS) == before


def test_keys_keep_their_meaning_in_the_app(open_app):
    screen = open_app(FEW)
    page = screen.page
    screen.button("Fault").focus()
    screen.press("Enter")
    screen.becomes("app.picker.mode", "fault")
    screen.button("Look").focus()
    screen.press(" ")
    screen.becomes("app.picker.mode", "look")
    page.get_by_title("vertices of horizons snap to").locator("visible=true").last.focus()
    screen.press("ArrowDown")
    screen.becomes("app.picker.snap", "peak")
    name = page.get_by_title("name of this fault")
    name.focus()
    screen.press("Control+a", *"x dd", "Enter")
    screen.becomes("app.interpretation.faults[0].name", "x dd")
    screen.press("y", "Control+z")  # what is half typed is the field's own to undo
    expect(name).to_have_value("x dd")
    screen.press("Control+z")
    screen.becomes("app.interpretation.faults[0].name", "F1")
    for part in (screen.plots.first, screen.button("Fault")):
        part.focus()
        screen.press("Control+y")
        screen.becomes("app.interpretation.faults[0].name", "x dd")
        screen.press("Control+z")
        screen.becomes("app.interpretation.faults[0].name", "F1")
    screen.tab("Weights")
    page.get_by_role("slider", name="stitch").focus()
    weight = screen.ask("app.weights.stitch")
    screen.press("ArrowRight")
    screen.until(f"app.weights.stitch > {weight}")
    assert page.locator(".seiswidgets-app [title=null]").count() == 0


def test_the_browser_keeps_its_own_keys(open_app):
    screen = open_app(FEW)
    page = screen.page
    page.evaluate("""() => {
      window.last = null;
      window.addEventListener("keydown", (event) => { window.last = event; }, true);
      document.addEventListener("copy", () => { window.hasCopied = true; });
    }""")
    for part in (screen.plots.first, screen.button("Fault"), page.get_by_title("name of this fault")):
        for key in OF_BROWSER:
            part.focus()
            screen.press(key)
            assert not page.evaluate("last.defaultPrevented"), key
    page.get_by_title("name of this fault").select_text()
    screen.press("Control+c")
    assert page.evaluate("hasCopied")


@pytest.mark.parametrize("key", ["Tab", "Shift+Tab"])
def test_tab_leaves_the_app(open_app, key):
    screen = open_app(RESTORED)
    screen.plots.first.focus()
    for _ in range(60):
        screen.press(key)
        if not screen.page.evaluate(KEPT):
            return
    pytest.fail(f"{key} does not lead out of the app")


def test_no_key_in_the_app_reaches_notebook_7(elsewhere):
    page = elsewhere(EMPTY + SHOWN, "notebooks").page
    page.locator(".jp-Notebook-ExecutionIndicator[data-status=idle]").wait_for(state="attached")
    run_first_cell(page)
    is_painted(page)
    prompt = page.locator(".jp-CodeCell .jp-InputPrompt").first.inner_text()
    for part in (".seiswidgets-layer .plot", "button[data-value=Fault]", "[role=tab]", ".widget-dropdown select"):
        page.locator(part).locator("visible=true").first.focus()
        for key in ("x", "d", "d", "m", "b", "Shift+M", "Escape"):
            page.keyboard.press(key)
    assert page.locator(".jp-Cell").count() == page.locator(".jp-CodeCell").count() == 2
    assert page.locator(".seiswidgets-app").is_visible()
    assert page.locator(".jp-CodeCell .jp-InputPrompt").first.inner_text() == prompt


# VS Code's page of an output: it forwards keys to the notebook, and keeps some from the browser.
VS_CODE = """() => {
  window.forwarded = [];
  const { signal } = (window.listening = new AbortController());
  for (const type of ["keydown", "keyup"])
    window.addEventListener(type, (event) => {
      if (event.ctrlKey && ["z", "y", "f", "s", "p"].includes(event.key)) event.preventDefault();
      forwarded.push(event.key);
    }, { signal });
}"""
VS_CODE_KEYS = [*"ddabxmyjk", "ArrowUp", "ArrowDown", "Enter", "Escape", "Delete", "Shift+Enter", "Control+z"]


def test_vs_code_forwards_no_key_from_the_app(open_app):
    screen = open_app(FEW)
    page = screen.page
    page.evaluate(VS_CODE)
    parts = (".plot", "button[data-value=Fault]", "[role=tab]", "select", "input[type=number]", "[role=slider]")
    for part in (*parts, "[role=separator]", ".seiswidgets-maximise button"):
        target = page.locator(f".seiswidgets-app {part}").locator("visible=true").first
        for key in VS_CODE_KEYS:
            target.focus()
            screen.press(key)
        assert page.evaluate("forwarded") == [], part
    page.evaluate("document.activeElement.blur()")
    screen.press("F8")
    assert page.evaluate("forwarded") == ["F8", "F8"]
    page.evaluate("listening.abort()")
