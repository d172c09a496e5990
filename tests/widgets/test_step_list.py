import numpy as np
import pytest
from ipywidgets import Button

import seiswidgets as sw
from seiswidgets.geology.steps import FLATTEN, UNFAULT

EVIL = "<img src=x onerror=alert(1)>"
F1, F2 = (sw.Fault([[x, 0], [x, 9]], name) for x, name in ((1, "F1"), (2, EVIL)))
H1, H2 = (sw.Horizon([[0, z], [9, z]], name=name) for z, name in ((1, "H1"), (2, "H2")))
PICKS = sw.Interpretation([F1, F2], [H1, H2])


@pytest.fixture
def steps():
    return sw.StepList(interpretation=PICKS, z_unit="ms")


@pytest.fixture
def told(steps):
    """The steps of all notifications."""
    heard = []
    steps.observe(lambda change: heard.append(change.new), "steps")
    return heard


@pytest.fixture
def focused(monkeypatch):
    """The buttons that were given the focus."""
    buttons = []
    monkeypatch.setattr(Button, "focus", lambda button: buttons.append(button))
    return buttons


def rows(steps):
    return steps.rows


def adders(steps):
    return list(steps.add_buttons.values())


def labels(row):
    return [label for label, _ in row.choice.options]


def test_it_begins_with_the_steps_of_a_plan(steps):
    assert steps.steps == sw.Plan().steps
    assert [row.enabled.description for row in rows(steps)] == [UNFAULT, FLATTEN]
    assert [row.datum.layout.display for row in rows(steps)] == ["none", ""]
    assert [row.beyond.layout.display for row in rows(steps)] == ["none", ""]


def test_choices_are_the_picks_that_there_are_as_text(steps):
    unfault, flatten = rows(steps)
    assert labels(unfault) == ["all faults", "F1", EVIL]
    assert labels(flatten) == ["first horizon", "H1", "H2"]


def test_each_control_changes_its_step_once(steps, told):
    unfault, flatten = rows(steps)
    unfault.choice.value = (EVIL,)
    flatten.enabled.value = False
    flatten.datum.value = " 1500.5 "
    flatten.choice.value = ("H2",)
    assert len(told) == 4
    assert steps.steps == (sw.Step(UNFAULT, (EVIL,)), sw.Step(FLATTEN, ("H2",), 1500.5, on=False))
    flatten.datum.value = ""
    flatten.choice.value = ()
    flatten.beyond.value = "keep"
    assert steps.steps[1] == sw.Step(FLATTEN, on=False, beyond="keep")


def test_steps_set_from_code_are_shown_with_one_notification(steps, told):
    asked = (sw.Step(FLATTEN, ("H1",), 0.1, on=False), sw.Step(UNFAULT, ("F1",)), sw.Step(FLATTEN, ("H2",), 1500))
    steps.steps = asked
    assert told == [asked]
    assert [row.step for row in rows(steps)] == list(asked)
    assert [row.datum.value for row in rows(steps)] == ["0.1", "", "1500"]
    assert [row.choice.value for row in rows(steps)] == [("H1",), ("F1",), ("H2",)]
    assert [row.enabled.value for row in rows(steps)] == [False, True, True]


def test_rows_are_used_again(steps):
    before = rows(steps)
    steps.steps = (*steps.steps[::-1], sw.Step(UNFAULT))
    assert rows(steps)[:2] == before
    steps.steps = steps.steps[:1]
    steps.steps = steps.steps * 2
    assert rows(steps) == before


def test_a_row_that_is_gone_is_not_listened_to(steps):
    gone = rows(steps)[1]
    steps.steps = steps.steps[:1]
    gone.datum.value = "12"
    assert steps.steps == (sw.Step(UNFAULT),)


def test_a_step_that_moves_takes_the_focus_along(steps, told, focused):
    steps.steps = (sw.Step(UNFAULT), sw.Step(FLATTEN, datum=5), sw.Step(FLATTEN))
    told.clear()
    rows(steps)[2].up.click()
    assert [step.datum for step in steps.steps] == [None, None, 5]
    assert focused.pop() is rows(steps)[1].up
    rows(steps)[1].up.click()
    assert [step.kind for step in steps.steps] == [FLATTEN, UNFAULT, FLATTEN]
    assert focused.pop() is rows(steps)[0].down  # its Up is disabled there
    rows(steps)[0].down.click()
    assert focused.pop() is rows(steps)[1].down
    assert len(told) == 3


def test_the_first_cannot_go_up_nor_the_last_down(steps):
    assert [(row.up.disabled, row.down.disabled) for row in rows(steps)] == [(True, False), (False, True)]
    adders(steps)[0].click()
    assert [(row.up.disabled, row.down.disabled) for row in rows(steps)[1:]] == [(False, False), (False, True)]


def test_add_and_remove(steps, told, focused):
    adders(steps)[1].click()
    adders(steps)[0].click()
    assert [step.kind for step in steps.steps] == [UNFAULT, FLATTEN, FLATTEN, UNFAULT]
    rows(steps)[1].remove.click()
    assert [step.kind for step in steps.steps] == [UNFAULT, FLATTEN, UNFAULT]
    assert focused.pop() is rows(steps)[1].remove
    for _ in range(3):
        rows(steps)[-1].remove.click()
    assert steps.steps == ()
    assert rows(steps) == ()
    assert focused[-1] is adders(steps)[0]
    adders(steps)[0].click()
    assert steps.steps == (sw.Step(UNFAULT),)
    assert len(told) == 7


@pytest.mark.parametrize("entry", ["abc", "12 m", "nan", "1e999", "<b>"])
def test_a_wrong_datum_is_said_beside_it_and_the_last_good_one_kept(steps, told, entry):
    row = rows(steps)[1]
    row.datum.value = "1500"
    row.datum.value = entry
    assert steps.steps[1].datum == 1500
    assert len(told) == 1
    assert row.datum.value == entry
    assert row.error.layout.display == ""
    assert "datum must be a finite number" in row.error.value
    assert "1500 ms is kept" in row.error.value
    assert "<b>" not in row.error.value
    row.datum.value = "1600"
    assert row.error.layout.display == "none"
    assert steps.steps[1].datum == 1600


def test_the_datum_is_labelled_with_its_unit(steps):
    assert rows(steps)[1].datum.description == "datum (ms)"
    steps.z_unit = "m"
    assert rows(steps)[1].datum.description == "datum (m)"


def test_a_datum_loses_no_digits(steps, told):
    datum = float(np.random.default_rng(0).uniform(1000, 2000))
    steps.steps = (sw.Step(FLATTEN, datum=datum),)
    assert float(rows(steps)[0].datum.value) == datum
    assert len(told) == 1


def test_picks_that_are_gone_stay_in_the_step_and_are_shown_as_missing(steps, told):
    unfault, flatten = rows(steps)
    unfault.choice.value, flatten.choice.value = ("F1",), ("H2",)
    asked = steps.steps
    told.clear()
    steps.interpretation = sw.Interpretation([F2], [H2])
    assert steps.steps == asked
    assert told == []
    assert labels(unfault) == ["all faults", EVIL, "missing: F1"]
    assert unfault.choice.label == "missing: F1"
    assert labels(flatten) == ["first horizon", "H2"]
    steps.interpretation = PICKS
    assert labels(unfault) == ["all faults", "F1", EVIL]
    assert unfault.choice.value == ("F1",)


def test_several_picks_are_one_more_choice(steps):
    steps.steps = (sw.Step(UNFAULT, ("F1", "F9")),)
    (row,) = rows(steps)
    assert row.choice.label == "F1, missing: F9"
    row.choice.value = ()
    assert steps.steps == (sw.Step(UNFAULT),)
    assert labels(row) == ["all faults", "F1", EVIL]


def test_what_is_being_typed_survives_new_picks(steps):
    row = rows(steps)[1]
    row.datum.value = "12x"
    steps.interpretation = sw.Interpretation([F1], [H1])
    assert row.datum.value == "12x"
    assert row.error.value


def test_what_is_no_step_is_refused(steps):
    with pytest.raises(sw.SettingError, match=r"steps must be seiswidgets\.Step"):
        steps.steps = ("unfault",)
    assert steps.steps == sw.Plan().steps


def test_every_button_says_what_it_does(steps):
    row = rows(steps)[0]
    assert all(button.icon and button.tooltip for button in (row.up, row.down, row.remove, *adders(steps)))


def test_steps_through_time_show_what_they_need(steps):
    steps.steps = (
        sw.Step("strip", ("H1",), age=5.0),
        sw.Step("unerode", datum=-100.0),
        sw.Step("decompact", age=5.0),
        sw.Step("flatten", ("H1",), [(0, 10), (9, 30)], by="vertical shear", age=5.0),
    )
    shown = [
        [name for name in ("choice", "datum", "beyond", "by", "age") if getattr(row, name).layout.display != "none"]
        for row in rows(steps)
    ]
    assert shown == [["choice", "age"], ["datum", "age"], ["age"], ["choice", "datum", "by", "age"]]
    rows(steps)[2].age.value = "6.5"
    assert steps.steps[2].age == 6.5
    rows(steps)[2].age.value = "old"
    assert "age must be a finite number" in rows(steps)[2].error.value
    rows(steps)[1].datum.value = ""
    assert "-100 ms is kept" in rows(steps)[1].error.value
    assert steps.steps[3].datum == ((0, 10), (9, 30))
    steps.add_buttons["strip"].click()
    assert steps.steps[-1] == sw.Step("strip")
