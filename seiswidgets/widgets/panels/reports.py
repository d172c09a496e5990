"""The reports of all stages of a restoration."""

from dataclasses import replace

from ipywidgets import HTML, VBox

from seiswidgets.geology.restoration import Restoration
from seiswidgets.widgets.messages import HINT
from seiswidgets.widgets.severity import remark
from seiswidgets.widgets.verdict import findings_of, title_of

NOTHING = HINT.format("Nothing has been restored yet.")


class Reports(VBox):
    """What each stage has achieved, in numbers with their units."""

    def __init__(self):
        self._page = HTML(NOTHING)
        super().__init__([self._page])

    def show(self, restoration: Restoration) -> None:
        """Show the findings of a restoration, worst first, and the reports of its stages below."""
        remarks = [remark(finding.severity, finding.text, title_of(finding)) for finding in findings_of(restoration)]
        tables = [replace(stage.report, findings=())._repr_html_() for stage in restoration.stages]
        self._page.value = "".join([*remarks, *tables]) or NOTHING
