"""Picks at the section's border or beyond it: clipped, and laid onto the border where they nearly follow it."""

import numpy as np
import pytest

import seiswidgets as sw
from seiswidgets.geology.clipping import clip_line

X0 = 1_705_843.59  # map coordinates
SECTION = sw.Section(np.ones((250, 400), np.float32), dx=12.5, dz=5, x0=X0)
RIGHT, BOTTOM = SECTION.extent[1], SECTION.extent[3]
FAULT = sw.Fault([(X0 + 2300, 0), (X0 + 2700, BOTTOM)], name="F1")
FOOTWALL, HANGING_WALL = ((np.interp(z, FAULT.points[:, 1], FAULT.points[:, 0]), z) for z in (500, 560))
BED = sw.Horizon([(X0, 500), FOOTWALL], [HANGING_WALL, (RIGHT, 560)], name="H1")
SPACING = 100.0


def unfaulted(fault=FAULT, bed=BED):
    return sw.Restoration(SECTION, spacing=SPACING).unfault(fault, bed)


@pytest.mark.parametrize("turned", [1, -1])
def test_parts_inside_keep_their_order_and_direction(turned):
    line = np.array([(-60, 100), (60, 100), (60, -20), (90, -20), (90, 200)]) + [X0, 0]
    parts = clip_line(SECTION, line[::turned])[::turned]
    expected = [[(0, 100), (60, 100), (60, 0)], [(90, 0), (90, 200)]]
    for part, points in zip(parts, expected, strict=True):
        np.testing.assert_allclose(part[::turned] - [X0, 0], points, atol=1e-6)


@pytest.mark.parametrize(
    ("picks", "name", "where"),
    [
        ({"fault": sw.Fault([(X0 + 2280, -62.25), (X0 + 2700, BOTTOM)], "F1")}, "F1", "x=1708123.6 m, z=-62.25 m"),
        ({"fault": sw.Fault([(X0 + 2300, -0.01), (X0 + 2700, BOTTOM)], "F1")}, "F1", "z=-0.01 m"),
        (
            {"bed": sw.Horizon([(X0 - 3, 500), FOOTWALL], BED.pieces[1], name="H1")},
            "H1",
            "x=1705840.6 m",
        ),
    ],
)
def test_what_sticks_out_is_clipped_with_a_note(picks, name, where):
    report = unfaulted(**picks).stages[-1].report
    (note,) = (finding for finding in report.findings if finding.kind != "extension")
    assert (note.severity, note.kind, note.pick) == ("note", "clipped", name)
    assert where in note.text
    assert report.converged
    assert max(cutoff.misfit for cutoff in report.cutoffs) < 0.1 * SECTION.dz


def test_a_note_about_clipping_is_given_once():
    bed = sw.Horizon([(X0 - 3, 500), FOOTWALL], BED.pieces[1], name="H1")
    assert [finding.kind for finding in unfaulted(bed=bed).flatten(bed).findings] == ["clipped"]


@pytest.mark.parametrize("depth", [0.0, 0.05, 0.5, 1.5, 2.5, 5.0])
@pytest.mark.parametrize("base", [False, True])
def test_a_horizon_at_the_border_flattens(depth, base):
    x = np.linspace(X0 + 0.4, RIGHT, 30)
    z = np.full(30, BOTTOM - depth if base else depth)
    report = sw.Restoration(SECTION).flatten(sw.Horizon(np.column_stack([x, z]), name="sea floor")).stages[-1].report
    assert report.converged
    assert report.vertices < 4000
    assert report.findings == ()


def test_the_sea_floor_flattens_after_unfaulting():
    sea_floor = sw.Horizon([(X0, 0.2), (RIGHT, 0.2)], name="sea floor")
    report = unfaulted().flatten(sea_floor).stages[-1].report
    assert report.converged
    assert report.beds[0].flatness < 0.1 * SECTION.dz


def test_many_finely_digitised_faults():
    faults, pieces, left = [], [], (X0, 690.0)
    for index in range(20):
        z = np.arange(300.0, 1106, 6.0)
        x = X0 + 200 + 230 * index + (z - 300) / 2.5
        faults.append(sw.Fault(np.column_stack([x, z]), name=f"F{index}"))
        pieces.append([left, (np.interp(690, z, x), 690)])
        left = (np.interp(730, z, x), 730.0)
    report = sw.Restoration(SECTION).unfault(faults, sw.Horizon(*pieces, [left, (RIGHT, 730)])).stages[-1].report
    assert report.converged
    assert report.vertices < 5000
