"""Executors for tests, and processes that end with them."""

import multiprocessing.resource_tracker
import os
import signal
from concurrent.futures import Executor, Future
from contextlib import contextmanager

import loky.backend.resource_tracker


class InThisThread(Executor):
    """Runs each task when it is submitted."""

    def submit(self, function, *arguments):
        future = Future()
        future.set_result(function(*arguments))
        return future


@contextmanager
def resource_trackers():
    """Begin the processes that look after the resources of others, which would go on until Python ends; end them."""
    trackers = loky.backend.resource_tracker._resource_tracker, multiprocessing.resource_tracker._resource_tracker
    for tracker in trackers:
        tracker.ensure_running()
    try:
        yield
    finally:
        for tracker in trackers:
            tracker._stop()


def number_or_death(content, index):
    """Kill the own process, once where a file tells so, or always."""
    flag = content.get(index)
    if flag and (flag == "always" or os.path.exists(flag)):
        if flag != "always":
            os.remove(flag)
        os.kill(os.getpid(), signal.SIGKILL)
    return index**2
