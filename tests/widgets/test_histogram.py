import matplotlib as mpl
import numpy as np
import pytest

import seiswidgets as sw
from seiswidgets.core.deformation import AREA_RATIO_COLOURS, area_ratio_histogram, colour_span, weighted_percentiles
from seiswidgets.interaction.colour import RatioColouring
from seiswidgets.interaction.ratio_axis import TICK_DISTANCE, ratio_ticks


@pytest.fixture
def numbers():
    """Area ratios about 1, and areas."""
    random = np.random.default_rng(5)
    return np.exp(random.normal(0, 0.05, 400)), random.uniform(1, 3, 400)


def test_levels_are_even_in_the_logarithm():
    colouring = RatioColouring(4.0)
    assert colouring.levels([0.25, 1, 4]).tolist() == [1, 128, 255]
    assert colouring.levels([0.01, 100, np.nan]).tolist() == [1, 255, 0]
    ratio = np.exp(np.random.default_rng(0).uniform(-1, 1, 50))
    np.testing.assert_array_equal(colouring.levels(ratio).astype(int) + colouring.levels(1 / ratio), 256)
    assert colouring.levels(np.ones((3, 4))).shape == (3, 4)
    assert colouring.levels(ratio).dtype == np.uint8


def test_the_palette_is_that_of_the_deformation_map():
    palette = RatioColouring(2.0).palette()
    assert palette.shape == (256, 4)
    assert palette.dtype == np.uint8
    assert palette[0, 3] == 0
    norm = mpl.colors.LogNorm(0.5, 2)
    for ratio in (0.5, 0.7, 1.0, 1.3, 2.0):
        expected = 255 * np.array(mpl.colormaps[AREA_RATIO_COLOURS](norm(ratio)))
        np.testing.assert_allclose(palette[RatioColouring(2.0).levels(ratio), :3], expected[:3], atol=4)


def test_what_has_kept_its_area_is_clear_and_what_has_changed_most_is_opaque():
    alpha = RatioColouring(2.0).palette()[:, 3].astype(int)
    assert alpha[128] == 0
    assert alpha[1] == alpha[255] == 255
    assert (np.diff(alpha[1:129]) <= 0).all()
    assert (np.diff(alpha[128:]) >= 0).all()


def test_what_lies_in_the_brush_is_lit_and_nothing_else():
    colouring = RatioColouring(2.0)
    ratio = np.exp(np.random.default_rng(1).uniform(-0.8, 0.8, 500))  # some beyond the span
    low, high = 0.9, 1.3
    alpha = colouring.palette((low, high))[colouring.levels(ratio), 3]
    assert (alpha[(ratio >= low) & (ratio <= high)] == 255).all()
    level = 2.0 ** (1 / 127)
    assert alpha[(ratio < low / level) | (ratio > high * level)].max() <= 0.12 * 255 + 1
    assert colouring.palette((low, high))[0, 3] == 0


def test_a_brush_to_the_end_holds_what_lies_beyond():
    colouring = RatioColouring(2.0)
    assert colouring.palette((1.5, 2.0))[colouring.levels(50.0), 3] == 255


def test_the_span_is_that_of_figures(numbers):
    ratio, areas = numbers
    assert RatioColouring.of([*ratio, np.nan], [*areas, 1.0]).span == colour_span(ratio, areas)
    assert RatioColouring.of([]).span > 1
    assert RatioColouring.of([np.nan]).span > 1


def test_bars_are_the_histogram_in_the_colours_of_the_map(numbers):
    widget = sw.DeformationHistogram(*numbers)
    edges, shares = area_ratio_histogram(*numbers, span=1.1)
    assert widget.bars["edges"] == edges.tolist()
    assert widget.bars["shares"] == shares.tolist()
    middles = np.sqrt(edges[:-1] * edges[1:])
    palette = widget.colouring.palette()[widget.colouring.levels(middles)]
    assert widget.bars["colours"] == ["#{:02x}{:02x}{:02x}".format(*colour) for colour in palette[:, :3]]


def test_median_and_percentiles_are_by_area(numbers):
    low, median, high = weighted_percentiles(*numbers, (1, 50, 99))
    summary = sw.DeformationHistogram(*numbers).summary
    assert f"median {median:.3f}" in summary
    assert f"P1 {low:.3f}" in summary
    assert f"P99 {high:.3f}" in summary


def test_the_scale_is_fixed_unless_it_is_set_and_says_so(numbers):
    widget = sw.DeformationHistogram([0.99, 1.01])
    edges = widget.bars["edges"]
    assert widget.summary.endswith("; scale ±10%")
    widget.show([0.5, 1.0, 1.0, 2.0])
    assert widget.bars["edges"] == edges
    assert widget.summary.endswith("; scale ±10%, 50% of the area beyond")
    widget.span = 1.25
    assert widget.bars["edges"][-1] == pytest.approx(1.25)
    assert "scale ±25%, rescaled" in widget.summary
    with pytest.raises(sw.SettingError, match="span must be above 1"):
        widget.span = 1.0


def test_a_logarithmic_axis_shows_rare_ratios():
    widget = sw.DeformationHistogram([0.95, 1.0], [1e-4, 1.0], log_shares=True)
    assert widget.bars["floor"] == pytest.approx(1e-5)
    assert [label for _, label in widget.bars["y"]] == ["0.001", "0.01", "0.1", "1", "10", "100"]
    widget.log_shares = False
    assert widget.bars["floor"] == 0
    assert widget.bars["y"][0] == [0, "0"]


def test_areas_count(numbers):
    widget = sw.DeformationHistogram([0.9, 1.1], [3, 1], bins=3)
    np.testing.assert_allclose(widget.bars["shares"], [0.75, 0, 0.25])
    widget.show([0.9, 1.1])
    np.testing.assert_allclose(widget.bars["shares"], [0.5, 0, 0.5])


def test_nothing_restored_is_said_in_words():
    widget = sw.DeformationHistogram()
    assert widget.bars == {}
    assert "Nothing restored" in widget.summary
    widget.show([1.0, 1.1])
    assert "Nothing" not in widget.summary
    widget.show([np.nan])
    assert widget.bars == {}
    assert "Nothing restored" in widget.summary


def test_rock_that_has_only_moved_has_its_bar_at_1():
    bars = sw.DeformationHistogram(np.ones(10)).bars
    assert np.argmax(bars["shares"]) == 20
    assert bars["edges"][20] < 1 < bars["edges"][21]


def test_triangles_without_a_ratio_are_left_out(numbers):
    ratio, areas = numbers
    widget = sw.DeformationHistogram([np.nan, *ratio], [1e9, *areas])
    assert widget.bars == sw.DeformationHistogram(ratio, areas).bars


def test_the_share_of_the_brush_is_that_of_the_bars_in_it(numbers):
    widget = sw.DeformationHistogram(*numbers)
    edges, shares = widget.bars["edges"], widget.bars["shares"]
    widget.brush = [edges[18], edges[23]]
    assert f"{100 * sum(shares[18:23]):.3g}% of the area" in widget.brushed
    widget.brush = [edges[0], edges[-1]]
    assert widget.brushed.endswith("100% of the area")
    widget.brush = []
    assert widget.brushed == ""


def test_the_brush_stays_when_the_numbers_change(numbers):
    widget = sw.DeformationHistogram([0.9, 1.1])
    widget.brush = [0.8, 1.0]
    assert "50% of the area" in widget.brushed
    widget.show([0.9, 0.91, 0.92, 1.1])
    assert widget.brush == [0.8, 1.0]
    assert "75% of the area" in widget.brushed
    widget.show([])
    assert widget.brushed == ""


def test_edges_of_neighbouring_bars_read_differently():
    for span in (1.01, 1.3, 5.0):
        bars = sw.DeformationHistogram([1 / span, span]).bars
        texts = [f"{edge:.{bars['decimals']}f}" for edge in bars["edges"]]
        assert len(set(texts)) >= 0.9 * len(texts)


@pytest.mark.parametrize(("span", "some"), [(1.01, 1.005), (1.2, 0.9), (1.3, 1.25), (2.5, 0.5), (12, 10), (2000, 100)])
def test_ticks_are_round_and_apart(span, some):
    ticks = ratio_ticks(span)
    assert {1, some} <= set(ticks)
    assert 3 <= len(ticks) <= 11
    assert min(ticks) >= 1 / span
    assert max(ticks) <= span
    assert (np.diff(np.log(ticks)) >= 2 * TICK_DISTANCE * np.log(span) * (1 - 1e-9)).all()


@pytest.mark.parametrize("brush", [[1.0], [1.1, 0.9], [0, 1], [0.9, np.nan], ["a", "b"], [0.9, 1, 1.1]])
def test_a_brush_is_a_range(brush):
    widget = sw.DeformationHistogram([1.0])
    with pytest.raises(sw.SettingError, match="brush must be"):
        widget.brush = brush
    assert widget.brush == []


@pytest.mark.parametrize(
    ("ratio", "areas", "words"),
    [
        ([1, 2], [1], "one area ratio and one area"),
        ([[1, 2]], None, "one area ratio and one area"),
        ([1, 0], None, "above 0"),
        ([1, np.inf], None, "finite"),
        ([1, 2], [1, -1], "areas must be"),
        ([1, 2], [0, 0], "not all of them 0"),
    ],
)
def test_numbers_are_checked(ratio, areas, words):
    with pytest.raises(sw.SettingError, match=words):
        sw.DeformationHistogram(ratio, areas)
    with pytest.raises(sw.SettingError, match="at least one bin"):
        sw.DeformationHistogram([1], bins=0)
