"""How the app goes from one section to another, and where it keeps its work."""

from dataclasses import replace
from os import PathLike
from pathlib import Path

from seiswidgets.geology.plan import Plan
from seiswidgets.geology.restoration import Restoration
from seiswidgets.geology.section import Section
from seiswidgets.interaction.drawing import Drawing
from seiswidgets.io.session.sources import SectionSource
from seiswidgets.widgets.section_view.canvas import LOCK
from seiswidgets.widgets.snapshot import Snapshot


class Turning:
    """The part of `RestorationApp` that is about which section it works on, and in which file."""

    @property
    def section(self) -> Section:
        """That is restored. If it is set, picks that lie on the new one too are kept; there is nothing to undo then."""
        return self.panes.original.section

    @section.setter
    def section(self, section: Section):
        self.begin(section, self.picker.drawing if self.picks_fit(section) else Drawing())

    def picks_fit(self, section: Section) -> bool:
        """Whether all that is drawn lies on another section too, and in the same units."""
        same = (section.x_unit, section.z_unit) == (self.section.x_unit, self.section.z_unit)
        return same and self.picker.drawing.lies_on(section)

    @property
    def session_path(self) -> Path | None:
        """Where the work is kept, None if nowhere; may be set."""
        return self.keeper.path

    @session_path.setter
    def session_path(self, path: str | PathLike | None):
        self.keeper.keep(path)

    def begin(
        self, section: Section, drawing: Drawing, *, source: SectionSource | None = None, plan: Plan | None = None
    ) -> None:
        """Go on with another section and what is drawn on it; on the same section, that can be undone.

        Parameters
        ----------
        section : Section
        drawing : Drawing
        source : SectionSource, optional
            Where the section comes from.
        plan : Plan, optional
            The steps and weights as they are, and the usual mesh, if left out.

        Raises
        ------
        DataError
            If there is a session, and it cannot be saved first.
        """
        with LOCK:
            self._ready = False
            try:
                self._turn_to(section, drawing, source)
                self._take_plan(plan or replace(self.plan, spacing=None))
            finally:
                self._ready = True
            self._restore_soon()

    def _turn_to(self, section, drawing, source):
        if section is self.section:
            self.source = source
            self.picker.take(drawing)
            return
        with self.keeper.turned():
            self._restorer.forget()
            self.picker.begin(Drawing())
            for pane in (self.panes.original, self.panes.restored):
                pane.frame = None
                pane.fit()
            self.source, restoration = source, Restoration(section)
            self._draw(Snapshot.of(restoration), restoration)
            self.solving.take(section)
            self.picker.begin(drawing)

    def _take_plan(self, plan):
        self.steps, self.weights = plan.steps, plan.weights
        self.solving.spacing, self.solving.solver = plan.spacing, plan.solver
