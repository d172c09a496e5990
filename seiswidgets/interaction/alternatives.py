"""Hypotheses of a document: one is shown and edited, and the others wait before and after it."""

from collections.abc import Callable, Sequence
from dataclasses import replace

from seiswidgets.errors import SettingError
from seiswidgets.geology.plan import Plan
from seiswidgets.interaction.document import Alternative, Document
from seiswidgets.interaction.drawing import Drawing


def alternatives(document: Document) -> tuple[Alternative, ...]:
    """All hypotheses of a document in their order, the one that is shown included."""
    return *document.before, Alternative(document.name, document.drawing, document.plan), *document.after


def with_alternatives(document: Document, hypotheses: Sequence[Alternative], index: int) -> Document:
    """A document of these hypotheses, of which one is shown."""
    shown = hypotheses[index]
    before, after = tuple(hypotheses[:index]), tuple(hypotheses[index + 1 :])
    return replace(document, name=shown.name, drawing=shown.drawing, plan=shown.plan, before=before, after=after)


def changed_alike(document: Document, change: Callable[[Drawing, Plan], tuple[Drawing, Plan]]) -> Document:
    """Change picks and plan of every hypothesis by the same function."""
    changed = [Alternative(one.name, *change(one.drawing, one.plan)) for one in alternatives(document)]
    return with_alternatives(document, changed, len(document.before))


def switched(document: Document, index: int) -> Document:
    """Show another hypothesis."""
    return with_alternatives(document, alternatives(document), index)


def duplicated(document: Document) -> Document:
    """Copy the hypothesis that is shown, and show the copy, under the next free letter."""
    hypotheses = list(alternatives(document))
    copy = replace(hypotheses[len(document.before)], name=free_name([one.name for one in hypotheses]))
    hypotheses.insert(len(document.before) + 1, copy)
    return with_alternatives(document, hypotheses, len(document.before) + 1)


def renamed(document: Document, name: str) -> Document:
    """Rename the hypothesis that is shown; SettingError if the name is empty, or that of another one."""
    name = name.strip()
    if not name:
        raise SettingError("the name of a hypothesis must not be empty")
    if name in {one.name for one in (*document.before, *document.after)}:
        raise SettingError(f"there is a hypothesis called {name!r} already; give each a name of its own")
    return replace(document, name=name)


def removed(document: Document) -> Document:
    """Remove the hypothesis that is shown, and show its neighbour; the last one stays."""
    others = [*document.before, *document.after]
    return with_alternatives(document, others, min(len(document.before), len(others) - 1)) if others else document


def moved(document: Document, step: int) -> Document:
    """Move the hypothesis that is shown up (-1) or down (1) in the order."""
    hypotheses, index = list(alternatives(document)), len(document.before)
    target = min(max(index + step, 0), len(hypotheses) - 1)
    hypotheses.insert(target, hypotheses.pop(index))
    return with_alternatives(document, hypotheses, target)


def free_name(names: Sequence[str]) -> str:
    """First of A, B, ..., Z, A2, B2, ... that is not in use."""
    letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZ"
    candidates = (
        letter + (str(round_) if round_ > 1 else "") for round_ in range(1, len(names) + 2) for letter in letters
    )
    return next(name for name in candidates if name not in names)
