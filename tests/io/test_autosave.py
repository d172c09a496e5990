import os
import shutil
import subprocess
import sys
import threading
import time
from dataclasses import replace
from pathlib import Path

import pytest

import seiswidgets as sw
from seiswidgets.errors import DataError
from seiswidgets.io.session.autosave import find_versions, numbered_files, set_aside
from seiswidgets.io.session.saved_picks import SavedPick

ROOT = Path(__file__).parents[2]
SESSION = sw.Session(sw.SectionSource("dataset", "f3"), None)
QUICK = {"behind": 0.01, "again": 0.01}


def session(number):
    """Sessions that differ: their fault lies elsewhere."""
    return replace(SESSION, faults=(SavedPick("F1", (((number, 0.0), (number, 9.0)),)),))


def wait_for(condition, seconds=20.0):
    """Wait until a condition holds; how long that took."""
    begun = time.monotonic()
    while not condition():
        if time.monotonic() - begun > seconds:
            pytest.fail("the condition did not come to hold")
        threading.Event().wait(0.002)
    return time.monotonic() - begun


@pytest.fixture
def path(tmp_path):
    """Path to save to; no unfinished file must be left behind."""
    yield tmp_path / "line.json"
    assert not list(tmp_path.rglob("*.part"))


class Disk:
    """Makes `os.replace` fail with a reason while there is one."""

    def __init__(self, monkeypatch):
        self.reason, self.tries, self._replace = None, 0, os.replace
        monkeypatch.setattr(os, "replace", self)

    def __call__(self, *paths):
        self.tries += 1
        if self.reason:
            raise OSError(*self.reason)
        self._replace(*paths)


@pytest.fixture
def disk(monkeypatch):
    return Disk(monkeypatch)


def test_an_edit_is_saved_within_a_second(path):
    with sw.Autosave(path) as autosave:
        waits = []
        for number in range(1, 4):  # the quickest of three: what else this machine does is not ours
            autosave.save(session(number))
            waits.append(wait_for(lambda number=number: number in numbered_files(path)))
            wait_for(lambda: autosave.pending is None)
            assert find_versions(path)[0].session == session(number)
    assert min(waits) < 1


def test_edits_close_together_are_saved_once_and_none_waits_for_the_last(path):
    with sw.Autosave(path, behind=0.3) as autosave:
        begun, number = time.monotonic(), 0
        while not (versions := find_versions(path)):  # edits go on and on, and yet they are saved
            assert time.monotonic() - begun < 20
            number += 1
            autosave.save(session(number))
    assert versions[-1].path.name == "line.000001.json"
    assert 10 < versions[-1].session.faults[0].pieces[0][0][0] <= number
    assert find_versions(path)[0].session == session(number)


def test_the_last_ten_versions_stay_the_newest_first(path):
    with sw.Autosave(path, **QUICK) as autosave:
        for number in range(14):
            autosave.save(session(number))
            wait_for(lambda: autosave.pending is None)
    versions = find_versions(path)
    assert [version.session for version in versions] == [session(number) for number in range(13, 3, -1)]
    assert [version.path.name for version in versions[:2]] == ["line.000014.json", "line.000013.json"]
    assert len(list(path.parent.iterdir())) == 10
    with sw.Autosave(path, keep=3, **QUICK) as autosave:
        autosave.save(session(99))
    assert [version.path.name for version in find_versions(path)] == [
        "line.000015.json",
        "line.000014.json",
        "line.000013.json",
    ]


def test_nothing_is_saved_twice(path, disk):
    with sw.Autosave(path, **QUICK) as autosave:
        for _ in range(3):
            autosave.save(session(1))
            wait_for(lambda: autosave.pending is None)
    assert disk.tries == 1


def test_closing_saves_what_waits(path):
    with sw.Autosave(path, behind=60.0) as autosave:
        autosave.save(session(5))
    assert find_versions(path)[0].session == session(5)
    with pytest.raises(DataError, match="is closed and saves no more"):
        autosave.save(session(6))
    autosave.close()


@pytest.mark.parametrize("reason", [(28, "No space left on device"), (30, "Read-only file system")])
def test_a_full_or_read_only_disk_is_told_once_and_tried_until_it_works(path, disk, reason):
    told = []
    with sw.Autosave(path, report=told.append, **QUICK) as autosave:
        disk.reason = reason
        autosave.save(session(1))
        wait_for(lambda: disk.tries > 5)
        assert autosave.pending == session(1)
        autosave.save(session(2))
        assert not find_versions(path)
        disk.reason = None
        wait_for(lambda: autosave.pending is None)  # the try under way may still be that of the first
        assert find_versions(path)[0].session == session(2)
    failure, mended = told
    assert isinstance(failure, DataError)
    assert reason[1] in str(failure)
    assert mended is None


def test_a_folder_that_goes_and_comes_back(path):
    told = []
    folder, aside = path.parent / "work", path.parent / "aside"
    folder.mkdir()
    with sw.Autosave(folder / "line.json", report=told.append, **QUICK) as autosave:
        autosave.save(session(1))
        wait_for(lambda: autosave.pending is None)
        folder.rename(aside)
        folder.write_text("a file in its place")
        autosave.save(session(2))
        wait_for(lambda: told)
        folder.unlink()
        aside.rename(folder)
        wait_for(lambda: autosave.pending is None)
    assert "cannot be written: Not a directory" in str(told[0])
    assert [version.session for version in find_versions(folder / "line.json")] == [session(2), session(1)]


def test_closing_while_the_disk_is_full_tells_and_keeps(path, disk):
    disk.reason = (28, "No space left on device")
    autosave = sw.Autosave(path, **QUICK)
    autosave.save(session(1))
    with pytest.raises(DataError, match="No space left on device"):
        autosave.close()
    assert autosave.pending == session(1)


def test_an_error_in_what_is_reported_to_does_not_end_the_saving(path, disk, caplog):
    disk.reason = (28, "No space left on device")
    with sw.Autosave(path, report=lambda error: 1 / 0, **QUICK) as autosave:
        autosave.save(session(1))
        wait_for(lambda: disk.tries > 2)
        disk.reason = None
    assert find_versions(path)[0].session == session(1)
    assert "ZeroDivisionError" in caplog.text


def test_what_is_set_aside_stays(path):
    assert set_aside(path) is None
    with sw.Autosave(path, keep=2, **QUICK) as autosave:
        for number in range(2):
            autosave.save(session(number))
            wait_for(lambda: autosave.pending is None)
        copy = set_aside(path)
        for number in range(2, 5):
            autosave.save(session(number))
            wait_for(lambda: autosave.pending is None)
    assert copy.name == "line.before-000002.json"
    assert sw.open_session(copy) == session(1)
    assert [version.session for version in find_versions(path)] == [session(4), session(3)]


def test_a_session_saved_under_the_path_itself_is_found_last(path):
    session(1).save(path)
    assert [version.path for version in find_versions(path)] == [path]
    with sw.Autosave(path, **QUICK) as autosave:
        autosave.save(session(2))
    assert [version.session for version in find_versions(path)] == [session(2), session(1)]


def test_the_path_may_begin_with_the_home_folder(path, monkeypatch):
    monkeypatch.setenv("HOME", str(path.parent))
    monkeypatch.setenv("USERPROFILE", str(path.parent))
    for number in (1, 2):
        with sw.Autosave("~/line.json", **QUICK) as autosave:
            autosave.save(session(number))
    assert [version.session for version in find_versions("~/line.json")] == [session(2), session(1)]
    assert set_aside("~/line.json") == path.with_name("line.before-000002.json")


def test_damaged_versions_are_left_out(path):
    with sw.Autosave(path, **QUICK) as autosave:
        for number in range(3):
            autosave.save(session(number))
            wait_for(lambda: autosave.pending is None)
    newest, middle, _ = find_versions(path)
    newest.path.write_bytes(newest.path.read_bytes()[:-30])
    (path.parent / "line.000009.json").mkdir()
    (path.parent / "other.000009.json").write_text("{}")
    assert [version.path for version in find_versions(path)] == [middle.path, path.with_name("line.000001.json")]
    assert find_versions(path.parent / "nowhere" / "line.json") == []


KILLED = """
import itertools, sys, threading
import seiswidgets as sw
from tests.io.test_autosave import session
autosave = sw.Autosave(sys.argv[1], behind=0.0)
for number in itertools.count():
    autosave.save(session(number))
    threading.Event().wait(0.001)
"""


def test_a_process_that_is_killed_leaves_only_complete_versions(path):
    process = subprocess.Popen([sys.executable, "-c", KILLED, str(path)], cwd=ROOT)
    try:
        wait_for(lambda: max(numbered_files(path), default=0) > 12, seconds=60)
    finally:
        process.kill()
        process.wait()
    versions = find_versions(path)
    assert 9 <= len(versions) <= 11  # killed between a new version and the deletion of an old one
    assert len(versions) == len(list(path.parent.glob("line.*.json")))
    for unfinished in path.parent.glob(".*.part"):  # what the killed process was at
        shutil.rmtree(unfinished)


def test_what_waits_is_saved_when_the_process_ends(path):
    code = (
        "import seiswidgets as sw\n"
        f"autosave = sw.Autosave({str(path)!r}, behind=60.0)\n"
        "autosave.save(sw.Session(sw.SectionSource('dataset', 'f3'), None))\n"
    )
    subprocess.run([sys.executable, "-c", code], cwd=ROOT, check=True)
    assert find_versions(path)[0].session == SESSION


def test_versions_of_another_kernel_stay(path):
    with sw.Autosave(path, **QUICK) as first, sw.Autosave(path, **QUICK) as other:
        save_one_by_one(first, [100])
        save_one_by_one(other, range(11))
    assert session(100) in [version.session for version in find_versions(path)]


def test_the_last_version_of_an_earlier_kernel_stays(path):
    with sw.Autosave(path, **QUICK) as earlier:
        save_one_by_one(earlier, [100])
    with sw.Autosave(path, **QUICK) as autosave:
        save_one_by_one(autosave, range(11))
    assert session(100) in [version.session for version in find_versions(path)]


def save_one_by_one(autosave, numbers):
    for number in numbers:
        autosave.save(session(number))
        wait_for(lambda: autosave.pending is None)
