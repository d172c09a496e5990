"""Hypotheses in the app: a list to switch and edit them, a table that compares them, and views of two."""

from base64 import b64encode
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial
from html import escape
from io import BytesIO

from ipywidgets import HTML, Button, Dropdown, HBox, Layout, Text, ToggleButtons, VBox
from matplotlib.figure import Figure
from traitlets import Bunch

from seiswidgets.errors import Cancelled, SettingError
from seiswidgets.geology.hypothesis import Hypothesis
from seiswidgets.geology.outcomes import NAME, Comparison, Outcome, heading, outcome_of, shown
from seiswidgets.geology.section import Section
from seiswidgets.interaction.alternatives import alternatives, duplicated, moved, removed, renamed, switched
from seiswidgets.interaction.document import Alternative, Document
from seiswidgets.plot.frame import plot_frame
from seiswidgets.plot.hypotheses import difference, hypotheses
from seiswidgets.widgets.jobs import Job, JobRunner
from seiswidgets.widgets.messages import HINT, TROUBLE, in_words
from seiswidgets.widgets.sortable_table import SortableTable, TableRow
from seiswidgets.widgets.workspace import Workspace

SIDE_BY_SIDE, BLINK, DIFFERENCE = "side by side", "blink", "difference"
DOTS = 100  # per inch, of the views
IMAGE = '<img alt="{alt}" style="width: 100%" src="data:image/png;base64,{data}">'
BLINKING = (
    '<style>@keyframes seiswidgets-blink {{ 50% {{ opacity: 0 }} }}</style><div style="position: relative">{below}'
    '<div style="position: absolute; inset: 0; animation: seiswidgets-blink 1.6s steps(1) infinite">{above}</div></div>'
)
EXPLAINED = (
    "Correlation across each fault, largest changes of bed lengths, of the area and of the rock, largest turn, and "
    "findings. None of them proves a hypothesis."
)
BUTTONS: dict[str, tuple[str, str, Callable[[Document], Document]]] = {
    "Duplicate": ("copy", "Copy the hypothesis that is shown, and go on with the copy", duplicated),
    "Up": ("arrow-up", "Move it up", lambda document: moved(document, -1)),
    "Down": ("arrow-down", "Move it down", lambda document: moved(document, 1)),
    "Delete": ("trash", "Delete the hypothesis that is shown", removed),
}


@dataclass(frozen=True, eq=False)
class Compared:
    """The outcome of a hypothesis, and what it was computed from."""

    section: Section
    alternative: Alternative
    outcome: Outcome

    def fits(self, section: Section, alternative: Alternative) -> bool:
        """Return whether it is the outcome of a hypothesis as it is now."""
        return (
            self.section is section
            and self.alternative.drawing.interpretation is alternative.drawing.interpretation
            and self.alternative.plan == alternative.plan
        )


class HypothesesPanel(VBox):
    """Hypotheses of a workspace: switch, duplicate, rename, reorder and delete them, and compare how well they restore.

    Parameters
    ----------
    workspace : Workspace

    Attributes
    ----------
    name : Text
        Name of the hypothesis that is shown.
    buttons : dict of str to Button
    table : SortableTable
    compare_button : Button
    other : Dropdown
        The hypothesis that the shown one is viewed with.
    view : ToggleButtons
    """

    def __init__(self, workspace: Workspace):
        self._workspace, self._runner = workspace, JobRunner()
        self._compared: dict[str, Compared] = {}  # by the name that the hypothesis had
        self._sorted: tuple[str, bool] = "", False
        self.name = Text(description="name", continuous_update=False, layout=Layout(width="200px"))
        self.buttons = {label: self._button(label) for label in BUTTONS}
        self.table = SortableTable(self._sort, self._choose)
        self.compare_button = Button(
            description="Compare", icon="balance-scale", tooltip="Restore all hypotheses and fill the table"
        )
        self.other = Dropdown(description="view with", layout=Layout(width="200px"))
        self.view = ToggleButtons(options=[SIDE_BY_SIDE, BLINK, DIFFERENCE], value=None, style={"button_width": "auto"})
        self.message, self.picture = HTML(HINT.format(EXPLAINED)), HTML()
        bar = HBox([self.name, *self.buttons.values(), self.compare_button], layout=Layout(flex_flow="row wrap"))
        views = HBox([self.other, self.view], layout=Layout(flex_flow="row wrap"))
        super().__init__([bar, self.table, self.message, views, self.picture])
        self.name.observe(self._rename, "value")
        self.compare_button.on_click(lambda _: self.compare())
        self.view.observe(lambda change: self._show_view(), "value")
        self.other.observe(lambda change: self._show_view(), "value")
        workspace.observe(self._take_document, "document")
        self._update()

    def compare(self) -> None:
        """Restore the hypotheses whose outcome is not known yet in the background, and show the table."""
        section, wanted = self._workspace.section, self._missing()
        self._say(HINT.format("Restoring ...") if wanted else HINT.format(EXPLAINED))
        if wanted:
            self._runner.submit(Job(partial(_compute, section, wanted), self._take_outcomes, self._fail))

    def wait(self, timeout: float | None = None) -> bool:
        """Wait until nothing is in progress; False after the timeout in seconds."""
        return self._runner.wait(timeout)

    def end(self) -> None:
        """Cancel what is in progress."""
        self._runner.drop()

    @property
    def comparison(self) -> Comparison:
        """The outcomes known so far, in the order of the table."""
        known = Comparison(tuple(filter(None, map(self._outcome, alternatives(self._workspace.document)))))
        column, descending = self._sorted
        return known.sorted_by(column, descending=descending) if column in (NAME, *known.columns) else known

    def _missing(self) -> list[Alternative]:
        """The hypotheses whose outcome is not known, or out of date."""
        return [one for one in alternatives(self._workspace.document) if not self._fresh(one)]

    def _fresh(self, one: Alternative) -> Compared | None:
        """The outcome of a hypothesis as it is now, whatever its name was; None if it is not known."""
        section = self._workspace.section
        return next((compared for compared in self._compared.values() if compared.fits(section, one)), None)

    def _outcome(self, one: Alternative) -> Outcome | None:
        """The outcome of a hypothesis under its present name, perhaps out of date; None if it was not compared."""
        compared = self._fresh(one) or self._compared.get(one.name)
        if compared is None:
            return None
        return replace(compared.outcome, hypothesis=replace(compared.outcome.hypothesis, name=one.name))

    def _take_outcomes(self, compared: list[Compared]) -> None:
        self._compared |= {one.alternative.name: one for one in compared}
        self._say(HINT.format(EXPLAINED))
        self._update()
        self._show_view()

    def _fail(self, error: Exception) -> None:
        self._say(TROUBLE.format(escape(in_words(error))))

    def _say(self, html: str) -> None:
        self.message.value = html

    def _button(self, label: str) -> Button:
        icon, tooltip, change = BUTTONS[label]
        button = Button(description=label if label == "Duplicate" else "", icon=icon, tooltip=tooltip)
        button.layout.width = "auto"
        button.on_click(
            lambda _: self._workspace.edit_hypotheses(f"{label.lower()} {self._workspace.document.name}", change)
        )
        return button

    def _rename(self, change: Bunch) -> None:
        old = self._workspace.document.name
        if change.new == old:
            return
        try:
            self._workspace.edit_hypotheses(f"rename {old}", partial(renamed, name=change.new))
        except SettingError as error:
            self._say(TROUBLE.format(escape(str(error))))
            self.name.value = old

    def _choose(self, name: str) -> None:
        names = [one.name for one in alternatives(self._workspace.document)]
        if name in names:
            self._workspace.edit_hypotheses(f"show {name}", partial(switched, index=names.index(name)))

    def _sort(self, column: int) -> None:
        """Sort by a column; by the same one again, the other way round."""
        wanted = (NAME, *self.comparison.columns)[column]
        self._sorted = wanted, wanted == self._sorted[0] and not self._sorted[1]
        self._update()

    def _take_document(self, change: Bunch) -> None:
        if change.old.section is not change.new.section:
            self._compared.clear()
            self.picture.value = ""
        self._update()

    def _update(self) -> None:
        """Show the hypotheses of the document, with what is known about them."""
        document, comparison = self._workspace.document, self.comparison
        hypotheses = {one.name: one for one in alternatives(document)}
        order = [outcome.name for outcome in comparison.outcomes]
        order += [name for name in hypotheses if name not in order]
        if not self._sorted[0]:
            order = list(hypotheses)
        columns = comparison.columns
        rows = [self._row(hypotheses[name], columns) for name in order]
        column, descending = self._sorted
        index = (NAME, *columns).index(column) if column in (NAME, *columns) else -1
        self.table.show((NAME, *map(heading, columns)), rows, index, descending)
        self.name.value = document.name
        for label in ("Up", "Down", "Delete"):
            self.buttons[label].disabled = len(hypotheses) == 1
        others = [name for name in hypotheses if name != document.name]
        if tuple(self.other.options) != tuple(others):
            kept = self.other.value
            self.other.options = others
            self.other.value = kept if kept in others else next(iter(others), None)

    def _row(self, one: Alternative, columns: tuple[str, ...]) -> TableRow:
        outcome = self._outcome(one)
        cells = tuple(shown(column, outcome.values.get(column) if outcome else None) for column in columns)
        is_chosen, is_fresh = one.name == self._workspace.document.name, self._fresh(one) is not None
        title = "not compared yet" if outcome is None else outcome.verdict if is_fresh else "out of date: press Compare"
        return TableRow(one.name, cells, title, is_chosen, outcome is not None and not is_fresh)

    def _show_view(self) -> None:
        """Draw the shown hypothesis and another one in the background, once both have been compared."""
        if self.view.value is None or self.other.value is None:
            return
        if self._missing():
            self.compare()  # which comes back here
            return
        outcomes = {outcome.name: outcome for outcome in self.comparison.outcomes}
        pair = outcomes[self._workspace.document.name], outcomes[self.other.value]
        work = partial(_draw, self.view.value, *pair, self._workspace.drawing.colours)
        self._runner.submit(Job(work, lambda html: setattr(self.picture, "value", html), self._fail))


def _compute(section: Section, wanted: list[Alternative], job: Job) -> list[Compared]:
    compared = []
    for one in wanted:
        if not job.wanted:
            raise Cancelled("the comparison was cancelled")
        hypothesis = Hypothesis(section, one.drawing.interpretation, one.plan, one.name)
        compared.append(Compared(section, one, outcome_of(hypothesis)))
    return compared


def _draw(view: str, one: Outcome, other: Outcome, colours: dict[tuple[str, str], str], job: Job) -> str:
    """HTML of a view of two outcomes."""
    names = f"{one.name} and {other.name}"
    if view == DIFFERENCE:
        return _image(difference(one, other, colours=colours, figure=Figure()), f"difference of {names}")
    if view == SIDE_BY_SIDE:
        return _image(hypotheses(Comparison((one, other)), colours=colours, figure=Figure()), names)
    sections = [outcome.restored.section for outcome in (one, other) if outcome.restored is not None]
    window = plot_frame(one.hypothesis.section, sections or [one.hypothesis.section], None, None).window
    above, below = (
        _image(hypotheses(Comparison((single,)), colours=colours, window=window, figure=Figure()), single.name)
        for single in (one, other)
    )
    return BLINKING.format(above=above, below=below)


def _image(figure: Figure, alt: str) -> str:
    buffer = BytesIO()
    figure.savefig(buffer, format="png", dpi=DOTS)
    return IMAGE.format(alt=escape(alt, quote=True), data=b64encode(buffer.getvalue()).decode())
