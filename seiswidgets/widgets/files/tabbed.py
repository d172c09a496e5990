"""The tabs of the app."""

from functools import cached_property

from traitlets import dlink, link

from seiswidgets.widgets.files.file_panel import FilePanel
from seiswidgets.widgets.panels.controls import DisplayControls
from seiswidgets.widgets.panels.pages import Pages
from seiswidgets.widgets.panels.step_list import StepList
from seiswidgets.widgets.panels.weight_sliders import WeightSliders


class Tabbed:
    """The part of `RestorationApp` that is in tabs: what no restoration needs is made when it is first looked at."""

    @cached_property
    def sliders(self) -> WeightSliders:
        """The tab Weights."""
        sliders = WeightSliders()
        link((self, "weights"), (sliders, "weights"))
        return sliders

    @cached_property
    def step_list(self) -> StepList:
        """The tab Steps."""
        step_list = StepList()
        dlink((self.panes.original, "section"), (step_list, "z_unit"), lambda section: section.z_unit)
        link((self, "interpretation"), (step_list, "interpretation"))
        link((self, "steps"), (step_list, "steps"))
        return step_list

    @cached_property
    def files(self) -> FilePanel:
        """The tab File."""
        return FilePanel(self)

    @property
    def _made_files(self):
        """The tab File, if it has been looked at."""
        return [self.files] if "files" in vars(self) else []

    def _tabs(self):
        return Pages(
            Picks=lambda: self.picker.list,
            Weights=lambda: self.sliders,
            Steps=lambda: self.step_list,
            Solver=lambda: self.solving,
            Display=lambda: DisplayControls(self.panes),
            Report=lambda: self.reports,
            File=lambda: self.files,
        )
