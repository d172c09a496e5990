"""Known answers must be what they claim: picture, picks and true map agree in every case."""

import numpy as np
import pytest
import shapely

from seiswidgets.errors import SettingError
from seiswidgets.geology import synthetic
from seiswidgets.geology.parallel_flow import FlexuralSlip, ramp_thrust, rounded_fold

CASES = {
    "planar": (synthetic.planar_fault, {}),
    "planar, vertical": (synthetic.planar_fault, {"dip": 90}),
    "planar, reverse": (synthetic.planar_fault, {"throw": -100}),
    "listric 0.3": (synthetic.listric_fault, {"turn": 0.3}),
    "graben": (synthetic.graben, {}),
    "domino 1": (synthetic.domino, {"faults": 1, "turn": 12}),
    "domino 5, steep": (synthetic.domino, {"turn": 12, "dip": 75}),
    "domino 15": (synthetic.domino, {"faults": 15, "turn": 12}),
    "tilt to the left": (synthetic.tilt, {"dip": -30}),
    "fold 62": (synthetic.sine_fold, {"dip": 62}),
    "blind, large slip": (synthetic.blind_fault, {"slip": 200, "length": 900}),
    "blind, to the left": (synthetic.blind_fault, {"dip": 120}),
    "faulted fold, one horizon": (synthetic.faulted_fold, {"horizons": (900.0,), "throw": 250}),
}
BENT = {
    "thrust": (synthetic.thrust, {}),
    "imbricates": (synthetic.thrust, {"faults": 3}),
    "fault-bend fold": (synthetic.fault_bend_fold, {"horizons": (1000.0, 1200.0)}),
    "flexural 30": (synthetic.flexural_fold, {}),
    "flexural 45": (synthetic.flexural_fold, {"dip": 45}),
}
RIGID = [name for name in CASES if not name.startswith("blind")]  # the rock around a blind fault bends
CASES |= BENT


@pytest.fixture(scope="module", params=CASES)
def case(request):
    build, settings = CASES[request.param]
    return request.param, build(**settings)


def samples(section):
    return np.stack(np.meshgrid(section.x, section.z), axis=-1).reshape(-1, 2)


def scattered(section, count=2000):
    x_min, x_max, z_min, z_max = section.extent
    return np.random.default_rng(1).uniform((x_min, z_min), (x_max, z_max), size=(count, 2))


def shifted_in(piece, distance=1e-7):
    """A piece whose ends are moved a little inwards, off the faults, where either side would do."""
    piece = piece.copy()
    for end, neighbour in ((0, 1), (-1, -2)):
        inward = piece[neighbour] - piece[end]
        piece[end] += distance * inward / np.linalg.norm(inward)
    return piece


def sagitta(fault):
    """Farthest that an arc strays from the polyline through its evenly spaced points; 0 for a few straight lines."""
    if len(fault.points) < 10:
        return 0.0
    first, middle, last = fault.points[:3]
    return 1.01 / 4 * shapely.LineString([first, last]).distance(shapely.Point(middle))


def test_amplitude_is_the_trace_at_the_deposited_depth(case):
    name, _ = case
    build, settings = CASES[name]
    answer = build(**settings, noise=0)
    deposited = answer.to_restored(samples(answer.section))[:, 1]
    expected = np.interp(deposited, *answer.trace.T).reshape(answer.section.shape)
    np.testing.assert_allclose(answer.section.amplitude, expected, atol=1e-5)
    assert answer.section.amplitude.dtype == np.float32


def test_every_horizon_was_deposited_level(case):
    _, answer = case
    for horizon in answer.interpretation.horizons:
        deposited = np.concatenate([answer.to_restored(shifted_in(piece))[:, 1] for piece in horizon.pieces])
        np.testing.assert_allclose(deposited, deposited[0], atol=1e-6)


def test_horizons_are_deposited_at_the_depths_asked_for():
    answer = synthetic.graben(horizons=(500.0, 800.0))
    deposited = [answer.to_restored(h.pieces[0])[0, 1] for h in answer.interpretation.horizons]
    np.testing.assert_allclose(deposited, [500, 800], atol=1e-6)


def test_horizons_are_strong_reflections(case):
    _, answer = case
    for horizon in answer.interpretation.horizons:
        depth = answer.to_restored(shifted_in(horizon.pieces[0]))[0, 1]
        near = abs(answer.trace[:, 0] - depth) < 15
        peak = answer.trace[near][answer.trace[near, 1].argmax()]
        assert abs(peak[0] - depth) < 10
        assert peak[1] > 1


def test_each_block_has_its_piece_of_every_horizon(case):
    _, answer = case
    blocks = len(answer.interpretation.faults) + 1  # for a blind fault, its two sides
    for horizon in answer.interpretation.horizons:
        assert len(horizon.pieces) == blocks
        if answer.fixed is not None:
            inside = [set(answer.block(shifted_in(piece))) for piece in horizon.pieces]
            assert inside == [{number} for number in range(len(horizon.pieces))]


def test_picks_lie_on_the_section_and_are_dense(case):
    _, answer = case
    for fault in answer.interpretation.faults:
        assert answer.section.contains(fault.points).all()
    for horizon in answer.interpretation.horizons:
        for piece in horizon.pieces:
            assert answer.section.contains(piece).all()
            assert np.linalg.norm(np.diff(piece, axis=0), axis=1).max() < 75


def test_cutoffs_lie_on_their_fault_and_were_one_point(case):
    _, answer = case
    for horizon in answer.interpretation.horizons:
        for number, fault in enumerate(answer.interpretation.faults):
            footwall, hanging_wall = horizon.pieces[number : number + 2]
            line = shapely.LineString(fault.points)
            for cutoff in (footwall[-1], hanging_wall[0]):
                assert line.distance(shapely.Point(cutoff)) < 1e-6 + sagitta(fault)
            before = [shifted_in(footwall)[-1], shifted_in(hanging_wall)[0]]
            assert np.linalg.norm(footwall[-1] - hanging_wall[0]) > 10
            for back in (answer.to_unfaulted, answer.to_restored):
                np.testing.assert_allclose(*back(before), atol=1e-6)


@pytest.mark.parametrize("case", RIGID, indirect=True)
def test_blocks_move_rigidly(case):
    _, answer = case
    points = scattered(answer.section)
    block = answer.block(points)
    for number in np.unique(block):
        here = points[block == number]
        before = answer.to_unfaulted(here)
        np.testing.assert_allclose(np.linalg.norm(before - before[0], axis=1), np.linalg.norm(here - here[0], axis=1))


def test_block_zero_holds_the_fixed_point_and_stays(case):
    _, answer = case
    if answer.fixed is None:
        assert not answer.block(scattered(answer.section)).any()
        return
    assert answer.block([answer.fixed]) == [0]
    for fault in answer.interpretation.faults:
        assert shapely.LineString(fault.points).distance(shapely.Point(answer.fixed)) > 200
    np.testing.assert_allclose(answer.to_unfaulted([answer.fixed]), [answer.fixed], atol=1e-12)


def test_cut_through_or_not():
    assert synthetic.blind_fault().fixed is None
    assert synthetic.tilt().fixed is None
    assert synthetic.sine_fold().fixed is None
    assert synthetic.planar_fault().fixed is not None


def test_a_case_without_a_fault_is_unfaulted_already():
    answer = synthetic.sine_fold()
    points = scattered(answer.section)
    np.testing.assert_array_equal(answer.to_unfaulted(points), points)


@pytest.mark.parametrize("throw", [50, 300])
def test_planar_fault_has_its_throw(throw):
    (footwall, hanging_wall), *_ = (h.pieces for h in synthetic.planar_fault(throw=throw).interpretation.horizons)
    assert hanging_wall[0, 1] - footwall[-1, 1] == pytest.approx(throw)


@pytest.mark.parametrize("turn", [0.05, 0.3])
def test_listric_hanging_wall_turns_by_the_angle(turn):
    piece = synthetic.listric_fault(turn=turn).interpretation.horizons[0].pieces[1]
    along = piece[-1] - piece[0]
    assert np.arctan2(-along[1], along[0]) == pytest.approx(turn)


def test_graben_opens_sideways_by_twice_the_heave():
    answer = synthetic.graben(throw=120, dip=60)
    right = np.array([[3900.0, 1000.0]])
    np.testing.assert_allclose(right - answer.to_unfaulted(right), [[2 * 120 / np.tan(np.pi / 3), 0]])
    left, right = (fault.points for fault in answer.interpretation.faults)
    assert (left[:, 0] < right[:, 0]).all()


@pytest.mark.parametrize("faults", [1, 15])
def test_domino_blocks_keep_their_centres_depth(faults):
    answer = synthetic.domino(faults=faults, turn=12)
    middle = np.array([fault.points.mean(axis=0) for fault in answer.interpretation.faults])
    apart = 500 / np.sin(np.pi / 3)
    centres = np.vstack([middle - [apart / 2, 0], middle[-1] + [apart / 2, 0]])
    np.testing.assert_allclose(answer.to_restored(centres)[:, 1], centres[:, 1])
    beds = answer.interpretation.horizon("H2").pieces
    for piece in beds:
        along = piece[-1] - piece[0]
        assert np.rad2deg(np.arctan2(-along[1], along[0])) == pytest.approx(12)


@pytest.mark.parametrize("faults", [1, 15])
def test_domino_faults_cross_the_section(faults):
    answer = synthetic.domino(faults=faults, turn=12)
    assert len(answer.interpretation.faults) == faults
    for fault in answer.interpretation.faults:
        np.testing.assert_array_equal(fault.points[:, 1], [0, 2000])
    assert answer.section.extent[1] >= 2000


@pytest.mark.parametrize("dip", [10, 62])
def test_sine_fold_dips_as_asked(dip):
    answer = synthetic.sine_fold(dip=dip)
    x = np.linspace(0, 4000, 20001)
    shift = 1000 - answer.to_restored(np.column_stack([x, np.full_like(x, 1000)]))[:, 1]
    assert np.rad2deg(np.arctan(abs(np.gradient(shift, x)).max())) == pytest.approx(dip, abs=0.01)
    for horizon in answer.interpretation.horizons:
        np.testing.assert_array_equal(horizon.pieces[0][[0, -1], 0], [0, 4000])


@pytest.mark.parametrize("slip", [20, 150])
def test_blind_slip_is_elliptic_and_vanishes_at_the_tips(slip):
    answer = synthetic.blind_fault(slip=slip, dip=60, length=900)
    down, across = np.array([0.5, np.sqrt(0.75)]), np.array([np.sqrt(0.75), -0.5])
    centre, t = np.array([2000, 1000]), np.linspace(-0.99, 0.99, 199)
    size = slip / 2 * np.sqrt(1 - t**2)
    deposited = centre + 450 * np.outer(t, down)
    for side in (-1, 1):
        today = deposited + side * np.outer(size, down)
        inside = abs((today - centre) @ down) < 450
        back = answer.to_restored(today + side * 1e-9 * across)
        np.testing.assert_allclose(back[inside], deposited[inside], atol=1e-5)
    ahead = centre + 450 * np.outer([-2, -1.2, 1.2, 2], down)
    np.testing.assert_allclose(answer.to_restored(ahead), ahead, atol=1e-6)


@pytest.mark.parametrize("slip", [20, 200])
def test_blind_restoration_inverts_the_slip(slip):
    """Forward through the crack's displacement in its textbook form, then back."""
    answer = synthetic.blind_fault(slip=slip, dip=60, length=900)
    deposited = scattered(answer.section)
    down, across = np.array([0.5, np.sqrt(0.75)]), np.array([np.sqrt(0.75), -0.5])
    zeta = ((deposited - (2000, 1000)) @ down + 1j * (deposited - (2000, 1000)) @ across) / 450
    inverse = [np.roots([1, -2 * point, 1]) for point in zeta]  # zeta -+ sqrt(zeta^2 - 1): the one that decays
    displacement = -slip / 2 * np.array([min(roots, key=abs).imag for roots in inverse])
    today = deposited + np.outer(displacement, down)
    # nearer to a tip than this, the displacement maps two points onto one
    tips = answer.interpretation.faults[0].points
    clear = (np.linalg.norm(today[:, None] - tips, axis=2) > slip**2 / (4 * 900)).all(axis=1)
    assert clear.mean() > 0.999
    np.testing.assert_allclose(answer.to_restored(today)[clear], deposited[clear], atol=1e-6)


def test_blind_restoration_is_finite_everywhere():
    answer = synthetic.blind_fault(slip=200, length=900)
    tip = answer.interpretation.faults[0].points[0]
    near = tip + np.random.default_rng(0).normal(scale=3, size=(5000, 2))
    moved = np.linalg.norm(answer.to_restored(np.vstack([near, tip])) - np.vstack([near, tip]), axis=1)
    assert moved.max() < 100


@pytest.mark.parametrize("case", BENT, indirect=True)
def test_bent_rock_keeps_its_area(case):
    _, answer = case
    points, step = scattered(answer.section), 1e-3
    columns = [answer.to_restored(points + by) - answer.to_restored(points - by) for by in ((step, 0), (0, step))]
    area = np.linalg.det(np.stack(columns, axis=1) / (2 * step))
    np.testing.assert_allclose(area, 1, atol=1e-6)


@pytest.mark.parametrize("dip", [30, 45, 60])
def test_a_parallel_fold_keeps_the_length_and_the_thickness_of_beds(dip):
    fold = FlexuralSlip(rounded_fold(dip, 1600, 200, (2000, 500)), 2000, 1000)
    x = np.linspace(-3000, 7000, 20001)
    beds = [fold.apply(np.column_stack([x, np.full_like(x, depth)])) for depth in (500, 1000, 1300)]
    for bed in beds:
        assert np.hypot(*np.diff(bed, axis=0).T).sum() == pytest.approx(10000, rel=1e-6)
        slopes = np.arctan2(*np.abs(np.diff(bed[::10], axis=0)).T[::-1])
        assert np.rad2deg(slopes.max()) == pytest.approx(dip, abs=0.1)
    upper, lower = shapely.LineString(beds[1][::2]), shapely.points(beds[2][200:-200:20])
    assert shapely.distance(lower, upper) == pytest.approx(300, abs=0.2)


def test_beds_that_follow_a_thrust_keep_their_length():
    """A sheet that was parallel to the floor is parallel to the ramp: the bisector bends it without strain."""
    (piece,) = synthetic.thrust(dip=25).interpretation.horizon("H1").pieces[1:]
    start, end = synthetic.thrust(dip=25).to_restored(shifted_in(piece)[[0, -1]])
    bends = np.hypot(*np.diff(piece, axis=0).T).sum()
    assert bends == pytest.approx(end[0] - start[0], rel=2e-3)  # the piece cuts corners


@pytest.mark.parametrize(
    "flow",
    [
        ramp_thrust([(0, 800), (1500, 800), (2700, 1400), (4000, 1400)], 400),
        FlexuralSlip(rounded_fold(45, 1600, 200, (2000, 500)), 2000, 1000),
    ],
)
def test_parallel_flow_is_undone_exactly(flow):
    points = np.random.default_rng(0).uniform((0, 0), (4000, 800), (2000, 2))
    np.testing.assert_allclose(flow.undo(flow.apply(points)), points, atol=1e-8)
    np.testing.assert_allclose(flow.apply(flow.undo(points)), points, atol=1e-8)


def test_horizons_above_the_upper_flat_are_folded_but_not_cut():
    answer = synthetic.fault_bend_fold()
    assert [len(horizon.pieces) for horizon in answer.interpretation.horizons] == [1, 2, 2]
    (above,) = answer.interpretation.horizons[0].pieces
    assert np.ptp(above[:, 1]) == pytest.approx(400 * np.sin(np.deg2rad(25)), rel=1e-6)  # the slip lifts it up the ramp


def test_imbricates_rise_from_one_floor_and_the_older_were_carried():
    answer = synthetic.thrust(slip=300, faults=3, spacing=1200)
    first, *older = (fault.points for fault in answer.interpretation.faults)
    for line in older:
        assert shapely.LineString(first).distance(shapely.Point(line[-1])) < 1e-6
    feet = [line[-1, 0] for line in older]
    np.testing.assert_allclose(np.diff([first[1, 0], *feet]), 1200 - 300)
    assert len(older[0]) == 4  # bent where it crossed the axial surface of F1


def test_seeds_reproduce_and_differ():
    one, same, other = (synthetic.faulted_fold(seed=seed).section.amplitude for seed in (1, 1, 2))
    np.testing.assert_array_equal(one, same)
    assert abs(one - other).max() > 1


def test_noise_has_the_level_stated():
    clean, noisy = (synthetic.planar_fault(noise=noise).section.amplitude for noise in (0, 0.2))
    assert (noisy - clean).std() == pytest.approx(0.2, rel=0.01)


def test_survey_sets_size_and_spacing():
    section = synthetic.planar_fault(width=3000, depth=1800, dx=25, dz=10, horizons=(700.0,)).section
    assert section.extent == (0, 3000, 0, 1800)
    assert section.shape == (181, 121)


@pytest.mark.parametrize(
    ("build", "settings", "message"),
    [
        (synthetic.domino, {"faults": 0}, "faults must be from 1 to 15, but is 0"),
        (synthetic.domino, {"faults": 16}, "faults must be from 1 to 15, but is 16"),
        (synthetic.domino, {"turn": 40}, "turn must be from 0 to 15 degrees, but is 40"),
        (synthetic.listric_fault, {"turn": -0.1}, "turn must be from 0 to 0.4 radians"),
        (synthetic.listric_fault, {"radius": 2500}, "must run from the top of the section to its border"),
        (
            synthetic.listric_fault,
            {"radius": 6000, "turn": 0.3},
            "the horizon at 900 m must have one piece in each block",
        ),
        (synthetic.planar_fault, {"dip": 20}, "fault F1 must run from the top of the section"),
        (synthetic.planar_fault, {"dip": np.nan}, "dip must be from 20 to 90 degrees, but is nan"),
        (synthetic.planar_fault, {"throw": 700}, "the horizon at 1400 m must have one piece .* block 1 has none"),
        (synthetic.planar_fault, {"horizons": (2500.0,)}, "the horizon at 2500 m"),
        (synthetic.sine_fold, {"dip": 70}, "the horizon at 750 m must have one piece"),
        (synthetic.sine_fold, {"dip": 80}, "dip must be from 0 to 75 degrees"),
        (synthetic.blind_fault, {"length": 4000}, "fault F1 must end inside the section"),
        (synthetic.blind_fault, {"slip": 800}, "slip must be from 0 to 125 m"),
        (synthetic.blind_fault, {"horizons": (300.0,)}, "the horizon at 300 m must have one piece"),
        (synthetic.graben, {"floor": 0}, "floor must be from 10"),
        (synthetic.thrust, {"spacing": 200}, "spacing must be from 375 to 10000 m, at least 1.25 of the slip"),
        (synthetic.thrust, {"floor": 2500}, "floor must be from 100 to 1950 m, inside the section"),
        (
            synthetic.thrust,
            {"slip": 1600, "spacing": 2000},
            "the horizon at 600 m must have one piece .* block 1 has none",
        ),
        (synthetic.thrust, {"width": 500}, "fault F1 must cross the section, which is 500 m x 2000 m"),
        (synthetic.thrust, {"slip": 1500}, "spacing must be from 1875"),
        (synthetic.fault_bend_fold, {"top": 1350}, "floor must be from 1450"),
        (synthetic.flexural_fold, {"dip": 60}, "radius must be from 2216.* with limbs of 60 degrees .* 2000 m deep"),
        (synthetic.tilt, {"noise": -1}, "noise must be from 0 to 10, but is -1"),
        (synthetic.tilt, {"depth": 1e9}, "depth must be from 500 to 5000"),
    ],
)
def test_settings_out_of_range_are_refused(build, settings, message):
    with pytest.raises(SettingError, match=message):
        build(**settings)


def test_a_misspelt_setting_is_refused():
    with pytest.raises(TypeError, match="nois"):
        synthetic.tilt(nois=0.1)
