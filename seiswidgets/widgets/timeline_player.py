"""Display of a restoration at moments between the present day and its end."""

from collections.abc import Callable

from seiswidgets.geology.restoration import Restoration
from seiswidgets.widgets.jobs import Job, JobRunner
from seiswidgets.widgets.linked_panes import LinkedPanes
from seiswidgets.widgets.messages import log_error
from seiswidgets.widgets.restorer import REST
from seiswidgets.widgets.snapshot import Snapshot


class TimelinePlayer:
    """Shows a restoration at moments between the present day and its end: coarsely at once, in detail at rest.

    Parameters
    ----------
    panes : LinkedPanes
    drawn : callable(Snapshot)
        Called after each moment that is drawn.
    """

    def __init__(self, panes: LinkedPanes, drawn: Callable[[Snapshot], None]):
        self._panes, self._drawn, self._runner = panes, drawn, JobRunner()

    def show(self, restoration: Restoration, time: float) -> None:
        """Show a restoration at a time, from 0, the present day, to the number of its stages."""
        self._runner.drop()
        if time < len(restoration.stages):
            moment = restoration.at(time)
            self._draw(Snapshot.of(moment, moving=True))
            self._runner.submit(Job(lambda job: Snapshot.of(moment), self._draw, log_error), REST)
        elif self._panes.shown.restoration is not restoration:
            self._draw(Snapshot.of(restoration))

    def cancel(self) -> None:
        """Draw nothing more, and leave what is shown as it is."""
        self._runner.drop()

    def wait(self, timeout: float | None = None) -> bool:
        """Wait until everything is shown in detail; False after the timeout in seconds."""
        return self._runner.wait(timeout)

    def _draw(self, snapshot: Snapshot) -> None:
        self._panes.show(snapshot)
        self._drawn(snapshot)
