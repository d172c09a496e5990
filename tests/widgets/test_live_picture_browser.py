"""Pictures that the browser draws itself: exact, sharp, in step with lines and axes, and without the kernel."""

import numpy as np
import pytest

from tests.widgets.appscreen import RESTORED

PLAIN = RESTORED + "app.panes.deformation = 0.0\napp.wait(30)\n"
DRAWN = """(number) => {
  const canvas = document.querySelectorAll("canvas.seiswidgets-plot")[number];
  const { width, height } = canvas;
  const { data } = canvas.getContext("2d").getImageData(0, 0, width, height);
  return [width, height, Array.from(data.filter((_, i) => i % 4 === 0))];
}"""
EXPECTED = """
def expected(columns, rows):
    from seiswidgets.core.resampling import resample
    section, pane = app.section, app.panes.restored
    points = pane.view.from_backing(np.column_stack([columns, rows]) + 0.5)
    origins = (app.restoration.to_original(points) - (section.x0, section.z0)) / (section.dx, section.dz)
    levels = app.panes.original.colouring.levels(resample(section.amplitude, *origins.T, order=1))
    return app.panes.original.colouring.palette[levels, 0].tolist()
"""
WATCH = """() => {
  const plot = document.querySelectorAll(".seiswidgets-layer .plot")[1];
  const canvas = document.querySelectorAll("canvas.seiswidgets-plot")[1];
  const look = () => {
    const row = canvas.getContext("2d").getImageData(0, canvas.height / 3, canvas.width, 1).data.join();
    const part = (name) => plot.querySelector(`.${name}`).outerHTML;
    const text = plot.parentElement.innerText.replace(" · 0 shows all of the rock", "");  // a hint, when rock leaves
    return { picture: row, lines: part("strokes"), axes: part("axes") + text };
  };
  window.seen = [look()];
  const watch = () => {
    if (window.stopped) return;
    window.seen.push(look());
    requestAnimationFrame(watch);
  };
  requestAnimationFrame(watch);
}"""
SEEN = """() => {
  window.stopped = true;
  const { seen } = window;
  return seen.slice(1).map((now, i) => Object.keys(now).filter((name) => now[name] !== seen[i][name]));
}"""


@pytest.fixture
def screen(open_app):
    screen = open_app(PLAIN)
    screen.until("len(app.restoration.stages) == 2 and app.wait(30)")
    screen.pictures()
    return screen


def drawn(screen, number=1):
    """Red of all pixels of a pane, shape (height, width)."""
    width, height, red = screen.page.evaluate(DRAWN, number)
    return np.reshape(red, (height, width))


def test_the_picture_is_the_kernels_linear_one_at_any_zoom(screen):
    screen.ask(f"exec({EXPECTED!r}, globals())")
    box = screen.plots.nth(1).bounding_box()
    for _ in range(2):
        screen.pictures()
        picture = drawn(screen)
        rows, columns = np.random.default_rng(0).integers(0, picture.shape, (1000, 2)).T
        wanted = screen.ask(f"expected({columns.tolist()}, {rows.tolist()})")
        assert np.mean(np.abs(picture[rows, columns] - wanted) > 1) <= 0.01
        screen.page.mouse.move(box["x"] + box["width"] / 2, box["y"] + box["height"] / 2)
        screen.page.mouse.wheel(0, -800)
        screen.until("not app.panes.restored.view.is_fitted")
        assert screen.ask("app.panes.original.view.window == app.panes.restored.view.window")


def test_time_needs_no_kernel(screen):
    end, lines = drawn(screen), screen.paths(1)
    handle = screen.page.locator(".noUi-handle").first
    with screen.opened.kernel_at_work():
        handle.focus()
        screen.page.keyboard.press("Home")
        today = screen.pictures(lambda pictures: pictures[1] == pictures[0])
        assert today[0] == today[1]
        assert (drawn(screen, 1) == drawn(screen, 0)).all()
        assert screen.paths(1) != lines
        screen.page.keyboard.press("End")
        screen.pictures(lambda pictures: pictures != today)
        assert (drawn(screen) == end).all()
        assert screen.paths(1) == lines


def test_while_a_line_is_dragged_lines_and_picture_change_together_and_axes_never(screen):
    screen.button("Horizon").click()
    vertex = screen.points("app.interpretation.horizons[0].pieces[0][20]")
    window, exaggeration = screen.ask("app.panes.restored.view.window"), screen.ask("app.panes.original.exaggeration")
    screen.page.evaluate(WATCH)
    for step in (1, 2, 3):
        screen.drag(vertex, vertex + [0, 40 * step], drop=False)
        screen.until("app.panes.shown.is_preview")
        screen.page.mouse.up()
        screen.until("app.wait(30) and not app.panes.shown.is_preview")
        vertex = screen.points("app.interpretation.horizons[0].pieces[0][20]")
    screen.press("Control+z")
    screen.until("app.wait(30) and not app.panes.shown.is_preview")
    screen.pictures()
    changes = [names for names in screen.page.evaluate(SEEN) if names]
    assert len(changes) > 3
    assert all("axes" not in names for names in changes)
    assert all("lines" in names for names in changes if "picture" in names)
    assert screen.ask("app.panes.restored.view.window") == window
    assert screen.ask("[pane.exaggeration for pane in panes]") == [exaggeration] * 2
