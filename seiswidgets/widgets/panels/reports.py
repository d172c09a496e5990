"""Reports on the stages of a restoration."""

from dataclasses import replace
from typing import TYPE_CHECKING

from ipywidgets import HTML, VBox

from seiswidgets.geology.restoration import Restoration
from seiswidgets.widgets.messages import HINT, in_the_app
from seiswidgets.widgets.severity import remark
from seiswidgets.widgets.verdict import title_of

if TYPE_CHECKING:  # slow to import, and the app can do without it at first
    from seiswidgets.geology.ensembles.ensemble import Ensemble

NOTHING = HINT.format("Nothing has been restored yet.")


class Reports(VBox):
    """Findings and measures of each stage, in numbers with their units.

    Attributes
    ----------
    page, errors : HTML
        The report, and the error bars of its numbers.
    """

    def __init__(self) -> None:
        self.page, self.errors = HTML(NOTHING), HTML()
        super().__init__([self.page, self.errors])

    def show(self, restoration: Restoration) -> None:
        """Show the findings of a restoration, worst first, and below them the reports on its stages."""
        remarks = [
            remark(finding.severity, in_the_app(finding.text), title_of(finding)) for finding in restoration.findings
        ]
        tables = [replace(stage.report, findings=())._repr_html_() for stage in restoration.stages]
        self.page.value = "".join([*remarks, *tables]) or NOTHING

    def show_errors(self, ensemble: "Ensemble | None") -> None:
        """Show the error bars of an ensemble below the reports, or none."""
        self.errors.value = f"<b>Error bars</b>{ensemble._repr_html_()}" if ensemble else ""
