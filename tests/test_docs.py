"""The documentation names all that is public; its examples and that of the README hold."""

import doctest
import importlib
import inspect
import pkgutil
import re
from pathlib import Path
from typing import get_type_hints

import matplotlib.pyplot as plt
import pytest

import seiswidgets as sw
from seiswidgets.geology.synthetic import Synthetic
from tests.executors import resource_trackers

ROOT = Path(__file__).parents[1]
API = ROOT / "docs" / "api"
README = (ROOT / "README.md").read_text(encoding="utf-8")
PAGES = "\n".join(page.read_text(encoding="utf-8") for page in API.glob("*.md"))
MODULES = [module.name for module in pkgutil.walk_packages(sw.__path__, "seiswidgets.") if module.name[-2:] != "__"]


def examples():
    """The examples in the docstrings of all modules."""
    finder = doctest.DocTestFinder(exclude_empty=True)
    return [test for name in MODULES for test in finder.find(importlib.import_module(name)) if test.examples]


def test_every_public_name_is_on_a_page_once():
    named = re.findall(r"^\.\. auto\w+:: (\S+)", PAGES, re.MULTILINE)
    public = [name.removeprefix("seiswidgets.") for name in named]
    assert sorted(name for name in public if "." not in name) == sorted(sw.__all__)


@pytest.mark.parametrize("module", [sw.datasets, sw.synthetic], ids=lambda module: module.__name__)
def test_every_section_that_can_be_made_is_on_a_page(module):
    members_of = inspect.getmembers(module, inspect.isfunction)
    functions = {name: one for name, one in members_of if one.__module__ == module.__name__}
    made = {name for name, one in functions.items() if get_type_hints(one).get("return") in (sw.Section, Synthetic)}
    assert {name for name in made if name[0] != "_"} <= members(module.__name__.rpartition(".")[2])


def test_every_picture_is_on_a_page():
    assert set(sw.plot.__all__) == members("plot")


def members(module):
    """Those of a module that its page names."""
    (names,) = re.findall(rf"automodule:: seiswidgets\.{module}\n   :members: (.*)", PAGES)
    return set(names.split(", "))


@pytest.mark.parametrize("example", examples(), ids=lambda example: example.name)
def test_the_docstrings_example_holds(example):
    result = doctest.DocTestRunner(optionflags=doctest.ELLIPSIS | doctest.NORMALIZE_WHITESPACE).run(example)
    assert result.attempted
    assert not result.failed


def test_the_readmes_examples_run_one_after_the_other(tmp_path, monkeypatch, capsys):
    examples = re.findall(r"^```python\n(.*?)^```", README, flags=re.DOTALL | re.MULTILINE)
    monkeypatch.chdir(tmp_path)
    names = {}
    with resource_trackers():
        for example in examples:
            exec(example.replace("members=200", "members=3"), names)  # which takes too long for a test
    plt.close("all")
    assert "settled" in capsys.readouterr().out
    assert (tmp_path / "workflow.png").stat().st_size > 10_000
