"""A job of the tab File in the background, with its progress and a button that cancels it."""

from collections.abc import Callable
from functools import partial

from ipywidgets import Button, FloatProgress, HBox, Layout
from traitlets import Bool

from seiswidgets.widgets.files.question import Question
from seiswidgets.widgets.jobs import Job, JobRunner
from seiswidgets.widgets.messages import in_words

Report = Callable[[float], bool]
Work = Callable[[Report], Callable[[], None]]


class BackgroundJob(HBox):
    """Runs one job at a time, and shows itself as long as one is in progress.

    Parameters
    ----------
    notice : Question
        Shows what went wrong.
    cancelled : callable() returning str
        The message after a job was cancelled.

    Attributes
    ----------
    busy : bool
    """

    busy = Bool(False)

    def __init__(self, notice: Question, cancelled: Callable[[], str]):
        self._notice, self._cancelled, self._runner = notice, cancelled, JobRunner()
        self._bar = FloatProgress(min=0, max=1, layout=Layout(width="120px"))
        self._cancel = Button(description="Cancel", icon="stop", layout=Layout(width="auto"))
        super().__init__([self._bar, self._cancel], layout=Layout(display="none"))
        self._cancel.on_click(lambda _: self.cancel())
        self.observe(lambda change: setattr(self.layout, "display", "" if change.new else "none"), "busy")

    def begin(self, work: Work) -> None:
        """Run a job, instead of the one in progress.

        It is given a function that reports the share done and returns whether to go on; what the job returns is called
        at its end.
        """
        self._bar.value, self._cancel.disabled, self.busy = 0, False, True
        end = partial(self._end, lambda finish: finish())
        fail = partial(self._end, lambda error: self._notice.alert(in_words(error)))
        stop = partial(self._end, lambda: self._notice.hint(self._cancelled()))
        self._runner.submit(Job(lambda job: work(partial(self._report, job)), end, fail, stop))

    def cancel(self) -> None:
        """Stop the job in progress as soon as it reports."""
        self._cancel.disabled = True
        self._notice.hint("Stopping ...")
        self._runner.stop()

    def drop(self) -> None:
        """Cancel the running and pending jobs, and say nothing."""
        self._runner.drop()
        self.busy = False

    def wait(self, timeout: float | None = None) -> bool:
        """Wait until nothing is left to do; False after the timeout in seconds."""
        return self._runner.wait(timeout)

    def _report(self, job, share):
        if job.wanted:
            self._bar.value = share
        return job.wanted

    def _end(self, action, *result):
        self.busy = False
        action(*result)
