"""Work of the tab File in the background: how far it is, and a button to give it up."""

from collections.abc import Callable
from functools import partial
from threading import Event

from ipywidgets import Button, FloatProgress, HBox, Layout
from traitlets import Bool

from seiswidgets.errors import Cancelled
from seiswidgets.widgets.files.question import Question
from seiswidgets.widgets.jobs import Worker
from seiswidgets.widgets.messages import in_words

Tell = Callable[[float], bool]
Job = Callable[[Tell], Callable[[], None]]


class BackgroundJob(HBox):
    """Does one job at a time on a thread, and shows itself as long as one is under way.

    Parameters
    ----------
    notice : Question
        That says what went wrong.
    given_up : callable() returning str
        What it says when a job was given up.

    Attributes
    ----------
    busy : bool
    """

    busy = Bool(False)

    def __init__(self, notice: Question, given_up: Callable[[], str]):
        self._notice, self._given_up = notice, given_up
        self._worker, self._stop = Worker(), Event()
        self._bar = FloatProgress(min=0, max=1, layout=Layout(width="120px"))
        self._cancel = Button(description="Cancel", icon="stop", layout=Layout(width="auto"))
        super().__init__([self._bar, self._cancel], layout=Layout(display="none"))
        self._cancel.on_click(lambda _: self.cancel())
        self.observe(lambda change: setattr(self.layout, "display", "" if change.new else "none"), "busy")

    def begin(self, job: Job) -> None:
        """Do a job, in place of the one under way.

        It is given a function to tell the share done by, which returns whether the job is still wanted. What the job
        returns is called at the end, if it is.
        """
        self._stop = Event()
        self._bar.value, self._cancel.disabled, self.busy = 0, False, True
        self._worker.ask(partial(self._work, job, self._stop))

    def cancel(self) -> None:
        """Give up the job that is under way, as soon as it asks whether it is wanted."""
        self._cancel.disabled = True
        self._notice.hint("Stopping ...")
        self._stop.set()

    def drop(self) -> None:
        """Want nothing any more, and say nothing."""
        self._worker.cancel()
        self.busy = False

    def wait(self, timeout: float | None = None) -> bool:
        """Wait until nothing is left to do; False if that took too long."""
        return self._worker.wait(timeout)

    def _work(self, job, stop, wanted):
        try:
            end = job(partial(self._tell, stop, wanted))
            if stop.is_set():
                raise Cancelled("a job that does not ask ends when it is done")
            self._end(wanted, end)
        except Cancelled:
            self._end(wanted, lambda: self._notice.hint(self._given_up()))
        except Exception as error:  # noqa: BLE001 - nobody else would hear of it on this thread
            self._end(wanted, partial(self._notice.alert, in_words(error)))

    def _tell(self, stop, wanted, share):
        if wanted():
            self._bar.value = share
        return wanted() and not stop.is_set()

    def _end(self, wanted, action):
        if wanted():
            self.busy = False
            action()
