"""A scan is calibrated and cropped in the opening panel, by clicks or by typed pixels, and opened as it should be."""

import numpy as np
import pytest

import seiswidgets as sw
from seiswidgets.widgets.app import RestorationApp
from tests.io.test_calibration import CROP, clicks, pixel_of, scan
from tests.widgets.hands import appear, click, drag_to, press, release

LONG = 30


@pytest.fixture
def app():
    app = RestorationApp(sw.synthetic.tilt().section, live=False)
    yield app
    app.close()
    assert app.wait(LONG)


def shown(app, path):
    """The opener, with the picture to be calibrated on the screen."""
    opener = app.files.section
    opener.file.text.value = str(path)
    assert opener.wait(LONG)
    opener.calibrator.open_button.click()
    assert opener.wait(LONG)
    appear(opener.calibrator.pane)
    return opener


def type_in(calibrator, calibration, crop=()):
    for axis in "xz":
        for end in (1, 2):
            for part, number in zip(("column", "row", "value"), calibration[axis][end - 1], strict=True):
                calibrator.points[f"{axis}{end}", part].value = f"{number:g}"
    for field, pixel in zip(calibrator.edges.values(), crop, strict=False):
        field.value = str(pixel)


def test_clicks_and_a_rectangle_give_the_section(app, tmp_path):
    path = scan(tmp_path / "page.png")
    opener = shown(app, path)
    calibrator = opener.calibrator
    for tool, tick, value in (("x1", (1000, 0), 1000), ("x2", (5500, 0), 5500), ("z1", (0, 200), 200)):
        assert calibrator.tools.value == tool
        click(calibrator.pane, pixel_of(*tick))
        calibrator.points[tool, "value"].value = str(value)
    assert "needs the column of the vertical axis, second point" in calibrator.state.value
    press(calibrator.pane, pixel_of(300, 1500))  # not where it should be, yet
    drag_to(calibrator.pane, pixel_of(0, 1800))
    release(calibrator.pane, pixel_of(0, 1800))
    calibrator.points["z2", "value"].value = "1800"
    assert calibrator.tools.value == "look"
    calibrator.tools.value = "crop"
    left, right, top, bottom = CROP
    press(calibrator.pane, (right, bottom))
    drag_to(calibrator.pane, (200, 100))
    release(calibrator.pane, (left, top))
    assert "401 traces 15 apart; z from 0 to 2000, 201 samples 10 apart" in calibrator.state.value
    assert opener.fields.fields["x_min"].layout.display == "none"
    opener.load()
    assert opener.wait(LONG)
    section = app.section
    expected = sw.open_section(path, calibration=clicks(), crop=CROP, velocity=2000.0)
    np.testing.assert_array_equal(section.amplitude, expected.amplitude)
    axes = [section.dx, section.dz, section.x0, section.z0]
    np.testing.assert_allclose(axes, [15.0, 10.0, 0.0, 0.0], atol=1.0)  # a click is a tenth of a pixel off
    again = app.workspace.source.open()
    np.testing.assert_array_equal(again.amplitude, section.amplitude)
    assert (again.dx, again.x0) == (section.dx, section.x0)


def test_a_page_that_lay_askew_is_said_to_be_and_straightened(app, tmp_path):
    path = scan(tmp_path / "page.png", 3.0)
    opener = shown(app, path)
    type_in(opener.calibrator, clicks(3.0), CROP)
    assert "axes are rotated by 2.9°" in opener.calibrator.state.value
    opener.calibrator.straighten.value = True
    assert "rotated" not in opener.calibrator.state.value
    opener.load()
    assert opener.wait(LONG)
    expected = sw.open_section(path, calibration=clicks(3.0, deskew=True), crop=CROP, velocity=2000.0)
    np.testing.assert_array_equal(app.section.amplitude, expected.amplitude)


def test_another_unit_rescales_the_values_that_were_typed(app, tmp_path):
    opener = shown(app, scan(tmp_path / "page.png"))
    type_in(opener.calibrator, clicks())
    opener.fields.fields["z_unit"].value = "s"
    opener.fields.fields["x_unit"].value = "km"
    values = [opener.calibrator.points[name, "value"].value for name in ("x1", "x2", "z1", "z2")]
    assert values == ["1", "5.5", "0.2", "1.8"]


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({("x2", "value"): "1000"}, "two different values on the horizontal axis"),
        ({("z2", "value"): "1,8"}, "needs the value of the vertical axis, second point"),
        ({"left": "a"}, "the first column to keep must be a"),
        ({"left": "600"}, "“crop” must be the first and last column"),
    ],
)
def test_bad_input_is_said_and_nothing_is_opened(app, tmp_path, changes, message):
    opener, before = shown(app, scan(tmp_path / "page.png")), app.section
    calibrator = opener.calibrator
    type_in(calibrator, clicks())
    for name, text in changes.items():
        (calibrator.edges if name in calibrator.edges else calibrator.points)[name].value = text
    assert message in calibrator.state.value
    opener.load()
    assert opener.wait(LONG)
    assert message in opener.notice.text
    assert app.section is before


def test_the_edges_can_be_typed_instead_and_a_crop_needs_no_calibration(app, tmp_path):
    opener = shown(app, scan(tmp_path / "page.png"))
    type_in(opener.calibrator, clicks())
    opener.calibrator.close_button.click()
    assert opener.calibrator.choices() == {}
    assert opener.fields.fields["x_min"].layout.display == ""
    opener.calibrator.open_button.click()
    assert opener.wait(LONG)
    opener.calibrator.edges["right"].value = "400"
    opener.load()
    assert opener.wait(LONG)
    assert app.section.shape == (300, 401)
