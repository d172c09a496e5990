"""A listric fault drawn with few points restores as if it had been drawn with many: known answer, also beside it."""

import numpy as np
import pytest
import shapely

import seiswidgets as sw

CASE = sw.synthetic.listric_fault(turn=0.06)
NEAR = 3  # traces


def beside_cutoffs(section):
    """Sample positions of the restored section within a few traces of the cut-offs, where barbs used to be."""
    (fault,) = CASE.interpretation.faults
    cutoffs = [cutoff.footwall for bed in CASE.interpretation.horizons for cutoff in sw.cutoffs(fault, bed)]
    step = np.stack(np.meshgrid(*[np.arange(-NEAR, NEAR + 1)] * 2), axis=-1).reshape(-1, 2) * (section.dx, section.dz)
    return np.concatenate(
        [np.round(np.array(cutoff) / (section.dx, section.dz)) * (section.dx, section.dz) + step for cutoff in cutoffs]
    )


@pytest.mark.parametrize("count", [7, 5, 4])
def test_a_fault_of_few_points(count):
    points = CASE.interpretation.faults[0].points
    drawn = sw.Fault(points[np.linspace(0, len(points) - 1, count).round().astype(int)], name="F1")
    largest_turn = np.degrees(np.abs(np.diff(np.arctan2(*np.diff(drawn.points, axis=0).T)))).max()
    assert 9 < largest_turn < 20
    assert shapely.hausdorff_distance(shapely.LineString(points), shapely.LineString(drawn.points)) > 10
    restored = sw.Restoration(CASE.section, spacing=100).unfault(drawn, CASE.interpretation.horizons, fixed=CASE.fixed)
    (stage,) = restored.stages
    assert stage.report.iterations <= 5
    assert {finding.kind for finding in stage.report.findings} <= {"extension"}
    assert stage.report.seams[0].widest < 0.1
    there = beside_cutoffs(CASE.section)
    came_from = restored.to_original(there)
    on_curve = shapely.distance(shapely.LineString(points), shapely.points(there)) < 0.5  # of either side
    apart = np.hypot(*(CASE.to_unfaulted(came_from) - there).T)
    assert np.nanmax(apart[~on_curve]) < 0.5
