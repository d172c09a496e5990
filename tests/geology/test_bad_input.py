"""Whatever is wrong with what a person gives is said in their own terms, and nothing is changed by it."""

import re
from itertools import pairwise

import numpy as np
import pytest
from shapely import LineString

import seiswidgets as sw
from seiswidgets.errors import Keyword

AMPLITUDE = np.random.default_rng(1).normal(size=(41, 61)).astype(np.float32)
FLAT = AMPLITUDE[:, :1] * np.ones(61)
SECTION = sw.Section(AMPLITUDE, dx=25.0, dz=25.0)  # 1500 m x 1000 m
TIME = sw.Section(AMPLITUDE, dx=25.0, dz=20.0, z_unit="ms", velocity=2500.0)  # 1500 m x 800 ms, as high as 1000 m
SPACING = 100.0

FAULT = sw.Fault([(700, 0), (900, 1000)], name="F1")
LEFT, RIGHT = [(0, 400), (780, 400)], [(800, 500), (1500, 500)]
HORIZON = sw.Horizon(LEFT, RIGHT, name="H1")
BLIND = sw.Fault([(760, 300), (840, 700)], name="blind")
BENT = sw.Horizon([(0, 400), (780, 400)], [(790, 430), (1500, 430)], name="bent")
TIMES = [LEFT * np.array([1, 0.8]), RIGHT * np.array([1, 0.8])]
TIME_FAULT, TIME_HORIZON = sw.Fault([(700, 0), (900, 800)], name="F1"), sw.Horizon(*TIMES, name="H1")


@pytest.mark.parametrize(
    ("amplitude", "message"),
    [
        (np.ones(5), r"2-D, \(samples, traces\), but have 1 dimension"),
        (np.ones((2, 3, 4)), r"2-D.* shape \(2, 3, 4\)"),
        ([], r"2-D.* shape \(0,\)"),
        (np.empty((0, 5)), r"at least 2 samples by 2 traces, but have shape \(0, 5\)"),
        (np.ones((1, 5)), r"at least 2 samples by 2 traces, but have shape \(1, 5\)"),
        (np.full((4, 5), np.nan), "all amplitudes are NaN"),
        ([[1, 2, 3], [4, 5, np.inf]], "sample 1 of trace 2 is infinite"),
        ([[1, 2], [-np.inf, 4]], "sample 1 of trace 0 is infinite"),
        ([[1, 2], [3]], "array of real numbers"),
        ([["a", "b"], ["c", "d"]], "array of real numbers"),
        (np.full((2, 2), 1j), "array of real numbers"),
        (None, "array of real numbers"),
    ],
)
def test_amplitudes(amplitude, message):
    with pytest.raises(sw.SectionError, match=message):
        sw.Section(amplitude, dx=1, dz=1)


def test_some_nan_amplitudes_are_fine_and_stay():
    missing = np.zeros(AMPLITUDE.shape, bool)
    missing[10:20, 45:55] = True
    section = sw.Section(np.where(missing, np.nan, FLAT), dx=25, dz=25)
    np.testing.assert_array_equal(np.isnan(section.amplitude), missing)
    level = sw.Horizon([(0, 800), (1500, 800)])
    restored = sw.Restoration(section, spacing=SPACING).flatten(level).section  # flat already: the same picture
    assert restored.shape == section.shape
    assert np.isnan(restored.amplitude[missing]).all()
    far = np.zeros(AMPLITUDE.shape, bool)
    far[1:-1, 1:40] = True
    np.testing.assert_allclose(restored.amplitude[far], FLAT[far], atol=1e-5)


@pytest.mark.parametrize(
    ("settings", "message"),
    [
        ({"dx": 0}, "dx must be above 0, but is 0"),
        ({"dx": -25}, "dx must be above 0, but is -25"),
        ({"dz": 0.0}, "dz must be above 0"),
        ({"dz": -1}, "dz must be above 0"),
        ({"dx": np.nan}, "dx must be a finite number"),
        ({"dz": np.inf}, "dz must be a finite number"),
        ({"dx": "wide"}, "dx must be a number, but is 'wide'"),
        ({"dz": None}, "dz must be a number, but is None"),
        ({"x0": np.nan}, "x0 must be a finite number"),
        ({"z_unit": "ms"}, r"two-way time \(z_unit='ms'\) needs velocity=, in m/s"),
        ({"z_unit": "s"}, "needs velocity="),
        ({"velocity": 2400}, r"in depth \(z_unit='m'\) takes no velocity=; leave it out"),
        ({"z_unit": "ms", "velocity": 0}, "velocity must be above 0 m/s"),
        ({"z_unit": "ms", "velocity": -2400}, "velocity must be above 0 m/s"),
        ({"z_unit": "ms", "velocity": np.nan}, "velocity must be a finite number"),
        ({"name": None}, "name must be text, but is None"),
        ({"credit": b"us"}, "credit must be text, but is b'us'"),
        ({"x_unit": "feet"}, "x_unit must be one of m, km, ft, but is 'feet'"),
        ({"z_unit": "hours"}, "z_unit must be one of m, km, ft, s, ms, but is 'hours'"),
    ],
)
def test_spacing_and_units(settings, message):
    with pytest.raises(sw.SectionError, match=message):
        sw.Section(AMPLITUDE, **{"dx": 25, "dz": 25} | settings)


LINES = {
    "none": ([], "must be a list of points"),
    "one point": ([(5, 5)], "at least two different points, but has 1"),
    "one point, twice": ([(5, 5), (5, 5)], "at least two different points, but has 1"),
    "NaN": ([(0, 0), (5, np.nan), (9, 9)], r"point 2 of .* is not finite: \(5, nan\)"),
    "infinite": ([(0, 0), (-np.inf, 1)], r"point 2 of .* is not finite: \(-inf, 1\)"),
    "three numbers": ([(0, 0, 0), (1, 1, 1)], r"list of points \(x, z\), but has shape \(2, 3\)"),
    "ragged": ([(0, 0), (1,)], "each of two numbers"),
    "words": ([("a", "b"), ("c", "d")], "each of two numbers"),
    "nothing": (None, "must be a list of points"),
}
FLAWED = {
    "crossing": ([(0, 0), (10, 0), (10, 5), (4, -5)], "crosses itself near x=7, z=0; redraw it or split it in two"),
    "crossing, with a point twice": ([(0, 0), (0, 0), (10, 10), (10, 0), (10, 0), (0, 10)], "near x=5, z=5"),
    "touching": ([(0, 0), (10, 0), (10, 5), (5, 0)], "crosses itself near x=5, z=0"),
    "back over its end": ([(0, 0), (10, 0), (6, 0)], "crosses itself near x=8, z=0"),
    "back and on": ([(0, 0), (10, 0), (6, 0), (20, 0)], "crosses itself near x=8, z=0"),
    "back over itself": ([(0, 0), (10, 0), (10, 4), (10, 0), (4, 0)], "crosses itself near x=10, z=0"),
    "closed": ([(0, 0), (10, 0), (10, 5), (0, 0)], "closes on itself at x=0, z=0; leave it open"),
    "there and back": ([(0, 0), (10, 0), (0, 0)], "closes on itself"),
}


@pytest.mark.parametrize(("points", "message"), LINES.values(), ids=LINES)
def test_lines(points, message):
    with pytest.raises(sw.PickError, match=f"fault 'F1'.*{message}|{message}") as raised:
        sw.Fault(points, name="F1")
    assert "fault 'F1'" in str(raised.value)
    with pytest.raises(sw.PickError, match=message) as raised:
        sw.Horizon(LEFT, points, name="H1")
    assert "piece 2 of horizon 'H1'" in str(raised.value)


@pytest.mark.parametrize(("points", "message"), FLAWED.values(), ids=FLAWED)
def test_lines_that_cross_themselves_are_carried(start, unfaulted, points, message):
    line = 50.0 * np.array(points) + (100, 300)
    bad_fault, bad_horizon = sw.Fault(line, name="F2"), sw.Horizon(LEFT, line, RIGHT, name="H1")
    assert not bad_fault.constrains
    assert bad_horizon.constrains
    restored = start.unfault([FAULT, bad_fault], bad_horizon, fixed=(100, 100))
    np.testing.assert_array_equal(restored.stages[-1].vertices, unfaulted.stages[-1].vertices)
    about = {finding.pick: finding for finding in restored.findings}
    for pick, what in ((bad_fault, "fault 'F2'"), (bad_horizon, "piece 2 of horizon 'H1'")):
        finding = about[pick.name]
        assert (finding.severity, finding.where) == ("warning", pick.flaw.where)
        assert re.match(f"{what} (crosses|closes) .*until then it is only carried along", finding.text)
        assert message.split()[0] in finding.text
        assert len(restored.carried(pick)) >= 1
    with pytest.raises(sw.PickError, match="fault 'F2' c"):
        start.unfault(bad_fault, HORIZON)


def test_a_horizon_without_pieces():
    with pytest.raises(sw.PickError, match="horizon 'H1' needs at least one piece"):
        sw.Horizon(name="H1")


def fault(*points):
    return sw.Fault(points, name="F2")


def horizon(*pieces):
    return sw.Horizon(*pieces, name="H2")


UNFAULTED = {
    "no fault": (([], HORIZON), "there is no fault to unfault"),
    "no horizon": ((FAULT, []), "no horizon ends at fault 'F1'.*give a horizon with a piece on either side"),
    "a horizon as fault": ((HORIZON, HORIZON), "expected a fault, a seiswidgets.Fault, but got a Horizon"),
    "a fault as horizon": ((FAULT, FAULT), "expected a horizon, a seiswidgets.Horizon, but got a Fault"),
    "a fault above": (
        (fault((700, -500), (800, -50)), HORIZON),
        "fault 'F2' lies outside the section, which reaches from x=0 to 1500 m and from z=0 to 1000 m; leave it out",
    ),
    "a horizon beside": (
        (FAULT, horizon([(1600, 500), (1501, 500)])),
        "horizon 'H2' lies outside the section, which reaches from x=0",
    ),
    "short": (
        (fault((700, 300), (750, 350)), HORIZON),
        "fault 'F2' near x=700 m, z=300 m is no longer than three traces and samples, too short to restore; draw more",
    ),
    "one side": (
        (FAULT, horizon(LEFT)),
        "'H2' reaches fault 'F1' in its footwall near x=780 m, z=400 m, but not in its hanging wall; draw a piece",
    ),
    "the other side": ((FAULT, horizon(RIGHT)), "in its hanging wall near x=800 m, z=500 m, but not in its footwall"),
    "too far": (
        (FAULT, horizon(LEFT, [(1400, 500), (1500, 500)])),
        "fault 'F1'.*piece 2 ends 600 m away from the fault, too far to be extended to it; draw it closer",
    ),
    "both too far": (
        (FAULT, horizon([(0, 400), (270, 400)], [(1310, 500), (1500, 500)])),
        "no horizon ends at fault 'F1' on both sides.*nearest is piece 1 of horizon 'H2', 500 m away",
    ),
    "along the border": (
        (fault((0, 0), (0, 1000)), horizon([(0, 400), (780, 400)])),
        "horizon 'H2' reaches fault 'F2' in its hanging wall",
    ),
}
CARRIED = {  # picks to unfault, and the finding about the one that only moves with the rock
    "twice the same": (
        ([FAULT, FAULT], HORIZON),
        r"'F1' and 'F1 \(2\)' lie on top of each other near x=800 m, z=500 m",
    ),
    "two close by": (
        ([FAULT, fault((702, 0), (902, 1000))], HORIZON),
        "faults 'F1' and 'F2' lie on top of each other near x=80. m, z=500 m.*keep one, or move them apart",
    ),
    "two in part": (
        ([FAULT, fault((700, 0), (800, 500), (1000, 1000))], HORIZON),
        "no horizon ends at fault 'F2' on both sides",
    ),
    "two on one side": (
        (FAULT, horizon(LEFT, [(0, 600), (820, 600)], RIGHT)),
        "pieces 1 and 2 of horizon 'H2' reach fault 'F1' in its footwall, the second near x=820 m, z=600 m, and fewer",
    ),
    "one twice on one side": (
        (FAULT, horizon([(780, 400), (300, 400), (300, 600), (820, 600)], RIGHT)),
        "both ends of piece 1 of horizon 'H2' reach fault 'F1' in its footwall",
    ),
    "a horizon beside": (
        (FAULT, [HORIZON, horizon([(1600, 500), (1501, 500)])]),
        "horizon 'H2' lies outside the section, which reaches from x=0",
    ),
    "short": (
        ([FAULT, fault((300, 300), (350, 350))], HORIZON),
        "fault 'F2' .* is no longer than three traces",
    ),
    "no horizon": (([FAULT, fault((1100, 0), (1200, 450))], HORIZON), "no horizon ends at fault 'F2' on both sides"),
    "one side": (
        (FAULT, [HORIZON, horizon([(0, 600), (820, 600)])]),
        "'H2' reaches fault 'F1' in its footwall near x=820",
    ),
    "contradiction": (
        (FAULT, [HORIZON, horizon([(0, 300), (760, 300)], [(820, 600), (1500, 600)])]),
        "horizon 'H2' contradicts horizon 'H1' at fault 'F1', near x=820 m, z=600 m: it lies above the other one",
    ),
}
FIXED = {
    "outside": ((-100, 100), r"fixed lies outside the section, at \(-100 m, 100 m\)"),
    "NaN": ((np.nan, 100), "fixed lies outside the section"),
    "a number": (3, r"fixed must be one point \(x, z\), but is 3"),
    "a word": ("left", "fixed must be one point"),
    "two points": ([(1, 2), (3, 4)], "fixed must be one point"),
}
SETTINGS = {
    "solver": ({"solver": "newton"}, "solver must be 'gauss-newton' or 'fixed-point', but is 'newton'"),
    "weighting": ({"weighting": "eq. 14"}, "weighting must be 'norms' or 'rows', but is 'eq. 14'"),
    "no iterations": ({"max_iterations": 0}, "max_iterations must be a whole number of 1 or more, but is 0"),
    "fewer": ({"max_iterations": -3}, "max_iterations must be"),
    "half an iteration": ({"max_iterations": 2.5}, "max_iterations must be"),
    "a word": ({"max_iterations": "many"}, "max_iterations must be"),
    "weights": ({"weights": {"edge": 1}}, "weights must be a seiswidgets.Weights, but is {'edge': 1}"),
}


@pytest.fixture(scope="module")
def start():
    return sw.Restoration(SECTION, spacing=SPACING)


@pytest.fixture(scope="module")
def unfaulted(start):
    return start.unfault(FAULT, HORIZON, fixed=(100, 100))


def raises_and_changes_nothing(restoration, error, message, work):
    stages, vertices = restoration.stages, [stage.vertices.copy() for stage in restoration.stages]
    with pytest.raises(error, match=message):
        work(restoration)
    assert restoration.stages is stages
    for stage, before in zip(restoration.stages, vertices, strict=True):
        np.testing.assert_array_equal(stage.vertices, before)
    again = restoration.flatten(HORIZON, max_iterations=1)
    assert [stage.kind for stage in again.stages] == [*(stage.kind for stage in stages), "flatten"]


@pytest.mark.parametrize(("picks", "message"), UNFAULTED.values(), ids=UNFAULTED)
def test_picks(start, picks, message):
    raises_and_changes_nothing(start, sw.PickError, message, lambda restoration: restoration.unfault(*picks))


@pytest.mark.parametrize(("picks", "message"), CARRIED.values(), ids=CARRIED)
def test_a_pick_that_cannot_be_used_is_carried(start, picks, message):
    restored = start.unfault(*picks, fixed=(100, 100))
    (finding,) = (finding for finding in restored.findings if finding.text.endswith("only carried along)"))
    assert re.search(message, finding.text)
    assert finding.pick in ("F2", "H2", "F1 (2)")
    assert finding.severity == {"contradiction": "problem", "one-sided": "note"}.get(finding.kind, "warning")
    assert restored.settled
    assert restored.stages[-1].report.picks == ("F1",)
    assert all(cutoff.throw == pytest.approx(100) for cutoff in restored.stages[-1].report.cutoffs)


@pytest.mark.parametrize("use", ["carry", "ignore"])
def test_a_pick_that_is_not_to_be_used_constrains_nothing(start, unfaulted, use):
    other = sw.Fault([(300, 0), (500, 1000)], name="F2", use=use)
    crossing = sw.Horizon([(0, 700), (840, 700)], [(800, 500), (1500, 500)], name="H2", use=use)
    restored = start.unfault([FAULT, other], [HORIZON, crossing], fixed=(100, 100))
    np.testing.assert_array_equal(restored.stages[-1].vertices, unfaulted.stages[-1].vertices)
    assert restored.findings == unfaulted.findings
    with pytest.raises(sw.PickError, match="set the use of one to 'constrain'"):
        start.unfault(other, HORIZON)
    with pytest.raises(sw.SettingError, match="the use of 'F2' must be one of constrain, carry, ignore, but is 'cut'"):
        sw.Fault(other.points, name="F2", use="cut")


BAD_DRAWINGS = {  # picks to unfault, the pick that the error is about, and the position if the text names one
    "a fault above": ((fault((700, -500), (800, -50)), HORIZON), "F2", (700, -500)),
    "a horizon beside": ((FAULT, horizon([(1600, 500), (1501, 500)])), "H2", (1600, 500)),
    "short": ((fault((700, 300), (750, 350)), HORIZON), "F2", (700, 300)),
    "a spike": ((fault((700, 0), (800, 500), (710, 10)), HORIZON), "F2", (800, 500)),
    "no horizon": (([FAULT], []), "F1", None),
    "out of reach": ((FAULT, horizon([(0, 400), (270, 400)], [(1310, 500), (1500, 500)])), "F1", None),
    "one side": ((FAULT, horizon(LEFT)), "F1", (780, 400)),
    "too far": ((FAULT, horizon(LEFT, [(1400, 500), (1500, 500)])), "F1", (780, 400)),
}


@pytest.mark.parametrize(("drawing", "pick", "where"), BAD_DRAWINGS.values(), ids=BAD_DRAWINGS)
def test_an_error_carries_the_pick_and_the_position_that_it_is_about(start, drawing, pick, where):
    faults, horizons, *fixed = drawing
    with pytest.raises(sw.PickError, match=pick or "fixed") as raised:
        start.unfault(faults, horizons, fixed=fixed[0] if fixed else None)
    assert raised.value.pick == pick
    assert raised.value.where == (where if where is None else pytest.approx(where, abs=1))


def test_positions_of_errors_are_in_the_units_of_a_time_section():
    with pytest.raises(sw.PickError, match="z=320 ms") as raised:
        sw.Restoration(TIME, spacing=SPACING).unfault(TIME_FAULT, sw.Horizon(TIMES[0], name="H2"))
    assert raised.value.where == pytest.approx((780, 320))


@pytest.mark.parametrize(
    ("work", "keyword"),
    [
        (lambda: sw.Section(AMPLITUDE, dx=1, dz=1, z_unit="ms"), "velocity"),
        (lambda: sw.Restoration(SECTION, spacing=0.5).flatten(HORIZON), "spacing"),
        (lambda: sw.Restoration(SECTION, spacing=400).flatten(sw.Horizon([(0, 400), (1500, 400)])), "spacing"),
    ],
)
def test_keywords_that_an_error_advises_are_parts_of_its_text(work, keyword):
    with pytest.raises(sw.SeiswidgetsError, match=f"{keyword}=") as raised:
        work()
    assert keyword in [part.name for part in raised.value.text.parts if isinstance(part, Keyword)]


@pytest.mark.parametrize("kind", ["unfault", "flatten"])
def test_a_misspelt_option_is_an_error_that_suggests_the_right_one(start, kind):
    picks = (FAULT, HORIZON) if kind == "unfault" else (HORIZON,)
    message = f"{kind} has no keyword max_iteration=; did you mean max_iterations="
    raises_and_changes_nothing(start, TypeError, message, lambda it: getattr(it, kind)(*picks, max_iteration=3))


@pytest.mark.parametrize(("fixed", "message"), FIXED.values(), ids=FIXED)
def test_fixed(start, fixed, message):
    raises_and_changes_nothing(start, sw.PickError, message, lambda it: it.unfault(FAULT, HORIZON, fixed=fixed))


@pytest.mark.parametrize(("settings", "message"), SETTINGS.values(), ids=SETTINGS)
@pytest.mark.parametrize("kind", ["unfault", "flatten"])
def test_settings(start, kind, settings, message):
    picks = (FAULT, HORIZON) if kind == "unfault" else (HORIZON,)
    raises_and_changes_nothing(start, sw.SettingError, message, lambda it: getattr(it, kind)(*picks, **settings))


@pytest.mark.parametrize(
    ("datum", "message"), [(np.nan, "datum must be a finite number, but is nan"), ("deep", "datum .* is 'deep'")]
)
def test_datum(unfaulted, datum, message):
    raises_and_changes_nothing(unfaulted, sw.SettingError, message, lambda it: it.flatten(HORIZON, datum=datum))


@pytest.mark.parametrize(
    ("horizon", "message"),
    [
        (FAULT, "expected a horizon, a seiswidgets.Horizon, but got a Fault"),
        ([HORIZON], "expected a horizon"),
        (
            sw.Horizon([(0, 400), (50, 400)], name="H2"),
            "'H2' is no longer than three traces",
        ),
        (
            sw.Horizon([(0, 400), (0.1, 400)], name="H2"),
            "'H2' is no longer than three traces",
        ),
        (
            sw.Horizon([(0, 1400), (50, 1001)], name="H2"),
            "horizon 'H2' lies outside the section, which reaches from x=0 to 1500 m and from z=0 to 1000 m",
        ),
    ],
)
def test_horizons_that_cannot_be_flattened(unfaulted, horizon, message):
    raises_and_changes_nothing(unfaulted, sw.PickError, message, lambda it: it.flatten(horizon))


@pytest.mark.parametrize("solver", ["gauss-newton", "fixed-point"])
@pytest.mark.parametrize("last", [1, 3])
def test_cancelled(unfaulted, solver, last):
    def progress(iteration, energy, vertices):
        return iteration < last

    folded = sw.Horizon([(0, 700), (400, 600), (800, 700), (1400, 600)])
    work = {"solver": solver, "progress": progress}
    raises_and_changes_nothing(
        unfaulted, sw.Cancelled, f"after iteration {last}", lambda it: it.flatten(folded, **work)
    )


WEIGHTS = ["mean_value", "contour", "edge", "slide", "stitch", "flatten", "length"]
NO_WEIGHTS = [-1, -1e-9, np.nan, np.inf, "1", None, 1j, [1, 2], np.ones(2)]


@pytest.mark.parametrize(
    ("name", "value"), [*((name, -1) for name in WEIGHTS), *(("edge", value) for value in NO_WEIGHTS[1:])], ids=repr
)
def test_weights(name, value):
    with pytest.raises(sw.SettingError, match=f"weight {name} must be a number of 0 or more, but is "):
        sw.Weights(**{name: value})


def test_weights_all_zero():
    with pytest.raises(sw.SettingError, match=r"all weights are 0.*set at least one above 0"):
        sw.Weights(**dict.fromkeys(WEIGHTS, 0))
    assert sw.Weights(**dict.fromkeys(WEIGHTS[1:], 0)).mean_value == 1


@pytest.mark.parametrize(
    ("value", "message"),
    [
        (0, "spacing must be above 0 m, but is 0"),
        (-10, "spacing must be above 0 m"),
        (np.nan, "spacing must be a finite number"),
        ("fine", "spacing must be a finite number, but is 'fine'"),
    ],
)
def test_mesh_spacing(value, message):
    with pytest.raises(sw.SettingError, match=message):
        sw.Restoration(SECTION, spacing=value)


@pytest.mark.parametrize(
    ("spacing", "message"),
    [
        (0.5, r"0.5 m would make about 6,8\d\d,\d\d\d vertices; the limit is 250,000: choose at least 2.6\d\d m"),
        (1e-9, "the limit is 250,000"),
    ],
)
def test_too_fine_meshes(spacing, message):
    restoration = sw.Restoration(SECTION, spacing=spacing)
    for work in (lambda: restoration.unfault(FAULT, HORIZON), lambda: restoration.flatten(HORIZON)):
        with pytest.raises(sw.SettingError, match=message):
            work()
    assert restoration.stages == ()


def test_too_coarse_meshes():
    restoration = sw.Restoration(SECTION, spacing=400)
    with pytest.raises(sw.SettingError, match=r"400 m makes only \d+ vertices; at least 30 .*: reduce spacing="):
        restoration.flatten(sw.Horizon([(0, 400), (1500, 400)]))
    assert restoration.stages == ()


def test_a_restoration_starts_from_a_section():
    with pytest.raises(sw.SettingError, match=r"starts from a seiswidgets\.Section, but got a ndarray"):
        sw.Restoration(AMPLITUDE)


@pytest.mark.parametrize(
    ("picks", "message"),
    [
        (
            (sw.Fault([(700, -50), (900, -20)], name="F2"), TIME_HORIZON),
            "fault 'F2' lies outside the section, .* from x=0 to 1500 m and from z=0 to 800 ms",
        ),
        (
            (TIME_FAULT, sw.Horizon(TIMES[0], name="H2")),
            "'H2' reaches fault 'F1' in its footwall near x=780 m, z=320 ms",
        ),
        ((sw.Fault([(700, 300), (740, 320)], name="F2"), TIME_HORIZON), "fault 'F2' near x=700 m, z=300 ms"),
    ],
)
def test_places_are_named_in_the_units_of_a_time_section(picks, message):
    with pytest.raises(sw.PickError, match=message):
        sw.Restoration(TIME, spacing=SPACING).unfault(*picks)


REPEATED = {
    "the same point": [(0, 0), (0, 0)],
    "the same, and on": [(0, 0), (0, 0), (0.1, 0.3), (0.2, 0.6)],
    "near by": [(0, 0), (0.5, 0.5), (-0.2, 0.3)],
}


@pytest.mark.parametrize(
    ("offsets", "number"),
    [*((offsets, 1) for offsets in REPEATED.values()), (REPEATED["near by"], 0), (REPEATED["near by"], 2)],
)
def test_points_closer_than_a_hundredth_of_the_spacing_are_one(start, offsets, number):
    points = np.array([(700.0, 1.0), (790, 500), (900, 999)])
    crowd = -np.array(offsets)[:0:-1] if number == 2 else np.array(offsets)[1:]
    repeated = np.insert(points, min(number + 1, 2), points[number] + crowd, axis=0)
    once, again = (start.unfault(sw.Fault(line), HORIZON, fixed=(100, 100)).stages[-1] for line in (points, repeated))
    np.testing.assert_array_equal(again.mesh.vertices, once.mesh.vertices)
    np.testing.assert_array_equal(again.vertices, once.vertices)


def test_a_horizon_with_repeated_points(start):
    pieces = [(0, 400), (390, 420), (780, 400)], RIGHT
    repeated = [(0, 400), (0, 400), (390, 420), (390, 420), (390, 420), (780, 400), (780, 400)], RIGHT
    once, again = (
        start.unfault(FAULT, sw.Horizon(*lines), fixed=(100, 100)).stages[-1] for lines in (pieces, repeated)
    )
    np.testing.assert_allclose(again.vertices, once.vertices, atol=1e-6)


def test_a_long_line_is_told_where_it_first_meets_itself():
    """Against all pairs of segments, one after the other."""
    rng = np.random.default_rng(4)
    for size in (40, 200, 400):
        line = rng.normal(size=(size, 2)).cumsum(axis=0)
        segments = [LineString(pair) for pair in pairwise(line)]
        first = next(
            later.intersection(earlier)
            for number, later in enumerate(segments)
            for earlier in segments[: max(0, number - 1)]
            if later.intersects(earlier)
        )
        assert f"near x={first.x:g}, z={first.y:g}" in str(sw.Fault(line, "F1").flaw)


def test_a_very_long_line_is_told_so_soon():
    x = np.arange(50_000.0)
    line = np.column_stack([x, np.sin(x / 50)])
    line[-1] = line[-5] + (0.3, 1.0)  # back over itself at its very end
    line[-2] = line[-5] + (0.3, -1.0)
    assert "crosses itself near x=49995" in str(sw.Fault(line, "F1").flaw)
