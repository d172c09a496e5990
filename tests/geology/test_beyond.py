"""A horizon on one sixth of the section is flattened, and the choice for the rest does what it says at the far end."""

import numpy as np
import pytest

import seiswidgets as sw

TILT, FOLD = sw.synthetic.tilt(10.0), sw.synthetic.sine_fold(20.0)
SPACING = 100.0


def part_of(case, share):
    """The first horizon of a case, as far as a share of the section's width."""
    (points,) = case.interpretation.horizons[0].pieces
    x_min, x_max, _, _ = case.section.extent
    return sw.Horizon(points[points[:, 0] <= x_min + share * (x_max - x_min)], name="H1")


def flattened(case, beyond, share=1 / 6):
    return sw.Restoration(case.section, SPACING).flatten(part_of(case, share), beyond=beyond)


def far_shift(case, restored):
    """Shift along z of points in the farthest tenth of the section."""
    x_min, x_max, z_min, z_max = case.section.extent
    points = np.stack(np.meshgrid(np.linspace(0.9, 1, 4), np.linspace(0.1, 0.9, 4)), -1).reshape(-1, 2)
    points = points * [x_max - x_min, z_max - z_min] + [x_min, z_min]
    return restored.to_restored(points)[:, 1] - points[:, 1]


@pytest.mark.parametrize("case", [TILT, FOLD], ids=["tilt", "fold"])
@pytest.mark.parametrize("beyond", ["free", "keep", "level", "trend"])
def test_the_horizon_itself_is_flat_whatever_happens_to_the_rest(case, beyond):
    (drawn,) = part_of(case, 1 / 6).pieces
    depths = flattened(case, beyond).to_restored(drawn)[:, 1]
    np.testing.assert_allclose(depths, depths.mean(), atol=0.1 * case.section.dz)


@pytest.mark.parametrize("beyond", ["free", "trend"])
def test_a_tilted_section_turns_as_a_whole(beyond):
    (bed,) = TILT.interpretation.horizons[0].pieces
    restored = flattened(TILT, beyond)
    assert np.ptp(restored.to_restored(bed)[:, 1]) < 0.2 * TILT.section.dz
    assert far_shift(TILT, restored).max() < -500.0  # right for a tilt, and a surprise if only the near end is tilted


@pytest.mark.parametrize("case", [TILT, FOLD], ids=["tilt", "fold"])
def test_the_rest_can_be_kept(case):
    np.testing.assert_allclose(far_shift(case, flattened(case, "keep")), 0.0, atol=1e-9)


@pytest.mark.parametrize("case", [TILT, FOLD], ids=["tilt", "fold"])
def test_a_horizon_extended_level_shifts_the_rest_by_as_much_as_its_end(case):
    restored = flattened(case, "level")
    (drawn,) = part_of(case, 1 / 6).pieces
    end = drawn[np.argmax(drawn[:, 0])]
    shift = restored.to_restored([end])[0, 1] - end[1]
    np.testing.assert_allclose(far_shift(case, restored), shift, rtol=0.1)


def test_what_a_choice_does_to_a_horizon_that_crosses_the_section_is_nothing():
    shifts = [far_shift(FOLD, flattened(FOLD, beyond, 1.0)) for beyond in ("free", "keep", "level", "trend")]
    for shift in shifts[1:]:
        np.testing.assert_allclose(shift, shifts[0], atol=1e-9)


def test_it_is_a_finding_that_the_rest_turns_and_a_note_what_was_chosen():
    (found,) = flattened(TILT, "free").findings
    assert (found.severity, found.kind, found.pick) == ("warning", "beyond", "H1")
    assert "spans 17% of the section" in found.text
    assert "beyond=" in found.text
    assert found.where[0] == pytest.approx(TILT.section.extent[1])
    for beyond in ("keep", "level", "trend"):
        (note,) = flattened(TILT, beyond).findings
        assert (note.severity, note.kind) == ("note", "beyond")
    assert flattened(TILT, "free", 1.0).findings == ()
    assert flattened(TILT, "free", 0.7).findings == ()


def test_a_plan_carries_the_choice_and_an_unknown_one_is_refused():
    step = sw.Step("flatten", datum=900.0, beyond="keep")
    picks = sw.Interpretation(horizons=[part_of(TILT, 1 / 6)])
    restored = sw.Plan((step,), spacing=SPACING).restore(TILT.section, picks)
    assert np.abs(far_shift(TILT, restored)).max() < 1e-9
    for refuse in (lambda: sw.Step("flatten", beyond="hold"), lambda: flattened(TILT, "hold")):
        with pytest.raises(sw.SettingError, match="beyond must be one of free, keep, level, trend"):
            refuse()
