import numpy as np
import pytest

import seiswidgets as sw
from seiswidgets.io.session.autosave import numbered_files
from seiswidgets.widgets.app import RestorationApp
from tests.widgets.hands import appear, draw

LONG = 60


@pytest.fixture
def new_app(tmp_path, monkeypatch):
    """A function that makes an app in an empty working folder; at the end all are closed."""
    monkeypatch.chdir(tmp_path)
    made = []

    def new(*arguments, **settings):
        made.append(RestorationApp(*arguments, **settings))
        return made[-1]

    yield new
    for app in made:
        app.close()
        assert app.wait(LONG)


def is_working(app, section):
    """True if the app shows a section, without a start page, and with nothing before it."""
    return (
        app.start_page is None
        and app.panes in app.children
        and app.panes.original.section is section is app.section
        and app.picker.buttons["undo"].disabled
    )


def test_a_built_in_section_is_opened_from_the_start_page(new_app):
    app = new_app()
    assert app.panes not in app.children
    app.start_page.chooser.value = "planar_fault"
    app.start_page.open_button.click()
    assert app.wait(LONG)
    assert is_working(app, app.section)
    assert app.section.name == sw.synthetic.planar_fault().section.name
    assert app.source == sw.SectionSource("synthetic", "planar_fault")
    appear(app.panes.original)
    app.picker.mode = "fault"
    draw(app.panes.original, (600.0, 200.0), (700.0, 800.0))
    assert len(app.interpretation.faults) == 1


def test_a_file_is_opened_from_the_start_page(new_app, tmp_path):
    np.savez(tmp_path / "line.npz", amplitude=np.zeros((30, 40), np.float32))
    app = new_app()
    opener = app.start_page.opener
    opener.file.text.value = str(tmp_path / "line.npz")
    assert app.wait(LONG)
    opener.open_button.click()
    assert app.wait(LONG)
    assert is_working(app, app.section)
    assert app.section.shape == (30, 40)


def test_a_session_of_the_folder_is_continued(new_app, tmp_path):
    (tmp_path / "work").mkdir()
    case = sw.synthetic.planar_fault()
    source = sw.SectionSource("synthetic", "planar_fault")
    first = new_app(
        case.section, case.interpretation, source=source, session=tmp_path / "work" / "line.json", live=False
    )
    first.close()
    app = new_app(live=False)
    (button,) = app.start_page.sessions.values()
    assert (button.description, button.tooltip) == ("line", str(tmp_path / "work" / "line.json"))
    button.click()
    assert app.wait(LONG)
    assert is_working(app, app.section)
    assert [fault.name for fault in app.interpretation.faults] == [fault.name for fault in case.interpretation.faults]
    assert app.session_path == tmp_path / "work" / "line.json"


def test_the_start_page_alone_saves_nothing(new_app, tmp_path):
    app = new_app(session=tmp_path / "line.json")
    app.close()
    assert numbered_files(tmp_path / "line.json") == {}
    assert list(tmp_path.glob("*")) == []
