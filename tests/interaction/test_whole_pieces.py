"""Whole pieces are selected, moved, slid, copied, joined, split, reversed and extended, and each edit can be undone."""

import numpy as np
import pytest
from shapely import LineString, Point

import seiswidgets as sw
from seiswidgets.interaction.gestures import Move, Press, Release
from seiswidgets.interaction.projection import PaneProjection
from seiswidgets.interaction.scene import strokes
from seiswidgets.interaction.viewport import Viewport
from tests.interaction.test_editor import (  # noqa: F401
    ACROSS,
    CTRL,
    FAULT,
    LEFT,
    PLAIN,
    RIGHT,
    SHIFT,
    VIEW,
    click,
    drag,
    drawn,
    editor_of,
    keys,
    move,
    pieces,
    press,
)

ALT = frozenset({"alt"})


def moved(points, dx, dz):
    return tuple((x + dx, z + dz) for x, z in points)


def is_moved(piece, points, dx, dz, at_fault):
    """A piece has moved, but its end at the fault stays on that, in the direction of its last stretch."""
    inner, end = (slice(1, None), 0) if at_fault == 0 else (slice(-1), -1)
    np.testing.assert_allclose(piece[inner], moved(points, dx, dz)[inner])
    assert LineString(FAULT).distance(Point(piece[end])) < 1e-9
    before, after = (np.subtract(line[end], line[1 if end == 0 else -2]) for line in (points, piece))
    assert np.cross([*before, 0], [*after, 0])[2] == pytest.approx(0, abs=1e-6)


def undo_is_named(editor, label, before):
    assert editor.history.next_undo.label == label
    editor.undo()
    assert editor.drawing == before


def chosen(editor):
    return [(piece.name, piece.piece) for piece in editor.state.chosen_pieces]


def test_a_dragged_piece_moves_as_a_whole_and_with_ctrl_the_whole_line(drawn):  # noqa: F811
    before = drawn.drawing
    drawn.enter("move")
    drag(drawn, LEFT[1], (260.0, 300.0))
    assert pieces(drawn, "H1", "horizon") == (moved(LEFT, 10, 40), tuple(RIGHT))
    undo_is_named(drawn, "move a piece of H1", before)
    press(drawn, LEFT[1], CTRL)
    move(drawn, (260.0, 300.0))
    drawn.settle()
    assert pieces(drawn, "H1", "horizon") == (moved(LEFT, 10, 40), moved(RIGHT, 10, 40)[:1] + ((860.0, 430.0),))
    undo_is_named(drawn, "move H1", before)


def test_alt_moves_a_piece_in_the_other_modes_and_escape_takes_it_back(drawn):  # noqa: F811
    for mode in ("look", "fault", "horizon"):
        drawn.enter(mode)
        before = drawn.drawing
        press(drawn, ACROSS[0], ALT)
        move(drawn, (100.0, 500.0))
        assert pieces(drawn, "H2", "horizon") == (moved(ACROSS, 0, 50),)
        keys(drawn, "Escape")
        assert drawn.drawing == before


@pytest.mark.parametrize("horizon", ["H1", "H2"])
def test_a_piece_slides_by_its_cutoff_which_stays_on_the_fault(drawn, horizon):  # noqa: F811
    """H1 ends at the fault, H2 crosses it and is cut there."""
    before = drawn.drawing
    drawn.enter("move")
    handle = next(mark for mark in drawn.cutoffs() if mark.horizon == horizon and mark.wall == "hanging wall")
    drag(drawn, handle.inside, (440.0, 330.0), (442.0, 340.0))
    after = pieces(drawn, horizon, "horizon")
    (slid,) = (piece for piece in after if piece not in before.pick("horizon", horizon).pieces and piece[-1][0] > 600)
    assert LineString(FAULT).distance(Point(slid[0])) < 1e-9
    assert slid[0][1] == pytest.approx(LineString(FAULT).interpolate(LineString(FAULT).project(Point(442, 340))).y)
    np.testing.assert_allclose(
        np.diff(slid, axis=0)[0, 1], RIGHT[1][1] - RIGHT[0][1] if horizon == "H1" else 5.0, atol=2
    )
    undo_is_named(drawn, f"slide {horizon} along F1", before)


def test_selected_pieces_that_end_at_the_fault_slide_together(drawn):  # noqa: F811
    lower = [(480.0, 420.0), (800.0, 440.0)]
    horizons = [sw.Horizon(LEFT, RIGHT, name="H1"), sw.Horizon(lower, name="H2")]
    drawn.load(sw.Interpretation([sw.Fault(FAULT, "F1")], horizons))
    drawn.enter("move")
    click(drawn, RIGHT[1])
    click(drawn, lower[1], SHIFT)
    drag(drawn, (471.0, 381.0), (481.0, 421.0))
    np.testing.assert_allclose(pieces(drawn, "H1", "horizon")[1], moved(RIGHT, 10, 40), atol=2.0)
    np.testing.assert_allclose(pieces(drawn, "H2", "horizon")[0], moved(lower, 10, 40), atol=2.0)
    assert pieces(drawn, "H1", "horizon")[0] == tuple(LEFT)
    assert drawn.history.next_undo.label == "slide 2 pieces along F1"


def test_the_keyboard_selects_moves_slides_and_deletes_pieces(drawn):  # noqa: F811
    before = drawn.drawing
    keys(drawn, "m", "PageDown", "PageDown")
    assert chosen(drawn) == [("H1", 0)]
    keys(drawn, "ArrowDown", modifiers=SHIFT)
    is_moved(pieces(drawn, "H1", "horizon")[0], LEFT, 0, 100, -1)
    undo_is_named(drawn, "move a piece of H1", before)
    keys(drawn, "PageDown")
    keys(drawn, "ArrowUp", modifiers=CTRL)
    first, last = pieces(drawn, "H1", "horizon")[1]
    assert LineString(FAULT).distance(Point(first)) < 1e-9
    assert np.subtract(last, RIGHT[1]) == pytest.approx(np.array([-10.0, -40.0]) / np.hypot(1, 4), rel=1e-6)
    undo_is_named(drawn, "slide H1 along F1", before)
    keys(drawn, "Delete")
    assert pieces(drawn, "H1", "horizon") == (tuple(LEFT),)
    undo_is_named(drawn, "delete a piece of H1", before)


def test_several_are_selected_by_shift_or_a_rectangle_and_moved_or_deleted_together(drawn):  # noqa: F811
    before = drawn.drawing
    drawn.enter("look")
    click(drawn, LEFT[1])
    click(drawn, ACROSS[0], SHIFT)
    assert chosen(drawn) == [("H1", 0), ("H2", 0)]
    drawn.enter("move")
    click(drawn, (10.0, 20.0))
    assert chosen(drawn) == []
    drag(drawn, (20.0, 200.0), (400.0, 300.0), (895.0, 470.0))
    assert chosen(drawn) == [("H1", 0), ("H1", 1), ("H2", 0)]
    click(drawn, LEFT[1], SHIFT)
    assert chosen(drawn) == [("H1", 1), ("H2", 0)]
    drag(drawn, ACROSS[0], (100.0, 460.0))
    is_moved(pieces(drawn, "H1", "horizon")[1], RIGHT, 0, 10, 0)
    undo_is_named(drawn, "move 2 pieces", before)
    drag(drawn, (20.0, 200.0), (895.0, 470.0))
    keys(drawn, "Delete")
    assert drawn.drawing.names("horizon") == ()
    undo_is_named(drawn, "delete 3 pieces", before)


def test_the_rectangle_is_drawn_in_its_pane_only(drawn):  # noqa: F811
    drawn.enter("move")
    count = len(strokes(drawn.state, PLAIN))
    press(drawn, (20.0, 200.0))
    move(drawn, (300.0, 300.0))
    assert len(strokes(drawn.state, PLAIN)) == count + 1
    assert len(strokes(drawn.state, PaneProjection(VIEW, sw.Restoration(VIEW.section)))) == count


def test_a_horizon_is_copied_and_the_copy_can_be_moved_at_once(drawn):  # noqa: F811
    before = drawn.drawing
    drawn.select("horizon", "H1")
    keys(drawn, "c")
    for piece, points, at_fault in zip(pieces(drawn, "H3", "horizon"), (LEFT, RIGHT), (-1, 0), strict=True):
        is_moved(piece, points, 0, 40, at_fault)
    assert (drawn.state.mode, chosen(drawn)) == ("move", [("H3", 0), ("H3", 1)])
    undo_is_named(drawn, "copy H1 down", before)
    drawn.select("horizon", "H1")
    keys(drawn, "C")
    assert pieces(drawn, "H3", "horizon")[0][0] == (50.0, 210.0)


def test_pieces_and_faults_are_joined_by_their_nearest_ends(drawn):  # noqa: F811
    before = drawn.drawing
    drawn.enter("look")
    click(drawn, RIGHT[1])
    keys(drawn, "j")
    (joined,) = pieces(drawn, "H1", "horizon")
    assert joined in ((*LEFT, *RIGHT), (*RIGHT[::-1], *LEFT[::-1]))
    undo_is_named(drawn, "join pieces of H1", before)
    below = sw.Fault([(560.0, 590.0), (500.0, 500.0)], "F2", ends=("extend", "tip"))
    faults = [sw.Fault(FAULT, "F1", ends=("tip", "auto")), below]
    editor = editor_of(VIEW, sw.Interpretation(faults))
    click(editor, FAULT[1])
    click(editor, (530.0, 545.0), SHIFT)
    keys(editor, "j")
    (fault,) = editor.interpretation.faults
    np.testing.assert_array_equal(fault.points, [*FAULT, (560.0, 590.0)])
    assert fault.ends == ("tip", "extend")
    with pytest.raises(sw.PickError, match="two pieces of horizons, or two faults"):
        keys(editor, "j")


def test_a_line_is_split_at_a_vertex_and_a_fault_becomes_two(drawn):  # noqa: F811
    before = drawn.drawing
    drawn.enter("horizon")
    click(drawn, LEFT[1])
    keys(drawn, "x")
    assert pieces(drawn, "H1", "horizon") == (tuple(LEFT[:2]), tuple(LEFT[1:]), tuple(RIGHT))
    undo_is_named(drawn, "split H1", before)
    drawn.enter("fault")
    click(drawn, FAULT[1])
    keys(drawn, "x")
    assert [fault.points.tolist() for fault in drawn.interpretation.faults] == [
        [list(FAULT[0]), list(FAULT[1])],
        [list(FAULT[1]), list(FAULT[2])],
    ]
    drawn.undo()
    click(drawn, FAULT[0])
    with pytest.raises(sw.PickError, match="between the ends"):
        keys(drawn, "x")


def test_reversing_a_fault_turns_its_ends_too():
    editor = editor_of(VIEW, sw.Interpretation([sw.Fault(FAULT, "F1", ends=("tip", "extend"))]))
    editor.select("fault", "F1")
    keys(editor, "r")
    assert pieces(editor) == (tuple(FAULT[::-1]),)
    assert editor.interpretation.faults[0].ends == ("extend", "tip")
    assert editor.history.next_undo.label == "reverse F1"


def test_lines_are_extended_to_the_first_fault_and_the_border():
    short = [(200.0, 300.0), (300.0, 300.0)]
    editor = editor_of(VIEW, sw.Interpretation([sw.Fault(FAULT, "F1")], [sw.Horizon(short, name="H1")]))
    editor.select("horizon", "H1")
    keys(editor, "e")
    np.testing.assert_allclose(pieces(editor, "H1", "horizon")[0], [(0, 300), *short, (450, 300)])
    assert editor.history.next_undo.label == "extend H1 to the border, F1"
    with pytest.raises(sw.PickError, match="already"):
        keys(editor, "e")
    editor.undo()
    editor.enter("horizon")
    click(editor, short[1])
    keys(editor, "e")  # this end only
    np.testing.assert_allclose(pieces(editor, "H1", "horizon")[0], [*short, (450, 300)])
    editor.select("fault", "F1")
    keys(editor, "e")
    np.testing.assert_allclose(pieces(editor)[0], [(375, 0), *FAULT, (525, 600)])


def test_a_piece_moved_in_the_restored_pane_is_carried_back_and_stays_in_its_block():
    """The hanging wall only slid: a move there is the same move today; what crosses the fault is cut off."""
    case = sw.synthetic.planar_fault()
    picks, pick = case.interpretation, case.interpretation.horizons[0]
    restored = sw.Restoration(case.section, 80.0).unfault(picks.faults, picks.horizons, fixed=case.fixed)
    view = Viewport(restored.section, 800, 600)
    projection, editor = PaneProjection(view, restored), editor_of(Viewport(case.section, 800, 600), picks)
    line = LineString(picks.faults[0].points)
    for index, piece in enumerate(pick.pieces):
        at_fault = min((0, -1), key=lambda end: line.distance(Point(piece[end])))
        towards = 1 if piece[at_fault][0] > piece[at_fault - 1 if at_fault else 1][0] else -1
        start = projection.to_pixels(piece[len(piece) // 2 : len(piece) // 2 + 1])[0]
        shift = np.array([20.0 * towards, 6.0])
        editor.enter("move")
        for gesture, pixel in ((Press, start), (Move, start + shift), (Release, start + shift)):
            editor.handle(gesture(projection.to_original(view.to_section(pixel)), tuple(pixel), projection))
        moved_piece = editor.drawing.pick("horizon", pick.name).pieces[index]
        inner = slice(2, -2)
        assert len(moved_piece) <= len(piece) + 1
        nearest = [LineString(piece + shift * view.pixel).distance(Point(point)) for point in moved_piece[inner]]
        assert max(nearest) < 1.0  # metre
        ends = [line.distance(Point(moved_piece[end])) for end in (0, -1)]
        assert min(ends) < 3 * view.pixel[0]
        assert not LineString(moved_piece[1:-1]).crosses(line)
        editor.undo()
