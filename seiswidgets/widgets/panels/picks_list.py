"""The list of picks beside a section: names, colours, visibility, deletion, and what is wrong with each."""

from collections.abc import Callable
from html import escape

from ipywidgets import HTML, Button, ColorPicker, HBox, Layout, Text, ToggleButton, VBox

from seiswidgets.errors import SeiswidgetsError
from seiswidgets.interaction.drawing import FAULT, HORIZON, Pick
from seiswidgets.interaction.editor import PickEditor
from seiswidgets.widgets.messages import TROUBLE

TITLES = {FAULT: "Faults", HORIZON: "Horizons"}
NONE_YET = " <i>none yet: choose {} and click along one</i>"
NARROW = Layout(width="34px", min_width="34px", padding="0")


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

    def update(self, complaints: dict[str, str]) -> None:
        """Show the editor's picks as they are, and beside them what is wrong, by name."""
        children = []
        for kind, rows in self._rows.items():
            picks = [pick for pick in self._pen.drawing.picks if pick.kind == kind]
            rows.extend(_Row(self) for _ in range(len(picks) - len(rows)))
            for row, pick in zip(rows, picks, strict=False):
                row.update(pick, self._is_chosen(pick), complaints.get(pick.name, ""))
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

    def _is_chosen(self, pick):
        chosen = self._pen.state.selection
        return chosen is not None and (chosen.kind, chosen.name) == (pick.kind, pick.name)


class _Row(VBox):
    """One pick."""

    def __init__(self, owner):
        self._owner, self._pick, self._updating = owner, None, False
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

    def update(self, pick: Pick, chosen: bool, complaint: str):
        """Show a pick."""
        self._pick, self._updating = pick, True
        try:
            self._name.value, self._visible.value, self._choose.value = pick.name, pick.visible, chosen
            self._colour.value = pick.colour
            self._visible.icon = "eye" if pick.visible else "eye-slash"
            act = "hide" if pick.visible else "show"
            self._choose.tooltip = f"select this {pick.kind}: a further line becomes a piece of a selected horizon"
            self._visible.tooltip = f"{act} this {pick.kind}; it is restored with all the same"
            self._name.tooltip = f"name of this {pick.kind}"
            self._delete.tooltip = f"delete this {pick.kind}; undo brings it back"
            self._say(complaint)
        finally:
            self._updating = False

    def _say(self, text):
        self._message.value = TROUBLE.format(escape(text))
        self._message.layout.display = "" if text else "none"

    def _edit(self, action, *arguments):
        if self._updating:
            return
        wrong = self._owner.edit(action, self._pick.kind, self._pick.name, *arguments)
        if wrong:
            self._say(wrong)

    def _on_choose(self, change):
        editor = self._owner.editor
        self._edit(editor.select) if change.new else self._edit(lambda kind, name: editor.deselect())

    def _on_colour(self, change):
        self._edit(self._owner.editor.recolour, change.new)

    def _on_visible(self, change):
        self._edit(self._owner.editor.show, change.new)

    def _on_name(self, change):
        self._edit(self._owner.editor.rename, change.new)
