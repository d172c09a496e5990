"""What is asked about a section's file before it is opened: fields for what it does not say itself."""

from html import escape

from ipywidgets import HTML, Dropdown, Layout, Text, VBox

from seiswidgets.errors import SettingError
from seiswidgets.geology import validation
from seiswidgets.geology.findings import worst_first
from seiswidgets.geology.section import METRES, SECONDS
from seiswidgets.io.info import SectionInfo
from seiswidgets.io.segy.reading import PER_MS_OR_M
from seiswidgets.widgets.closing import close_with_parts
from seiswidgets.widgets.files.labels import LABELS, in_labels
from seiswidgets.widgets.messages import HINT

HEIGHTS = {
    "two-way time (ms)": "ms",
    "two-way time (s)": "s",
    "depth (m)": "m",
    "depth (km)": "km",
    "depth (ft)": "ft",
}
VELOCITY, TRACES_APART, SAMPLES_APART = 2000.0, 25.0, 4.0  # usual values, offered where a file says nothing
ALL = "all traces"
LINES = ("inline", "crossline", "traces")
NUMBER = {"inline": "its number", "crossline": "its number", "traces": "counted from 0"}
EXTENT = {"x_min": "left edge", "x_max": "right edge", "z_min": "top", "z_max": "bottom"}
OF_Z = ("dz", "z0", "z_min", "z_max")
OF_X = ("dx", "x_min", "x_max")
KEPT = ("z_unit", "velocity", "x_unit")  # of the same file, when it is looked at again
ASSUMED = "Assumed, as the file does not say: {}. Correct what is wrong."
CROPPED = " The picture must show the section alone: cut its margins off before."
REASON = '<div style="line-height: 1.4">{}.</div>'
STYLE = {"description_width": "130px"}


class SectionFields(VBox):
    """Fields for the choices of `open_section` that a file needs, filled in with usual values where there are any."""

    def __init__(self):
        super().__init__()
        self.fields = {}
        self._note, self._info = HTML(), None

    def show(self, info: SectionInfo) -> None:
        """Show the fields that this file needs."""
        before = self.fields if self._info and self._info.path == info.path else {}
        self._info, self.fields = info, {}
        if info.kind == "SEG-Y":
            self._ask_line()
        if any("z_unit" in need for need in info.needed):
            self._ask_units()
        if any("extent" in need for need in info.needed):
            self._ask_extent()
        elif info.kind == "SEG-Y":
            self._ask_spacing()
        for name in set(KEPT) & set(before) & set(self.fields):
            self.fields[name].value = before[name].value
        self._take_units()
        replaced = [field for field in self.children if field is not self._note]
        self.children = [*self.fields.values(), self._note]
        for field in replaced:  # or ipywidgets would keep it
            close_with_parts(field)

    def choices(self) -> dict:
        """The keywords of `open_section`.

        Raises
        ------
        SettingError
            If a field holds no number where it must.
        """
        said = {name: self._value(name) for name, field in self.fields.items() if field.layout.display != "none"}
        line, number = said.pop("line", ALL), said.pop("number", None)
        if line != ALL:
            said[line] = number
        if "x_min" in said:
            said["extent"] = _extent({name: said.pop(name) for name in EXTENT})
        return {name: value for name, value in said.items() if value is not None}

    def _value(self, name):
        value = self.fields[name].value
        if name in ("line", "z_unit", "x_unit"):
            return value
        text = value.strip()
        if name == "number":
            return _line_number(self.fields["line"].value, text)
        if not text and self._placeholder(name):
            return None  # as the file says
        return validation.finite_number(EXTENT.get(name) or LABELS[name], text)

    def _ask_line(self):
        self._choose("line", "line", LINES if self._info.inlines else (ALL, *LINES))
        self._ask("number", "", "")
        self.fields["line"].observe(self._take_line, "value")
        self._take_line()

    def _take_line(self, change=None):
        kind, number = self.fields["line"].value, self.fields["number"]
        number.layout.display = "none" if kind == ALL else ""
        number.description = NUMBER.get(kind, "")
        if kind in ("inline", "crossline"):
            middle = self._info.middle(kind)
            number.value = "" if middle is None else str(middle)
        elif kind == "traces":
            number.value = f"0 to {self._info.shape[1] - 1}"

    def _ask_units(self):
        self._choose("z_unit", "vertical axis", list(HEIGHTS.items()))
        self._ask("velocity", "velocity (m/s)", VELOCITY)
        self._choose("x_unit", "unit of x", list(METRES))
        self.fields["x_unit"].value = self._info.x_unit or "m"
        for name in ("z_unit", "x_unit"):
            self.fields[name].observe(self._take_units, "value")

    def _ask_extent(self):
        samples, traces = self._info.shape
        reach = (traces - 1) * TRACES_APART, (samples - 1) * SAMPLES_APART
        for (name, words), value in zip(EXTENT.items(), (0, reach[0], 0, reach[1]), strict=True):
            self._ask(name, words, value)

    def _ask_spacing(self):
        for name, usual in (("dx", TRACES_APART), ("dz", SAMPLES_APART), ("z0", 0)):
            self._ask(name, LABELS[name], usual if name in self._info.needed else "")

    def _take_units(self, change=None):
        """Name the units behind what they are of, and say what is assumed."""
        units = {name: self.fields[name].value for name in ("x_unit", "z_unit") if name in self.fields}
        if units:
            self.fields["velocity"].layout.display = "" if units["z_unit"] in SECONDS else "none"
            for name in self.fields.keys() & {*OF_X, *OF_Z}:
                unit = units["x_unit" if name in OF_X else "z_unit"]
                self.fields[name].description = f"{EXTENT.get(name) or LABELS[name]} ({unit})"
                self.fields[name].placeholder = self._placeholder(name)
        self._note.value = self._said()

    def _placeholder(self, name):
        """What the file says, in the units that are chosen; "" where it says nothing."""
        found = None if name in self._info.needed else getattr(self._info, name, None)
        if found is None:
            return ""
        if name == "dx" and self._info.inlines:
            return "as the file says"  # of a volume, what was measured is of its first line
        scale = 1 if name == "dx" else PER_MS_OR_M[self.fields["z_unit"].value]
        return f"{scale * found:g}, as the file says"

    def _said(self):
        """What is not in the file, as HTML: why not, and which fields hold no more than a usual value."""
        reasons = "".join(REASON.format(escape(in_labels(one.text))) for one in worst_first(self._info.findings))
        assumed = []
        if "z_unit" in self.fields:
            assumed += ["vertical axis", *["velocity"] * (self.fields["z_unit"].value in SECONDS)]
            assumed += [] if self._info.x_unit else ["unit of x"]
        assumed += [LABELS[name] for name in ("dx", "dz", "z0") if name in self._info.needed]
        assumed += [words for name, words in EXTENT.items() if name in self.fields]
        cropped = CROPPED if self._info.kind == "picture" else ""
        return reasons + (HINT.format(ASSUMED.format(", ".join(assumed)) + cropped) if assumed else "")

    def _ask(self, name, words, value):
        text = value if isinstance(value, str) else f"{value:g}"
        self.fields[name] = Text(text, description=words, style=STYLE, layout=Layout(width="auto"))

    def _choose(self, name, words, options):
        self.fields[name] = Dropdown(options=options, description=words, style=STYLE, layout=Layout(width="auto"))


def _extent(edges):
    """The edges in their order, each of which must be beyond the one across from it."""
    for low, high in (("x_min", "x_max"), ("z_min", "z_max")):
        if not edges[low] < edges[high]:
            raise SettingError(
                f"the {EXTENT[high]} must be more than the {EXTENT[low]}, {edges[low]:g}, but is {edges[high]:g}"
            )
    return list(edges.values())


def _line_number(kind, text):
    """The number of a line, or the slice of some traces."""
    first, _, last = text.partition("to")
    try:
        return slice(int(first), int(last) + 1) if kind == "traces" else int(text)
    except ValueError:
        wanted = 'two numbers, as in "0 to 99"' if kind == "traces" else "a whole number"
        raise SettingError(f"the number of the {kind} must be {wanted}, but is {text!r}") from None
