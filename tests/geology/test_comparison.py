"""Interpretations compared with the truth, and pooled."""

import numpy as np
import pytest

import seiswidgets as sw
from seiswidgets.geology.assignment import assigned_case, file_stem

CASE = sw.synthetic.planar_fault()
TRUE = CASE.interpretation


def moved(aside=0.0, down=0.0, right=0.0, names="ABC", horizons=TRUE.horizons):
    """The true picks shifted (m), the right pieces of the horizons by more, with other names in another order."""
    lines = [
        sw.Horizon(bed.pieces[0] + [aside, down], bed.pieces[1] + [aside, down + right], name=name)
        for bed, name in zip(horizons, names, strict=False)
    ]
    return sw.Interpretation([sw.Fault(TRUE.faults[0].points + [aside, 0], name="X")], lines[::-1])


def test_the_truth_compared_with_itself_is_right():
    found = sw.compare_picks(CASE.section, TRUE, TRUE)
    assert [line.pick for line in found.lines] == ["F1", "H1", "H2", "H3"]
    assert found.error("fault") == pytest.approx(0, abs=1e-9)
    assert found.error("horizon") == pytest.approx(0, abs=1e-9)
    assert found.coverage("horizon") == 1
    assert found.throw_error == 0
    assert found.extra == ()


def test_errors_are_distances_in_metres_of_rock():
    found = sw.compare_picks(CASE.section, moved(down=7), TRUE)
    assert found.error("horizon") == pytest.approx(7, rel=0.02)
    slanted = sw.compare_picks(CASE.section, moved(aside=20), TRUE)
    assert slanted.error("fault") == pytest.approx(20 * np.sin(np.radians(60)), rel=0.02)


def test_picks_are_matched_by_position():
    found = sw.compare_picks(CASE.section, moved(down=5), TRUE)
    assert [(line.name, line.pick) for line in found.lines] == [("F1", "X"), ("H1", "A"), ("H2", "B"), ("H3", "C")]


def test_a_wrong_match_shows_in_error_and_throw():
    found = sw.compare_picks(CASE.section, moved(right=75), TRUE)
    assert found.error("horizon") > 40
    assert [score.picked - score.true for score in found.throws] == pytest.approx([75] * 3, abs=1)


def test_a_missing_pick_is_named_and_an_extra_one_too():
    few = sw.compare_picks(CASE.section, moved(horizons=TRUE.horizons[:1]), TRUE)
    assert [line.pick for line in few.lines] == ["X", "A", None, None]
    assert [score.picked is None for score in few.throws] == [False, True, True]
    assert few.coverage("horizon") == pytest.approx(1 / 3)
    assert "not picked" in str(few)
    more = sw.compare_picks(CASE.section, TRUE, moved(horizons=TRUE.horizons[:2], names="AB"))
    assert more.extra == ("H3",)
    assert np.isnan(sw.compare_picks(CASE.section, sw.Interpretation(), TRUE).error("fault"))


def test_a_pick_far_from_the_truth_covers_nothing_of_it():
    level = sw.Interpretation([sw.Fault([(0, 500), (4000, 500)], name="F1")], TRUE.horizons)
    found = sw.compare_picks(CASE.section, level, TRUE)
    assert found.coverage("fault") < 0.15
    assert found.error("fault") > 500


def test_half_a_line_covers_half():
    bed = TRUE.horizons[1].pieces[0]
    half = sw.Horizon(bed[: len(bed) // 2 + 1], TRUE.horizons[1].pieces[1], name="H2")
    picks = sw.Interpretation(TRUE.faults, [TRUE.horizons[0], half, TRUE.horizons[2]])
    (line,) = [line for line in sw.compare_picks(CASE.section, picks, TRUE).lines if line.name == "H2"]
    lengths = [np.ptp(piece[:, 0]) for piece in TRUE.horizons[1].pieces]
    assert line.coverage == pytest.approx(1 - lengths[0] / 2 / sum(lengths), abs=0.02)


def test_a_class_is_pooled_into_percentiles():
    offsets = np.linspace(-20, 20, 11)
    pool = sw.pool_picks(CASE.section, [moved(right=offset) for offset in offsets], TRUE)
    true = sw.throw(TRUE.faults[0], TRUE.horizon("H2"))
    assert pool.throw_percentiles("F1", "H2") == pytest.approx([true - 16, true, true + 16], abs=0.5)
    low, median, high = pool.depth_percentiles("H2")
    right = CASE.section.x > 3000
    assert median[right] == pytest.approx(np.full(right.sum(), 1000 + 150), abs=1)
    assert (high - low)[right] == pytest.approx(np.full(right.sum(), 32), abs=1)
    assert (high - low)[CASE.section.x < 1000] == pytest.approx(0, abs=1e-9)
    with pytest.raises(sw.PickError, match="no interpretation to pool"):
        sw.pool_picks(CASE.section, [])


def test_an_assignment_depends_on_name_and_course_alone():
    mine = sw.assignment("Ada Lovelace", "2026")
    assert np.array_equal(mine.amplitude, sw.assignment("  ada   LOVELACE", "2026").amplitude)
    assert not np.array_equal(mine.amplitude, sw.assignment("Ada Byron", "2026").amplitude)
    assert not np.array_equal(mine.amplitude, sw.assignment("Ada Lovelace").amplitude)
    case = assigned_case("Ada Lovelace", "2026")
    assert [bed.pieces[0][0, 1] for bed in case.interpretation.horizons] == pytest.approx([750, 1050, 1400], abs=2)
    assert file_stem("Zoë Müller-Óg") == "zoë-müller-óg"
    with pytest.raises(sw.SettingError, match="needs a student's name"):
        sw.assignment(" - ")
