import io
import json
import threading
from html import unescape
from pathlib import Path

import matplotlib.pyplot as plt
import meshio
import numpy as np
import pytest
import segyio
import xarray

import seiswidgets as sw
from seiswidgets.errors import DataError, Keyword, SettingError
from seiswidgets.widgets.app import RestorationApp
from seiswidgets.widgets.files import picks_files, result_files, section_opener
from seiswidgets.widgets.files.file_field import FileField
from tests.io.segyfiles import numbered, segy_bytes, volume_headers
from tests.widgets.files import line, message, send, volume
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


def look(app, path):
    """Have a file previewed in the panel."""
    opener = app.files.section
    opener.file.text.value = str(path)
    assert opener.wait(LONG)
    return opener


def load(app, path, **fields):
    """Open a file in the panel, some fields filled in."""
    opener = look(app, path)
    for name, value in fields.items():
        opener.fields.fields[name].value = value
    opener.load()
    assert opener.wait(LONG)
    return opener


def answer(notice, name):
    notice.answers[name].click()


def test_a_line_is_previewed_and_opened(app, tmp_path):
    path = line(tmp_path / "line.sgy", text=HOSTILE.ljust(3200))
    opener = look(app, path)
    assert "30 traces of 40 samples; traces 25 m apart; samples 4 ms" in opener.summary.value
    assert "&lt;img src=x" in opener.summary.value
    assert "<img" not in opener.summary.value
    assert "two-way" not in opener.notice.text
    assert "does not state it: vertical axis, velocity. Correct" in opener.fields.note.value
    shown = {name: opener.fields.fields[name] for name in ("dx", "dz", "z0")}
    opener.fields.fields["z_unit"].value = "s"
    assert [field.description for field in shown.values()] == [
        "traces apart (m)",
        "samples apart (s)",
        "first sample at (s)",
    ]
    assert [field.placeholder for field in shown.values()] == [
        "25, as in the file",
        "0.004, as in the file",
        "0, as in the file",
    ]
    opener.fields.fields["z_unit"].value = "ms"
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
    load(app, path, line="inline", number="99", z_unit="m")
    assert "its first trace has 10 there" in opener.notice.text
    assert "the numbers are at other bytes, give “other header bytes”" in opener.notice.text


def test_some_traces_of_a_line_are_opened(app, tmp_path):
    opener = load(app, line(tmp_path / "line.sgy"), line="traces", number="10 to 19")
    assert app.section.shape == (40, 10)
    assert opener.fields.fields["line"].options == ("all traces", "inline", "crossline", "traces")


def test_header_bytes_that_are_chosen_are_previewed_and_opened(app, tmp_path):
    path, at = tmp_path / "volume.sgy", {"il": 9, "xl": 21}
    headers = volume_headers([10, 11, 12], [1, 2, 3, 4, 5], **at)
    path.write_bytes(segy_bytes(numbered(headers, **at), headers))
    opener = look(app, path)
    assert opener.header_bytes.box.layout.display == "none"
    assert "inlines" not in opener.summary.value
    opener.fields.fields["z_unit"].value = "m"
    opener.header_bytes.unfolded.value = True
    for name, byte in (("inline", "9"), ("crossline", "21")):
        opener.header_bytes.fields[name].value = byte
        assert opener.wait(LONG)
    assert "3 inlines, 10 to 12; 5 crosslines, 1 to 5" in opener.summary.value
    opener.load()
    assert opener.wait(LONG)
    assert app.section.z_unit == "m"
    assert app.source.choices["header_bytes"] == {"inline": 9, "crossline": 21}
    np.testing.assert_array_equal(app.section.amplitude, app.source.open().amplitude)
    np.testing.assert_array_equal(app.section.amplitude[0], [1101.0, 1102.0, 1103.0, 1104.0, 1105.0])


@pytest.mark.parametrize(("byte", "said"), [("182", "where no number starts"), ("x", "must be a whole number")])
def test_header_bytes_that_are_none_are_said(app, tmp_path, byte, said):
    opener = look(app, line(tmp_path / "line.sgy"))
    opener.header_bytes.unfolded.value = True
    opener.header_bytes.fields["x"].value = byte
    assert opener.wait(LONG)
    assert said in opener.notice.text
    assert opener.open_button.disabled
    opener.header_bytes.unfolded.value = False
    assert opener.wait(LONG)
    assert opener.notice.text == ""
    assert not opener.open_button.disabled


def test_positions_that_are_of_no_use_are_said_before_opening(app, tmp_path):
    traces = np.zeros((4, 5), np.float32)
    (tmp_path / "uneven.sgy").write_bytes(segy_bytes(traces, [{181: x} for x in (0, 25, 50, 110)]))
    opener = look(app, tmp_path / "uneven.sgy")
    assert "unevenly spaced traces: most are 25 apart" in opener.fields.note.value
    assert "give the distance between traces: “traces apart”" in opener.fields.note.value
    load(app, tmp_path / "uneven.sgy", dx="0")
    assert "“traces apart” must be above 0, but is 0" in opener.notice.text
    (tmp_path / "old.sgy").write_bytes(segy_bytes(traces, [{73: x} for x in (0, 25, 50, 75)]))
    assert "give “other header bytes” {" in unescape(look(app, tmp_path / "old.sgy").fields.note.value)


def mislabelled(path, code):
    traces = np.sin(np.arange(40) / 3 + np.arange(30)[:, None] / 5)
    content = bytearray(segy_bytes(traces, [{181: 25 * n} for n in range(30)]))
    content[3224:3226] = code.to_bytes(2, "big")
    path.write_bytes(content)
    return path, traces


def test_a_doubtful_sample_format_is_asked_for(app, tmp_path):
    path, traces = mislabelled(tmp_path / "line.sgy", 1)
    opener = look(app, path)
    assert "give “sample format” f4" in unescape(opener.fields.note.value)
    chooser = opener.fields.fields["sample_format"]
    assert [value for _, value in chooser.options] == ["f4", "ibm"]
    load(app, path)
    np.testing.assert_allclose(app.section.amplitude.T, traces, rtol=1e-6, atol=1e-6)
    assert app.source.choices["sample_format"] == "f4"
    opener.header_bytes.unfolded.value = True
    opener.header_bytes.corrections["sample_format"].value = "ibm"
    assert opener.wait(LONG)
    assert "sample_format" not in opener.fields.fields
    opener.load()
    assert opener.wait(LONG)
    assert app.source.choices["sample_format"] == "ibm"


def test_a_header_that_cannot_be_read_can_be_corrected(app, tmp_path):
    path, traces = mislabelled(tmp_path / "line.sgy", 0)
    opener = look(app, path)
    assert "states no format: give “sample format”" in opener.notice.text
    assert opener.open_button.disabled
    opener.header_bytes.unfolded.value = True
    opener.header_bytes.corrections["sample_format"].value = "f4"
    assert opener.wait(LONG)
    assert opener.notice.text == ""
    opener.load()
    assert opener.wait(LONG)
    np.testing.assert_allclose(app.section.amplitude.T, traces, rtol=1e-6, atol=1e-6)


def test_an_offset_is_asked_for_before_stack(app, tmp_path):
    headers = [{181: 25 * n, 21: n, 37: offset} for n in range(20) for offset in (100, 200, 300)]
    traces = np.random.default_rng(0).normal(size=(60, 40))
    (tmp_path / "gathers.sgy").write_bytes(segy_bytes(traces, headers))
    opener = look(app, tmp_path / "gathers.sgy")
    assert opener.fields.fields["offset"].value == "100"
    assert "3 offsets, 100 to 300" in opener.summary.value
    load(app, tmp_path / "gathers.sgy", offset="200")
    assert app.source.choices["offset"] == 200
    np.testing.assert_allclose(app.section.amplitude.T, traces[1::3], rtol=1e-6)


def test_doubtful_headers_are_said_before_opening(app, tmp_path):
    traces, path = np.zeros((30, 5), np.float32), tmp_path / "decimetres.sgy"
    path.write_bytes(segy_bytes(traces, [{181: 4_340_000 + 125 * n, 185: 64_780_000} for n in range(30)]))
    said = unescape(look(app, path).fields.note.value)
    assert "in decimetres, the traces are 12.5 apart: “traces apart” 12.5;" in said
    bits = [int(np.array(434_000 + 25 * n, "f4").view("i4")) for n in range(30)]
    (tmp_path / "floats.sgy").write_bytes(segy_bytes(traces, [{181: x, 185: 0} for x in bits]))
    opener = look(app, tmp_path / "floats.sgy")
    assert "are read as IEEE floats" in opener.fields.note.value
    assert opener.fields.fields["dx"].placeholder == "25, as in the file"


def test_numbers_that_are_typed_follow_their_unit(app, tmp_path):
    np.save(tmp_path / "matrix.npy", np.zeros((11, 21)))
    opener = app.files.section
    opener.file.text.value = str(tmp_path / "matrix.npy")
    assert opener.wait(LONG)
    fields = opener.fields.fields
    fields["z_max"].value, fields["x_max"].value, fields["x_min"].value = "4000", "1500", ""
    fields["z_unit"].value, fields["x_unit"].value = "s", "km"
    assert [fields[name].value for name in ("z_max", "x_max", "x_min")] == ["4", "1.5", ""]
    assert fields["velocity"].value == "2000"
    fields["z_unit"].value = "ft"
    fields["z_unit"].value = "m"
    assert float(fields["z_max"].value) == pytest.approx(4000 * 0.3048, rel=1e-9)


def test_a_matrix_takes_the_places_of_its_corners(app, tmp_path):
    np.save(tmp_path / "matrix.npy", np.random.default_rng(0).normal(size=(11, 21)))
    opener = load(app, tmp_path / "matrix.npy", z_unit="m", x_min="100", z_max="50")
    assert app.section.extent == (100.0, 500.0, 0.0, 50.0)
    assert app.section.velocity is None
    load(app, tmp_path / "matrix.npy", z_unit="m", x_min="")
    assert "left edge must be a finite number, but is ''" in opener.notice.text
    load(app, tmp_path / "matrix.npy", x_min="0", x_max="far")
    assert "right edge must be a finite number, but is 'far'" in opener.notice.text
    load(app, tmp_path / "matrix.npy", x_min="10", x_max="-5")
    assert "the right edge must be more than the left edge, 10, but is -5" in opener.notice.text
    assert app.section.extent == (100.0, 500.0, 0.0, 50.0)


def test_our_own_file_needs_nothing(app, case, tmp_path):
    sw.save_section(case.section, tmp_path / "own.npz")
    opener = load(app, tmp_path / "own.npz")
    assert opener.fields.fields == {}
    np.testing.assert_array_equal(app.section.amplitude, case.section.amplitude)


def test_of_an_archive_only_what_it_lacks_is_asked_for(app, tmp_path):
    amplitude = np.random.default_rng(0).normal(size=(11, 21))
    np.savez(tmp_path / "axes.npz", amplitude=amplitude, dx=5.0, dz=2.0)
    opener = load(app, tmp_path / "axes.npz", velocity="1800")
    assert list(opener.fields.fields) == ["z_unit", "velocity", "x_unit"]
    assert (app.section.velocity, app.section.dx) == (1800.0, 5.0)
    np.savez(tmp_path / "units.npz", amplitude=amplitude, z_unit="m")
    opener = load(app, tmp_path / "units.npz", x_max="40", z_max="50")
    assert list(opener.fields.fields) == ["x_min", "x_max", "z_min", "z_max"]
    assert "does not state it: left edge, right edge, top, bottom." in opener.fields.note.value
    assert app.section.extent == (0.0, 40.0, 0.0, 50.0)


@pytest.mark.parametrize("content", [b"", b"\x89PNG but not really", b"some words, no numbers"])
def test_what_cannot_be_opened_is_said_and_changes_nothing(app, case, tmp_path, content):
    path = tmp_path / f"{HOSTILE.replace('/', '')}.sgy"
    path.write_bytes(content)
    opener = look(app, path)
    assert str(path) in opener.notice.text
    assert "<img" not in opener.notice.line.value
    assert opener.open_button.disabled
    assert app.section is case.section
    opener.file.text.value = ""
    assert opener.notice.text == ""


def test_opening_can_be_cancelled(app, case, tmp_path, monkeypatch):
    begun, go_on, opened = threading.Event(), threading.Event(), section_opener.open_section

    def slow(path, *, progress, **choices):
        begun.set()
        go_on.wait(LONG)
        return opened(path, progress=progress, **choices)

    monkeypatch.setattr(section_opener, "open_section", slow)
    opener = look(app, line(tmp_path / "line.sgy"))
    opener.load()
    assert begun.wait(LONG)
    assert opener.job.layout.display == ""
    assert opener.open_button.disabled
    opener.job.cancel_button.click()
    assert "Stopping" in opener.notice.text
    go_on.set()
    assert opener.wait(LONG)
    assert app.section is case.section
    assert "cancelled" in opener.notice.text
    assert opener.job.layout.display == "none"
    assert not opener.open_button.disabled


def test_another_path_takes_the_place_of_what_is_being_opened(app, case, tmp_path, monkeypatch):
    begun, go_on, opened = threading.Event(), threading.Event(), section_opener.open_section

    def slow(path, *, progress, **choices):
        begun.set()
        go_on.wait(LONG)
        return opened(path, **choices)

    monkeypatch.setattr(section_opener, "open_section", slow)
    opener = look(app, line(tmp_path / "line.sgy"))
    opener.load()
    assert begun.wait(LONG)
    opener.file.text.value = str(line(tmp_path / "other.sgy", count=20))
    go_on.set()
    assert opener.wait(LONG)
    assert app.section is case.section
    assert "20 traces" in opener.summary.value
    assert opener.notice.text == ""


def test_what_should_not_happen_is_said_too(app, tmp_path, monkeypatch, caplog):
    monkeypatch.setattr(section_opener, "open_section", lambda *_, **__: 1 / 0)
    opener = load(app, line(tmp_path / "line.sgy"))
    assert "should not have happened: ZeroDivisionError" in opener.notice.text
    assert "a background job failed" in caplog.text


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
    assert app.workspace.history.next_undo.label == "open same.npz"
    load(app, line(tmp_path / "line.sgy"))
    assert set(opener.notice.answers) == {"Drop the picks", "Do not open"}
    answer(opener.notice, "Drop the picks")
    assert app.picker.drawing.picks == ()
    assert app.restoration.stages == ()
    assert app.picker.editor.undo()
    assert app.wait(LONG)
    assert app.section.shape == case.section.shape
    assert app.picker.drawing == drawn
    assert app.restoration.original is app.section


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
    assert "Uploaded: _b__up.sgy" in opener.file.status.value
    assert opener.wait(LONG)
    opener.load()
    assert opener.wait(LONG)
    assert app.section.shape == (40, 30)
    assert app.source is None
    app.close()
    assert not path.parent.exists()


def test_files_of_the_folder_that_is_typed_are_offered(tmp_path, monkeypatch):
    (tmp_path / "data").mkdir()
    for name in ("b.SGY", "<b>.png", "notes.pdf", ".hidden.sgy", "data/line.sgy"):
        (tmp_path / name).touch()
    monkeypatch.chdir(tmp_path)
    field = FileField("path", ".sgy,.png")
    assert field.text.options == ("<b>.png", "b.SGY", "data/")
    for typed in ("data", "data/", "data/nothing.sgy"):
        field.text.value = typed
        assert field.text.options == ("data/line.sgy",)
    for typed in ("nowhere/x", "~nobody-of-that-name/x", "\0/x"):
        field.text.value = typed
        assert field.text.options == ()


def test_an_upload_comes_piece_by_piece_whatever_gets_lost():
    field = FileField("path")
    assert send(field, "line.sgy", b"abcdefgh", piece=3) == [0, 3, 6, None]
    first = Path(field.path)
    assert first.read_bytes() == b"abcdefgh"
    assert field.is_uploaded
    asked = []
    field.upload.send = asked.append
    message(field, "begin", "x", name="line.sgy", size=6)
    for start in (0, 0, 3):  # the second one was sent again, though it had come
        message(field, "piece", "x", b"123", start=start)
    assert [answer["next"] for answer in asked] == [0, 3, 3, None]
    assert first.read_bytes() == b"123123"
    field.text.value = "typed.sgy"
    assert (field.path, field.is_uploaded) == ("typed.sgy", False)
    assert field.status.layout.display == "none"
    field.end()
    assert not first.parent.exists()


def test_an_upload_that_is_given_up_leaves_what_was_there(monkeypatch):
    field = FileField("path")
    send(field, "line.sgy", b"abc")
    path = Path(field.path)
    field.upload.send = lambda answer: None
    message(field, "begin", "x", name="line.sgy", size=9)
    message(field, "piece", "x", b"123", start=0)
    message(field, "stop", "x", reason="")
    message(field, "piece", "x", b"456", start=3)
    assert field.error == "'line.sgy' was not uploaded"
    assert field.path == str(path)
    assert path.read_bytes() == b"abc"
    assert list(path.parent.iterdir()) == [path]
    monkeypatch.setattr("seiswidgets.widgets.files.upload.MOST", 2)
    assert send(field, "long.sgy", b"abc") == [None]
    assert "it has 3 bytes, more than 2" in field.error
    field.end()


def test_an_upload_on_a_full_disk_is_said(monkeypatch):
    field = FileField("path")

    class Full(io.BytesIO):
        name = "full"

        def write(self, piece):
            raise OSError(28, "No space left on device")

    monkeypatch.setattr(Path, "open", lambda *_, **__: Full())
    assert send(field, "line.sgy", b"abc") == [0, None]
    assert "'line.sgy' was not uploaded: it cannot be stored: No space left on device" in field.error
    field.end()


def take(picks, path):
    """Import picks, and give back what is said."""
    picks.file.text.value = str(path)
    picks.import_button.click()
    assert picks.wait(LONG)
    return picks.notice.text


@pytest.mark.parametrize("suffix", ["geojson", "csv"])
def test_picks_go_out_and_come_in(restored, case, tmp_path, suffix):
    picks = restored.files.picks
    picks.out.value = str(tmp_path / f"picks.{suffix}")
    picks.write()
    assert picks.notice.text == f"Wrote 1 fault and 3 horizons to {picks.out.value}."
    restored.interpretation = sw.Interpretation()
    picks.write()
    assert "exists already" in picks.notice.text
    answer(picks.notice, "Leave it")
    assert take(picks, picks.out.value) == "Read 1 fault and 3 horizons; Undo brings the earlier picks back."
    (fault,) = restored.interpretation.faults
    np.testing.assert_array_equal(fault.points, case.interpretation.faults[0].points)
    restored.picker.editor.undo()
    restored.picker.refresh()
    assert restored.interpretation.faults == ()
    picks.write()
    answer(picks.notice, "Replace it")
    picks.keep.value = False
    assert take(picks, picks.out.value) == "Read 0 faults and 0 horizons; Undo brings the earlier picks back."


def test_picks_that_are_drawn_stay_beside_those_of_a_file(app, tmp_path):
    old, other, new = (
        sw.Fault([(x, 100.0), (x, 900.0)], name) for x, name in ((500.0, "A"), (900.0, "B"), (700.0, "A"))
    )
    app.interpretation = sw.Interpretation([old, other])
    app.picker.editor.recolour("fault", "A", "#123456")
    app.picker.refresh()
    sw.write_picks(sw.Interpretation([new]), tmp_path / "picks.csv", app.section)
    take(app.files.picks, tmp_path / "picks.csv")
    assert [pick.name for pick in app.picker.drawing.picks] == ["A", "B"]
    assert app.picker.drawing.picks[0].colour == "#123456"
    np.testing.assert_array_equal(app.interpretation.faults[0].points, new.points)
    app.files.picks.keep.value = False
    take(app.files.picks, tmp_path / "picks.csv")
    assert [pick.name for pick in app.picker.drawing.picks] == ["A"]


def test_what_an_export_does_not_say_is_asked_for(app, tmp_path):
    (tmp_path / "export.txt").write_text("-> \n100 0 200\n300 0 260\n-> \n500 0 290\n")
    picks = app.files.picks
    assert picks.map_fields.layout.display == "none"
    assert "export.txt: its suffix does not tell its format; give “format”" in take(picks, tmp_path / "export.txt")
    picks.format.value = "cps3-horizons"
    assert picks.map_fields.layout.display == ""
    assert picks.x_unit.options[0][0] == "choose: not in the file"
    assert "choose what “x comes from”" in take(picks, tmp_path / "export.txt")
    picks.along.value = "x"
    assert "does not state its x_unit; give “unit of x”" in take(picks, tmp_path / "export.txt")
    picks.x_unit.value = picks.z_unit.value = "m"
    assert "Read 0 faults and 1 horizon;" in take(picks, tmp_path / "export.txt")
    assert "left out" in picks.notice.text
    np.testing.assert_array_equal(app.interpretation.horizons[0].pieces[0], [[100, 200], [300, 260]])
    assert "give the path" in take(picks, "")


def test_what_is_not_chosen_any_more_is_shown(app):
    picks = app.files.picks
    for chooser in (picks.format, picks.x_unit, picks.z_unit, picks.along):
        chooser.index = 2
        chooser.index = 0  # as a page tells it
        assert chooser.index == 0


def test_places_on_a_map_are_taken_along_the_line_of_the_section(app, tmp_path):
    path, export = tmp_path / "line.sgy", tmp_path / "export.txt"
    headers = [{181: 1000 + 3 * trace, 185: 500 + 4 * trace} for trace in range(20)]
    path.write_bytes(segy_bytes(np.random.default_rng(0).normal(size=(20, 40)).astype(np.float32), headers))
    export.write_text("-> \n1006 508 20\n1030 540 60\n")
    picks = app.files.picks
    picks.format.value, picks.x_unit.value, picks.z_unit.value = "cps3-horizons", "m", "ms"
    picks.along.value = "segy"
    assert "does not come from a SEG-Y file" in take(picks, export)
    load(app, path)
    assert "Read 0 faults and 1 horizon;" in take(picks, export)
    np.testing.assert_allclose(app.interpretation.horizons[0].pieces[0], [[10, 20], [50, 60]])
    picks.along.value = "points"
    assert "two or more X Y, as in" in take(picks, export)
    picks.points.value = "1003 504; 1057, 576"
    assert "Read 0 faults and 1 horizon;" in take(picks, export)
    np.testing.assert_allclose(app.interpretation.horizons[0].pieces[0], [[5, 20], [45, 60]])
    load(app, path, dx="7")
    answer(app.files.section.notice, "Drop the picks")
    picks.along.value = "segy"
    assert "were not used for the section" in take(picks, export)


def test_an_import_can_be_cancelled(app, tmp_path, monkeypatch):
    begun, go_on = threading.Event(), threading.Event()

    def slow(*_, **__):
        begun.set()
        go_on.wait(LONG)
        return sw.Interpretation([sw.Fault([(0.0, 0.0), (100.0, 100.0)])])

    monkeypatch.setattr(picks_files, "read_picks", slow)
    picks = app.files.picks
    picks.file.text.value = "picks.csv"
    picks.read()
    assert begun.wait(LONG)
    picks.job.cancel_button.click()
    go_on.set()
    assert picks.wait(LONG)
    assert "The import was cancelled" in picks.notice.text
    assert app.interpretation.faults == ()


def test_trouble_with_picks_is_said_beside(app, tmp_path):
    picks = app.files.picks
    assert "there is no file" in take(picks, tmp_path / f"{HOSTILE.replace('/', '')}.csv")
    assert "<img" not in picks.notice.line.value


def test_all_results_are_written_and_open_again(restored, tmp_path):
    restored.picker.editor.recolour("fault", "F1", "#123456")
    results = restored.files.results
    results.folder.value = str(tmp_path / "out")
    for box in results.kinds.values():
        box.value = True
    results.export()
    assert results.wait(LONG)
    assert f"Wrote into {tmp_path / 'out'}: faulted fold-restored.npz, " in results.notice.text
    assert [path.parent for path in results.written] == [tmp_path / "out"] * len(results.kinds)
    written = {path.name.split("-")[-1]: path for path in results.written}
    section = restored.restoration.section
    np.testing.assert_array_equal(sw.open_section(written["restored.npz"]).amplitude, section.amplitude)
    assert sw.preview(written["restored.sgy"]).shape == section.shape
    assert written["figure.png"].read_bytes().startswith(b"\x89PNG")
    assert written["storyboard.png"].read_bytes().startswith(b"\x89PNG")
    assert "<svg" in written["figure.svg"].read_text()
    assert len(meshio.read(written["mesh.vtu"]).points) == len(restored.restoration.stages[-1].vertices)
    assert len(json.loads(written["report.json"].read_text())["stages"]) == 2
    assert "<!DOCTYPE html>" in written["report.html"].read_text()
    assert "stroke: #123456" in written["figure.svg"].read_text()  # the colour that F1 has in the app
    assert '"colour":"#123456"' in written["handout.html"].read_text("utf-8")
    with xarray.open_dataset(written["displacement.nc"]) as fields:
        assert "displacement_x" in fields
    assert plt.get_fignums() == []
    before = {path: path.stat().st_mtime_ns for path in results.written}
    choose_results(results, "report.json", "report.html")
    results.export()
    assert "These files exist already: faulted fold-report.json, faulted fold-report.html." in results.notice.text
    answer(results.notice, "Leave them")
    assert {path: path.stat().st_mtime_ns for path in before} == before
    results.export()
    answer(results.notice, "Replace them")
    assert results.wait(LONG)
    assert sum(path.stat().st_mtime_ns != time for path, time in before.items()) == 2
    assert not list((tmp_path / "out").glob(".*"))


def choose_results(results, *endings):
    for ending, box in results.kinds.items():
        box.value = ending in endings


def test_measures_are_exported_as_tables_with_units(restored, tmp_path):
    results = restored.files.results
    results.folder.value = str(tmp_path / "out")
    choose_results(results, "throw.csv", "growth.csv", "balance.csv", "extension.csv")
    results.export()
    assert results.wait(LONG)
    heads = {path.name.rpartition("-")[2]: path.read_text().splitlines()[0] for path in results.written}
    assert heads["throw.csv"] == "fault,horizon,age (Ma),depth (m),throw (m),heave (m),slip (m)"
    assert len(heads) == 4


def export_reports(app, folder):
    """Begin to export both reports into a folder."""
    results = app.files.results
    results.folder.value = str(folder)
    choose_results(results, "report.json", "report.html")
    results.export()
    return results


def test_an_export_runs_beside_and_is_cancelled_between_files(restored, tmp_path, monkeypatch):
    begun, go_on = threading.Event(), threading.Event()
    kind, write = result_files.WRITERS["report.json"]

    def slow(result, path):
        begun.set()
        go_on.wait(LONG)
        write(result, path)

    monkeypatch.setitem(result_files.WRITERS, "report.json", (kind, slow))
    results = export_reports(restored, tmp_path)
    assert begun.wait(LONG)
    assert results.notice.text == "Writing faulted fold-report.json ..."
    assert results.export_button.disabled
    restored.interpretation = sw.Interpretation()  # goes on, and does not change what is written
    results.job.cancel_button.click()
    go_on.set()
    assert results.wait(LONG)
    assert results.notice.text == f"The export was cancelled. Wrote into {tmp_path}: faulted fold-report.json."
    assert [path.name for path in tmp_path.iterdir()] == ["faulted fold-report.json"]
    assert len(json.loads(results.written[0].read_text())["stages"]) == 2
    assert not results.export_button.disabled


def test_one_file_that_cannot_be_written_keeps_no_other_from_it(restored, tmp_path, monkeypatch):
    kind, _ = result_files.WRITERS["report.json"]

    def fail(result, path):
        raise DataError(f"{path} cannot be written: give ", Keyword("x_unit"))

    monkeypatch.setitem(result_files.WRITERS, "report.json", (kind, fail))
    results = export_reports(restored, tmp_path)
    assert results.wait(LONG)
    assert "report.json cannot be written: give “unit of x”. Wrote into" in results.notice.text
    assert [path.name for path in results.written] == ["faulted fold-report.html"]


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
    choose_results(results, "restored.sgy")
    results.export()
    assert results.wait(LONG)
    with segyio.open(results.written[0], ignore_geometry=True) as file:
        assert set(file.attributes(189)[:]) == {11}


def test_results_say_what_they_need(restored, tmp_path):
    results = restored.files.results
    for folder, stem, match in (
        ("", "", "give the folder for the files"),
        (str(tmp_path / "none" / "out"), "", "The folder"),
        ("~nobody-of-that-name/out", "", "home"),
        (str(tmp_path), "../up", "a name without folders"),
        (str(tmp_path), "..", "a name without folders"),
    ):
        results.folder.value, results.stem.value = folder, stem
        results.export_button.click()
        assert match in results.notice.text
    choose_results(results)
    with pytest.raises(SettingError, match="choose what to export"):
        results.export()
    assert list(tmp_path.iterdir()) == []


def test_without_a_restoration_there_is_nothing_to_export(app, tmp_path):
    app.files.results.folder.value = str(tmp_path)
    with pytest.raises(SettingError, match="there is no result yet: restore first"):
        app.files.results.export()


def test_the_storyboard_that_is_exported_has_the_layers_of_the_plan(restored, tmp_path, monkeypatch):
    layers, told = sw.Stratigraphy([sw.Layer(None, 0.0), sw.Layer("H1", 5.0)]), []
    restored.live = False
    restored.workspace.change_plan("stratigraphy", stratigraphy=layers)
    draw = result_files.plot.storyboard
    monkeypatch.setattr(result_files.plot, "storyboard", lambda *all, **look: told.append(look) or draw(*all, **look))
    results = restored.files.results
    results.folder.value = str(tmp_path)
    choose_results(results, "storyboard.png")
    results.export()
    assert results.wait(LONG)
    assert [path.name for path in results.written] == ["faulted fold-storyboard.png"]
    assert told[0]["stratigraphy"] is layers
