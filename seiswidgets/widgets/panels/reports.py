"""The reports of all stages of a restoration."""

from ipywidgets import HTML, VBox

from seiswidgets.geology.restoration import Restoration
from seiswidgets.widgets.messages import HINT

NOTHING = HINT.format("Nothing has been restored yet.")


class Reports(VBox):
    """What each stage has achieved, in numbers with their units."""

    def __init__(self):
        self._page = HTML(NOTHING)
        super().__init__([self._page])

    def show(self, restoration: Restoration) -> None:
        """Show the reports of a restoration's stages."""
        tables = [stage.report._repr_html_() for stage in restoration.stages]
        self._page.value = "".join(tables) or NOTHING
