import json
import threading
from pathlib import Path

import meshio
import numpy as np
import pytest
import segyio
import xarray

import seiswidgets as sw
from seiswidgets.errors import DataError, SettingError
from seiswidgets.widgets.app import RestorationApp
from seiswidgets.widgets.files import sectionopener
from seiswidgets.widgets.files.filefield import FileField
from tests.widgets.files import line, send, volume
from tests.widgets.hands import appear, draw

LONG = 60
HOSTILE = "<img src=x onerror=alert(1)>"


@pytest.fixture(scope="module")
def case():
    return sw.synthetic.faulted_fold()


@pytest.fixture
def app(case):
    app = RestorationApp(case.section, live=False)
    app.solving.spacing = 150.0
    appear(app.panes.original, app.panes.restored)
    yield app
    app.close()
    assert app.wait(LONG)


@pytest.fixture
def restored(app, case):
    app.live, app.interpretation, app.fixed = True, case.interpretation, case.fixed
    assert app.wait(LONG)
    app.live = False
    return app


def load(app, path, **fields):
    """Open a file in the panel, some fields filled in."""
    opener = app.files.section
    opener.file.text.value = str(path)
    for name, value in fields.items():
        opener.fields.fields[name].value = value
    opener.load()
    assert opener.wait(LONG)
    return opener


def answer(notice, name):
    notice.answers[name].click()


def test_a_line_is_previewed_and_opened(app, tmp_path):
    path = line(tmp_path / "line.sgy", text=HOSTILE.ljust(3200))
    opener = app.files.section
    opener.file.text.value = str(path)
    assert "30 traces of 40 samples; traces 25 m apart; samples 4 ms" in opener._preview.value
    assert "&lt;img src=x" in opener._preview.value
    assert "<img" not in opener._preview.value
    assert "two-way" not in opener.notice.text
    assert "vertical axis, velocity (m/s)" in opener.fields._note.value
    load(app, path, velocity="2500")
    section = app.section
    assert (section.velocity, section.dx, section.z_unit, section.shape) == (2500.0, 25.0, "ms", (40, 30))
    np.testing.assert_array_equal(section.amplitude, sw.open_section(path, velocity=2500).amplitude)
    assert app.source == sw.SectionSource("file", str(path), {"z_unit": "ms", "velocity": 2500.0, "x_unit": "m"})
    assert app.panes.shown.restoration.original is section
    assert app.step_list.z_unit == "ms"
    assert app.panes.restored.view.is_fitted


def test_a_line_of_a_volume_needs_its_number(app, tmp_path):
    path = volume(tmp_path / "volume.sgy")
    opener = load(app, path, line="crossline", z_unit="m")
    assert opener.fields.fields["number"].value == "3"
    np.testing.assert_array_equal(app.section.amplitude[0], [1003.0, 1103.0, 1203.0])
    load(app, path, line="traces", number="5 to 9", z_unit="m")
    np.testing.assert_array_equal(app.section.amplitude[0], [1101.0, 1102.0, 1103.0, 1104.0, 1105.0])
    np.testing.assert_array_equal(app.source.open().amplitude, app.section.amplitude)
    load(app, path, line="traces", number="5", z_unit="m")
    assert 'must be two numbers, as in "0 to 99"' in opener.notice.text


def test_a_matrix_takes_the_places_of_its_corners(app, tmp_path):
    np.save(tmp_path / "matrix.npy", np.random.default_rng(0).normal(size=(11, 21)))
    opener = load(app, tmp_path / "matrix.npy", z_unit="m", x_min="100", z_max="50")
    assert app.section.extent == (100.0, 500.0, 0.0, 50.0)
    assert app.section.velocity is None
    load(app, tmp_path / "matrix.npy", z_unit="m", x_min="")
    assert "x_min must be a finite number, but is ''" in opener.notice.text
    load(app, tmp_path / "matrix.npy", x_min="0", x_max="far")
    assert "x_max must be a finite number, but is 'far'" in opener.notice.text
    assert app.section.extent == (100.0, 500.0, 0.0, 50.0)


def test_our_own_file_needs_nothing(app, case, tmp_path):
    sw.save_section(case.section, tmp_path / "own.npz")
    opener = load(app, tmp_path / "own.npz")
    assert opener.fields.fields == {}
    np.testing.assert_array_equal(app.section.amplitude, case.section.amplitude)


@pytest.mark.parametrize("content", [b"", b"\x89PNG but not really", b"some words, no numbers"])
def test_what_cannot_be_opened_is_said_and_changes_nothing(app, case, tmp_path, content):
    path = tmp_path / f"{HOSTILE.replace('/', '')}.sgy"
    path.write_bytes(content)
    opener = app.files.section
    opener.file.text.value = str(path)
    assert str(path) in opener.notice.text
    assert "<img" not in opener.notice._line.value
    assert opener._open.disabled
    assert app.section is case.section
    opener.file.text.value = ""
    assert opener.notice.text == ""


def test_opening_can_be_cancelled(app, case, tmp_path, monkeypatch):
    begun, go_on, opened = threading.Event(), threading.Event(), sectionopener.open_section

    def slow(path, *, progress, **choices):
        begun.set()
        go_on.wait(LONG)
        return opened(path, progress=progress, **choices)

    monkeypatch.setattr(sectionopener, "open_section", slow)
    opener = app.files.section
    opener.file.text.value = str(line(tmp_path / "line.sgy"))
    opener.load()
    assert begun.wait(LONG)
    assert opener._progress.layout.display == ""
    opener._cancel.click()
    go_on.set()
    assert opener.wait(LONG)
    assert app.section is case.section
    assert "cancelled" in opener.notice.text
    assert opener._progress.layout.display == "none"


def test_what_should_not_happen_is_said_too(app, tmp_path, monkeypatch, caplog):
    monkeypatch.setattr(sectionopener, "open_section", lambda *_, **__: 1 / 0)
    opener = load(app, line(tmp_path / "line.sgy"))
    assert "should not have happened: ZeroDivisionError" in opener.notice.text
    assert "in the background failed" in caplog.text


def test_picks_are_kept_or_dropped_as_the_user_says(restored, case, tmp_path):
    app, drawn = restored, restored.picker.drawing
    sw.save_section(case.section, tmp_path / "same.npz")
    opener = load(app, tmp_path / "same.npz")
    assert set(opener.notice.answers) == {"Keep the picks", "Drop the picks", "Do not open"}
    answer(opener.notice, "Do not open")
    assert app.section is case.section
    load(app, tmp_path / "same.npz")
    answer(opener.notice, "Keep the picks")
    assert app.section is not case.section
    assert app.picker.drawing == drawn
    assert not app.picker.pen.can_undo
    load(app, line(tmp_path / "line.sgy"))
    assert set(opener.notice.answers) == {"Drop the picks", "Do not open"}
    answer(opener.notice, "Drop the picks")
    assert app.picker.drawing.picks == ()
    assert not app.picker.pen.can_undo
    assert app.restoration.stages == ()


def test_a_section_set_from_code_keeps_the_picks_that_lie_on_it(restored, case):
    app, drawn = restored, restored.picker.drawing
    app.solving.spacing = 60.0
    app.live = True
    other = sw.Section(case.section.amplitude[::-1], case.section.dx, case.section.dz)
    app.section = other
    assert app.wait(LONG)
    assert app.section is other is app.restoration.original
    assert app.picker.drawing == drawn
    assert app.solving.spacing is None
    assert len(app.restoration.stages) == 2
    app.section = sw.Section(case.section.amplitude[:40, :40], case.section.dx, case.section.dz)
    assert app.interpretation.faults == ()
    assert app.fixed is None
    app.picker.mode = "fault"
    draw(app.panes.original, (20.0, 20.0), (60.0, 150.0))
    assert len(app.interpretation.faults) == 1
    app.section = sw.synthetic.tilt().section
    with pytest.raises(SettingError, match="another section"):
        app.restoration = sw.Restoration(other)


def test_an_upload_is_opened_under_a_harmless_name(app, tmp_path):
    content = line(tmp_path / "line.sgy").read_bytes()
    opener = app.files.section
    send(opener.file, "../../<b>\0up.sgy", content)
    path = Path(opener.file.path)
    assert path.name == "_b__up.sgy"
    assert path.read_bytes() == content
    opener.load()
    assert opener.wait(LONG)
    assert app.section.shape == (40, 30)
    assert app.source is None
    app.close()
    assert not path.parent.exists()


def test_uploads_are_held_against_their_size(monkeypatch):
    field = FileField("path")
    send(field, "cut.sgy", b"abc", size=4)
    assert "'cut.sgy' has 3 of 4 bytes" in field.error
    monkeypatch.setattr("seiswidgets.widgets.files.filefield.MOST_UPLOADED", 2)
    send(field, "long.sgy", b"abc")
    assert "there may be 2" in field.error
    assert field.path == ""


@pytest.mark.parametrize("suffix", ["geojson", "csv"])
def test_picks_go_out_and_come_in(restored, case, tmp_path, suffix):
    picks = restored.files.picks
    picks.out.value = str(tmp_path / f"picks.{suffix}")
    assert picks.write() == f"Wrote {picks.out.value}."
    restored.interpretation = sw.Interpretation()
    picks.file.text.value = picks.out.value
    assert "Undo brings back" in picks.read()
    (fault,) = restored.interpretation.faults
    np.testing.assert_array_equal(fault.points, case.interpretation.faults[0].points)
    restored.picker.pen.undo()
    assert restored.picker.pen.interpretation.faults == ()


def test_units_that_a_format_lacks_are_asked_for(app, tmp_path):
    (tmp_path / "export.txt").write_text("-> \n100 0 200\n300 0 260\n-> \n500 0 290\n")
    picks = app.files.picks
    picks.file.text.value = str(tmp_path / "export.txt")
    with pytest.raises(SettingError, match="its format cannot be told"):
        picks.read()
    assert picks._of_exports.layout.display == "none"
    picks.format.value = "cps3-horizons"
    assert picks._of_exports.layout.display == ""
    picks.along.value = "x"
    with pytest.raises(DataError, match="x_unit="):
        picks.read()
    picks.x_unit.value = picks.z_unit.value = "m"
    assert "left out" in picks.read()
    assert len(app.interpretation.horizons) == 1


def test_trouble_with_picks_is_said_beside(app, tmp_path):
    picks = app.files.picks
    picks.file.text.value = str(tmp_path / f"{HOSTILE.replace('/', '')}.csv")
    next(child for child in picks.children if getattr(child, "description", "") == "Import picks").click()
    assert "there is no file" in picks.notice.text
    assert "<img" not in picks.notice._line.value


def test_all_results_are_written_and_open_again(restored, tmp_path):
    results = restored.files.results
    results.folder.value = str(tmp_path / "out")
    for box in results.kinds.values():
        box.value = True
    results.export()
    assert [path.parent for path in results.written] == [tmp_path / "out"] * 8
    written = {path.name.split("-")[-1]: path for path in results.written}
    section = restored.restoration.section
    np.testing.assert_array_equal(sw.open_section(written["restored.npz"]).amplitude, section.amplitude)
    assert sw.preview(written["restored.sgy"]).shape == section.shape
    assert written["figure.png"].read_bytes().startswith(b"\x89PNG")
    assert "<svg" in written["figure.svg"].read_text()
    assert len(meshio.read(written["mesh.vtu"]).points) == len(restored.restoration.stages[-1].vertices)
    assert len(json.loads(written["report.json"].read_text())["stages"]) == 2
    assert "<!DOCTYPE html>" in written["report.html"].read_text()
    with xarray.open_dataset(written["displacement.nc"]) as fields:
        assert "displacement_x" in fields
    with pytest.raises(DataError, match="exist already; choose another name, or allow"):
        results.export()
    results.replace.value = True
    results.export()
    assert not list((tmp_path / "out").glob(".*"))


@pytest.mark.parametrize(("line", "number"), [("inline", "11"), ("traces", "5 to 9")])
def test_segy_results_carry_the_headers_of_the_line_they_came_from(app, tmp_path, line, number):
    load(app, volume(tmp_path / "volume.sgy"), line=line, number=number, z_unit="m")
    flat = sw.Horizon([(0.0, 1.0), (100.0, 2.0)], name="H1")
    app.interpretation = sw.Interpretation([], [flat])
    app.solving.spacing = 5.0
    app.restore()
    assert app.wait(LONG)
    results = app.files.results
    results.folder.value = str(tmp_path)
    for ending, box in results.kinds.items():
        box.value = ending == "restored.sgy"
    results.export()
    with segyio.open(results.written[0], ignore_geometry=True) as file:
        assert set(file.attributes(189)[:]) == {11}


@pytest.mark.parametrize(
    ("folder", "stem", "match"),
    [
        ("", "", "give the folder"),
        ("{}/none/out", "", "cannot be made"),
        ("{}", "../up", "a name without folders"),
        ("{}", "..", "a name without folders"),
    ],
)
def test_results_say_what_they_need(restored, tmp_path, folder, stem, match):
    results = restored.files.results
    results.folder.value, results.stem.value = folder.format(tmp_path), stem
    with pytest.raises((DataError, SettingError), match=match):
        results.export()
    results._said()
    assert results.notice.text
    assert list(tmp_path.iterdir()) == []


def test_without_a_restoration_there_is_nothing_to_export(app, tmp_path):
    app.files.results.folder.value = str(tmp_path)
    with pytest.raises(SettingError, match="restore the section first"):
        app.files.results.export()
