"""What an interpreter draws on a section: faults, horizons, and both together."""

from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
import shapely

from seiswidgets.errors import PickError

FAULT, HORIZON = "fault", "horizon"
AT_ONCE = 64  # segments of a line that are looked at together for one that meets an earlier one


@dataclass(frozen=True, eq=False)
class Fault:
    """A fault, drawn as a polyline from one end to the other.

    Parameters
    ----------
    points : array, shape (n, 2), n >= 2
        Rows ``(x, z)`` in the section's units.
    name : str
        What errors and reports call it.

    Raises
    ------
    PickError
        If there are fewer than two different points, if one is not finite, or if the line crosses itself.
    """

    points: np.ndarray
    name: str = "fault"

    def __post_init__(self):
        object.__setattr__(self, "points", _polyline(self.points, f"fault {self.name!r}"))


@dataclass(frozen=True, eq=False, init=False)
class Horizon:
    """A horizon, drawn as pieces: one polyline for each fault block that it was seen in.

    Parameters
    ----------
    *pieces : arrays, each of shape (n, 2), n >= 2
        Rows ``(x, z)`` in the section's units; pieces and their points in any direction and order.
    name : str
        What errors and reports call it.

    Raises
    ------
    PickError
        If there is no piece, or a piece has fewer than two different points, one that is not finite, or crosses itself.
    """

    pieces: tuple[np.ndarray, ...]
    name: str = "horizon"

    def __init__(self, *pieces, name="horizon"):
        object.__setattr__(self, "name", name)
        if not pieces:
            raise PickError(f"horizon {name!r} needs at least one piece; draw a line of two points or more")
        checked = (_polyline(piece, f"piece {number} of horizon {name!r}") for number, piece in enumerate(pieces, 1))
        object.__setattr__(self, "pieces", tuple(checked))

    def __repr__(self):
        return f"Horizon({', '.join(f'{len(piece)} points' for piece in self.pieces)}, name={self.name!r})"


@dataclass(frozen=True, eq=False)
class Interpretation:
    """The faults and horizons of one section, each with a name of its own.

    Raises
    ------
    PickError
        If two faults, or two horizons, have the same name.
    """

    faults: tuple[Fault, ...] = ()
    horizons: tuple[Horizon, ...] = ()

    def __post_init__(self):
        for kind in ("faults", "horizons"):
            object.__setattr__(self, kind, tuple(getattr(self, kind)))
            repeated = [name for name, count in Counter(pick.name for pick in getattr(self, kind)).items() if count > 1]
            if repeated:
                raise PickError(f"two {kind} are called {repeated[0]!r}; give each a name of its own")

    def fault(self, name: str) -> Fault:
        """The fault of that name; PickError if there is none."""
        return _named(self.faults, "fault", name)

    def horizon(self, name: str) -> Horizon:
        """The horizon of that name; PickError if there is none."""
        return _named(self.horizons, "horizon", name)


def usable(drawn: Iterable) -> tuple[Interpretation, tuple]:
    """What can be used of lines that were drawn, and what is wrong with the others.

    Parameters
    ----------
    drawn : iterable of (kind, name, pieces)
        "fault" or "horizon", its name, and lists of points (x, z): of a fault, one.

    Returns
    -------
    interpretation : Interpretation
    problems : tuple of (kind, name, number, message)
        Of each piece that cannot be used, counted from 0.
    """
    made, problems = {FAULT: [], HORIZON: []}, []
    for kind, name, pieces in drawn:
        messages = [_problem(kind, name, pieces, number) for number in range(len(pieces))]
        problems += [(kind, name, number, message) for number, message in enumerate(messages) if message]
        good = [piece for piece, message in zip(pieces, messages, strict=True) if not message]
        if good:
            made[kind].append(Fault(*good, name=name) if kind == FAULT else Horizon(*good, name=name))
    return Interpretation(made[FAULT], made[HORIZON]), tuple(problems)


def _problem(kind, name, pieces, number):
    """Why a piece cannot be used, or None."""
    what = f"fault {name!r}" if kind == FAULT else f"piece {number + 1} of horizon {name!r}"
    try:
        _polyline(pieces[number], what)
    except PickError as error:
        return str(error)
    return None


def _named(picks, kind, name):
    for pick in picks:
        if pick.name == name:
            return pick
    raise PickError(f"there is no {kind} called {name!r}; there are {', '.join(repr(p.name) for p in picks) or 'none'}")


def _polyline(points, what):
    try:
        line = np.array(points, dtype=float)
    except (TypeError, ValueError):
        raise PickError(f"{what} must be a list of points (x, z), each of two numbers") from None
    if line.ndim != 2 or line.shape[1] != 2:
        raise PickError(f"{what} must be a list of points (x, z), but has shape {line.shape}")
    if not np.isfinite(line).all():
        bad = int(np.argmin(np.isfinite(line).all(axis=1)))
        raise PickError(f"point {bad + 1} of {what} is not finite: ({line[bad, 0]:g}, {line[bad, 1]:g})")
    if len(line) < 2 or (line == line[0]).all():
        raise PickError(f"{what} needs at least two different points, but has {len(np.unique(line, axis=0))}")
    if (line[0] == line[-1]).all():
        raise PickError(f"{what} closes on itself at x={line[0, 0]:g}, z={line[0, 1]:g}; leave it open")
    if not shapely.LineString(line).is_simple:
        x, z = _self_crossing(line)
        raise PickError(f"{what} crosses itself near x={x:g}, z={z:g}; redraw it or split it in two")
    line.setflags(write=False)
    return line


def _self_crossing(line):
    """The first place where a polyline meets itself again."""
    line = line[np.append(True, (line[1:] != line[:-1]).any(axis=1))]
    segments = shapely.linestrings(np.stack([line[:-1], line[1:]], axis=1))
    tree = shapely.STRtree(segments)
    for start in range(0, len(segments), AT_ONCE):
        later, earlier = tree.query(segments[start : start + AT_ONCE], predicate="intersects")
        later += start
        pairs = np.column_stack([later, earlier])[earlier < later]
        pairs = pairs[np.lexsort(pairs.T[::-1])]
        shared = shapely.intersection(segments[pairs[:, 1]], segments[pairs[:, 0]])
        again = (pairs[:, 0] - pairs[:, 1] > 1) | (shapely.length(shared) > 0)  # neighbours have a point in common
        if again.any():
            return shared[np.argmax(again)].centroid.coords[0]
    return tuple(line[0])
