"""Background work of the tab File, with a progress bar and a button that cancels it."""

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
    """Runs one job at a time; visible while one is in progress.

    Parameters
    ----------
    notice : Question
        Shows errors.
    cancelled : callable() -> str
        Message after a job was cancelled.

    Attributes
    ----------
    busy : bool
    cancel_button : Button
    """

    busy = Bool(False)

    def __init__(self, notice: Question, cancelled: Callable[[], str]):
        self._notice, self._cancelled, self._runner = notice, cancelled, JobRunner()
        self._bar = FloatProgress(min=0, max=1, layout=Layout(width="120px"))
        self.cancel_button = Button(description="Cancel", icon="stop", layout=Layout(width="auto"))
        super().__init__([self._bar, self.cancel_button], layout=Layout(display="none"))
        self.cancel_button.on_click(lambda _: self.cancel())
        self.observe(lambda change: setattr(self.layout, "display", "" if change.new else "none"), "busy")

    def begin(self, work: Work) -> None:
        """Run a job in place of the one in progress.

        The job gets a function that takes the fraction done and returns whether to continue; the function that it
        returns is called at its end.
        """
        self._bar.value, self.cancel_button.disabled, self.busy = 0, False, True
        end = partial(self._end, lambda finish: finish())
        fail = partial(self._end, lambda error: self._notice.alert(in_words(error)))
        stop = partial(self._end, lambda: self._notice.hint(self._cancelled()))
        self._runner.submit(Job(lambda job: work(partial(self.report, job)), end, fail, stop))

    def cancel(self) -> None:
        """Stop the job in progress at its next report."""
        self.cancel_button.disabled = True
        self._notice.hint("Stopping ...")
        self._runner.stop()

    def drop(self) -> None:
        """Cancel the job in progress without a message."""
        self._runner.drop()
        self.busy = False

    def wait(self, timeout: float | None = None) -> bool:
        """Wait until no job is in progress; False after the timeout in seconds."""
        return self._runner.wait(timeout)

    def report(self, job: Job, fraction: float) -> bool:
        """Show the fraction done of a job; return whether it should continue."""
        if job.wanted:
            self._bar.value = fraction
        return job.wanted

    def _end(self, action: Callable[..., None], *result: object) -> None:
        self.busy = False
        action(*result)
