"""All picks on a section as one frozen value: every edit makes a new one, so that undo is exact."""

import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from seiswidgets.errors import PickError, SettingError
from seiswidgets.geology.bodies import BODY, SALT, check_kind
from seiswidgets.geology.pick_colours import COLOURS
from seiswidgets.geology.picks import (
    AUTO,
    AUTO_ENDS,
    CONSTRAIN,
    FAULT,
    HORIZON,
    Ends,
    Fault,
    Horizon,
    Interpretation,
    LineMap,
    both_ends,
    check_use,
    usable,
)
from seiswidgets.geology.section import Section

LETTERS = {FAULT: "F", HORIZON: "H", BODY: "B"}
LEAST_POINTS = {FAULT: 2, HORIZON: 2, BODY: 3}

Point = tuple[float, float]
Points = tuple[Point, ...]
_usable = lru_cache(maxsize=64)(usable)  # every property of a drawing needs it


@dataclass(frozen=True)
class Pick:
    """A fault or a body, of one piece, or a horizon, of any number of pieces.

    Attributes
    ----------
    kind : {"fault", "horizon", "body"}
    name : str
    pieces : tuple of tuples of points (x, z)
    colour : str
        "#rrggbb", or the name of a colour.
    visible : bool
        Hidden picks take part in the restoration all the same.
    use : {"constrain", "carry", "ignore"}
        See `Fault` and `Horizon`.
    ends : pair of {"auto", "tip", "extend"}
        See `Fault`.
    body : {"salt", "no data"}
        See `Body`.
    """

    kind: str
    name: str
    pieces: tuple[Points, ...]
    colour: str
    visible: bool = True
    use: str = CONSTRAIN
    ends: Ends = AUTO_ENDS
    body: str = SALT


@dataclass(frozen=True)
class DraftLine:
    """A line that is being drawn.

    Attributes
    ----------
    kind : {"fault", "horizon", "body"}
    points : tuple of points (x, z)
    name : str or None
        Name of the pick that the line becomes a piece of; None if it becomes a new pick.
    """

    kind: str
    points: Points
    name: str | None = None


@dataclass(frozen=True)
class PickSelection:
    """A pick, a piece of it, or a vertex of that; without a name, the draft line or a vertex of it."""

    kind: str
    name: str | None
    piece: int | None = None
    vertex: int | None = None


@dataclass(frozen=True)
class Drawing:
    """All picks and the draft line.

    Its methods return a new drawing. Invalid lines, such as ones that cross themselves, are kept and listed in
    ``problems``.
    """

    picks: tuple[Pick, ...] = ()
    draft: DraftLine | None = None

    def pick(self, kind: str, name: str) -> Pick:
        """Look up a pick by kind and name; PickError if there is none."""
        for pick in self.picks:
            if (pick.kind, pick.name) == (kind, name):
                return pick
        raise PickError(f"there is no {kind} called {name!r}; there are {', '.join(map(repr, self.names(kind)))}")

    def names(self, kind: str) -> tuple[str, ...]:
        """Names of the picks of a kind."""
        return tuple(pick.name for pick in self.picks if pick.kind == kind)

    def free_name(self, kind: str) -> str:
        """First of F1, F2, ..., H1, H2, ... or B1, B2, ... that is not in use."""
        names = self.names(kind)
        return next(name for index in range(1, len(names) + 2) if (name := f"{LETTERS[kind]}{index}") not in names)

    def line(self, target: PickSelection) -> Points:
        """Points of the line that a target lies on; empty if there is no such line."""
        if target.name is None:
            return self.draft.points if self.draft else ()
        pieces = next((pick.pieces for pick in self.picks if (pick.kind, pick.name) == (target.kind, target.name)), ())
        return pieces[target.piece] if target.piece is not None and target.piece < len(pieces) else ()

    @property
    def draft_end(self) -> PickSelection | None:
        """The last vertex of the draft line; None if there is no draft line."""
        return PickSelection(self.draft.kind, None, 0, len(self.draft.points) - 1) if self.draft else None

    def with_line(self, target: PickSelection, points: ArrayLike) -> "Drawing":
        """Replace the points of a line; a piece of too few points goes, and so does a pick without pieces."""
        if target.name is None:
            return self._with_draft(_points(points))
        pieces: list[ArrayLike] = list(self.pick(target.kind, target.name).pieces)
        index, points = target.piece or 0, _points(points)
        pieces[index : index + 1] = [points] if len(points) >= LEAST_POINTS[target.kind] else []
        return self.with_pieces(target.kind, target.name, pieces)

    def with_pieces(self, kind: str, name: str, pieces: Sequence[ArrayLike]) -> "Drawing":
        """Replace the pieces of a pick; without any, the pick goes."""
        if not pieces:
            return self.without_pick(kind, name)
        return self.with_changes(kind, name, pieces=tuple(map(_points, pieces)))

    def with_changes(self, kind: str, name: str, /, **changes: Any) -> "Drawing":
        """Change fields of a pick."""
        old = self.pick(kind, name)
        return replace(self, picks=tuple(replace(old, **changes) if pick is old else pick for pick in self.picks))

    def with_vertex_moved(self, target: PickSelection, point: Sequence[float]) -> "Drawing":
        """Move a vertex to a point."""
        return self._with_vertices(target, [point], removed=1)

    def with_vertex_inserted(self, target: PickSelection, point: Sequence[float]) -> "Drawing":
        """Insert a vertex before the one at the target."""
        return self._with_vertices(target, [point], removed=0)

    def with_vertex_removed(self, target: PickSelection) -> "Drawing":
        """Remove a vertex."""
        return self._with_vertices(target, [], removed=1)

    def with_draft_begun(self, kind: str, point: Point, name: str | None = None) -> "Drawing":
        """Begin a draft line at a point; with the name of a horizon, it becomes a further piece of that one."""
        return replace(self, draft=DraftLine(kind, _points([point]), name))

    def with_draft_extended(self, points: ArrayLike) -> "Drawing":
        """Append vertices to the draft line."""
        return self._with_draft((self.draft.points if self.draft else ()) + _points(points))

    def with_draft_continued(self, stretches: Sequence[np.ndarray]) -> "Drawing":
        """Continue the draft line along stretches, the first of which starts at its end.

        A horizon is broken between two stretches, so that each makes a piece of its own. A fault runs on.
        """
        first, *others = stretches
        drawing = self.with_draft_extended(first[1:])
        for stretch in others:
            drawing = drawing._broken_off().with_draft_extended(stretch)
        return drawing

    def with_draft_finished(self) -> tuple["Drawing", str | None]:
        """Turn the draft line into a pick, or a piece of one, and return the name of that too.

        A line of fewer than two different points, or a body of fewer than three, stays a draft, and the name is None.
        """
        draft = self.draft
        if draft is None or len(set(draft.points)) < LEAST_POINTS[draft.kind]:
            return self, None
        drawing = replace(self, draft=None)
        if draft.name is not None and draft.name in drawing.names(draft.kind):
            pieces = (*drawing.pick(draft.kind, draft.name).pieces, draft.points)
            return drawing.with_changes(draft.kind, draft.name, pieces=pieces, visible=True), draft.name
        name = self.free_name(draft.kind) if draft.name is None else draft.name
        return drawing.with_pick(draft.kind, name, [draft.points]), name

    def with_name(self, kind: str, name: str, new: str) -> "Drawing":
        """Rename a pick; a horizon given the name of another one becomes pieces of it.

        Raises
        ------
        PickError
            If the name is empty, or if another fault or body has it.
        """
        pick, new = self.pick(kind, name), str(new).strip()
        if not new:
            raise PickError(f"the name of {kind} {name!r} must not be empty", pick=name)
        if new == name:
            return self
        if new not in self.names(kind):
            return self.with_changes(kind, name, name=new)._with_draft_renamed(kind, name, new)
        if kind != HORIZON:
            raise PickError(f"there is a {kind} called {new!r} already; give each a name of its own", pick=name)
        joined = self.with_changes(kind, new, pieces=self.pick(kind, new).pieces + pick.pieces)
        return joined.without_pick(kind, name)._with_draft_renamed(kind, name, new)

    def with_colour(self, kind: str, name: str, colour: str) -> "Drawing":
        """Give a pick a colour, "#rrggbb" or a name; SettingError if it is neither."""
        if not re.fullmatch(r"#[0-9a-fA-F]{3}|#[0-9a-fA-F]{6}|[a-zA-Z]+", str(colour)):
            raise SettingError(f"colour must be #rrggbb or the name of a colour, but is {colour!r}")
        return self.with_changes(kind, name, colour=str(colour))

    def with_visibility(self, kind: str, name: str, visible: bool) -> "Drawing":
        """Show or hide a pick."""
        return self.with_changes(kind, name, visible=bool(visible))

    def with_use(self, kind: str, name: str, use: str) -> "Drawing":
        """Let a pick constrain the restoration, only carry it along, or ignore it."""
        check_use(name, use)
        return self.with_changes(kind, name, use=use)

    def with_ends(self, name: str, ends: Ends) -> "Drawing":
        """Say of each end of a fault whether it dies out, reaches on, or is judged by its distance."""
        return self.with_changes(FAULT, name, ends=both_ends(ends))

    def with_body_kind(self, name: str, body: str) -> "Drawing":
        """Say whether a body is salt or an area without data."""
        check_kind(name, body)
        return self.with_changes(BODY, name, body=body)

    def without_pick(self, kind: str, name: str) -> "Drawing":
        """Delete a pick."""
        deleted = self.pick(kind, name)
        return replace(self, picks=tuple(pick for pick in self.picks if pick is not deleted))

    def with_interpretation(self, interpretation: Interpretation) -> "Drawing":
        """Replace the picks by those of an interpretation; picks of the same name keep their looks."""
        looks = {(pick.kind, pick.name): (pick.colour, pick.visible) for pick in self.picks}
        drawing = replace(self, picks=())
        picks: list[Fault | Horizon] = [*interpretation.faults, *interpretation.horizons]
        for pick in picks:
            kind = FAULT if isinstance(pick, Fault) else HORIZON
            pieces, ends = ((pick.points,), pick.ends) if isinstance(pick, Fault) else (pick.pieces, AUTO)
            colour, visible = looks.get((kind, pick.name), (None, True))
            drawing = drawing.with_pick(kind, pick.name, pieces, colour, visible, pick.use, ends)
        for body in interpretation.bodies:
            colour, visible = looks.get((BODY, body.name), (None, True))
            drawing = drawing.with_pick(BODY, body.name, [body.points], colour, visible, body=body.kind)
        return drawing

    def with_pick(
        self,
        kind: str,
        name: str,
        pieces: Iterable[ArrayLike],
        colour: str | None = None,
        visible: bool = True,
        use: str = CONSTRAIN,
        ends: str | Ends = AUTO,
        body: str = SALT,
    ) -> "Drawing":
        """Add a pick, in a colour of its own if none is given."""
        points, colour = tuple(map(_points, pieces)), colour or self._free_colour(kind)
        new = Pick(kind, name, points, colour, visible, use, both_ends(ends), body)
        return replace(self, picks=(*self.picks, new))

    def mapped(self, line_map: LineMap) -> "Drawing":
        """Apply a function of lines, shape (n, 2) to (m, 2), to all picks and the draft line."""
        picks = [
            replace(pick, pieces=tuple(_mapped(pick, piece, line_map) for piece in pick.pieces)) for pick in self.picks
        ]
        draft = self.draft and replace(self.draft, points=_points(line_map(np.array(self.draft.points))))
        return replace(self, picks=tuple(picks), draft=draft)

    def lies_on(self, section: Section) -> bool:
        """Return True if no pick reaches beyond a section."""
        points = [point for pick in self.picks for piece in pick.pieces for point in piece]
        return not points or bool(section.contains(points).all())

    @property
    def colours(self) -> dict[tuple[str, str], str]:
        """Colour of each pick, by its kind and name."""
        return {(pick.kind, pick.name): pick.colour for pick in self.picks}

    @property
    def interpretation(self) -> Interpretation:
        """Picks that are finished and valid; the same object as long as the picks do not change."""
        return self._checked[0]

    @property
    def problems(self) -> list[tuple[str, str]]:
        """Name and message for each line that cannot be used, or only be carried along."""
        return [(name, message) for _, name, _, message in self._checked[1]]

    def valid_pieces(self, pick: Pick) -> list[int]:
        """Indices of the pieces of a pick that can constrain a restoration."""
        if pick.use != CONSTRAIN:
            return []
        invalid = {piece for kind, name, piece, _ in self._checked[1] if (kind, name) == (pick.kind, pick.name)}
        return [piece for piece in range(len(pick.pieces)) if piece not in invalid]

    @property
    def _checked(self) -> tuple[Interpretation, tuple[tuple[str, str, int, str], ...]]:
        return _usable(
            tuple((pick.kind, pick.name, pick.pieces, pick.use, pick.ends, pick.body) for pick in self.picks)
        )

    def _with_vertices(self, target: PickSelection, inserted: Sequence[Sequence[float]], removed: int) -> "Drawing":
        """Replace some vertices from the target on by others."""
        points, vertex = self.line(target), target.vertex or 0
        return self.with_line(target, (*points[:vertex], *inserted, *points[vertex + removed :]))

    def _with_draft(self, points: Points) -> "Drawing":
        draft = replace(self.draft, points=points) if self.draft and points else None
        return replace(self, draft=draft)

    def _broken_off(self) -> "Drawing":
        """Make the draft line of a horizon a piece, and begin another without points; a fault stays a draft."""
        name = None
        if self.draft and self.draft.kind == HORIZON:
            drawing, name = self.with_draft_finished()
        return self if name is None else replace(drawing, draft=DraftLine(HORIZON, (), name))

    def _with_draft_renamed(self, kind: str, name: str, new: str) -> "Drawing":
        draft = self.draft
        if draft is None or (draft.kind, draft.name) != (kind, name):
            return self
        return replace(self, draft=replace(draft, name=new))

    def _free_colour(self, kind: str) -> str:
        """Colour used least so far."""
        used = [pick.colour for pick in self.picks]
        return min(COLOURS[kind], key=used.count)


def closed(points: Points) -> Points:
    """Points with the first one repeated at the end."""
    return (*points, *points[:1])


def _mapped(pick: Pick, piece: Points, line_map: LineMap) -> Points:
    line = closed(piece) if pick.kind == BODY else piece
    mapped = _points(line_map(np.array(line)))
    return mapped[:-1] if pick.kind == BODY else mapped


def _points(points: ArrayLike) -> Points:
    return tuple((float(x), float(z)) for x, z in np.asarray(points, float).reshape(-1, 2).tolist())
