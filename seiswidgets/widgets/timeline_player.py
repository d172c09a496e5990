"""A restoration at moments between the present day and its end."""

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
    shown : callable()
        Called after each.
    """

    def __init__(self, panes: LinkedPanes, shown: Callable[[], None]):
        self._panes, self._shown, self._runner = panes, shown, JobRunner()

    def show(self, restoration: Restoration, time: float) -> None:
        """Show a restoration at a time, from 0, the present day, to the number of its stages."""
        self._runner.drop()
        if time < len(restoration.stages):
            moment = restoration.at(time)
            self._take(Snapshot.of(moment, moving=True))
            self._runner.submit(Job(lambda job: Snapshot.of(moment), self._take, log_error), REST)
        elif self._panes.shown.restoration is not restoration:
            self._take(Snapshot.of(restoration))

    def cancel(self) -> None:
        """Leave what is shown as it is."""
        self._runner.drop()

    def wait(self, timeout: float | None = None) -> bool:
        """Wait until all is shown in detail; False after the timeout in seconds."""
        return self._runner.wait(timeout)

    def _take(self, snapshot):
        self._panes.show(snapshot)
        self._shown()
