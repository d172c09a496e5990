"""Judging answers, and the form that asks for them; test_notebooks_browser gives the answers."""

from html import escape

import pytest
from exercises import ask
from exercises.question import Choice, Feedback, Number

HEAVE = Number(
    "How large is the heave?",
    86.6,
    "m",
    1.0,
    "Two legs of a triangle.",
    ((150.0, "The throw."), (173.2, "The slip.")),
    "Draw it.",
)
TERM = Choice(
    "Which term?", "edge length", "It knows sizes.", (("mean value", "Shapes only."), ("contour", "Border only."))
)


SHARE = Number("What share?", 7.3, "%", 0.2, "Before over after.", ((0.0, "Longer."),), "Divide.")
DIP = Number("How steep?", 68.0, "°", 1.5, "Steeper.", (), "Draw it.")
TIMES = Number("How many times?", 4.0, "", 0.3, "Like heat.", (), "Print it.")


@pytest.mark.parametrize("given", [86.6, 87.5, "86", " 86.6 m ", "8.66e1"])
def test_a_number_is_right_within_its_tolerance(given):
    assert HEAVE.check(given).right
    assert HEAVE.check(given).text == "Two legs of a triangle."


@pytest.mark.parametrize(
    ("question", "given"),
    [
        *((HEAVE, given) for given in ("86.6m", "86.6 Metres", "0.0866 km", "8660 cm", "284 ft", "8.66e-2km")),
        *((HEAVE, given) for given in ("86,6", "86,6 m", "~86.6", "≈ 87 m", "+86.6", "260/3", "86.6\u202fm")),
        *((SHARE, given) for given in ("7.3", "7,3 %", "7.3 percent", "7.3 per cent")),
        *((DIP, given) for given in ("68°", "68 deg", "68 degrees", "68.0 °")),
        *((TIMES, given) for given in ("4", "4x", "4 ×", "4 times")),
    ],
)
def test_a_right_number_may_be_written_in_many_ways(question, given):
    assert question.check(given).right


@pytest.mark.parametrize("given", ["-86.6", "−86.6 m", "–86,6", "－86.6"])
def test_a_right_number_with_the_wrong_sign_is_told_so(given):
    assert HEAVE.check(given) == Feedback(False, "That is right but for its sign: leave it out.")


@pytest.mark.parametrize(("given", "told"), [("0.073", "7.3 %"), ("1/8", "12.5 %"), ("0,134", "13.4 %")])
def test_a_share_of_one_is_told_apart_from_percents(given, told):
    assert SHARE.check(given).text.endswith(f"is very little. If you mean a share, it is {told}.")
    assert SHARE.check("0").text == "Longer."


@pytest.mark.parametrize(("given", "hint"), [(150, "The throw."), ("173 m", "The slip."), (172.5, "The slip.")])
def test_a_known_mistake_gets_its_hint(given, hint):
    assert HEAVE.check(given).text == hint
    assert not HEAVE.check(given).right


@pytest.mark.parametrize(
    ("given", "told"), [(500, "500 m is too large. Draw it."), ("−3", "-3 m is too small. Draw it.")]
)
def test_any_other_number_gets_the_general_hint(given, told):
    assert HEAVE.check(given).text == told


@pytest.mark.parametrize(
    "given", ["many", "1e999", "nan", "inf", None, "86 ms", "8_6", "1,086.6", "86.6 %", "1/0", "m"]
)
def test_what_is_no_number_is_said_to_be_none(given):
    feedback = HEAVE.check(given)
    assert not feedback.right
    assert "is no number. Give one, in m" in feedback.text


@pytest.mark.parametrize("given", ["", "  "])
def test_where_nothing_is_given_a_number_is_asked_for(given):
    assert HEAVE.check(given) == Feedback(False, "Give a number, in m, such as 12.5.")


def test_a_mistake_must_be_told_from_the_answer():
    with pytest.raises(ValueError, match="cannot be told from the answer 5"):
        Number("?", 5.0, "m", 1.0, "", ((6.5, "too near"),), "")


def test_a_choice_is_right_or_gets_its_hint():
    assert TERM.check("edge length").right
    assert TERM.check("contour").text == "Border only."
    assert not TERM.check("contour").right
    assert "Choose one of: contour; edge length; mean value" in TERM.check(None).text


def test_options_differ():
    with pytest.raises(ValueError, match="two of the options are the same"):
        Choice("?", "a", "", (("a", "hint"),))


@pytest.mark.parametrize(("question", "right", "wrong"), [(HEAVE, "86.6", "150"), (TERM, "edge length", "contour")])
def test_the_form_shows_the_feedback(question, right, wrong):
    _, answer, button, feedback = ask(question).children
    for given, verdict in ((wrong, "Not yet."), (right, "Right.")):
        answer.value = given
        button.click()
        assert verdict in feedback.value
        assert question.check(given).text in feedback.value


@pytest.mark.parametrize(("question", "told"), [(HEAVE, ["heave"]), (TERM, ["term", "contour", "mean value"])])
def test_readers_without_a_kernel_see_what_is_asked(question, told):
    seen = ask(question)._repr_mimebundle_()
    assert "application/vnd.jupyter.widget-view+json" in seen
    assert all(word in seen["text/html"] for word in told)


@pytest.mark.parametrize(("question", "given", "told"), [(HEAVE, "86.6", "Right."), (TERM, "edge length", "")])
def test_enter_checks_a_number_but_a_choice_waits_for_the_button(question, given, told):
    _, answer, _, feedback = ask(question).children
    before = feedback.value
    answer.value = given  # of a text it changes when Enter is pressed
    assert (told in feedback.value) if told else (feedback.value == before)


def test_the_form_escapes_what_it_shows():
    nasty = "<img src=x onerror=alert(1)>"
    form = ask(Number(nasty, 1.0, "m", 0.1, nasty, (), ""))
    assert nasty not in form._repr_mimebundle_()["text/html"]
    text, answer, button, feedback = form.children
    assert nasty not in text.value
    for given in (nasty, "1"):
        answer.value = given
        button.click()
        assert nasty not in feedback.value
        assert escape(nasty) in feedback.value
