"""The app in its main states, in both themes and on narrow and wide windows: a screenshot of each, to be looked at."""

from tests.widgets.appscreen import SHOWN, AppScreen
from tests.widgets.test_histogram_browser import bar
from tests.widgets.test_layout_browser import FILLING

SIZES = {1000: 800, 1366: 768, 1900: 1000}
OUT = """() => [...document.querySelectorAll(".jp-OutputArea-output button, .jp-OutputArea-output .seiswidgets-layer")]
  .filter((one) => one.offsetParent !== null && one.getBoundingClientRect().right > window.innerWidth)
  .map((one) => one.textContent)"""


def look(screen, state):
    """Every look of a state: nothing is cut off by the window, and every pane is painted for the room it has."""
    for dark in (False, True):
        screen.opened.darken(dark)
        for width, height in SIZES.items():
            screen.page.set_viewport_size({"width": width, "height": height})
            one, other = screen.pictures(lambda pictures: all(is_filled(screen, pictures)))
            assert one[:2] == other[:2]
            assert screen.page.evaluate(OUT) == []
            screen.shoot(f"app-{state}-{'dark' if dark else 'light'}-{width}")


def is_filled(screen, pictures):
    """True if each canvas has as many pixels as its plot area."""
    for (width, height, *_), box in zip(
        pictures, (screen.plots.nth(number).bounding_box() for number in (0, 1)), strict=True
    ):
        yield abs(width - box["width"]) <= 1 and abs(height - box["height"]) <= 1


def test_every_state_in_every_look(notebook):
    screen = AppScreen(notebook(FILLING + SHOWN, width=1366, height=768))
    look(screen, "empty")
    screen.button("Fault").click()
    screen.click(*screen.points("drawn.faults[0].points[:24:6]"))
    screen.page.mouse.move(*screen.pixels([(2700, 1500)])[0])
    look(screen, "picking")
    screen.press("Escape")
    screen.ask("[app.set_trait('interpretation', drawn), app.set_trait('fixed', case.fixed)] and None")
    screen.until("len(app.restoration.stages) == 2 and app.wait(30)")
    look(screen, "restored")
    screen.button("Horizon").click()
    (mark,) = screen.points("[mark.inside for mark in editor.cutoffs()][:1]")
    screen.drag(mark, mark + [60, 120], drop=False)
    screen.until("app.picker.dragging and app.panes.shown.is_preview")
    screen.shoot("app-dragging")
    screen.press("Escape")
    screen.page.mouse.up()
    screen.press("Escape", "Escape")
    screen.until("app.wait(30) and not app.panes.shown.is_preview")
    screen.page.mouse.move(*bar(screen.opened, 25))
    screen.page.mouse.down()
    screen.page.mouse.move(*bar(screen.opened, 40), steps=5)
    screen.page.mouse.up()
    screen.until("app.panes.brush")
    look(screen, "brushed")
    screen.ask("app.histogram.set_trait('brush', [])")
    screen.ask("app.timeline.set_trait('time', 1.4)")
    look(screen, "timeline")
    for name in ("Weights", "Steps", "Solver", "Display", "Report"):
        screen.tab(name)
        screen.shoot(f"app-tab-{name.lower()}")
    screen.tab("Picks")
    far = "sw.Interpretation([*drawn.faults, sw.Fault([(100.0, 100.0), (150.0, 500.0)], 'far')], drawn.horizons)"
    screen.ask(f"app.set_trait('interpretation', {far})")
    screen.button("Restore").click()
    for role in ("status", "note"):  # above the panes, and beside the pick
        screen.page.get_by_role(role).get_by_text("far").first.wait_for()
    look(screen, "finding")
