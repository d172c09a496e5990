"""Corrections of a SEG-Y file's headers: bytes of line numbers and positions, sample format, byte order, revision."""

from typing import Any

from ipywidgets import HTML, Checkbox, Dropdown, GridBox, Layout, Text, VBox
from traitlets import Bunch, Dict

from seiswidgets.errors import SettingError
from seiswidgets.io.options import LAYOUT_OPTIONS
from seiswidgets.io.segy.formats import FORMATS, ORDERS
from seiswidgets.io.segy.traces import FIELDS
from seiswidgets.widgets.files.labels import LABELS
from seiswidgets.widgets.messages import HINT

BYTE_LABELS = {"scalar": "scalar of x and y"}
EXPLANATION = HINT.format(
    "First byte of each number, counted from 1; its kind may follow, as in “181 f4”. Press Enter to see what the file "
    "then contains."
)
STATED = ("as in the file", None)
CHOICES = {
    "sample_format": [STATED, *((each.words, each.name) for each in FORMATS.values())],
    "byte_order": [STATED, *((f"{order}-endian", order) for order in ORDERS)],
    "revision": [STATED, *((str(number), number) for number in (0, 1, 2))],
}


class HeaderBytes(VBox):
    """A checkbox that unfolds a field for each byte, and a choice for each other correction.

    Attributes
    ----------
    entered : dict
        Text of each field that is not the standard byte, and each correction; empty while folded.
    unfolded, fields, box : Checkbox, dict of Text, VBox
        Controls.
    corrections : dict of Dropdown
        Controls of the keywords in ``CHOICES``.
    """

    entered = Dict()

    def __init__(self) -> None:
        self.unfolded = Checkbox(description="other header bytes than the standard's, or another format", indent=False)
        self.fields = {name: _field(name) for name in FIELDS}
        self.corrections = {name: _chooser(name) for name in CHOICES}
        columns = Layout(grid_template_columns="repeat(auto-fit, minmax(190px, 1fr))")
        controls = [*self.fields.values(), *self.corrections.values()]
        self.box = VBox([HTML(EXPLANATION), GridBox(controls, layout=columns)])
        super().__init__([self.unfolded, self.box])
        for field in (self.unfolded, *controls):
            field.observe(self._take, "value")
        self._take()

    def reset(self) -> None:
        """Fold, and return to the standard bytes and the file's own headers."""
        self.unfolded.value = False
        for name, field in self.fields.items():
            field.value = str(FIELDS[name].byte)
        for chooser in self.corrections.values():
            chooser.value = None

    def chosen(self) -> dict[str, Any]:
        """Keywords for `open_section` and `preview`.

        Raises
        ------
        SettingError
            If a byte is not a whole number.
        """
        keywords = {name: value for name, value in self.entered.items() if name in LAYOUT_OPTIONS}
        positions = {name: _byte(name, text) for name, text in self.entered.items() if name in FIELDS}
        return keywords | ({"header_bytes": positions} if positions else {})

    def _take(self, change: Bunch | None = None) -> None:
        self.box.layout.display = "" if self.unfolded.value else "none"
        texts = {name: field.value.strip() for name, field in self.fields.items()}
        entered: dict[str, Any] = {name: text for name, text in texts.items() if text != str(FIELDS[name].byte)}
        entered |= {name: field.value for name, field in self.corrections.items() if field.value is not None}
        self.entered = entered if self.unfolded.value else {}


def _field(name: str) -> Text:
    style, layout = {"description_width": "110px"}, Layout(width="auto")
    label, byte = BYTE_LABELS.get(name, name), str(FIELDS[name].byte)
    return Text(byte, description=label, continuous_update=False, style=style, layout=layout)


def _chooser(name: str) -> Dropdown:
    style, layout = {"description_width": "110px"}, Layout(width="auto")
    return Dropdown(options=CHOICES[name], description=LABELS[name], style=style, layout=layout)


def _byte(name: str, text: str) -> int | tuple[int, str]:
    number, *kind = text.split()
    try:
        return (int(number), kind[0]) if kind else int(number)
    except ValueError:
        wanted = f"the byte of {BYTE_LABELS.get(name, name)} must be a whole number"
        raise SettingError(f"{wanted}, but is {text!r}") from None
