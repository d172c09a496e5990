import numpy as np
import pytest

import seiswidgets as sw
from seiswidgets.interaction.overlay import stroke_points
from seiswidgets.widgets.picker import Picker
from tests.widgets.hands import appear, click, drag_to, draw, keys, press, release, tell

FAULT = [(400.0, 100.0), (450.0, 300.0), (500.0, 500.0)]
LEFT, RIGHT = [(50.0, 250.0), (250.0, 260.0), (430.0, 220.0)], [(470.0, 380.0), (850.0, 390.0)]
NASTY = "<img src=x onerror=alert(1)>"


@pytest.fixture
def section():
    return sw.Section(np.random.default_rng(1).normal(size=(61, 91)), dx=10.0, dz=10.0)


@pytest.fixture
def picker(section):
    picker = Picker(section)
    appear(picker.pane)
    return picker


@pytest.fixture
def drawn(picker):
    picker.mode = "fault"
    draw(picker.pane, *FAULT)
    picker.mode = "horizon"
    draw(picker.pane, *LEFT)
    draw(picker.pane, *RIGHT)
    return picker


def lines(picker):
    return [stroke_points(stroke).tolist() for stroke in picker.pane.layer.strokes if not stroke["dots"]]


def rows(picker, kind):
    """The rows of the list: choose, colour, visible, name, use, delete; and the message."""
    shown = [row for row in picker.list._rows[kind] if row in picker.list.children]
    return [(*row.children[0].children, row.children[1]) for row in shown]


def test_lines_are_drawn_and_told(drawn):
    (fault,), (horizon,) = drawn.interpretation.faults, drawn.interpretation.horizons
    np.testing.assert_allclose(fault.points, FAULT)
    for piece, points in zip(horizon.pieces, (LEFT, RIGHT), strict=True):
        np.testing.assert_allclose(piece, points)
    np.testing.assert_allclose(lines(drawn)[0], FAULT)
    cutoffs = [mark for mark in drawn.pane.layer.marks if mark["kind"] == "cutoff"]
    assert [mark["text"] for mark in cutoffs] == ["1", "1"]


def test_the_rubber_band_starts_at_the_last_vertex(picker):
    picker.mode = "fault"
    click(picker.pane, *FAULT[:2])
    np.testing.assert_allclose(picker.pane.layer.rubber, FAULT[1:2])
    keys(picker.pane, "Escape")
    assert picker.pane.layer.rubber == []


def test_traits_and_screen_follow_each_other(picker):
    told = []
    picker.observe(lambda change: told.append(len(change.new.faults)), "interpretation")
    picks = sw.Interpretation([sw.Fault(FAULT, "F7")], [sw.Horizon(LEFT, name="H7")])
    picker.interpretation = picks
    assert told == [1]
    np.testing.assert_allclose(lines(picker)[0], FAULT)
    keys(picker.pane, "z", modifiers=["ctrl"])
    assert told == [1, 0]
    assert not picker.interpretation.horizons
    picker.fixed = (100.0, 100.0)
    assert [mark["kind"] for mark in picker.pane.layer.marks] == ["held"]
    picker.mode = "block"
    click(picker.pane, (200.0, 200.0))
    assert picker.fixed == pytest.approx((200.0, 200.0))
    with pytest.raises(sw.PickError, match="fixed must be a point"):
        picker.fixed = (1.0, 2.0, 3.0)


def test_dragging_says_so_and_tells_each_place(drawn):
    told = []
    drawn.observe(
        lambda change: told.append((drawn.dragging, change.new.faults[0].points[1].tolist())), "interpretation"
    )
    drawn.mode = "fault"
    press(drawn.pane, FAULT[1])
    assert drawn.dragging
    drag_to(drawn.pane, (460.0, 310.0))
    drag_to(drawn.pane, (470.0, 320.0))
    release(drawn.pane, (470.0, 320.0))
    assert not drawn.dragging
    assert told == [(True, pytest.approx([460.0, 310.0])), (True, pytest.approx([470.0, 320.0]))]


def test_the_picks_of_a_kind_can_be_folded(drawn):
    group = drawn.list.groups["horizon"]
    assert group.description == "Horizons (1)"
    group.click()
    assert not drawn.list.rows("horizon")
    assert drawn.list.rows("fault")
    draw(drawn.pane, (50.0, 500.0), (300.0, 510.0))
    assert not drawn.list.rows("horizon")
    group.click()
    assert list(drawn.list.rows("horizon")) == list(drawn.drawing.names("horizon"))


def test_the_list_names_colours_hides_and_deletes(drawn):
    _, colour, visible, name, use, delete, _ = rows(drawn, "fault")[0]
    name.value = NASTY
    assert drawn.interpretation.faults[0].name == NASTY
    assert drawn.pane.layer.strokes[0]["label"] == NASTY
    colour.value = "#123456"
    assert drawn.pane.layer.strokes[0]["colour"] == "#123456"
    visible.value = False
    assert len(drawn.interpretation.faults) == 1
    assert "fault" not in {stroke["label"] for stroke in drawn.pane.layer.strokes}
    use.value = "carry"
    assert not drawn.interpretation.faults[0].constrains
    assert drawn.workspace.history.next_undo.label == f"carry {NASTY}"
    delete.click()
    assert not drawn.interpretation.faults
    for _ in range(5):
        drawn.editor.undo()
    drawn.refresh()
    assert rows(drawn, "fault")[0][3].value == "F1"
    assert rows(drawn, "fault")[0][4].value == "constrain"
    assert drawn.pane.layer.strokes[0]["colour"] != "#123456"


def test_what_is_wrong_with_a_pick_is_said_beside_it(drawn):
    *_, name, _, _, message = rows(drawn, "fault")[0]
    name.value = " "
    assert "must not be empty" in message.value
    drawn.refresh()
    assert name.value == "F1"
    assert message.layout.display == "none"
    drawn.show_findings([sw.Finding("problem", "odd", f"this one is odd, and {NASTY}", pick="H1")])
    assert rows(drawn, "fault")[0][-1].layout.display == "none"
    *_, message = rows(drawn, "horizon")[0]
    assert "&lt;img" in message.value
    assert NASTY not in message.value
    drawn.mode = "fault"
    draw(drawn.pane, (100, 100), (200, 200), (200, 100), (100, 200))
    assert "crosses itself" in rows(drawn, "fault")[1][-1].value


def test_a_horizon_of_its_own_is_begun_by_the_button(drawn):
    new = drawn.buttons["new"]
    new.click()
    draw(drawn.pane, (50.0, 500.0), (400.0, 510.0))
    assert [len(horizon.pieces) for horizon in drawn.interpretation.horizons] == [2, 1]


def test_horizons_snap_where_that_is_asked_for():
    case = sw.synthetic.sine_fold(noise=0)
    picker = Picker(case.section, mode="horizon", snap="peak", follow=True)
    appear(picker.pane)
    (bed,) = case.interpretation.horizons[1].pieces
    draw(picker.pane, tuple(bed[3] + (0, 12)), tuple(bed[30] - (0, 9)))
    (piece,) = picker.interpretation.horizons[0].pieces
    assert len(piece) > 3
    assert abs(np.interp(piece[:, 0], *bed.T) - piece[:, 1]).max() < case.section.dz
    picker.snap = "off"
    picker.editor.deselect()
    draw(picker.pane, tuple(bed[3] + (0, 80)), tuple(bed[30] + (0, 80)))
    assert len(picker.interpretation.horizons[1].pieces[0]) == 2


def test_all_of_it_by_keyboard(picker):
    keys(picker.pane, "f", "Enter", "ArrowUp", "ArrowUp", " ", "ArrowDown", "ArrowRight", " ", "Enter")
    assert len(picker.interpretation.faults) == 1
    assert [mark["kind"] for mark in picker.pane.layer.marks] == ["cursor"]
    assert picker.mode == "fault"
    keys(picker.pane, "Escape", "Escape")
    assert picker.mode == "look"


def test_picks_to_start_with_cannot_be_undone(section):
    picker = Picker(section, interpretation=sw.Interpretation([sw.Fault(FAULT, "F1")]), fixed=(100.0, 100.0))
    keys(picker.pane, "z", modifiers=["ctrl"])
    assert [fault.name for fault in picker.interpretation.faults] == ["F1"]
    assert picker.fixed == (100.0, 100.0)
    assert picker.buttons["undo"].disabled


def test_undoing_a_finished_line_removes_its_last_edit_and_does_not_reopen_it(drawn):
    drawn.mode = "fault"
    line = np.array([*FAULT, (FAULT[-1][0], FAULT[-1][1] - 100)]) + [200, 0]
    draw(drawn.pane, *line)
    assert [pick.name for pick in drawn.drawing.picks] == ["F1", "H1", "F2"]
    assert drawn.buttons["undo"].tooltip == "Undo: add to F2 (Ctrl+Z)"
    keys(drawn.pane, "z", modifiers=["ctrl"])
    np.testing.assert_allclose(drawn.drawing.pick("fault", "F2").pieces[0], line[:-1])
    assert drawn.drawing.draft is None
    for _ in line[2:-1]:
        keys(drawn.pane, "z", modifiers=["ctrl"])
    assert drawn.buttons["undo"].tooltip == "Undo: draw F2 (Ctrl+Z)"
    keys(drawn.pane, "z", modifiers=["ctrl"])
    assert [pick.name for pick in drawn.drawing.picks] == ["F1", "H1"]
    keys(drawn.pane, *"y" * len(line), modifiers=["ctrl"])
    np.testing.assert_allclose(drawn.drawing.pick("fault", "F2").pieces[0], line)


def test_the_browser_gets_every_vertex_as_a_dot_whatever_the_zoom(section):
    dense = [(100.0 + 2 * number, 300.0) for number in range(100)]
    picker = Picker(section, interpretation=sw.Interpretation(horizons=[sw.Horizon(dense, name="H1")]), mode="horizon")
    appear(picker.pane)
    keys(picker.pane, *["PageDown"] * 8)
    (dots,) = (stroke for stroke in picker.pane.layer.strokes if stroke["dots"])
    assert stroke_points(dots).tolist() == [list(point) for point in dense]
    assert dots["chosen"] == 7


def test_the_line_below_says_what_a_click_will_do(drawn):
    drawn.mode = "look"
    assert "click a line to select it" in drawn.click_line.value
    x, y = drawn.pane.view.to_pixels(FAULT[0]).tolist()
    tell(drawn.pane, "hover", x=x, y=y)
    assert "Click to select F1" in drawn.click_line.value
    drawn.mode = "fault"
    assert "Drag to move this vertex of F1" in drawn.click_line.value


def test_help_is_opened_by_its_key_and_its_button_and_closed_again(drawn):
    assert not drawn.help.is_open
    drawn.children[0]._receive(None, {"name": "?"}, [])
    assert drawn.help.is_open
    assert "Ctrl+click" in drawn.help.children[2].value
    drawn.help.children[0]._receive(None, {"name": "Escape"}, [])
    assert not drawn.help.is_open
    drawn.buttons["help"].click()
    assert drawn.help.is_open


def test_a_right_click_offers_what_can_be_done_there_and_the_choice_is_done(drawn, monkeypatch):
    told = []
    monkeypatch.setattr(drawn.pane.layer, "send", told.append)
    x, y = drawn.pane.view.to_pixels(FAULT[0]).tolist()
    tell(drawn.pane, "menu", x=x, y=y)
    (menu,) = told
    assert (menu["kind"], menu["x"], menu["y"]) == ("menu", x, y)
    tell(drawn.pane, "choose", key=str(menu["labels"].index("Delete F1")))
    assert drawn.drawing.names("fault") == ()
    tell(drawn.pane, "choose", key="0")  # of a menu that is gone
    assert drawn.drawing.names("fault") == ()
    tell(drawn.pane, "menu", x=x, y=y)
    tell(drawn.pane, "choose", key=str(told[-1]["labels"].index("All gestures and keys")))
    assert drawn.help.is_open
