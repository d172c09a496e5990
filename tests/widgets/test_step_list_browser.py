from tests.widgets.browser import keep_picture

CELL = """
import seiswidgets as sw
name = "<img src=x onerror=alert(1)>"
picks = sw.Interpretation([sw.Fault([[1, 0], [1, 9]], name)], [sw.Horizon([[0, 1], [9, 1]], name="H1")])
steps = sw.StepList([sw.Step("unfault", [name]), sw.Step("flatten"), sw.Step("flatten", ["H1"], 5)])
steps.interpretation = picks
steps.layout.width = "320px"
steps
"""
FOCUSED = "(tip) => [...document.querySelectorAll(`button[title='${tip}']`)].indexOf(document.activeElement)"
EARLIER, LATER = "Do this step earlier", "Do this step later"


def test_steps_by_keyboard_in_a_narrow_place(notebook):
    opened = notebook(CELL)
    names_are_text_and_all_fits(opened)
    press = opened.page.keyboard.press
    opened.page.get_by_title(EARLIER).nth(2).focus()
    press("Enter")
    opened.until("[step.datum for step in steps.steps] == [None, 5, None]")
    opened.page.wait_for_function(f"({FOCUSED})('{EARLIER}') === 1")
    press("Enter")
    opened.until("[step.datum for step in steps.steps] == [5, None, None]")
    opened.page.wait_for_function(f"({FOCUSED})('{LATER}') === 0")


def test_typing_a_datum(notebook):
    opened = notebook(CELL)
    datum = opened.page.get_by_placeholder("mean level").nth(2)
    datum.fill("abc")
    datum.press("Enter")
    opened.page.get_by_role("alert").get_by_text("5 m is kept").wait_for()
    datum.fill("7")
    opened.ask("steps.set_trait('interpretation', sw.Interpretation(picks.faults))")
    opened.page.get_by_text("missing: H1").wait_for(state="attached")
    assert datum.evaluate("field => field === document.activeElement && field.value === '7'")
    datum.press("Enter")
    opened.until("steps.steps[2].datum == 7")
    opened.page.get_by_role("alert").wait_for(state="detached")


def names_are_text_and_all_fits(opened):
    choice = opened.page.locator(".widget-dropdown select").first
    choice.wait_for()
    assert choice.evaluate("(one) => one.selectedOptions[0].textContent").startswith("<img")
    assert opened.page.locator("option img").count() == 0
    steps = opened.page.locator(".widget-vbox").first
    keep_picture(steps, "step-list-narrow")
    right = "(all) => Math.max(...all.map((one) => one.getBoundingClientRect().right))"
    left = steps.bounding_box()["x"]
    assert steps.locator("select, input, button").evaluate_all(right) <= left + 321
