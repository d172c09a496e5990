"""Fields for the bytes of SEG-Y's trace header that hold line numbers and positions, if not the standard ones."""

from ipywidgets import HTML, Checkbox, GridBox, Layout, Text, VBox
from traitlets import Bunch, Dict

from seiswidgets.errors import SettingError
from seiswidgets.io.segy.traces import BYTES
from seiswidgets.widgets.messages import HINT

LABELS = {"scalar": "scalar of x and y"}
EXPLANATION = HINT.format("First byte of each number, counted from 1. Press Enter to see what the file then contains.")


class HeaderBytes(VBox):
    """A checkbox that unfolds a field for each byte.

    Attributes
    ----------
    entered : dict of str to str
        Text of each field that is not the standard byte; empty while folded.
    unfolded, fields, box : Checkbox, dict of Text, VBox
        Controls.
    """

    entered = Dict()

    def __init__(self) -> None:
        self.unfolded = Checkbox(description="other header bytes than the standard's", indent=False)
        self.fields = {name: _field(name, byte) for name, byte in BYTES.items()}
        columns = Layout(grid_template_columns="repeat(auto-fit, minmax(190px, 1fr))")
        self.box = VBox([HTML(EXPLANATION), GridBox(list(self.fields.values()), layout=columns)])
        super().__init__([self.unfolded, self.box])
        for field in (self.unfolded, *self.fields.values()):
            field.observe(self._take, "value")
        self._take()

    def reset(self) -> None:
        """Fold, and return to the standard bytes."""
        self.unfolded.value = False
        for name, field in self.fields.items():
            field.value = str(BYTES[name])

    def chosen(self) -> dict[str, int] | None:
        """Bytes as for `open_section`, None if all are standard.

        Raises
        ------
        SettingError
            If one is not a whole number.
        """
        return {name: _byte(name, text) for name, text in self.entered.items()} or None

    def _take(self, change: Bunch | None = None) -> None:
        self.box.layout.display = "" if self.unfolded.value else "none"
        texts = {name: field.value.strip() for name, field in self.fields.items()} if self.unfolded.value else {}
        self.entered = {name: text for name, text in texts.items() if text != str(BYTES[name])}


def _field(name: str, byte: int) -> Text:
    style, layout = {"description_width": "110px"}, Layout(width="auto")
    return Text(str(byte), description=LABELS.get(name, name), continuous_update=False, style=style, layout=layout)


def _byte(name: str, text: str) -> int:
    try:
        return int(text)
    except ValueError:
        raise SettingError(f"the byte of {LABELS.get(name, name)} must be a whole number, but is {text!r}") from None
