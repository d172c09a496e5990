"""Executors for tests."""

from concurrent.futures import Executor, Future


class InThisThread(Executor):
    """Runs each task when it is submitted."""

    def submit(self, function, *arguments):
        future = Future()
        future.set_result(function(*arguments))
        return future
