"""The exercises' form in a browser: answered by keyboard and mouse, read out by its labels."""

import pytest

from tests.test_notebooks import NOTEBOOKS
from tests.widgets.browser import keep_picture

CELL = f"""
import sys
sys.path.insert(0, {str(NOTEBOOKS[0].parent)!r})
from exercises import ask
from exercises import fault_restoration, flattening
from ipywidgets import VBox
VBox([ask(fault_restoration.heave_of(150, 60)), ask(flattening.what_the_datum_does({{0: 0.0, 100: 0.0}}))])
"""


@pytest.mark.parametrize("dark", [False, True], ids=["light", "dark"])
def test_answers_are_given_and_checked(notebook, dark):
    page = notebook(CELL, dark=dark).page
    page.get_by_text("What does another datum change?").wait_for()
    number, choice = page.get_by_role("button", name="Check", exact=True).all()
    page.get_by_label("Answer (m)").fill("150")
    number.click()
    page.get_by_role("status").filter(has_text="It would be, at a dip of 45°.").wait_for()
    page.get_by_label("only how high everything lies").check()
    choice.click()
    page.get_by_role("status").filter(has_text="moves up or down as one").wait_for()
    keep_picture(page, f"exercises{'_dark' * dark}")
    page.get_by_label("Answer (m)").fill("87 m")
    number.click()
    page.get_by_role("status").filter(has_text="Right.").nth(1).wait_for()
