"""What README, guides and notebooks point to is there: files, headings, make targets, names; without the network."""

import re
from pathlib import Path

import nbformat
import pytest

import seiswidgets as sw

ROOT = Path(__file__).parents[1]
TARGETS = set(re.findall(r"^([a-z-]+):(?!=)", (ROOT / "Makefile").read_text(encoding="utf-8"), re.MULTILINE))
NOTEBOOKS = sorted((ROOT / "notebooks").glob("*.ipynb"))
PAGES = [*sorted(ROOT.glob("*.md")), *sorted((ROOT / "docs").rglob("*.md")), *NOTEBOOKS]
PAGES = [page for page in PAGES if "_build" not in page.parts]
FENCED = re.compile(r"^```.*?^```", re.DOTALL | re.MULTILINE)
SUFFIXES = "md|py|toml|txt|json|ipynb|css|js|png"


def prose(page):
    """A page's text, of a notebook that of its cells of text."""
    if page.suffix != ".ipynb":
        return page.read_text(encoding="utf-8")
    return "\n\n".join(cell.source for cell in nbformat.read(page, as_version=4).cells if cell.cell_type == "markdown")


def code(page):
    """A page's code, and all between backticks."""
    text = prose(page)
    cells = nbformat.read(page, as_version=4).cells if page.suffix == ".ipynb" else []
    inline = re.findall(r"`([^`\n]+)`", FENCED.sub("", text))
    return "\n".join([*FENCED.findall(text), *inline, *(cell.source for cell in cells if cell.cell_type == "code")])


def links(page):
    """Where a page's links and pictures lead."""
    text = FENCED.sub("", prose(page))
    return re.findall(r"\]\(\s*<?([^)\s>]+)>?\s*\)", text) + re.findall(r"^\[[^\]]+\]:\s*(\S+)", text, re.MULTILINE)


def anchors(page):
    """The headings of a page, as GitHub makes links of them."""
    titles = re.findall(r"^#+\s+(.+?)\s*$", FENCED.sub("", prose(page)), re.MULTILINE)
    return {re.sub(r"[^\w\- ]", "", title.lower()).replace(" ", "-") for title in titles}


def every_page(function):
    return pytest.mark.parametrize("page", PAGES, ids=lambda page: page.relative_to(ROOT).as_posix())(function)


@every_page
def test_links_lead_somewhere(page):
    for link in links(page):
        if "://" in link:
            assert re.fullmatch(r"https://[\w.-]+\.[a-z]{2,}(/[^\s]*)?", link), f"{link} is no address"
            for opened in re.findall(r"urlpath=(?:lab/tree|voila/render)/(.*)", link):
                assert (ROOT / opened).exists(), f"{link}: there is no {opened}"
            continue
        path, _, anchor = link.partition("#")
        target = page if not path else page.parent / path
        assert target.exists(), f"{link} is not there"
        assert not anchor or anchor in anchors(target), f"{link}: there is no such heading"


@every_page
def test_commands_can_be_made(page):
    named = set(re.findall(r"^make ([a-z-]+)", code(page), re.MULTILINE))
    assert named <= TARGETS, f"the Makefile has no {named - TARGETS}"
    assert set(re.findall(r"python -m seiswidgets (\w+)", code(page))) <= {"restore"}


@every_page
def test_public_names_exist(page):
    for name in set(re.findall(r"\bsw((?:\.[A-Za-z_]\w*)+)", code(page))):
        thing, whole = sw, "sw"
        for part in name[1:].split("."):
            whole += f".{part}"
            if isinstance(thing, type) and not hasattr(thing, part):
                break  # an attribute that only an instance has
            assert hasattr(thing, part), f"there is no {whole}"
            thing = getattr(thing, part)


@every_page
def test_files_named_are_there(page):
    named = re.findall(rf"`((?:[\w.-]+/)+[\w.-]+\.(?:{SUFFIXES}))`", FENCED.sub("", prose(page)))
    for folder in (ROOT, ROOT / "seiswidgets"):
        ours = [name for name in named if (folder / name.split("/")[0]).is_dir()]
        assert [name for name in ours if not (folder / name).exists()] == []


def test_there_is_something_to_check():
    assert sum(len(links(page)) for page in PAGES) > 5
    assert {"README.md", "formats.md", "01_restore_a_section.ipynb"} <= {page.name for page in PAGES}
