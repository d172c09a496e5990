import gzip
import sys
import zipfile

import numpy as np
import pytest

import seiswidgets as sw
from tests.io.segyfiles import segy_bytes, straight
from tests.leftovers import nothing_left


@pytest.mark.parametrize("act", [sw.preview, lambda path: sw.open_section(path, z_unit="m")])
@pytest.mark.parametrize(
    ("name", "content", "message"),
    [
        ("gone.sgy", None, r"gone.sgy does not exist"),
        ("", None, r"is a folder; give the path of a file"),
        ("empty.npy", b"", r"empty.npy is empty"),
        ("scan.png", b"no picture", r"scan.png has the suffix .png, but does not begin like such a file"),
        ("line.npz", b"no archive", r"line.npz has the suffix .npz, but does not begin like such a file"),
        ("unknown", b"\x7fELF" * 2000, r"unknown is in an unsupported file format; convert it"),
    ],
)
def test_a_file_that_cannot_be(tmp_path, act, name, content, message):
    if content is not None:
        (tmp_path / name).write_bytes(content)
    with pytest.raises(sw.DataError, match=message):
        act(tmp_path / name)


def test_a_path_may_begin_with_the_home_folder(tmp_path, monkeypatch):
    monkeypatch.setenv("HOME", str(tmp_path))
    monkeypatch.setenv("USERPROFILE", str(tmp_path))
    section = sw.Section(np.ones((2, 3)), 1, 1)
    session = sw.Session.of(section, sw.SectionSource("file", str(tmp_path / "line.npz")), sw.Interpretation())
    sw.save_section(section, "~/line.npz")
    sw.write_picks(sw.Interpretation(), "~/picks.csv", section)
    session.save("~/session.json")
    assert sw.open_section("~/line.npz").shape == (2, 3)
    assert sw.read_picks("~/picks.csv", section).faults == ()
    assert sw.open_session("~/session.json") == session
    for act in (sw.preview, sw.open_session, lambda path: sw.save_section(section, path)):
        with pytest.raises(sw.DataError, match=r"'~nobody-of-this-name/line.npz' cannot be the path of a file"):
            act("~nobody-of-this-name/line.npz")


def test_a_path_may_be_a_string_and_the_suffix_in_capitals(tmp_path):
    path = tmp_path / "LINE.SGY"
    path.write_bytes(segy_bytes(np.ones((2, 3)), straight(2)))
    assert sw.open_section(str(path), z_unit="m").name == "LINE"


def test_segy_is_known_without_a_suffix(tmp_path):
    (tmp_path / "line").write_bytes(segy_bytes(np.ones((2, 3)), straight(2)))
    assert sw.preview(tmp_path / "line").kind == "SEG-Y"


def test_a_misspelt_choice_is_an_error(tmp_path):
    with pytest.raises(TypeError, match="open_section has no keyword velocty=; did you mean velocity="):
        sw.open_section(tmp_path, velocty=2000)


@pytest.mark.parametrize("chosen", [{"dx": -5, "dz": 1}, {"dx": 1, "dz": "one"}])
def test_spacings_that_are_none(tmp_path, chosen):
    np.save(tmp_path / "line.npy", np.ones((2, 2)))
    with pytest.raises(sw.SettingError, match=r"must be (above 0|a finite number)"):
        sw.open_section(tmp_path / "line.npy", z_unit="m", **chosen)


def test_a_missing_package_is_named(monkeypatch):
    monkeypatch.setitem(sys.modules, "xarray", None)
    with pytest.raises(sw.DataError, match=r"requires .* xarray.*pip install xarray.*seiswidgets\[files\]"):
        sw.to_xarray(sw.Section(np.ones((2, 3)), 25, 4))


def test_segy_is_read_and_written_without_segyio(tmp_path, monkeypatch):
    (tmp_path / "line.sgy").write_bytes(segy_bytes(np.ones((2, 3)), straight(2)))
    monkeypatch.setitem(sys.modules, "segyio", None)
    section = sw.open_section(tmp_path / "line.sgy", z_unit="m")
    sw.save_section(section, tmp_path / "again.sgy", like=tmp_path / "line.sgy")
    assert sw.open_section(tmp_path / "again.sgy", z_unit="m").shape == (3, 2)


def test_no_file_stays_open(tmp_path):
    (tmp_path / "line.sgy").write_bytes(segy_bytes(np.ones((2, 3)), straight(2)))
    np.savez(tmp_path / "line.npz", a=np.ones((2, 2)))
    with nothing_left():
        sw.open_section(tmp_path / "line.sgy", z_unit="m")
        with pytest.raises(sw.SettingError, match="inline 5"):
            sw.open_section(tmp_path / "line.sgy", z_unit="m", inline=5)
        sw.open_section(tmp_path / "line.npz", z_unit="m", dx=1, dz=1)


@pytest.mark.parametrize(
    ("name", "members", "match"),
    [
        (
            "line.zip",
            ["line.sgy"],
            r"line.zip is a zip archive; unzip it, and open .*: 'line.sgy'$",
        ),
        ("a.sgy", ["__a/", "a.sgy", "b.sgy", "c.sgy", "d.txt"], r"unzip it.* 'a.sgy', 'b.sgy', 'c.sgy', \.\.\.$"),
        ("line.npz", ["line.png"], r"line.npz is a zip archive; unzip it"),
    ],
)
def test_a_zip_says_unzip_it(tmp_path, name, members, match):
    with zipfile.ZipFile(tmp_path / name, "w") as archive:
        for member in members:
            archive.writestr(member, b"content")
    for act in (sw.preview, sw.open_section):
        with pytest.raises(sw.DataError, match=match):
            act(tmp_path / name)


@pytest.mark.parametrize(
    ("name", "content"), [("a.sgy.gz", gzip.compress(b"a", mtime=0)), ("a.7z", b"7z\xbc\xaf\x27\x1c12")]
)
def test_other_archives_say_unpack(tmp_path, name, content):
    (tmp_path / name).write_bytes(content)
    with pytest.raises(sw.DataError, match=r"is packed with (gzip|7-Zip); unpack it"):
        sw.preview(tmp_path / name)


@pytest.mark.parametrize(("headers", "rows"), [([{181: 25 * n} for n in range(9)], 3), ([{}] * 9, 4)])
def test_a_preview_prints_a_few_lines_without_the_textual_header(tmp_path, headers, rows):
    (tmp_path / "line.sgy").write_bytes(segy_bytes(np.ones((9, 4)), headers))
    info = sw.preview(tmp_path / "line.sgy")
    printed = repr(info)
    assert printed.startswith("line.sgy: SEG-Y (IEEE float, 4 bytes, big-endian)")
    assert "9 traces of 4 samples" in printed
    assert "A LINE" in info.header
    assert "A LINE" not in printed
    assert rows <= len(printed.splitlines()) <= 8
