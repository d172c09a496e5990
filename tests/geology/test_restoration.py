"""The chain of stages: maps there and back, units, pictures, warm starts and cancelling."""

from dataclasses import replace

import numpy as np
import pytest

import seiswidgets as sw
from tests.geology.answers import largest_throw, random_points, restored_fold, restored_in_two_stages

CASES = {
    "faulted fold": sw.synthetic.faulted_fold,
    "listric": sw.synthetic.listric_fault,
    "graben": sw.synthetic.graben,
    "domino": sw.synthetic.domino,
    "blind": sw.synthetic.blind_fault,
}


@pytest.fixture(scope="module", params=CASES)
def answer(request):
    case = CASES[request.param]()
    return case, restored_in_two_stages(case)


@pytest.fixture
def fold():
    return restored_fold()


def test_points_go_there_and_back(answer):
    case, restored = answer
    points = random_points(case.section, 100_000)
    back = restored.to_original(restored.to_restored(points))
    assert np.abs(back - points).max() < 1e-6 * restored.stages[0].spacing


def test_it_knows_the_picks_that_its_stages_were_given(answer):
    case, restored = answer
    drawn, given = restored.interpretation, case.interpretation
    for kind in ("faults", "horizons"):
        assert {pick.name for pick in getattr(drawn, kind)} == {pick.name for pick in getattr(given, kind)}
        assert set(getattr(drawn, kind)) <= set(getattr(given, kind))
    assert sw.Restoration(case.section).interpretation.faults == ()


def test_points_outside_map_nowhere(answer):
    _, restored = answer
    assert np.isnan(restored.to_restored([(-1e4, 0), (0, 1e5), (np.nan, 3)])).all()
    assert np.isnan(restored.to_original([(-1e4, 0), (0, 1e5)])).all()


def test_the_border_of_the_section_maps(answer):
    case, restored = answer
    x_min, x_max, z_min, z_max = case.section.extent
    x, z = np.linspace(x_min, x_max, 301), np.linspace(z_min, z_max, 301)
    border = [np.column_stack(np.broadcast_arrays(*side)) for side in ((x, z_min), (x, z_max), (x_min, z), (x_max, z))]
    assert np.isfinite(restored.to_restored(np.concatenate(border))).all()


def test_nothing_is_turned_over(answer):
    _, restored = answer
    for stage in restored.stages:
        assert (stage.area_ratio > 0).all()
        assert stage.report.flipped == 0
        assert stage.report.converged


def test_the_horizon_lies_level_in_the_restored_picture(answer):
    case, restored = answer
    lines = restored.carried(case.interpretation.horizons[1])
    levels = np.concatenate(lines)[:, 1]
    assert np.ptp(levels) < 0.5 * case.section.dz


def test_the_picture_holds_the_original_amplitudes(answer):
    """Each restored sample is the amplitude at the place where it came from, of the noise-free trace of beds."""
    case, restored = answer
    section = restored.section
    x, z = np.meshgrid(section.x, section.z)
    points = np.column_stack([x.ravel(), z.ravel()])
    original = restored.to_original(points)
    depth = case.to_restored(original)[:, 1]
    expected = np.interp(depth, *case.trace.T)
    drawn = section.amplitude.ravel()
    both = np.isfinite(drawn) & np.isfinite(expected)
    assert both.mean() > 0.6
    assert np.corrcoef(drawn[both], expected[both])[0, 1] > 0.98


def test_samples_stay_on_the_lattice_and_nothing_is_cropped(answer):
    case, restored = answer
    original, section = case.section, restored.section
    assert (section.dx, section.dz) == (original.dx, original.dz)
    for offset, step in ((section.x0 - original.x0, section.dx), (section.z0 - original.z0, section.dz)):
        assert offset / step == pytest.approx(round(offset / step), abs=1e-9)
    x_min, _, _, z_max = section.extent
    low, high = restored.stages[-1].vertices.min(axis=0), restored.stages[-1].vertices.max(axis=0)
    assert low[0] - section.dx < x_min < low[0] + section.dx
    assert high[1] - section.dz < z_max < high[1] + section.dz


def test_without_a_stage_everything_stays():
    section = sw.synthetic.tilt().section
    start = sw.Restoration(section)
    assert start.section is section
    points = random_points(section, 10)
    np.testing.assert_array_equal(start.to_restored(points), points)


def test_blocks_are_welded(answer):
    """Rock covers the seam: places on a restored fault come from somewhere."""
    case, restored = answer
    unfaulted = replace(restored, stages=restored.stages[:1])
    for fault in case.interpretation.faults:
        (line, *_) = unfaulted.carried(fault)
        middle = (line[1:-2] + line[2:-1]) / 2
        inside = middle[np.isfinite(unfaulted.to_original(middle)).all(axis=1)]
        assert len(inside) > 0.9 * len(middle)


def test_a_carried_fault_never_turns_back(answer):
    case, restored = answer
    for fault in case.interpretation.faults:
        line = np.concatenate(restored.carried(fault))
        assert (np.diff(line[:, 1]) * np.sign(line[-1, 1] - line[0, 1]) > 0).all()


def test_stages_chain_in_any_order():
    case = sw.synthetic.faulted_fold()
    picks = case.interpretation
    start = sw.Restoration(case.section, spacing=100)
    other_way = start.flatten(picks.horizons[0]).unfault(picks.faults, picks.horizons, fixed=case.fixed)
    assert [stage.kind for stage in other_way.stages] == ["flatten", "unfault"]
    assert other_way.stages[-1].report.converged
    assert max(cutoff.misfit for cutoff in other_way.stages[-1].report.cutoffs) < 0.1 * case.section.dz


def test_faults_can_be_restored_one_at_a_time():
    case = sw.synthetic.graben()
    picks = case.interpretation
    both = sw.Restoration(case.section).unfault(picks.faults, picks.horizons, fixed=case.fixed)
    horizons = [
        (sw.Horizon(*horizon.pieces[:2], name=horizon.name), sw.Horizon(*horizon.pieces[1:], name=horizon.name))
        for horizon in picks.horizons
    ]
    first, second = zip(*horizons, strict=True)
    one = sw.Restoration(case.section).unfault(picks.faults[0], first, fixed=case.fixed)
    one_by_one = one.unfault(picks.faults[1], second, fixed=case.fixed)
    points = random_points(case.section, 2000)
    apart = np.hypot(*(one_by_one.to_restored(points) - both.to_restored(points)).T)
    assert np.nanquantile(apart, 0.99) < 0.01 * largest_throw(both.stages[0])


@pytest.mark.parametrize(
    ("change", "scale"),
    [
        ({"z_unit": "ms", "velocity": 2500.0}, (1, 1 / 1.25)),
        ({"z_unit": "s", "velocity": 2500.0}, (1, 1 / 1250)),
        ({"x_unit": "ft", "z_unit": "ft"}, (1 / 0.3048, 1 / 0.3048)),
        ({"x_unit": "km", "z_unit": "km"}, (1e-3, 1e-3)),
        ({"x_unit": "km", "z_unit": "ms", "velocity": 2500.0}, (1e-3, 1 / 1.25)),
    ],
    ids=str,
)
def test_the_same_rock_in_other_units_is_restored_the_same(fold, change, scale):
    case, expected = fold
    unfaulted_expected = replace(expected, stages=expected.stages[:1])
    section, scale = case.section, np.array(scale)
    other = replace(section, dx=section.dx * scale[0], dz=section.dz * scale[1], **change)
    picks = case.interpretation
    faults = [sw.Fault(fault.points * scale) for fault in picks.faults]
    horizons = [
        sw.Horizon(*(piece * scale for piece in horizon.pieces), name=horizon.name) for horizon in picks.horizons
    ]
    unfaulted = sw.Restoration(other, spacing=120).unfault(faults, horizons, fixed=case.fixed * scale)
    restored = unfaulted.flatten(horizons[1])
    points = random_points(section, 1000)
    apart = np.hypot(*(restored.to_restored(points * scale) / scale - expected.to_restored(points)).T)
    before = np.hypot(*(unfaulted.to_restored(points * scale) / scale - unfaulted_expected.to_restored(points)).T)
    assert np.nanmax(before) < 1e-3
    assert np.median(apart) < 1.5  # rounding in other units may make Triangle choose another mesh
    assert apart.max() < 20
    for mine, theirs in zip(restored.stages[0].report.cutoffs, expected.stages[0].report.cutoffs, strict=True):
        assert mine.throw == pytest.approx(theirs.throw * scale[1], rel=1e-6)


def test_a_restoration_is_a_value():
    case = sw.synthetic.planar_fault()
    start = sw.Restoration(case.section, spacing=100)
    picks = case.interpretation
    unfaulted = start.unfault(picks.faults, picks.horizons)
    assert start.stages == ()
    for array in (unfaulted.stages[0].vertices, unfaulted.stages[0].mesh.vertices, unfaulted.section.amplitude):
        with pytest.raises(ValueError, match="read-only"):
            array[0] = 0


def test_progress_is_told_and_can_cancel(fold):
    case, _ = fold
    start = sw.Restoration(case.section, spacing=120)
    picks, told = case.interpretation, []
    unfaulted = start.unfault(picks.faults, picks.horizons, progress=lambda *news: told.append(news))
    report = unfaulted.stages[0].report
    assert [iteration for iteration, _, _ in told] == list(range(1, report.iterations + 1))
    assert told[-1][1] == pytest.approx(sum(report.energy.values()))
    assert told[-1][2].shape[1] == 2
    with pytest.raises(sw.Cancelled, match="after iteration 1"):
        start.unfault(picks.faults, picks.horizons, progress=lambda *_: False)
    assert start.stages == ()


def test_a_warm_start_settles_sooner_in_the_same_place(fold):
    case, restored = fold
    picks, first = case.interpretation, restored.stages[1]
    unfaulted = replace(restored, stages=restored.stages[:1])
    weights = sw.Weights(length=12)
    cold = unfaulted.flatten(picks.horizons[1], weights=weights).stages[1]
    warm = unfaulted.flatten(picks.horizons[1], weights=weights, start=first).stages[1]
    assert warm.report.iterations < cold.report.iterations
    np.testing.assert_allclose(warm.vertices, cold.vertices, atol=1e-3)


@pytest.mark.parametrize("change", [{}, {"weights": sw.Weights(mean_value=2.0)}, {"fixed": None}], ids=str)
def test_the_mesh_is_taken_over_where_nothing_that_shapes_it_has_changed(fold, change):
    case, restored = fold
    picks, start, choices = case.interpretation, restored.stages[0], {"fixed": case.fixed, **change}
    begin = replace(restored, stages=())
    cold, warm = (begin.unfault(picks.faults, picks.horizons, **choices, start=at).stages[0] for at in (None, start))
    assert warm.mesh_setup is start.mesh_setup
    assert cold.mesh_setup is not start.mesh_setup
    np.testing.assert_allclose(
        warm.vertices[: len(warm.mesh_setup.mesh.vertices)],
        cold.vertices[: len(cold.mesh_setup.mesh.vertices)],
        atol=1e-3,
    )


def test_a_datum_leaves_the_mesh_as_it_is(fold):
    case, restored = fold
    unfaulted, horizon = replace(restored, stages=restored.stages[:1]), case.interpretation.horizons[1]
    cold, warm = (unfaulted.flatten(horizon, datum=900.0, start=at).stages[1] for at in (None, restored.stages[1]))
    assert warm.mesh is restored.stages[1].mesh
    np.testing.assert_allclose(warm.vertices, cold.vertices, atol=1e-3)


def test_a_piece_too_short_for_the_mesh_changes_nothing(fold):
    case, restored = fold
    unfaulted, horizon = replace(restored, stages=restored.stages[:1]), case.interpretation.horizons[1]
    x, z = case.section.extent[1] / 2, case.section.extent[3] / 2
    with_a_speck = sw.Horizon(*horizon.pieces, [(x, z), (x + 0.1, z)], name=horizon.name)
    flattened = [unfaulted.flatten(one).stages[1].vertices for one in (horizon, with_a_speck)]
    np.testing.assert_array_equal(*flattened)


def test_the_mesh_is_made_anew_where_the_picks_have_changed(fold):
    case, restored = fold
    picks, start, begin = case.interpretation, restored.stages[0], replace(restored, stages=())
    (fault,), horizons = picks.faults, picks.horizons
    moved = sw.Fault(fault.points + [1.0, 0.0], name=fault.name)
    same_name = sw.Fault(fault.points, name=horizons[0].name)
    for faults, beds in ((moved, horizons), (fault, horizons[:2]), (same_name, horizons)):
        again = begin.unfault(faults, beds, fixed=case.fixed, start=start).stages[0]
        assert again.mesh_setup is not start.mesh_setup
    finer = replace(begin, spacing=110.0).unfault(fault, horizons, fixed=case.fixed, start=start).stages[0]
    assert finer.mesh_setup is not start.mesh_setup


def test_a_warm_start_is_near_the_answer_at_once_though_the_outline_has_changed(fold):
    """As while a cut-off is dragged: after two steps nothing is off by more than a tenth of a sample."""
    case, restored = fold
    picks, begin = case.interpretation, replace(restored, stages=())
    _, horizon, _ = picks.horizons
    dragged = sw.Horizon(horizon.pieces[0] + [0.0, 4.0], horizon.pieces[1], name=horizon.name)
    unfaulted = begin.unfault(picks.faults, dragged, fixed=case.fixed, start=restored.stages[0])
    settled = unfaulted.flatten(dragged).stages[1]
    quick = unfaulted.flatten(dragged, start=restored.stages[1], max_iterations=2).stages[1]
    cold = unfaulted.flatten(dragged, max_iterations=2).stages[1]
    off, off_cold = (np.abs(stage.vertices - settled.vertices).max() for stage in (quick, cold))
    assert off < 0.1 * case.section.dz
    assert off < 0.3 * off_cold


def test_the_report_is_made_when_it_is_read(fold):
    case, restored = fold
    picks = case.interpretation
    stage = replace(restored, stages=()).unfault(picks.faults, picks.horizons, fixed=case.fixed).stages[0]
    assert "report" not in vars(stage)
    assert stage.report is stage.report
    assert stage.report.overlap >= 0


def test_an_unfinished_solution_says_so(fold):
    case, _ = fold
    picks = case.interpretation
    stage = sw.Restoration(case.section, spacing=120).flatten(picks.horizons[1], max_iterations=1).stages[0]
    assert not stage.report.converged
    assert "did NOT settle" in str(stage.report)


def test_contradicting_horizons_are_named():
    """One of two horizons that swap order across a fault is carried; other misfits are in the report."""
    case = sw.synthetic.planar_fault()
    picks = case.interpretation
    (left, right), (lower_left, lower_right) = (horizon.pieces for horizon in picks.horizons[:2])
    swapped = [sw.Horizon(left, lower_right, name="A"), sw.Horizon(lower_left, right, name="B")]
    stage = sw.Restoration(case.section, spacing=100).unfault(picks.faults, swapped).stages[0]
    assert [cutoff.horizon for cutoff in stage.report.cutoffs] == ["A"]
    assert [(finding.kind, finding.pick) for finding in stage.report.findings] == [("contradiction", "B")]
    assert "Settled; cut-offs meet to 0.01 samples; but horizon 'B' contradicts horizon 'A'" in stage.report.verdict
    crossed = [sw.Horizon(left, right, name="A"), sw.Horizon(lower_left, picks.horizons[2].pieces[1], name="B")]
    soft = sw.Restoration(case.section, spacing=100).unfault(
        picks.faults, crossed, weights=sw.Weights(stitch=1), max_iterations=60
    )
    apart = [finding for finding in soft.stages[0].report.findings if finding.kind == "cut-off"]
    assert {finding.pick for finding in apart} == {"A", "B"}
    assert all(f"horizon {finding.pick} at fault F1" in finding.text for finding in apart)


def test_the_fixed_point_is_there_for_comparison():
    """It is still off after a thousand iterations where Gauss-Newton is exact after a few (a tilted section)."""
    case = sw.synthetic.tilt(dip=5)
    errors = {}
    for solver in ("gauss-newton", "fixed-point"):
        stage = (
            sw.Restoration(case.section, spacing=60).flatten(case.interpretation.horizons[1], solver=solver).stages[0]
        )
        off = stage.vertices - case.to_restored(stage.mesh.vertices)
        errors[solver] = np.abs(off - off.mean(axis=0)).max()
        assert stage.report.solver == solver
    assert stage.report.iterations == 1000
    assert not stage.report.converged
    assert errors["gauss-newton"] < 1e-3
    assert 0.1 < errors["fixed-point"] < 100


def test_weights_of_norms_and_of_rows():
    """A weight of a norm is the root of a weight of rows; the fixed point slides farther with the former."""
    case, slips = sw.synthetic.planar_fault(), []
    picks, start = case.interpretation, sw.Restoration(case.section, spacing=200)
    roots = sw.Weights(slide=10**0.5, stitch=10**0.5)
    for weights, weighting in ((sw.Weights(), "norms"), (roots, "rows"), (sw.Weights(), "rows"), (sw.Weights(), None)):
        options = {"solver": "fixed-point", "weighting": weighting, "weights": weights, "max_iterations": 30}
        stage = start.unfault(picks.faults, picks.horizons, fixed=case.fixed, **options).stages[0]
        slips.append(np.hypot(*(stage.vertices - stage.mesh.vertices).T).mean())
    assert slips[0] == slips[1] == slips[3]
    assert slips[0] > 1.5 * slips[2]


def test_a_solution_that_turns_triangles_over_is_refused():
    """The fixed point flips triangles where a block has to slide along a round fault."""
    case = sw.synthetic.listric_fault()
    picks = case.interpretation
    start = sw.Restoration(case.section, spacing=150)
    with pytest.raises(sw.FlippedError, match=r"turned \d+ of \d+ triangles over.* near x=.* m, z=") as refusal:
        start.unfault(picks.faults, picks.horizons, fixed=case.fixed, solver="fixed-point", max_iterations=300)
    assert refusal.value.count > 0


def test_the_default_mesh_has_two_to_three_thousand_vertices(answer):
    _, restored = answer
    for stage in restored.stages:
        assert 2000 <= stage.report.vertices <= 3000
