"""Conversions between pixels and sections, there and back, at every zoom, exaggeration and resolution."""

import itertools

import numpy as np
import pytest

import seiswidgets as sw
from seiswidgets.interaction.viewport import FARTHEST, FEWEST, Viewport

NOISE = np.random.default_rng(1).normal(size=(200, 300))
DEPTH = sw.Section(NOISE, dx=25.0, dz=10.0, x0=612_000.0, z0=-50.0)
TIME = sw.Section(NOISE, dx=0.0125, dz=4.0, x_unit="km", z_unit="ms", velocity=2400.0)
TINY = sw.Section(NOISE[:2, :3], dx=1.0, dz=1.0)
SECTIONS = {"depth": DEPTH, "time": TIME, "tiny": TINY}


def near(window):
    return pytest.approx(window, rel=1e-9, abs=1e-9)


@pytest.fixture(params=SECTIONS)
def view(request):
    return Viewport(SECTIONS[request.param], 900, 600)


COMMON, TALL, FLAT = (900, 600), (333.3, 1217.7), (1919, 80)


@pytest.mark.parametrize(
    ("section", "size", "ratio", "zoom", "exaggeration"),  # each zoom twice; of the others each pair of values
    [
        ("depth", COMMON, 1, 0.1, None),
        ("depth", TALL, 1.5, 3, 1),
        ("depth", FLAT, 2, 1e9, 7.3),
        ("depth", TALL, 2, 20, None),
        ("time", COMMON, 1.5, 20, 7.3),
        ("time", TALL, 2, 0.7, None),
        ("time", FLAT, 1, 1, 1),
        ("time", COMMON, 1, 3, 7.3),
        ("tiny", COMMON, 2, 1, 1),
        ("tiny", TALL, 1, 1e9, 7.3),
        ("tiny", FLAT, 1.5, 0.7, None),
        ("tiny", FLAT, 2, 0.1, 1),
    ],
)
def test_pixels_there_and_back(section, size, ratio, zoom, exaggeration):
    view = Viewport(SECTIONS[section]).resized(*size, ratio).zoomed(zoom, at=(0.3 * size[0], 0.8 * size[1]))
    view = view if exaggeration is None else view.exaggerated(exaggeration)
    pixels = np.array(list(itertools.product(np.linspace(0, size[0], 23), np.linspace(0, size[1], 17))))
    assert abs(view.to_pixels(view.to_section(pixels)) - pixels).max() < 1e-3
    device = np.array(list(itertools.product(*(np.arange(0, length, 7) for length in view.backing))))
    assert abs(view.to_backing(view.from_backing(device)) - device).max() < 1e-3
    whole = np.round(view.to_backing(view.to_section(pixels)))  # a canvas draws on whole pixels
    assert abs(view.to_backing(view.from_backing(whole)) - whole).max() < 1e-3
    assert (abs(view.to_pixels(view.from_backing(whole)) - pixels) * view.backing / view.size).max() <= 0.501


def test_corners(view):
    view = view.resized(901, 603, ratio := 1.5)
    x_min, x_max, z_min, z_max = view.window
    assert view.to_pixels([(x_min, z_min), (x_max, z_max)]) == near(np.array([[0, 0], [901, 603]]))
    assert view.to_backing([x_max, z_max]) == near(view.backing)
    assert view.backing == (round(901 * ratio), round(603 * ratio))
    assert view.picture == near((0, 0, 901, 603))


def test_a_fitted_view_holds_every_cell(view):
    x_min, x_max, z_min, z_max = view.section.extent
    inside = view.to_pixels([(x_min, z_min), (x_max, z_max)])
    cells = view.size / view.section.shape[::-1]
    assert inside == near(np.array([cells / 2, view.size - cells / 2]))
    assert view.zoomed(2).panned(30, 40).fitted() == view


@pytest.mark.parametrize(
    ("factor", "pixel"), [(0.01, (450, 300)), (0.9, (880, 20)), (3, (123.4, 567.8)), (1e6, (0, 0))]
)
def test_zoom_keeps_the_point_under_the_pointer(view, factor, pixel):
    zoomed = view.zoomed(2, at=(100, 100)).zoomed(factor, at=pixel)
    assert zoomed.to_section(pixel) == near(view.zoomed(2, at=(100, 100)).to_section(pixel))
    assert zoomed.exaggeration == pytest.approx(view.exaggeration)


@pytest.mark.parametrize(("factor", "pixel"), [(1.1, (0, 600)), (2, None), (10, (123, 456))])
def test_zoom_in_and_out_is_the_identity(factor, pixel):
    view = Viewport(DEPTH).zoomed(1.3, at=(500, 100))
    assert view.zoomed(factor, at=pixel).zoomed(1 / factor, at=pixel).window == near(view.window)


def test_zoom_has_limits(view):
    closest, farthest = view.zoomed(1e9, at=(30, 20)), view.zoomed(1e-9, at=(30, 20))
    for limit, factor in ((closest, 2), (farthest, 0.5)):
        assert limit.zoomed(factor).window == near(limit.window)
    x_min, x_max, z_min, z_max = closest.window
    across = (x_max - x_min) / view.section.dx, (z_max - z_min) / view.section.dz
    if view.section is not TINY:  # which is shown whole at the closest
        assert min(across) == pytest.approx(FEWEST)
    assert np.diff(farthest.window)[[0, 2]] == near(FARTHEST * np.diff(view.window)[[0, 2]])


def test_the_section_is_never_lost_from_sight():
    rng = np.random.default_rng(0)
    view = Viewport(DEPTH)
    for _ in range(300):
        if rng.random() < 0.5:
            view = view.zoomed(rng.choice([0.3, 3.0]), at=rng.uniform(0, 1, 2) * view.size)
        else:
            view = view.panned(*rng.normal(0, 2000, 2))
        left, top, width, height = view.picture
        assert -width - 0.01 <= left <= view.width + 0.01
        assert -height - 0.01 <= top <= view.height + 0.01
        assert left + width >= -0.01
        assert top + height >= -0.01


def test_pan_moves_the_picture_by_pixels(view):
    closer = view.zoomed(2)
    point = closer.to_section((400, 300))
    panned = closer.panned(12.5, -7)
    assert panned.to_pixels(point) == near((412.5, 293))
    assert panned.panned(-12.5, 7).window == near(closer.window)


def test_pan_keeps_the_middle_on_the_section(view):
    for way in ((1e6, 1e6), (-1e6, 1e6), (1e6, -1e6)):
        x, z = view.panned(*way).to_section(view.size / 2)
        x_min, x_max, z_min, z_max = view.whole
        assert x_min - 1e-6 <= x <= x_max + 1e-6
        assert z_min - 1e-6 <= z <= z_max + 1e-6


@pytest.mark.parametrize("value", [0.5, 10])
def test_exaggeration(view, value):
    view = view.zoomed(1.5).exaggerated(value)
    assert view.exaggeration == pytest.approx(value)
    rock = view.section.to_rock(view.to_section([(0, 0), (100, 0), (0, 100)]))
    assert (rock[1, 0] - rock[0, 0]) / (rock[2, 1] - rock[0, 1]) == pytest.approx(value)


def test_true_proportions_lie_in_the_middle():
    view = Viewport(DEPTH, 900, 600).exaggerated(1)
    left, top, width, height = view.picture
    assert (left, width) == near((0, 900))
    assert top == pytest.approx((600 - height) / 2)
    assert height == pytest.approx(900 * 200 * 10 / (300 * 25))


def test_the_exaggeration_of_a_time_section_is_of_rock():
    view = Viewport(TIME, 900, 600)
    rock = 300 * 12.5, 200 * 4 * 1.2  # metres
    assert view.exaggeration == pytest.approx((600 / rock[1]) / (900 / rock[0]))


def test_a_frame_is_fitted_instead_of_the_section(view):
    x_min, x_max, z_min, z_max = view.whole
    frame = x_min - 100, x_max + 50, z_min, z_max + 200
    framed = view.with_frame(frame)
    assert framed.window == framed.whole == frame
    assert framed.covered == view.whole
    closer = framed.zoomed(1.1, at=(0, 0))
    assert not closer.is_fitted
    assert closer.fitted() == framed
    assert closer.with_frame(None).window == closer.window
    assert framed.with_frame(None) == view
    farthest = framed.zoomed(1e-9)
    assert np.diff(farthest.window)[[0, 2]] == near(FARTHEST * np.diff(frame)[[0, 2]])


def test_another_section_in_the_same_view():
    view, part = Viewport(DEPTH, 500, 400, 2), sw.Section(NOISE[:50], dx=25.0, dz=10.0, x0=700_000.0)
    assert view.with_section(part) == Viewport(part, 500, 400, 2)
    closer = view.zoomed(2)
    assert closer.with_section(part).window == closer.window
    assert closer.with_section(TIME) == Viewport(TIME, 500, 400, 2)  # a window in metres means nothing there


def test_resizing(view):
    assert view.resized(500, 400).is_fitted
    closer = view.zoomed(1.5, at=(10, 10)).exaggerated(3)
    other = closer.resized(500, 400, 2)
    assert other.exaggeration == pytest.approx(3)
    assert other.window[:2] == near(closer.window[:2])
    assert other.resized(900, 600, 1).window == near(closer.window)


@pytest.mark.parametrize(("size", "zoom"), [((900, 600), 2.3), ((1900, 300), 0.5), ((120, 90), 1e6), ((20, 10), 17)])
def test_ticks_are_round_and_lie_in_the_window(view, zoom, size):
    view = view.resized(*size).zoomed(zoom, at=(0.7 * size[0], 0.2 * size[1]))
    x_min, x_max, z_min, z_max = view.window
    for number, (axis, low, high) in enumerate(zip(view.ticks(), (x_min, z_min), (x_max, z_max), strict=True)):
        assert len(axis.ticks) >= 2
        assert low <= axis.ticks[0] < axis.ticks[-1] <= high
        steps = np.diff(axis.ticks)
        assert steps == pytest.approx(steps[0])
        digits = steps[0] / 10 ** np.floor(np.log10(steps[0]) + 1e-9)
        assert min(abs(digits - np.array([1, 2, 5]))) < 1e-6
        assert np.array(axis.ticks) / steps[0] == pytest.approx(np.round(np.array(axis.ticks) / steps[0]), abs=1e-6)
        assert len(set(axis.labels)) == len(axis.labels)
        assert [float(label) for label in axis.labels] == pytest.approx(axis.ticks)
        points = np.tile(view.to_section((0, 0)), (len(axis.ticks), 1))
        points[:, number] = axis.ticks
        assert axis.pixels == pytest.approx(view.to_pixels(points)[:, number], abs=1e-6)


def test_axes_name_their_units():
    assert [axis.title for axis in Viewport(DEPTH).ticks()] == ["Distance (m)", "Depth (m)"]
    assert [axis.title for axis in Viewport(TIME).ticks()] == ["Distance (km)", "Two-way time (ms)"]
    assert Viewport(TIME).ticks()[0].labels[:3] == ("0.0", "0.5", "1.0")
    assert "-0" not in Viewport(DEPTH).zoomed(3, at=(0, 20)).ticks()[1].labels


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (lambda view: view.resized(0, 600), "width must be a finite number above 0, but is 0"),
        (lambda view: view.resized(900, np.nan), "height must be"),
        (lambda view: view.resized(900, 600, "two"), "pixel_ratio must be .* 'two'"),
        (lambda view: view.zoomed(0), "factor must be"),
        (lambda view: view.exaggerated(-1), "exaggeration must be .* above 0, but is -1"),
        (lambda view: Viewport(view.section, window=(0, 0, 1, 2)), "window must be .* each minimum first"),
        (lambda view: Viewport(view.section, window=(0, np.inf, 1, 2)), "window must be"),
        (lambda view: Viewport(view.section, window=(0, 1, 2)), "window must be"),
        (lambda view: Viewport(view.section, frame=(0, 1, 3, 2)), "frame must be"),
        (lambda view: view.with_frame("all"), "frame must be .* 'all'"),
    ],
)
def test_what_cannot_be_shown(change, message):
    with pytest.raises(sw.SettingError, match=message):
        change(Viewport(DEPTH))
