"""A question as a small form: a field for the answer, help on demand, and the feedback."""

from html import escape

from ipywidgets import HTML, Button, HBox, Layout, RadioButtons, Text, VBox

from exercises.question import Choice, Feedback, Number, Question

RIGHT, NOT_YET, HELP = "#009e73", "#d55e00", "#0072b2"  # of a border: distinct to the colour-blind, on light and dark
STEPS = "Hint", "Method", "Show the answer"


class Form(VBox):
    """The form of a question, which readers without a kernel see as its text."""

    def __init__(self, question, *fields):
        self._question = question
        super().__init__([HTML(_asked(question)), *fields])

    def _repr_mimebundle_(self, **kwargs):
        """Add the question as text, for pages where nothing can be answered."""
        bundle = super()._repr_mimebundle_(**kwargs)
        options = [f"<li>{escape(option)}</li>" for option in getattr(self._question, "options", ())]
        text = _asked(self._question) + (f"<ul>{''.join(options)}</ul>" if options else "")
        return bundle and {**bundle, "text/html": text}


def ask(question: Number | Choice) -> Form:
    """The form of a question; the same answers can be checked in code, by ``question.check``."""
    answer, button, feedback = _field(question), Button(description="Check"), HTML(_shown(None))

    def judge(_):
        feedback.value = _shown(question.check(answer.value))

    button.on_click(judge)
    if isinstance(question, Number):  # a text's value changes when the key Enter is pressed
        answer.observe(judge, "value")
    return Form(question, answer, HBox([button, _help_button(question, feedback)]), feedback)


def check(question: Question, given: object) -> Form:
    """Feedback on what a line of code computed, and help; run the cell again after changing the line."""
    feedback = HTML(_shown(question.check(given)))
    return Form(question, HBox([_help_button(question, feedback)]), feedback)


def _help_button(question, feedback):
    """A button that gives a hint, then the method, then the answer: each is sent to the page only when asked for."""
    button = Button(description=STEPS[0])

    def show(_):
        step = STEPS.index(button.description)
        title, text = question.help(step)
        feedback.value = _block(f"{title}.", text, HELP)
        button.description = STEPS[min(step + 1, len(STEPS) - 1)]

    button.on_click(show)
    return button


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
    return _block(verdict, feedback.text, colour)


def _block(title, text, colour):
    look = f"border-left: 4px solid {colour}; padding-left: 8px; line-height: 1.4"
    return f'<p role="status" style="{look}"><b>{title}</b> {escape(text)}</p>'
