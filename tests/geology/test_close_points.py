"""Points of a drawing that lie closer than a mesh can show: the answer must be that of the drawing without them."""

import numpy as np
import pytest
from shapely import LineString, Point

import seiswidgets as sw
from tests.geology.answers import block_errors

SECTION = sw.Section(np.ones((101, 161), np.float32), dx=25, dz=20)
TIME = sw.Section(np.ones((101, 161), np.float32), dx=25, dz=10, z_unit="ms", velocity=4000.0)
STEEP = np.array([0.5, np.sqrt(3) / 2])
WIDTH, DEPTH, SLIP = 4000.0, 2000.0, 150.0


def at(z, x=1500.0):
    return np.array([x, 0]) + z / STEEP[1] * STEEP


def bed(z, slip, name, section=SECTION):
    footwall = at(z)
    hanging_wall = footwall + slip * STEEP
    left, right = [(0, z), footwall], [hanging_wall, (WIDTH, hanging_wall[1])]
    return sw.Horizon(section.from_rock(left), section.from_rock(right), name=name)


def slid(section, points, beds, spacing):
    fault = sw.Fault(section.from_rock(points), name="F")
    return sw.Restoration(section, spacing=spacing).unfault(fault, beds, fixed=(300, 500)).stages[-1].report


@pytest.mark.parametrize("section", [SECTION, TIME], ids=["depth", "time"])
@pytest.mark.parametrize("spacing", [30.0, 150.0])
@pytest.mark.parametrize("wall", [0, SLIP], ids=["footwall", "hanging wall"])
@pytest.mark.parametrize("off", [-0.09, 0.03, 0.1, 0.3])
def test_a_fault_point_beside_a_cut_off(section, spacing, wall, off):
    beds = [bed(z, SLIP, f"H{z}", section) for z in (500.0, 900.0, 1300.0)]
    report = slid(section, [at(0.0), at(900.0) + (wall + off) * STEEP, at(DEPTH)], beds, spacing)
    assert report.converged
    assert report.iterations <= 5
    assert max(cutoff.misfit for cutoff in report.cutoffs) < 1e-3
    assert report.findings == ()


@pytest.mark.parametrize("spacing", [30.0, None, 150.0])
@pytest.mark.parametrize("off", [0.02, 0.07, 0.1, 0.3, 2.0])
def test_two_cut_offs_beside_each_other(spacing, off):
    """The footwall's cut-off of one bed lies just below the hanging wall's of the bed above."""
    second = 500.0 + SLIP * STEEP[1] + off
    beds = [bed(500.0, SLIP, "H1"), bed(second, SLIP, "H2"), bed(1300.0, SLIP, "H3")]
    report = slid(SECTION, [at(0.0), at(DEPTH)], beds, spacing)
    assert report.converged
    assert max(cutoff.misfit for cutoff in report.cutoffs) < 1e-3
    assert report.findings == ()


@pytest.mark.parametrize("off", [0.1, 0.3, 1.0, 3.0])
def test_a_sliver_does_not_hold_a_fault_that_dies_out(off):
    beds = []
    for number, z in enumerate((500.0, 900.0, 1300.0), 1):
        throw = 200 * np.sqrt(1 - (z / 1700) ** 2)
        footwall, hanging_wall = at(z - throw / 2), at(z + throw / 2)
        x = np.linspace(hanging_wall[0], WIDTH, 40)
        drag = hanging_wall[1] - throw / 2 * (1 - np.exp((hanging_wall[0] - x) / 900))
        beds.append(sw.Horizon([(0, footwall[1]), footwall], np.column_stack([x, drag]), name=f"H{number}"))
    close = beds[1].pieces[0][-1] + off * STEEP
    fault = sw.Fault([at(0.0), at(400.0), close, at(1700.0)])
    report = sw.Restoration(SECTION).unfault(fault, beds).stages[-1].report
    assert report.converged
    assert report.iterations <= 15


@pytest.mark.parametrize("spacing", [30.0, None])
@pytest.mark.parametrize("off", [0.05, 0.1, 2.0])
@pytest.mark.parametrize("wall", [0, 1], ids=["footwall", "hanging wall"])
def test_points_of_a_listric_fault_beside_its_cut_offs(spacing, off, wall):
    case = sw.synthetic.listric_fault()
    (fault,), horizons = case.interpretation.faults, case.interpretation.horizons
    line = LineString(fault.points)
    ways = [line.project(Point(point)) for point in fault.points]
    ways += [line.project(Point(horizon.pieces[wall][wall - 1])) + off for horizon in horizons]
    points = [line.interpolate(way).coords[0] for way in sorted(ways)]
    stage = (
        sw.Restoration(case.section, spacing=spacing).unfault(sw.Fault(points), horizons, fixed=case.fixed).stages[-1]
    )
    errors, _ = block_errors(stage, case.to_unfaulted, case.block)
    assert stage.report.converged
    assert stage.report.iterations <= 5
    assert errors.max() < 2e-3 * 350
    assert stage.report.findings == ()


@pytest.mark.parametrize("off", [0.05, 0.1, 0.5, 2.0])
@pytest.mark.parametrize("spacing", [40.0, None])
def test_a_fault_point_beside_a_branch(off, spacing):
    """A block between two faults slides down both, whether or not a point is drawn beside the place where they meet."""
    meeting = at(1400.0)
    other = sw.Fault([(3100.0, 0.0), meeting], name="antithetic")
    down = (meeting - [3100, 0]) / np.hypot(*(meeting - [3100, 0]))
    reports = []
    for points in ([at(0.0), at(DEPTH)], [at(0.0), meeting + off * STEEP, at(DEPTH)]):
        beds = []
        for number, z in enumerate((400.0, 800.0), 1):
            left, right = at(z), np.array([3100, 0]) + z / down[1] * down
            sunk = z + 50.0
            inner = [at(sunk), np.array([3100, 0]) + sunk / down[1] * down]
            beds.append(sw.Horizon([(0, z), left], inner, [right, (WIDTH, z)], name=f"H{number}"))
        start = sw.Restoration(SECTION, spacing=spacing)
        reports.append(start.unfault([sw.Fault(points, name="main"), other], beds).stages[-1].report)
    plain, crowded = reports
    assert plain.converged
    assert crowded.converged
    assert crowded.iterations <= plain.iterations + 10
    for before, after in zip(plain.cutoffs, crowded.cutoffs, strict=True):
        assert after.throw == pytest.approx(before.throw, abs=0.01)
        assert after.misfit == pytest.approx(before.misfit, abs=0.2)


@pytest.mark.parametrize("off", [-3.0, -0.3, -0.02, 0.02, 0.3, 3.0])
def test_a_horizon_that_passes_a_tip_nearly(off):
    """A fault that dies out a little above or below a horizon might as well die out on it."""
    beds = []
    for number, z in enumerate((500.0, 900.0, 1300.0), 1):
        throw = 120 * np.sqrt(1 - (z / 1700) ** 2)
        footwall, hanging_wall = at(z - throw / 2), at(z + throw / 2)
        x = np.linspace(hanging_wall[0], WIDTH, 20)
        drag = hanging_wall[1] - throw / 2 * (1 - np.exp((hanging_wall[0] - x) / 900))
        beds.append(sw.Horizon([(0, footwall[1]), footwall], np.column_stack([x, drag]), name=f"H{number}"))
    beds.append(sw.Horizon([(0, 1700 + off), (WIDTH, 1700 + off)], name="at the tip"))
    report = sw.Restoration(SECTION, spacing=100).unfault(sw.Fault([at(0.0), at(1700.0)]), beds).stages[-1].report
    assert report.converged
    assert report.iterations <= 10


def graben(off):
    """An antithetic fault that ends on the main one, at some distance from a cut-off there."""
    sunk, meeting = 40.0, at(1300.0 + off)
    start = np.array([3100.0, 0.0])
    down = (meeting - start) / np.hypot(*(meeting - start))
    beds = []
    for z in (400.0, 850.0):
        inner = [at(z + sunk), start + (z + sunk) / down[1] * down]
        beds.append(sw.Horizon([(0, z), at(z)], inner, [start + z / down[1] * down, (WIDTH, z)], name=f"H{z}"))
    beds.append(sw.Horizon([(0, 1300), at(1300)], [at(1300), (WIDTH, 1300)], name="below"))
    return [sw.Fault([at(0.0), at(DEPTH)], name="main"), sw.Fault([start, meeting], name="antithetic")], beds


@pytest.mark.parametrize("off", [-3.0, -0.1, 0.1, 3.0])
def test_a_fault_that_ends_beside_a_cut_off_of_another(off):
    report = sw.Restoration(SECTION, spacing=100).unfault(*graben(off)).stages[-1].report
    assert report.converged
    assert report.iterations <= 12


def test_the_mesh_depends_neither_on_the_order_of_picks_nor_on_their_directions():
    faults, beds = graben(0.5)
    turned = [sw.Fault(fault.points[::-1], name=fault.name) for fault in faults[::-1]]
    mirrored = [sw.Horizon(*(piece[::-1] for piece in bed.pieces[::-1]), name=bed.name) for bed in beds[::-1]]
    start = sw.Restoration(SECTION, spacing=100)
    one, other = (start.unfault(*picks).stages[-1] for picks in ((faults, beds), (turned, mirrored)))
    found, again = (np.unique(np.round(stage.mesh_setup.mesh.vertices, 5), axis=0) for stage in (one, other))
    np.testing.assert_array_equal(again, found)
    assert one.report.iterations == other.report.iterations
