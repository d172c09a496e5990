"""Fields for the properties of a section that its file does not state."""

import contextlib
from collections.abc import Callable, Sequence
from html import escape
from typing import Any

from ipywidgets import HTML, Dropdown, Layout, Text, VBox, Widget
from traitlets import Bunch

from seiswidgets.errors import SettingError
from seiswidgets.geology import validation
from seiswidgets.geology.findings import worst_first
from seiswidgets.geology.section import METRES, SECONDS
from seiswidgets.io.info import SectionInfo
from seiswidgets.io.segy.formats import FORMATS
from seiswidgets.io.segy.reading import PER_MS_OR_M
from seiswidgets.widgets.closing import close_with_parts
from seiswidgets.widgets.files.labels import LABELS, in_labels
from seiswidgets.widgets.messages import HINT

VERTICAL_AXES = {
    "two-way time (ms)": "ms",
    "two-way time (s)": "s",
    "depth (m)": "m",
    "depth (km)": "km",
    "depth (ft)": "ft",
}
VELOCITY, TRACES_APART, SAMPLES_APART = 2000.0, 25.0, 4.0  # offered if the file states none
ALL = "all traces"
LINES = ("inline", "crossline", "traces")
NUMBER = {"inline": "inline number", "crossline": "crossline number", "traces": "counted from 0"}
EXTENT = {"x_min": "left edge", "x_max": "right edge", "z_min": "top", "z_max": "bottom"}
OF_Z = ("dz", "z0", "z_min", "z_max")
OF_X = ("dx", "x_min", "x_max")
KEPT = ("z_unit", "velocity", "x_unit")  # when the same file is previewed again
ASSUMED = "Assumed, since the file does not state it: {}. Correct it if necessary."
CROPPED = " If the picture shows more than the section, crop it and calibrate its axes on the picture."
REASON = '<div style="line-height: 1.4">{}.</div>'
STYLE = {"description_width": "130px"}


class SectionFields(VBox):
    """Fields for the keywords of `open_section` that a file needs, filled with usual values.

    Attributes
    ----------
    fields : dict of str to Text or Dropdown
        By keyword; "line" and "number" select a line, "x_min" to "z_max" are its extent.
    note : HTML
        Findings about the file, and the values that are assumed.
    rescale : callable(axis, factor)
        Called when the unit of "x" or "z" changes, to convert other numbers; may be set.
    """

    children: tuple[Widget, ...]

    def __init__(self) -> None:
        super().__init__()
        self.fields: dict[str, Text | Dropdown] = {}
        self.note = HTML()
        self.rescale: Callable[[str, float], None] = lambda axis, scale: None
        self._info: SectionInfo | None = None

    def show(self, info: SectionInfo) -> None:
        """Show the fields that a file needs."""
        before = self.fields if self._info and self._info.path == info.path else {}
        self._info, self.fields = info, {}
        if info.kind == "SEG-Y":
            self._add_line(info)
            self._add_doubts(info)
        if any("z_unit" in need for need in info.needed):
            self._add_units(info)
        if any("extent" in need for need in info.needed):
            self._add_extent(info)
        elif info.kind == "SEG-Y":
            self._add_spacing(info)
        for name in set(KEPT) & set(before) & set(self.fields):
            self.fields[name].value = before[name].value
        self._update_units()
        replaced = [field for field in self.children if field is not self.note]
        self.children = (*self.fields.values(), self.note)
        for field in replaced:  # or ipywidgets would keep it alive
            close_with_parts(field)

    def choices(self) -> dict[str, Any]:
        """Keywords of `open_section`.

        Raises
        ------
        SettingError
            If a field that needs a number does not contain one.
        """
        choices = {name: self._value(name) for name in self.fields if self._is_shown(name)}
        line, number = choices.pop("line", ALL), choices.pop("number", None)
        if line != ALL:
            choices[line] = number
        if "x_min" in choices:
            choices["extent"] = _extent({name: choices.pop(name) for name in EXTENT})
        return {name: value for name, value in choices.items() if value is not None}

    def offer_extent(self, offered: bool) -> None:
        """Show the fields of the extent, or hide them where it follows from a calibration."""
        for name in self.fields.keys() & set(EXTENT):
            self.fields[name].layout.display = "" if offered else "none"
        self._update_units()

    def _is_shown(self, name: str) -> bool:
        return self.fields[name].layout.display != "none"

    def _value(self, name: str) -> Any:
        value = self.fields[name].value
        if name in ("line", "z_unit", "x_unit", "sample_format"):
            return value
        text = value.strip()
        if name in ("number", "offset"):
            return _line_number(self.fields["line"].value if name == "number" else name, text)
        if not text and self._placeholder(name):
            return None  # as in the file
        return validation.finite_number(EXTENT.get(name) or LABELS[name], text)

    def _add_line(self, info: SectionInfo) -> None:
        self._add_choice("line", "line", LINES if info.inlines else (ALL, *LINES))
        self._add_text("number", "", "")
        self.fields["line"].observe(lambda change: self._update_number(info), "value")
        self._update_number(info)

    def _update_number(self, info: SectionInfo) -> None:
        """Offer the middle line of a volume, or all traces."""
        kind, number = self.fields["line"].value, self.fields["number"]
        number.layout.display = "none" if kind == ALL else ""
        number.description = NUMBER.get(kind, "")
        if "offset" in self.fields:
            self.fields["offset"].layout.display = "none" if kind == "traces" else ""
        if kind in ("inline", "crossline"):
            middle = info.middle(kind)
            number.value = "" if middle is None else str(middle)
        elif kind == "traces":
            number.value = f"0 to {info.shape[1] - 1}"

    def _add_doubts(self, info: SectionInfo) -> None:
        """Ask for an offset before stack, and for a doubtful sample format, the likelier one first."""
        if info.offsets:
            self._add_text("offset", LABELS["offset"], info.offsets[0])
        if "sample_format" in info.needed:
            names = {each.name: each.words for each in FORMATS.values()}
            self._add_choice("sample_format", LABELS["sample_format"], [(names[n], n) for n in info.sample_formats])

    def _add_units(self, info: SectionInfo) -> None:
        self._add_choice("z_unit", "vertical axis", list(VERTICAL_AXES.items()))
        self._add_text("velocity", "velocity (m/s)", VELOCITY)
        self._add_choice("x_unit", "unit of x", list(METRES))
        self.fields["x_unit"].value = info.x_unit or "m"
        for name in ("z_unit", "x_unit"):
            self.fields[name].observe(self._take_unit, "value")

    def _take_unit(self, change: Bunch) -> None:
        """Convert the numbers typed to the unit that was chosen."""
        is_x = change.owner is self.fields["x_unit"]
        scale = _factor(change.old, change.new)
        for name in self.fields.keys() & {*(OF_X if is_x else OF_Z)}:
            with contextlib.suppress(ValueError):  # empty, or not a number yet
                self.fields[name].value = f"{float(self.fields[name].value) * scale:.12g}"
        self.rescale("x" if is_x else "z", scale)
        self._update_units()

    def _add_extent(self, info: SectionInfo) -> None:
        samples, traces = info.shape
        width, height = (traces - 1) * TRACES_APART, (samples - 1) * SAMPLES_APART
        for (name, label), value in zip(EXTENT.items(), (0, width, 0, height), strict=True):
            self._add_text(name, label, value)

    def _add_spacing(self, info: SectionInfo) -> None:
        for name, usual in (("dx", TRACES_APART), ("dz", SAMPLES_APART), ("z0", 0)):
            self._add_text(name, LABELS[name], usual if name in info.needed else "")

    def _update_units(self) -> None:
        """Show the units in the labels, and what is assumed."""
        units = {name: self.fields[name].value for name in ("x_unit", "z_unit") if name in self.fields}
        if units:
            self.fields["velocity"].layout.display = "" if units["z_unit"] in SECONDS else "none"
            for name in self.fields.keys() & {*OF_X, *OF_Z}:
                unit = units["x_unit" if name in OF_X else "z_unit"]
                self.fields[name].description = f"{EXTENT.get(name) or LABELS[name]} ({unit})"
                self.fields[name].placeholder = self._placeholder(name)
        self.note.value = "" if self._info is None else self._note(self._info)

    def _placeholder(self, name: str) -> str:
        """Value stated in the file, in the chosen units; "" if there is none."""
        info = self._info
        value = None if info is None or name in info.needed else getattr(info, name, None)
        if info is None or value is None:
            return ""
        if name == "dx" and info.inlines:
            return "as in the file"  # the spacing of a volume was measured along its first line only
        scale = 1 if name == "dx" else PER_MS_OR_M[self.fields["z_unit"].value]
        return f"{scale * value:g}, as in the file"

    def _note(self, info: SectionInfo) -> str:
        """HTML of the findings about a file, and of the values that are assumed."""
        findings = "".join(REASON.format(escape(in_labels(one.text))) for one in worst_first(info.findings))
        assumed: list[str] = []
        if "z_unit" in self.fields:
            assumed += ["vertical axis", *["velocity"] * (self.fields["z_unit"].value in SECONDS)]
            assumed += [] if info.x_unit else ["unit of x"]
        assumed += [LABELS[name] for name in ("offset", "sample_format", "dx", "dz", "z0") if name in info.needed]
        assumed += [label for name, label in EXTENT.items() if name in self.fields and self._is_shown(name)]
        cropped = CROPPED if info.kind == "picture" else ""
        return findings + (HINT.format(ASSUMED.format(", ".join(assumed)) + cropped) if assumed else "")

    def _add_text(self, name: str, label: str, value: float | str) -> None:
        text = value if isinstance(value, str) else f"{value:g}"
        self.fields[name] = Text(text, description=label, style=STYLE, layout=Layout(width="auto"))

    def _add_choice(self, name: str, label: str, options: Sequence) -> None:
        self.fields[name] = Dropdown(options=options, description=label, style=STYLE, layout=Layout(width="auto"))


def _factor(old: str, new: str) -> float:
    """Factor that converts a number to another unit; from time to depth, milliseconds become metres."""
    for sizes in (SECONDS, METRES):
        if old in sizes and new in sizes:
            return sizes[old] / sizes[new]
    return PER_MS_OR_M[new] / PER_MS_OR_M[old]


def _extent(edges: dict[str, float]) -> list[float]:
    """Extent of a section from its edges; right must be more than left, and bottom more than top."""
    for low, high in (("x_min", "x_max"), ("z_min", "z_max")):
        if not edges[low] < edges[high]:
            raise SettingError(
                f"the {EXTENT[high]} must be more than the {EXTENT[low]}, {edges[low]:g}, but is {edges[high]:g}"
            )
    return list(edges.values())


def _line_number(kind: str, text: str) -> int | slice:
    """Parse the number of a line, or a range of traces."""
    first, _, last = text.partition("to")
    try:
        return slice(int(first), int(last) + 1) if kind == "traces" else int(text)
    except ValueError:
        wanted = 'two numbers, as in "0 to 99"' if kind == "traces" else "a whole number"
        raise SettingError(f"the number of the {kind} must be {wanted}, but is {text!r}") from None
