"""Each gesture does what it says, any number of them in any order does no harm, and all of it can be undone."""

import numpy as np
import pytest
from hypothesis import HealthCheck, event, given, settings
from hypothesis import strategies as st
from shapely import LineString, Point

import seiswidgets as sw
from seiswidgets.geology.cutoffs import heave, throw
from seiswidgets.interaction.document import Document, EditHistory
from seiswidgets.interaction.drawing import Drawing
from seiswidgets.interaction.editor import PickEditor
from seiswidgets.interaction.editor_state import MODES
from seiswidgets.interaction.gesture_table import GESTURES
from seiswidgets.interaction.gestures import DoubleClick, Key, Move, Press, Release
from seiswidgets.interaction.projection import PaneProjection
from seiswidgets.interaction.scene import marks, rubber_band, strokes
from seiswidgets.interaction.snapping import follow_event, snap_to_event
from seiswidgets.interaction.viewport import Viewport

SECTION = sw.Section(np.random.default_rng(1).normal(size=(61, 91)), dx=10.0, dz=10.0)  # 900 m x 600 m
VIEW = Viewport(SECTION, 910, 610)  # a pixel a metre
PLAIN = PaneProjection(VIEW)  # of a pane that shows the present-day section
CTRL, SHIFT = frozenset({"ctrl"}), frozenset({"shift"})
FAULT = [(400.0, 100.0), (450.0, 300.0), (500.0, 500.0)]
LEFT, RIGHT = [(50.0, 250.0), (250.0, 260.0), (430.0, 220.0)], [(470.0, 380.0), (850.0, 390.0)]

ACROSS = [(100.0, 450.0), (480.0, 450.0), (800.0, 455.0)]
PICKS = sw.Interpretation(  # a horizon of two pieces that end at the fault, and one across it
    [sw.Fault(FAULT, "F1")], [sw.Horizon(LEFT, RIGHT, name="H1"), sw.Horizon(ACROSS, name="H2")]
)


def editor_of(view, interpretation=None, fixed=None, **tools):
    """An editor that starts with some picks."""
    drawing = Drawing().with_interpretation(interpretation or sw.Interpretation())
    return PickEditor(EditHistory(Document(view.section, drawing, sw.Plan(fixed=fixed))), view, **tools)


@pytest.fixture
def editor():
    return editor_of(VIEW)


@pytest.fixture
def drawn():
    return editor_of(VIEW, PICKS, (100.0, 100.0))


def press(editor, point, modifiers=frozenset(), button=0):
    return editor.handle(Press(point, tuple(VIEW.to_pixels(point)), PLAIN, button, modifiers))


def move(editor, point, modifiers=frozenset()):
    return editor.handle(Move(point, tuple(VIEW.to_pixels(point)), PLAIN, modifiers))


def release(editor, point, **options):
    return editor.handle(Release(point, tuple(VIEW.to_pixels(point)), PLAIN, **options))


def click(editor, point, modifiers=frozenset()):
    return press(editor, point, modifiers) | release(editor, point)


def double_click(editor, point):
    click(editor, point)
    click(editor, point)
    return editor.handle(DoubleClick(point, tuple(VIEW.to_pixels(point)), PLAIN))


def drag(editor, start, *ways, modifiers=frozenset()):
    press(editor, start)
    for way in ways:
        move(editor, way, modifiers)
    release(editor, ways[-1])


def keys(editor, *names, modifiers=frozenset()):
    return [editor.handle(Key(name, PLAIN, modifiers)) for name in names]


def draw(editor, points):
    for point in points[:-1]:
        click(editor, point)
    double_click(editor, points[-1])


def pieces(editor, name="F1", kind="fault"):
    return editor.drawing.pick(kind, name).pieces


# Drawing


def test_click_adds_vertices_and_a_double_click_finishes(editor):
    editor.enter("fault")
    for number, point in enumerate(FAULT, 1):
        assert click(editor, point)
        assert editor.drawing.draft.points == tuple(FAULT[:number])
        assert editor.rubber_band == point
    assert editor.interpretation.faults == ()
    assert double_click(editor, FAULT[-1])
    assert editor.drawing.draft is None
    assert editor.rubber_band is None
    assert editor.interpretation.fault("F1").points.tolist() == [list(point) for point in FAULT]


def test_enter_finishes(editor):
    editor.enter("fault")
    for point in FAULT:
        click(editor, point)
    assert keys(editor, "Enter") == [True]
    assert pieces(editor) == (tuple(FAULT),)


def test_the_ends_of_a_fault_snap_to_the_border_and_to_other_faults(drawn):
    drawn.enter("fault")
    draw(drawn, [(300.0, 7.0), (390.0, 9.0), (457.0, 300.0)])  # a pixel is a metre
    (first, middle, last) = pieces(drawn, "F2")[0]
    assert first == (300.0, 0.0)
    assert middle == (390.0, 9.0)
    assert LineString(FAULT).distance(Point(last)) < 1e-9
    assert np.hypot(last[0] - 457, last[1] - 300) < 8
    drawn.undo()
    assert pieces(drawn, "F2")[0] == ((300.0, 7.0), (390.0, 9.0), (457.0, 300.0))


def test_the_ends_of_a_loaded_fault_are_kept_through_edits(editor):
    editor.load(sw.Interpretation([sw.Fault(FAULT, "F1", ends=("auto", "tip"))]))
    editor.enter("fault")
    drag(editor, FAULT[1], (430.0, 300.0))
    assert editor.interpretation.fault("F1").ends == ("auto", "tip")


def test_the_end_of_a_fault_snaps_while_it_is_dragged_unless_shift_is_held(drawn):
    drawn.enter("fault")
    drag(drawn, FAULT[0], (420.0, 60.0), (420.0, 6.0))
    assert pieces(drawn)[0][0] == (420.0, 0.0)
    drag(drawn, (420.0, 0.0), (420.0, 60.0), (420.0, 6.0), modifiers=SHIFT)
    assert pieces(drawn)[0][0] == (420.0, 6.0)
    drag(drawn, FAULT[1], (420.0, 20.0), (440.0, 6.0))
    assert pieces(drawn)[0][1] == (440.0, 6.0)


def test_new_picks_take_free_names(editor):
    editor.enter("fault")
    for x in (100.0, 300.0, 500.0):
        draw(editor, [(x, 100.0), (x, 200.0)])
    assert editor.drawing.names("fault") == ("F1", "F2", "F3")
    editor.delete("fault", "F2")
    draw(editor, [(700.0, 100.0), (700.0, 200.0)])
    assert editor.drawing.names("fault") == ("F1", "F3", "F2")
    assert len({pick.colour for pick in editor.drawing.picks}) == 3


def test_a_line_begun_with_a_horizon_selected_is_a_piece_of_it(editor):
    editor.enter("horizon")
    draw(editor, LEFT)
    draw(editor, RIGHT)
    assert pieces(editor, "H1", "horizon") == (tuple(LEFT), tuple(RIGHT))
    keys(editor, "Escape")
    draw(editor, [(100.0, 500.0), (200.0, 500.0)])
    assert editor.drawing.names("horizon") == ("H1", "H2")
    assert len(editor.interpretation.horizon("H1").pieces) == 2


def test_the_piece_begun_keeps_its_horizon_through_undo(editor):
    editor.enter("horizon")
    draw(editor, LEFT)
    click(editor, RIGHT[0])
    editor.undo()
    draw(editor, RIGHT)
    assert len(pieces(editor, "H1", "horizon")) == 2
    for _ in range(20):
        editor.undo()
    for _ in range(20):
        editor.redo()
    assert pieces(editor, "H1", "horizon") == (tuple(LEFT), tuple(RIGHT))


def test_a_line_of_one_point_stays_under_way(editor):
    editor.enter("fault")
    double_click(editor, FAULT[0])
    keys(editor, "Enter")
    assert editor.drawing.draft.points == (FAULT[0],)
    click(editor, FAULT[1])
    keys(editor, "Enter")
    assert pieces(editor) == (tuple(FAULT[:2]),)


def test_a_change_of_mode_finishes_the_line(editor):
    editor.enter("fault")
    for point in FAULT:
        click(editor, point)
    editor.enter("horizon")
    assert pieces(editor) == (tuple(FAULT),)
    click(editor, LEFT[0])
    editor.enter("look")
    assert editor.drawing.draft is None
    editor.undo()
    assert editor.drawing.draft.points == (LEFT[0],)
    assert editor.state.mode == "horizon"


def test_points_off_the_section_go_to_its_border(editor):
    editor.enter("fault")
    draw(editor, [(300.0, -4.0), (400.0, 604.0)])
    assert pieces(editor) == (((300.0, 0.0), (400.0, 600.0)),)


def test_shift_draws_over_what_lies_there(drawn):
    drawn.enter("fault")
    click(drawn, FAULT[1], SHIFT)
    assert drawn.drawing.draft.points == (FAULT[1],)
    assert pieces(drawn) == (tuple(FAULT),)


def test_nothing_is_taken_hold_of_but_the_line_under_way(drawn):
    drawn.enter("fault")
    click(drawn, (200.0, 200.0))
    click(drawn, FAULT[0])
    assert len(drawn.drawing.draft.points) == 2
    drag(drawn, (200.0, 200.0), (180.0, 190.0))
    assert drawn.drawing.draft.points == ((180.0, 190.0), FAULT[0])


# Changing


def test_drag_moves_a_vertex_in_one_step(drawn):
    drawn.enter("fault")
    before = drawn.drawing
    drag(drawn, FAULT[1], (455.0, 310.0), (460.0, 330.0), (455.0, 340.0))
    assert pieces(drawn) == ((FAULT[0], (455.0, 340.0), FAULT[2]),)
    assert drawn.undo()
    assert drawn.drawing == before
    assert not drawn.undo()


def test_a_press_takes_the_nearest_vertex_within_reach(drawn):
    drawn.enter("fault")
    drag(drawn, (453.0, 305.0), (460.0, 330.0))
    assert pieces(drawn)[0][1] == (460.0, 330.0)
    draw(drawn, [(700.0, 350.0), (720.0, 450.0)])
    assert drawn.drawing.names("fault") == ("F1", "F2")


def test_a_click_that_trembles_moves_nothing(drawn):
    drawn.enter("fault")
    before = drawn.drawing
    drag(drawn, FAULT[1], (451.0, 301.0), (450.0, 298.5))
    assert drawn.drawing == before
    assert not drawn.history.undo_count
    assert drawn.state.selection.vertex == 1


def test_a_drag_ends_where_the_button_goes_up(drawn):
    drawn.enter("fault")
    start, end = pieces(drawn)[0][1], (333.0, 222.0)
    press(drawn, start)
    assert release(drawn, end)  # no move was told on the way
    assert pieces(drawn)[0][1] == end
    drawn.undo()
    press(drawn, start)
    move(drawn, end)
    assert release(drawn, end, cancelled=True)
    assert pieces(drawn)[0][1] == start
    assert not drawn.history.undo_count


def test_a_press_that_turns_out_to_be_a_pinch_has_done_nothing(drawn):
    drawn.enter("fault")
    click(drawn, (50.0, 60.0))
    line = drawn.drawing
    press(drawn, (70.0, 300.0))
    assert len(drawn.drawing.draft.points) == 2
    release(drawn, (70.0, 300.0), cancelled=True)
    assert drawn.drawing == line
    release(drawn, (70.0, 300.0), cancelled=True)
    assert drawn.drawing == line


def test_escape_gives_up_a_drag(drawn):
    drawn.enter("fault")
    before = drawn.drawing
    press(drawn, FAULT[1])
    move(drawn, (500.0, 310.0))
    assert drawn.drawing != before
    keys(drawn, "Escape")
    assert drawn.drawing == before
    assert not move(drawn, (510.0, 310.0))
    assert not drawn.history.undo_count


def test_a_click_on_a_line_inserts_a_vertex(drawn):
    drawn.enter("fault")
    click(drawn, (427.0, 200.0))
    assert len(pieces(drawn)[0]) == 4
    assert pieces(drawn)[0][1] == pytest.approx((425.1, 200.5), abs=0.1)
    drawn.undo()
    assert pieces(drawn) == (tuple(FAULT),)
    drag(drawn, (425.0, 200.0), (440.0, 210.0))
    assert pieces(drawn)[0][1] == (440.0, 210.0)
    drawn.undo()
    assert pieces(drawn) == (tuple(FAULT),)


def test_look_mode_selects_first(drawn):
    assert not click(drawn, (600.0, 100.0))  # the pane pans
    assert click(drawn, FAULT[1])
    assert (drawn.state.selection.name, drawn.state.selection.vertex) == ("F1", None)
    assert pieces(drawn) == (tuple(FAULT),)
    drag(drawn, FAULT[1], (460.0, 330.0))
    assert pieces(drawn)[0][1] == (460.0, 330.0)
    click(drawn, (425.0, 200.0))
    assert len(pieces(drawn)[0]) == 4


def test_ctrl_click_removes_a_vertex_a_piece_and_a_pick(drawn):
    drawn.enter("horizon")
    before = drawn.drawing
    click(drawn, LEFT[1], CTRL)
    assert pieces(drawn, "H1", "horizon")[0] == (LEFT[0], LEFT[2])
    click(drawn, LEFT[0], CTRL)
    assert pieces(drawn, "H1", "horizon") == (tuple(RIGHT),)
    click(drawn, RIGHT[1], frozenset({"meta"}))
    assert drawn.drawing.names("horizon") == ("H2",)
    for _ in range(3):
        drawn.undo()
    assert drawn.drawing == before


@pytest.mark.parametrize("key", ["Delete", "Backspace"])
def test_delete(drawn, key):
    drawn.enter("fault")
    click(drawn, FAULT[1])
    assert keys(drawn, key) == [True]
    assert pieces(drawn) == ((FAULT[0], FAULT[2]),)
    keys(drawn, "Escape")
    assert keys(drawn, key) == [False]
    click(drawn, (600.0, 100.0))
    click(drawn, (650.0, 100.0))
    keys(drawn, key, key)  # the one that was clicked last is selected
    assert drawn.drawing.draft is None
    keys(drawn, "Enter", "Enter", "ArrowDown", "Enter", key)
    assert len(drawn.drawing.draft.points) == 1
    keys(drawn, key)
    assert drawn.drawing.draft is None


def test_delete_removes_the_piece_drawn_last_but_no_more(drawn):
    drawn.enter("horizon")
    drawn.select("horizon", "H1")
    draw(drawn, [(600.0, 100.0), (700.0, 100.0)])
    assert keys(drawn, "Delete", "Delete") == [True, False]
    assert pieces(drawn, "H1", "horizon") == (tuple(LEFT), tuple(RIGHT))
    draw(drawn, [(600.0, 100.0), (700.0, 100.0)])
    assert len(pieces(drawn, "H1", "horizon")) == 3


def test_delete_in_look_mode(drawn):
    click(drawn, LEFT[1])
    assert keys(drawn, "Delete", "Delete") == [True, False]
    assert pieces(drawn, "H1", "horizon") == (tuple(RIGHT),)
    drawn.select("horizon", "H1")
    assert keys(drawn, "Delete") == [True]
    assert drawn.drawing.names("horizon") == ("H2",)


@pytest.mark.parametrize(
    ("key", "step"), [("ArrowLeft", (-10, 0)), ("ArrowRight", (10, 0)), ("ArrowUp", (0, -10)), ("ArrowDown", (0, 10))]
)
@pytest.mark.parametrize(("modifiers", "times"), [(frozenset(), 1), (SHIFT, 10)])
def test_arrows_nudge(drawn, key, step, modifiers, times):
    drawn.enter("fault")
    click(drawn, FAULT[1])
    assert keys(drawn, key, modifiers=modifiers) == [True]
    assert pieces(drawn)[0][1] == tuple(np.add(FAULT[1], np.multiply(step, times)))
    drawn.undo()
    assert pieces(drawn) == (tuple(FAULT),)


def test_page_keys_and_insert(drawn):
    drawn.enter("horizon")
    keys(drawn, "PageDown", "PageDown", "PageDown", "PageDown")
    assert (drawn.state.selection.name, drawn.state.selection.piece, drawn.state.selection.vertex) == ("H1", 1, 0)
    keys(drawn, "PageUp", "PageUp", "Insert")
    assert pieces(drawn, "H1", "horizon")[0][2] == (340.0, 240.0)
    keys(drawn, "PageDown", "i")
    assert len(pieces(drawn, "H1", "horizon")[0]) == 5


# In a pane of the restored section


@pytest.fixture(scope="module")
def slipped():
    """A case, its restoration, and how a pane of the restored section sees it."""
    case = sw.synthetic.planar_fault()
    picks = case.interpretation
    restored = sw.Restoration(case.section, 60.0).unfault(picks.faults, picks.horizons, fixed=case.fixed)
    return case, restored, PaneProjection(Viewport(restored.section, 800, 600), restored)


def press_in(projection, editor, point):
    """Press in a pane at a point of its section."""
    return editor.handle(Press(projection.to_original(point), tuple(projection.view.to_pixels(point)), projection))


def test_vertices_are_taken_where_the_restored_pane_shows_them(slipped):
    case, _, projection = slipped
    editor = editor_of(Viewport(case.section), case.interpretation)
    editor.enter("horizon")
    vertex = case.interpretation.horizons[0].pieces[0][0]
    (shown,) = projection.to_pane([vertex])
    assert press_in(projection, editor, shown)
    assert editor.drawing.line(editor.state.selection)[editor.state.selection.vertex] == tuple(vertex)


def test_a_line_across_a_restored_fault_is_drawn_in_pieces_that_end_there(slipped):
    case, restored, projection = slipped
    editor = editor_of(Viewport(case.section))
    editor.enter("horizon")
    x_min, x_max, z_min, z_max = case.section.extent
    ends = [(x_min + share * (x_max - x_min), z_min + 0.6 * (z_max - z_min)) for share in (0.15, 0.85)]
    for end in ends:
        assert press_in(projection, editor, end)
    editor.finish()
    (horizon,) = editor.interpretation.horizons
    assert len(horizon.pieces) == 2
    np.testing.assert_allclose(
        restored.to_restored(np.concatenate(horizon.pieces))[:, 1], ends[0][1], atol=0.2 * case.section.dz
    )
    assert abs(sw.throw(case.interpretation.faults[0], horizon)) == pytest.approx(
        abs(sw.throw(case.interpretation.faults[0], case.interpretation.horizons[0])), rel=0.02
    )
    editor.undo()
    assert editor.drawing == Drawing()


def test_nothing_is_drawn_where_the_restored_pane_shows_no_rock(slipped):
    case, _, projection = slipped
    editor = editor_of(Viewport(case.section))
    editor.enter("fault")
    x_min, x_max, z_min, _ = case.section.extent
    assert not press_in(projection, editor, (x_max + 10 * (x_max - x_min), z_min))
    assert editor.drawing.draft is None


# The keyboard alone


def test_a_fault_and_a_horizon_by_keyboard_alone(editor):
    assert keys(editor, "f", "Enter") == [True, True]
    assert editor.state.cursor == pytest.approx((450.0, 300.0), abs=10)
    keys(editor, "ArrowUp", "ArrowUp", modifiers=SHIFT)
    start = editor.state.cursor
    keys(editor, "Enter", "ArrowDown", "ArrowDown", "ArrowRight", " ")
    keys(editor, "ArrowDown", modifiers=SHIFT)
    keys(editor, "Enter", "Enter")
    (x, z) = start
    assert pieces(editor) == ((start, (x + 10, z + 20), (x + 10, z + 120)),)
    keys(editor, "h", "ArrowLeft", "Enter", "ArrowLeft", "ArrowLeft", "Enter", "Enter")
    assert len(editor.interpretation.horizon("H1").pieces[0]) == 2
    assert editor.state.cursor is not None
    keys(editor, "Escape", "Escape")
    assert editor.state.mode == "look"


def test_delete_takes_back_what_the_keyboard_put(editor):
    keys(editor, "f", "Enter", "Enter", "ArrowDown", "Enter", "Backspace")
    assert len(editor.drawing.draft.points) == 1
    keys(editor, "ArrowRight", "Enter", "Enter")
    assert len(pieces(editor)[0]) == 2


def test_the_cursor_steps_by_pixels_or_by_one_sample(editor):
    editor.viewport = Viewport(SECTION, 91, 61)  # a sample a pixel
    keys(editor, "f", "Enter")
    x, z = editor.state.cursor
    keys(editor, "ArrowRight")
    assert editor.state.cursor == (x + 80, z)
    keys(editor, "ArrowLeft", modifiers=CTRL)
    assert editor.state.cursor == (x + 70, z)


def test_tab_and_other_keys_are_left_alone(drawn):
    for mode in MODES:
        drawn.enter(mode)
        before = drawn.state
        assert keys(drawn, "Tab", "q", "0", "F5", " ", "Home") == [False] * 6
        assert keys(drawn, "Tab", modifiers=SHIFT) == [False]
        assert keys(drawn, "c", "s", modifiers=CTRL) == [False] * 2
        assert drawn.state == before


def test_the_table_names_every_key():
    table = str(GESTURES)
    for word in (
        "Enter",
        "Space",
        "Arrows",
        "Page Up",
        "Insert",
        "Delete",
        "Backspace",
        "Escape",
        "Ctrl+Z",
        "Ctrl+Y",
        "Shift+C",
        "Ctrl+Up",
        "J",
        "X",
        "E",
        "R",
        "M",
    ):
        assert word in table


@pytest.mark.parametrize(
    ("mode", "point", "modifiers", "words"),
    [
        ("fault", (700.0, 100.0), frozenset(), "Click to begin a fault"),
        ("fault", FAULT[1], frozenset(), "Drag to move this vertex of F1; Ctrl+click removes it"),
        ("fault", FAULT[1], CTRL, "Click to remove this vertex"),
        ("fault", (425.0, 200.0), frozenset(), "Click to insert a vertex into F1"),
        ("horizon", LEFT[1], frozenset(), "Drag to move this vertex of H1"),
        ("look", LEFT[1], frozenset(), "Click to select H1"),
        ("look", (700.0, 100.0), frozenset(), "Drag to pan"),
        ("block", (700.0, 100.0), frozenset(), "Click to hold this block"),
        ("block", (100.0, 100.0), frozenset(), "Click to release the block"),
        ("block", (700.0, 100.0), SHIFT, "Click to pin this point"),
        ("move", LEFT[1], frozenset(), "Drag to move a piece of H1"),
        ("move", LEFT[2], frozenset(), "Drag to slide this piece of H1 along F1"),
        ("move", (700.0, 100.0), frozenset(), "Drag a rectangle"),
        ("look", LEFT[1], frozenset({"alt"}), "Drag to move a piece of H1"),
    ],
)
def test_the_hint_says_what_the_click_does_and_changes_nothing(drawn, mode, point, modifiers, words):
    drawn.enter(mode)
    before = drawn.state
    assert drawn.click_hint(Move(point, tuple(VIEW.to_pixels(point)), PLAIN, modifiers)).startswith(words)
    assert drawn.state is before or drawn.state == before


def test_the_hint_follows_the_line_that_is_drawn(drawn):
    def hint(point):
        return drawn.click_hint(Move(point, tuple(VIEW.to_pixels(point)), PLAIN))

    drawn.enter("horizon")
    drawn.select("horizon", "H1")
    assert hint((600.0, 100.0)).startswith("Click to begin another piece of H1")
    click(drawn, (600.0, 100.0))
    assert hint((700.0, 100.0)).startswith("Click to add a vertex; double click or Enter finishes")
    press(drawn, (600.0, 100.0))
    assert hint((600.0, 100.0)) == ""


# The held block


def test_hold_a_block(editor):
    editor.enter("block")
    click(editor, (200.0, 300.0))
    assert editor.state.fixed == (200.0, 300.0)
    click(editor, (600.0, 300.0))
    assert editor.state.fixed == (600.0, 300.0)
    click(editor, (603.0, 302.0))
    assert editor.state.fixed is None
    editor.undo()
    assert editor.state.fixed == (600.0, 300.0)
    double_click(editor, (200.0, 300.0))
    assert editor.state.fixed == (200.0, 300.0)
    keys(editor, "Delete")
    assert editor.state.fixed is None
    keys(editor, "Enter", "Enter")
    assert editor.state.fixed is not None
    keys(editor, "Enter")
    assert editor.state.fixed is None


def test_pin_points(editor):
    editor.enter("block")
    click(editor, (200.0, 300.0))
    for point in ((600.0, 300.0), (100.0, 100.0)):
        click(editor, point, modifiers=frozenset({"shift"}))
    assert editor.state.pins == ((600.0, 300.0), (100.0, 100.0))
    assert editor.state.fixed == (200.0, 300.0)
    shown = [mark.text for mark in marks(editor.state, PLAIN, ()) if mark.kind == "held"]
    assert shown == ["held", "pin", "pin"]
    click(editor, (603.0, 302.0))
    assert editor.state.pins == ((100.0, 100.0),)
    editor.undo()
    assert editor.state.pins == ((600.0, 300.0), (100.0, 100.0))


# Undo and Escape


def test_undo_and_redo_by_keys(editor):
    editor.enter("fault")
    draw(editor, FAULT)
    done = editor.drawing
    for _ in range(4):  # once more than there are edits
        assert keys(editor, "z", modifiers=CTRL) == [True]
        assert editor.drawing.draft is None
    assert editor.drawing.picks == ()
    assert editor.drawing.draft is None
    assert not editor.history.undo_count
    keys(editor, "Z", modifiers=CTRL | SHIFT)
    keys(editor, "y", "y", "y", modifiers=CTRL)
    assert editor.drawing == done
    assert not editor.history.redo_count


def test_an_edit_after_undo_forgets_what_was_undone(editor):
    editor.enter("fault")
    click(editor, FAULT[0])
    editor.undo()
    click(editor, FAULT[1])
    assert not editor.redo()
    assert editor.drawing.draft.points == (FAULT[1],)


def test_escape_leaves_step_by_step(drawn):
    drawn.enter("horizon")
    drawn.select("horizon", "H1")
    click(drawn, (600.0, 100.0))
    click(drawn, (700.0, 100.0))
    press(drawn, (700.0, 100.0))
    move(drawn, (700.0, 150.0))
    keys(drawn, "Escape")
    assert drawn.drawing.draft.points[-1] == (700.0, 100.0)
    keys(drawn, "Escape")
    assert drawn.drawing.draft is None
    assert drawn.state.selection.name == "H1"
    keys(drawn, "Escape")
    assert drawn.state.selection is None
    assert drawn.state.mode == "horizon"
    assert keys(drawn, "Escape", "Escape") == [True, False]
    assert drawn.state.mode == "look"
    drawn.undo()
    assert len(drawn.drawing.draft.points) == 2


def test_undo_goes_back_without_limit(editor):
    editor.enter("fault")
    for number in range(3000):
        click(editor, (float(number % 40) * 20, float(number // 40) * 7), SHIFT)
    while editor.undo():
        pass
    assert editor.drawing == Drawing()


# The list of picks


def test_the_list(drawn):
    before = drawn.drawing
    drawn.rename("fault", "F1", "  the big one ")
    drawn.recolour("fault", "the big one", "#123456")
    drawn.show("fault", "the big one", False)
    pick = drawn.drawing.pick("fault", "the big one")
    assert (pick.colour, pick.visible) == ("#123456", False)
    assert drawn.interpretation.fault("the big one").points.tolist() == [list(point) for point in FAULT]
    drawn.delete("fault", "the big one")
    drawn.hold((5.0, 5.0))
    for _ in range(5):
        assert drawn.undo()
    assert drawn.drawing == before


def test_hidden_picks_are_not_under_the_pointer(drawn):
    drawn.show("fault", "F1", False)
    drawn.enter("fault")
    click(drawn, FAULT[1])
    assert drawn.drawing.draft.points == (FAULT[1],)


def test_horizons_of_one_name_are_one(drawn):
    drawn.enter("horizon")
    drawn.select("horizon", "H2")
    click(drawn, (600.0, 100.0))
    drawn.rename("horizon", "H2", "H1")
    assert len(pieces(drawn, "H1", "horizon")) == 3
    click(drawn, (700.0, 100.0))
    keys(drawn, "Enter")
    assert len(pieces(drawn, "H1", "horizon")) == 4
    assert drawn.drawing.names("horizon") == ("H1",)


@pytest.mark.parametrize(
    ("change", "error", "message"),
    [
        (lambda p: p.rename("fault", "F9", "x"), sw.PickError, "no fault called 'F9'; there are 'F1'"),
        (lambda p: p.rename("fault", "F2", "F1"), sw.PickError, "a fault called 'F1' already"),
        (lambda p: p.rename("fault", "F1", " "), sw.PickError, "must not be empty"),
        (lambda p: p.recolour("fault", "F1", "red;x:1"), sw.SettingError, "colour must be #rrggbb"),
        (lambda p: p.delete("horizon", "F1"), sw.PickError, "no horizon called 'F1'"),
        (lambda p: p.enter("draw"), sw.SettingError, "mode must be one of look, fault, horizon, body, move, block"),
    ],
)
def test_what_cannot_be(drawn, change, error, message):
    drawn.enter("fault")
    draw(drawn, [(700.0, 100.0), (700.0, 200.0)])
    before = drawn.drawing
    with pytest.raises(error, match=message):
        change(drawn)
    assert drawn.drawing == before


# Problems, and there and back again


def test_a_line_that_crosses_itself_is_kept_and_reported(drawn):
    drawn.enter("horizon")
    drawn.select("horizon", "H1")
    draw(drawn, [(600.0, 50.0), (700.0, 150.0), (700.0, 50.0), (600.0, 150.0)])
    assert len(pieces(drawn, "H1", "horizon")) == 3
    assert [bool(flaw) for flaw in drawn.interpretation.horizon("H1").flaws] == [False, False, True]
    ((name, message),) = drawn.problems
    assert name == "H1"
    assert message.startswith("piece 3 of horizon 'H1' crosses itself near x=650")
    drag(drawn, (700.0, 50.0), (750.0, 250.0))
    assert drawn.problems == []
    assert len(drawn.interpretation.horizon("H1").pieces) == 3


CASES = [sw.synthetic.graben(), sw.synthetic.faulted_fold(), sw.synthetic.domino(faults=3)]


@pytest.mark.parametrize("case", CASES, ids=lambda case: case.section.name)
def test_interpretation_there_and_back(case):
    given_in, editor = case.interpretation, editor_of(Viewport(case.section), case.interpretation)
    back = editor.interpretation
    assert [fault.name for fault in back.faults] == [fault.name for fault in given_in.faults]
    assert [horizon.name for horizon in back.horizons] == [horizon.name for horizon in given_in.horizons]
    for one, other in zip(given_in.faults, back.faults, strict=True):
        assert np.array_equal(one.points, other.points)
    for one, other in zip(given_in.horizons, back.horizons, strict=True):
        assert len(one.pieces) == len(other.pieces)
        assert all(map(np.array_equal, one.pieces, other.pieces))
    assert editor.problems == []
    before = editor.drawing
    editor.load(editor.interpretation)
    assert not editor.history.undo_count
    editor.load(given_in)
    assert editor.drawing == before


def test_loading_is_an_edit_and_keeps_looks(drawn):
    drawn.recolour("fault", "F1", "#abcdef")
    drawn.load(sw.Interpretation([sw.Fault(RIGHT, "F1")], [sw.Horizon(LEFT, name="new")]))
    assert drawn.drawing.pick("fault", "F1").colour == "#abcdef"
    assert drawn.drawing.names("horizon") == ("new",)
    drawn.undo()
    assert drawn.drawing.names("horizon") == ("H1", "H2")


# Cut-offs


def test_a_fold_that_a_fault_cuts_twice_has_two_numbers_there():
    fault, at = sw.Fault([(300, 0), (600, 600)], "F1"), lambda z: (300 + z / 2, z)
    hanging_wall = [at(160.0), (600, 260), at(440.0)]
    fold = sw.Horizon([(0, 100), at(100.0)], hanging_wall, [(0, 380), at(380.0)], name="H1")
    found = editor_of(VIEW, sw.Interpretation([fault], [fold])).cutoffs()
    depths = {number: sorted(mark.point[1] for mark in found if mark.number == number) for number in (1, 2)}
    assert depths == {1: pytest.approx([100, 160]), 2: pytest.approx([380, 440])}


def test_cutoffs_are_numbered_by_fault_and_horizon(drawn):
    marks = drawn.cutoffs()
    assert [(mark.number, mark.fault, mark.horizon) for mark in marks] == [
        (1, "F1", "H1"), (1, "F1", "H1"), (2, "F1", "H2"), (2, "F1", "H2")
    ]  # fmt: skip
    assert {mark.wall for mark in marks if mark.number == 1} == {"hanging wall", "footwall"}
    for mark in marks:
        assert mark.point[0] == pytest.approx(400 + (mark.point[1] - 100) / 4)
    drawn.show("horizon", "H1", False)
    assert {mark.number for mark in drawn.cutoffs()} == {2}


@pytest.mark.parametrize("case", CASES[:2], ids=lambda case: case.section.name)
def test_cutoffs_of_a_synthetic_section(case):
    marks = editor_of(Viewport(case.section), case.interpretation).cutoffs()
    for fault in case.interpretation.faults:
        for horizon in case.interpretation.horizons:
            found = {m.wall: m.point for m in marks if (m.fault, m.horizon) == (fault.name, horizon.name)}
            if len(case.interpretation.faults) == 1:
                apart = np.subtract(found["hanging wall"], found["footwall"])
                expected = heave(fault, horizon), throw(fault, horizon)  # these do not know the size of a trace
                np.testing.assert_allclose(np.abs(apart), np.abs(expected), atol=0.01)
            assert len(found) == 2


@pytest.mark.parametrize("mode", ["look", "horizon"])
def test_a_cutoff_is_dragged_along_its_fault(drawn, mode):
    drawn.enter(mode)
    before = drawn.drawing
    mark = next(mark for mark in drawn.cutoffs() if mark.horizon == "H1" and mark.point[1] < 300)
    drag(drawn, mark.point, (500.0, 230.0), (500.0, 262.5))
    left, right = pieces(drawn, "H1", "horizon")
    assert right == tuple(RIGHT)
    assert left[:2] == tuple(LEFT[:2])
    assert len(left) == 3
    assert left[2][0] == pytest.approx(400 + (left[2][1] - 100) / 4)
    assert left[2] == pytest.approx((444.1, 276.5), abs=0.1)  # the nearest place of the fault
    assert any(mark.point == pytest.approx(left[2]) for mark in drawn.cutoffs())
    drawn.undo()
    assert drawn.drawing == before


def test_a_horizon_across_a_fault_is_split_where_its_cutoff_is_dragged(drawn):
    before = drawn.drawing
    lower = (487.5, 450.0)
    click(drawn, lower)
    assert drawn.drawing == before
    drag(drawn, (490.5, 450.0), (499.0, 495.0))  # pressed to the right of the fault
    left, right = pieces(drawn, "H2", "horizon")
    assert left[-1] == pytest.approx((487.5, 450.0), abs=0.5)
    assert right[0] == pytest.approx((498.8, 495.0), abs=0.5)
    assert {mark.wall for mark in drawn.cutoffs() if mark.horizon == "H2"} == {"hanging wall", "footwall"}
    drawn.undo()
    assert drawn.drawing == before


@pytest.mark.parametrize("tip", [(415.0, 223.0), (445.0, 217.0)])
def test_a_piece_that_ends_short_or_overshoots_is_dragged_to_the_fault(drawn, tip):
    short = sw.Horizon([*LEFT[:2], tip], RIGHT, name="H1")
    drawn.load(sw.Interpretation(PICKS.faults, [short]))
    mark = next(mark for mark in drawn.cutoffs() if mark.point[1] < 300)
    click(drawn, mark.point)
    assert pieces(drawn, "H1", "horizon")[0][-1] == tip
    drag(drawn, mark.point, (437.5, 250.0))
    left, right = pieces(drawn, "H1", "horizon")
    assert left == (*LEFT[:2], pytest.approx((437.5, 250.0)))
    assert right == tuple(RIGHT)


def test_shift_takes_a_cutoff_off_its_fault(drawn):
    drawn.enter("horizon")
    mark = next(mark for mark in drawn.cutoffs() if mark.horizon == "H1" and mark.point[1] < 300)
    drag(drawn, mark.point, (380.0, 200.0), modifiers=SHIFT)
    assert pieces(drawn, "H1", "horizon")[0][-1] == (380.0, 200.0)


# Snapping


def test_horizons_snap_and_faults_do_not():
    case = sw.synthetic.sine_fold(noise=0)
    view = Viewport(case.section)
    editor = editor_of(
        view,
        snap=lambda point: snap_to_event(case.section, point, "peak", 6),
        follow=lambda start, end: follow_event(case.section, start, end, "peak", 40),
    )
    (bed,) = case.interpretation.horizons[1].pieces
    editor.enter("horizon")
    for point in (bed[3] + (0, 12), bed[30] - (0, 9)):
        at = tuple(point), tuple(view.to_pixels(point)), PaneProjection(view)
        editor.handle(Move(*at))
        previewed = rubber_band(editor.state, PaneProjection(view))
        editor.handle(Press(*at))
    line = np.array(editor.drawing.draft.points)
    assert previewed == list(editor.drawing.draft.points)
    assert len(rubber_band(editor.state, PaneProjection(view))) == 1  # until the pointer moves
    assert len(line) > 3
    assert abs(np.interp(line[:, 0], *bed.T) - line[:, 1]).max() < case.section.dz
    editor.undo()
    assert len(editor.drawing.draft.points) == 1
    editor.deselect()
    keys(editor, *["ArrowRight"] * 8)
    dashed = [stroke for stroke in strokes(editor.state, PaneProjection(view)) if stroke.dash]
    assert len(dashed[0].points) > 2
    keys(editor, "Escape")
    editor.enter("fault")
    point = tuple(bed[3] + (0, 12))
    editor.handle(Press(point, tuple(view.to_pixels(point)), PaneProjection(view)))
    assert editor.drawing.draft.points == (point,)


# Any gestures in any order

COARSE = st.tuples(st.integers(-1, 31).map(lambda n: n * 30.0), st.integers(-1, 21).map(lambda n: n * 30.0))
NEAR = st.tuples(st.floats(-9, 9), st.floats(-9, 9))
MODIFIERS = st.sampled_from([frozenset()] * 6 + [CTRL, SHIFT, CTRL | SHIFT, frozenset({"alt"})])
KEYS = (
    "Enter", " ", "Escape", "Delete", "Backspace", "Tab", "PageUp", "PageDown", "Insert", "f", "h", "b", "l", "q",
    "ArrowLeft", "ArrowRight", "ArrowUp", "ArrowDown", "z", "y", "Z", "m", "c", "C", "j", "x", "r", "e",
)  # fmt: skip


@st.composite
def gestures(draw):
    """One gesture, often at or near what was drawn: a place is a coarse one, a number of a vertex, or neither."""
    kind = draw(st.sampled_from([click] * 4 + [Press] * 4 + [Move] * 4 + [Release] * 3 + [DoubleClick] + [Key] * 5))
    if kind is Key:
        return kind, draw(st.sampled_from(KEYS)), draw(MODIFIERS)
    place = draw(COARSE | COARSE | st.integers(0, 50) | st.sampled_from([(np.nan, np.nan), (1e9, -1e9)]))
    return kind, (place, draw(st.just((0.0, 0.0)) | NEAR)), draw(MODIFIERS)


COMMANDS = {
    "rename": lambda editor, pick: editor.rename(
        pick.kind, pick.name, "H1" if pick.kind == "horizon" else editor.drawing.free_name("fault")
    ),
    "hide": lambda editor, pick: editor.show(pick.kind, pick.name, not pick.visible),
    "recolour": lambda editor, pick: editor.recolour(pick.kind, pick.name, "red"),
    "select": lambda editor, pick: editor.select(pick.kind, pick.name),
    "delete": lambda editor, pick: editor.delete(pick.kind, pick.name),
    "load": lambda editor, pick: editor.load(editor.interpretation),
}
ACTIONS = (
    gestures() | gestures() | gestures() | gestures() | st.tuples(st.sampled_from(sorted(COMMANDS)), st.integers(0, 5))
)


def perform(editor, action):
    if action[0] in COMMANDS:
        if editor.drawing.picks and not (action[0] in ("rename", "delete") and editor.drawing.draft):
            COMMANDS[action[0]](editor, editor.drawing.picks[action[1] % len(editor.drawing.picks)])
        return
    kind, what, modifiers = action
    if kind is Key:
        try:
            consumed = editor.handle(Key(what, PLAIN, modifiers))
        except sw.PickError:  # a command that what is selected does not allow
            return
        assert what != "Tab" or not consumed
        return
    place, aside = what
    if isinstance(place, int):
        places = [point for pick in editor.drawing.picks for piece in pick.pieces for point in piece]
        places += [mark.point for mark in editor.cutoffs()]
        place = places[place % len(places)] if places else (300.0, 300.0)
    point = tuple(float(value) for value in np.add(place, aside))
    if kind is click:
        click(editor, point, modifiers)
    else:
        editor.handle(kind(point, tuple(VIEW.to_pixels(point).tolist()), PLAIN, modifiers=modifiers))


def check_edit(editor, before, depth, dragging):
    """Undo and redo a gesture: it is one edit, or two if it ended a drag as well."""
    edits = editor.history.undo_count - depth
    assert edits <= 1 + dragging
    if edits > 0 and not editor.state.drag:
        after, future = editor.state, editor.history.redo_count
        assert all(editor.undo() for _ in range(edits))
        assert editor.drawing == before
        assert all(editor.redo() for _ in range(edits))
        assert (editor.drawing, editor.state.selection, editor.history.redo_count) == (
            after.drawing,
            after.selection,
            future,
        )


def check_state(editor):
    state, section = editor.state, editor.viewport.section
    assert state.mode in MODES
    assert state.drawing.draft is None or state.mode == state.drawing.draft.kind
    for pick in state.drawing.picks:
        assert pick.pieces
        assert all(len(piece) >= 2 for piece in pick.pieces)
        assert section.contains(np.vstack(pick.pieces)).all()
    assert len(set(state.drawing.names("fault"))) == len(state.drawing.names("fault"))
    assert len(set(state.drawing.names("horizon"))) == len(state.drawing.names("horizon"))
    bad = {name for name, _ in editor.problems}
    drawn = {(pick.kind, pick.name) for pick in state.drawing.picks}
    usable = {("fault", pick.name) for pick in editor.interpretation.faults}
    usable |= {("horizon", pick.name) for pick in editor.interpretation.horizons}
    assert usable <= drawn
    assert {name for _, name in drawn - usable} <= bad
    for mark in editor.cutoffs():
        assert np.isfinite(mark.point).all()
    target = state.selection
    assert target is None or target.vertex is None or target.vertex < len(state.drawing.line(target))


def random_gestures(actions, interpretation=None, **options):
    editor = editor_of(VIEW, interpretation, **options)
    start = editor.drawing
    for action in actions:
        drag, depth, undone = editor.state.drag, editor.history.undo_count, editor.history.redo_count
        before = drag.before if drag else editor.drawing
        perform(editor, action)
        if editor.history.redo_count <= undone:
            check_edit(editor, before, depth, drag is not None)
        check_state(editor)
    for _ in range(5):
        editor.handle(Key("Escape", PLAIN))
    assert (editor.state.mode, editor.state.selection, editor.state.drag) == ("look", None, None)
    assert editor.drawing.draft is None
    end, edits = editor.drawing, editor.history.undo_count
    while editor.undo():
        pass
    assert editor.drawing == start
    assert all(editor.redo() for _ in range(edits))  # there may be more, if the last was an undo
    assert editor.drawing == end
    event(f"{min(edits // 10, 5)}0 edits or more")
    return editor


SOON = settings(
    max_examples=100,
    deadline=None,
    derandomize=True,
    suppress_health_check=[HealthCheck.too_slow, HealthCheck.data_too_large],
)


@SOON
@given(st.lists(ACTIONS, min_size=40, max_size=60))
def test_random_gestures_from_nothing(actions):
    random_gestures([(Key, "f", frozenset()), *actions])


@SOON
@given(st.lists(ACTIONS, min_size=40, max_size=60), st.sampled_from(["f", "h", "l", "m"]))
def test_random_gestures_on_a_drawing(actions, mode):
    snap = lambda point: snap_to_event(SECTION, point, "peak", 3)  # noqa: E731
    random_gestures([(Key, mode, frozenset()), *actions], PICKS, snap=snap)


def test_a_body_is_drawn_closed_and_edited_like_other_picks(editor):
    corners = [(100.0, 200.0), (200.0, 200.0), (200.0, 300.0), (100.0, 300.0)]
    keys(editor, "s")
    for point in corners[:2]:
        click(editor, point)
    keys(editor, "Enter")
    assert editor.drawing.draft  # a body of two points is none yet
    for point in corners[2:]:
        click(editor, point)
    keys(editor, "Enter")
    (body,) = editor.interpretation.bodies
    assert (body.name, body.kind) == ("B1", "salt")
    np.testing.assert_array_equal(body.points, corners)
    drag(editor, (100.0, 250.0), (60.0, 260.0), (50.0, 250.0))  # on the side that closes it
    np.testing.assert_array_equal(editor.interpretation.bodies[0].points, [*corners, (50.0, 250.0)])
    editor.body_kind("body", "B1", "no data")
    assert editor.interpretation.bodies[0].kind == "no data"
    editor.use("body", "B1", "ignore")
    assert editor.interpretation.bodies == ()
    for _ in range(3):
        editor.undo()
    np.testing.assert_array_equal(editor.interpretation.bodies[0].points, corners)


def test_a_body_that_crosses_itself_is_a_problem(editor):
    picks = Drawing().with_pick("body", "B1", [[(0, 0), (90, 90), (0, 90), (90, 0)]])
    assert picks.interpretation.bodies == ()
    assert [name for name, _ in picks.problems] == ["B1"]
