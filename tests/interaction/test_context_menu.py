import pytest

from seiswidgets.interaction.context_menu import menu_items
from seiswidgets.interaction.drawing import PickSelection
from seiswidgets.interaction.gestures import Press
from seiswidgets.interaction.scene import strokes
from tests.interaction.test_editor import FAULT, LEFT, PLAIN, VIEW, drawn, pieces  # noqa: F401

EMPTY = (700.0, 100.0)


def menu(editor, point):
    return dict(menu_items(editor, Press(point, tuple(VIEW.to_pixels(point)), PLAIN)))


@pytest.mark.parametrize(
    ("point", "label", "change"),
    [
        (FAULT[1], "Remove this vertex", lambda editor: len(pieces(editor)[0]) == 2),
        ((425.0, 200.0), "Insert a vertex here", lambda editor: len(pieces(editor)[0]) == 4),
        (FAULT[1], "Delete F1", lambda editor: not editor.interpretation.faults),
        (FAULT[1], "Hide F1", lambda editor: not editor.drawing.pick("fault", "F1").visible),
        (FAULT[1], "Only carry F1", lambda editor: editor.interpretation.faults[0].use == "carry"),
        (LEFT[1], "Delete this piece", lambda editor: len(pieces(editor, "H1", "horizon")) == 1),
        (LEFT[1], "Select H1", lambda editor: editor.state.selection.name == "H1"),
        (LEFT[1], "Move H1", lambda editor: len(editor.state.chosen_pieces) == 2 and editor.state.mode == "move"),
        (LEFT[1], "Move this piece", lambda editor: len(editor.state.chosen_pieces) == 1),
        (LEFT[1], "Copy H1 up", lambda editor: editor.drawing.names("horizon") == ("H1", "H2", "H3")),
        (LEFT[1], "Copy H1 down", lambda editor: editor.state.selection.name == "H3"),
        (LEFT[1], "Join to the nearest piece", lambda editor: len(pieces(editor, "H1", "horizon")) == 1),
        ((425.0, 200.0), "Split here", lambda editor: editor.drawing.names("fault") == ("F1", "F2")),
        (FAULT[1], "Split here", lambda editor: pieces(editor, "F2") == (tuple(FAULT[1:]),)),
        (FAULT[1], "Extend to fault or border", lambda editor: pieces(editor)[0][0] == (375.0, 0.0)),
        (
            FAULT[0],
            "Extend this end to fault or border",
            lambda editor: pieces(editor) == (((375.0, 0.0), *FAULT),),
        ),
        (FAULT[1], "Reverse the line", lambda editor: pieces(editor) == (tuple(FAULT[::-1]),)),
        (FAULT[0], "This end dies out here", lambda editor: editor.interpretation.faults[0].ends == ("tip", "auto")),
        (
            FAULT[-1],
            "This end reaches what lies ahead",
            lambda editor: editor.drawing.picks[0].ends == ("auto", "extend"),
        ),
        (
            FAULT[-1],
            "✓ Judge this end by its distance",
            lambda editor: editor.drawing.picks[0].ends == ("auto", "auto"),
        ),
        (EMPTY, "Keep this level (regional)", lambda editor: editor.state.document.plan.regional == EMPTY[1]),
        (EMPTY, "Begin a fault here", lambda editor: editor.drawing.draft.points == (EMPTY,)),
        (EMPTY, "Begin a horizon here", lambda editor: editor.drawing.draft.name is None),
        (EMPTY, "Hold this block", lambda editor: editor.state.fixed == EMPTY),
        (EMPTY, "Release the held block", lambda editor: editor.state.fixed is None),
        (EMPTY, "Pin this point", lambda editor: editor.state.pins == (EMPTY,)),
    ],
)
def test_each_item_does_what_it_says_and_can_be_undone(drawn, point, label, change):  # noqa: F811
    before, count = drawn.history.document, drawn.history.undo_count
    menu(drawn, point)[label]()
    assert change(drawn)
    if drawn.history.document != before:
        assert drawn.history.undo_count == count + 1
        name = drawn.history.next_undo.label
        menu(drawn, EMPTY)[f"Undo: {name}"]()
        assert drawn.history.document == before


def test_a_line_that_is_being_drawn_is_finished_or_dropped(drawn):  # noqa: F811
    drawn.enter("fault")
    drawn.add(EMPTY)
    drawn.add((700.0, 300.0))
    menu(drawn, FAULT[1])["Remove its last vertex"]()
    assert drawn.drawing.draft.points == (EMPTY,)
    drawn.add((700.0, 300.0))
    menu(drawn, FAULT[1])["Finish the line"]()
    assert drawn.drawing.names("fault") == ("F1", "F2")
    drawn.add((800.0, 300.0))
    menu(drawn, FAULT[1])["Drop the line"]()
    assert drawn.drawing.draft is None


def test_several_selected_pieces_have_actions_of_their_own(drawn):  # noqa: F811
    drawn.select("horizon", "H1")
    assert "Join the 2 selected pieces" not in menu(drawn, EMPTY)
    drawn.change(lambda state: state.choose(state.chosen_pieces))
    menu(drawn, EMPTY)["Join the 2 selected pieces"]()
    assert len(pieces(drawn, "H1", "horizon")) == 1
    drawn.undo()
    drawn.change(lambda state: state.choose(state.change(selection=PickSelection("horizon", "H1")).chosen_pieces))
    menu(drawn, EMPTY)["Delete the 2 selected pieces"]()
    assert drawn.drawing.names("horizon") == ("H2",)


def test_a_regional_level_is_seen_until_it_is_released(drawn):  # noqa: F811
    assert "Release the regional level" not in menu(drawn, EMPTY)
    menu(drawn, EMPTY)["Keep this level (regional)"]()
    (level,) = (stroke for stroke in strokes(drawn.state, PLAIN) if stroke.label == "regional")
    x_min, x_max, *_ = VIEW.section.extent
    assert level.points.tolist() == [[x_min, EMPTY[1]], [x_max, EMPTY[1]]]
    assert drawn.history.next_undo.label == "regional level"
    menu(drawn, EMPTY)["Release the regional level"]()
    assert not [stroke for stroke in strokes(drawn.state, PLAIN) if stroke.label == "regional"]
