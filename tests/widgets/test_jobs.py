import threading
import time

import pytest

from seiswidgets.errors import Cancelled
from seiswidgets.widgets.jobs import Job, JobRunner


@pytest.fixture
def runner():
    runner = JobRunner()
    yield runner
    runner.drop()
    assert runner.wait(5)


class Endless:
    """Work that goes on until it is not wanted any more."""

    def __init__(self):
        self.begun = threading.Event()

    def __call__(self, job):
        self.begun.set()
        while job.wanted:
            time.sleep(0.001)
        raise Cancelled("the job was cancelled")


def loud(error):
    raise error


def test_a_result_is_delivered_and_the_thread_ends(runner):
    results = []
    runner.submit(Job(lambda job: job.wanted, results.append, loud))
    assert runner.wait(5)
    assert results == [True]
    assert not [thread for thread in threading.enumerate() if thread.name == "seiswidgets job"]


def test_an_error_is_delivered(runner):
    errors = []
    runner.submit(Job(lambda job: 1 / 0, loud, errors.append))
    assert runner.wait(5)
    assert [type(error) for error in errors] == [ZeroDivisionError]


def test_the_newest_job_drops_the_running_and_the_waiting_one(runner):
    endless, results = Endless(), []
    runner.submit(Job(endless, results.append, loud, lambda: results.append("stopped")))
    assert endless.begun.wait(5)
    runner.submit(Job(lambda job: "waited", results.append, loud), delay=60)
    for number in range(20):
        runner.submit(Job(lambda job, number=number: number, results.append, loud))
    assert runner.wait(5)
    assert results[-1] == 19
    assert not {"waited", "stopped"} & set(results)


def test_a_job_waits_for_its_delay(runner):
    results = []
    submitted = time.monotonic()
    runner.submit(Job(lambda job: time.monotonic(), results.append, loud), delay=0.05)
    assert runner.wait(5)
    assert results[0] - submitted >= 0.05


def test_a_job_that_is_stopped_says_so(runner):
    endless, results = Endless(), []
    runner.submit(Job(endless, results.append, loud, lambda: results.append("stopped")))
    assert endless.begun.wait(5)
    runner.stop()
    assert runner.wait(5)
    assert results == ["stopped"]


def test_a_job_that_is_dropped_delivers_nothing(runner):
    endless, results = Endless(), []
    runner.submit(Job(endless, results.append, loud, lambda: results.append("stopped")))
    assert endless.begun.wait(5)
    runner.drop()
    assert runner.wait(5)
    assert results == []
