"""Check that a test leaves nothing behind."""

import gc
import os
import re
import sys
import threading
import time
from contextlib import contextmanager

import psutil
import pytest

PROCESS = "/proc/self"  # Linux's; elsewhere open files are not looked at
NOT_OF_TESTS = re.compile(r"\..*|__pycache__|screenshots|.*(\.(py|js|css|md)|~)")  # of tools and of who works meanwhile
PATIENCE = 5.0  # seconds that what is about to end may take


@contextmanager
def nothing_left(*folders, only_files=False):
    """A context that fails if it leaves a thread, a process, an open file, or anything new in one of these folders.

    What there was before may go on. What is about to end is waited for. With ``only_files`` it looks at the folders
    alone.
    """

    def here():
        return {*_files(folders), *(() if only_files else _running())}

    before = here()
    yield
    end = time.monotonic() + PATIENCE
    while left := here() - before:
        if time.monotonic() > end:
            pytest.fail(f"left behind: {', '.join(sorted(map(_words, left)))}", pytrace=False)
        gc.collect()  # closes what nobody can reach any more, and warns of it
        time.sleep(0.01)


def family(number):
    """The process of a number, and all that it has started and these have."""
    first = psutil.Process(number)
    return [first, *first.children(recursive=True)]


def ended(processes, patience=60.0):
    """Wait until processes have ended that were told to; if some have not, end them, and fail."""
    _, alive = psutil.wait_procs(processes, patience)
    for process in alive:
        process.kill()
    if alive:
        pytest.fail(f"did not end: {alive}", pytrace=False)


def _running():
    """Running threads and processes, and open files, as pairs of kind and object."""
    yield from (("thread", thread) for thread in threading.enumerate())
    yield from (("process", number) for number in _children())
    yield from (("open file", opened) for opened in _open_files())


def _files(folders):
    """Files in folders, as such pairs."""
    for folder in folders:
        yield from (("file", os.path.join(folder, name)) for name in _names(folder) if not NOT_OF_TESTS.fullmatch(name))


def _children():
    """The numbers of the processes that this one has started and that have not been waited for."""
    if not os.path.exists(f"{PROCESS}/task/{os.getpid()}/children"):
        return [child.pid for child in psutil.Process().children()]  # which goes through all of the machine's
    return [int(number) for task in _names(f"{PROCESS}/task") for number in _read(f"{PROCESS}/task/{task}/children")]


def _open_files():
    """Numbers of files, pipes and sockets with what they are; but for those that a library keeps, as its fonts.

    Pytest turns the standard ones to and fro.
    """
    for number in {*_names(f"{PROCESS}/fd")} - {"0", "1", "2"}:
        try:
            target = os.readlink(f"{PROCESS}/fd/{number}")
        except OSError:  # it was that of this list
            continue
        if not target.startswith(sys.prefix):
            yield number, target


def _names(folder):
    try:
        return os.listdir(folder)
    except OSError:  # it is not there
        return []


def _read(path):
    """The words in a file."""
    try:
        with open(path) as file:
            return file.read().split()
    except OSError:  # of a thread that has just ended
        return []


def _words(pair):
    kind, what = pair
    return f"{kind} {psutil.Process(what) if kind == 'process' else what}"
