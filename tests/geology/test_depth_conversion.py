"""Conversion between two-way time and depth, against closed forms and a planar fault of known throw."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import seiswidgets as sw
from tests.geology.answers import random_points

V0, K = 1800.0, 0.8
TABLE = sw.TimeDepthTable([0, 0.5, 1.5], [0, 450, 2100], time_unit="s", source="checkshot of well 1")
UPPER = sw.Horizon([(0, 400), (1500, 500)], [(1600, 700), (3600, 650)], name="upper")
LOWER = sw.Horizon([(0, 900), (2000, 690), (3600, 800)], name="lower")  # it meets the upper one in one point
CAKE = sw.LayerCake([UPPER, LOWER], [1800, 2400, 3500])
MODELS = [sw.ConstantVelocity(2200), sw.LinearVelocity(V0, K), sw.LinearVelocity(V0, 0), TABLE, CAKE]


def timed(z_unit="ms", x_unit="m"):
    amplitude = np.random.default_rng(0).normal(size=(300, 150))
    step = {"ms": 4.0, "s": 0.004}[z_unit]
    return sw.Section(amplitude, 25.0, step, z0=25 * step, x_unit=x_unit, z_unit=z_unit, velocity=2000)


@pytest.mark.parametrize("model", MODELS, ids=str)
def test_to_depth_and_back_is_the_identity(model):
    section = timed()
    conversion = section.to_depth(model).conversion
    points = random_points(section, 2000)
    np.testing.assert_allclose(conversion.to_time(conversion.to_depth(points)), points, atol=1e-6 * section.dz)


@pytest.mark.parametrize("model", MODELS, ids=str)
def test_the_section_in_depth_covers_all_samples_and_its_samples_lie_no_farther_apart_than_theirs(model):
    section = timed()
    deep = section.to_depth(model)
    nodes = np.stack(np.meshgrid(section.x, section.z), axis=-1)
    depths = deep.conversion.to_depth(nodes)[..., 1]
    assert deep.z[0] <= depths.min() + 1e-9
    assert deep.z[-1] >= depths.max() - 1e-9
    assert deep.dz <= np.diff(depths, axis=0).min() + 1e-9
    assert deep.to_time() is section


def test_linear_velocity_integrates_v0_plus_k_z():
    times = np.linspace(0, 2.4, 25)
    rays = solve_ivp(lambda _, z: (V0 + K * z) / 2, (0, 2.4), [0.0], t_eval=times, rtol=1e-10, atol=1e-8)
    np.testing.assert_allclose(sw.LinearVelocity(V0, K).depth(0 * times, times), rays.y[0], rtol=1e-8)


def test_a_layer_cake_adds_up_its_layers():
    depth = sw.LayerCake([UPPER, LOWER], [1800, 2400, 3500]).depth(np.array([0.0]), np.array([1.2]))
    np.testing.assert_allclose(depth, 0.4 * 900 + 0.5 * 1200 + 0.3 * 1750)


def test_units_of_the_section_are_converted():
    model = sw.LinearVelocity(V0, K)
    seconds = timed("s", "km").to_depth(model)
    np.testing.assert_allclose(seconds.z, timed().to_depth(model).z)
    x, z = seconds.conversion.to_depth([1.0, 0.5])
    np.testing.assert_allclose((x, z), (1.0, model.depth(0, 0.5)))


@pytest.mark.parametrize("order", [1, 3])
def test_amplitudes_are_interpolated_once_in_the_recorded_section(order):
    """A restoration that moves nothing by a whole trace gives the recorded section's own interpolation."""
    section = timed()
    deep = section.to_depth(sw.LinearVelocity(V0, K))
    picture = sw.Restoration(deep).picture(order=order, cells=10**9)
    times = deep.conversion.to_time(np.column_stack([np.zeros(deep.shape[0]), deep.z]))[:, 1]
    rows = (times - section.z0) / section.dz
    inside = rows <= section.shape[0] - 1
    np.testing.assert_allclose(
        picture.amplitude[inside, 7], section.sampled(np.full(len(rows), 7.0), rows, order)[inside]
    )


def test_a_straight_fault_becomes_a_curve_that_its_points_follow():
    section = timed()
    conversion = section.to_depth(sw.LinearVelocity(V0, K)).conversion
    fault = sw.Fault([(500, 200), (2500, 1250)], name="F1", ends="tip")
    deep = conversion.to_depth(fault)
    assert (deep.name, deep.ends) == ("F1", ("tip", "tip"))
    fine = conversion.to_depth(np.column_stack([np.linspace(500, 2500, 999), np.linspace(200, 1250, 999)]))
    off = np.interp(fine[:, 0], *deep.points.T) - fine[:, 1]
    assert 2 < len(deep.points) < 50
    assert np.abs(off).max() < 0.12 * conversion.dz
    picks = sw.Interpretation([fault], [LOWER], [sw.Body([(100, 300), (400, 300), (300, 600)])])
    again = conversion.to_time(conversion.to_depth(picks))
    np.testing.assert_allclose(again.faults[0].points[[0, -1]], fault.points)
    assert len(again.bodies[0].points) >= 3


def test_a_planar_fault_recorded_in_time_is_restored_without_rotation():
    true = sw.synthetic.planar_fault(throw=200)
    deep = true.section.to_time(sw.LinearVelocity(V0, K)).to_depth(sw.LinearVelocity(V0, K))
    picks = deep.conversion.to_depth(deep.conversion.to_time(true.interpretation))
    restored = sw.Restoration(deep).unfault(picks.faults, picks.horizons, fixed=true.fixed)
    assert max(abs(motion.rotation) for motion in restored.stages[0].report.motions) < 0.01
    for bed in restored.carried(picks.horizons[1]):
        assert np.ptp(bed[:, 1]) < 0.1 * deep.dz


def test_the_velocity_and_its_source_stand_in_the_report():
    case = sw.synthetic.planar_fault()
    deep = case.section.to_time(TABLE).to_depth(TABLE)
    restored = sw.Restoration(deep, spacing=150).unfault(case.interpretation.faults, case.interpretation.horizons)
    assert "time-depth table of 3 rows (checkshot of well 1)" in str(restored.stages[0].report)
    assert restored.section.conversion is None


@pytest.mark.parametrize(
    ("make", "error", "message"),
    [
        (lambda: sw.ConstantVelocity(2.4), sw.SettingError, "from 100 to 12000 m/s, but is 2.4; check its unit"),
        (lambda: sw.LinearVelocity(-1800, 0.5), sw.SettingError, "v0 must be"),
        (lambda: sw.LinearVelocity(1800, np.nan), sw.SettingError, "k must be a finite number"),
        (lambda: sw.TimeDepthTable([0, 100, 100], [0, 90, 180]), sw.SettingError, "row 3 has 100 after 100"),
        (lambda: sw.TimeDepthTable([0, 100], [0, 90, 180]), sw.SettingError, "2 times and 3 depths"),
        (lambda: sw.TimeDepthTable([0, 100], [0, 9000]), sw.SettingError, "velocity between rows 1 and 2"),
        (lambda: sw.TimeDepthTable([0, 1], [0, 1], time_unit="min"), sw.SettingError, "time_unit must be one of"),
        (lambda: sw.LayerCake([UPPER], [1800]), sw.SettingError, "2 layers, but there are 1 velocities"),
        (lambda: sw.LayerCake([LOWER, UPPER], [1800, 2400, 3500]), sw.PickError, "'upper' lies above 'lower'"),
        (
            lambda: sw.LayerCake([sw.Horizon([(0, 4), (9, 4)], [(5, 6), (12, 6)], name="H")], [1800, 2400]),
            sw.PickError,
            "two times at one position near x=9",
        ),
        (lambda: timed().to_depth(sw.LinearVelocity(2000, -40)), sw.SectionError, "positive everywhere, but 2000 m/s"),
        (lambda: timed().to_depth(sw.ConstantVelocity(2000), dz=-1), sw.SectionError, "dz must be above 0"),
        (lambda: timed().to_depth(sw.ConstantVelocity(2000), dz=0.01), sw.SectionError, "make dz larger"),
        (lambda: timed().to_time(), sw.SectionError, "it is already there"),
        (lambda: sw.synthetic.tilt().section.to_depth(sw.ConstantVelocity(2000)), sw.SectionError, "already there"),
        (lambda: sw.synthetic.tilt().section.to_time(), sw.SectionError, "needs velocity="),
        (lambda: sw.synthetic.tilt().section.to_time(sw.LinearVelocity(1800, -3)), sw.SectionError, "positive"),
    ],
)
def test_bad_input_is_refused_in_words(make, error, message):
    with pytest.raises(error, match=message):
        make()
