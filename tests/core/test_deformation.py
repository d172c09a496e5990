import numpy as np
import pytest
import shapely

from seiswidgets.core.deformation import (
    area_ratio,
    area_ratio_histogram,
    colour_span,
    principal_stretches,
    weighted_percentiles,
)
from seiswidgets.core.triangulation import triangulate
from seiswidgets.errors import SettingError


@pytest.fixture(scope="module")
def mesh():
    return triangulate(shapely.box(0, 0, 40, 30), [shapely.LineString([(10, 5), (30, 25)])], 3.0)


def rotation(angle):
    return np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])


@pytest.mark.parametrize("factor", [0.25, 1.0, 3.0])
def test_scaling_has_one_area_ratio_and_one_stretch(mesh, factor):
    scaled = factor * mesh.vertices
    np.testing.assert_allclose(area_ratio(mesh, scaled), factor**-2, rtol=1e-10)
    np.testing.assert_allclose(principal_stretches(mesh, scaled), factor, rtol=1e-7)


def test_compression_has_an_area_ratio_above_one(mesh):
    assert np.all(area_ratio(mesh, mesh.vertices * [0.8, 1.0]) > 1)


def test_area_ratio_is_initial_over_final_area(mesh):
    rng = np.random.default_rng(1)
    vertices = mesh.vertices + rng.normal(scale=0.1, size=mesh.vertices.shape)
    corners = vertices[mesh.triangles]
    final = np.array([shapely.Polygon(triangle).area for triangle in corners])
    np.testing.assert_allclose(area_ratio(mesh, vertices), mesh.areas / final, rtol=1e-9)


@pytest.mark.parametrize("shear", [0.0, 0.3, 2.0])
def test_simple_shear_has_its_textbook_stretches(mesh, shear):
    stretches = principal_stretches(mesh, mesh.vertices @ np.array([[1.0, shear], [0.0, 1.0]]).T)
    larger = np.sqrt(1 + shear**2 / 4) + shear / 2
    np.testing.assert_allclose(stretches, np.tile([larger, 1 / larger], (len(mesh.triangles), 1)), rtol=1e-7)


def test_stretches_are_singular_values_and_forget_turns(mesh):
    rng = np.random.default_rng(2)
    vertices = mesh.vertices + rng.normal(scale=0.3, size=mesh.vertices.shape)
    before, after = (
        points[mesh.triangles[:, 1:]] - points[mesh.triangles[:, :1]] for points in (mesh.vertices, vertices)
    )
    expected = np.linalg.svd(np.linalg.solve(before, after), compute_uv=False)
    np.testing.assert_allclose(principal_stretches(mesh, vertices), expected, atol=1e-10)
    turned = vertices @ rotation(0.7).T + [100, -50]
    np.testing.assert_allclose(principal_stretches(mesh, turned), expected, atol=1e-10)


def test_area_ratio_is_one_over_the_product_of_stretches(mesh):
    vertices = mesh.vertices + np.random.default_rng(3).normal(scale=0.1, size=mesh.vertices.shape)
    product = principal_stretches(mesh, vertices).prod(axis=1)
    np.testing.assert_allclose(area_ratio(mesh, vertices) * product, 1, rtol=1e-10)


def test_histogram_is_symmetric_about_one_and_counts_all_of_the_area():
    rng = np.random.default_rng(4)
    ratio, areas = np.exp(rng.normal(scale=0.2, size=500)), rng.uniform(1, 5, 500)
    edges, shares = area_ratio_histogram(ratio, areas)
    assert len(shares) == len(edges) - 1 == 41
    np.testing.assert_allclose(edges * edges[::-1], 1)
    assert edges[0] <= ratio.min() * (1 + 1e-12)
    assert edges[-1] >= ratio.max() * (1 - 1e-12)
    assert shares.sum() == pytest.approx(1)


def test_histogram_weighs_by_area_and_keeps_what_lies_beyond_its_ends():
    _, shares = area_ratio_histogram([0.01, 1.0, 1.0, 50.0], [1.0, 2.0, 3.0, 4.0], bins=5, span=2.0)
    np.testing.assert_allclose(shares, [0.1, 0, 0.5, 0, 0.4])


def test_histogram_of_nothing_deformed_has_all_of_the_area_in_the_middle(mesh):
    _, shares = area_ratio_histogram(area_ratio(mesh, mesh.vertices), mesh.areas, bins=3)
    np.testing.assert_allclose(shares, [0, 1, 0])


@pytest.mark.parametrize("span", [1.0, 0.5, np.nan])
def test_histogram_refuses_a_span_that_is_not_above_one(span):
    with pytest.raises(SettingError, match="span must be above 1"):
        area_ratio_histogram([1.0], [1.0], span=span)


def test_percentiles_of_equal_weights_are_numpys():
    values = np.random.default_rng(5).normal(size=101)
    percents = [0, 3, 5, 50, 77.7, 95, 100]
    expected = np.percentile(values, percents, method="hazen")
    np.testing.assert_allclose(weighted_percentiles(values, np.full(101, 7.0), percents), expected, atol=1e-12)


def test_percentiles_follow_the_weight():
    assert weighted_percentiles([1.0, 2.0, 3.0], [1.0, 1.0, 998.0], 50) == pytest.approx(3, abs=0.01)


def test_a_weight_in_pieces_gives_the_same_median():
    rng = np.random.default_rng(6)
    values, weights = rng.normal(size=400), rng.integers(1, 5, 400)
    whole = weighted_percentiles(values, weights, [10, 50, 90])
    pieces = weighted_percentiles(np.repeat(values, weights), np.ones(weights.sum()), [10, 50, 90])
    np.testing.assert_allclose(whole, pieces, atol=0.02)


@pytest.mark.parametrize(("share", "span"), [(0.005, 1.02), (0.05, 1.5)])
def test_colours_end_at_the_round_ratio_that_holds_98_percent_of_the_area(share, span):
    ratio = np.where(np.arange(1000) < 1000 * share, 1 / 1.4, 1.01)
    assert colour_span(ratio, np.ones(1000)) == span
    assert colour_span(1 / ratio, np.ones(1000)) == span


def test_colours_end_somewhere_however_strong_the_deformation():
    assert colour_span([0.01, 100.0], [1.0, 1.0]) == 5.0
