"""Work in the gallery is never lost: neither by another choice, nor with the kernel."""

import json

import numpy as np
import pytest

import seiswidgets as sw
from seiswidgets.widgets.gallery import BACK, DAMAGED, RETURN, SETTINGS_BACK
from seiswidgets.widgets.work import Work

FAULT = [(1800.0, 100.0), (2000.0, 900.0), (2300.0, 1700.0)]
AGAIN = [(900.0, 200.0), (1000.0, 800.0)]


@pytest.fixture
def opened():
    """A function that makes a gallery, as a new kernel does, and shows it in a browser that had kept some texts."""
    made = []

    def open_gallery(kept=None, **settings):
        made.append(sw.Gallery(**settings))
        if kept is not None:
            receive(made[-1], kind="found", texts=kept)
        return made[-1]

    yield open_gallery
    for gallery in made:
        gallery.close()


def receive(gallery, **content):
    gallery.storage._handle_custom_msg(content, [])


def kept(gallery):
    """Texts in the browser when the page is closed."""
    return json.loads(json.dumps(gallery.storage.kept))


def draw(gallery, points=FAULT):
    """A fault, a horizon of a single point that is not finished, a held point, and other choices in each tab."""
    app, editor = gallery.app, gallery.app.picker.editor
    app.live = False
    app.interpretation = sw.Interpretation([sw.Fault(points, "my <fault>")])
    editor.recolour("fault", "my <fault>", "#123456")
    editor.show("fault", "my <fault>", False)
    app.fixed = (400.0, 500.0)
    editor.enter("horizon")
    editor.add((700.0, 600.0))
    app.picker.refresh()
    app.weights, app.steps = sw.Weights(stitch=7.0), (sw.Step("flatten", datum=333.0), sw.Step("unfault", on=False))
    app.solving.spacing, app.solving.solver = 90.0, "fixed-point"
    app.picker.snap, app.picker.window, app.picker.follow = "trough", 7.5, True
    app.panes.original.colours, app.panes.original.gain, app.panes.original.polarity = "seismic", 2.0, -1
    app.panes.original.clip, app.panes.deformation, app.panes.mesh, app.panes.zoom_linked = 90.0, 0.2, 0.7, True
    return Work.of(app)


def test_work_on_a_section_is_back_when_that_is_chosen_again(opened):
    gallery = opened()
    done = draw(gallery)
    gallery.choice = "graben"
    assert gallery.app.picker.drawing.picks == ()
    other = draw(gallery, AGAIN)
    gallery.choice = "faulted_fold"
    assert Work.of(gallery.app) == done
    assert done.drawing.draft.points == ((700.0, 600.0),)
    assert gallery.notice.text == BACK
    assert gallery.app.workspace.history.next_undo is None
    gallery.choice = "graben"
    assert Work.of(gallery.app) == other


def test_an_interpreters_picks_come_beside_ones_own(opened):
    gallery = opened()
    done = draw(gallery)
    gallery.with_picks = True
    assert gallery.app.picker.drawing.names("fault") == ("F1",)
    assert gallery.notice.text == ""
    gallery.app.picker.editor.rename("fault", "F1", "renamed")
    gallery.app.picker.refresh()
    gallery.with_picks = False
    assert Work.of(gallery.app) == done
    gallery.with_picks = True
    assert gallery.app.picker.drawing.names("fault") == ("renamed",)


def test_a_new_kernel_gets_it_all_back_from_the_browser(opened):
    first = opened({})
    first.choice = "graben"
    done = draw(first, AGAIN)
    first.choice, first.with_picks = "faulted_fold", True
    first.app.weights = sw.Weights(edge=3.0)
    second = opened(kept(first))
    assert (second.choice, second.with_picks) == ("faulted_fold", True)
    assert second.app.weights == sw.Weights(edge=3.0)
    assert second.notice.text == SETTINGS_BACK
    second.with_picks = False
    assert second.notice.text == ""
    second.choice = "graben"
    assert Work.of(second.app) == done
    assert second.notice.text == BACK
    assert kept(second)["graben"] == kept(first)["graben"]


def test_numbers_come_back_exactly(opened):
    first, points = opened({}), np.random.default_rng(0).uniform(1, 900, (40, 2))
    first.app.interpretation = sw.Interpretation([], [sw.Horizon(points[np.argsort(points[:, 0])], name="H1")])
    second = opened(kept(first))
    assert second.app.picker.drawing == first.app.picker.drawing


def test_what_code_asks_for_is_shown_whatever_the_browser_had(opened):
    first = opened({})
    first.choice = "graben"
    done = draw(first, AGAIN)
    assert opened(kept(first), choice="sine_fold").choice == "sine_fold"
    assert Work.of(opened(kept(first), choice="graben").app) == done


def test_what_was_drawn_before_the_page_answered_stays(opened):
    first = opened({})
    draw(first)
    second = opened()
    done = draw(second, AGAIN)
    receive(second, kind="found", texts=kept(first))
    assert Work.of(second.app) == done
    second.choice = "graben"
    second.choice = "faulted_fold"
    assert Work.of(second.app) == done


def test_a_page_that_comes_later_changes_nothing(opened):
    first = opened({})
    draw(first)
    gallery = opened({})
    receive(gallery, kind="found", texts=kept(first))
    assert gallery.app.picker.drawing.picks == ()


def test_starting_over_clears_and_can_be_taken_back(opened):
    gallery = opened({})
    assert gallery.start_over_button.disabled
    done = draw(gallery)
    assert not gallery.start_over_button.disabled
    gallery.start_over_button.click()
    assert Work.of(gallery.app) == Work.of(opened().app)
    assert "faulted_fold" not in kept(gallery)
    assert gallery.start_over_button.disabled
    gallery.notice.answers[RETURN].click()
    assert Work.of(gallery.app) == done
    assert "faulted_fold" in kept(gallery)
    gallery.start_over()
    gallery.app.picker.editor.undo()
    assert gallery.app.picker.editor.drawing == done.drawing


def test_what_was_cleared_does_not_come_back(opened):
    first = opened({})
    draw(first)
    gallery = opened(kept(first))
    gallery.start_over()
    for name in ("graben", "faulted_fold"):
        gallery.choice = name
    assert gallery.app.picker.drawing.picks == ()
    assert opened(kept(gallery)).app.picker.drawing.picks == ()


def beyond(document):
    document["session"]["picks"]["faults"][0]["points"][0] = [-500.0, 0.0]


def newer(document):
    document["session"]["version"] = 99


def no_line(document):
    document["draft"]["kind"] = "river"


def empty_line(document):
    document["draft"]["points"] = []


def line_beyond(document):
    document["draft"]["points"] = [[1e9, 0.0]]


def nested_setting(document):
    document["settings"]["colours"] = [1]


def huge_setting(document):
    document["settings"]["gain"] = 10**400


def no_session(document):
    del document["session"]


@pytest.mark.parametrize(
    "damage", [beyond, newer, no_line, empty_line, line_beyond, nested_setting, huge_setting, no_session]
)
def test_a_damaged_text_is_left_out_and_said(opened, damage):
    first = opened({})
    draw(first)
    texts = kept(first)
    document = json.loads(texts["faulted_fold"])
    damage(document)
    gallery = opened({**texts, "faulted_fold": json.dumps(document)})
    assert gallery.app.picker.drawing.picks == ()
    assert gallery.notice.text == DAMAGED
    draw(gallery, AGAIN)
    assert opened(kept(gallery)).notice.text == BACK


@pytest.mark.parametrize("text", ["", "{", "null", "[]", "{}", "NaN", "[" * 100_000, " " * (2**23 + 1)])
def test_no_text_at_all_is_left_out_too(opened, text):
    gallery = opened({"faulted_fold": text, "choice": text})
    assert gallery.choice == "faulted_fold"
    assert gallery.notice.text == DAMAGED


@pytest.mark.parametrize("chosen", ['{"choice": "nowhere", "with_picks": false}', '{"choice": ["graben"]}', "7"])
def test_a_section_that_is_none_is_not_chosen(opened, chosen):
    assert opened({"choice": chosen}).choice == "faulted_fold"


def test_a_setting_that_is_none_any_more_leaves_the_others(opened):
    first = opened({})
    draw(first)
    texts = kept(first)
    document = json.loads(texts["faulted_fold"])
    document["settings"] |= {"colours": "no such colours", "gain": "much", "unknown": 1}
    app = opened({**texts, "faulted_fold": json.dumps(document)}).app
    assert app.panes.original.colours == "greys"
    assert app.panes.original.gain == 1.0
    assert app.panes.original.clip == 90.0
    assert app.picker.drawing.names("fault") == ("my <fault>",)


def test_a_browser_that_keeps_nothing_is_said_as_long_as_that_lasts(opened):
    gallery = opened({})
    receive(gallery, kind="trouble", text="the <quota> is exceeded")
    assert "cannot keep your drawing (the &lt;quota&gt; is exceeded)" in gallery.warning.value
    assert gallery.warning.layout.display == ""
    receive(gallery, kind="trouble", text="")
    assert gallery.warning.layout.display == "none"


def test_a_name_that_no_text_can_hold_is_said_and_stays_in_the_kernel(opened):
    gallery = opened({})
    gallery.app.interpretation = sw.Interpretation([sw.Fault(FAULT, "half \ud800")])
    assert "unpaired surrogate" in gallery.warning.value
    gallery.choice = "graben"
    gallery.choice = "faulted_fold"
    assert gallery.app.picker.drawing.names("fault") == ("half \ud800",)
    gallery.app.picker.editor.rename("fault", "half \ud800", "whole")
    gallery.app.picker.refresh()
    assert gallery.warning.layout.display == "none"


def test_a_section_of_ones_own_neither_takes_the_place_of_a_choice_nor_is_lost(opened):
    gallery = opened({})
    done = draw(gallery)
    own = sw.Section(np.random.default_rng(1).normal(size=(60, 80)), dx=10.0, dz=10.0, name="my line")
    gallery.app.section = own
    gallery.app.interpretation = sw.Interpretation([sw.Fault([(100.0, 50.0), (200.0, 300.0)], "F1")])
    there = Work.of(gallery.app)
    assert json.loads(kept(gallery)["faulted_fold"])["session"]["picks"]["faults"][0]["name"] == "my <fault>"
    gallery.choice = "graben"
    assert "my line" in gallery.notice.text
    gallery.choice = "faulted_fold"
    assert Work.of(gallery.app) == done
    assert gallery.notice.text.startswith(BACK)
    gallery.choice = "graben"
    gallery.notice.answers[RETURN].click()
    assert gallery.app.section is own
    assert Work.of(gallery.app) == there
    assert "graben" not in kept(gallery)
    gallery.choice = "faulted_fold"
    gallery.notice.answers[RETURN].click()
    gallery.start_over()
    assert gallery.app.section is own
    assert gallery.app.picker.drawing.picks == ()
    gallery.notice.answers[RETURN].click()
    assert Work.of(gallery.app) == there
    assert "my <fault>" in kept(gallery)["faulted_fold"]


def test_a_session_that_cannot_be_saved_does_not_keep_another_section_from_being_shown(opened, tmp_path, monkeypatch):
    gallery = opened({})
    gallery.app.session_path = tmp_path / "work.json"

    def fail(*_):
        raise sw.DataError("the disk is full; make room")

    monkeypatch.setattr(sw.Session, "save", fail)
    done = draw(gallery)
    gallery.choice = "graben"
    assert "the disk is full" in gallery.warning.value
    assert gallery.app.section.name == "graben"
    gallery.choice = "faulted_fold"
    assert Work.of(gallery.app) == done
