"""List of the picks beside a section: names, colours, visibility, deletion, and findings about each."""

from collections.abc import Callable
from html import escape

from ipywidgets import HTML, Button, ColorPicker, Dropdown, HBox, Layout, Text, ToggleButton, VBox, Widget
from traitlets import Bunch

from seiswidgets.errors import SeiswidgetsError
from seiswidgets.geology.bodies import BODY, KINDS
from seiswidgets.geology.picks import FAULT, HORIZON, USES
from seiswidgets.interaction.drawing import Pick
from seiswidgets.interaction.editor import PickEditor
from seiswidgets.widgets.messages import TROUBLE
from seiswidgets.widgets.severity import remark

TITLES = {FAULT: "Faults", HORIZON: "Horizons", BODY: "Bodies"}
USE_TOOLTIPS = {
    FAULT: "constrain: blocks slide along it; carry: it moves with the rock and cuts nothing; ignore: it is left out",
    HORIZON: "constrain: it is matched across faults; carry: it only moves with the rock; ignore: it is left out",
    BODY: "a hole in the mesh: salt, or an area without data",
}
NONE_YET = " <i>none yet: choose {} and click {} one</i>"
HEADING = {"font_weight": "bold", "button_color": "transparent"}
NARROW = {"width": "34px", "min_width": "34px", "padding": "0"}  # not a Layout, which all apps would share


class PicksList(VBox):
    """A row for each pick of an editor; changes in a row are edits, which can be undone.

    Parameters
    ----------
    editor : PickEditor
        Editor of the picks.
    changed : callable()
        Called after each edit.

    Attributes
    ----------
    groups : dict of str to Button
        Headings of the picks of each kind, which fold and unfold them.
    """

    children: tuple[Widget, ...]

    def __init__(self, editor: PickEditor, changed: Callable[[], None]):
        self.editor, self._changed = editor, changed
        self._rows: dict[str, list[PickRow]] = {kind: [] for kind in TITLES}
        self._complaints: dict[str, tuple[str, str]] = {}
        self._folded: set[str] = set()
        self.groups = {kind: Button(layout=Layout(width="auto"), style=HEADING) for kind in TITLES}
        self._hints = {kind: HTML() for kind in TITLES}
        self._titles = {kind: HBox([self.groups[kind], self._hints[kind]]) for kind in TITLES}
        super().__init__()
        for kind, button in self.groups.items():
            button.on_click(lambda _, kind=kind: self._fold(kind))
        self.update({})

    def update(self, complaints: dict[str, tuple[str, str]]) -> None:
        """Show the editor's picks, each with its complaint: a severity and a text, by the name of the pick."""
        self._complaints = complaints
        children: list[Widget] = []
        for kind, rows in self._rows.items():
            picks = [pick for pick in self.editor.drawing.picks if pick.kind == kind]
            rows.extend(PickRow(self, kind) for _ in range(len(picks) - len(rows)))
            for row, pick in zip(rows, picks, strict=False):
                row.update(pick, self.is_selected(pick), complaints.get(pick.name))
            none = NONE_YET.format(kind.title(), "around" if kind == BODY else "along")
            self._hints[kind].value = "" if picks else none
            self._show_group(kind, len(picks))
            children += [self._titles[kind], *(rows[: len(picks)] if kind not in self._folded else [])]
        if tuple(children) != self.children:
            self.children = tuple(children)

    def _fold(self, kind: str) -> None:
        """Fold or unfold the picks of a kind."""
        self._folded ^= {kind}
        self.update(self._complaints)

    def _show_group(self, kind: str, count: int) -> None:
        button, is_folded = self.groups[kind], kind in self._folded
        button.description = f"{TITLES[kind]} ({count})" if count else TITLES[kind]
        button.icon = "caret-right" if is_folded else "caret-down"
        button.tooltip = f"{'unfold' if is_folded else 'fold'} the list of {TITLES[kind].lower()}"

    def rows(self, kind: str) -> dict[str, "PickRow"]:
        """Rows of the picks of a kind, by name."""
        return {row.name.value: row for row in self._rows[kind] if row in self.children}

    def edit(self, action: Callable[..., None], *arguments: object) -> str:
        """Make an edit; return the message of its error, "" if there is none."""
        try:
            action(*arguments)
        except SeiswidgetsError as error:
            return str(error)
        finally:
            self._changed()
        return ""

    def is_selected(self, pick: Pick) -> bool:
        """Return whether a pick, or a part of it, is selected."""
        selection = self.editor.state.selection
        return selection is not None and (selection.kind, selection.name) == (pick.kind, pick.name)


class PickRow(VBox):
    """Row of one pick.

    Attributes
    ----------
    select, colour, visible, name, use, delete : ToggleButton, ColorPicker, ToggleButton, Text, Dropdown, Button
        Controls of the pick.
    message : HTML
        The worst finding about it, or an error.
    """

    def __init__(self, owner: PicksList, kind: str):
        self._owner, self._pick = owner, Pick(kind, "", (), "")
        self.select = ToggleButton(icon="crosshairs", layout=NARROW)
        self.colour = ColorPicker(concise=True, layout=Layout(width="32px", min_width="32px"))
        self.visible = ToggleButton(icon="eye", layout=NARROW)
        self.name = Text(continuous_update=False, layout=Layout(flex="1 1 auto", width="auto", min_width="60px"))
        self.use = Dropdown(options=KINDS if kind == BODY else USES, layout=Layout(width="92px", flex="0 0 auto"))
        self.delete = Button(icon="trash", layout=NARROW)
        self.message = HTML(layout=Layout(display="none"))
        line = HBox([self.select, self.colour, self.visible, self.name, self.use, self.delete])
        super().__init__([line, self.message])
        self.select.observe(self._take_selected, "value")
        self.colour.observe(self._take_colour, "value")
        self.visible.observe(self._take_visible, "value")
        self.name.observe(self._take_name, "value")
        self.use.observe(self._take_use, "value")
        self.delete.on_click(lambda _: self._edit(owner.editor.delete))

    def update(self, pick: Pick, selected: bool, complaint: tuple[str, str] | None) -> None:
        """Show a pick, whether it is selected, and its complaint."""
        self._pick = pick  # first, so that the controls that show it see no difference and make no edit
        self.name.value, self.visible.value, self.select.value = pick.name, pick.visible, selected
        self.colour.value, self.use.value = pick.colour, _shown_use(pick)
        self.visible.icon = "eye" if pick.visible else "eye-slash"
        action = "hide" if pick.visible else "show"
        piece = "; the next line drawn becomes a piece of it" if pick.kind == HORIZON else ""
        self.select.tooltip = f"select this {pick.kind}{piece}"
        self.visible.tooltip = f"{action} this {pick.kind}; hidden picks are restored too"
        self.name.tooltip = f"name of this {pick.kind}"
        self.use.tooltip = USE_TOOLTIPS[pick.kind]
        self.delete.tooltip = f"delete this {pick.kind}; undo brings it back"
        self._show_message(remark(*complaint) if complaint else "")

    def _show_message(self, html: str) -> None:
        self.message.value = html
        self.message.layout.display = "" if html else "none"

    def _edit(self, action: Callable[..., None], *arguments: object) -> None:
        error = self._owner.edit(action, self._pick.kind, self._pick.name, *arguments)
        if error:
            self._show_message(TROUBLE.format(escape(error)))

    def _take_selected(self, change: Bunch) -> None:
        if change.new != self._owner.is_selected(self._pick):
            editor = self._owner.editor
            self._edit(editor.select if change.new else lambda kind, name: editor.deselect())

    def _take_colour(self, change: Bunch) -> None:
        if change.new != self._pick.colour:
            self._edit(self._owner.editor.recolour, change.new)

    def _take_visible(self, change: Bunch) -> None:
        if change.new != self._pick.visible:
            self._edit(self._owner.editor.show, change.new)

    def _take_name(self, change: Bunch) -> None:
        if change.new != self._pick.name:
            self._edit(self._owner.editor.rename, change.new)

    def _take_use(self, change: Bunch) -> None:
        if change.new != _shown_use(self._pick):
            editor = self._owner.editor
            self._edit(editor.body_kind if self._pick.kind == BODY else editor.use, change.new)


def _shown_use(pick: Pick) -> str:
    """The use of a line, or the kind of a body."""
    return pick.body if pick.kind == BODY else pick.use
