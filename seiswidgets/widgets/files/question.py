"""A question in the app, with a button for each answer."""

from collections.abc import Callable, Mapping, Sequence
from html import escape
from pathlib import Path

from ipywidgets import HTML, Button, HBox, Layout, VBox, Widget
from traitlets import Unicode

from seiswidgets.errors import SeiswidgetsError
from seiswidgets.io.files import make_folder
from seiswidgets.widgets.closing import close_with_parts
from seiswidgets.widgets.files.labels import in_labels
from seiswidgets.widgets.messages import HINT, TROUBLE

MAKE, LEAVE = "Make it", "Leave it"


class Question(VBox):
    """A line of text with the answers to a question below it, visible while there is a text.

    Attributes
    ----------
    text : str
        The text shown; "" if there is none.
    line : HTML
    """

    text = Unicode()

    def __init__(self) -> None:
        self.line, self._answers = HTML(), HBox(layout=Layout(flex_flow="row wrap"))
        super().__init__([self.line, self._answers], layout=Layout(display="none"))

    @property
    def answers(self) -> dict[str, Button]:
        """Buttons of the answers, by description."""
        return {one.description: one for one in self._answers.children if isinstance(one, Button)}

    def ask(self, text: str, answers: Mapping[str, Callable[[], None]], *before: Widget) -> None:
        """Ask a question, with other controls before its answers; an answer removes it and calls its function."""
        self._show(HINT, text, [*before, *(self._button(*answer) for answer in answers.items())])

    def hint(self, text: str) -> None:
        """Show a text in place of the question."""
        self._show(HINT, text)

    def alert(self, text: str) -> None:
        """Show an error message in place of the question, with the panel's labels in place of keywords."""
        self._show(TROUBLE, in_labels(text))

    def has_folder(self, folder: Path, then: Callable[[], None]) -> bool:
        """Return whether a folder exists; if not, offer to make it, and to call a function after that."""

        def make() -> None:
            make_folder(folder)
            then()

        if folder.is_dir():
            return True
        self.ask(f"The folder {folder} does not exist.", {MAKE: lambda: self.attempt(make), LEAVE: lambda: None})
        return False

    def attempt(self, action: Callable[[], None]) -> None:
        """Call a function and show its error, if it raises one."""
        try:
            action()
        except SeiswidgetsError as error:
            self.alert(error.text)

    def _button(self, description: str, action: Callable[[], None]) -> Button:
        def act(_: Button) -> None:
            self.hint("")
            action()

        button = Button(description=description, layout=Layout(width="auto"))
        button.on_click(act)
        return button

    def _show(self, look: str, text: str, controls: Sequence[Widget] = ()) -> None:
        answered = self.answers.values()
        self.text, self.line.value, self._answers.children = text, look.format(escape(text)), controls
        for button in answered:  # or ipywidgets would keep it alive
            close_with_parts(button)
        self.layout.display = "" if text else "none"
