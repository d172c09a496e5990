"""The gallery in JupyterLab, where the kernel outlives the page, and a cell may be run again."""

import pytest

CELLS = "import seiswidgets as sw\ngallery = sw.Gallery(choice='faulted_fold')\n", "gallery\n"
DRAW = "setattr(gallery.app, 'interpretation', sw.Interpretation([sw.Fault([[900, 100], [1500, 1500]], 'mine')]))"
NAMES = "[fault.name for fault in gallery.app.interpretation.faults]"
FORGET = "() => { sessionStorage.clear(); localStorage.clear(); }"


@pytest.fixture
def shown(notebook):
    """A notebook that shows a gallery; what the browser keeps is gone at the end."""
    opened = notebook(*CELLS)
    opened.page.locator(".seiswidgets-layer").first.wait_for()
    yield opened
    opened.page.evaluate(FORGET)


def test_a_cell_that_is_run_again_shows_what_was_drawn(shown):
    shown.ask(DRAW)
    shown.page.wait_for_function("Object.values(sessionStorage).some((text) => text.includes(`mine`))")
    shown.run()
    shown.becomes(NAMES, ["mine"])
    shown.page.get_by_text("Your drawing on this section is back").wait_for()
    # The page may still be building the view of the app that the kernel has replaced meanwhile.
    shown.errors[:] = [error for error in shown.errors if error != "widget model not found"]


def test_a_page_that_is_loaded_again_shows_the_kernels_work(shown):
    shown.ask(DRAW)
    shown.command("docmanager:save")
    shown.reload()
    shown.page.locator(".seiswidgets-layer .name").first.wait_for()
    assert shown.ask(NAMES) == ["mine"]
    assert shown.ask("gallery.notice.text") == ""


def test_choices_leave_no_more_widgets_on_the_page_than_there_were(shown):
    models = "len(__import__('ipywidgets').widgets.widget._instances)"
    shown.page.get_by_label("Section", exact=True).select_option("Graben")
    shown.becomes("gallery.choice", "graben")
    shown.page.get_by_text("Two faults, and between them").wait_for()
    count = shown.ask(models)
    for title, name in (("Folds", "sine_fold"), ("Graben", "graben")):
        shown.page.get_by_label("Section", exact=True).select_option(title)
        shown.becomes("gallery.choice", name)
    shown.page.get_by_text("Two faults, and between them").wait_for()
    shown.becomes(models, count)
