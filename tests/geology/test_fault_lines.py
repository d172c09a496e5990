"""Faults as they are cut: tidied, joined to what they nearly reach, and told apart."""

from dataclasses import replace

import numpy as np
import pytest
import shapely
from shapely import LineString

import seiswidgets as sw
from seiswidgets.geology.domain import RestorationDomain
from seiswidgets.geology.fault_lines import MERGED, NEAR, fault_lines, merge_close_points, resample_fine

SECTION = sw.Section(np.ones((101, 201), np.float32), dx=10, dz=10)
SPACING = 100.0
GROUND = RestorationDomain(shapely.box(0, 0, 2000, 1000), SECTION, SPACING)
CLOSE, FAR = 0.9 * NEAR * 10, 1.1 * NEAR * 10


def lines(**faults):
    return {name: shapely.get_coordinates(line) for name, line in fault_lines(arrays(faults), GROUND).items()}


def arrays(faults):
    return {name: np.array(points, float) for name, points in faults.items()}


@pytest.mark.parametrize("turned", [1, -1])
def test_tips_near_the_border_meet_it(turned):
    drawn = [(800, CLOSE), (900, 500), (1000, 1000 - CLOSE)][::turned]
    line = lines(F=drawn)["F"][::turned]
    slope = 100 / (500 - CLOSE)  # straight ahead
    np.testing.assert_allclose(line, [(900 - 500 * slope, 0), (900, 500), (900 + 500 * slope, 1000)])


@pytest.mark.parametrize("spacing", [40.0, 100.0, 250.0])
@pytest.mark.parametrize("short", [5.0, CLOSE, FAR, 60.0])
def test_the_mesh_does_not_decide_which_ends_meet_the_border(spacing, short):
    found = fault_lines({"F": np.array([(900.0, short), (1000, 1000)])}, replace(GROUND, requested_spacing=spacing))
    assert (found["F"].coords[0][1] == 0) == (short < FAR)


@pytest.mark.parametrize("turned", [1, -1])
def test_a_chosen_tip_stays_and_an_end_to_extend_reaches_what_lies_ahead(turned):
    drawn = np.array([(900.0, 5), (900, 400)])[::turned]
    found = fault_lines({"F": drawn}, GROUND, {"F": ("tip", "extend")[::turned]})["F"]
    np.testing.assert_allclose(found.coords[::turned], [(900, 5), (900, 1000)])
    both = fault_lines(arrays({"F": drawn, "sill": [(100, 700), (1800, 700)]}), GROUND, {"F": ("extend", "extend")})
    np.testing.assert_allclose(both["F"].coords[::turned], [(900, 0), (900, 700)])


def test_a_gentle_fault_is_drawn_on_straight_ahead_not_upwards():
    found = lines(F=[(1300, 300), (500, 20)])["F"]
    np.testing.assert_allclose(found, [(1300, 300), (500 - 20 * 800 / 280, 0)])


def test_lines_depend_neither_on_the_order_of_the_faults_nor_on_their_direction():
    drawn = {
        "long": [(1000, 10), (1000, 990)],
        "near": [(500, 505), (985, 500)],
        "over": [(1500, 300), (980, 310)],
        "tip to tip": [(480, 505), (100, 400)],
    }
    found = lines(**drawn)
    other = lines(**{name: points[::-1] for name, points in list(drawn.items())[::-1]})
    for name, line in found.items():
        np.testing.assert_allclose(other[name][::-1], line, atol=1e-9)


@pytest.mark.parametrize("step", [2.0, 7.0, 60.0])
@pytest.mark.parametrize("jitter", [0.0, 1.5])
def test_fine_digitising_is_resampled(step, jitter):
    z = np.arange(0, 1000 + step / 2, step)
    noise = np.random.default_rng(3).normal(size=len(z)) * jitter
    noise[[0, -1]] = 0
    bend = np.where(z < 500, 0, 0.5 * (z - 500))
    found = resample_fine(np.column_stack([800 + bend + noise, z]), GROUND)
    assert np.hypot(*np.diff(found, axis=0).T).min() > min(step, 0.25 * SPACING)
    assert np.abs(found[:, 0] - 800 - np.interp(found[:, 1], z, bend)).max() < 2 * jitter + 4


def test_tips_far_from_the_border_stay():
    drawn = [(800, FAR), (1000, 1000 - FAR)]
    np.testing.assert_array_equal(lines(F=drawn)["F"], drawn)


def test_faults_that_reach_the_border_exactly_stay():
    drawn = [(800, 0), (1000, 1000)]
    np.testing.assert_array_equal(lines(F=drawn)["F"], drawn)


@pytest.mark.parametrize("turned", [1, -1])
@pytest.mark.parametrize("order", [1, -1])
def test_tips_near_another_fault_meet_it(turned, order):
    main, branch = [(1000, 0), (1000, 1000)], [(500, 0), (1000 - CLOSE, 500)][::turned]
    found = lines(**dict([("main", main), ("branch", branch)][::order]))
    np.testing.assert_array_equal(found["main"], main)
    np.testing.assert_allclose(found["branch"][::turned], [(500, 0), (1000, 500 + 500 * CLOSE / (500 - CLOSE))])


@pytest.mark.parametrize("turned", [1, -1])
@pytest.mark.parametrize("order", [1, -1])
def test_overshoots_beyond_another_fault_are_trimmed(turned, order):
    main, branch = [(1000, 0), (1000, 1000)], [(500, 500), (1000 + CLOSE, 500)][::turned]
    found = lines(**dict([("main", main), ("branch", branch)][::order]))
    np.testing.assert_allclose(found["branch"][::turned], [(500, 500), (1000, 500)])


def test_faults_that_cross_stay_whole():
    one, other = [(500, 0), (1500, 1000)], [(1500, 0), (500, 1000)]
    found = lines(one=one, other=other)
    np.testing.assert_array_equal(found["one"], one)
    np.testing.assert_array_equal(found["other"], other)


def test_two_tips_that_nearly_meet_are_joined_once():
    found = lines(one=[(300, 500), (990, 500)], other=[(1010, 500), (1700, 500)])
    gap = LineString(found["one"]).distance(LineString(found["other"]))
    assert gap == 0
    assert LineString(found["one"]).intersection(LineString(found["other"])).length == 0


@pytest.mark.parametrize("count", [2, 3, 10])
def test_repeated_points_are_merged(count):
    rng = np.random.default_rng(count)
    corners = np.array([(800.0, 0), (900, 500), (1000, 1000)])
    crowd = np.repeat(corners, count, axis=0)
    crowd[1::count] += rng.uniform(-0.4, 0.4, (3, 2)) * MERGED * SPACING
    crowd[count - 1 :: count] = corners
    np.testing.assert_array_equal(merge_close_points(crowd, SPACING)[[0, -1]], corners[[0, -1]])
    assert len(merge_close_points(crowd, SPACING)) == 3
    np.testing.assert_allclose(merge_close_points(crowd, SPACING), corners, atol=MERGED * SPACING)


def test_points_farther_apart_stay():
    points = np.array([(0, 0), (0, 1.1), (0, 2.2), (0, 3.3)]) * MERGED * SPACING
    np.testing.assert_array_equal(merge_close_points(points, SPACING), points)


@pytest.mark.parametrize("length", [0.5, 20, 30])
def test_faults_that_are_too_short(length):
    with pytest.raises(sw.PickError, match=r"fault 'F' near x=800 m, z=300 m is no longer than three traces"):
        lines(F=[(800, 300), (800, 300 + length)])


@pytest.mark.parametrize("spacing", [20.0, 300.0])
def test_the_mesh_does_not_decide_whether_a_fault_is_too_short(spacing):
    domain = replace(GROUND, requested_spacing=spacing)
    assert len(fault_lines({"F": np.array([(800.0, 300), (800, 331)])}, domain)["F"].coords) == 2
    bed = sw.Horizon([(0, 310), (800, 310)], [(800, 314), (2000, 314)])
    stage = sw.Restoration(SECTION, spacing=spacing).unfault(sw.Fault([(800, 290), (800, 340)]), bed).stages[-1]
    assert stage.report.converged


@pytest.mark.parametrize("turned", [1, -1])
def test_faults_that_turn_back(turned):
    spike = [(700, 0), (790, 450), (780, 395), (791, 455), (900, 1000)]
    with pytest.raises(sw.PickError, match=r"fault 'F' turns back on itself near x=7[89]\d m, z=(450|395) m; leave"):
        lines(F=spike[::turned])


def test_a_zigzag_that_does_not():
    zigzag = [(700, 0), (790, 450), (740, 390), (800, 500), (900, 1000)]
    np.testing.assert_array_equal(lines(F=zigzag)["F"], zigzag)


@pytest.mark.parametrize("offset", [0, 1, 4])
@pytest.mark.parametrize("turned", [1, -1])
def test_faults_on_top_of_each_other(offset, turned):
    one, other = [(800, 0), (800, 1000)], [(800 + offset, 200), (800 + offset, 700)][::turned]
    with pytest.raises(sw.PickError, match=r"faults 'one' and 'other' lie on top of each other near x=80\d m, z=450 m"):
        lines(one=one, other=other)


def test_faults_side_by_side():
    one, other = [(800, 0), (800, 1000)], [(820, 200), (820, 700)]
    assert set(lines(one=one, other=other)) == {"one", "other"}


@pytest.mark.parametrize(
    "tips",
    [(0, 1000), (CLOSE, 1000), (FAR, 1000), (1e-9, 1000), (0, 1000 - 1e-7), (5, 995)],
)
def test_a_section_comes_apart_where_its_fault_meets_the_border(tips):
    fault = sw.Fault([(900, tips[0]), (1100, tips[1])])
    horizon = sw.Horizon([(0, 400), (980, 400)], [(1000, 500), (2000, 500)])
    start = sw.Restoration(SECTION, spacing=SPACING)
    stage = start.unfault(fault, horizon, fixed=(100, 100)).stages[0]
    assert stage.mesh.blocks.max() == (0 if tips[0] == FAR else 1)
    if tips[0] == FAR:
        return
    still = np.hypot(*(stage.vertices - stage.mesh.vertices).T) == 0
    assert 0.3 < still.mean() < 0.7  # one block of two
    assert stage.report.converged
