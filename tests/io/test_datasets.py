import hashlib
import os
import threading
from functools import partial
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer

import numpy as np
import pytest

import seiswidgets as sw
from seiswidgets.errors import DataError
from seiswidgets.io.datasets import F3, FOLDER_VARIABLE, TEAPOT, Source, find_file, read_ascii_inline, read_raw_traces

CONTENT = b"some traces"
SHA256 = hashlib.sha256(CONTENT).hexdigest()


def real(source):
    """Path of a real file; skips the test where there is none, but not in CI."""
    try:
        return find_file(source)
    except DataError:
        if os.environ.get(FOLDER_VARIABLE) or os.environ.get("CI") == "true":
            raise
        pytest.skip(f"the real sections are not here; set {FOLDER_VARIABLE}")


class QuietHandler(SimpleHTTPRequestHandler):
    def log_message(self, *args):
        pass


@pytest.fixture
def published(tmp_path, monkeypatch):
    """A source that a server on this machine serves from a folder of the test, `tmp_path / "published"`."""
    monkeypatch.delenv(FOLDER_VARIABLE, raising=False)
    monkeypatch.setenv("NO_PROXY", "127.0.0.1")
    root = tmp_path / "published"
    (root / "owner/repository/0123/data").mkdir(parents=True)
    (root / "owner/repository/0123/data/traces.dat").write_bytes(CONTENT)
    server = ThreadingHTTPServer(("127.0.0.1", 0), partial(QuietHandler, directory=root))
    thread = threading.Thread(target=server.serve_forever, args=(0.01,))  # seconds between two looks whether to end
    thread.start()
    yield Source("owner/repository", "0123", "data/traces.dat", SHA256, host=f"http://127.0.0.1:{server.server_port}")
    server.shutdown()
    thread.join()
    server.server_close()


@pytest.fixture
def unreachable(monkeypatch):
    """A source at a port of this machine where nobody listens."""
    monkeypatch.delenv(FOLDER_VARIABLE, raising=False)
    monkeypatch.setenv("NO_PROXY", "127.0.0.1")
    return Source("owner/repository", "0123", "data/traces.dat", SHA256, host="http://127.0.0.1:1")


def test_f3_has_each_sample_at_its_crossline_and_time():
    traces = {}
    for line in real(F3).read_text().splitlines():
        _, crossline, *samples = line.split()
        traces[int(crossline)] = np.array(samples, float)
    section = sw.datasets.f3()
    assert section.shape == (463, 951)
    for column, crossline in enumerate(range(300, 1251)):
        np.testing.assert_array_equal(section.amplitude[:, column], traces[crossline])


def test_teapot_has_each_sample_at_its_trace_and_time():
    content = real(TEAPOT).read_bytes()
    section = sw.datasets.teapot()
    assert section.shape == (251, 357)
    for row, column in [(0, 0), (250, 0), (0, 356), (250, 356), (100, 200)]:
        start = 4 * (251 * column + row)
        assert section.amplitude[row, column] == np.frombuffer(content[start : start + 4], ">f4")[0]
    np.testing.assert_array_equal(section.amplitude, np.frombuffer(content, ">f4").reshape(357, 251).T)


@pytest.mark.parametrize(
    ("make", "source", "extent", "owner", "licence"),
    [
        (sw.datasets.f3, F3, (0, 23750, 0, 1848), "dGB Earth Sciences and TNO", "CC BY-SA 3.0"),
        (sw.datasets.teapot, TEAPOT, (0, 8900, 500, 1500), "RMOTC, U.S. Department of Energy", "Apache-2.0"),
    ],
)
def test_real_sections_carry_units_and_show_credit_and_licence(make, source, extent, owner, licence):
    real(source)
    section = make(velocity=2500)
    assert section.extent == extent
    assert (section.x_unit, section.z_unit, section.velocity) == ("m", "ms", 2500)
    assert section.amplitude.dtype.isnative
    for part in (section.name, owner, licence):
        assert part in repr(section)


@pytest.mark.parametrize(("source", "name"), [(F3, "export_inline362.ascii"), (TEAPOT, "tp73.dat")])
def test_sources_are_fixed_to_a_commit(source, name):
    assert source.name == name
    assert source.url == f"https://raw.githubusercontent.com/{source.repository}/{source.commit}/{source.path}"
    assert (len(source.commit), len(source.sha256)) == (40, 64)


def test_a_file_in_the_users_folder_is_used_where_it_lies(tmp_path, monkeypatch, unreachable):
    monkeypatch.setenv(FOLDER_VARIABLE, str(tmp_path))
    (tmp_path / "traces.dat").write_bytes(CONTENT)
    assert find_file(unreachable, cache=tmp_path / "cache") == tmp_path / "traces.dat"
    assert not (tmp_path / "cache").exists()


def test_a_file_in_the_users_folder_with_another_hash_is_named(tmp_path, monkeypatch, published):
    monkeypatch.setenv(FOLDER_VARIABLE, str(tmp_path))
    (tmp_path / "traces.dat").write_bytes(CONTENT[:-1])
    with pytest.raises(DataError, match=rf"{tmp_path}/traces.dat is damaged or another version.*{SHA256}"):
        find_file(published, cache=tmp_path / "cache")


@pytest.mark.parametrize("make", [sw.datasets.f3, sw.datasets.teapot])
def test_a_folder_that_is_not_there_is_named(tmp_path, monkeypatch, make):
    monkeypatch.setenv(FOLDER_VARIABLE, str(tmp_path / "nowhere"))
    with pytest.raises(DataError, match=rf"{FOLDER_VARIABLE} is set to .*nowhere.* not a folder"):
        make()


@pytest.mark.parametrize("folder", [None, "", "empty"])
def test_what_the_users_folder_lacks_is_downloaded_once(tmp_path, monkeypatch, published, folder):
    if folder is not None:
        monkeypatch.setenv(FOLDER_VARIABLE, folder and str(tmp_path))
    path = find_file(published, cache=tmp_path / "cache")
    assert path.parent == tmp_path / "cache"
    assert path.read_bytes() == CONTENT
    (tmp_path / "published/owner/repository/0123/data/traces.dat").unlink()
    assert find_file(published, cache=tmp_path / "cache") == path


def test_a_damaged_file_in_the_cache_is_downloaded_again(tmp_path, published):
    (tmp_path / "traces.dat").write_bytes(b"half")
    assert find_file(published, cache=tmp_path).read_bytes() == CONTENT


def test_a_download_of_something_else_is_refused(tmp_path, published):
    (tmp_path / "published/owner/repository/0123/data/traces.dat").write_bytes(b"please sign in")
    with pytest.raises(DataError, match=r"traces.dat .* could not be downloaded.*hash"):
        find_file(published, cache=tmp_path / "cache")
    assert not list((tmp_path / "cache").glob("*"))


def test_a_file_that_is_no_longer_published_is_an_error(tmp_path, published):
    (tmp_path / "published/owner/repository/0123/data/traces.dat").unlink()
    with pytest.raises(DataError, match=r"could not be downloaded.*404"):
        find_file(published, cache=tmp_path / "cache")


def test_without_a_network_the_error_says_where_to_put_the_file(tmp_path, unreachable):
    with pytest.raises(DataError, match="Download it from") as caught:
        find_file(unreachable, cache=tmp_path / "cache")
    for part in (
        "traces.dat",
        unreachable.url,
        f"put it into {tmp_path}/cache",
        f"set {FOLDER_VARIABLE} to that folder",
    ):
        assert part in str(caught.value)


def test_a_cache_that_cannot_be_written_is_an_error(tmp_path, published):
    (tmp_path / "cache").write_text("a file where the folder should be")
    with pytest.raises(DataError, match="could not be downloaded"):
        find_file(published, cache=tmp_path / "cache")


TEXT = "7 3 0.5 -1 2\n7 2 3 4 5\n"


def test_text_traces_are_put_in_order_of_their_crosslines(tmp_path):
    (tmp_path / "inline.txt").write_text(TEXT)
    amplitude = read_ascii_inline(tmp_path / "inline.txt", shape=(3, 2))
    np.testing.assert_array_equal(amplitude, [[3, 0.5], [4, -1], [5, 2]])


@pytest.mark.parametrize(
    ("text", "message"),
    [
        (TEXT[: TEXT.index("\n") + 1], "must hold 2 lines of 5 numbers .* but holds 1 lines of 5"),
        (TEXT[:-4], "not a text file of 2 traces of equal length"),
        (TEXT.replace("4", "four"), "not a text file of 2 traces"),
        (TEXT.replace("7 2", "7 1"), "lacks a crossline"),
        (TEXT.replace("7 2", "7 3"), "holds one twice"),
    ],
)
def test_a_damaged_text_is_an_error(tmp_path, text, message):
    (tmp_path / "inline.txt").write_text(text)
    with pytest.raises(DataError, match=message):
        read_ascii_inline(tmp_path / "inline.txt", shape=(3, 2))


def test_raw_traces_are_columns(tmp_path):
    (tmp_path / "raw.dat").write_bytes(np.arange(6, dtype=">f4").tobytes())
    np.testing.assert_array_equal(read_raw_traces(tmp_path / "raw.dat", shape=(3, 2)), [[0, 3], [1, 4], [2, 5]])


@pytest.mark.parametrize("size", [0, 20, 23, 28])
def test_raw_traces_of_another_size_are_an_error(tmp_path, size):
    (tmp_path / "raw.dat").write_bytes(bytes(size))
    with pytest.raises(DataError, match=f"must hold 24 bytes .* but holds {size}"):
        read_raw_traces(tmp_path / "raw.dat", shape=(3, 2))
