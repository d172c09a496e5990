import pytest

import seiswidgets as sw
from seiswidgets.widgets import gallery as module
from seiswidgets.widgets.gallery import EXHIBITS, Exhibit
from tests.sections import real_section

LONG = 60  # seconds until a restoration must be done


@pytest.fixture
def gallery():
    gallery = sw.Gallery()
    yield gallery
    app = gallery.app
    gallery.close()
    assert app is None or app.wait(LONG)


def apps(gallery):
    return [child for child in gallery.children if isinstance(child, sw.RestorationApp)]


def test_it_opens_with_a_section_and_no_picks(gallery):
    assert gallery.choice == "faulted_fold"
    assert gallery.app.section.name == "faulted fold"
    assert gallery.app.interpretation.faults == ()
    assert gallery.app in gallery.children


def test_another_choice_makes_another_app_and_ends_the_first(gallery):
    first = gallery.app
    gallery.choice = "sine_fold"
    assert gallery.app.section.name == "sine fold"
    assert apps(gallery) == [gallery.app]
    assert first.comm is None


@pytest.mark.parametrize("name", [name for name, exhibit in EXHIBITS.items() if exhibit.has_picks])
def test_with_picks_each_section_made_by_computer_is_restored(gallery, name):
    gallery.set_trait("with_picks", True)
    gallery.choice = name
    assert gallery.app.wait(LONG)
    assert gallery.app.interpretation.horizons
    assert gallery.app.restoration.stages
    assert gallery.app.restoration.settled
    if name not in ("thrust", "fault_bend_fold", "blind_fault"):  # bends of their sheets, and new bed, are findings
        assert gallery.app.status.text.startswith("Settled.")


@pytest.mark.parametrize("name", ["f3", "teapot"])
def test_real_sections_come_with_their_credit_and_without_picks(gallery, name):
    section, _ = real_section(name)
    gallery.with_picks = True
    gallery.choice = name
    assert gallery.app.section.name == section.name
    assert section.credit in gallery.caption.value
    assert gallery.app.interpretation.faults == ()
    assert gallery.picks_box.disabled


def test_a_missing_file_is_said_in_words(gallery, monkeypatch):
    def missing():
        raise sw.DataError("put <b>it</b> in a folder")

    monkeypatch.setitem(module.EXHIBITS, "teapot", Exhibit("Teapot Dome", missing, ""))
    gallery.choice = "teapot"
    assert gallery.app is None
    assert apps(gallery) == []
    assert "Teapot Dome is not available. put &lt;b&gt;it&lt;/b&gt;" in gallery.caption.value
    gallery.choice = "faulted_fold"
    assert gallery.app is not None


def test_a_reader_without_a_kernel_sees_the_apps_picture(gallery):
    bundle = gallery._repr_mimebundle_()
    assert bundle["image/png"] == gallery.app._repr_mimebundle_()["image/png"]
    view = bundle["application/vnd.jupyter.widget-view+json"]
    assert view["model_id"] == gallery.model_id


def test_the_box_of_an_interpreters_picks_is_off_where_there_are_none(gallery):
    gallery.with_picks = True
    assert gallery.picks_box.value
    gallery.choice = "f3"
    assert gallery.picks_box.disabled
    assert not gallery.picks_box.value
    gallery.choice = "graben"
    assert gallery.picks_box.value
    assert not gallery.picks_box.disabled
    gallery.picks_box.value = False
    assert not gallery.with_picks
