"""Hypotheses and uncertainty in a notebook: the table by mouse and keyboard, and processes started by a kernel."""

from tests.widgets.appscreen import EMPTY, RESTORED, SHOWN, AppScreen

COARSE = "app.workspace.change_plan('mesh', spacing=300.0)\n"
SORT = "button[aria-label='sort by correlation F1']"


def test_hypotheses_are_compared_and_members_are_computed(notebook):
    opened = notebook(EMPTY + COARSE + RESTORED + SHOWN)
    screen, page = AppScreen(opened), opened.page
    screen.tab("Hypotheses")
    screen.button("Duplicate").click()
    opened.until("[one.name for one in app.hypotheses] == ['A', 'B']")
    page.locator("button[title^='Restore all']").click()
    heading = page.locator(SORT)
    heading.wait_for()
    heading.focus()
    page.keyboard.press("Enter")
    page.wait_for_selector("th[aria-sort='ascending']")
    assert heading.evaluate("(one) => one === document.activeElement")  # drawing the table again leaves the focus
    page.keyboard.press("n")
    page.wait_for_selector("tr.chosen button[aria-label='show A']")
    page.locator("button[aria-label='show B']").click()
    opened.until("app.workspace.document.name == 'B'")
    screen.tab("Uncertainty")
    opened.ask("app.uncertainty_panel.members.set_trait('value', 3)")
    page.locator("button[title^='Restore with errors']").click()
    opened.until("app.uncertainty_panel.ensemble is not None and len(app.uncertainty_panel.ensemble.members) == 3")
    page.get_by_label("map of the spread").check()
    page.wait_for_selector(".seiswidgets-layer image[href^='data:image/png']", state="attached")
