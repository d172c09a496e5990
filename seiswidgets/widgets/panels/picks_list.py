"""The list of picks beside a section: names, colours, visibility, deletion, and what is wrong with each."""

from collections.abc import Callable
from html import escape

from ipywidgets import HTML, Button, ColorPicker, HBox, Layout, Text, ToggleButton, VBox

from seiswidgets.errors import SeiswidgetsError
from seiswidgets.interaction.drawing import FAULT, HORIZON, Pick
from seiswidgets.interaction.editor import PickEditor
from seiswidgets.widgets.messages import TROUBLE
from seiswidgets.widgets.severity import remark

TITLES = {FAULT: "Faults", HORIZON: "Horizons"}
NONE_YET = " <i>none yet: choose {} and click along one</i>"
NARROW = {"width": "34px", "min_width": "34px", "padding": "0"}  # a Layout would be shared by all apps


class PicksList(VBox):
    """A row for each pick of a editor; what is changed in it is an edit, which can be undone.

    Parameters
    ----------
    editor : PickEditor
    changed : callable()
        Called after each edit.
    """

    def __init__(self, editor: PickEditor, changed: Callable[[], None]):
        self._pen, self._changed = editor, changed
        self._rows = {FAULT: [], HORIZON: []}
        self._titles = {kind: HTML() for kind in TITLES}
        super().__init__()
        self.update({})

    def update(self, complaints: dict[str, tuple[str, str]]) -> None:
        """Show the editor's picks as they are, and beside each its complaint: a severity and a text, by name."""
        children = []
        for kind, rows in self._rows.items():
            picks = [pick for pick in self._pen.drawing.picks if pick.kind == kind]
            rows.extend(_Row(self) for _ in range(len(picks) - len(rows)))
            for row, pick in zip(rows, picks, strict=False):
                row.update(pick, self.is_chosen(pick), complaints.get(pick.name))
            self._titles[kind].value = f"<b>{TITLES[kind]}</b>" + ("" if picks else NONE_YET.format(kind.title()))
            children += [self._titles[kind], *rows[: len(picks)]]
        if tuple(children) != self.children:
            self.children = children

    def edit(self, action: Callable[..., None], *arguments) -> str:
        """Make an edit, and return what is wrong with it, if anything is."""
        try:
            action(*arguments)
        except SeiswidgetsError as error:
            return str(error)
        finally:
            self._changed()
        return ""

    @property
    def editor(self) -> PickEditor:
        """Whose picks are listed."""
        return self._pen

    def is_chosen(self, pick: Pick) -> bool:
        """Whether a pick, or a part of it, is selected."""
        chosen = self._pen.state.selection
        return chosen is not None and (chosen.kind, chosen.name) == (pick.kind, pick.name)


class _Row(VBox):
    """One pick."""

    def __init__(self, owner):
        self._owner, self._pick = owner, Pick(FAULT, "", (), "")
        self._choose = ToggleButton(icon="crosshairs", layout=NARROW)
        self._colour = ColorPicker(concise=True, layout=Layout(width="32px", min_width="32px"))
        self._visible = ToggleButton(icon="eye", layout=NARROW)
        self._name = Text(continuous_update=False, layout=Layout(flex="1 1 auto", width="auto", min_width="60px"))
        self._delete = Button(icon="trash", layout=NARROW)
        self._message = HTML(layout=Layout(display="none"))
        line = HBox([self._choose, self._colour, self._visible, self._name, self._delete])
        super().__init__([line, self._message])
        self._choose.observe(self._on_choose, "value")
        self._colour.observe(self._on_colour, "value")
        self._visible.observe(self._on_visible, "value")
        self._name.observe(self._on_name, "value")
        self._delete.on_click(lambda _: self._edit(owner.editor.delete))

    def update(self, pick: Pick, chosen: bool, complaint: tuple[str, str] | None):
        """Show a pick."""
        self._pick = pick  # first: a control that is made to show it then changes nothing
        self._name.value, self._visible.value, self._choose.value = pick.name, pick.visible, chosen
        self._colour.value = pick.colour
        self._visible.icon = "eye" if pick.visible else "eye-slash"
        act = "hide" if pick.visible else "show"
        self._choose.tooltip = f"select this {pick.kind}: a further line becomes a piece of a selected horizon"
        self._visible.tooltip = f"{act} this {pick.kind}; hidden picks take part in the restoration"
        self._name.tooltip = f"name of this {pick.kind}"
        self._delete.tooltip = f"delete this {pick.kind}; undo brings it back"
        self._say(remark(*complaint) if complaint else "")

    def _say(self, html):
        self._message.value = html
        self._message.layout.display = "" if html else "none"

    def _edit(self, action, *arguments):
        wrong = self._owner.edit(action, self._pick.kind, self._pick.name, *arguments)
        if wrong:
            self._say(TROUBLE.format(escape(wrong)))

    def _on_choose(self, change):
        if change.new != self._owner.is_chosen(self._pick):
            editor = self._owner.editor
            self._edit(editor.select if change.new else lambda kind, name: editor.deselect())

    def _on_colour(self, change):
        if change.new != self._pick.colour:
            self._edit(self._owner.editor.recolour, change.new)

    def _on_visible(self, change):
        if change.new != self._pick.visible:
            self._edit(self._owner.editor.show, change.new)

    def _on_name(self, change):
        if change.new != self._pick.name:
            self._edit(self._owner.editor.rename, change.new)
