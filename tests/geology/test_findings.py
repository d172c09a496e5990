"""Findings of a report: known faults of drawings are found, and named in the section's units."""

from dataclasses import replace

import numpy as np
import pytest
import shapely

import seiswidgets as sw
from seiswidgets.geology.findings import SEVERITIES, Finding, worst_first

WIDTH, DEPTH = 4000.0, 2000.0
STEEP = np.array([0.5, np.sqrt(3) / 2])  # a fault that dips at 60 degrees to the right
DEPTH_SECTION = sw.Section(np.ones((101, 161), np.float32), dx=25, dz=20)
SECTIONS = {
    "depth": DEPTH_SECTION,
    "time": sw.Section(np.ones((101, 161), np.float32), dx=25, dz=10, z_unit="ms", velocity=4000.0),
    "km": sw.Section(np.ones((101, 161), np.float32), dx=0.025, dz=20, x_unit="km"),
}


def at(z, x=1500.0):
    """The point of a steep fault at a depth in metres."""
    return np.array([x, 0]) + z / STEEP[1] * STEEP


def drawn(top=0.0, bottom=DEPTH, slip=60.0, section=DEPTH_SECTION):
    """A steep fault between two depths, and two beds that it offsets by a slip, on any section of 4000 by 2000 m."""
    beds = []
    for number, z in enumerate((700.0, 1200.0), 1):
        footwall, hanging_wall = at(z), at(z) + slip * STEEP
        left, right = [(0, z), footwall], [hanging_wall, (WIDTH, hanging_wall[1])]
        beds.append(sw.Horizon(section.from_rock(left), section.from_rock(right), name=f"H{number}"))
    return sw.Fault(section.from_rock([at(top), at(bottom)]), name="F1"), beds


def of_kind(findings, kind):
    return [finding for finding in findings if finding.kind == kind]


def unfaulted(fault, beds, section=DEPTH_SECTION, **options):
    return sw.Restoration(section).unfault(fault, beds, **options)


def test_a_clean_section_has_no_findings():
    restored = unfaulted(*drawn(), fixed=(300, 1000))
    assert restored.findings == ()
    assert restored.settled


@pytest.mark.parametrize(
    ("section", "shortfall", "words"),
    [
        ("depth", 65, "F1 dies out 65 m below the top of the section"),
        ("depth", 95, "F1 dies out 95 m below the top of the section"),
        ("time", 70, "F1 dies out 35 ms below the top of the section"),
        ("km", 65, "F1 dies out 65 m below the top of the section"),
    ],
)
def test_a_fault_that_ends_just_below_the_top(section, shortfall, words):
    section = SECTIONS[section]
    stage = unfaulted(*drawn(top=shortfall, section=section), section).stages[-1]
    (end,) = of_kind(stage.report.findings, "fault end")
    assert end.severity == "warning"
    assert end.pick == "F1"
    assert end.text == f"{words}; the rock there must bend instead of slip. Extend it to the border if it reaches it."
    np.testing.assert_allclose(end.where, section.from_rock(at(shortfall)), rtol=1e-9)


def test_other_borders_are_named_too():
    fault, beds = drawn(bottom=DEPTH - 80)
    (end,) = of_kind(unfaulted(fault, beds).findings, "fault end")
    assert end.text.startswith("F1 dies out 80 m above the bottom of the section;")
    level = sw.Fault([(90, 600), (1500, 900), (3910, 1100)], name="thrust")
    bed = sw.Horizon([(400, 100), (1400, 879.6)], [(1600, 908.1), (2600, 1500)], name="H")
    ends = of_kind(unfaulted(level, bed).findings, "fault end")
    assert [end.text.split(";")[0] for end in ends] == [
        "thrust dies out 90 m from the left border of the section",
        "thrust dies out 90 m from the right border of the section",
    ]


@pytest.mark.parametrize("top", [130, 300, 500])
def test_a_fault_that_dies_out_far_inside_is_only_noted(top):
    (end,) = of_kind(unfaulted(*drawn(top=top, slip=40)).findings, "fault end")
    assert (end.severity, end.text) == ("note", f"F1 dies out inside the section, {top} m below the top.")


def test_a_slip_that_would_die_out_too_soon_is_a_warning():
    """160 m below the top is far for a slip of 60 m, and near for one of 250 m."""
    severities = [
        of_kind(unfaulted(*drawn(top=160, slip=slip)).findings, "fault end")[0].severity for slip in (60, 250)
    ]
    assert severities == ["note", "warning"]


def test_genuine_blind_faults_are_no_errors():
    case = sw.synthetic.blind_fault()
    restored = sw.Restoration(case.section).unfault(case.interpretation.faults, case.interpretation.horizons)
    found = [(finding.severity, finding.kind) for finding in restored.findings]
    assert set(found) == {("note", "fault end"), ("warning", "heave")}  # the beds beside them were indeed stretched
    assert found.count(("note", "fault end")) == 2


@pytest.mark.parametrize(
    ("gap", "words"), [(90, "F2 ends 90 m short of F1 near x="), (-90, "F2 ends 90 m beyond F1 near x=")]
)
def test_a_fault_that_does_not_quite_reach_another(gap, words):
    fault, beds = drawn()
    meeting = at(1000.0)
    across = np.array([STEEP[1], -0.5])
    start, end = meeting + 1100 * across, meeting + gap * across
    branch = sw.Fault([start, end], name="F2")
    middle = (start + end) / 2
    bed = sw.Horizon([middle + (-300, -80), middle + (-20, -80)], [middle + (30, 60), middle + (300, 60)], name="H3")
    ends = of_kind(unfaulted([fault, branch], [*beds, bed]).findings, "fault end")
    (near,) = (end for end in ends if end.severity == "warning")
    assert near.text.startswith(words)
    assert near.pick == "F2"
    np.testing.assert_allclose(near.where, end, rtol=1e-9)


def test_a_fault_that_meets_another_does_not_end_there():
    fault, beds = drawn()
    meeting, across = at(1000.0), np.array([STEEP[1], -0.5])
    start = meeting + 1100 * across
    middle = (start + meeting) / 2
    bed = sw.Horizon([middle + (-300, -80), middle + (-20, -80)], [middle + (30, 60), middle + (300, 60)], name="H3")
    ends = of_kind(unfaulted([fault, sw.Fault([start, meeting], name="F2")], [*beds, bed]).findings, "fault end")
    np.testing.assert_allclose([end.where for end in ends], [start], rtol=1e-9)


def test_a_solver_that_did_not_settle():
    case = sw.synthetic.sine_fold(dip=45)
    restored = sw.Restoration(case.section).flatten(case.interpretation.horizons[1], max_iterations=3)
    (unsettled,) = of_kind(restored.findings, "unsettled")
    assert (unsettled.severity, unsettled.pick) == ("problem", "H2")
    assert unsettled.text.startswith("the solver did not settle in 3 iterations")
    assert "max_iterations" in unsettled.text
    assert case.section.contains([unsettled.where]).all()
    assert not restored.settled
    report = restored.stages[-1].report
    assert report.findings[0].severity == "problem"
    assert unsettled.text not in report.unmet


@pytest.fixture(scope="module")
def contradicting():
    """The upper bed of one side is joined to its own other side, the middle one to the lowest: no slip matches both."""
    case = sw.synthetic.planar_fault()
    (left, right), (low_left, _), (_, low_right) = (horizon.pieces for horizon in case.interpretation.horizons)
    crossed = [sw.Horizon(left, right, name="A"), sw.Horizon(low_left, low_right, name="B")]
    fault, weights = case.interpretation.faults, sw.Weights(stitch=1, slide=0.1)
    return crossed, sw.Restoration(case.section, spacing=100).unfault(fault, crossed, weights=weights)


def test_cut_offs_that_stay_apart(contradicting):
    crossed, restored = contradicting
    apart = of_kind(restored.findings, "cut-off")
    assert [(finding.severity, finding.pick) for finding in apart] == [("problem", "A"), ("problem", "B")]
    for finding, horizon in zip(apart, crossed, strict=True):
        np.testing.assert_allclose(finding.where, horizon.pieces[1][0], rtol=1e-6)
        assert finding.text.startswith(f"horizon {horizon.name} at fault F1: its cut-offs are still ")
        assert " m apart, near x=" in finding.text
    assert {finding.text for finding in apart} <= set(restored.stages[-1].report.unmet)


def test_sides_of_a_fault_that_part(contradicting):
    _, restored = contradicting
    (parted,) = of_kind(restored.findings, "contact")
    assert (parted.severity, parted.pick) == ("warning", "F1")
    assert parted.text.startswith("the sides of fault F1 are up to ")
    (line,) = restored.stages[0].faults
    assert line.distance(shapely.Point(parted.where)) < 1


def test_rock_on_rock():
    """Two faults that cross cannot both slip far at once."""
    faults = [sw.Fault([(x, 0), (3000 - x, 2000)], name=name) for x, name in ((1000, "F1"), (2000, "F2"))]
    bed = sw.Horizon([(0, 700), (1350, 700)], [(1450, 900), (1550, 900)], [(1650, 700), (4000, 700)], name="A")
    restored = sw.Restoration(DEPTH_SECTION, 100).unfault(faults, bed)
    (overlap,) = of_kind(restored.findings, "overlap")
    stage = restored.stages[-1]
    assert overlap.severity == "problem"
    assert overlap.text.startswith(f"{float(f'{stage.report.overlap:.2g}'):g} m² of rock lie on other rock")
    there = restored.to_restored([overlap.where])[0]
    corners = stage.vertices[stage.mesh.triangles] - there
    ahead = np.roll(corners, -1, axis=1)
    holding = (corners[..., 0] * ahead[..., 1] - corners[..., 1] * ahead[..., 0] > 0).all(axis=1)
    assert holding.sum() >= 2  # the rock from there lies where other rock lies


def test_gaps_between_blocks():
    case = sw.synthetic.blind_fault()
    picks = case.interpretation
    (stage,) = sw.Restoration(case.section, 100).unfault(picks.faults, picks.horizons).stages
    line, rest = stage.faults[0], stage.mesh.vertices
    centres = rest[stage.mesh.triangles].mean(axis=1)
    beside = np.array([line.distance(shapely.Point(centre)) for centre in centres]) < 100
    right = centres[:, 0] > np.interp(centres[:, 1], *np.array(line.coords)[:, ::-1].T)
    moved = stage.vertices.copy()
    one_side = np.setdiff1d(stage.mesh.triangles[beside & right], stage.mesh.triangles[~right])
    moved[one_side[[line.distance(shapely.Point(rest[vertex])) < 1e-6 for vertex in one_side]], 0] += 20
    report = replace(stage, vertices=moved).report
    (gap,) = of_kind(report.findings, "gap")
    assert report.gap == pytest.approx(20 * np.ptp(np.array(line.coords)[:, 1]), rel=0.3)
    assert gap.severity == "warning"
    assert "of gaps have opened between the blocks" in gap.text
    assert line.distance(shapely.Point(gap.where)) < 100


def test_a_horizon_off_its_datum():
    case = sw.synthetic.sine_fold(dip=45)
    loose = sw.Weights(flatten=0.1)
    findings = sw.Restoration(case.section).flatten(case.interpretation.horizons[1], weights=loose).findings
    (off,) = of_kind(findings, "datum")
    assert (off.severity, off.pick) == ("problem", "H2")
    assert "m off its datum near x=" in off.text
    line = case.interpretation.horizons[1].pieces[0]
    assert np.hypot(*(line - off.where).T).min() < 60


@pytest.mark.parametrize(("length", "found"), [(10, False), (0.1, True)])
def test_a_bed_that_does_not_keep_its_length(length, found):
    case = sw.synthetic.sine_fold(dip=30)
    restored = sw.Restoration(case.section).flatten(case.interpretation.horizons[1], weights=sw.Weights(length=length))
    changed = of_kind(restored.findings, "bed length")
    assert bool(changed) == found
    change = restored.stages[-1].report.beds[0].length_change
    assert (abs(change) > 0.005) == found
    for finding in changed:
        assert (finding.severity, finding.pick) == ("warning", "H2")
        assert f"has become {abs(change):.1%} shorter" in finding.text


def test_findings_of_all_stages_are_placed_in_the_present_day_section():
    fault, beds = drawn(top=25, slip=250)
    first = unfaulted(fault, beds, fixed=None)
    second = first.flatten(beds[0], max_iterations=1)
    (unsettled,) = of_kind(second.findings, "unsettled")
    (as_reported,) = of_kind(second.stages[1].report.findings, "unsettled")
    np.testing.assert_allclose(first.to_restored([unsettled.where]), [as_reported.where], atol=1)
    assert np.hypot(*np.subtract(unsettled.where, as_reported.where)) > 10
    count = sum(len(stage.report.findings) for stage in second.stages)
    assert len(second.findings) == count
    ranks = [SEVERITIES.index(finding.severity) for finding in second.findings]
    assert ranks == sorted(ranks, reverse=True)
    assert first.settled
    assert not second.settled


def test_a_place_that_was_nowhere_before_has_none():
    fault, beds = drawn()
    first = unfaulted(fault, beds, fixed=(300, 1000))
    assert first._origin((-500.0, 300.0)) is None
    assert replace(first, stages=())._origin((-500.0, 300.0)) == (-500.0, 300.0)


def test_worst_first():
    given = [
        Finding(severity, "datum", text) for text, severity in enumerate(("note", "problem", "warning", "problem"))
    ]
    assert [finding.text for finding in worst_first(given)] == [1, 3, 2, 0]


def test_a_severity_that_there_is_not():
    with pytest.raises(ValueError, match=r"severity must be one of .* but is 'fatal'"):
        Finding("fatal", "datum", "")


@pytest.mark.parametrize(("top", "angle"), [(160.0, 25), (0.0, None)])
def test_a_section_that_folds_about_the_tip_of_a_fault(top, angle):
    """A long section with a large throw below a young cover: the limbs turn until the fault's lower end matches."""
    section = sw.Section(np.zeros((241, 801), np.float32), 25.0, 4.0)
    line = sw.Fault([(12000.0 - 1.54 * (z - 160.0), z) for z in (top, 960.0)], name="F")
    (left, right) = ((12000.0 - 1.54 * (z - 160.0), z) for z in (820.0, 490.0))
    bed = sw.Horizon([(0.0, 820.0), left], [right, (20000.0, 490.0)], name="H")
    stage = sw.Restoration(section, 200.0).unfault(line, bed).stages[-1]
    folds = of_kind(stage.report.findings, "fold")
    assert bool(folds) == (angle is not None)
    hanging, foot = sorted(stage.report.motions, key=lambda motion: motion.where[0])
    assert (hanging.part, foot.part) == ("hanging wall of F", "footwall of F")
    if angle is None:
        assert foot.rotation == pytest.approx(hanging.rotation, abs=0.1)
        assert foot.dx - hanging.dx == pytest.approx(-1.54 * 330, rel=0.02)
        return
    assert foot.rotation - hanging.rotation == pytest.approx(angle, abs=1.5)
    assert folds[0].severity == "problem"
    words = f"the section folds by {foot.rotation - hanging.rotation:.0f} degrees about the tip of F: is the young"
    assert folds[0].text.startswith(words)
    np.testing.assert_allclose(folds[0].where, (12000, 160), rtol=1e-6)
    assert stage.report.verdict.startswith("Settled; cut-offs meet to 0.0")
    assert f" samples; but {words}" in stage.report.verdict


@pytest.mark.parametrize(("top", "severity"), [(0.0, "warning"), (300.0, "note")])
def test_an_offset_that_grows_downwards(top, severity):
    """Growth is suspected where the fault reaches the surface; towards a tip, slip falls to 0 anyway."""
    beds = [
        sw.Horizon([(0, z), at(z)], [at(z) + slip * STEEP, (WIDTH, (at(z) + slip * STEEP)[1])], name=f"H{number}")
        for number, (z, slip) in enumerate(((700.0, 50.0), (1000.0, 90.0), (1300.0, 130.0)), 1)
    ]
    fault = sw.Fault([at(top), at(DEPTH)], name="F1")
    (growth,) = of_kind(unfaulted(fault, beds).findings, "growth")
    assert (growth.severity, growth.pick) == (severity, "F1")
    assert growth.text.startswith("the offset along F1 grows downwards from 50 m to 130 m")
    assert not of_kind(unfaulted(fault, beds[:1]).findings, "growth")
