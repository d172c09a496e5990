import gc
import weakref

import pytest
from ipywidgets import Layout, Style
from ipywidgets.widgets.widget import _instances

import seiswidgets as sw
from seiswidgets.widgets.app import RestorationApp
from tests.widgets.files import line
from tests.widgets.hands import appear, draw, keys

LONG = 60  # seconds until a restoration must be done
CASE = sw.synthetic.faulted_fold()


def use(app, path):
    """Have an app make all that it makes while it is worked with."""
    appear(app.panes.original, app.panes.restored)
    app.picker.mode = "fault"
    draw(app.panes.original, (3000.0, 200.0), (3300.0, 1200.0))
    keys(app.panes.original, "z", modifiers=["ctrl"])  # its row is there still, but not shown
    app.steps = app.steps[:1]
    app.files.section.file.text.value = str(path)
    app.keeper.notice.ask("Is it?", {"Yes": app.restore, "No": app.cancel})
    app.keeper.notice.ask("Is it?", {"Yes": app.restore})
    assert app.wait(LONG)


def test_a_closed_app_leaves_no_widget_but_looks_and_is_forgotten(tmp_path):
    before = set(_instances)
    app = RestorationApp(CASE.section, CASE.interpretation, fixed=CASE.fixed)
    use(app, line(tmp_path / "line.sgy"))
    restoration, app_itself = weakref.ref(app.restoration), weakref.ref(app)
    app.close()
    assert app.wait(LONG)
    left = [widget for number, widget in _instances.items() if number not in before]
    assert [widget for widget in left if not isinstance(widget, Layout | Style)] == []
    del app
    gc.collect()
    assert app_itself() is restoration() is None


def test_an_app_that_cannot_be_made_says_only_why(monkeypatch):
    also = []
    monkeypatch.setattr("sys.unraisablehook", also.append)
    with pytest.raises(sw.SettingError, match=r"starts from a seiswidgets\.Section"):
        RestorationApp("line.sgy")
    gc.collect()
    assert also == []
