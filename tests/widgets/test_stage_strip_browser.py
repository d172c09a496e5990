"""The strip of thumbnails under the time slider, in the app."""

from playwright.sync_api import expect

from tests.widgets.appscreen import RESTORED

PIXELS = "(all) => new Set(all.map((canvas) => canvas.toDataURL())).size"


def test_a_thumbnail_goes_to_its_moment_by_mouse_and_keyboard(open_app):
    app = open_app(RESTORED)
    app.until("len(app.restoration.stages) == 2")
    strip = app.page.get_by_role("toolbar", name="Stages")
    buttons = strip.get_by_role("button")
    expect(buttons).to_have_text(["present day", "unfaulting F1", "flattening H1"])
    expect(buttons.nth(2)).to_have_attribute("aria-pressed", "true")
    app.page.wait_for_function("document.querySelectorAll('.seiswidgets-strip canvas')[2]?.width === 216")
    assert strip.locator("canvas").evaluate_all(PIXELS) == 3
    buttons.nth(1).click()
    app.until("app.timeline.time == 1")
    expect(buttons.nth(1)).to_have_attribute("aria-pressed", "true")
    app.page.keyboard.press("ArrowLeft")
    app.page.keyboard.press("Enter")
    app.until("app.timeline.time == 0")
    app.ask("app.timeline.set_trait('time', 2)")
    expect(buttons.nth(2)).to_have_attribute("aria-pressed", "true")
    app.ask("setattr(app, 'steps', app.steps[:1])")
    expect(strip).to_be_hidden()
