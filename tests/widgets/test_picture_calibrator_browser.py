"""A scan is calibrated with a real mouse: two clicks on each axis and a rectangle give the section as it was drawn."""

import numpy as np

from tests.io.test_calibration import CROP, pixel_of, scan
from tests.widgets.axe import serious

TICKS = {"x1": (1000, 0), "x2": (5500, 0), "z1": (0, 200), "z2": (0, 1800)}


def test_a_scan_is_calibrated_and_cropped_by_mouse(open_app, tmp_path):
    path = scan(tmp_path / "page.png")
    screen = open_app("\nopener = app.files.section\n", f"path = {str(path)!r}\n")
    screen.tab("File")
    screen.ask("setattr(opener.file.text, 'value', path)")
    button = screen.page.get_by_role("button", name="Calibrate and crop on the picture")
    button.click()
    plot = screen.page.locator(".widget-tab-contents .seiswidgets-layer .plot")
    plot.wait_for()

    def place(pixel):
        plot.scroll_into_view_if_needed()
        box = plot.bounding_box()
        x, y = screen.ask(f"opener.calibrator.pane.view.to_pixels({list(map(float, pixel))}).tolist()")
        return box["x"] + x, box["y"] + y

    for name, tick in TICKS.items():
        screen.page.mouse.click(*place(pixel_of(*tick)))
        screen.until(f"opener.calibrator.points[{name!r}, 'column'].value")
        screen.page.wait_for_function("() => document.activeElement.placeholder === 'value'")  # ready to be typed
        screen.page.keyboard.type(str(tick[name[0] == "z"]))
        screen.until(f"opener.calibrator.points[{name!r}, 'value'].value")
    screen.page.get_by_role("button", name="Crop", exact=True).click()
    left, right, top, bottom = CROP
    screen.page.mouse.move(*place((left, top)))
    screen.page.mouse.down()
    screen.page.mouse.move(*place((right, bottom)), steps=5)
    screen.page.mouse.up()
    screen.until("len(opener.calibrator.choices()) == 2")
    screen.shoot("calibrated-scan")
    assert serious(screen.page, ".seiswidgets-app") == []
    screen.page.get_by_role("button", name="Open section").click()
    screen.until("app.section.shape[0] < 300 and app.section.dx > 10")
    axes = screen.ask("[app.section.dx, app.section.dz, app.section.x0, app.section.z0]")
    np.testing.assert_allclose(axes[:2], [15.0, 10.0], rtol=0.01)
    assert abs(axes[2]) < 30.0  # two pixels: of the click and of the rectangle
    assert abs(axes[3]) < 20.0
