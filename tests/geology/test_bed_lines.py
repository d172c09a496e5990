"""Length and width of beds before and after restoring, against synthetic sections that keep them."""

import numpy as np
import pytest

import seiswidgets as sw
from seiswidgets.geology.bed_lines import bed_extent


def unfaulted(case, picks=None):
    picks = picks or case.interpretation
    return sw.Restoration(case.section, spacing=100).unfault(picks.faults, picks.horizons, fixed=case.fixed)


@pytest.mark.parametrize(
    "case",
    [sw.synthetic.planar_fault(), sw.synthetic.domino(), sw.synthetic.faulted_fold()],
    ids=lambda case: case.section.name,
)
def test_beds_keep_their_length_and_lose_the_heave_and_the_dip_in_width(case):
    picks, restored = case.interpretation, unfaulted(case)
    for horizon in picks.horizons:
        extent = bed_extent(restored, picks.faults, horizon)
        drawn = sum(np.hypot(*np.diff(piece, axis=0).T).sum() for piece in horizon.pieces)
        np.testing.assert_allclose(extent.length, drawn, rtol=1e-3)
        np.testing.assert_allclose(extent.restored_length, extent.length, rtol=1e-5)
        truth = [case.to_unfaulted(piece) for piece in horizon.pieces]
        np.testing.assert_allclose(extent.restored_width, np.ptp(np.concatenate(truth)[:, 0]), atol=1)


def test_gaps_of_the_picks_beside_a_fault_count_as_bed():
    case = sw.synthetic.planar_fault()
    picks = case.interpretation
    short = []
    for horizon in picks.horizons:
        left, right = sorted(horizon.pieces, key=lambda piece: piece[0, 0])
        short.append(sw.Horizon(left[:-1], right[1:], name=horizon.name))
    restored = unfaulted(case, sw.Interpretation(picks.faults, short))
    for whole, part in zip(picks.horizons, short, strict=True):
        extents = [bed_extent(restored, picks.faults, horizon) for horizon in (whole, part)]
        np.testing.assert_allclose(extents[1].length, extents[0].length, rtol=1e-6)
        np.testing.assert_allclose(extents[1].restored_length, extents[0].length, rtol=1e-5)


def test_a_horizon_outside_the_section_has_no_extent():
    case = sw.synthetic.planar_fault()
    assert bed_extent(unfaulted(case), case.interpretation.faults, sw.Horizon([(9000, 100), (9900, 100)])) is None


def test_a_bed_that_rock_was_stripped_down_to_is_measured_and_those_above_it_are_not():
    case = sw.synthetic.faulted_fold()
    picks = case.interpretation
    restored = sw.Restoration(case.section).strip(picks.horizons[1], faults=picks.faults)
    above, surface, below = (bed_extent(restored, picks.faults, horizon) for horizon in picks.horizons)
    assert above is None
    for extent in (surface, below):
        np.testing.assert_allclose(extent.restored_length, extent.length, rtol=2e-3)
        np.testing.assert_allclose(extent.restored_width, extent.width, rtol=1e-6)
