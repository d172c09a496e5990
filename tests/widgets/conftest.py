import contextlib
import os
import shutil

import ipywidgets
import pytest

from seiswidgets.widgets.ipycanvas_compat import CANVAS_MANAGER
from tests.leftovers import ended, family
from tests.widgets.appscreen import EMPTY, SHOWN, AppScreen
from tests.widgets.bare import BareLayer
from tests.widgets.browser import FLAGS, Notebook, Page, Server
from tests.widgets.canvas_messages import CanvasMessage


@pytest.fixture(autouse=True)
def loud_callbacks(monkeypatch):
    """Callbacks that fail, fail the test: ipywidgets would log that and go on, and has no switch for it."""

    def call(self, *args, **kwargs):
        return [callback(*args, **kwargs) for callback in self.callbacks]

    monkeypatch.setattr(ipywidgets.CallbackDispatcher, "__call__", call)


@pytest.fixture
def sent(monkeypatch):
    """All messages to canvases, decoded; ipycanvas has no public way to read them."""
    messages = []
    monkeypatch.setattr(
        CANVAS_MANAGER, "send", lambda content, buffers=None: messages.append(CanvasMessage.decode(buffers))
    )
    return messages


@pytest.fixture(scope="session")
def chromium():
    """A running Chromium; skips where there is none, but never in CI."""
    path = shutil.which("chromium") or shutil.which("google-chrome")
    if path is None:
        missing = "there is no Chromium here; on Debian: apt-get install chromium"
        pytest.fail(missing) if os.environ.get("CI") else pytest.skip(missing)
    from playwright.sync_api import sync_playwright

    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=path, args=FLAGS)
        yield browser
        told = browser.new_browser_cdp_session().send("SystemInfo.getProcessInfo")["processInfo"]
        processes = family(next(one["id"] for one in told if one["type"] == "browser"))
        browser.close()
        ended(processes)


@pytest.fixture(scope="session")
def lab(tmp_path_factory):
    """A JupyterLab of its own: its address, its token and its folder."""
    with _running(tmp_path_factory.mktemp("lab")) as server:
        yield server


@pytest.fixture(scope="session")
def other_server(tmp_path_factory):
    """Another one, for Voila's pages: after one of those, JupyterLab's fonts are refused."""
    with _running(tmp_path_factory.mktemp("other")) as server:
        yield server


@contextlib.contextmanager
def _running(folder):
    server = Server(folder)
    try:
        server.wait()
        yield server
    finally:
        server.end()


@pytest.fixture(scope="session")
def spare():
    """A page of JupyterLab for the next test: to load one takes ten times as long as to open a notebook in it."""
    return []


@pytest.fixture
def notebook(lab, chromium, spare, request):
    """A function that opens a notebook, or cells as one, and runs it; at the end the console must hold no error."""
    opened, failed = [], request.session.testsfailed

    def open_notebook(*cells, path=None, ratio=1.0, touch=False, **options):
        plain = ratio == 1 and not touch
        one = spare.pop() if plain and spare else Notebook(lab, chromium, ratio=ratio, touch=touch)
        opened.append((one, plain))
        one.open(path or lab.write(cells), kernel=None if path else lab.prepared(), **options)
        lab.prepare()
        return one

    yield open_notebook
    errors = [error for one, _ in opened for error in one.errors]
    for one, plain in opened:
        if request.session.testsfailed > failed or errors or one.page.is_closed():
            one.close()  # as it is now, no other test shall have it
        else:
            one.shut()
            spare.append(one) if plain else one.close()
    lab.end_kernels()
    assert errors == []


@pytest.fixture
def elsewhere(other_server, chromium):
    """A function that opens a cell of code at another place of the server; the console must hold no error."""
    opened = []

    def open_page(cell, place):
        name = other_server.write([cell])
        opened.append(Page(chromium, other_server.address(name, place), height=1150))
        return opened[-1]

    yield open_page
    for one in opened:
        one.close()
    other_server.end_kernels()
    assert [error for one in opened for error in one.errors] == []


@pytest.fixture
def open_app(notebook):
    """A function that shows an app, made by some code besides that of an empty one, in a notebook's cell."""

    def open_it(*code, more=(), height=1150, **options):
        return AppScreen(notebook("".join([EMPTY, *code, SHOWN]), *more, height=height, **options))

    return open_it


@pytest.fixture
def bare_layer(chromium):
    """A function that shows the pointer layer in a page of its own; at the end the console must hold no error."""
    opened = []

    def open_layer(**options):
        opened.append(BareLayer(chromium, **options))
        return opened[-1]

    yield open_layer
    for one in opened:
        one.close()
    assert [error for one in opened for error in one.errors] == []
