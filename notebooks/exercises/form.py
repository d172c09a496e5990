"""A question as a small form: the answer, a button, and the feedback."""

from html import escape

from ipywidgets import HTML, Button, Layout, RadioButtons, Text, VBox

from exercises.question import Choice, Feedback, Number

RIGHT, NOT_YET = "#009e73", "#d55e00"  # of a border only: told apart by the colour-blind, seen on light and dark


class Form(VBox):
    """The form of a question, which readers without a kernel see as its text."""

    def __init__(self, question, *fields):
        self._question = question
        super().__init__([HTML(_asked(question)), *fields])

    def _repr_mimebundle_(self, **kwargs):
        """Beside the form itself what it asks, for pages where nothing can be answered."""
        bundle = super()._repr_mimebundle_(**kwargs)
        options = [f"<li>{escape(option)}</li>" for option in getattr(self._question, "options", ())]
        text = _asked(self._question) + (f"<ul>{''.join(options)}</ul>" if options else "")
        return bundle and {**bundle, "text/html": text}


def ask(question: Number | Choice) -> Form:
    """The form of a question; the same answers can be checked in code, by ``question.check``."""
    answer, button, feedback = _field(question), Button(description="Check"), HTML(_shown(None))

    def check(_):
        feedback.value = _shown(question.check(answer.value))

    button.on_click(check)
    if isinstance(question, Number):  # a text's value changes when the key Enter is pressed
        answer.observe(check, "value")
    return Form(question, answer, button, feedback)


def _asked(question):
    return f"<p><b>Exercise.</b> {escape(question.asked)}</p>"


def _field(question):
    if isinstance(question, Choice):
        return RadioButtons(options=question.options, value=None, description="Answer", layout=Layout(width="auto"))
    label = f"Answer ({question.unit})" if question.unit else "Answer"
    look = {"style": {"description_width": "initial"}, "layout": Layout(width="16em")}
    return Text(description=label, continuous_update=False, **look)


def _shown(feedback: Feedback | None) -> str:
    """HTML of some feedback, in a place that a screen reader reads out when it changes."""
    if feedback is None:
        return '<p role="status"></p>'
    verdict, colour = ("Right.", RIGHT) if feedback.right else ("Not yet.", NOT_YET)
    look = f"border-left: 4px solid {colour}; padding-left: 8px; line-height: 1.4"
    return f'<p role="status" style="{look}"><b>{verdict}</b> {escape(feedback.text)}</p>'
