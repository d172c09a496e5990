"""Judging answers, and the form that asks for them; test_notebooks_browser gives the answers."""

from html import escape
from math import radians, tan

import numpy as np
import pytest
from exercises import ask, check
from exercises.question import Choice, Code, Feedback, Number
from ipywidgets.embed import dependency_state

HEAVE = Number(
    "How large is the heave?",
    86.6,
    "m",
    1.0,
    "Two legs of a triangle.",
    ((150.0, "The throw."), (173.2, "The slip.")),
    "Draw it.",
    "Use the tangent.",
)
TERM = Choice(
    "Which term?",
    "edge length",
    "It knows sizes.",
    (("mean value", "Shapes only."), ("contour", "Border only.")),
    "Look.",
    "Compare.",
)
SHARE = Number(
    "What share?", 7.3, "%", 0.2, "Before over after.", ((0.0, "Longer."), (13.4, "Limb.")), "Think.", "Divide."
)
DIP = Number("How steep?", 68.0, "°", 1.5, "Steeper.", ((32.0, "True."),), "Draw it.", "Multiply.")
TIMES = Number("How many times?", 4.0, "", 0.3, "Like heat.", (), "Bars.", "Print it.")
WAIT = Number("How long?", 250.0, "ms", 5.0, "Two-way.", ((500.0, "One-way."),), "Halve.", "Divide.")
SLOPE = Code(
    "Write it.",
    lambda throw, dip: throw / tan(radians(dip)),
    "return throw / np.tan(np.radians(dip))",
    ((100.0, 60.0), (50.0, 30.0)),
    "Legs.",
    ((lambda throw, dip: throw * tan(radians(dip)), "Other way round."),),
    "Draw.",
    "Divide by the tangent.",
)
SOLVED = {HEAVE: "86.6", TERM: "edge length", SHARE: "7.3", DIP: "68", TIMES: "4", WAIT: "250", SLOPE: "np.radians"}


@pytest.mark.parametrize("given", [86.6, 87.5, np.float64(86.6), "86", " 86.6 m ", "8.66e1"])
def test_a_number_is_right_within_its_tolerance(given):
    assert HEAVE.check(given) == Feedback(True, "Two legs of a triangle.")


@pytest.mark.parametrize(
    ("question", "given"),
    [
        *((HEAVE, given) for given in ("86.6m", "86.6 Metres", "0.0866 km", "8660 cm", "284 ft", "8.7e-2km", "0.0866")),
        *((HEAVE, given) for given in ("86,6", "86,6 m", "~86.6", "≈ 87 m", "+86.6", "260/3", "86.6\u202fm")),
        *((SHARE, given) for given in ("7.3", "7,3 %", "7.3 percent", "7.3 per cent", "0.073", ".073", 0.073, "8/110")),
        *((DIP, given) for given in ("68°", "68 deg", "68 degrees", "68.0 °", "1.187", "1.187 rad", "1.19 radians")),
        *((TIMES, given) for given in ("4", "4x", "4 ×", "4 times", "400 %", "400 percent")),
        *((WAIT, given) for given in ("250", "250 ms", "0.25 s", "0.25", "0.25 seconds")),
    ],
)
def test_a_right_number_may_be_written_in_many_ways(question, given):
    assert question.check(given).right


@pytest.mark.parametrize("given", ["-86.6", "−86.6 m", "–86,6", "－86.6"])
def test_a_right_number_with_the_wrong_sign_gets_a_hint(given):
    assert HEAVE.check(given) == Feedback(False, "That is right but for its sign: leave it out.")


@pytest.mark.parametrize(
    ("question", "given", "hint"),
    [
        *((HEAVE, given, "The throw.") for given in (150, "0.15 km", "0.15", "492 ft")),
        *((HEAVE, given, "The slip.") for given in ("173 m", 172.5, "568 feet")),
        *((SHARE, given, "Limb.") for given in ("13.4", "0.134", "0,134", "13.4 %")),
        (SHARE, "0", "Longer."),
        (DIP, "0.5585", "True."),
        (DIP, "0.56 rad", "True."),
        (WAIT, "0.5 s", "One-way."),
    ],
)
def test_a_known_mistake_gets_its_hint_in_any_unit(question, given, hint):
    feedback = question.check(given)
    assert not feedback.right
    assert feedback.text.endswith(hint)


@pytest.mark.parametrize(
    ("question", "given", "text"),
    [
        (HEAVE, 500, "500 m is too large. Use the tangent."),
        (HEAVE, "−3", "-3 m is too small. Use the tangent."),
        (SHARE, "1/8", "Read as a share of 1, that is 12.5 %. 12.5 % is too large. Divide."),
        (SHARE, "0.5", "Read as a share of 1, that is 50 %. 50 % is too large. Divide."),
        (DIP, "0.9 rad", "That is 51.57°. 51.57° is too small. Multiply."),
    ],
)
def test_any_other_number_is_too_large_or_too_small(question, given, text):
    assert question.check(given) == Feedback(False, text)


@pytest.mark.parametrize(
    ("question", "given", "said"),
    [
        (DIP, "15 m", "15 m is a length; asked is an angle, in °."),
        (HEAVE, "86 ms", "86 ms is a time; asked is a length, in m."),
        (HEAVE, "86.6 %", "86.6 % is a share; asked is a length, in m."),
        (SHARE, "7.3°", "7.3° is an angle; asked is a share, in %."),
        (TIMES, "4 km", "4 km is a length; asked is a plain number."),
        (HEAVE, "86 parsecs", "The unit of '86 parsecs' is unknown; asked is a length, in m."),
    ],
)
def test_a_unit_of_the_wrong_kind_is_named(question, given, said):
    assert question.check(given) == Feedback(False, said)


@pytest.mark.parametrize("given", ["many", "1e999", "nan", "inf", None, "8_6", "1,086.6", "1/0", "m", [1, 2]])
def test_other_text_is_no_number(given):
    feedback = HEAVE.check(given)
    assert not feedback.right
    assert "is not a number. Give one, in m" in feedback.text


@pytest.mark.parametrize(("given", "said"), [("", "Give a number, in m, such as 12.5."), (..., "Replace the dots")])
def test_an_empty_answer_is_asked_for(given, said):
    assert HEAVE.check(given).text.startswith(said)


def test_a_mistake_must_differ_from_the_answer():
    with pytest.raises(ValueError, match="cannot be told from the answer 5"):
        Number("?", 5.0, "m", 1.0, "", ((6.5, "too near"),), "", "")


def test_a_choice_is_right_or_gets_its_hint():
    assert TERM.check("edge length").right
    assert TERM.check("contour") == Feedback(False, "Border only.")
    assert "Choose one of: contour; edge length; mean value" in TERM.check(None).text


def test_options_differ():
    with pytest.raises(ValueError, match="two of the options are the same"):
        Choice("?", "a", "", (("a", "hint"),), "", "")


def undefined(throw, dip):
    return throw / tangent(dip)  # noqa: F821 - as a student may write it


@pytest.mark.parametrize(
    ("given", "said"),
    [
        (..., "Replace the dots"),
        (lambda throw, dip: ..., "Replace the dots"),
        (86.6, "Give the function itself, without brackets; this is 86.6."),
        (lambda throw, dip: None, "returns nothing; begin the line with return."),
        (lambda throw, dip: "steep", "returns steep, which is not a number."),
        (lambda throw, dip: [throw, dip], "returns an array of shape (2,), but one number is wanted"),
        (lambda throw, dip: np.inf, "Is something divided by zero?"),
        (undefined, "undefined(100, 60) raised NameError"),
        (lambda throw: throw, "It must take 2 arguments"),
        (lambda throw, dip: throw * tan(radians(dip)), "Other way round."),
        (lambda throw, dip: -throw / tan(radians(dip)), "its sign is the opposite"),
        (lambda throw, dip: throw / tan(radians(dip)) / 1000, "1000 times too small"),
        (lambda throw, dip: throw / tan(radians(60)), "right in 1 of 2 cases. Divide by the tangent."),
        (lambda throw, dip: 0, "right in none of 2 cases"),
    ],
)
def test_a_line_of_code_is_run_and_gets_a_kind_word(given, said):
    feedback = SLOPE.check(given)
    assert not feedback.right
    assert said in feedback.text


def test_a_right_line_of_code_is_right():
    assert SLOPE.check(lambda throw, dip: np.divide(throw, np.tan(np.deg2rad(dip)))) == Feedback(True, "Legs.")


@pytest.mark.parametrize("question", SOLVED, ids=lambda question: question.text)
def test_objects_do_not_print_their_solutions(question):
    seen = f"{question!r} {question} {vars(question)}"
    assert SOLVED[question] not in seen
    assert all(question.help(step)[1] not in seen for step in range(3))


@pytest.mark.parametrize("question", [HEAVE, SLOPE], ids=lambda question: question.text)
def test_pages_hold_the_solution_only_after_it_was_asked_for(question):
    form = ask(question) if isinstance(question, Number) else check(question, ...)
    (button,) = [one for one in form.children[-2].children if one.description == "Hint"]
    feedback = form.children[-1]
    for step, title in enumerate(("Hint.", "Method.", "Answer.")):
        assert SOLVED[question] not in str(dependency_state(form))
        button.click()
        assert title in feedback.value
        assert escape(question.help(step)[1]) in feedback.value
    assert SOLVED[question] in feedback.value


@pytest.mark.parametrize(("question", "right", "wrong"), [(HEAVE, "86.6", "150"), (TERM, "edge length", "contour")])
def test_the_form_shows_the_feedback(question, right, wrong):
    _, answer, buttons, feedback = ask(question).children
    for given, verdict in ((wrong, "Not yet."), (right, "Right.")):
        answer.value = given
        buttons.children[0].click()
        assert verdict in feedback.value
        assert question.check(given).text in feedback.value


def test_a_line_of_code_is_judged_by_its_cell():
    assert "Replace the dots" in check(SLOPE, ...).children[-1].value
    assert "Right." in check(HEAVE, 86.6).children[-1].value


@pytest.mark.parametrize(("question", "told"), [(HEAVE, ["heave"]), (TERM, ["term", "contour", "mean value"])])
def test_readers_without_a_kernel_see_the_question(question, told):
    seen = ask(question)._repr_mimebundle_()
    assert "application/vnd.jupyter.widget-view+json" in seen
    assert all(word in seen["text/html"] for word in told)


@pytest.mark.parametrize(("question", "given", "told"), [(HEAVE, "86.6", "Right."), (TERM, "edge length", "")])
def test_enter_checks_a_number_but_a_choice_waits_for_the_button(question, given, told):
    _, answer, _, feedback = ask(question).children
    before = feedback.value
    answer.value = given  # of a text it changes when Enter is pressed
    assert (told in feedback.value) if told else (feedback.value == before)


def test_the_form_escapes_its_texts():
    nasty = "<img src=x onerror=alert(1)>"
    form = ask(Number(nasty, 1.0, "m", 0.1, nasty, (), "", ""))
    assert nasty not in form._repr_mimebundle_()["text/html"]
    text, answer, buttons, feedback = form.children
    assert nasty not in text.value
    for given in (nasty, "1"):
        answer.value = given
        buttons.children[0].click()
        assert nasty not in feedback.value
        assert escape(nasty) in feedback.value
