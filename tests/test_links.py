"""Links, commands and names in README, guides and notebooks all exist. The network is not used."""

import re
from pathlib import Path

import nbformat
import pytest

import seiswidgets as sw
from seiswidgets.__main__ import main

ROOT = Path(__file__).parents[1]
TARGETS = set(re.findall(r"^([a-z-]+):(?!=)", (ROOT / "Makefile").read_text(encoding="utf-8"), re.MULTILINE))
NOTEBOOKS = sorted((ROOT / "notebooks").glob("*.ipynb"))
PAGES = [*sorted(ROOT.glob("*.md")), *sorted((ROOT / "docs").rglob("*.md")), *sorted((ROOT / "teaching").glob("*.md"))]
PAGES += NOTEBOOKS
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
    """Targets of a page's links and pictures."""
    text = FENCED.sub("", prose(page))
    return re.findall(r"\]\(\s*<?([^)\s>]+)>?\s*\)", text) + re.findall(r"^\[[^\]]+\]:\s*(\S+)", text, re.MULTILINE)


def anchors(page):
    """The headings of a page, as GitHub makes links of them."""
    titles = re.findall(r"^#+\s+(.+?)\s*$", FENCED.sub("", prose(page)), re.MULTILINE)
    return {re.sub(r"[^\w\- ]", "", title.lower()).replace(" ", "-") for title in titles}


def on_pages(find):
    """Pairs of a page and each thing that a function finds on it, of which there must be several."""
    found = [(page, one) for page in PAGES for one in find(page)]
    assert len({page for page, _ in found}) > 2
    return found


def missing(found, exists):
    """Name what does not exist, and the page that mentions it."""
    return [f"{page.relative_to(ROOT)}: {one}" for page, one in found if not exists(page, one)]


def leads_somewhere(page, link):
    if "://" in link:
        opened = re.findall(r"urlpath=(?:lab/tree|voila/render)/(.*)", link)
        is_address = re.fullmatch(r"https://[\w.-]+\.[a-z]{2,}(/[^\s]*)?", link)
        return is_address and all((ROOT / path).exists() for path in opened)
    path, _, anchor = link.partition("#")
    target = page.parent / path if path else page
    return target.exists() and (not anchor or anchor in anchors(target))


def is_public(page, name):
    thing = sw
    for part in name[1:].split("."):
        if isinstance(thing, type) and not hasattr(thing, part):
            return True  # an attribute that only an instance has
        if not hasattr(thing, part):
            return False
        thing = getattr(thing, part)
    return True


def test_links_lead_somewhere():
    assert missing(on_pages(links), leads_somewhere) == []


def test_commands_can_be_made():
    targets = on_pages(lambda page: re.findall(r"^make ([a-z-]+)", code(page), re.MULTILINE))
    assert missing(targets, lambda page, target: target in TARGETS) == []
    commands = [word for page in PAGES for word in re.findall(r"python -m seiswidgets (\w+)", code(page))]
    assert {"restore", "assign", "grade"} <= set(commands)
    for command in set(commands):
        with pytest.raises(SystemExit, match="0"):
            main([command, "--help"])


def test_public_names_exist():
    names = on_pages(lambda page: set(re.findall(r"\bsw((?:\.[A-Za-z_]\w*)+)", code(page))))
    assert missing(names, is_public) == []


def test_files_named_are_there():
    pattern = rf"`((?:[\w.-]+/)+[\w.-]+\.(?:{SUFFIXES}))`"
    named = on_pages(lambda page: re.findall(pattern, FENCED.sub("", prose(page))))
    for folder in (ROOT, ROOT / "seiswidgets"):
        ours = [(page, name) for page, name in named if (folder / name.split("/")[0]).is_dir()]
        assert ours
        assert missing(ours, lambda page, name, folder=folder: (folder / name).exists()) == []
