import numpy as np
import pytest
import shapely

import seiswidgets as sw
from seiswidgets.interaction.projection import PaneProjection, side_of
from seiswidgets.interaction.viewport import Viewport


@pytest.fixture(scope="module")
def case():
    return sw.synthetic.planar_fault()


@pytest.fixture(scope="module")
def projection(case):
    picks = case.interpretation
    restored = sw.Restoration(case.section, 60.0).unfault(picks.faults, picks.horizons, fixed=case.fixed)
    return PaneProjection(Viewport(restored.section, 800, 600), restored)


def test_the_original_is_seen_as_it_is(case):
    projection = PaneProjection(Viewport(case.section))
    line = case.interpretation.faults[0].points
    np.testing.assert_array_equal(projection.lines([(line, 1)])[0], line)
    np.testing.assert_array_equal(projection.path(line[0], line[-1])[0], line[[0, -1]])
    assert projection.to_original(line[0]) == tuple(line[0])


def test_a_line_is_shown_where_its_points_are_restored_to(case, projection):
    line = case.interpretation.horizons[0].pieces[0][:2]
    (shown,) = projection.lines([(line, 0)])
    shown = shown[np.isfinite(shown).all(axis=1)]
    ways = np.linspace(0.02, 0.98, 50)[:, None]
    there = projection.to_pane(line[0] + ways * (line[1] - line[0]))
    np.testing.assert_allclose(np.interp(there[:, 0], *shown[np.argsort(shown[:, 0])].T), there[:, 1], atol=0.2)


def test_a_line_across_a_fault_is_interrupted_there(case, projection):
    x_min, x_max, z_min, z_max = case.section.extent
    level = (z_min + z_max) / 2
    (shown,) = projection.lines([([(x_min, level), (x_max, level)], 0)])
    assert np.isnan(shown).all(axis=1).sum() == 2  # one in between and one at the end


def test_a_fault_is_shown_whole_on_one_of_its_sides(case, projection):
    fault = case.interpretation.faults[0].points
    (shown,), (vertices,) = projection.lines([(fault, 1)]), projection.vertices([(fault, 1)])
    assert np.isnan(shown).all(axis=1).sum() == 1
    np.testing.assert_allclose(vertices[0], shown[0], atol=1e-6)
    np.testing.assert_allclose(vertices[-1], shown[-2], atol=1e-6)


def test_many_lines_at_once_are_shown_as_each_alone(case, projection):
    lines = [(piece, 0) for horizon in case.interpretation.horizons for piece in horizon.pieces]
    for together, line in zip(projection.lines(lines), lines, strict=True):
        np.testing.assert_array_equal(together, projection.lines([line])[0])
    assert projection.lines([]) == projection.vertices([]) == []


def test_a_path_and_its_way_back_are_the_straight_line(case, projection):
    x_min, x_max, z_min, z_max = case.section.extent
    start, end = ((x_min + share * (x_max - x_min), z_min + 0.5 * (z_max - z_min)) for share in (0.1, 0.9))
    runs = projection.path(projection.to_original(start), projection.to_original(end))
    assert len(runs) == 2
    np.testing.assert_allclose(runs[0][0], projection.to_original(start))
    np.testing.assert_allclose(runs[-1][-1], projection.to_original(end))
    back = projection.to_pane(np.concatenate(runs))
    assert np.isfinite(back).all()
    np.testing.assert_allclose(back[:, 1], start[1], atol=0.2 * case.section.dz)


def test_a_body_is_shown_with_the_rock_around_it(case):
    """Its border moves with the rock outside, whichever way round it was drawn."""
    corners = [(700.0, 1200.0), (1000.0, 1150.0), (1100.0, 1500.0), (800.0, 1600.0)]
    body = sw.Body(corners, name="B1")
    restored = sw.Restoration(case.section, spacing=120, bodies=[body]).flatten(case.interpretation.horizons[0])
    (border,) = restored.carried(body)
    projection = PaneProjection(Viewport(restored.section), restored)
    for points in (corners, corners[::-1]):
        (shown,) = projection.lines([([*points, points[0]], side_of("body", points))])
        rows = shown[np.isfinite(shown).all(axis=1)]
        assert len(rows) >= len(corners)
        assert shapely.LineString(border).distance(shapely.points(rows)).max() < 1


def test_a_horizon_that_became_the_border_is_not_interrupted():
    case = sw.synthetic.half_graben(dx=25, dz=10)
    top, faults = case.interpretation.horizon("H2"), case.interpretation.faults
    restored = sw.Restoration(case.section).strip(top, faults=faults).unfault(faults, [top], fixed=case.fixed)
    projection = PaneProjection(Viewport(case.section), restored)
    for piece, line in zip(top.pieces, projection.lines([(piece, 0) for piece in top.pieces]), strict=True):
        assert np.isnan(line[:, 0]).sum() == 1  # at its end
        assert np.ptp(line[:-1, 0]) > 0.98 * np.ptp(piece[:, 0])
