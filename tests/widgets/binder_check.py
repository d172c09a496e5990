"""Notebooks in an environment of just what binder/ lists, with the memory they take: run by `make binder-check`."""

import os
import shutil
from pathlib import Path

import psutil
import pytest

from tests.widgets.browser import ROOT, Notebook, Server
from tests.widgets.byhand import is_painted
from tests.widgets.test_notebooks_browser import has_run

MOST_MEGABYTES = 1000  # of server and kernels together; Binder gives between 1,000 and 2,000
OPENED = sorted((ROOT / "notebooks").glob("0[16]_*.ipynb"))


@pytest.fixture
def binder(tmp_path):
    """JupyterLab of the environment that `make binder-check` has made, with the notebooks."""
    server = Server(tmp_path, Path(os.environ["SEISWIDGETS_BINDER"]) / "bin" / "python")
    shutil.copytree(ROOT / "notebooks", server.folder, dirs_exist_ok=True)
    try:
        server.wait()
        yield server
    finally:
        server.end()


def test_notebooks_open_in_what_binder_installs_and_its_memory_suffices(binder, chromium):
    print()
    opened = []
    try:
        for path in OPENED:
            opened.append(Notebook(binder, chromium))
            opened[-1].open(path.name)
            has_run(opened[-1])
            print(f"{path.stem}: {megabytes(binder):.0f} MB with all so far open")
        is_painted(opened[0].page)
        assert Path(opened[0].ask("sw.__file__")).is_relative_to(os.environ["SEISWIDGETS_BINDER"])
        assert [error for one in opened for error in one.errors] == []
        assert megabytes(binder) < MOST_MEGABYTES
        show_dashboard(binder, opened[0].context.new_page())
    finally:
        for one in opened:
            one.close()


def show_dashboard(binder, page):
    page.goto(f"http://127.0.0.1:{binder.port}/voila/render/dashboard.ipynb?token={binder.token}")
    is_painted(page)
    print(f"dashboard: {megabytes(binder):.0f} MB with all so far open")


def megabytes(server):
    """Memory of a server and its kernels; what processes share is counted once, where the system tells."""
    first = psutil.Process(server.process.pid)
    used = (process.memory_full_info() for process in (first, *first.children(recursive=True)))
    return sum(getattr(memory, "pss", memory.rss) for memory in used) / 2**20
