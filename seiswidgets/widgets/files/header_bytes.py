"""At which bytes of SEG-Y's trace header the numbers of lines and the positions stand, where not at the standard's."""

from ipywidgets import HTML, Checkbox, GridBox, Layout, Text, VBox
from traitlets import Dict

from seiswidgets.errors import SettingError
from seiswidgets.io.segy.traces import BYTES
from seiswidgets.widgets.messages import HINT

WORDS = {"scalar": "scalar of x and y"}
MEANING = HINT.format("The byte that each number begins at, counted from 1. Enter shows what the file holds then.")


class HeaderBytes(VBox):
    """Folded away, with the standard's bytes, until it is asked for.

    Attributes
    ----------
    said : dict of str to str
        What was entered, where it is not the standard's byte; nothing while it is folded away.
    """

    said = Dict()

    def __init__(self):
        self.asked = Checkbox(description="other header bytes than the standard's", indent=False)
        self.fields = {name: _field(name, byte) for name, byte in BYTES.items()}
        columns = Layout(grid_template_columns="repeat(auto-fit, minmax(190px, 1fr))")
        self._box = VBox([HTML(MEANING), GridBox(list(self.fields.values()), layout=columns)])
        super().__init__([self.asked, self._box])
        for field in (self.asked, *self.fields.values()):
            field.observe(self._take, "value")
        self._take()

    def rest(self) -> None:
        """Go back to the standard's bytes, folded away."""
        self.asked.value = False
        for name, field in self.fields.items():
            field.value = str(BYTES[name])

    def chosen(self) -> dict[str, int] | None:
        """As `open_section` takes them, None where all are the standard's.

        Raises
        ------
        SettingError
            If one is no whole number.
        """
        return {name: _byte(name, text) for name, text in self.said.items()} or None

    def _take(self, change=None):
        self._box.layout.display = "" if self.asked.value else "none"
        entered = {name: field.value.strip() for name, field in self.fields.items()} if self.asked.value else {}
        self.said = {name: text for name, text in entered.items() if text != str(BYTES[name])}


def _field(name, byte):
    style, layout = {"description_width": "110px"}, Layout(width="auto")
    return Text(str(byte), description=WORDS.get(name, name), continuous_update=False, style=style, layout=layout)


def _byte(name, text):
    try:
        return int(text)
    except ValueError:
        raise SettingError(f"the byte of {WORDS.get(name, name)} must be a whole number, but is {text!r}") from None
