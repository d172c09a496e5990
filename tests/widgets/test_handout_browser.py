"""Handouts in a browser: opened from disk, with the network off."""

import numpy as np
import pytest
from playwright.sync_api import expect

import seiswidgets as sw
from tests.io.restored import restored
from tests.widgets.axe import serious
from tests.widgets.browser import Page, awaited, keep_picture

PIXELS = """(name) => document.querySelector(`#${name} canvas`).toDataURL()"""
CROSS = """(name) => {
  const lines = [...document.querySelectorAll(`#${name} .linked .cross`)];
  return lines.length ? [Number(lines[0].getAttribute("x1")), Number(lines[1].getAttribute("y1"))] : null;
}"""
LABELS = """(name) => [...document.querySelectorAll(`#${name} .axes .label`)].map((label) => label.textContent)"""


class Handout:
    """A handout on the screen."""

    def __init__(self, chromium, path, **options):
        self.shown = Page(chromium, "about:blank", **options)
        self.page, self.requests = self.shown.page, []
        self.shown.context.set_offline(True)
        self.page.on("request", lambda request: self.requests.append(request.url))
        self.page.goto(path.as_uri())
        expect(self.page.locator("#restored .axes .label").nth(3)).to_be_attached()
        self.still()

    def still(self):
        """Wait until what was requested is drawn."""
        self.page.evaluate("new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))")

    def pixels(self, name):
        self.still()
        return self.page.evaluate(PIXELS, name)

    def becomes(self, name, pixels):
        """Wait until a pane shows a picture: while time runs on a slow computer, it is drawn coarsely at first."""
        awaited(lambda: self.pixels(name), lambda found: found == pixels, "another picture")

    def labels(self, name):
        self.still()
        return self.page.evaluate(LABELS, name)

    def size(self, name="original"):
        box = self.page.locator(f"#{name}").bounding_box()
        return np.array([box["width"], box["height"]])

    def point_at(self, name, share):
        """Move the mouse to a share of a pane's width and height, and return its position in the pane."""
        at = self.size(name) * share
        box = self.page.locator(f"#{name}").bounding_box()
        self.page.mouse.move(box["x"] + at[0], box["y"] + at[1])
        self.still()
        return at


@pytest.fixture(scope="module")
def path(tmp_path_factory):
    path = tmp_path_factory.mktemp("handout") / "handout.html"
    sw.save_html(restored(), path)
    return path


@pytest.fixture
def handout(chromium, path):
    """A function that opens a handout; at the end the console must hold no error, and nothing else was asked for."""
    opened = []

    def open_handout(file=path, **options):
        opened.append((Handout(chromium, file, **options), file))
        return opened[-1][0]

    yield open_handout
    for one, _ in opened:
        one.shown.close()
    for one, file in opened:
        assert one.shown.errors == []
        assert one.requests == [file.as_uri()]


def window(restoration):
    """The window of a handout that shows everything."""
    points = np.concatenate([stage.vertices for stage in restoration.stages])
    section = restoration.original
    x_min, x_max, z_min, z_max = section.extent
    half = np.array([section.dx, section.dz]) / 2
    low = np.minimum(points.min(axis=0), np.array([x_min, z_min]) - half)
    return low, np.maximum(points.max(axis=0), np.array([x_max, z_max]) + half) - low


def test_the_cursor_of_a_pane_is_at_its_point_in_the_other(handout):
    page = handout()
    low, span = window(restored())
    for name, other, carried in (
        ("original", "restored", restored().to_restored),
        ("restored", "original", restored().to_original),
    ):
        at = page.point_at(name, (0.3, 0.6))
        point = low + span * at / page.size(name)
        expected = (carried([point])[0] - low) / span * page.size(other)
        np.testing.assert_allclose(page.page.evaluate(CROSS, other), expected, atol=0.5)
    readout = page.page.locator("#readout").inner_text()
    assert f"x {point[0]:.6g} m, depth {point[1]:.6g} m" in readout
    ratio = restored().area_ratio_at(carried([point]))[0]
    assert f"area ratio {ratio:.3f}" in readout


def test_time_moves_the_rock_and_the_picks_and_play_ends_at_the_end(handout):
    page = handout()
    end, present = page.pixels("restored"), page.pixels("original")
    line = page.page.locator("#restored .stroke .line").nth(1)
    restored_line = line.get_attribute("d")
    page.page.get_by_role("button", name="present day").click()
    page.becomes("restored", present)
    assert line.get_attribute("d") != restored_line
    slider = page.page.get_by_role("slider", name="Time")
    assert slider.get_attribute("aria-valuetext") == "present day"
    slider.press("ArrowRight")
    assert slider.get_attribute("aria-valuetext").startswith("unfaulting ")
    assert page.pixels("restored") not in (present, end)
    slider.press("End")
    slider.press("PageDown")
    page.page.get_by_role("button", name="Play").click()
    expect(page.page.locator("#time output")).to_have_text("restored")
    page.becomes("restored", end)
    assert line.get_attribute("d") == restored_line


def test_zoom_and_pan_are_the_same_in_both_panes_by_wheel_drag_and_keys(handout):
    page = handout(height=700)
    whole = page.labels("original")
    page.point_at("original", (0.25, 0.25))
    page.page.mouse.wheel(0, -500)
    zoomed = page.labels("restored")
    assert zoomed == page.labels("original") != whole
    page.page.mouse.down()
    page.point_at("original", (0.75, 0.75))
    page.page.mouse.up()
    panned = page.labels("original")
    assert panned == page.labels("restored") != zoomed
    page.page.keyboard.press("0")
    assert page.labels("restored") == whole
    page.page.keyboard.press("+")
    page.page.keyboard.press("ArrowLeft")
    assert page.labels("restored") == page.labels("original") != whole
    page.page.mouse.dblclick(*(page.page.locator("#restored").bounding_box()[key] + 40 for key in ("x", "y")))
    assert page.labels("original") == whole
    page.page.get_by_role("button", name="Zoom in").click()
    assert page.labels("original") != whole


def test_two_fingers_zoom_and_one_scrolls_a_whole_picture(handout):
    page = handout(width=390, height=800, touch=True)
    assert page.page.evaluate("document.documentElement.scrollWidth") <= 390
    assert page.page.locator("#original .plot").evaluate("(plot) => getComputedStyle(plot).touchAction") == "pan-y"
    box = page.page.locator("#original").bounding_box()
    middle = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    fingers = page.shown.context.new_cdp_session(page.page)

    def touch(kind, apart):
        points = [{"x": middle[0] + side * apart, "y": middle[1], "id": side + 1} for side in (-1, 1)]
        fingers.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": points if kind != "touchEnd" else []})

    whole = page.labels("restored")
    touch("touchStart", 30)
    touch("touchMove", 60)
    touch("touchMove", 90)
    touch("touchEnd", 0)
    assert page.labels("restored") == page.labels("original") != whole
    assert page.page.locator("#original .plot").evaluate("(plot) => getComputedStyle(plot).touchAction") == "none"


def test_brushing_the_histogram_highlights_rock_in_both_panes(handout):
    page = handout(height=1000)
    before = [page.pixels(name) for name in ("original", "restored")]
    chart = page.page.locator("#histogram .chart")
    box = chart.bounding_box()
    y = box["y"] + box["height"] / 2
    page.page.mouse.move(box["x"] + 0.6 * box["width"], y)
    page.page.mouse.down()
    page.page.mouse.move(box["x"] + 0.9 * box["width"], y)
    page.page.mouse.up()
    brushed = [page.pixels(name) for name in ("original", "restored")]
    assert all(one != other for one, other in zip(before, brushed, strict=True))
    assert "% of the area" in page.page.locator("#histogram .brushed").inner_text()
    keep_picture(page.page, "handout")
    chart.press("Escape")
    for name, pixels in zip(("original", "restored"), before, strict=True):
        page.becomes(name, pixels)
    page.page.get_by_role("checkbox", name="Deformation map").check()
    assert [page.pixels(name) for name in ("original", "restored")] not in (before, brushed)


def test_the_histogram_agrees_with_the_kernels_and_follows_time(handout):
    page = handout()
    case = restored()
    summary = page.page.locator("#histogram .summary").inner_text()
    nodes = np.stack(np.meshgrid(case.original.x, case.original.z), axis=-1).reshape(-1, 2)
    histogram = sw.DeformationHistogram(case.area_ratio_at(nodes))
    numbers = [[float(word.strip(",;")) for word in text.split()[1:6:2]] for text in (summary, histogram.summary)]
    np.testing.assert_allclose(*numbers, atol=0.002)
    page.page.get_by_role("button", name="present day").click()
    expect(page.page.locator("#histogram .summary")).to_contain_text("median 1.000, P1 1.000, P99 1.000")


def test_picks_and_mesh_can_be_switched(handout):
    page = handout()
    strokes = page.page.locator(".stroke")
    assert strokes.count() > 6
    page.page.get_by_role("checkbox", name="Picks").uncheck()
    page.still()
    assert strokes.count() == 0
    page.page.get_by_role("checkbox", name="Mesh").check()
    page.still()
    assert all(page.page.locator(".mesh").evaluate_all("(all) => all.map((mesh) => mesh.getAttribute('d'))"))


def test_on_paper_both_panes_are_whole_and_at_the_end(handout):
    page = handout()
    whole = page.labels("restored")
    page.page.get_by_role("button", name="present day").click()
    page.page.get_by_role("button", name="Zoom in").click()
    zoomed = page.labels("restored")
    moment = page.page.locator("#restored .note")
    assert "present day" in moment.inner_text()
    page.page.evaluate("window.dispatchEvent(new Event('beforeprint'))")
    assert page.page.evaluate(LABELS, "restored") == whole  # at once: no frame is drawn before the printer's
    assert "present day" not in moment.inner_text()
    assert page.page.locator("#restored canvas").evaluate("(canvas) => canvas.width / canvas.clientWidth") > 2.9
    page.page.evaluate("window.dispatchEvent(new Event('afterprint'))")
    assert page.page.evaluate(LABELS, "restored") == zoomed
    assert "present day" in moment.inner_text()
    assert page.page.pdf().startswith(b"%PDF")


def test_axe_finds_nothing_and_nothing_sticks_out_at_any_width(handout):
    page = handout()
    page.page.get_by_text("Report", exact=True).click()
    page.page.get_by_text("Mouse, touch and keys").click()
    for width in (390, 1000, 1900):
        page.page.set_viewport_size({"width": width, "height": 900})
        for scheme in ("light", "dark"):
            page.page.emulate_media(color_scheme=scheme)
            assert serious(page.page) == [], (width, scheme)
            assert page.page.evaluate("document.documentElement.scrollWidth") <= width
    assert page.page.evaluate("async () => (await axe.run()).violations.map(({ id }) => id)") == []


def test_nothing_restored_is_shown_too(handout, tmp_path):
    case = sw.synthetic.graben()
    file = tmp_path / "plain.html"
    sw.save_html(sw.Restoration(case.section), file, case.interpretation)
    page = handout(file)
    page.page.get_by_text("Not restored yet").wait_for()
    assert page.pixels("original") == page.pixels("restored")
    assert page.page.get_by_role("slider").count() == 0
    page.point_at("original", (0.5, 0.5))
    assert page.page.evaluate(CROSS, "restored") is not None
