"""Picks of an interpreter on a section: faults, horizons, and both together."""

from collections import Counter
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TypeVar

import numpy as np
import shapely
from numpy.typing import ArrayLike

from seiswidgets.errors import PickError, SettingError, number_text
from seiswidgets.geology.bodies import BODY, Body
from seiswidgets.geology.section import filled

FAULT, HORIZON = "fault", "horizon"
USES = CONSTRAIN, CARRY, IGNORE = "constrain", "carry", "ignore"
MISSING = "missing"  # kind of the errors about picks that a step names and that do not exist
AUTO, TIP, EXTEND = "auto", "tip", "extend"  # what happens to an end of a fault
Ends = tuple[str, str]  # for the first and the last point of a fault
AUTO_ENDS: Ends = (AUTO, AUTO)
LineMap = Callable[[np.ndarray], np.ndarray]
SEGMENTS_AT_ONCE = 64  # of a line, tested together for one that meets an earlier one


def both_ends(ends: str | Ends) -> Ends:
    """Validate a choice for the ends of a fault, or a pair of choices; a pair."""
    first, last = (ends, ends) if isinstance(ends, str) or len(ends) != 2 else ends
    if not {first, last} <= {AUTO, TIP, EXTEND}:
        raise SettingError(f"ends must be 'auto', 'tip' or 'extend', or two of them, but is {ends!r}")
    return str(first), str(last)


@dataclass(frozen=True, eq=False)
class Fault:
    """A fault, drawn as a polyline from one end to the other.

    Rock slides along the smooth curve through its points. Turns of up to 10 degrees, or of up to 25 in a series of
    similar ones, are taken for samples of that curve; larger ones, and single ones such as the bends of a ramp, are
    corners. A bend that should stay sharp needs a second point close to it.

    Parameters
    ----------
    points : array, shape (n, 2), n >= 2
        Rows ``(x, z)`` in the section's units.
    name : str
        Its name in errors and reports.
    ends : {"auto", "tip", "extend"}, or a pair of these for the first and the last point
        "auto" draws an end that lies within three traces and samples of the border or of another fault on to it, and
        reports every other end inside the section. "tip" leaves the end where it is: the fault dies out there.
        "extend" draws it on, straight ahead, to the border or the first fault in its way.
    use : {"constrain", "carry", "ignore"}
        Whether blocks slide along it, or it only moves with the rock and cuts nothing, or it is left out. A line that
        crosses itself is carried in any case.

    Raises
    ------
    PickError
        If there are fewer than two different points, or if one is not finite.
    SettingError
        If ``ends`` or ``use`` is not one of these.
    """

    points: np.ndarray
    name: str = "fault"
    ends: str | Ends = AUTO
    use: str = CONSTRAIN

    def __post_init__(self) -> None:
        object.__setattr__(self, "ends", both_ends(self.ends))
        object.__setattr__(self, "points", _polyline(self.points, f"fault {self.name!r}", self.name))
        check_use(self.name, self.use)

    @cached_property
    def flaw(self) -> PickError | None:
        """The reason why the fault can only be carried, or None: it crosses itself, or closes on itself."""
        return _flaw(self.points, f"fault {self.name!r}", self.name)

    @property
    def constrains(self) -> bool:
        """True if blocks slide along it."""
        return self.use == CONSTRAIN and self.flaw is None

    def mapped(self, line_map: LineMap) -> "Fault":
        """Apply a function of lines, shape (n, 2) to (m, 2)."""
        return replace(self, points=line_map(self.points))


@dataclass(frozen=True, eq=False, init=False)
class Horizon:
    """A horizon, drawn as pieces: one polyline for each fault block that it was seen in.

    Parameters
    ----------
    *pieces : arrays, each of shape (n, 2), n >= 2
        Rows ``(x, z)`` in the section's units; pieces and their points in any direction and order.
    name : str
        Its name in errors and reports.
    use : {"constrain", "carry", "ignore"}
        Whether it is matched across faults, or it only moves with the rock, or it is left out. Pieces that cross
        themselves are carried in any case.

    Raises
    ------
    PickError
        If there is no piece, or a piece has fewer than two different points, or one that is not finite.
    SettingError
        If there is no such use.
    """

    pieces: tuple[np.ndarray, ...]
    name: str = "horizon"
    use: str = CONSTRAIN

    def __init__(self, *pieces: ArrayLike, name: str = "horizon", use: str = CONSTRAIN) -> None:
        object.__setattr__(self, "name", name)
        object.__setattr__(self, "use", use)
        check_use(name, use)
        if not pieces:
            raise PickError(f"horizon {name!r} needs at least one piece; draw a line of two points or more", pick=name)
        lines = (_polyline(piece, f"piece {index} of horizon {name!r}", name) for index, piece in enumerate(pieces, 1))
        object.__setattr__(self, "pieces", tuple(lines))

    @cached_property
    def flaws(self) -> tuple[PickError | None, ...]:
        """For each piece the reason why it can only be carried, or None: it crosses itself, or closes on itself."""
        return tuple(
            _flaw(piece, f"piece {index} of horizon {self.name!r}", self.name)
            for index, piece in enumerate(self.pieces, 1)
        )

    @property
    def flaw(self) -> PickError | None:
        """The flaw of the first piece that has one."""
        return next(filter(None, self.flaws), None)

    @property
    def constrains(self) -> bool:
        """True if at least one piece is matched across faults."""
        return self.use == CONSTRAIN and None in self.flaws

    def mapped(self, line_map: LineMap) -> "Horizon":
        """Apply a function of lines, shape (n, 2) to (m, 2), to each piece."""
        return Horizon(*map(line_map, self.pieces), name=self.name, use=self.use)

    def __repr__(self) -> str:
        return f"Horizon({', '.join(f'{len(piece)} points' for piece in self.pieces)}, name={self.name!r})"


Pick = TypeVar("Pick", Fault, Horizon)


@dataclass(frozen=True, eq=False)
class Interpretation:
    """The faults, horizons and bodies of one section, each with a name of its own among its kind.

    Raises
    ------
    PickError
        If two faults, two horizons or two bodies have the same name.
    """

    faults: Sequence[Fault] = ()
    horizons: Sequence[Horizon] = ()
    bodies: Sequence[Body] = ()

    def __post_init__(self) -> None:
        for kind in ("faults", "horizons", "bodies"):
            object.__setattr__(self, kind, tuple(getattr(self, kind)))
            repeated = [name for name, count in Counter(pick.name for pick in getattr(self, kind)).items() if count > 1]
            if repeated:
                raise PickError(f"two {kind} are called {repeated[0]!r}; give each a name of its own", pick=repeated[0])

    def mapped(self, line_map: LineMap) -> "Interpretation":
        """Apply a function of lines, shape (n, 2) to (m, 2), to all picks."""
        return Interpretation(
            [fault.mapped(line_map) for fault in self.faults],
            [horizon.mapped(line_map) for horizon in self.horizons],
            [body.mapped(line_map) for body in self.bodies],
        )

    def fault(self, name: str) -> Fault:
        """The fault of that name; PickError if there is none."""
        return _find(self.faults, FAULT, name)

    def horizon(self, name: str) -> Horizon:
        """The horizon of that name; PickError if there is none."""
        return _find(self.horizons, HORIZON, name)


Problem = tuple[str, str, int, str]  # kind and name of a pick, index of the piece, and what is wrong with it


def usable(
    drawn: Iterable[tuple[str, str, Sequence[ArrayLike], str, Ends, str]],
) -> tuple[Interpretation, tuple[Problem, ...]]:
    """Make an interpretation of drawn lines, without those that are none, and list the problems of lines.

    Parameters
    ----------
    drawn : iterable of (kind, name, pieces, use, ends, body)
        "fault", "horizon" or "body", its name, lists of points (x, z), one list unless it is a horizon, its use, a
        fault's ends, and the kind of a body.

    Returns
    -------
    interpretation : Interpretation
        Lines that cross themselves included: they are carried.
    problems : tuple of (kind, name, index, message)
        One for each piece that is left out or can only be carried; pieces count from 0.
    """
    faults: list[Fault] = []
    horizons: list[Horizon] = []
    bodies: list[Body] = []
    problems: list[Problem] = []
    for kind, name, pieces, use, ends, body in drawn:
        if kind == BODY:
            try:
                bodies += [Body(np.asarray(points), body, name) for points in pieces if use != IGNORE]
            except PickError as error:
                problems.append((kind, name, 0, str(error)))
            continue
        good: list[np.ndarray] = []
        for index, piece in enumerate(pieces):
            what = f"fault {name!r}" if kind == FAULT else f"piece {index + 1} of horizon {name!r}"
            try:
                good.append(_polyline(piece, what, name))
                flaw = _flaw(good[-1], what, name)
            except PickError as error:
                flaw = error
            if flaw:
                problems.append((kind, name, index, str(flaw)))
        if good and kind == FAULT:
            faults.append(Fault(good[0], name, ends=ends, use=use))
        elif good:
            horizons.append(Horizon(*good, name=name, use=use))
    return Interpretation(faults, horizons, bodies), tuple(problems)


def _find(picks: Sequence[Pick], kind: str, name: str) -> Pick:
    for pick in picks:
        if pick.name == name:
            return pick
    names = ", ".join(repr(pick.name) for pick in picks) or "none"
    raise PickError(f"there is no {kind} called {name!r}; there are {names}", kind=MISSING, pick=name)


def _polyline(points: ArrayLike, what: str, name: str) -> np.ndarray:
    """Validate the points of a line; ``what`` names the line in errors, ``name`` the pick it belongs to."""
    try:
        line = np.array(filled(points), dtype=float)
    except (TypeError, ValueError):
        raise PickError(f"{what} must be a list of points (x, z), each of two numbers", pick=name) from None
    if line.ndim != 2 or line.shape[1] != 2:
        raise PickError(f"{what} must be a list of points (x, z), but has shape {line.shape}", pick=name)
    if not np.isfinite(line).all():
        bad = int(np.argmin(np.isfinite(line).all(axis=1)))
        raise PickError(f"point {bad + 1} of {what} is not finite: ({line[bad, 0]:g}, {line[bad, 1]:g})", pick=name)
    if len(line) < 2 or (line == line[0]).all():
        count = len(np.unique(line, axis=0))
        raise PickError(f"{what} needs at least two different points, but has {count}", pick=name)
    line.setflags(write=False)
    return line


def _at(x: float, z: float) -> str:
    return f"x={number_text(x)}, z={number_text(z)}"


def check_use(name: str, use: str) -> None:
    """Raise SettingError for a use that does not exist."""
    if use not in USES:
        raise SettingError(f"the use of {name!r} must be one of {', '.join(USES)}, but is {use!r}", pick=name)


def _flaw(line: np.ndarray, what: str, name: str) -> PickError | None:
    """The reason why a line can only be carried, or None; ``what`` names it in the text, ``name`` its pick."""
    if (line[0] == line[-1]).all():
        x, z = line[0].tolist()
        return PickError(f"{what} closes on itself at {_at(x, z)}; leave it open", pick=name, where=(x, z))
    if shapely.LineString(line).is_simple:
        return None
    x, z = _self_crossing(line)
    text = f"{what} crosses itself near {_at(x, z)}; redraw it or split it in two"
    return PickError(text, pick=name, where=(x, z))


def _self_crossing(line: np.ndarray) -> tuple[float, float]:
    """The first point where a polyline meets itself again."""
    line = line[np.append(True, (line[1:] != line[:-1]).any(axis=1))]
    segments = shapely.linestrings(np.stack([line[:-1], line[1:]], axis=1))
    tree = shapely.STRtree(segments)
    for start in range(0, len(segments), SEGMENTS_AT_ONCE):
        later, earlier = tree.query(segments[start : start + SEGMENTS_AT_ONCE], predicate="intersects")
        later += start
        pairs = np.column_stack([later, earlier])[earlier < later]
        pairs = pairs[np.lexsort(pairs.T[::-1])]
        shared = shapely.intersection(segments[pairs[:, 1]], segments[pairs[:, 0]])
        again = (pairs[:, 0] - pairs[:, 1] > 1) | (shapely.length(shared) > 0)  # neighbours have a point in common
        if again.any():
            x, z = shared[np.argmax(again)].centroid.coords[0]
            return float(x), float(z)
    return float(line[0, 0]), float(line[0, 1])
