import errno
import os

import numpy as np
import pytest
import segyio

import seiswidgets as sw
from tests.io.restored import restored
from tests.io.segyfiles import numbered, segy_bytes, straight, volume_headers
from tests.io.test_segy import alaska

FIELDS = ("dx", "dz", "x0", "z0", "x_unit", "z_unit", "velocity", "name", "credit")


@pytest.mark.parametrize("time", [False, True])
def test_an_npz_keeps_all_of_a_section(tmp_path, time):
    section = restored(time).section
    sw.save_section(restored(time), tmp_path / "line.npz")
    again = sw.open_section(tmp_path / "line.npz")
    np.testing.assert_array_equal(again.amplitude, section.amplitude)
    assert again.amplitude.dtype == section.amplitude.dtype
    assert [getattr(again, name) for name in FIELDS] == [getattr(section, name) for name in FIELDS]
    assert sw.preview(tmp_path / "line.npz").needed == ()


def test_choices_count_over_an_npz(tmp_path):
    sw.save_section(restored(True), tmp_path / "line.npz")
    again = sw.open_section(tmp_path / "line.npz", velocity=2500, dx=7)
    assert (again.velocity, again.dx, again.z_unit) == (2500, 7, "ms")
    assert sw.open_section(tmp_path / "line.npz", z_unit="m").velocity is None


@pytest.mark.parametrize("time", [False, True])
def test_segy_opens_again_with_the_same_numbers(tmp_path, time):
    section, path = restored(time).section, tmp_path / "line.sgy"
    sw.save_section(restored(time), path)
    expected = np.nan_to_num(section.amplitude.astype(np.float32))
    again = sw.open_section(path, z_unit=section.z_unit, velocity=section.velocity, x0=section.x0)
    np.testing.assert_array_equal(again.amplitude, expected)
    assert again.extent == pytest.approx(section.extent)
    with segyio.open(path, ignore_geometry=True) as file:
        np.testing.assert_array_equal(file.trace.raw[:].T, expected)
        np.testing.assert_allclose(file.samples, section.z)
        assert int(file.format) == segyio.SegySampleFormat.IEEE_FLOAT_4_BYTE
        x = file.attributes(181)[:] / -file.attributes(71)[0]
        np.testing.assert_allclose(x, section.x, atol=1e-3)
        dead = np.isnan(section.amplitude).all(axis=0)
        np.testing.assert_array_equal(file.attributes(29)[:], np.where(dead, 2, 1))


def test_segy_says_that_it_is_no_measurement(tmp_path):
    sw.save_section(restored(), tmp_path / "line.sgy")
    header = sw.preview(tmp_path / "line.sgy").header
    assert "RESTORED BY SEISWIDGETS" in header
    assert "NOT A MEASUREMENT" in header
    assert "flatten H1" in header
    assert all(line.startswith(f"C{number:02}") for number, line in enumerate(header.splitlines(), 1))
    sw.save_section(restored().original, tmp_path / "line.sgy")
    assert "RESTORED" not in sw.preview(tmp_path / "line.sgy").header


def test_a_name_cannot_break_the_textual_header(tmp_path):
    section = sw.Section(np.ones((2, 2)), 25, 4, name="é\x1b\nC03 MEASURED".ljust(100, "."))
    sw.save_section(section, tmp_path / "line.sgy")
    lines = sw.preview(tmp_path / "line.sgy").header.split("\n")
    assert lines[1].startswith("C02 ZERO WHERE THERE ARE NO DATA. SECTION: ?  C03 MEASURED..")
    assert [line[:3] for line in lines] == [f"C{number:02}" for number in range(1, 41)]


def test_the_real_lines_headers_are_carried_over(tmp_path):
    section, path = sw.open_section(alaska(), dx=33.5, velocity=3000), tmp_path / "line.sgy"
    sw.save_section(section, path, like=alaska())
    with segyio.open(alaska(), ignore_geometry=True) as before, segyio.open(path, ignore_geometry=True) as after:
        np.testing.assert_array_equal(after.trace.raw[:], before.trace.raw[:])
        for byte in (1, 5, 9, 21, 181, 189, 197, 201):
            np.testing.assert_array_equal(after.attributes(byte)[:], before.attributes(byte)[:])
    before, after = (sw.preview(at).header.splitlines() for at in (alaska(), path))
    changed = [number for number, pair in enumerate(zip(before, after, strict=True)) if pair[0] != pair[1]]
    assert [before[number] for number in changed] == ["C10", "C11"]
    assert "NOT A MEASUREMENT" in after[changed[0]]


@pytest.mark.parametrize("endian", ["big", "little"])
def test_traces_beyond_the_ends_continue_the_line(tmp_path, endian):
    like, path = tmp_path / "before.sgy", tmp_path / "after.sgy"
    headers = [header | {21: 50 + 2 * n, 9: 7, 71: -10, 115: 4} for n, header in enumerate(straight(4, step=250))]
    like.write_bytes(segy_bytes(np.ones((4, 3)), headers, endian=endian))
    sw.save_section(sw.Section(np.ones((3, 8)), dx=25, dz=4, x0=-50), path, like=like)
    with segyio.open(path, ignore_geometry=True) as file:
        np.testing.assert_array_equal(file.attributes(181)[:], 1000 + 250 * np.arange(-2, 6))
        np.testing.assert_array_equal(file.attributes(185)[:], 500)
        np.testing.assert_array_equal(file.attributes(21)[:], 50 + 2 * np.arange(-2, 6))
        np.testing.assert_array_equal(file.attributes(9)[:], 7)
        np.testing.assert_array_equal(file.attributes(71)[:], -10)
    assert sw.open_section(path, z_unit="m").dx == 25


def test_numbers_that_become_too_large_beyond_the_ends_are_refused(tmp_path):
    headers = [header | {21: 2**31 - 3 + n} for n, header in enumerate(straight(3))]
    (tmp_path / "before.sgy").write_bytes(segy_bytes(np.ones((3, 3)), headers))
    with pytest.raises(sw.SettingError, match=r"after.sgy: the numbers .* are too large for SEG-Y; leave out like="):
        sw.save_section(sw.Section(np.ones((3, 6)), 25, 4), tmp_path / "after.sgy", like=tmp_path / "before.sgy")
    with pytest.raises(sw.DataError, match=r"none.sgy does not exist"):
        sw.save_section(sw.Section(np.ones((3, 6)), 25, 4), tmp_path / "after.sgy", like=tmp_path / "none.sgy")
    assert os.listdir(tmp_path) == ["before.sgy"]


def test_the_binary_header_is_carried_over(tmp_path):
    said = {3203: 7, 3207: 31, 3211: 5, 3229: 4, 3255: 2}
    (tmp_path / "before.sgy").write_bytes(segy_bytes(np.ones((3, 3)), straight(3), code=3, binary=said))
    section = sw.open_section(tmp_path / "before.sgy", z_unit="ft")
    sw.save_section(section, tmp_path / "after.sgy", like=tmp_path / "before.sgy")
    with segyio.open(tmp_path / "after.sgy", ignore_geometry=True) as file:
        assert [file.bin[byte] for byte in (3201, 3205, 3209, 3229, 3255, 3225)] == [7, 31, 5, 4, 2, 5]


def test_a_link_is_followed(tmp_path):
    (tmp_path / "line.npz").symlink_to(tmp_path / "real.npz")
    sw.save_section(sw.Section(np.ones((3, 6)), 25, 4), tmp_path / "line.npz")
    assert (tmp_path / "line.npz").is_symlink()
    assert sw.open_section(tmp_path / "real.npz").shape == (3, 6)


def test_the_headers_of_a_line_of_a_volume_are_carried_over(tmp_path):
    headers = volume_headers([10, 11, 12], [201, 203, 205])
    (tmp_path / "volume.sgy").write_bytes(segy_bytes(numbered(headers), headers))
    section = sw.open_section(tmp_path / "volume.sgy", inline=11, z_unit="m")
    sw.save_section(section, tmp_path / "line.sgy", like=tmp_path / "volume.sgy", inline=11)
    with segyio.open(tmp_path / "line.sgy", ignore_geometry=True) as file:
        np.testing.assert_array_equal(file.attributes(189)[:], 11)
        np.testing.assert_array_equal(file.attributes(193)[:], [201, 203, 205])


def test_headers_without_a_free_line_lose_their_last_ones(tmp_path):
    full = "".join(f"C{number:02} TAKEN".ljust(80) for number in range(1, 41))
    (tmp_path / "before.sgy").write_bytes(segy_bytes(np.ones((2, 3)), straight(2), text=full))
    sw.save_section(sw.Section(np.ones((3, 2)), 25, 4), tmp_path / "after.sgy", like=tmp_path / "before.sgy")
    lines = sw.preview(tmp_path / "after.sgy").header.splitlines()
    assert lines[37] == "C38 TAKEN"
    assert "NOT A MEASUREMENT" in lines[38]


@pytest.mark.parametrize(
    ("z_unit", "dz", "z0"), [("ms", 0.5, 1.25), ("s", 0.004, -0.1), ("km", 0.005, 0.03), ("ft", 10, 5)]
)
def test_units_come_back(tmp_path, z_unit, dz, z0):
    velocity = 2000 if z_unit in ("ms", "s") else None
    x_unit = {"km": "km", "ft": "ft"}.get(z_unit, "m")
    dx = 0.025 if x_unit == "km" else 25
    section = sw.Section(np.ones((3, 4)), dx, dz, 3, z0, x_unit=x_unit, z_unit=z_unit, velocity=velocity)
    sw.save_section(section, tmp_path / "line.sgy")
    again = sw.open_section(tmp_path / "line.sgy", z_unit=z_unit, velocity=velocity)
    assert (again.dz, again.z0) == pytest.approx((dz, z0))
    assert again.x_unit == ("ft" if z_unit == "ft" else "m")
    assert again.dx == pytest.approx(25)


def test_a_saved_file_is_of_revision_1(tmp_path):
    sw.save_section(sw.Section(np.ones((3, 4)), 25, 4), tmp_path / "line.sgy")
    assert (tmp_path / "line.sgy").read_bytes()[3500:3502] == b"\1\0"


@pytest.mark.parametrize(
    ("fields", "message"),
    [
        ({"dz": 1 / 3}, r"whole thousandths, but this section has 0.333333 m"),
        ({"dz": 40}, r"from 0.001 to 32.767"),
        ({"amplitude": np.ones((70_000, 2))}, "65,535 samples per trace, of up to 3.4e38, but this section has 70,000"),
        ({"amplitude": np.full((3, 4), 1e39)}, "65,535 samples per trace, of up to 3.4e38, .* of up to 1e\\+39"),
        ({"z0": 1e6}, r"cannot hold a first sample at 1e\+06 m"),
        ({"x0": 1e10}, r"cannot hold positions as far out as 1e\+10 m"),
    ],
)
def test_what_segy_cannot_hold_is_said(tmp_path, fields, message):
    section = sw.Section(**{"amplitude": np.ones((3, 4)), "dx": 25, "dz": 4} | fields)
    with pytest.raises(sw.SettingError, match=message + ".*save it as .npz"):
        sw.save_section(section, tmp_path / "line.sgy")
    assert not os.listdir(tmp_path)


def test_what_stood_there_stays_when_writing_fails(tmp_path, monkeypatch):
    path = tmp_path / "line.sgy"
    path.write_text("before")

    def full(*_):
        raise OSError(errno.ENOSPC, "No space left on device")

    monkeypatch.setattr("seiswidgets.io.segy.writing._textual_header", full)
    with pytest.raises(sw.DataError, match=r"line.sgy cannot be written: No space left.*Any older file .* unchanged"):
        sw.save_section(restored(), path)
    assert path.read_text() == "before"
    assert os.listdir(tmp_path) == ["line.sgy"]


def test_a_folder_that_is_not_there(tmp_path):
    with pytest.raises(sw.DataError, match=r"line.npz cannot be written: No such file"):
        sw.save_section(restored(), tmp_path / "none" / "line.npz")


def test_another_ending_is_refused(tmp_path):
    with pytest.raises(sw.SettingError, match=r"line.dat must end in .sgy or .segy or .npz"):
        sw.save_section(restored(), tmp_path / "line.dat")
    with pytest.raises(sw.SettingError, match="leave like= and its line out"):
        sw.save_section(restored(), tmp_path / "line.npz", like="before.sgy")


def test_something_else_is_refused(tmp_path):
    with pytest.raises(sw.SettingError, match="takes a Section or a Restoration, but got a ndarray"):
        sw.save_section(np.ones((2, 2)), tmp_path / "line.npz")


@pytest.mark.parametrize("like", [None, "big", "little", "revision 0"])
def test_segy_has_the_bytes_of_revision_1_whatever_it_comes_from(tmp_path, like):
    if like is not None:
        binary = dict.fromkeys(range(3501, 3600, 2), 0x2020) if like == "revision 0" else {3501: 0x100, 3505: 0}
        endian = "little" if like == "little" else "big"
        (tmp_path / "like.sgy").write_bytes(segy_bytes(np.ones((9, 8)), straight(9), 5, endian, binary=binary))
        section, choices = sw.open_section(tmp_path / "like.sgy", velocity=2000), {"like": tmp_path / "like.sgy"}
    else:
        section, choices = sw.Section(np.ones((8, 9)), dx=25, dz=4), {}
    sw.save_section(section, tmp_path / "out.sgy", **choices)
    assert (tmp_path / "out.sgy").read_bytes()[3500:3506] == b"\1\0\0\1\0\0"
    assert sw.open_section(tmp_path / "out.sgy", velocity=2000).dx == 25
