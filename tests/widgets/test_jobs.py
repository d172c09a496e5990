import threading
import time

import pytest

from seiswidgets.widgets.jobs import Worker


@pytest.fixture
def worker():
    worker = Worker()
    yield worker
    worker.cancel()
    assert worker.wait(5)


def test_a_job_is_done_and_the_thread_ends(worker):
    done = []
    worker.ask(lambda wanted: done.append(wanted()))
    assert worker.wait(5)
    assert done == [True]
    assert not [thread for thread in threading.enumerate() if thread.name == "seiswidgets restoring"]


def test_the_newest_job_ends_the_one_under_way_and_drops_the_one_that_waits(worker):
    begun, seen = threading.Event(), []

    def long(wanted):
        begun.set()
        while wanted():
            time.sleep(0.001)
        seen.append("given up")

    worker.ask(long)
    assert begun.wait(5)
    worker.ask(lambda wanted: seen.append("dropped"), delay=60)
    for number in range(20):
        worker.ask(lambda wanted, number=number: seen.append(number))
    assert worker.wait(5)
    assert seen[-1] == 19
    assert "dropped" not in seen


def test_a_job_that_waits_is_done_when_it_is_due(worker):
    done = []
    asked = time.monotonic()
    worker.ask(lambda wanted: done.append(time.monotonic()), delay=0.05)
    assert worker.wait(5)
    assert done[0] - asked >= 0.05


def test_cancelling_wants_nothing_any_more(worker):
    begun, wants = threading.Event(), []

    def long(wanted):
        begun.set()
        while wanted():
            time.sleep(0.001)
        wants.append(wanted())

    worker.ask(long)
    assert begun.wait(5)
    worker.cancel()
    assert worker.wait(5)
    assert wants == [False]
