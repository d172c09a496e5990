"""A restoration at moments between today and its end."""

from collections.abc import Callable

from seiswidgets.geology.restoration import Restoration
from seiswidgets.widgets.jobs import Worker
from seiswidgets.widgets.linked_panes import LinkedPanes
from seiswidgets.widgets.restorer import REST
from seiswidgets.widgets.section_view.canvas import LOCK
from seiswidgets.widgets.snapshot import Snapshot


class TimelinePlayer:
    """Shows moments in two linked panes: coarsely at once, and in all detail when time stands still.

    Parameters
    ----------
    panes : LinkedPanes
    shown : callable()
        Called after each.
    """

    def __init__(self, panes: LinkedPanes, shown: Callable[[], None]):
        self._panes, self._shown, self._worker = panes, shown, Worker()

    def show(self, restoration: Restoration, time: float) -> None:
        """Show a restoration at a time, from 0, today, to the number of its stages."""
        self._worker.cancel()
        if time < len(restoration.stages):
            moment = restoration.at(time)
            self._panes.show(Snapshot.of(moment, moving=True))
            self._worker.ask(lambda wanted: self._sharpen(moment, wanted), REST)
        elif self._panes.shown.restoration is not restoration:
            self._panes.show(Snapshot.of(restoration))
        self._shown()

    def cancel(self) -> None:
        """Leave what is shown as it is."""
        self._worker.cancel()

    def wait(self, timeout: float | None = None) -> bool:
        """Wait until all is shown in detail; False if that took too long."""
        return self._worker.wait(timeout)

    def _sharpen(self, moment, wanted):
        frame = Snapshot.of(moment)
        with LOCK:
            if wanted():
                self._panes.show(frame)
                self._shown()
