"""The uncertainty of an interpretation, and interpretations drawn from it."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import cast

import numpy as np
import shapely
from scipy.special import ndtr
from shapely import LineString

from seiswidgets.core.correlated_noise import noise_kernels
from seiswidgets.errors import SettingError
from seiswidgets.geology import validation
from seiswidgets.geology.ensembles.piece_ends import PieceEnd, brought_to_faults, piece_ends
from seiswidgets.geology.fault_lines import NEAR
from seiswidgets.geology.hypothesis import Hypothesis, with_slip, with_velocity
from seiswidgets.geology.picks import AUTO, EXTEND, IGNORE, Ends, Fault, Horizon, Interpretation, both_ends
from seiswidgets.geology.scan import Scan
from seiswidgets.geology.slip_profile import SlipProfile

INPUTS = ("horizon", "fault", "dip", "velocity", "matches")
DETAIL = 3  # points of a perturbed line for each correlation length
STEEPEST = 45.0  # degrees: the largest deviation of a dip

Draw = dict[str, np.ndarray]  # independent standard normal numbers by input
Slips = Scan | Sequence[tuple[SlipProfile, float]]


@dataclass(frozen=True)
class Uncertainty:
    """Standard deviations of what an interpretation rests on; 0 leaves an input as it is.

    Parameters
    ----------
    horizon : float
        Of the picks of horizons, in samples, up and down.
    fault : float
        Of the picks of faults, in traces, across the fault (in samples where it is flat).
    correlation_length : float
        Distance along a line over which errors of picks are alike, in metres of rock: two points as far apart have a
        correlation of 0.61, at twice that 0.14. Errors of two pieces, or of two picks, are independent.
    dip : float
        Of the dip of each fault, which turns about its middle, in degrees.
    velocity : float
        Of the velocity, as a share of it. In a section in depth, all depths grow with it.
    matches : dict of str to Scan, or to list of (SlipProfile, weight)
        Slips that are possible along a fault, by its name, such as the peaks of its scan: each member takes one, as
        often as its weight says, in the first step that slides along it.

    Raises
    ------
    SettingError
        If a deviation is negative or not a number, the correlation length is not above 0, the dip's is above 45, or a
        match is not a slip with a weight.
    """

    horizon: float = 0.0
    fault: float = 0.0
    correlation_length: float = 500.0
    dip: float = 0.0
    velocity: float = 0.0
    matches: Mapping[str, Slips] = field(default_factory=dict, hash=False)

    def __post_init__(self) -> None:
        for name in ("horizon", "fault", "dip", "velocity", "correlation_length"):
            value = validation.finite_number(name, getattr(self, name))
            if value < 0:
                raise SettingError(f"{name} is a standard deviation, 0 or more, but is {value:g}")
            object.__setattr__(self, name, value)
        if self.correlation_length == 0:
            raise SettingError("correlation_length must be above 0 m; a short one makes errors independent")
        if self.dip > STEEPEST:
            raise SettingError(f"dip must be at most {STEEPEST:g} degrees, but is {self.dip:g}")
        object.__setattr__(self, "matches", {name: _checked_choices(name, one) for name, one in self.matches.items()})

    @property
    def choices(self) -> dict[str, tuple[tuple[SlipProfile, float], ...]]:
        """The possible slips along each fault with their weights, which add up to 1."""
        return cast(dict, self.matches)


def _checked_choices(name: str, choices: Slips) -> tuple[tuple[SlipProfile, float], ...]:
    """Validate the matches of a fault; their weights are made to add up to 1."""
    if isinstance(choices, Scan):
        choices = [(peak.profile, peak.weight) for peak in choices.peaks]
    try:
        profiles, weights = zip(*choices, strict=True)
        shares = np.array([validation.finite_number("the weight of a match", weight) for weight in weights])
    except (TypeError, ValueError):
        profiles, shares = (), np.zeros(0)
    if not (shares >= 0).all() or not shares.any() or not all(isinstance(one, SlipProfile) for one in profiles):
        raise SettingError(
            f"the matches of fault {name!r} must be pairs of a seiswidgets.SlipProfile and a weight of 0 or more, not "
            "all of them 0"
        )
    return tuple(zip(profiles, (shares / shares.sum()).tolist(), strict=True))


@dataclass(frozen=True, eq=False)
class NoisyLine:
    """A line with enough points for its errors, in the section's units.

    Attributes
    ----------
    points : array, shape (n, 2)
    across : array, shape (n, 2)
        Displacement by an error of one cell.
    kernels : array, shape (n, m)
        See `noise_kernels`.
    """

    points: np.ndarray
    across: np.ndarray
    kernels: np.ndarray


@dataclass(frozen=True, eq=False)
class Perturbation:
    """Draws hypotheses around one: the same line errors, turns and velocities for the same seed and index.

    Parameters
    ----------
    drawn : Hypothesis
    uncertainty : Uncertainty
    seed : int
    """

    drawn: Hypothesis
    uncertainty: Uncertainty
    seed: int = 0

    def draw(self, index: int) -> Draw:
        """Draw the numbers of a member, each input from a stream of its own."""
        streams = (np.random.SeedSequence(self.seed, spawn_key=(index, which)) for which in range(len(INPUTS)))
        numbers = zip(INPUTS, self._counts, streams, strict=True)
        return {name: np.random.default_rng(stream).standard_normal(count) for name, count, stream in numbers}

    def hypothesis(self, index: int) -> Hypothesis:
        """The hypothesis of a member."""
        draw, picks = self.draw(index), self.drawn.interpretation
        horizon, turns = iter(self._errors("horizon", draw)), iter(np.radians(self.uncertainty.dip * draw["dip"]))
        fault = iter(self._errors("fault", draw))
        faults = [self._moved_fault(pick, fault, next(turns)) for pick in picks.faults]
        lines, ends = [pick.points for pick in faults if pick.use != IGNORE], iter(self._piece_ends)
        horizons = [self._moved_horizon(pick, horizon, ends, lines) for pick in picks.horizons]
        moved = replace(self.drawn, interpretation=Interpretation(faults, horizons, picks.bodies))
        chosen = {name: self.uncertainty.choices[name][k][0] for name, k in self._chosen(draw).items()}
        factor = float(np.exp(self.uncertainty.velocity * draw["velocity"][0]))
        return with_velocity(with_slip(moved, chosen), factor)

    def explanatory(self, index: int) -> Draw:
        """The numbers of a member that a regression can use: of a choice, 1 for what was chosen, 0 for the rest."""
        draw = self.draw(index)
        chosen = self._chosen(draw)
        flags = [np.arange(1, len(one)) == chosen[name] for name, one in self.uncertainty.choices.items()]
        return {**draw, "matches": np.concatenate([*flags, np.zeros(0)])}

    @property
    def likeliest(self) -> dict[str, SlipProfile]:
        """The match of each fault that has the largest weight."""
        return {name: max(one, key=lambda pair: pair[1])[0] for name, one in self.uncertainty.choices.items()}

    def _chosen(self, draw: Draw) -> dict[str, int]:
        """Index of the match of each fault."""
        chosen = {}
        for (name, choices), number in zip(self.uncertainty.choices.items(), draw["matches"], strict=True):
            through = np.cumsum([weight for _, weight in choices])
            chosen[name] = min(int(np.searchsorted(through, ndtr(number))), len(choices) - 1)
        return chosen

    @property
    def _counts(self) -> tuple[int, ...]:
        lines = [sum(line.kernels.shape[1] for line in group) for group in (self._horizons, self._faults)]
        return *lines, len(self.drawn.interpretation.faults), 1, len(self.uncertainty.matches)

    def _errors(self, kind: str, draw: Draw) -> Iterator[np.ndarray]:
        """Points of each line after its errors."""
        start, deviation = 0, getattr(self.uncertainty, kind)
        for line in self._horizons if kind == "horizon" else self._faults:
            numbers = draw[kind][start : start + line.kernels.shape[1]]
            start += len(numbers)
            yield line.points + deviation * (line.kernels @ numbers)[:, None] * line.across

    def _moved_horizon(
        self, pick: Horizon, errors: Iterator[np.ndarray], ends: Iterator[list[PieceEnd]], faults: list[np.ndarray]
    ) -> Horizon:
        moved = [next(errors) for _ in pick.pieces]
        if not (self.uncertainty.horizon or self.uncertainty.fault or self.uncertainty.dip):
            return pick
        pieces = [brought_to_faults(piece, next(ends), faults, self._cell) for piece in moved]
        return Horizon(*pieces, name=pick.name, use=pick.use)

    def _moved_fault(self, pick: Fault, errors: Iterator[np.ndarray], turn: float) -> Fault:
        points = next(errors)
        if not (self.uncertainty.fault or turn):
            return pick
        if turn:
            rock = self.drawn.section.to_rock(points)
            middle = np.array(LineString(rock).interpolate(0.5, normalized=True).coords[0])
            turned = middle + (rock - middle) @ [[np.cos(turn), np.sin(turn)], [-np.sin(turn), np.cos(turn)]]
            points = self.drawn.section.from_rock(turned)
        return Fault(points, pick.name, ends=self._ends(pick), use=pick.use)

    def _ends(self, fault: Fault) -> Ends:
        """The ends of a fault; one that nearly meets the border goes on meeting it, wherever it moves."""
        x_min, x_max, z_min, z_max = self.drawn.section.extent
        border = shapely.box(x_min, z_min, x_max, z_max)
        cell = self._cell

        def end(choice: str, point: np.ndarray) -> str:
            at = shapely.Point(point)
            nearest = np.array(border.exterior.interpolate(border.exterior.project(at)).coords[0])
            meets = not border.contains(at) or np.hypot(*((nearest - point) / cell)) <= NEAR
            return EXTEND if choice == AUTO and meets else choice

        first, last = both_ends(fault.ends)
        return end(first, fault.points[0]), end(last, fault.points[-1])

    @property
    def _cell(self) -> np.ndarray:
        """Distance between two traces and between two samples, in the section's units."""
        return np.array([self.drawn.section.dx, self.drawn.section.dz])

    @cached_property
    def _piece_ends(self) -> list[list[PieceEnd]]:
        """Ends of all pieces of horizons at faults that are not ignored."""
        picks = self.drawn.interpretation
        faults = [fault.points for fault in picks.faults if fault.use != IGNORE]
        pieces = (piece for pick in picks.horizons for piece in pick.pieces)
        return [list(piece_ends(piece, faults, self._cell)) for piece in pieces]

    @cached_property
    def _horizons(self) -> list[NoisyLine]:
        pieces = (piece for pick in self.drawn.interpretation.horizons for piece in pick.pieces)
        return [self._noisy(piece, level=True) for piece in pieces]

    @cached_property
    def _faults(self) -> list[NoisyLine]:
        return [self._noisy(pick.points, level=False) for pick in self.drawn.interpretation.faults]

    def _noisy(self, points: np.ndarray, level: bool) -> NoisyLine:
        section, length = self.drawn.section, self.uncertainty.correlation_length
        rock = shapely.get_coordinates(LineString(section.to_rock(points)).segmentize(length / DETAIL))
        arc_length = np.append(0, np.cumsum(np.hypot(*np.diff(rock, axis=0).T)))
        points, cell = section.from_rock(rock), self._cell
        across = np.tile([0.0, 1.0], (len(points), 1))
        if not level:
            along = np.gradient(points / cell, axis=0)
            across = along[:, ::-1] * [1, -1] / np.maximum(np.hypot(*along.T), np.finfo(float).tiny)[:, None]
        return NoisyLine(points, across * cell, noise_kernels(arc_length, length))
