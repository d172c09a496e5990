"""What is asked about a section's file before it is opened: fields for what it does not say itself."""

from html import escape

from ipywidgets import HTML, Dropdown, Layout, Text, VBox
from traitlets import Bool

from seiswidgets.errors import SettingError
from seiswidgets.geology import asked
from seiswidgets.geology.section import METRES, SECONDS
from seiswidgets.io.info import SectionInfo

HEIGHTS = {
    "two-way time (ms)": "ms",
    "two-way time (s)": "s",
    "depth (m)": "m",
    "depth (km)": "km",
    "depth (ft)": "ft",
}
VELOCITY, TRACES_APART, SAMPLES_APART = 2000.0, 25.0, 4.0  # usual values, offered where a file says nothing
LINES = ("inline", "crossline", "traces")
EXTENT = ("x_min", "x_max", "z_min", "z_max")
ASSUMED = "Assumed, as the file does not say: {}. Correct what is wrong."
STYLE, WIDE = {"description_width": "110px"}, Layout(width="auto")


class SectionFields(VBox):
    """Fields for the choices of `open_section` that a file needs, filled in with usual values where there are any.

    Attributes
    ----------
    has_volume : bool
        Whether one line of several is to be chosen.
    """

    has_volume = Bool(False)

    def __init__(self):
        super().__init__()
        self.fields = {}
        self._note, self._info = HTML(), None

    def show(self, info: SectionInfo) -> None:
        """Show the fields that this file needs."""
        self._info, self.has_volume = info, info.inlines is not None
        for field in self.fields.values():
            field.close()
        self.fields = {}
        if self.has_volume:
            self._ask_line(info)
        if any("z_unit" in need for need in info.needed):
            self._choose("z_unit", "vertical axis", list(HEIGHTS.items()))
            self._ask("velocity", "velocity (m/s)", VELOCITY)
            self._choose("x_unit", "unit of x", list(METRES))
            self.fields["x_unit"].value = info.x_unit or "m"
            self.fields["z_unit"].observe(self._take_unit, "value")
        if any("extent" in need for need in info.needed):
            self._ask_extent(info)
        elif info.needed:
            self._ask_spacing(info)
        self._note.value = escape(self._assumed())
        self.children = [*self.fields.values(), self._note]

    def choices(self) -> dict:
        """The keywords of `open_section`.

        Raises
        ------
        SettingError
            If a field holds no number where it must.
        """
        said = {name: self._value(name) for name, field in self.fields.items() if field.layout.display != "none"}
        if "line" in said:
            said[said.pop("line")] = said.pop("number")
        if "x_min" in said:
            said["extent"] = [said.pop(name) for name in EXTENT]
        return {name: value for name, value in said.items() if value is not None}

    def _value(self, name):
        value = self.fields[name].value
        if name in ("line", "z_unit", "x_unit"):
            return value
        text = value.strip()
        if name == "number":
            return _line_number(self.fields["line"].value, text)
        if not text and name == "dx" and name not in self._info.needed:
            return None  # as the file says
        return asked.number(name, text)

    def _ask_line(self, info):
        self._choose("line", "line", LINES)
        self._ask("number", "its number", "")
        self.fields["line"].observe(self._take_line, "value")
        self._take_line()

    def _take_line(self, change=None):
        kind = self.fields["line"].value
        if kind == "traces":
            self.fields["number"].value = f"0 to {self._info.shape[1] - 1}"
            return
        first, last, count = self._info.inlines if kind == "inline" else self._info.crosslines
        step = (last - first) / max(count - 1, 1)
        self.fields["number"].value = str(round(first + count // 2 * step))

    def _take_unit(self, change):
        self.fields["velocity"].layout.display = "" if change.new in SECONDS else "none"

    def _ask_extent(self, info):
        reach = (info.shape[1] - 1) * TRACES_APART, (info.shape[0] - 1) * SAMPLES_APART
        for name, value in zip(EXTENT, (0, reach[0], 0, reach[1]), strict=True):
            self._ask(name, f"{name.replace('_', ' ')}imum", value)

    def _ask_spacing(self, info):
        for name, words, usual in (("dx", "traces apart", TRACES_APART), ("dz", "samples apart", SAMPLES_APART)):
            if name in info.needed:
                self._ask(name, words, usual)
        if "dx" not in self.fields:
            self._ask("dx", "traces apart", "")
            self.fields["dx"].placeholder = f"{info.dx:g}, as the file says"
        if "z0" in info.needed:
            self._ask("z0", "first sample at", 0)

    def _assumed(self):
        """In words, which fields hold no more than a usual value."""
        assumed = [field.description for name, field in self.fields.items() if name in ("z_unit", "velocity", *EXTENT)]
        assumed += [self.fields[name].description for name in ("dx", "dz", "z0") if name in self._info.needed]
        return ASSUMED.format(", ".join(assumed)) if assumed else ""

    def _ask(self, name, words, value):
        text = value if isinstance(value, str) else f"{value:g}"
        self.fields[name] = Text(text, description=words, style=STYLE, layout=Layout(width="auto"))

    def _choose(self, name, words, options):
        self.fields[name] = Dropdown(options=options, description=words, style=STYLE, layout=WIDE)


def _line_number(kind, text):
    """The number of a line, or the slice of some traces."""
    first, _, last = text.partition("to")
    try:
        return slice(int(first), int(last) + 1) if kind == "traces" else int(text)
    except ValueError:
        wanted = 'two numbers, as in "0 to 99"' if kind == "traces" else "a whole number"
        raise SettingError(f"the number of the {kind} must be {wanted}, but is {text!r}") from None
