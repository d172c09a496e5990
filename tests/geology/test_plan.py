from dataclasses import replace

import numpy as np
import pytest

import seiswidgets as sw
from seiswidgets.geology.plan import RestorationJob


@pytest.fixture(scope="module")
def case():
    return sw.synthetic.faulted_fold()


@pytest.fixture(scope="module")
def task(case):
    return RestorationJob(case.section, case.interpretation, sw.Plan(spacing=60.0, fixed=case.fixed))


@pytest.fixture(scope="module")
def restored(task):
    return task.restored()


def with_weights(task, **weights):
    return replace(task, plan=replace(task.plan, weights=replace(task.plan.weights, **weights)))


def test_a_plan_is_the_chain_of_its_steps(case, restored):
    picks = case.interpretation
    chain = sw.Restoration(case.section, 60.0).unfault(picks.faults, picks.horizons, fixed=case.fixed)
    chain = chain.flatten(picks.horizons[0])
    for stage, other in zip(restored.stages, chain.stages, strict=True):
        np.testing.assert_array_equal(stage.vertices, other.vertices)


def test_steps_that_are_off_or_have_nothing_to_do_are_left_out(case, task):
    assert RestorationJob(case.section, sw.Interpretation(), sw.Plan()).restored().stages == ()
    off = replace(task, plan=replace(task.plan, steps=(sw.Step("unfault", on=False), sw.Step("flatten"))))
    assert [stage.kind for stage in off.restored().stages] == ["flatten"]
    only_faults = replace(task, interpretation=sw.Interpretation(case.interpretation.faults))
    assert [step.kind for step in only_faults.steps] == ["unfault"]


@pytest.mark.parametrize(
    ("weights", "kept"), [({}, 2), ({"flatten": 20.0}, 1), ({"slide": 20.0}, 0), ({"edge": 2.0}, 0)]
)
def test_stages_are_made_anew_only_where_something_changed(task, restored, weights, kept):
    again = with_weights(task, **weights).restored((task, restored))
    assert [one is other for one, other in zip(again.stages, restored.stages, strict=True)] == [
        number < kept for number in range(2)
    ]


def test_picks_that_move_or_hold_elsewhere_are_new_tasks(case, task, restored):
    moved = sw.Fault(case.interpretation.faults[0].points + (1.0, 0.0), case.interpretation.faults[0].name)
    picks = replace(task, interpretation=sw.Interpretation([moved], case.interpretation.horizons))
    held = replace(task, plan=replace(task.plan, fixed=None))
    for other in (picks, held, replace(task, plan=sw.Plan(spacing=61.0))):
        assert other.restored((task, restored)).stages[0] is not restored.stages[0]


def test_a_warm_start_comes_to_the_same(task, restored):
    heavier = with_weights(task, stitch=30.0)
    warm, cold = heavier.restored((task, restored)), heavier.restored()
    for one, other in zip(warm.stages[:1], cold.stages[:1], strict=True):
        np.testing.assert_allclose(one.vertices, other.vertices, atol=1e-3)
    points = np.random.default_rng(0).uniform(*np.reshape(task.section.extent, (2, 2)).T, size=(200, 2))
    another_mesh = 0.1 * task.plan.spacing  # the second stage's outline differs by rounding, and so does its mesh
    np.testing.assert_allclose(warm.to_restored(points), cold.to_restored(points), atol=another_mesh)


def test_the_coarse_task_has_about_a_ninth_of_the_vertices(task):
    coarse = task.coarse.restored()
    fine = task.restored()
    share = len(coarse.stages[1].mesh.vertices) / len(fine.stages[1].mesh.vertices)
    assert 0.08 < share < 0.17


def test_the_coarse_task_is_not_too_coarse_for_its_picks(case, task):
    assert task.coarse.plan.spacing == 180.0
    top, bottom = case.interpretation.faults[0].points[[0, -1]]
    short = sw.Fault(np.array([top, top + 300 * (bottom - top) / np.hypot(*(bottom - top))]), "F9")
    drawn = replace(task, interpretation=sw.Interpretation([short], case.interpretation.horizons))
    assert drawn.coarse.plan.spacing == pytest.approx(100.0)
    flat = replace(task, plan=sw.Plan((sw.Step("flatten"),), spacing=400.0))
    assert flat.coarse.restored().stages[0].spacing == 400.0


@pytest.mark.parametrize("name", ["faulted_fold", "listric_fault", "graben"])
def test_a_quick_look_is_near_the_full_restoration(name):
    case = getattr(sw.synthetic, name)()
    task = RestorationJob(case.section, case.interpretation, sw.Plan(fixed=case.fixed))
    earlier = task, task.restored()
    pieces = [piece.copy() for piece in case.interpretation.horizons[0].pieces]
    pieces[0][-1] += (0, 40)
    moved = sw.Horizon(*pieces, name=case.interpretation.horizons[0].name)
    picks = sw.Interpretation(case.interpretation.faults, [moved, *case.interpretation.horizons[1:]])
    dragged = replace(task, interpretation=picks)
    quick, full = dragged.coarse.restored(earlier), dragged.restored(earlier)
    points = np.random.default_rng(0).uniform(*np.reshape(task.section.extent, (2, 2)).T, size=(2000, 2))
    off = np.hypot(*(quick.to_restored(points) - full.to_restored(points)).T)
    assert np.nanmedian(off) < 7.5  # metres: a sample and a half
    assert np.nanpercentile(off, 95) < 15.0
    assert np.isfinite(off).mean() > 0.99


def test_progress_counts_the_steps_and_cancels(task):
    seen = []
    task.restored(progress=lambda step, iteration, energy: seen.append((step, iteration, energy)))
    assert [step for step, *_ in seen] == sorted(step for step, *_ in seen)
    assert {step for step, *_ in seen} == {0, 1}
    with pytest.raises(sw.Cancelled, match="cancelled"):
        task.restored(progress=lambda step, iteration, energy: step == 0)


def test_what_is_wrong_with_a_plan_is_said():
    with pytest.raises(sw.SettingError, match=r"one of 'unfault', 'flatten', 'strip', .* but is 'fold'"):
        sw.Step("fold")
    with pytest.raises(sw.SettingError, match="datum must be a finite number"):
        sw.Step("flatten", datum=float("nan"))
    with pytest.raises(sw.SettingError, match=r"must be seiswidgets\.Step"):
        sw.Plan(steps=("unfault",))
    with pytest.raises(sw.SettingError, match="solver must be"):
        sw.Plan(solver="simplex")


def test_steps_name_picks_that_are_there(case, task):
    for step, message in (
        (sw.Step("unfault", ("F9",)), "there is no fault called 'F9'"),
        (sw.Step("flatten", ("H9",)), "there is no horizon called 'H9'"),
        (sw.Step("flatten", ("H1", "H2")), "a step takes one horizon at a time"),
    ):
        with pytest.raises(sw.PickError, match=message):
            sw.Plan((step,)).restore(case.section, case.interpretation)
