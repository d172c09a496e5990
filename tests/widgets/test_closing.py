"""A closed widget leaves nothing behind: no open widget in ipywidgets' registry, and no section in memory."""

import gc
import threading
import weakref

import numpy as np
import pytest
from ipywidgets.widgets import widget as registry

import seiswidgets as sw
from seiswidgets.geology.plan import RestorationJob
from seiswidgets.widgets.closing import close_with_parts
from seiswidgets.widgets.files.question import Question

LONG = 60  # seconds until a restoration must be done
FRESH_VIEW = {"kind": "size", "width": 500, "height": 300, "ratio": 1, "fresh": True}


def open_widgets():
    return set(registry._instances)


def own_section():
    """A section that nothing else refers to."""
    made = sw.synthetic.faulted_fold().section
    return sw.Section(made.amplitude.copy(), dx=made.dx, dz=made.dz, name="own")


def picks():
    return sw.synthetic.faulted_fold().interpretation


def shown(pane):
    """Do what a page does that shows a pane: paint the pictures on canvases of their own."""
    pane.layer._handle_custom_msg(FRESH_VIEW, [])


def pane(section, tmp_path):
    made = sw.SectionPane(section)
    shown(made)
    return made


def linked_panes(section, tmp_path):
    made = sw.LinkedPanes(sw.Plan().restore(section, picks()), deformation=0.5, mesh=0.5)
    shown(made.original)
    shown(made.restored)
    return made


def picker(section, tmp_path):
    made = sw.Picker(section, interpretation=picks())
    made.interpretation = sw.Interpretation()  # the rows of the list stay in reserve
    return made


def step_list(section, tmp_path):
    made = sw.StepList(interpretation=picks())
    made.steps = made.steps[:1]
    return made


def app(section, tmp_path):
    return sw.RestorationApp(section)


def used_app(section, tmp_path):
    """With all tabs opened, a restoration shown, the session saved, and questions asked."""
    made = sw.RestorationApp(section, picks(), session=tmp_path / "work.json")
    tabs = made.tabs
    for number in range(len(tabs.children)):
        tabs.selected_index = number
    np.save(tmp_path / "other.npy", np.zeros((30, 40)))
    for name in ("other.npy", "other.npy ", "nothing.npy"):  # each is looked at anew
        made.files.section.file.text.value = str(tmp_path / name)
        assert made.wait(LONG)
    made.session_bar.notice.ask("Sure?", {"Yes": lambda: None, "No": lambda: None})
    made.session_bar.notice.ask("Quite sure?", {"Yes": lambda: None})
    for one in (made.panes.original, made.panes.restored):
        shown(one)
    assert made.wait(LONG)
    assert made.restoration.stages
    return made


PARTS = [
    pane,
    linked_panes,
    picker,
    step_list,
    app,
    used_app,
    lambda section, tmp_path: sw.WeightSliders(),
    lambda section, tmp_path: sw.Timeline(["unfault", "flatten"]),
    lambda section, tmp_path: sw.DeformationHistogram([1.0, 1.1]),
]


@pytest.mark.parametrize("make", PARTS, ids=lambda make: make.__name__)
def test_a_closed_widget_leaves_no_widget_and_no_section(make, tmp_path):
    sw.SectionPane(own_section()).close()  # ipycanvas opens what all canvases share
    gc.collect()
    before = open_widgets()
    section = own_section()
    made, seen = make(section, tmp_path), weakref.ref(section)
    assert open_widgets() > before
    made.close()
    assert open_widgets() == before
    made.close()
    del made, section
    gc.collect()
    assert seen() is None


def test_closing_during_a_restoration_ends_it_and_frees_the_section(monkeypatch):
    begun = threading.Event()
    monkeypatch.setattr(RestorationJob, "restored", _slow(begun))
    before, section = open_widgets(), own_section()
    made, seen = sw.RestorationApp(section, picks()), weakref.ref(section)
    assert begun.wait(LONG)
    made.close()
    assert not [thread for thread in threading.enumerate() if thread.name == "seiswidgets restoring"]
    del made, section
    gc.collect()
    assert open_widgets() == before
    assert seen() is None


def _slow(begun):
    """A restoration that goes on until it is given up."""
    pause = threading.Event()

    def restored(task, earlier=None, progress=None):
        begun.set()
        while progress(0, 1, 1.0):
            pause.wait(0.01)
        raise sw.Cancelled("given up")

    return restored


def test_a_job_that_closes_its_own_app_does_not_wait_for_itself():
    made, closed = sw.RestorationApp(own_section(), picks()), threading.Event()

    def close(change):
        made.close()
        closed.set()

    made.observe(close, "restoration")
    assert closed.wait(LONG)
    assert made.wait(LONG)
    assert made.comm is None


def test_a_picker_leaves_the_pane_open_that_it_was_lent():
    lent = sw.SectionPane(own_section())
    before = open_widgets()
    one = sw.Picker(lent, interpretation=picks())
    one.close()
    assert open_widgets() == before
    shown(lent)
    lent.layer._handle_custom_msg({"kind": "press", "x": 100, "y": 100}, [])  # which nobody draws with
    lent.layer._handle_custom_msg({"kind": "release", "x": 100, "y": 100}, [])
    assert lent.message == ""
    lent.close()


def test_a_gallery_holds_one_app_however_often_another_is_chosen():
    gallery = sw.Gallery()
    counts, seen = set(), []
    for name in ("graben", "sine_fold") * 3:
        gallery.choice = name
        seen.append(weakref.ref(gallery.app.section))
        counts.add((name, len(open_widgets())))
    assert len(counts) == 2
    gc.collect()
    assert [one() is None for one in seen] == [True] * 5 + [False]
    gallery.close()


def test_a_closed_gallery_leaves_nothing():
    before = open_widgets()
    gallery = sw.Gallery(with_picks=True)
    gallery.choice = "planar_fault"
    seen = weakref.ref(gallery.app.section)
    gallery.close()
    gallery.close()
    assert open_widgets() == before
    del gallery
    gc.collect()
    assert seen() is None


def test_answers_to_earlier_questions_are_closed():
    before, question, asked = open_widgets(), Question(), set()
    for _ in range(3):
        question.ask("Sure?", {"Yes": lambda: None, "No": lambda: None})
        asked.add(len(open_widgets()))
    assert len(asked) == 1
    close_with_parts(question)
    assert open_widgets() == before
