"""Histories of a basin by events, each with its exact map, so that the section at any time is known.

Layers are laid down up to a level; between, the rock is folded, slips along faults, subsides, compacts or is eroded. A
point of the present-day section is carried back event by event; it belongs to the oldest layer whose top it lay below
when that layer was complete.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise

import numpy as np

from seiswidgets.geology.kinematics import Circular, Deformation, ShearFold, Straight, Survey, sign_change
from seiswidgets.geology.lithology import PER_KM, Lithology, pore_thickness, thickness_at

SPACING = 25.0  # m, between the points of a horizon
STEP = 1.0  # m, along horizons, while they are carried
Level = Callable[[np.ndarray], np.ndarray]  # depth at each x


def level(depth: float) -> Level:
    """A surface at one depth."""
    return lambda x: np.full(np.shape(x), float(depth))


@dataclass(frozen=True)
class Deposit:
    """Rock laid down up to a surface, from whatever lies below."""

    top: Level


@dataclass(frozen=True)
class Erode:
    """Rock removed down to a surface."""

    top: Level


def subside(metres: float) -> ShearFold:
    """The same subsidence everywhere."""
    return ShearFold(level(metres))


@dataclass(frozen=True)
class Slip:
    """Motion of the hanging wall of a fault, along it: so the fault stays where it is."""

    fault: Straight | Circular
    motion: Deformation
    name: str = "F1"

    def apply(self, points: np.ndarray) -> np.ndarray:
        return np.where(self.fault.side(points)[:, None] > 0, self.motion.apply(points), points)

    def undo(self, points: np.ndarray) -> np.ndarray:
        return np.where(self.fault.side(points)[:, None] > 0, self.motion.undo(points), points)


@dataclass(frozen=True)
class Compact:
    """Compaction of all layers under a new one, and the subsidence that makes room for it.

    Attributes
    ----------
    solids : tuple of functions of x
        Thickness of the grains in each layer so far, young to old, m.
    rocks : tuple of Lithology
    before, after : functions of x
        Depth of the top of the pile before the new layer, and of the new layer's top after it.
    load : function of x
        Thickness of the grains of the new layer.
    cover : Lithology
        Of the new layer.
    """

    solids: tuple[Level, ...]
    rocks: tuple[Lithology, ...]
    before: Level
    after: Level
    load: Level
    cover: Lithology

    def apply(self, points: np.ndarray) -> np.ndarray:
        return self._moved(points, forwards=True)

    def undo(self, points: np.ndarray) -> np.ndarray:
        return self._moved(points, forwards=False)

    def _moved(self, points: np.ndarray, forwards: bool) -> np.ndarray:
        x, z = points.T
        deep = _thickness(self.cover, self.load(x), np.zeros(len(x)))  # of burial, at the top of the layer below
        burials, tops = [np.zeros(len(x)), deep], [self.before(x), self.after(x) + deep]
        source, target = (0, 1) if forwards else (1, 0)
        result = z - tops[source] + tops[target]  # above the top: with it
        for solid, rock in zip(self.solids, self.rocks, strict=True):
            inside = z >= tops[source]
            grains = z - tops[source] - _pores(rock, burials[source], np.maximum(z - tops[source], 0))
            result = np.where(inside, tops[target] + _thickness(rock, grains, burials[target]), result)
            for state in (0, 1):
                thick = _thickness(rock, solid(x), burials[state])
                tops[state], burials[state] = tops[state] + thick, burials[state] + thick
        below = z >= tops[source]  # the basement does not compact
        return np.column_stack([x, np.where(below, z - tops[source] + tops[target], result)])


def _pores(rock: Lithology, top: np.ndarray, length: np.ndarray) -> np.ndarray:
    return pore_thickness(np.array(rock.phi0), np.array(rock.c * PER_KM), top, top + length, length)


def _thickness(rock: Lithology, solid: np.ndarray, top: np.ndarray) -> np.ndarray:
    return thickness_at(np.array(rock.phi0), np.array(rock.c * PER_KM), np.maximum(solid, 0), top)


Event = Deposit | Erode | Slip | Compact | ShearFold


@dataclass(frozen=True, eq=False)
class EventHistory:
    """Events from old to new; the last one is a deposit, whose top is the top of the section."""

    events: tuple[Event, ...]

    @cached_property
    def deposits(self) -> list[int]:
        """Indices of the deposits among the events, old to new."""
        return [index for index, event in enumerate(self.events) if isinstance(event, Deposit)]

    @cached_property
    def surfaces(self) -> list[int]:
        """Indices of the events that gave each deposit its final top: itself, or an erosion before the next one."""
        ends = [*self.deposits[1:], len(self.events)]
        made = [index for index, event in enumerate(self.events) if isinstance(event, Deposit | Erode)]
        return [max(index for index in made if index < end) for end in ends]

    def back(self, points: np.ndarray, event: int, since: int | None = None) -> np.ndarray:
        """Return points of the present, or of after a later event, to where they were after an event.

        They are carried as if all had been there then.
        """
        for later in reversed(self.events[event + 1 : None if since is None else since + 1]):
            if not isinstance(later, Deposit | Erode):
                points = later.undo(points)
        return points

    def forth(self, points: np.ndarray, event: int, until: int | None = None) -> np.ndarray:
        """Carry points from after an event to after a later one, or to the present."""
        for later in self.events[event + 1 : None if until is None else until + 1]:
            if not isinstance(later, Deposit | Erode):
                points = later.apply(points)
        return points

    def layer(self, points: np.ndarray) -> np.ndarray:
        """Number of the deposit that present-day points belong to, from 0 for the oldest; shape (n,)."""
        found = np.full(len(points), len(self.deposits) - 1)
        kept = np.ones(len(points), bool)  # that no erosion since has taken away
        for index in range(len(self.events) - 1, -1, -1):
            if isinstance(self.events[index], Deposit | Erode):
                x, z = self.back(points, index).T
                below = z >= self._top(index)(x)
                if isinstance(self.events[index], Erode):
                    kept &= below
                else:
                    found[below & kept] = self.deposits.index(index)
        return found

    def at(self, points: np.ndarray, number: int) -> np.ndarray:
        """Return present-day points to when a deposit's top was complete; NaN where they were not there yet."""
        moved = self.back(points, self.surfaces[number])
        return np.where((self.layer(points) <= number)[:, None], moved, np.nan)

    def _top(self, event: int) -> Level:
        surface = self.events[event]
        if not isinstance(surface, Deposit | Erode):
            raise TypeError("only a deposit or an erosion makes a surface")
        return surface.top

    def horizon(self, number: int, survey: Survey) -> list[np.ndarray]:
        """The present-day pieces of a deposit's top, as far as it was not eroded and lies in the section."""
        index = self.surfaces[number]
        pieces = self._pieces(index, survey)
        for later in range(index + 1, len(self.events)):
            event = self.events[later]
            if isinstance(event, Erode):
                pieces = [run for piece in pieces for run in _runs(piece, piece[:, 1] >= event.top(piece[:, 0]))]
            elif not isinstance(event, Deposit):
                pieces = [event.apply(piece) for piece in pieces]
        inside = [run for piece in pieces for run in _runs(piece, survey.margin(piece) >= -1e-9)]
        return [survey.snap(_thinned(piece)) for piece in inside if len(piece) > 2]

    @cached_property
    def slips(self) -> dict[str, int]:
        """Index of the last slip along each fault, by its name."""
        return {event.name: index for index, event in enumerate(self.events) if isinstance(event, Slip)}

    def _side(self, name: str, points: np.ndarray, event: int) -> np.ndarray:
        """Distance into the hanging wall of a fault, of points as they were after an event; shape (n,)."""
        index = self.slips[name]
        slip = self.events[index]
        moved = self.back(points, index, event) if index <= event else self.forth(points, event, index - 1)
        return slip.fault.side(moved) if isinstance(slip, Slip) else np.zeros(len(points))

    def _pieces(self, event: int, survey: Survey) -> list[np.ndarray]:
        """A surface after the event that made it, divided at the faults that slip later."""
        x = np.arange(-survey.depth, survey.width + survey.depth + STEP, STEP)
        top = self._top(event)
        cuts = []
        for name in [name for name, index in self.slips.items() if index > event]:

            def side(x: np.ndarray, name: str = name) -> np.ndarray:
                return self._side(name, np.column_stack([x, top(x)]), event)

            cuts += [sign_change(side, x[at], x[at + 1]) for at in np.flatnonzero(np.diff(side(x) >= 0))]
        stops = [x[0], *sorted(cuts), x[-1]]
        pieces = []
        for first, last in pairwise(stops):
            gap = 1e-9 * (last - first)  # the ends lie just on their own side
            along = np.array([first + gap, *x[(x > first + 1e-6) & (x < last - 1e-6)], last - gap])
            pieces.append(np.column_stack([along, top(along)]))
        return pieces

    def bed(self, points: np.ndarray, survey: Survey, thickness: Sequence[float]) -> np.ndarray:
        """Depth of the bed that each present-day point belongs to, in a pile of level beds; shape (n,).

        Beds divide a layer in proportion, between its base and its top as they were when it was complete.

        Parameters
        ----------
        points : array, shape (n, 2)
        survey : Survey
        thickness : list of float
            Of each layer in the pile, old to new; the oldest has no base.
        """
        tops = np.cumsum([0.0, *thickness[:0:-1]])[::-1]  # depth of each deposit's top in the pile, old to new
        number, result = self.layer(points), np.empty(len(points))
        for layer, index in enumerate(self.deposits):
            own = number == layer
            x, z = self.back(points[own], index).T
            below = z - self._top(index)(x)
            if layer:
                below *= thickness[layer] / np.maximum(self._base(index, x, z, survey) - self._top(index)(x), 1e-9)
                below = np.clip(below, 0, thickness[layer])
            result[own] = tops[layer] + below
        return result

    def _base(self, event: int, x: np.ndarray, z: np.ndarray, survey: Survey) -> np.ndarray:
        """Depth of a deposit's base below points of its time."""
        older = max(index for index in range(event) if isinstance(self.events[index], Deposit | Erode))
        base, points = np.full(len(x), np.inf), np.column_stack([x, z])
        for piece in self._pieces(older, survey):
            moved = self.forth(piece, older, event)
            same = np.ones(len(x), bool)
            for name in [name for name, index in self.slips.items() if index > older]:
                walls = self._side(name, np.vstack([moved[len(moved) // 2], points]), event) > 0
                same &= walls[1:] == walls[0]
            base = np.where(same, np.interp(x, *moved[np.argsort(moved[:, 0])].T), base)
        return base


def _runs(points: np.ndarray, kept: np.ndarray) -> list[np.ndarray]:
    """The stretches of a line whose points are kept."""
    edges = np.flatnonzero(np.diff(np.concatenate([[0], kept.astype(int), [0]])))
    return [points[first:last] for first, last in zip(edges[::2], edges[1::2], strict=True) if last - first > 1]


def _thinned(points: np.ndarray) -> np.ndarray:
    """Fewer points of a line, some 25 m apart, its ends among them."""
    step = max(1, round(SPACING / STEP))
    return np.vstack([points[:-1:step], points[-1:]])
