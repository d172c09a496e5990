"""Nothing serious is found by axe-core: in the app on any of its tabs, in a report, in the documentation."""

import os

import pytest
from playwright.sync_api import expect

import seiswidgets as sw
from tests.widgets.axe import serious
from tests.widgets.browser import ROOT
from tests.widgets.byhand import is_painted, is_restored

CELL = """
import seiswidgets as sw
gallery = sw.Gallery(with_picks=True)
gallery
"""
TABS = ("Picks", "Weights", "Steps", "Solver", "Display", "Report")
APP = ".jp-OutputArea-output > .widget-vbox"
PAGES = ROOT / "docs" / "_build" / "html"
KINDS = (
    "docs/index",
    "docs/gallery",
    "docs/formats",
    "docs/api/widgets",
    "notebooks/01_restore_a_section",
    "CONTRIBUTING",
)


def test_axe_finds_nothing_serious_in_the_app(notebook):
    opened = notebook(CELL, height=1200)
    is_painted(opened.page)
    is_restored(opened.page)
    for dark in (False, True):
        opened.darken(dark)
        for tab in TABS:
            opened.page.get_by_role("tab", name=tab, exact=True).click()
            opened.page.get_by_role("tabpanel").first.wait_for()
            assert serious(opened.page, APP) == [], (tab, dark)
        opened.page.get_by_role("tab", name="File", exact=True).click()
        opened.page.get_by_placeholder("section: path of").wait_for()  # it is made when it is looked at
        assert serious(opened.page, APP) == [], ("File", dark)


def test_controls_are_found_by_the_names_that_are_seen_beside_them(notebook):
    opened = notebook(CELL, height=1200)
    is_restored(opened.page)
    opened.page.get_by_role("button", name="Play", exact=True).click()
    opened.page.get_by_role("button", name="Pause", exact=True).click()
    opened.page.get_by_role("slider", name="Time").wait_for()
    opened.page.get_by_role("tab", name="Weights").click()
    opened.page.get_by_role("slider", name="stitch").wait_for()
    opened.page.get_by_role("tab", name="Picks").click()
    fault = opened.page.get_by_role("textbox", name="name of this fault")
    expect(fault).to_have_value("F1")
    opened.ask("setattr(gallery, 'choice', 'graben')")
    opened.page.get_by_text("Two faults, and between them").wait_for()
    expect(fault).to_have_count(2)


@pytest.fixture
def page(chromium):
    context = chromium.new_context()
    yield context.new_page()
    context.close()


def serious_in_no_scheme(page):
    for scheme in ("light", "dark"):
        page.emulate_media(color_scheme=scheme)
        assert serious(page) == [], f"{page.url}, {scheme}"


def test_axe_finds_nothing_serious_in_a_report(page, tmp_path):
    case = sw.synthetic.faulted_fold()
    picks = case.interpretation
    unfaulted = sw.Restoration(case.section).unfault(picks.faults, picks.horizons, fixed=case.fixed)
    path = tmp_path / "report.html"
    sw.save_report(unfaulted.flatten(picks.horizon("H2")), path)
    page.goto(path.as_uri())
    assert page.get_by_role("table").count() > 1
    serious_in_no_scheme(page)


def test_axe_finds_nothing_serious_in_the_documentation(page):
    if not PAGES.exists():
        missing = "the documentation has not been made: make docs"
        pytest.fail(missing) if os.environ.get("CI") else pytest.skip(missing)
    for kind in KINDS:
        page.goto((PAGES / f"{kind}.html").as_uri())
        serious_in_no_scheme(page)
