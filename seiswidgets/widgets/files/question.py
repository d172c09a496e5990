"""A question in the app, with a button for each answer."""

from collections.abc import Callable, Mapping
from html import escape

from ipywidgets import HTML, Button, HBox, Layout, VBox, Widget
from traitlets import Unicode

from seiswidgets.errors import SeiswidgetsError
from seiswidgets.widgets.closing import close_with_parts
from seiswidgets.widgets.files.labels import in_labels
from seiswidgets.widgets.messages import HINT, TROUBLE


class Question(VBox):
    """A line of text, and below it the answers, as long as it is asked.

    Attributes
    ----------
    text : str
        What is said; "" when nothing is.
    """

    text = Unicode()

    def __init__(self):
        self._line, self._answers = HTML(), HBox(layout=Layout(flex_flow="row wrap"))
        super().__init__([self._line, self._answers], layout=Layout(display="none"))

    @property
    def answers(self) -> dict[str, Button]:
        """The buttons, by what they say."""
        return {one.description: one for one in self._answers.children if isinstance(one, Button)}

    def ask(self, text: str, answers: Mapping[str, Callable[[], None]], *before: Widget) -> None:
        """Ask; an answer takes the question away, and then does what it says. Other controls stand before them."""
        self._say(HINT, text, [*before, *(self._button(*answer) for answer in answers.items())])

    def hint(self, text: str) -> None:
        """Say something, in place of the question."""
        self._say(HINT, text)

    def alert(self, text: str) -> None:
        """Say what is wrong, in place of the question and in the words of the panel."""
        self._say(TROUBLE, in_labels(text))

    def attempt(self, action: Callable[[], None]) -> None:
        """Do something; if that cannot be done, say why."""
        try:
            action()
        except SeiswidgetsError as error:
            self.alert(str(error))

    def _button(self, name, action):
        def act(_):
            self.hint("")
            action()

        button = Button(description=name, layout=Layout(width="auto"))
        button.on_click(act)
        return button

    def _say(self, look, text, controls=()):
        answered = self.answers.values()
        self.text, self._line.value, self._answers.children = text, look.format(escape(text)), controls
        for button in answered:  # or ipywidgets would keep it
            close_with_parts(button)
        self.layout.display = "" if text else "none"
