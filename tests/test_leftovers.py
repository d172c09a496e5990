"""The watch that nothing is left behind: it sees what is left, and every test is watched."""

import os
import re
import socket
import subprocess
import sys
import threading
from pathlib import Path

import pytest

from tests import leftovers
from tests.leftovers import ended, nothing_left

ROOT = Path(__file__).parents[1]
ASLEEP = [sys.executable, "-c", "import time; time.sleep(60)"]


def begin_thread(folder):
    over = threading.Event()
    thread = threading.Thread(target=over.wait, name="forgotten")
    thread.start()
    return lambda: (over.set(), thread.join())


def begin_process(folder):
    process = subprocess.Popen(ASLEEP)
    return lambda: (process.kill(), process.wait())


def begin_file(folder):
    (folder / "forgotten.txt").touch()
    return (folder / "forgotten.txt").unlink


def open_file(folder):
    return (folder.parent / "open.txt").open("w").close


def open_socket(folder):
    return socket.socket().close


@pytest.mark.parametrize(
    ("begin", "name"),
    [
        (begin_thread, r"^left behind: thread <Thread\(forgotten, started \d+\)>$"),
        (begin_process, r"^left behind: process psutil.Process\(pid=\d+, name='python.*\)$"),
        (begin_file, r"^left behind: file .*/watched/forgotten\.txt$"),
        (open_file, r"^left behind: open file .*/open\.txt'\)$"),
        (open_socket, r"^left behind: open file .*socket"),
    ],
)
def test_what_is_left_is_named(begin, name, tmp_path, monkeypatch):
    monkeypatch.setattr(leftovers, "PATIENCE", 0.02)
    (tmp_path / "watched").mkdir()
    with pytest.raises(pytest.fail.Exception, match=name), nothing_left(tmp_path / "watched"):
        end = begin(tmp_path / "watched")
    with nothing_left(tmp_path / "watched"):  # what was there before may go on
        pass
    end()


def test_what_is_about_to_end_is_waited_for():
    with nothing_left():
        timer = threading.Timer(0.1, lambda: None)
        timer.start()
    assert not timer.is_alive()


def test_processes_that_do_not_end_are_ended_and_named():
    process = subprocess.Popen(ASLEEP)
    with pytest.raises(pytest.fail.Exception, match=rf"did not end: .*pid={process.pid}"):
        ended(leftovers.family(process.pid), patience=0.02)
    assert process.wait() != 0


CARELESS = """
import subprocess, sys, threading
import pytest
from tests import leftovers

leftovers.PATIENCE = 0.1
started = []

@pytest.fixture(scope="module")
def process():
    started.append(subprocess.Popen([sys.executable, "-c", ""]))

def test_thread():
    threading.Thread(target=threading.Event().wait, args=(60,), name="forgotten", daemon=True).start()

def test_file_that_nobody_can_reach(tmp_path):
    cycle = [(tmp_path / "unreachable.txt").open("w")]
    cycle.append(cycle)

def test_sound(tmp_path, process):
    (tmp_path / "kept.txt").write_text("where it may be")

def test_last(process):
    pass
"""


def test_every_test_and_every_module_is_watched(tmp_path):
    (tmp_path / "test_careless.py").write_text(CARELESS)
    settings = [f"--config-file={ROOT / 'pyproject.toml'}", f"--rootdir={tmp_path}", f"--basetemp={tmp_path / 'own'}"]
    call = [sys.executable, "-m", "pytest", "-p", "tests.conftest", *settings, str(tmp_path)]
    environment = {**os.environ, "PYTHONPATH": str(ROOT)}
    told = subprocess.run(call, env=environment, capture_output=True, text=True, check=False).stdout
    assert "4 passed" in told, told
    assert set(re.findall(r"^ERROR .*::test_(\w+)", told, re.MULTILINE)) == {
        "thread",
        "file_that_nobody_can_reach",
        "last",  # of its module, and so blamed for the module's fixture
    }
    for left in ("thread <Thread(forgotten", "process psutil.Process(", "unclosed file <_io.FileIO name='"):
        assert left in told, told
