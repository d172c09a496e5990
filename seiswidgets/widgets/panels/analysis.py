"""The app's tab Analysis: throw and growth of the faults, balance and extension, as a figure and as tables."""

from collections.abc import Callable
from dataclasses import dataclass
from html import escape
from io import StringIO

from ipywidgets import HTML, ToggleButtons, VBox
from traitlets import Bunch

from seiswidgets.geology.balance import balance
from seiswidgets.geology.fault_history import fault_growth, fault_throws
from seiswidgets.geology.histories import extension_history
from seiswidgets.geology.pick_colours import PickColours
from seiswidgets.geology.picks import Interpretation
from seiswidgets.geology.restoration import Restoration
from seiswidgets.geology.stratigraphy import Stratigraphy
from seiswidgets.geology.tables import Table
from seiswidgets.widgets.jobs import Job, JobRunner
from seiswidgets.widgets.messages import HINT, TROUBLE, in_words
from seiswidgets.widgets.severity import remark
from seiswidgets.widgets.workspace import Workspace

PAUSE = 0.3  # seconds without an edit before anything is measured
NO_CUTOFFS = HINT.format("No horizon meets a fault on both sides yet.")
NOT_RESTORED = HINT.format("Nothing has been restored yet.")


@dataclass(frozen=True, eq=False)
class Measured:
    """The objects to measure, unaffected by later edits."""

    restored: Restoration
    picks: Interpretation
    stratigraphy: Stratigraphy | None
    colours: PickColours


class Analysis(VBox):
    """Measures of the picks and of the restoration, kept up to date in the background.

    Parameters
    ----------
    workspace : Workspace

    Attributes
    ----------
    choice : ToggleButtons
    page : HTML
    """

    def __init__(self, workspace: Workspace):
        self._workspace, self._runner = workspace, JobRunner()
        self.choice = ToggleButtons(options=list(PAGES), style={"button_width": "auto"})
        self.page = HTML()
        super().__init__([self.choice, self.page])
        self.choice.observe(lambda change: self._measure(0.0), "value")
        workspace.observe(self._follow, ["document", "restoration"])
        self._measure(0.0)

    def wait(self, timeout: float | None = None) -> bool:
        """Wait until everything is measured; False after the timeout in seconds."""
        return self._runner.wait(timeout)

    def end(self) -> None:
        """Stop measuring."""
        self._workspace.unobserve(self._follow, ["document", "restoration"])
        self._runner.drop()

    def _follow(self, change: Bunch) -> None:
        if self._workspace.settled:
            self._measure(PAUSE)

    def _measure(self, delay: float) -> None:
        workspace, make = self._workspace, PAGES[self.choice.value]
        measured = Measured(
            workspace.restoration, workspace.interpretation, workspace.plan.stratigraphy, workspace.drawing.colours
        )
        self._runner.submit(Job(lambda job: make(measured), self._show, self._fail), delay)

    def _show(self, page: str) -> None:
        self.page.value = page

    def _fail(self, error: Exception) -> None:
        self.page.value = TROUBLE.format(escape(in_words(error)))


def _throw_page(measured: Measured) -> str:
    table = fault_throws(measured.restored.original, measured.picks, measured.stratigraphy)
    return _figure(table, measured.colours) + table._repr_html_() if len(table) else NO_CUTOFFS


def _growth_page(measured: Measured) -> str:
    table = fault_growth(measured.restored.original, measured.picks, measured.stratigraphy)
    return table._repr_html_() if len(table) else NO_CUTOFFS


def _balance_page(measured: Measured) -> str:
    if not measured.restored.stages:
        return NOT_RESTORED
    found = balance(measured.restored, measured.picks)
    remarks = [remark(one.severity, one.text, one.kind) for one in found.findings]
    return "".join([*remarks, *(table._repr_html_() for table in found.tables if len(table))])


def _extension_page(measured: Measured) -> str:
    restored = measured.restored
    return extension_history(restored, measured.picks)._repr_html_() if restored.stages else NOT_RESTORED


def _figure(table: Table, colours: PickColours) -> str:
    """Throw against depth, as an SVG image that says what it shows."""
    from matplotlib.figure import Figure  # slow to import, and only this tab needs it

    from seiswidgets.plot import throws

    figure = Figure(figsize=(4.4, 3.4), layout="constrained")
    throws(table, figure.subplots(), colours=colours)
    file = StringIO()
    figure.savefig(file, format="svg")
    svg = file.getvalue()
    names = ", ".join(dict.fromkeys(map(str, table.column("fault"))))
    label = escape(f"Throw against depth at {names}; the table below has the numbers", quote=True)
    return svg[svg.index("<svg") :].replace(
        "<svg", f'<svg role="img" style="max-width: 100%; height: auto" aria-label="{label}"', 1
    )


PAGES: dict[str, Callable[[Measured], str]] = {
    "Throw": _throw_page,
    "Growth": _growth_page,
    "Balance": _balance_page,
    "Extension": _extension_page,
}
