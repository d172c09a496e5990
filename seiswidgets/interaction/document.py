"""The document that is edited, and the history that undoes and redoes its changes."""

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from functools import cached_property
from itertools import pairwise
from typing import Any

from seiswidgets.geology.hypothesis import FIRST_NAME
from seiswidgets.geology.plan import Plan
from seiswidgets.geology.section import Section
from seiswidgets.interaction.cutoff_handles import CutOffHandle, cutoff_handles
from seiswidgets.interaction.drawing import Drawing, Pick, PickSelection

DRAFT_LINE = "draft line"  # label of an edit of the draft line alone


@dataclass(frozen=True)
class Alternative:
    """A hypothesis: picks and a plan, with a name."""

    name: str
    drawing: Drawing
    plan: Plan


@dataclass(frozen=True)
class Document:
    """Everything that an edit can change: a section, its picks and the plan to restore it, and other hypotheses.

    Attributes
    ----------
    section : Section
    drawing : Drawing
    plan : Plan
    source : SectionSource or None
        Origin of the section; None for a section made in memory.
    name : str
        Of the hypothesis that drawing and plan make.
    before, after : tuple of Alternative
        The other hypotheses, in their order; see `alternatives`.
    """

    section: Section
    drawing: Drawing = field(default_factory=Drawing)
    plan: Plan = field(default_factory=Plan)
    source: Any = None  # a value to this package, which does not know files
    name: str = FIRST_NAME
    before: tuple[Alternative, ...] = ()
    after: tuple[Alternative, ...] = ()

    @cached_property
    def cutoffs(self) -> tuple[CutOffHandle, ...]:
        """Cut-offs of visible horizons at visible faults."""
        return cutoff_handles(self.drawing, self.section)


@dataclass(frozen=True)
class Entry:
    """A document before or after an edit, with the label of the edit and the selection at that time."""

    label: str
    document: Document
    selection: PickSelection | None


class EditHistory:
    """The current document, with unlimited undo and redo.

    A drag changes the document many times and counts as one edit: ``amend`` changes it, and ``commit`` makes all
    changes since the last commit one edit. ``edit`` does both.

    Parameters
    ----------
    document : Document
    changed : callable(), optional
        Called after each change of the document or of the history.
    check : callable(Document), optional
        Called with the new document before each edit, undo and redo; it may raise to prevent it.
    """

    def __init__(
        self,
        document: Document,
        changed: Callable[[], None] = lambda: None,
        check: Callable[[Document], None] = lambda document: None,
    ):
        self._document = self._committed = document
        self._changed, self._check = changed, check
        self._past: list[Entry] = []
        self._future: list[Entry] = []

    @property
    def document(self) -> Document:
        """The current document, changes that are not committed yet included."""
        return self._document

    @property
    def is_settled(self) -> bool:
        """True if all changes are committed, so that no drag is in progress."""
        return self._document == self._committed

    @property
    def undo_count(self) -> int:
        """Number of edits that can be undone."""
        return len(self._past)

    @property
    def redo_count(self) -> int:
        """Number of edits that can be redone."""
        return len(self._future)

    @property
    def next_undo(self) -> Entry | None:
        """The edit that ``undo`` would undo, with the document before it; None if there is none."""
        return self._past[-1] if self._past else None

    @property
    def next_redo(self) -> Entry | None:
        """The edit that ``redo`` would redo, with the document after it; None if there is none."""
        return self._future[-1] if self._future else None

    def amend(self, **changes: Any) -> None:
        """Change fields of the document without recording an edit yet."""
        self._take(replace(self._document, **changes), self._committed)

    def commit(self, label: str, selection: PickSelection | None = None) -> None:
        """Record all changes since the last commit as one edit, with the selection before it."""
        if self._document != self._committed:
            self._past.append(Entry(label, self._committed, selection))
            self._future.clear()
        self._take(self._document, self._document)

    def edit(self, label: str, selection: PickSelection | None = None, **changes: Any) -> None:
        """Change fields of the document and record the edit, unless nothing changes; "" derives the label."""
        document = replace(self._document, **changes)
        self._check(document)
        if document != self._committed:
            self._past.append(Entry(label or edit_label(self._committed, document), self._committed, selection))
            self._future.clear()
        self._take(document, document)

    def close_draft(self, closed: Callable[[Document], tuple[Document, PickSelection | None]]) -> None:
        """Make the edits of the draft line that was just finished edits of its pick, so that undo does not reopen it.

        Parameters
        ----------
        closed : callable(Document) -> (Document, PickSelection or None)
            Finishes the draft line of a document, and selects the pick.
        """
        begun = len(self._past)
        while begun and self._past[begun - 1].document.drawing.draft:
            begun -= 1
        older, edits = self._past[: max(0, begun - 1)], self._past[max(0, begun - 1) :]
        entries = [
            Entry(entry.label, *closed(entry.document)) if entry.document.drawing.draft else entry for entry in edits
        ]
        documents = [*(entry.document for entry in entries), self._committed]
        self._past = older + [
            replace(entry, label=edit_label(before, after) if entry.label == DRAFT_LINE else entry.label)
            for entry, (before, after) in zip(entries, pairwise(documents), strict=True)
            if before != after
        ]
        self._changed()

    def undo(self, selection: PickSelection | None = None) -> Entry | None:
        """Undo the last edit; return the entry before it, or None if there is no edit."""
        return self._travel(self._past, self._future, selection)

    def redo(self, selection: PickSelection | None = None) -> Entry | None:
        """Redo the edit that was undone last; return the entry after it, or None if there is none."""
        return self._travel(self._future, self._past, selection)

    def forget(self) -> None:
        """Start a new history at the current document."""
        self._past.clear()
        self._future.clear()
        self._committed = self._document
        self._changed()

    def _travel(self, source: list[Entry], target: list[Entry], selection: PickSelection | None) -> Entry | None:
        if not source:
            return None
        self._check(source[-1].document)
        entry = source.pop()
        target.append(Entry(entry.label, self._committed, selection))
        self._take(entry.document, entry.document)
        return entry

    def _take(self, document: Document, committed: Document) -> None:
        is_new = document != self._document or committed != self._committed
        if document != self._document:
            self._document = document
        self._committed = self._document if committed == self._document else committed
        if is_new:
            self._changed()


def edit_label(before: Document, after: Document) -> str:
    """Name the edit of picks, held point or regional level between two documents, as the tooltip of Undo shows it."""
    if before.drawing == after.drawing:
        return "held point" if before.plan.regional == after.plan.regional else "regional level"
    old, new = ({(pick.kind, pick.name): pick for pick in one.drawing.picks} for one in (before, after))
    changed = {key for key in old.keys() & new.keys() if old[key] != new[key]}
    if len(changed) == 1 and old.keys() == new.keys():
        (key,) = changed
        return f"{_change(old[key], new[key])} {key[1]}"
    for verb, keys in (("draw", new.keys() - old.keys()), ("delete", old.keys() - new.keys()), ("change", changed)):
        if keys:
            return f"{verb} {', '.join(name for _, name in sorted(keys))}"
    return DRAFT_LINE


def _change(before: Pick, after: Pick) -> str:
    """Name the change of a pick's pieces, with the preposition that the pick's name follows."""
    pieces = len(after.pieces) - len(before.pieces)
    vertices = sum(map(len, after.pieces)) - sum(map(len, before.pieces))
    if pieces > 0 and set(before.pieces) <= set(after.pieces):
        return "add a piece to"
    if pieces < 0 and set(after.pieces) <= set(before.pieces):
        return "delete a piece of"
    if pieces or before.pieces == after.pieces:
        return "change"
    return "move a vertex of" if not vertices else "add to" if vertices > 0 else "delete a vertex of"
