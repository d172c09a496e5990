"""All that has been picked on a section, as one frozen value: every edit makes a new one, so that undo is exact."""

import re
from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np

from seiswidgets.errors import PickError, SettingError
from seiswidgets.geology.picks import FAULT, HORIZON, Interpretation, usable
from seiswidgets.geology.section import Section

LETTERS = {FAULT: "F", HORIZON: "H"}
COLOURS = {  # told apart by the colour-blind, on grey and on red-white-blue
    FAULT: ("#e69f00", "#f0e442", "#ff5fa2", "#c77cff", "#ffb000"),
    HORIZON: ("#00c2a8", "#56b4e9", "#7ad151", "#0072b2", "#b8de29"),
}

Point = tuple[float, float]
Points = tuple[Point, ...]
_usable = lru_cache(maxsize=64)(usable)  # asked for at every look at a drawing


@dataclass(frozen=True)
class Pick:
    """A fault, of one piece, or a horizon, of any number of pieces.

    Attributes
    ----------
    kind : {"fault", "horizon"}
    name : str
    pieces : tuple of tuples of points (x, z)
    colour : str
        "#rrggbb", or the name of a colour.
    visible : bool
        Hidden picks are restored with all the same.
    """

    kind: str
    name: str
    pieces: tuple[Points, ...]
    colour: str
    visible: bool = True


@dataclass(frozen=True)
class DraftLine:
    """The line under way, and the horizon that it is to be a piece of; without a name it becomes a new pick."""

    kind: str
    points: Points
    name: str | None = None


@dataclass(frozen=True)
class PickSelection:
    """A pick, or a piece of it, or a vertex of that; without a name, of the line under way."""

    kind: str
    name: str | None
    piece: int | None = None
    vertex: int | None = None


@dataclass(frozen=True)
class Drawing:
    """All picks, the line under way, and the point that is held.

    Its methods return a new one. Invalid lines (that cross themselves, say) are kept, and told of in ``problems``.
    """

    picks: tuple[Pick, ...] = ()
    draft: DraftLine | None = None

    def pick(self, kind: str, name: str) -> Pick:
        """The pick of that kind and name; PickError if there is none."""
        for pick in self.picks:
            if (pick.kind, pick.name) == (kind, name):
                return pick
        raise PickError(f"there is no {kind} called {name!r}; there are {', '.join(map(repr, self.names(kind)))}")

    def names(self, kind: str) -> tuple[str, ...]:
        """Names of the picks of a kind."""
        return tuple(pick.name for pick in self.picks if pick.kind == kind)

    def free_name(self, kind: str) -> str:
        """The first of F1, F2, ... or H1, H2, ... that is not in use."""
        taken = self.names(kind)
        return next(name for number in range(1, len(taken) + 2) if (name := f"{LETTERS[kind]}{number}") not in taken)

    def line(self, target: PickSelection) -> Points:
        """The points of the line that a target lies on; none if there is no such line."""
        if target.name is None:
            return self.draft.points if self.draft else ()
        pieces = next((pick.pieces for pick in self.picks if (pick.kind, pick.name) == (target.kind, target.name)), ())
        return pieces[target.piece] if target.piece is not None and target.piece < len(pieces) else ()

    def with_line(self, target: PickSelection, points) -> "Drawing":
        """With other points on a line; a piece left with fewer than two goes, and so does a pick without pieces."""
        points = _points(points)
        if target.name is None:
            return replace(self, draft=replace(self.draft, points=points) if points else None)
        pieces = list(self.pick(target.kind, target.name).pieces)
        pieces[target.piece : target.piece + 1] = [points] if len(points) > 1 else []
        return self.with_pieces(target.kind, target.name, pieces)

    def with_pieces(self, kind: str, name: str, pieces) -> "Drawing":
        """With other pieces of a pick, which goes if there are none."""
        return self._with(kind, name, pieces=tuple(map(_points, pieces))) if pieces else self.deleted(kind, name)

    def moved(self, target: PickSelection, point: Point) -> "Drawing":
        """With a vertex elsewhere."""
        points = self.line(target)
        return self.with_line(target, (*points[: target.vertex], point, *points[target.vertex + 1 :]))

    def inserted(self, target: PickSelection, point: Point) -> "Drawing":
        """With a vertex more, before the one at the target."""
        points = self.line(target)
        return self.with_line(target, (*points[: target.vertex], point, *points[target.vertex :]))

    def removed(self, target: PickSelection) -> "Drawing":
        """Without a vertex."""
        points = self.line(target)
        return self.with_line(target, points[: target.vertex] + points[target.vertex + 1 :])

    def begun(self, kind: str, point: Point, name: str | None = None) -> "Drawing":
        """With a line under way of one vertex; a horizon's name makes it a further piece of that one."""
        return replace(self, draft=DraftLine(kind, _points([point]), name))

    def extended(self, points) -> "Drawing":
        """With more vertices at the end of the line under way."""
        return replace(self, draft=replace(self.draft, points=self.draft.points + _points(points)))

    def continued(self, stretches) -> "Drawing":
        """With the line under way led on along stretches, the first of which starts where it ends.

        A horizon is broken between two stretches: each makes a piece of its own. A fault goes straight on.
        """
        first, *others = stretches
        drawing = self.extended(first[1:])
        for stretch in others:
            done, name = drawing.finished() if self.draft.kind == HORIZON else (drawing, None)
            drawing = done.begun(HORIZON, stretch[0], name).extended(stretch[1:]) if name else drawing.extended(stretch)
        return drawing

    def finished(self) -> tuple["Drawing", str | None]:
        """With the line under way made a pick, or a piece of one; and its name.

        A line of fewer than two different points stays under way.
        """
        line = self.draft
        if line is None or len(set(line.points)) < 2:
            return self, None
        done = replace(self, draft=None)
        if line.name in done.names(line.kind):
            pieces = (*done.pick(line.kind, line.name).pieces, line.points)
            return done._with(line.kind, line.name, pieces=pieces, visible=True), line.name
        name = self.free_name(line.kind) if line.name is None else line.name
        return replace(done, picks=(*self.picks, Pick(line.kind, name, (line.points,), self._colour(line.kind)))), name

    def renamed(self, kind: str, name: str, new: str) -> "Drawing":
        """With another name for a pick; a horizon given the name of another one becomes pieces of it.

        Raises
        ------
        PickError
            If the name is empty, or another fault has it.
        """
        pick, new = self.pick(kind, name), str(new).strip()
        if not new:
            raise PickError(f"the name of {kind} {name!r} must not be empty")
        if new == name:
            return self
        if new not in self.names(kind):
            return self._with(kind, name, name=new)._with_target(kind, name, new)
        if kind == FAULT:
            raise PickError(f"there is a fault called {new!r} already; give each a name of its own")
        joined = self._with(kind, new, pieces=self.pick(kind, new).pieces + pick.pieces)
        return joined.deleted(kind, name)._with_target(kind, name, new)

    def recoloured(self, kind: str, name: str, colour: str) -> "Drawing":
        """With another colour for a pick, "#rrggbb" or a name; SettingError if it is neither."""
        if not re.fullmatch(r"#[0-9a-fA-F]{3}|#[0-9a-fA-F]{6}|[a-zA-Z]+", str(colour)):
            raise SettingError(f"colour must be #rrggbb or the name of a colour, but is {colour!r}")
        return self._with(kind, name, colour=str(colour))

    def shown(self, kind: str, name: str, visible: bool = True) -> "Drawing":
        """With a pick visible, or hidden."""
        return self._with(kind, name, visible=bool(visible))

    def deleted(self, kind: str, name: str) -> "Drawing":
        """Without a pick."""
        gone = self.pick(kind, name)
        return replace(self, picks=tuple(pick for pick in self.picks if pick is not gone))

    def with_interpretation(self, interpretation: Interpretation) -> "Drawing":
        """With the picks of an interpretation instead; those that had the same name keep their looks."""
        looks = {(pick.kind, pick.name): (pick.colour, pick.visible) for pick in self.picks}
        drawing = replace(self, picks=())
        for kind, picks in ((FAULT, interpretation.faults), (HORIZON, interpretation.horizons)):
            for pick in picks:
                pieces = (pick.points,) if kind == FAULT else pick.pieces
                drawing = drawing.with_pick(kind, pick.name, pieces, *looks.get((kind, pick.name), ()))
        return drawing

    def with_pick(self, kind: str, name: str, pieces, colour: str | None = None, visible: bool = True) -> "Drawing":
        """With one more pick, in a colour of its own if none is given."""
        new = Pick(kind, name, tuple(map(_points, pieces)), colour or self._colour(kind), visible)
        return replace(self, picks=(*self.picks, new))

    def lies_on(self, section: Section) -> bool:
        """Whether no pick, and no held point, lies beyond a section."""
        points = [point for pick in self.picks for piece in pick.pieces for point in piece]
        return not points or bool(section.contains(points).all())

    @property
    def interpretation(self) -> Interpretation:
        """What is finished and valid; the same object as long as the picks do not change."""
        return self._checked[0]

    @property
    def problems(self) -> list[tuple[str, str]]:
        """Name and message, for each line that is kept but cannot be used."""
        return [(name, message) for _, name, _, message in self._checked[1]]

    def valid_pieces(self, pick: Pick) -> list[int]:
        """Which pieces of a pick can be used, from 0."""
        bad = {piece for kind, name, piece, _ in self._checked[1] if (kind, name) == (pick.kind, pick.name)}
        return [piece for piece in range(len(pick.pieces)) if piece not in bad]

    @property
    def _checked(self):
        return _usable(tuple((pick.kind, pick.name, pick.pieces) for pick in self.picks))

    def _with(self, kind, name, /, **changes):
        old = self.pick(kind, name)
        return replace(self, picks=tuple(replace(old, **changes) if pick is old else pick for pick in self.picks))

    def _with_target(self, kind, name, new):
        line = self.draft
        return (
            self
            if line is None or (line.kind, line.name) != (kind, name)
            else replace(self, draft=replace(line, name=new))
        )

    def _colour(self, kind):
        """The colour least used so far."""
        used = [pick.colour for pick in self.picks]
        return min(COLOURS[kind], key=used.count)


def _points(points):
    return tuple((float(x), float(z)) for x, z in np.asarray(points, float).reshape(-1, 2).tolist())
