"""JavaScript and style sheets that the widgets load in the browser.

They are bundled from ``js`` into ``static`` by ``make js``, and committed there.
"""

from pathlib import Path

STATIC = Path(__file__).parent / "static"


def asset(name: str) -> str:
    """Read a bundle.

    A widget receives its ``_esm`` and ``_css`` as text, not as a path: anywidget watches files given as paths, and its
    watcher keeps every widget of the class alive.
    """
    return (STATIC / name).read_text("utf-8")
