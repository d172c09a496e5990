"""Stripping, decompacting and flattening, against sections that are known at every time."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest

import seiswidgets as sw
from seiswidgets.core.mesh import triangle_areas
from seiswidgets.geology.decompaction import ColumnCompaction
from seiswidgets.geology.plan import RestorationJob
from tests.geology.answers import random_points


def horizon(case, name):
    return case.interpretation.horizon(name)


def footwall_level(case, name):
    return horizon(case, name).pieces[0][0, 1]


@cache
def graben_through_time(radius):
    """A growth fault restored layer by layer: the case, and the restoration after each layer of growth strata."""
    case = sw.synthetic.growth_fault(radius=radius, dx=25, dz=10)
    faults, restored, found = case.interpretation.faults, sw.Restoration(case.section), {}
    for name in ("H1", "H2", "H3", "H4"):
        restored = restored.strip(horizon(case, name), faults=faults)
        if name != "H1":
            restored = restored.unfault(faults, [horizon(case, name)], fixed=case.fixed)
        found[name] = restored
    return case, found


@pytest.mark.parametrize("radius", [None, 3500.0])
@pytest.mark.parametrize(("name", "throw"), [("H2", 40), ("H3", 50), ("H4", 60)])
def test_each_step_of_a_growth_fault_is_undone(radius, name, throw):
    case, found = graben_through_time(radius)
    restored = found[name]
    points = random_points(case.section, 2000)
    truth = case.at_age(points, case.stratigraphy.layer(name).age) + [0, footwall_level(case, name)]
    moved = restored.to_restored(points)
    known = np.isfinite(truth).all(axis=1) & np.isfinite(moved).all(axis=1)
    assert known.sum() > 0.98 * np.isfinite(truth).all(axis=1).sum()
    assert np.hypot(*(moved - truth)[known].T).max() < 0.01 * throw
    (line,) = restored.carried(horizon(case, name))
    assert np.ptp(line[:, 1]) < 0.5 * case.section.dz
    assert restored.stages[-1].report.cutoffs[0].throw == pytest.approx(throw, rel=0.1)


def test_stripping_leaves_what_lies_below():
    case, found = graben_through_time(None)
    stripped = found["H1"]
    points = random_points(case.section, 1000)
    points = points[np.abs(points[:, 1] - footwall_level(case, "H1")) > 0.1]
    below = points[:, 1] > footwall_level(case, "H1")
    moved = stripped.to_restored(points)
    assert (np.isfinite(moved).all(axis=1) == below).all()
    assert np.allclose(moved[below], points[below], atol=1e-9)
    assert np.isnan(stripped.section.amplitude[stripped.section.z < footwall_level(case, "H1") - 10]).all()
    assert stripped.carried(horizon(case, "H1"))


def test_a_horizon_that_does_not_span_the_section_is_continued_level():
    case = sw.synthetic.growth_fault(dx=25, dz=10)
    short = sw.Horizon([(1000, 220), (3000, 240)], name="short")
    stage = sw.Restoration(case.section).strip(short).stages[0]
    assert [finding.kind for finding in stage.report.findings] == ["extended", "extended"]
    assert stage.mesh.vertices[:, 1].min() == pytest.approx(220, abs=1)


def test_nothing_is_left_below_the_bottom():
    case = sw.synthetic.growth_fault(dx=25, dz=10)
    with pytest.raises(sw.PickError, match="nothing is left of the section below horizon 'floor'"):
        sw.Restoration(case.section).strip(sw.Horizon([(0, 1999), (4000, 1999)], name="floor"))


@cache
def basin_through_time():
    """A compacted basin, and its restoration after each layer."""
    case = sw.synthetic.compacted_basin(dx=50, dz=10)
    restored, found = sw.Restoration(case.section), []
    for layer in case.stratigraphy.layers[1:]:
        top = horizon(case, layer.top)
        restored = restored.strip(top).decompact(case.stratigraphy, case.interpretation, age=layer.age)
        restored = restored.flatten(top, datum=0.0, by="vertical shear")
        found.append(restored)
    return case, found


def test_every_horizon_of_a_compacted_basin_had_its_depth_at_every_time():
    case, found = basin_through_time()
    for restored, layer in zip(found, case.stratigraphy.layers[1:], strict=True):
        for older in case.stratigraphy.layers[1:]:
            points = np.vstack(horizon(case, older.top).pieces)
            error = restored.to_restored(points) - case.at_age(points, layer.age)
            assert np.nanmax(np.abs(error), initial=0) < 1
        assert restored.stages[-2].report.flipped == 0
        assert dict(restored.stages[-2].report.details)


def test_without_decompaction_the_basin_is_too_shallow():
    case, _ = basin_through_time()
    top, base = horizon(case, "H1"), horizon(case, "H4")
    plain = sw.Restoration(case.section).strip(top).flatten(top, datum=0.0, by="vertical shear")
    points = np.vstack(base.pieces)
    true = case.at_age(points, case.stratigraphy.layer("H1").age)
    assert np.nanmax(plain.to_restored(points)[:, 1]) < 0.95 * np.nanmax(true[:, 1])


def test_grains_are_kept_in_each_column_and_on_the_mesh():
    case, _ = basin_through_time()
    stripped = sw.Restoration(case.section).strip(horizon(case, "H1"))
    rock = stripped.stratified(case.stratigraphy, case.interpretation)
    x = np.linspace(100, 3900, 50)
    before = ColumnCompaction.of(rock.layers.columns(x), rock.memory, case.stratigraphy)
    thickness, depth = before.expanded()
    nodes = np.stack([depth - thickness, depth], axis=-1)
    after = ColumnCompaction(replace(before.columns, nodes=nodes), nodes, case.stratigraphy)
    solids = [(columns.columns.thickness - columns.pores()).sum(axis=1) for columns in (before, after)]
    assert np.allclose(*solids, rtol=1e-6)
    assert (thickness.sum(axis=1) > 1.01 * before.columns.thickness.sum(axis=1)).all()
    stage = stripped.decompact(case.stratigraphy, case.interpretation).stages[-1]
    old, new = (
        solid_area(rock, case.stratigraphy, stage, *state)
        for state in (
            (stage.mesh.vertices, rock.memory(stage.mesh.vertices)),
            (stage.vertices, stage.burial),
        )
    )
    assert new == pytest.approx(old, rel=1e-4)


def solid_area(rock, stratigraphy, stage, vertices, burial):
    """Area of the grains of a mesh whose burial is linear in each triangle, by the rule of the edges' middles."""
    triangles = stage.mesh.triangles
    layer = rock.layers.layer_at(stage.mesh.vertices[triangles].mean(axis=1))
    middles = (burial[triangles] + np.roll(burial[triangles], 1, axis=1)) / 2
    rocks = [layer.rock for layer in stratigraphy.layers]
    porosity = [rocks[index].porosity(depths).mean() for index, depths in zip(layer, middles, strict=True)]
    return float(np.sum(triangle_areas(vertices, triangles) * (1 - np.array(porosity))))


def test_a_sequence_finds_which_fault_moved_when_and_undoes_it():
    case = sw.synthetic.half_graben(dx=25, dz=10)
    activity = sw.FaultActivity.of(case.stratigraphy, case.interpretation)
    assert [activity.moved(top) for top in case.stratigraphy.tops] == [(), *[("F1",)] * 4]
    assert "F1     H5 (25 Ma)" in str(activity)
    plan = sw.Plan.sequential(case.stratigraphy, case.interpretation, decompact=False, fixed=case.fixed)
    assert [step.kind for step in plan.steps] == ["strip", "flatten", *["strip", "unfault", "flatten"] * 4]
    seen = set()
    restored = plan.restore(case.section, case.interpretation, progress=lambda step, *_: seen.add(step))
    assert seen == set(range(len(plan.steps)))
    assert not restored.skipped
    points = random_points(case.section, 1000)
    for index, stage in enumerate(restored.stages, 1):
        if stage.kind == "flatten":
            error = restored.at(index).to_restored(points) - case.at_age(points, stage.age)
            assert np.nanmax(np.hypot(*error.T)) < 0.01 * 100
    points = points[np.isfinite(restored.to_restored(points)).all(axis=1)]
    assert np.allclose(restored.to_original(restored.to_restored(points)), points, atol=1e-6 * 4000)


def test_a_sequence_can_be_told_which_fault_moved_when():
    case = sw.synthetic.growth_fault(dx=25, dz=10)
    plan = sw.Plan.sequential(case.stratigraphy, case.interpretation, activity={"H3": ["F1"]}, isostasy=sw.Isostasy())
    assert [step.age for step in plan.steps if step.kind == "unfault"] == [15]
    assert {step.kind for step in plan.steps} == {"strip", "unfault", "decompact", "isostasy", "flatten"}


def test_a_sequence_with_compaction_and_isostasy_settles_without_flips():
    case = sw.synthetic.growth_fault(dx=25, dz=10)
    crust = sw.Isostasy(elastic_thickness=5e3)
    plan = sw.Plan.sequential(case.stratigraphy, case.interpretation, isostasy=crust, fixed=case.fixed)
    restored = replace(plan, spacing=80.0).restore(case.section, case.interpretation)
    assert not restored.skipped
    assert all(stage.report.flipped == 0 for stage in restored.stages)
    assert restored.settled
    assert [stage.age for stage in restored.stages] == sorted(stage.age for stage in restored.stages)
    (top,) = restored.carried(horizon(case, "H4"))
    assert np.abs(top[:, 1]).max() < 0.5 * case.section.dz
    assert {finding.severity for finding in sw.check(case.section, case.interpretation, plan)} <= {"note"}


def test_cancelling_a_sequence_stops_it():
    case = sw.synthetic.growth_fault(dx=25, dz=10)
    plan = sw.Plan.sequential(case.stratigraphy, case.interpretation)
    with pytest.raises(sw.Cancelled, match="cancelled"):
        plan.restore(case.section, case.interpretation, progress=lambda step, *_: step < 2)


def test_a_changed_lithology_keeps_the_steps_before_it():
    case = sw.synthetic.growth_fault(dx=25, dz=10)
    plan = sw.Plan.sequential(case.stratigraphy, case.interpretation)
    job = RestorationJob(case.section, case.interpretation, replace(plan, spacing=120.0))
    first = job.restored()
    layers = [replace(layer, lithology="chalk") for layer in case.stratigraphy.layers]
    changed = replace(job, plan=replace(job.plan, stratigraphy=sw.Stratigraphy(layers)))
    second = changed.restored((job, first))
    assert second.stages[0] is first.stages[0]
    assert second.stages[1] is not first.stages[1]


def test_crossing_tops_and_missing_ones_are_refused():
    case = sw.synthetic.growth_fault(dx=25, dz=10)
    crossing = sw.Horizon([(0, 300), (4000, 800)], name="X")
    picks = sw.Interpretation(case.interpretation.faults, [*case.interpretation.horizons, crossing])
    start = sw.Restoration(case.section)
    layers = sw.Stratigraphy([sw.Layer(None, 0), sw.Layer("X", 3), sw.Layer("H2", 9)])
    with pytest.raises(sw.PickError, match="horizon 'H2' crosses horizon 'X' near"):
        start.decompact(layers, picks)
    with pytest.raises(sw.PickError, match="there is no horizon called 'X'"):
        start.decompact(layers, case.interpretation)
