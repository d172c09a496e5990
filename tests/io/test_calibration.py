"""A scanned page is calibrated by two points on each axis and cropped: the section lies where it was drawn."""

import numpy as np
import pytest
from PIL import Image

import seiswidgets as sw
from seiswidgets.io.rasters.calibration import Calibration

WIDTH, DEPTH = 6000.0, 2000.0  # of the section on the page, in m and ms
FRAME = (60.0, 40.0, 460.0, 240.0)  # its left, top, right and bottom edge on the page, in pixels, before it is rotated
UNITS = {"velocity": 2000.0}


def shade(x, z):
    """A pattern that is smooth at the scale of a pixel."""
    return np.sin(2 * np.pi * x / 1500) * np.cos(2 * np.pi * z / 400)


def pixel_of(x, z, degrees=0.0, mirrored=False):
    """Column and row on a page that was laid on the scanner at an angle."""
    left, top, right, bottom = FRAME
    x = WIDTH - x if mirrored else x
    at = np.array([left + x / WIDTH * (right - left) - 250, top + z / DEPTH * (bottom - top) - 150])
    angle = np.radians(degrees)
    return np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]]) @ at + [250, 150]


def scan(path, degrees=0.0, mirrored=False):
    """A page of 520 x 300 pixels."""
    columns, rows = np.meshgrid(np.arange(520.0), np.arange(300.0))
    origin, right, down = (pixel_of(*at, degrees, mirrored) for at in ((0, 0), (1, 0), (0, 1)))
    units = np.column_stack([right - origin, down - origin])
    x, z = np.linalg.solve(units, np.stack([columns.ravel(), rows.ravel()]) - origin[:, None])
    inside = (x >= 0) & (x <= WIDTH) & (z >= 0) & (z <= DEPTH)
    grey = np.where(inside, 127.5 + 120 * shade(x, z), 255).reshape(columns.shape)
    Image.fromarray(np.round(grey).astype(np.uint8)).save(path)
    return path


def clicks(degrees=0.0, mirrored=False, **more):
    """Two points on each axis, to the nearest pixel."""
    ticks = {"x": [(1000.0, 0.0), (5500.0, 0.0)], "z": [(0.0, 200.0), (0.0, 1800.0)]}
    return {
        name: [(*np.round(pixel_of(*tick, degrees, mirrored)).tolist(), tick[name == "z"]) for tick in pair]
        for name, pair in ticks.items()
    } | more


def is_right(section, margin=20):
    """The pattern lies where it was drawn, to within a pixel, away from the edges."""
    x, z = np.meshgrid(section.x, section.z)
    part = np.s_[margin:-margin, margin:-margin]
    shifted = [
        np.abs(shade(x + i * 15, z + j * 10) - section.amplitude / 120)[part] for i in (-1, 0, 1) for j in (-1, 0, 1)
    ]
    return np.median(np.min(shifted, axis=0)) < 0.1


CROP = (60, 460, 40, 240)


@pytest.mark.parametrize("mirrored", [False, True])
def test_axes_are_right_to_within_a_pixel(tmp_path, mirrored):
    path = scan(tmp_path / "page.png", mirrored=mirrored)
    section = sw.open_section(path, calibration=clicks(mirrored=mirrored), crop=CROP, **UNITS)
    assert section.shape == (201, 401)
    assert (section.dx, section.dz) == (pytest.approx(15.0, rel=0.01), pytest.approx(10.0, rel=0.01))
    assert (section.x0, section.z0) == (pytest.approx(0, abs=15.0), pytest.approx(0, abs=10.0))
    assert is_right(section)


@pytest.mark.parametrize("degrees", [3.0, -5.0])
def test_a_page_that_lay_askew_is_straightened(tmp_path, degrees):
    path = scan(tmp_path / "page.png", degrees)
    section = sw.open_section(path, calibration=clicks(degrees, deskew=True), crop=CROP, **UNITS)
    assert is_right(section)
    with pytest.warns(UserWarning, match=r"rotated by -?[2345]\.\d degrees"):
        skewed = sw.open_section(path, calibration=clicks(degrees), crop=CROP, **UNITS)
    assert not is_right(skewed)


def test_the_whole_page_without_a_crop_and_a_crop_without_calibration(tmp_path):
    path = scan(tmp_path / "page.png")
    page = sw.open_section(path, calibration=clicks(), **UNITS)
    part = sw.open_section(path, calibration=clicks(), crop=CROP, **UNITS)
    assert page.shape == (300, 520)
    column, row = round((part.x0 - page.x0) / page.dx), round((part.z0 - page.z0) / page.dz)
    assert (column, row) == (60, 40)
    np.testing.assert_array_equal(page.amplitude[40:241, 60:461], part.amplitude)
    typed = sw.open_section(path, extent=(0, WIDTH, 0, DEPTH), crop=CROP, **UNITS)
    np.testing.assert_array_equal(typed.amplitude, part.amplitude)
    assert (typed.dx, typed.dz) == (15.0, 10.0)


def test_a_session_opens_the_same_section_again(tmp_path):
    path = scan(tmp_path / "page.png", 3.0)
    choices = {"calibration": clicks(3.0, deskew=True), "crop": CROP, **UNITS}
    source = sw.SectionSource("file", str(path), choices)
    sw.Session(source, None).save(tmp_path / "work.json")
    again = sw.open_session(tmp_path / "work.json").source.open()
    np.testing.assert_array_equal(again.amplitude, sw.open_section(path, **choices).amplitude)


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({}, "or two points on each axis by calibration="),
        ({"calibration": {"x": clicks()["x"]}}, "two points"),
        ({"calibration": clicks() | {"y": 1}}, "two points"),
        ({"calibration": clicks() | {"x": [(1, 2), (3, 4)]}}, "two points"),
        ({"calibration": clicks() | {"x": [(9, 40, 0), (400, 40, 0)]}}, "two different values on the horizontal axis"),
        ({"calibration": clicks() | {"x": [(9, 40, 0), (9, 40, 100)]}}, "horizontal axis, one left of the other"),
        ({"calibration": clicks() | {"z": [(9, 40, 0), (60, 40, 100)]}}, "vertical axis, one above the other"),
        ({"calibration": clicks() | {"z": [(9, 40, 0), (9, 90, -100)]}}, "increase downwards"),
        ({"calibration": {"x": [(0, 0, 0), (9, 9, 1)], "z": [(0, 0, 0), (9, 9, 1)]}}, "parallel"),
        ({"calibration": clicks(), "dx": 5.0}, "dx= has no meaning for a picture that is calibrated"),
        ({"calibration": clicks(), "crop": (0, 520, 0, 10)}, "of 520 columns and 300 rows"),
        ({"calibration": clicks(), "crop": (10, 10, 0, 10)}, "at least two of each"),
        ({"calibration": clicks(), "crop": (0, 9.5, 0, 10)}, "crop= must be the first and last column"),
        ({"calibration": 3}, "calibration= must be a dictionary"),
    ],
)
def test_bad_input_is_refused_in_words(tmp_path, changes, message):
    with pytest.raises(sw.SettingError, match=message):
        sw.open_section(scan(tmp_path / "page.png"), **UNITS, **changes)


def test_other_files_cannot_be_cropped(tmp_path):
    np.save(tmp_path / "matrix.npy", np.ones((5, 5)))
    with pytest.raises(sw.SettingError, match="crop= has no meaning for array"):
        sw.open_section(tmp_path / "matrix.npy", extent=(0, 1, 0, 1), crop=(0, 1, 0, 1), z_unit="m")


def test_the_angle_of_the_axes_is_that_of_the_page():
    for degrees in (0.0, 2.5, -7.0):
        for mirrored in (False, True):
            assert Calibration.of(clicks(degrees, mirrored)).rotation == pytest.approx(degrees, abs=0.4)
