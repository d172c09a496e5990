"""Files, sessions and what goes wrong, in a JupyterLab driven by mouse and keyboard."""

import os
import secrets
import signal
import time

import numpy as np
import pytest
from playwright.sync_api import expect

import seiswidgets as sw
from tests.widgets.browser import READY, keep_picture
from tests.widgets.byhand import is_painted
from tests.widgets.files import line

APP = """
import os, time, seiswidgets as sw
case = sw.synthetic.faulted_fold()
app = sw.RestorationApp(case.section, session="{0}.json", source=sw.SectionSource("synthetic", "faulted_fold"),
    live=False, height=300)
app
"""
EXPORTED = """
app.interpretation, app.fixed, app.live = case.interpretation, case.fixed, True
app.files.results.folder.value = "{0}-results"
from threading import Event
job, pause = app.files.results.job, Event()
report = job.report
def wait_for_cancel(own, fraction):
    while fraction > 0.5 and own.wanted:
        pause.wait(0.05)
    return report(own, fraction)
job.report = wait_for_cancel
"""
NAMES = "[pick.name for pick in app.picker.drawing.picks]"
PICKS = "[[pick.name, pick.colour, pick.pieces] for pick in app.picker.drawing.picks]"
SAVED = """[len(version.session.faults) for version in
    __import__("seiswidgets.io.session.autosave").io.session.autosave.find_versions("{0}.json")][:1]"""
DISK = """exec('''
from seiswidgets.io import files
class Full:
    def __getattr__(self, name):
        return getattr(os, name)
    def replace(self, *names):
        raise OSError(28, "No space left on device")
files.os = Full() if {0} else os
''')"""
OFFLINE = 10  # seconds
DROP = "() => window.jupyterapp.shell.currentWidget.sessionContext.session.kernel._ws.close()"


@pytest.fixture
def name():
    return f"work-{secrets.token_hex(3)}"


@pytest.fixture
def app(notebook, name):
    opened = notebook(APP.format(name))
    is_painted(opened.page)
    return opened


def at(opened, x, y):
    """A place of the page, from shares of the first pane's width and height."""
    box = opened.page.locator("canvas.seiswidgets-plot").first.bounding_box()
    return box["x"] + x * box["width"], box["y"] + y * box["height"]


def draw_fault(opened, x):
    """A fault of two vertices, by mouse."""
    opened.page.get_by_role("button", name="Fault", exact=True).click()
    opened.page.mouse.click(*at(opened, x, 0.2))
    opened.page.mouse.dblclick(*at(opened, x + 0.05, 0.8))


def show(opened, tab):
    opened.page.get_by_role("tab", name=tab, exact=True).click()


def shoot(opened, called):
    keep_picture(opened.page, called)


def test_a_kernel_killed_in_mid_drag_loses_no_finished_edit(app, name):
    draw_fault(app, 0.3)
    draw_fault(app, 0.6)
    app.becomes(NAMES, ["F1", "F2"])
    app.becomes(SAVED.format(name), [2])
    before, process = app.ask(PICKS), app.ask("os.getpid()")
    app.page.mouse.move(*at(app, 0.3, 0.2))
    app.page.mouse.down()
    app.page.mouse.move(*at(app, 0.4, 0.3), steps=4)
    app.until("app.picker.dragging")
    os.kill(process, signal.SIGKILL)
    app.page.mouse.up()
    dialog = app.page.locator(".jp-Dialog")
    dialog.get_by_role("button").last.click()
    app.page.wait_for_function(READY)
    app.run()
    is_painted(app.page)
    assert app.ask("os.getpid()") != process
    assert app.ask(NAMES) == []
    app.page.get_by_text("holds earlier work").wait_for()
    shoot(app, "session-offered")
    app.page.get_by_role("button", name="Open", exact=True).click()
    app.becomes(NAMES, ["F1", "F2"])
    assert app.ask(PICKS) == before
    assert set(app.errors) <= {"Cannot send"}  # which JupyterLab throws at whoever talks to a dead kernel
    app.errors.clear()
    app.close()


def test_a_tab_that_is_closed_and_opened_again_goes_on(app, name):
    draw_fault(app, 0.3)
    app.becomes(NAMES, ["F1"])
    app.command("docmanager:save")
    app.page.close()
    app.visit(app.address)
    app.page.wait_for_function(READY)
    is_painted(app.page)
    assert app.ask(NAMES) == ["F1"]
    draw_fault(app, 0.6)
    app.becomes(NAMES, ["F1", "F2"])
    app.becomes(SAVED.format(name), [2])


def test_a_full_disk_is_said_and_the_picks_are_saved_when_there_is_room(app, name):
    app.ask(DISK.format(True))
    place = at(app, 0, 0)
    draw_fault(app, 0.3)
    alert = app.page.get_by_role("alert").filter(has_text="No space left on device")
    alert.wait_for()
    assert at(app, 0, 0) == place  # or the next click would miss
    shoot(app, "disk-full")
    assert app.ask(NAMES) == ["F1"]
    draw_fault(app, 0.6)
    app.becomes(NAMES, ["F1", "F2"])
    assert app.ask(SAVED.format(name)) == []
    assert app.ask("app.solving.spacing") is None  # though the page has rounded the slider's value
    app.ask(DISK.format(False))
    alert.wait_for(state="hidden")
    app.becomes(SAVED.format(name), [2])


def test_a_connection_that_drops_for_ten_seconds_loses_nothing(app, name):
    draw_fault(app, 0.3)
    app.becomes(NAMES, ["F1"])
    app.page.add_locator_handler(  # JupyterLab says that the server is gone
        app.page.locator(".jp-Dialog"), lambda dialog: dialog.get_by_role("button").last.click()
    )
    app.context.set_offline(True)
    app.page.evaluate(DROP)
    for x in (0.5, 0.6):  # which may be lost: the page does not know yet that nobody listens
        app.page.mouse.click(*at(app, x, 0.5))
        app.page.mouse.wheel(0, -300)
    time.sleep(OFFLINE)  # the drop itself
    app.context.set_offline(False)
    app.page.wait_for_function(READY)
    assert app.ask(NAMES) == ["F1"]
    app.page.get_by_role("button", name="Look", exact=True).click()  # ends what came only in part
    app.until("app.picker.editor.drawing.draft is None")
    count = len(app.ask(NAMES)) + 1
    draw_fault(app, 0.8)
    app.becomes(f"len({NAMES})", count)
    app.becomes(SAVED.format(name), [count])
    window = app.ask("app.panes.original.view.window")
    app.page.mouse.wheel(0, -300)
    app.until(f"list(app.panes.original.view.window) != {window}")
    assert all("WebSocket" in error or "ERR_" in error for error in app.errors), app.errors
    app.errors.clear()
    app.close()  # whatever JupyterLab still has to say of it is not for another test


def test_results_go_out_and_sections_come_in_by_mouse(notebook, name, lab, tmp_path):
    app = notebook(APP.format(name), EXPORTED.format(name), height=1500)
    is_painted(app.page)
    show(app, "File")
    app.becomes("len(app.restoration.stages)", 2)
    export_and_cancel(app)
    assert sorted(path.name for path in (lab.folder / f"{name}-results").iterdir()) == [
        "faulted fold-figure.png",
        "faulted fold-restored.npz",
    ]
    path = line(lab.folder / f"{name}.sgy", text="C01 <img src=x onerror=alert(1)>".ljust(3200))
    open_by_path(app, path.name)
    app.page.get_by_role("button", name="Drop the picks").click()
    app.becomes("[app.section.name, app.section.shape]", [name, [40, 30]])
    is_painted(app.page)
    expected = sw.open_section(path, velocity=2000.0).amplitude
    np.testing.assert_allclose(app.ask("app.section.amplitude[:3].tolist()"), expected[:3], rtol=1e-6)
    sent = line(tmp_path / "sent.sgy", count=500, samples=6000)
    assert sent.stat().st_size > 11 * 2**20  # a server closes the connection on a message above 10
    with app.page.expect_file_chooser() as chooser:
        app.page.get_by_role("button", name="Upload").first.click()
    chooser.value.set_files(sent)
    app.page.get_by_text("500 traces of 6,000 samples").wait_for()
    app.page.get_by_role("button", name="Open section").click()
    app.becomes("[app.section.name, app.section.shape]", ["sent", [6000, 500]])
    shoot(app, "file-opened")
    app.becomes("app.close()", None)  # deletes the upload, before the kernel is ended


def export_and_cancel(app):
    """Begin an export, ask the kernel something meanwhile, and give it up after the second of three files."""
    app.page.get_by_role("button", name="Export results").click()
    app.page.get_by_text("Writing faulted fold-figure.png ...").wait_for()
    assert app.ask("job.busy")  # the last of the files waits for Cancel
    shoot(app, "exporting")
    app.page.get_by_role("button", name="Cancel").last.click()
    app.page.get_by_text("The export was cancelled. Wrote into").wait_for()


def open_by_path(app, path):
    """Open a SEG-Y file, after a look at other header bytes."""
    field = app.page.get_by_placeholder("section: path of")
    field.fill(path)
    field.press("Enter")
    app.page.get_by_text("30 traces of 40 samples").wait_for()
    expect(app.page.locator(f'datalist option[value="{path}"]')).not_to_have_count(0)
    app.page.get_by_text("textual header").click()
    app.page.get_by_text("C01 <img src=x").wait_for()
    other = app.page.get_by_label("other header bytes than the standard's")
    other.check()
    app.page.get_by_label("x", exact=True).fill("73")
    app.page.keyboard.press("Tab")
    app.page.get_by_text("has no trace positions: bytes 73 and 185").wait_for()
    shoot(app, "file-panel")
    other.uncheck()
    app.page.get_by_text("has no trace positions").wait_for(state="hidden")
    app.page.get_by_role("button", name="Open section").click()
