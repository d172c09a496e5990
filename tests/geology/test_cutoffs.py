"""Cut-offs, throw and heave are those of the network, however unsteadily it was drawn."""

import itertools

import numpy as np
import pytest
from shapely import LineString

import seiswidgets as sw
from seiswidgets.geology.cutoffs import PickNetwork
from seiswidgets.geology.segments import hanging_side, horizon_segments, split_at_faults

TOP, DIP = (1000.0, 0.0), 60.0  # a fault that dips to the right
ALONG = np.array([np.cos(np.radians(DIP)), np.sin(np.radians(DIP))])
WIDTH, DEPTH = 3000.0, 1000.0


def on_fault(z):
    return TOP[0] + z / np.tan(np.radians(DIP))


def fault(mirrored=False, upwards=False, points=2):
    line = np.column_stack([on_fault(z := np.linspace(0, DEPTH, points)), z])
    return sw.Fault(seen(line[::-1] if upwards else line, mirrored), name="F")


def seen(points, mirrored):
    points = np.array(points, float)
    return (WIDTH, 0) + points * (-1, 1) if mirrored else points


def horizon(throw, mirrored=False, level=400.0, shift=(0.0, 0.0), dip=0.0):
    """Two pieces at a fault, the right one, in its hanging wall, lower by a throw; their ends moved."""
    slope = np.tan(np.radians(dip))
    left, right = on_fault(level), on_fault(level + throw)
    pieces = [
        [(x, level + slope * (x - left)) for x in (0, left + shift[0])],
        [(x, level + throw + slope * (x - right)) for x in (right + shift[1], WIDTH)],
    ]
    return sw.Horizon(*(seen(piece, mirrored) for piece in pieces), name="H")


MIRRORED = pytest.mark.parametrize("mirrored", [False, True], ids=["dips right", "dips left"])
NORMAL_AND_REVERSE = pytest.mark.parametrize("throw", [300.0, -100.0])


@pytest.mark.parametrize("throw", [1.0, 300.0, -100.0])
@MIRRORED
@pytest.mark.parametrize(("upwards", "points"), [(False, 7), (True, 2)], ids=["drawn down", "drawn up"])
def test_throw_and_heave(throw, mirrored, upwards, points):
    drawn, bed = fault(mirrored, upwards, points), horizon(throw, mirrored)
    assert sw.throw(drawn, bed) == pytest.approx(throw)
    assert sw.heave(drawn, bed) == pytest.approx(throw / np.tan(np.radians(DIP)))


@NORMAL_AND_REVERSE
@MIRRORED
def test_pieces_in_any_order_and_direction(throw, mirrored):
    pieces = horizon(throw, mirrored).pieces
    for order, *turned in itertools.product([1, -1], [1, -1], [1, -1]):
        bed = sw.Horizon(*(piece[::way] for piece, way in zip(pieces[::order], turned, strict=True)))
        assert sw.throw(fault(mirrored), bed) == pytest.approx(throw)
        assert sw.heave(fault(mirrored), bed) == pytest.approx(throw / np.tan(np.radians(DIP)))


@pytest.mark.parametrize(("throw", "mirrored"), [(1.0, False), (300.0, True), (-1.0, True), (-300.0, False)])
@pytest.mark.parametrize(
    "shift", [(-200, 250), (-50, 0), (0, 1e-9), (-1e-7, -1e-7), (1e-9, -1e-6), (60, -40), (-60, -40)]
)
def test_ends_that_stop_short_are_extended_and_overshoots_trimmed(throw, mirrored, shift):
    assert sw.throw(fault(mirrored), horizon(throw, mirrored, shift=shift)) == pytest.approx(throw, abs=1e-5)


@NORMAL_AND_REVERSE
@pytest.mark.parametrize("dip", [-20, 20])
def test_dipping_beds_are_extended_along_their_dip(throw, dip):
    exact, short = (horizon(throw, shift=shift, dip=dip) for shift in ((0, 0), (-150, 150)))
    assert sw.throw(fault(), short) == pytest.approx(sw.throw(fault(), exact)) == pytest.approx(throw)


@NORMAL_AND_REVERSE
@MIRRORED
def test_a_bent_piece_is_extended_along_its_last_tenth(throw, mirrored):
    left, right = on_fault(400), on_fault(400 + throw)
    footwall = [(0, 100), (left - 300, 400), (left - 60, 400)]
    hanging_wall = [(right + 60, 400 + throw), (right + 400, 400 + throw), (WIDTH, 600 + throw)]
    bed = sw.Horizon(*(seen(piece, mirrored) for piece in (footwall, hanging_wall)))
    assert sw.throw(fault(mirrored), bed) == pytest.approx(throw)
    assert sw.throw(fault(mirrored), sw.Horizon(*(piece[::-1] for piece in bed.pieces))) == pytest.approx(throw)


def test_a_piece_is_extended_by_a_fifth_of_its_length_at_most():
    end = on_fault(400)
    length = end / 1.2  # of a piece that ends where a fifth of it takes it just to the fault
    right = horizon(100).pieces[1]
    assert sw.throw(fault(), sw.Horizon([(0, 400), (length + 0.1, 400)], right)) == pytest.approx(100)
    with pytest.raises(
        sw.PickError, match=r"piece 1 ends .* away from the fault, too far to be extended to it; draw it closer"
    ):
        sw.throw(fault(), sw.Horizon([(0, 400), (length - 0.1, 400)], right))


@MIRRORED
def test_a_piece_across_a_fault_has_not_slipped(mirrored):
    across = sw.Horizon(seen([(0, 400), (WIDTH, 450)], mirrored))
    assert sw.throw(fault(mirrored), across) == pytest.approx(0, abs=1e-9)
    assert sw.heave(fault(mirrored), across) == pytest.approx(0, abs=1e-9)
    assert (
        len(horizon_segments([LineString(piece) for piece in across.pieces], [LineString(fault(mirrored).points)])) == 2
    )


@pytest.mark.parametrize("z_unit", ["m", "ms"])
@pytest.mark.parametrize("scale", [1e-3, 1.0, 1e5])
def test_throw_does_not_depend_on_the_scale_of_the_drawing(scale, z_unit):
    axes = np.array([scale, scale * (0.8 if z_unit == "ms" else 1)])
    drawn = sw.Fault(fault().points * axes)
    bed = sw.Horizon(*(piece * axes for piece in horizon(100, shift=(-100, 40)).pieces))
    assert sw.throw(drawn, bed) == pytest.approx(100 * axes[1])
    assert sw.heave(drawn, bed) == pytest.approx(100 * axes[0] / np.tan(np.radians(DIP)))


@pytest.mark.parametrize("turn", [0, 180])
def test_the_hanging_wall_lies_above_the_fault(turn):
    for dip in range(5, 180, 10):
        along = np.array([np.cos(np.radians(dip)), np.sin(np.radians(dip))])
        line = LineString([-100 * along, 100 * along][:: -1 if turn else 1])
        assert hanging_side(line, (0, 0), (0.0, -10)) == (1 if dip != 90 else -1) or dip == 90
        assert hanging_side(line, (0, 0), (0.0, 10)) == -1 or dip == 90
    upright = LineString([(0, 0), (0, 100)][:: -1 if turn else 1])
    assert [hanging_side(upright, (0, 50), (x, 50)) for x in (1, -1)] == [1, -1]


@pytest.mark.parametrize("turn", [1, -1])
def test_a_fault_that_is_overturned_in_part_keeps_its_hanging_wall(turn):
    """It dips to the right as a whole, but to the left in its middle, where the bed meets it."""
    line = [(1000, 0), (1200, 300), (1150, 700), (1300, 1000)][::turn]
    bed = sw.Horizon([(0, 450), (1181.25, 450)], [(1168.75, 550), (3000, 550)])
    assert sw.throw(sw.Fault(line), bed) == pytest.approx(100)
    high = sw.Horizon([(0, 290), (1190, 290)], [(1199, 390), (3000, 390)])  # one cut-off above the bend, one below
    assert sw.throw(sw.Fault(line), high) == pytest.approx(100, abs=1)


def network(faults, *pieces):
    faults = {name: LineString(line) for name, line in faults.items()}
    lines = [LineString(piece) for piece in pieces]
    return PickNetwork(faults, {"H": horizon_segments(lines, list(faults.values()))}, str)


GRABEN = {"left": [(800, 0), (1200, 1000)], "right": [(2200, 0), (1800, 1000)]}
BEDS = [[(0, 400), (960, 400)], [(1000, 500), (2000, 500)], [(2040, 400), (3000, 400)]]


@pytest.mark.parametrize("order", [(0, 1, 2), (1, 2, 0), (2, 1, 0)])
@pytest.mark.parametrize("middle", [(1000, 2000), (1050, 1950), (990, 2010)], ids=["exact", "short", "over"])
def test_the_middle_of_a_graben_serves_both_faults(order, middle):
    pieces = [BEDS[0], [(x, 500) for x in middle], BEDS[2]]
    found = network(GRABEN, *(pieces[index] for index in order))
    pairs = {pair.fault: pair for pair in found.cutoffs()}
    assert set(pairs) == {"left", "right"}
    for name, places in {"left": [(1000, 500), (960, 400)], "right": [(2000, 500), (2040, 400)]}.items():
        for (index, place), point in zip((pairs[name].hanging_wall, pairs[name].footwall), places, strict=True):
            part = found.horizons["H"][index]
            np.testing.assert_allclose(part.line.coords[place], point)
            np.testing.assert_allclose(part.ends[place].point, point)


def test_a_horizon_beyond_a_blind_tip_is_left_alone():
    blind = {"F": [(1400, 450), (1600, 900)]}
    above = [(0, 400), (3000, 400)]
    found = network(blind, above, [(0, 600), (1466, 600)], [(1490, 650), (3000, 650)])
    (pair,) = found.cutoffs()
    assert (pair.hanging_wall[0], pair.footwall[0]) == (2, 1)
    whole = found.horizons["H"][0]
    assert whole.ends == (None, None)
    np.testing.assert_array_equal(whole.line.coords, above)


def test_an_overshoot_counts_where_no_other_piece_lies():
    """A bed drawn across a fault by a little, with nothing beyond it: its short end is the other side's piece."""
    over = [(0, 400), (on_fault(400) + 60, 400)]
    line = [LineString(fault().points)]
    assert len(horizon_segments([LineString(over)], line)) == 2
    assert len(horizon_segments([LineString(over), LineString([(1400, 500), (3000, 500)])], line)) == 2
    assert sw.throw(fault(), sw.Horizon(over)) == pytest.approx(0, abs=1e-9)
    assert sw.throw(fault(), sw.Horizon(over, horizon(100).pieces[1])) == pytest.approx(100)


def test_a_piece_across_several_faults_is_split_at_each():
    lines = [LineString(line) for line in GRABEN.values()]
    found = split_at_faults(LineString([(3000, 400), (0, 400)]), lines, piece=7)
    assert [part.line.length for part in found] == pytest.approx([960, 1080, 960])
    assert [tuple(end and (end.fault, end.side) for end in part.ends) for part in found] == [
        (None, (1, -1)),
        ((1, 1), (0, 1)),
        ((0, -1), None),
    ]
    assert {part.piece for part in found} == {7}


def test_the_drawing_and_the_report_agree():
    section = sw.Section(np.ones((51, 61), np.float32), dx=50, dz=16, z_unit="ms", velocity=2500)
    axes = np.array([1, 0.8])
    drawn = sw.Fault(fault().points * axes)
    bed = sw.Horizon(*(piece * axes for piece in horizon(100, shift=(-100, 40)).pieces))
    (found,) = sw.Restoration(section, spacing=150).unfault(drawn, bed).stages[0].report.cutoffs
    assert found.throw == pytest.approx(sw.throw(drawn, bed)) == pytest.approx(80)
    assert found.heave == pytest.approx(sw.heave(drawn, bed))


def at_depth(*depths):
    return [(float(on_fault(z)), z) for z in depths]


def overturned(slip, reverse=1):
    """A bed folded about the fault: it meets the fault at 300 and at 700 m, and slip moves the hanging wall down."""
    upper, lower, upper_moved, lower_moved = at_depth(300, 700, 300 + slip, 700 + slip)
    return sw.Horizon(
        [(0, 300), upper][::reverse],
        [upper_moved, (upper_moved[0] + 500, 500 + slip), lower_moved][::reverse],
        [(0, 700), lower],
        name="H",
    )


@pytest.mark.parametrize("slip", [100.0, -80.0, 250.0])
@pytest.mark.parametrize(("mirrored", "upwards"), [(False, False), (True, True)])
def test_a_fault_that_cuts_a_bed_twice_has_a_pair_at_each_place(slip, mirrored, upwards):
    bed = sw.Horizon(*(seen(piece, mirrored) for piece in overturned(slip, -1 if mirrored else 1).pieces), name="H")
    drawn = fault(mirrored, upwards)
    found = sorted(sw.cutoffs(drawn, bed), key=lambda cutoff: cutoff.footwall[1])
    assert [cutoff.footwall[1] for cutoff in found] == pytest.approx([300, 700])
    assert [cutoff.hanging_wall[1] for cutoff in found] == pytest.approx([300 + slip, 700 + slip])
    assert [cutoff.throw for cutoff in found] == pytest.approx([slip, slip])
    assert [cutoff.heave for cutoff in found] == pytest.approx([slip / np.tan(np.radians(DIP))] * 2)
    for measure in (sw.throw, sw.heave):
        with pytest.raises(sw.PickError, match=r"at 2 places, near .* take one of cutoffs\(fault, horizon\)"):
            measure(drawn, bed)


def test_an_end_without_a_partner_is_the_one_that_lies_farthest_from_all():
    """Two of three ends in the hanging wall belong to the two in the footwall."""
    ends = [350.0, 500.0, 750.0]
    pieces = [np.array([point, (WIDTH, point[1])]) for point in at_depth(*ends)]
    bed = network({"F": fault().points}, *pieces, [(0, 300), at_depth(300)[0]], [(0, 700), at_depth(700)[0]])
    assert bed.places("F", "H") == [((0, 0), (3, -1)), ((1, 0), None), ((2, 0), (4, -1))]
