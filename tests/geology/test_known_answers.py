"""Sections whose true restoration is known: what is left is the fault's polyline and the solver."""

import numpy as np
import pytest

import seiswidgets as sw
from seiswidgets.core.meshers import chosen_mesher
from tests.geology.answers import block_errors, largest_throw, spacing_for

CASES = {
    "planar": (sw.synthetic.planar_fault, {}),
    "reverse": (sw.synthetic.planar_fault, {"throw": -100}),
    **{f"listric {turn}": (sw.synthetic.listric_fault, {"turn": turn}) for turn in (0.05, 0.1, 0.2, 0.3)},
    "graben": (sw.synthetic.graben, {}),
    **{
        f"domino {faults} x {turn}": (sw.synthetic.domino, {"faults": faults, "turn": turn})
        for faults, turn in ((1, 12), (2, 5), (7, 9), (15, 12))
    },
}


LARGE = ["graben", "listric 0.3", "domino 15 x 12"]
SIZES = [
    *((name, 600, "free") for name in CASES),
    *((name, 5000, "held") for name in CASES),
    *((name, 5000, "free") for name in ("planar", "reverse", *LARGE)),
    *((name, 20000, "held") for name in LARGE),
]


@pytest.mark.parametrize(("name", "vertices", "held"), SIZES)
def test_blocks_come_back(name, vertices, held):
    make, keywords = CASES[name]
    case, held = make(**keywords), held == "held"
    start = sw.Restoration(case.section, spacing_for(case.section, vertices))
    picks = case.interpretation
    stage = start.unfault(picks.faults, picks.horizons, fixed=case.fixed if held else None).stages[-1]
    errors, block = block_errors(stage, case.to_unfaulted, case.block, rigid=not held)
    assert stage.report.converged
    assert stage.report.iterations <= 10
    assert stage.report.findings == ()
    assert errors.max() <= 2e-3 * largest_throw(stage)
    if held:
        assert (errors[block == 0] == 0).all()
        assert_held(stage, case)


def assert_held(stage, case):
    """Not one vertex of the held block has moved."""
    label = case.block(stage.mesh.vertices[stage.mesh.triangles].mean(axis=1))
    part = stage.mesh.blocks[stage.mesh.triangles[:, 0]]
    still = np.unique(stage.mesh.triangles[part == np.bincount(part[label == 0]).argmax()])
    assert len(still) > 30
    np.testing.assert_array_equal(stage.vertices[still], stage.mesh.vertices[still])


@pytest.mark.parametrize(("dip", "vertices"), [(2, 600), (10, 5000), (25, 600)])
def test_a_tilted_section_turns_back(dip, vertices):
    case = sw.synthetic.tilt(dip=dip)
    restored = sw.Restoration(case.section, spacing_for(case.section, vertices)).flatten(
        case.interpretation.horizons[1]
    )
    stage = restored.stages[-1]
    off = stage.vertices - case.to_restored(stage.mesh.vertices)
    errors = np.hypot(*(off - off.mean(axis=0)).T)  # how far the whole moves sideways, and its datum, are a choice
    relief = np.ptp(case.interpretation.horizons[1].pieces[0][:, 1])
    assert stage.report.converged
    assert stage.report.iterations <= 10
    assert errors.max() <= 2e-3 * relief


@pytest.mark.parametrize("dip", [10, 30, 45, 60])
@pytest.mark.parametrize("spacing", [None, 100, 40])
def test_a_fold_becomes_level_and_keeps_its_length(dip, spacing):
    case = sw.synthetic.sine_fold(dip=dip)
    bed = case.interpretation.horizons[1]
    restored = sw.Restoration(case.section, spacing=spacing).flatten(bed)
    (line,) = restored.carried(bed)
    report = restored.stages[-1].report
    before, after = (np.hypot(*np.diff(points, axis=0).T).sum() for points in (bed.pieces[0], line))
    assert report.converged
    shallow = 15 if chosen_mesher() == "Triangle" else 20  # at 45 degrees, 11 to 19 steps by either's meshes
    assert report.iterations <= (shallow if dip <= 45 else 40)
    assert report.flipped == 0
    assert report.findings == ()
    assert np.ptp(line[:, 1]) / 2 < 0.15 * case.section.dz  # it is drawn within a tenth of a sample of the mesh
    assert abs(after / before - 1) < (0.002 if dip <= 45 else 0.005)


@pytest.mark.parametrize(("dip", "wavelength"), [(65, 2000), (60, 1500), (55, 1200)])
def test_steep_folds_settle(dip, wavelength):
    """Steps go to and fro for ever there where a solver does not know how the area barrier bends."""
    case = sw.synthetic.sine_fold(dip=dip, wavelength=wavelength)
    report = sw.Restoration(case.section).flatten(case.interpretation.horizons[1]).stages[-1].report
    assert report.converged
    assert report.iterations <= 60


def test_a_heavier_length_weight_keeps_the_bed_better():
    case = sw.synthetic.sine_fold(dip=45)
    changes = [
        sw.Restoration(case.section)
        .flatten(case.interpretation.horizons[1], weights=sw.Weights(length=length))
        .stages[-1]
        .report.beds[0]
        .length_change
        for length in (1, 10, 100)
    ]
    assert (np.diff(np.abs(changes)) < 0).all()


def test_the_datum_is_where_the_horizon_comes_to_lie():
    case = sw.synthetic.sine_fold(dip=20)
    horizon = case.interpretation.horizons[1]
    for datum in (950.0, 1100.0):
        restored = sw.Restoration(case.section).flatten(horizon, datum=datum)
        (line,) = restored.carried(horizon)
        assert np.abs(line[:, 1] - datum).max() < 0.3 * case.section.dz


@pytest.mark.parametrize("dip", [30.0, 45.0])
def test_beds_that_slip_past_each_other_all_become_level(dip):
    """A parallel fold flattened on its middle bed: without slip between beds the others keep a tenth of its height."""
    case = sw.synthetic.flexural_fold(dip=dip)
    picks = case.interpretation
    plan = sw.Plan((sw.Step("flatten", "H2"),), weights=sw.Weights(bedding=10.0))
    restored = plan.restore(case.section, picks)
    assert restored.settled
    for horizon in picks.horizons:
        height, relief = (np.ptp(line[:, 1]) for line in (horizon.pieces[0], restored.carried(horizon)[0]))
        assert relief < 0.02 * height
