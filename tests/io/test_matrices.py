import os
import subprocess
import sys
import zipfile
from pathlib import Path

import numpy as np
import pytest

import seiswidgets as sw

MATRIX = np.array([[1, 2.5, -3], [4, np.nan, 6]])
AXES = {"dx": 10, "dz": 5, "z_unit": "m"}


def npy(path, array, **choices):
    np.save(path, array, **choices)
    return path


def npz(path, **arrays):
    np.savez(path, **arrays)
    return path


def text(path, content, encoding="utf-8"):
    path.write_text(content, encoding=encoding)
    return path


@pytest.mark.parametrize(
    ("dtype", "order"),
    [("<f8", "C"), (">f8", "F"), ("f4", "F"), ("f2", "C"), ("i2", "C"), (">i4", "F"), ("u1", "F"), ("?", "C")],
)
def test_arrays_of_any_real_kind(tmp_path, dtype, order):
    array = np.asarray(np.arange(12).reshape(3, 4) % 7, dtype, order=order)
    section = sw.open_section(npy(tmp_path / "line.npy", array), **AXES)
    np.testing.assert_array_equal(section.amplitude, array.astype(float))
    assert section.amplitude.dtype.isnative
    assert (section.dx, section.dz, section.x0, section.z0) == (10, 5, 0, 0)


def test_an_extent_will_do_for_spacing(tmp_path):
    section = sw.open_section(npy(tmp_path / "line.npy", MATRIX), extent=(10, 30, 100, 104), velocity=2000)
    assert (section.dx, section.dz, section.extent, section.z_unit) == (10, 4, (10, 30, 100, 104), "ms")


def test_an_npz_with_one_matrix(tmp_path):
    section = sw.open_section(npz(tmp_path / "line.npz", picture=MATRIX, times=np.arange(3)), **AXES)
    np.testing.assert_array_equal(section.amplitude, MATRIX)


@pytest.mark.parametrize("arrays", [{"a": MATRIX, "b": MATRIX}, {"a": MATRIX[0]}, {"a": np.array([["x", "y"]] * 2)}])
def test_an_npz_without_a_single_matrix_of_numbers(tmp_path, arrays):
    with pytest.raises(sw.DataError, match=r"line.npz must hold one matrix of real numbers.*, but holds a of shape"):
        sw.open_section(npz(tmp_path / "line.npz", **arrays), **AXES)


def test_beside_an_amplitude_only_its_place_is_read(tmp_path):
    beside = {"dates": np.array(["2020-01-01"], "M8[D]"), "notes": np.array({"by": "us"}, object), "name": 7}
    section = sw.open_section(npz(tmp_path / "line.npz", amplitude=MATRIX, **beside), **AXES)
    assert section.name == "7"
    np.testing.assert_array_equal(section.amplitude, MATRIX)


@pytest.mark.parametrize(
    ("stored", "needed"),
    [
        ({"dx": 1, "dz": 1, "z_unit": "m"}, ()),
        ({"dx": 1, "dz": 1, "z_unit": "ms", "velocity": 2000}, ()),
        ({"dx": 1, "dz": 1, "z_unit": "ms"}, ("z_unit or velocity",)),
        ({"dx": 1, "z_unit": "m"}, ("extent, or dx and dz",)),
    ],
)
def test_a_preview_asks_for_what_an_npz_does_not_say(tmp_path, stored, needed):
    assert sw.preview(npz(tmp_path / "line.npz", amplitude=MATRIX, **stored)).needed == needed


def test_an_error_in_what_is_stored_names_the_file(tmp_path):
    path = npz(tmp_path / "line.npz", amplitude=MATRIX, dx=-1, dz=1, z_unit="m")
    with pytest.raises(sw.SectionError, match=r"line.npz: dx must be above 0"):
        sw.open_section(path)


def test_a_cube_is_no_matrix_whatever_its_extent(tmp_path):
    with pytest.raises(sw.DataError, match=r"line.npz must hold a matrix .* of shape \(1, 2, 3\)"):
        sw.open_section(npz(tmp_path / "line.npz", amplitude=MATRIX[None]), extent=(0, 1, 0, 1), z_unit="m")


def test_integers_are_counted_as_the_floats_that_they_become(tmp_path, monkeypatch):
    monkeypatch.setattr("seiswidgets.io.options.MOST_BYTES", 100)
    with pytest.raises(sw.DataError, match=r"line.npy would make a section of 4 x 4 amplitudes"):
        sw.open_section(npy(tmp_path / "line.npy", np.ones((4, 4), np.int8)), **AXES)


def test_nothing_is_unpickled(tmp_path):
    class Trap:
        def __reduce__(self):
            return pytest.fail, ("unpickled",)

    trap = np.array([[Trap(), 1], [2, 3]], object)
    for path in (npy(tmp_path / "trap.npy", trap), npz(tmp_path / "trap.npz", amplitude=trap)):
        with pytest.raises(sw.DataError, match="holds object, not real numbers"):
            sw.open_section(path, **AXES)
        with pytest.raises(sw.DataError, match=r"holds object|real numbers"):
            sw.preview(path)


@pytest.mark.parametrize(
    "shape", ["(100000, 100000)", "(1000000000000, 1000000000000)", "(-3, -2)", "(3, 3)", "(2, 2)"]
)
def test_a_header_that_claims_another_size_is_refused(tmp_path, shape):
    path = npy(tmp_path / "line.npy", MATRIX)
    content = path.read_bytes()
    claimed = content[:128].replace(b"(2, 3)", shape.encode()).replace(b" " * (len(shape) - 6), b"", 1)[:127] + b"\n"
    path.write_bytes(claimed + content[128:])
    with pytest.raises(sw.DataError, match=r"line.npy .*(would make a section of|claims to hold)"):
        sw.open_section(path, **AXES)


def test_a_header_that_python_cannot_parse_is_refused(tmp_path):
    path = npy(tmp_path / "line.npy", MATRIX)
    path.write_bytes(path.read_bytes().replace(b"(2, 3)", b"(2, 3("))
    with pytest.raises(sw.DataError, match=r"line.npy is damaged, or not a matrix"):
        sw.open_section(path, **AXES)


def test_an_npz_that_would_unpack_to_too_much_is_refused_packed(tmp_path, monkeypatch):
    np.savez_compressed(tmp_path / "line.npz", amplitude=np.zeros((100, 100)))
    monkeypatch.setattr("seiswidgets.io.options.MOST_BYTES", 10_000)
    monkeypatch.setattr(zipfile.ZipFile, "open", lambda *_: pytest.fail("unpacked"))
    with pytest.raises(sw.DataError, match=r"line.npz would make a section of 80128 amplitudes"):
        sw.open_section(tmp_path / "line.npz", **AXES)


@pytest.mark.parametrize(
    "content",
    ["1 2.5 -3\n4 nan 6\n", "# x\n1,2.5,-3\n\n4,nan,6", "1;2.5;-3\r\n4;NaN;6", "1\t2.5\t-3 # one\n4\tnan\t6\n"],
)
def test_text_of_every_delimiter(tmp_path, content):
    for encoding in ("utf-8", "utf-8-sig"):
        path = text(tmp_path / "line.txt", content, encoding)
        np.testing.assert_array_equal(sw.open_section(path, **AXES).amplitude, MATRIX)
        info = sw.preview(path)
        assert (info.kind, info.shape) == ("text", (2, 3))


def test_text_is_known_without_a_suffix(tmp_path):
    assert sw.preview(text(tmp_path / "line.dat", "1 2\n3 4\n")).kind == "text"


@pytest.mark.parametrize(
    ("content", "encoding", "message"),
    [
        ("# m\n1 2\n3\n", "utf-8", ": row 3 has 1 values, and those before it 2; write .* decimal point"),
        ("one two\n3 4\n", "utf-8", ": row 1, value 1 must be a number, but is 'one'; write "),
        ("\n1,5;2,5\n3,5;4,5\n", "utf-8-sig", ": row 2, value 1 must be a number, but is '1,5'; write "),
        (
            "1,,3\n4,5,6\n",
            "utf-8",
            ": row 1, value 2 must be a number, but is ''; write .* nan where there are no data",
        ),
        ("1 2\n3 4 é", "latin-1", " is damaged, or not a matrix of numbers: .* in UTF-8"),
        ("1 2\n3 4", "utf-16", " is damaged, or not a matrix of numbers: .* in UTF-8"),
        ("#", "utf-8", " must hold a matrix"),
    ],
)
def test_text_that_is_no_matrix(tmp_path, content, encoding, message):
    with pytest.raises(sw.DataError, match=f"line.txt{message}"):
        sw.open_section(text(tmp_path / "line.txt", content, encoding), **AXES)


def test_a_text_in_one_row_is_refused_before_it_is_read(tmp_path, monkeypatch):
    monkeypatch.setattr("seiswidgets.io.rasters.arrays.MOST_ROW_CHARACTERS", 10)
    with pytest.raises(sw.DataError, match=r"line.txt has a first row of 10 characters or more; write one row"):
        sw.open_section(text(tmp_path / "line.txt", "1 2 3 4 5 6\n1 2 3 4 5 6\n"), **AXES)


def test_what_is_infinite_or_nothing_at_all_is_refused(tmp_path):
    with pytest.raises(sw.DataError, match=r"line.txt has an infinite amplitude at sample 1 of trace 0"):
        sw.open_section(text(tmp_path / "line.txt", "1 2\n1e999 4\n"), **AXES)
    with pytest.raises(sw.DataError, match=r"line.npy has no amplitudes: all 4 are NaN"):
        sw.open_section(npy(tmp_path / "line.npy", np.full((2, 2), np.nan)), **AXES)


@pytest.mark.parametrize("array", [np.ones(5), np.ones((1, 5)), np.ones((2, 2, 2)), np.ones((2, 2), complex)])
def test_an_array_that_is_no_matrix(tmp_path, array):
    with pytest.raises(sw.DataError, match=r"line\.npy .*(matrix|real numbers)"):
        sw.open_section(npy(tmp_path / "line.npy", array), **AXES)


def test_axes_are_asked_for(tmp_path):
    path = npy(tmp_path / "line.npy", MATRIX)
    with pytest.raises(sw.SettingError, match=r"line.npy does not say how wide and how deep"):
        sw.open_section(path, z_unit="m", dx=1)
    with pytest.raises(sw.SettingError, match=r"line.npy does not say whether it is in time or in depth"):
        sw.open_section(path, dx=1, dz=1)
    info = sw.preview(path)
    assert (info.shape, info.needed) == ((2, 3), ("extent, or dx and dz", "z_unit or velocity"))


@pytest.mark.parametrize("mask", [np.eye(4, dtype=bool), np.zeros((4, 4), bool), np.tri(4, dtype=bool)])
@pytest.mark.parametrize("dtype", [np.int16, np.float32, np.float64])
def test_masked_samples_have_no_data(mask, dtype):
    values = np.arange(16, dtype=dtype).reshape(4, 4)
    amplitude = sw.Section(np.ma.array(values, mask=mask, fill_value=7), dx=1, dz=1).amplitude
    np.testing.assert_array_equal(np.isnan(amplitude), mask)
    np.testing.assert_array_equal(amplitude[~mask], values[~mask])
    assert amplitude.dtype == (np.float64 if dtype == np.float64 else np.float32)


def test_masked_points_of_a_pick_are_refused():
    with pytest.raises(sw.PickError, match="point 2 of fault 'F' is not finite"):
        sw.Fault(np.ma.array([(0, 0), (1, 1), (2, 2)], mask=[(0, 0), (0, 1), (0, 0)]), "F")


def packed(path):
    np.savez_compressed(path, amplitude=np.zeros((3000, 8000), np.float32), dx=5.0, dz=1.0, z_unit="m")


def other_matrix(path):
    np.savez_compressed(path, matrix=np.zeros((3000, 8000), np.float32), remark=np.zeros(9_000_000, np.int8))


def long_header(path):
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive, archive.open("amplitude.npy", "w") as file:
        file.write(b"\x93NUMPY\2\0" + (10**8).to_bytes(4, "little"))
        for _ in range(100):
            file.write(b" " * 10**6)


def long_rows(path):
    with path.open("w") as file:
        file.writelines("1 " * 1_000_000 + "\n" for _ in range(3))


@pytest.mark.parametrize(
    ("name", "write"),
    [("a.npz", packed), ("a.npz", other_matrix), ("a.npz", long_header), ("a.txt", long_rows)],
)
def test_a_preview_takes_no_more_than_the_file_and_50_mb(tmp_path, name, write):
    write(tmp_path / name)
    code = (
        "import sys\nfrom memory import peak\nimport seiswidgets as sw\nfrom seiswidgets.io import opening\n"
        "before = peak()\n"
        "try:\n    sw.preview(sys.argv[1])\nexcept sw.DataError:\n    pass\nprint(peak() - before)"
    )
    run = [sys.executable, "-c", code, str(tmp_path / name)]
    environment = os.environ | {"PYTHONPATH": os.pathsep.join([str(Path(__file__).parent), *sys.path])}
    done = subprocess.run(run, capture_output=True, text=True, check=True, env=environment)
    assert int(done.stdout) * 1024 < (tmp_path / name).stat().st_size + 50e6


def test_a_preview_of_an_npz_reads_what_is_stored_beside_the_matrix(tmp_path):
    packed(tmp_path / "line.npz")
    info = sw.preview(tmp_path / "line.npz")
    assert (info.shape, info.format, info.needed) == ((3000, 8000), "float32", ())
