import os

os.environ["MPLBACKEND"] = "Agg"  # no windows; before anything imports matplotlib

import gc
import sys
import tempfile
from pathlib import Path

import pytest

from tests.leftovers import nothing_left

ROOT = Path(__file__).parents[1]
PLACES = [Path(folder) for name in ("seiswidgets", "tests", "notebooks") for folder, *_ in os.walk(ROOT / name)]
CODE = [folder for folder in PLACES if folder.name != "__pycache__"]


def pytest_addoption(parser):
    parser.addoption("--without-triangle", action="store_true", help="test as where Triangle is not installed")


def pytest_configure(config):
    if config.getoption("--without-triangle"):
        sys.modules["triangle"] = None  # importing it raises ImportError


@pytest.fixture(scope="session", autouse=True)
def own_folders(tmp_path_factory):
    """A home and a place for temporary files that are the session's own, and are left as they were.

    The user's cache stays in use: it holds the real sections, once they have been fetched, and matplotlib's fonts.
    """
    home, temporary = tmp_path_factory.mktemp("home"), tmp_path_factory.mktemp("temporary")
    cache = os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache"
    with pytest.MonkeyPatch.context() as patch:
        for name in ("XDG_CONFIG_HOME", "XDG_DATA_HOME", "XDG_STATE_HOME"):
            patch.delenv(name, raising=False)
        for name, folder in {"HOME": home, "TMPDIR": temporary, "XDG_CACHE_HOME": cache}.items():
            patch.setenv(name, str(folder))
        patch.setenv("NODE_DISABLE_COMPILE_CACHE", "1")  # JupyterLab asks npm for a path, which would leave a cache
        patch.setattr(tempfile, "tempdir", str(temporary))
        gc.collect()
        gc.freeze()  # what has been imported is not looked through again, which makes the later collections quick
        with nothing_left(temporary):
            yield home, temporary


@pytest.fixture(scope="module", autouse=True)
def nothing_left_by_the_module():
    """Nothing new is in the folders of the project, and what was not closed is warned of."""
    with nothing_left(ROOT, *CODE, only_files=True):  # what runs may be the session's, begun in mid-module
        yield
        gc.collect()


@pytest.fixture(autouse=True)
def nothing_left_by_the_test(own_folders):
    with nothing_left(*own_folders):
        yield
