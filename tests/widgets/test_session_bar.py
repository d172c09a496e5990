import os
import re
import time
from functools import partial
from pathlib import Path

import numpy as np
import pytest

import seiswidgets as sw
from seiswidgets.errors import DataError, SettingError
from seiswidgets.interaction.drawing import Drawing
from seiswidgets.io import files
from seiswidgets.io.session import ownership
from seiswidgets.io.session.autosave import find_versions, numbered_files
from seiswidgets.widgets.app import RestorationApp
from seiswidgets.widgets.files import session_bar
from tests.widgets.hands import appear, click, drag_to, draw, keys, press, release

LONG = 60
FAULT, OTHER = [(2000.0, 200.0), (2400.0, 1200.0)], [(3000.0, 200.0), (3300.0, 1200.0)]
SOURCE = sw.SectionSource("synthetic", "faulted_fold")


@pytest.fixture(scope="module")
def section():
    return sw.synthetic.faulted_fold().section


@pytest.fixture
def new_app(section):
    """A function that makes an app; at the end all are closed."""
    made = []

    def new(one=section, **settings):
        made.append(RestorationApp(one, **{"live": False, "source": SOURCE, **settings}))
        appear(made[-1].panes.original, made[-1].panes.restored)
        return made[-1]

    yield new
    for app in made:
        app.close()
        assert app.wait(LONG)


@pytest.fixture
def quick(monkeypatch):
    """Edits are saved, and saving is tried again, after no time worth waiting for."""
    monkeypatch.setattr(session_bar, "Autosave", partial(session_bar.Autosave, behind=0.01, again=0.01))


@pytest.fixture
def path(tmp_path):
    return tmp_path / "work.json"


@pytest.fixture
def full_disk(monkeypatch):
    """A list of beginnings of file names: files with these cannot be written, or none if one is empty."""
    full, replace = [], os.replace

    def replaced(one, other):
        if os.path.basename(other).startswith(tuple(full)):
            raise OSError(28, "No space left on device")
        replace(one, other)

    monkeypatch.setattr(files.os, "replace", replaced)
    return full


def wait_for(condition, seconds=20):
    end = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < end
        time.sleep(0.01)


def draw_fault(app, points=FAULT):
    app.picker.mode = "fault"
    app.picker.editor.deselect()
    draw(app.panes.original, *points)


def names(path):
    """Names of the picks in the newest version."""
    versions = find_versions(path)
    return [pick.name for pick in (*versions[0].session.faults, *versions[0].session.horizons)] if versions else []


def choose(app, answer):
    app.session_bar.notice.answers[answer].click()
    assert app.wait(LONG)


def test_without_a_path_nothing_is_written(new_app, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    app = new_app()
    draw_fault(app)
    app.close()
    assert app.session_path is None
    assert list(tmp_path.iterdir()) == []


def test_every_finished_edit_is_saved_a_moment_later(new_app, path):
    app = new_app(session=path)
    assert app.session_path == path
    assert not numbered_files(path)
    draw_fault(app)
    wait_for(lambda: names(path) == ["F1"])
    app.picker.editor.recolour("fault", "F1", "#123456")
    app.picker.editor.show("fault", "F1", False)
    app.picker.refresh()
    app.weights = sw.Weights(stitch=33.0)
    app.solving.spacing = 77.0
    app.steps = (sw.Step("unfault"),)
    app.fixed = (100.0, 100.0)
    app.close()
    session = find_versions(path)[0].session
    assert [(pick.colour, pick.visible) for pick in session.faults] == [("#123456", False)]
    plan = sw.Plan((sw.Step("unfault"),), sw.Weights(stitch=33.0), spacing=77.0, fixed=(100.0, 100.0))
    assert session.plan == app.plan == plan
    assert session.source == SOURCE


def test_a_point_held_is_work_too(new_app, path):
    app = new_app(session=path)
    app.picker.mode = "block"
    click(app.panes.original, (1000.0, 500.0))
    app.close()
    assert find_versions(path)[0].session.fixed == pytest.approx((1000.0, 500.0))
    again = new_app(session=path)
    assert ": 0 faults and 0 horizons, a point held (work.00000" in again.session_bar.versions.options[0][0]
    choose(again, "Open")
    assert again.fixed == app.fixed


def test_what_is_dragged_is_saved_when_it_is_let_go(new_app, path):
    app = new_app(session=path)
    draw_fault(app)
    pane = app.panes.original
    press(pane, FAULT[0])
    drag_to(pane, (2100.0, 300.0))
    app.session_bar.end()
    assert find_versions(path)[0].session.faults[0].pieces == (tuple(FAULT),)
    release(pane, (2100.0, 300.0))
    app.session_path = path
    choose(app, "Start anew")
    app.close()
    assert find_versions(path)[0].session.faults[0].pieces[0][0] == pytest.approx((2100.0, 300.0))


def test_lines_that_cannot_be_used_are_saved_too(new_app, path):
    app = new_app(session=path)
    draw_fault(app, [(1000.0, 200.0), (1400.0, 600.0), (1400.0, 200.0), (1000.0, 600.0)])
    assert not app.interpretation.faults[0].constrains
    app.close()
    assert names(path) == ["F1"]


def test_earlier_work_is_offered_and_opened(new_app, path, section):
    first = new_app(session=path)
    draw_fault(first)
    first.picker.editor.recolour("fault", "F1", "#123456")
    first.picker.refresh()
    first.weights = sw.Weights(stitch=33.0)
    first.close()
    before = {file: file.read_bytes() for file in path.parent.iterdir()}
    again = new_app(session=path)
    assert "holds earlier work" in again.session_bar.notice.text
    assert ": 1 fault and 0 horizons (work.00000" in again.session_bar.versions.options[0][0]
    draw_fault(again, OTHER)
    again.session_bar.end()
    assert {file: file.read_bytes() for file in path.parent.iterdir()} == before
    again.session_path = path
    choose(again, "Open")
    assert again.section is section
    assert again.picker.drawing == first.picker.drawing
    assert again.weights == sw.Weights(stitch=33.0)
    keys(again.panes.original, "z", modifiers=["ctrl"])  # what was drawn before the choice is not lost either
    np.testing.assert_allclose(again.interpretation.faults[0].points, OTHER)


@pytest.mark.usefixtures("quick")
def test_an_older_version_can_be_chosen(new_app, path):
    first = new_app(session=path)
    draw_fault(first)
    wait_for(lambda: names(path) == ["F1"])
    draw_fault(first, OTHER)
    first.close()
    assert names(path) == ["F1", "F2"]
    again = new_app(session=path)
    again.session_bar.versions.value = again.session_bar.versions.options[1][1]
    choose(again, "Open")
    assert [pick.name for pick in again.picker.drawing.picks] == ["F1"]


@pytest.mark.usefixtures("quick")
def test_who_starts_anew_keeps_the_earlier_work_aside(new_app, path):
    first = new_app(session=path)
    draw_fault(first)
    first.close()
    again = new_app(session=path)
    choose(again, "Start anew")
    assert "stays in" in again.session_bar.notice.text
    draw_fault(again, OTHER)
    for number in range(12):
        again.fixed = (100.0 + number, 100.0)
        wait_for(lambda: again.session_bar.is_saved)
    assert len(numbered_files(path)) == 10
    assert sw.open_session(path.with_name("work.before-000001.json")).faults[0].name == "F1"


@pytest.mark.usefixtures("quick")
def test_a_full_disk_is_said_and_the_picks_are_saved_later(new_app, path, full_disk):
    app = new_app(session=path)
    full_disk.append("")
    draw_fault(app)
    wait_for(lambda: app.session_bar.news.text)
    assert "No space left on device" in app.session_bar.news.text
    assert "stay in memory" in app.session_bar.news.text
    assert app.status.text != app.session_bar.news.text
    assert [fault.name for fault in app.interpretation.faults] == ["F1"]
    full_disk.clear()
    wait_for(lambda: names(path) == ["F1"])
    wait_for(lambda: "Saved again" in app.session_bar.news.text)


@pytest.mark.usefixtures("quick")
def test_from_a_full_disk_the_work_goes_to_another_path(new_app, path, full_disk):
    app = new_app(session=path)
    full_disk.append(f"{path.stem}.")
    draw_fault(app)
    wait_for(lambda: app.session_bar.news.text)
    app.session_path = path.with_name("other.json")
    assert not app.session_bar.news.text
    wait_for(lambda: names(path.with_name("other.json")) == ["F1"])
    assert names(path) == []


def test_closing_on_a_full_disk_says_so(new_app, path, full_disk):
    app = new_app(session=path)
    full_disk.append("")
    draw_fault(app)
    with pytest.raises(DataError, match="No space left"):
        app.close()
    full_disk.clear()


def test_a_section_from_nowhere_is_kept_beside_its_session(new_app, path, section, tmp_path):
    app = new_app(session=path, source=None)
    draw_fault(app)
    app.close()
    (beside,) = tmp_path.glob("work.section-*.npz")
    again = sw.open_session(find_versions(path)[0].path)
    assert again.source == sw.SectionSource("file", str(beside))
    np.testing.assert_array_equal(again.open_section().amplitude, section.amplitude)


def test_work_on_another_section_opens_that(new_app, path):
    first = new_app(session=path)
    draw_fault(first)
    first.close()
    again = new_app(sw.synthetic.tilt().section, session=path, source=None)
    draw_fault(again, OTHER)
    choose(again, "Open")
    np.testing.assert_array_equal(again.section.amplitude, first.section.amplitude)
    assert again.source == SOURCE
    assert again.picker.drawing.picks == first.picker.drawing.picks
    again.close()
    assert [file.name for file in path.parent.iterdir() if "before" in file.name] == []


def test_the_picks_alone_are_taken_where_the_section_is_gone(new_app, path, section, tmp_path):
    first = new_app(session=path, source=None)
    draw_fault(first)
    first.close()
    next(tmp_path.glob("*.npz")).unlink()
    other = sw.Section(section.amplitude * 2, section.dx, section.dz)
    again = new_app(other, session=path, source=None)
    choose(again, "Open")
    assert "does not exist" in again.session_bar.notice.text
    choose(again, "Picks only")
    assert again.section is other
    assert again.picker.drawing.picks == first.picker.drawing.picks
    small = new_app(sw.Section(section.amplitude[:9, :9], section.dx, section.dz), source=None)
    small.session_path = path
    choose(small, "Picks only")
    assert "do not lie on the section" in small.session_bar.notice.text
    assert set(small.session_bar.notice.answers) == {"Open", "Picks only", "Start anew"}
    assert again.session_path is None
    assert "Another app saves its work" in again.session_bar.notice.text


def test_a_file_outside_the_sessions_folder_is_read_only_if_agreed(new_app, section, tmp_path):
    folder = tmp_path / "work"
    folder.mkdir()
    sw.save_section(section, tmp_path / "outside.npz")
    first = new_app(session=folder / "work.json", source=sw.SectionSource("file", str(tmp_path / "outside.npz")))
    draw_fault(first)
    first.close()
    again = new_app(sw.synthetic.tilt().section, session=folder / "work.json", source=None)
    choose(again, "Open")
    assert "outside the session's folder" in again.session_bar.notice.text
    choose(again, "Back")
    choose(again, "Open")
    choose(again, "Read it")
    np.testing.assert_array_equal(again.section.amplitude, section.amplitude)


def test_another_section_sets_the_work_on_the_first_aside(new_app, path, full_disk):
    app = new_app(session=path)
    full_disk.append("")
    draw_fault(app)
    other = sw.synthetic.tilt().section
    with pytest.raises(DataError, match="No space left"):
        app.section = other
    assert [fault.name for fault in app.interpretation.faults] == ["F1"]
    full_disk.clear()
    app.section = other
    aside = path.with_name("work.before-000001.json")
    assert str(aside) in app.session_bar.notice.text
    app.workspace.open(other, app.picker.drawing)
    draw_fault(app, [(500.0, 200.0), (800.0, 700.0)])
    app.close()
    assert sw.open_session(aside).faults[0].pieces == (tuple(FAULT),)
    np.testing.assert_array_equal(find_versions(path)[0].session.open_section().amplitude, other.amplitude)


def test_versions_that_cannot_be_opened_are_not_written_over_unasked(new_app, path):
    path.with_name("work.000003.json").write_text('{"format": "seiswidgets session", "version": 99}')
    app = new_app(session=path)
    assert "none that can be opened" in app.session_bar.notice.text
    draw_fault(app)
    choose(app, "Start anew")
    app.close()
    assert sorted(file.name for file in path.parent.glob("*.json")) == [
        "work.000003.json",
        "work.000004.json",
        "work.before-000003.json",
    ]


def keep_here(app):
    """Press the button in the tab File."""
    app.files.session.keep_button.click()


def test_paths_that_cannot_be_a_sessions_are_refused(new_app, tmp_path):
    app = new_app()
    with pytest.raises(SettingError, match=r"must end in \.json"):
        app.session_path = tmp_path / "work.txt"
    with pytest.raises(DataError, match="home"):
        app.session_path = "~nobody-of-that-name/work.json"
    with pytest.raises(DataError, match="does not exist"):
        app.session_path = tmp_path / "none" / "work.json"
    app.files.session.path.value = "work.txt"
    keep_here(app)
    assert "must end in .json" in app.files.session.notice.text
    app.files.session.path.value = str(tmp_path / "work.json")
    keep_here(app)
    assert app.session_path == tmp_path / "work.json"
    told = re.search(r"the next one in (\S+), and", app.files.session.notice.text)[1]
    draw_fault(app)
    wait_for(lambda: app.session_bar.is_saved)
    assert list(numbered_files(tmp_path / "work.json").values()) == [Path(told)]  # the file that was named
    app.session_path = tmp_path / "work.json"
    assert app.session_bar.notice.answers == {}  # about its own work it does not ask
    app.session_path = None
    assert app.session_path is None
    keep_here(app)
    assert "choose above the section" in app.files.session.notice.text
    choose(app, "Start anew")
    assert app.files.session.notice.text == ""
    app.files.session.path.value = ""
    keep_here(app)
    assert app.session_path is None
    assert "are not saved any more" in app.files.session.notice.text


@pytest.mark.usefixtures("quick")
def test_undoing_a_change_of_section_continues_the_first_ones_session(new_app, path, section):
    app = new_app(session=path)
    draw_fault(app)
    drawing = app.picker.drawing
    wait_for(lambda: app.session_bar.is_saved)
    other = sw.synthetic.tilt().section
    app.workspace.open(other, Drawing())
    assert "work.before-000001.json" in app.session_bar.notice.text
    draw_fault(app, [(500.0, 200.0), (800.0, 700.0)])
    while app.section is other:
        app.picker.editor.undo()
    assert (app.section, app.picker.drawing) == (section, drawing)
    theirs = path.with_name("work.before-000002.json")
    assert str(theirs) in app.session_bar.notice.text
    np.testing.assert_array_equal(sw.open_session(theirs).open_section().amplitude, other.amplitude)
    assert app.session_path == path
    draw_fault(app, OTHER)
    app.close()
    assert names(path) == ["F1", "F2"]
    np.testing.assert_array_equal(find_versions(path)[0].session.open_section().amplitude, section.amplitude)
    assert sw.open_session(path.with_name("work.before-000001.json")).faults[0].pieces == (tuple(FAULT),)


@pytest.mark.usefixtures("quick")
def test_a_section_without_work_leaves_none_aside(new_app, path, section, tmp_path):
    app = new_app(session=path)
    draw_fault(app)
    app.workspace.open(sw.synthetic.tilt().section, Drawing())
    app.picker.editor.undo()
    assert app.section is section
    assert app.session_bar.notice.text == ""
    app.close()
    assert names(path) == ["F1"]
    assert len(list(tmp_path.glob("*.before-*"))) == 1


@pytest.mark.usefixtures("quick")
def test_undoing_a_change_of_section_is_refused_while_the_work_cannot_be_saved(new_app, path, section, full_disk):
    app = new_app(session=path)
    other, history = sw.synthetic.tilt().section, app.workspace.history
    app.section = other
    app.interpretation = sw.Interpretation([sw.Fault([(500.0, 200.0), (800.0, 700.0)], "F1")])
    app.fixed = (100.0, 100.0)
    full_disk.append("")
    keys(app.panes.original, "z", "z", modifiers=["ctrl"])
    assert history.next_undo.document.section is section
    with pytest.raises(DataError, match="No space left"):
        app.picker.editor.undo()
    assert (app.section, history.undo_count, history.redo_count) == (other, 1, 2)
    assert "This section stays, because its work cannot be saved" in app.session_bar.notice.text
    full_disk.clear()
    app.picker.editor.undo()
    assert app.section is section


def test_a_missing_folder_is_offered_to_be_made(new_app, tmp_path):
    app = new_app()
    app.files.session.path.value = str(tmp_path / "one" / "two" / "work.json")
    keep_here(app)
    assert app.session_path is None
    assert app.files.session.notice.text == f"The folder {tmp_path / 'one' / 'two'} does not exist."
    app.files.session.notice.answers["Make it"].click()
    assert app.session_path == tmp_path / "one" / "two" / "work.json"


@pytest.fixture
def other_kernel(monkeypatch, path):
    """A context in which this process claims a path as another one that lives."""

    def claim_as_other():
        with monkeypatch.context() as patch:
            patch.setattr(ownership, "OURS", "other")
            ownership.claim(path)

    return claim_as_other


@pytest.mark.usefixtures("quick")
@pytest.mark.parametrize(("answer", "name"), [("Take over", "work.json"), ("Open a copy", "work-2.json")])
def test_the_second_of_two_kernels_takes_over_or_opens_a_copy(new_app, path, other_kernel, answer, name):
    first = new_app(session=path)
    draw_fault(first)
    first.close()
    other_kernel()
    before = numbered_files(path)
    second = new_app(session=path)
    assert "is open in another notebook" in second.session_bar.notice.text
    draw_fault(second, OTHER)
    second.wait(LONG)
    assert numbered_files(path) == before
    choose(second, answer)
    if answer == "Take over":
        choose(second, "Open")
    assert second.session_path == path.with_name(name)
    assert [pick.name for pick in second.picker.drawing.picks] == ["F1"]
    draw_fault(second, OTHER)
    second.close()
    assert names(path.with_name(name)) == ["F1", "F2"]
    assert (ownership.other_owner(path) is None) == (answer == "Take over")


@pytest.mark.usefixtures("quick")
@pytest.mark.parametrize(("answer", "name"), [("Take it back", "work.json"), ("Open a copy", "work-2.json")])
def test_the_first_of_two_kernels_is_told_and_loses_nothing(new_app, path, other_kernel, answer, name):
    first = new_app(session=path)
    draw_fault(first)
    wait_for(lambda: first.session_bar.is_saved)
    other_kernel()
    draw_fault(first, OTHER)
    assert "has taken over" in first.session_bar.notice.text
    assert names(path) == ["F1"]
    choose(first, answer)
    wait_for(lambda: names(path.with_name(name)) == ["F1", "F2"])
