"""Synthetic basins whose section is known at every time: growth faults, folds under unconformities, compaction."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import Unpack

import numpy as np

from seiswidgets.geology.events import Compact, Deposit, Erode, Event, EventHistory, Slip, level, subside
from seiswidgets.geology.forward_model import beds_trace, noisy_amplitude
from seiswidgets.geology.kinematics import (
    Circular,
    RigidMotion,
    ShearFold,
    Straight,
    Survey,
    SurveyKeywords,
    check_range,
)
from seiswidgets.geology.lithology import LITHOLOGIES, Lithology
from seiswidgets.geology.picks import Fault, Horizon, Interpretation
from seiswidgets.geology.section import Section
from seiswidgets.geology.stratigraphy import Layer, Stratigraphy

Numbers = tuple[float, ...]
AGE = 5.0  # Ma, between two tops


@dataclass(frozen=True, eq=False)
class SyntheticBasin:
    """A section with its interpretation and stratigraphy, known at every time.

    Parameters
    ----------
    section : Section
    interpretation : Interpretation
        Its faults F1, F2, ..., and its horizons H1, H2, ..., young to old.
    stratigraphy : Stratigraphy
        The youngest layer reaches up to the top of the section, at 0 Ma.
    trace : array, shape (n, 2)
        Rows ``(depth, amplitude)`` of the beds as a pile.
    fixed : (x, z) or None
        A point in the footwall.
    history : EventHistory
    """

    section: Section
    interpretation: Interpretation
    stratigraphy: Stratigraphy
    trace: np.ndarray = field(repr=False)
    fixed: tuple[float, float] | None
    history: EventHistory = field(repr=False)

    def at_age(self, points: np.ndarray, age: float) -> np.ndarray:
        """Return points of the section to when the top of that age was complete; NaN where they were not there yet."""
        ages = [layer.age for layer in self.stratigraphy.layers]
        return self.history.at(np.asarray(points, float), len(ages) - 1 - ages.index(age))


def make_basin(
    name: str,
    survey: Survey,
    events: Sequence[Event],
    faults: Sequence[Fault],
    thickness: Numbers,
    rocks: Sequence[Lithology | str],
    fixed: tuple[float, float] | None = None,
) -> SyntheticBasin:
    """Lay down layers by a history of events, and pick faults and the tops of all layers but the youngest.

    Parameters
    ----------
    thickness : tuple of float
        Of each layer in the pile of beds, old to new, m.
    rocks : list of Lithology or str
        Young to old.
    """
    history, rng = EventHistory(tuple(events)), np.random.default_rng(survey.seed)
    count = len(history.deposits)
    trace = beds_trace(rng, tuple(np.cumsum(thickness[:0:-1]).tolist()))
    beds = history.bed(survey.grid().reshape(-1, 2), survey, thickness)
    section = Section(noisy_amplitude(rng, survey, beds, trace), survey.dx, survey.dz, name=name)
    horizons = [Horizon(*history.horizon(count - 1 - index, survey), name=f"H{index}") for index in range(1, count)]
    layers = [Layer(f"H{index}" if index else None, AGE * index, rock) for index, rock in enumerate(rocks)]
    return SyntheticBasin(section, Interpretation(faults, horizons), Stratigraphy(layers), trace, fixed, history)


def growth_fault(
    throws: Numbers = (60.0, 50.0, 40.0),
    thickness: float = 250.0,
    cover: float = 200.0,
    dip: float = 60.0,
    radius: float | None = None,
    **keywords: Unpack[SurveyKeywords],
) -> SyntheticBasin:
    """A fault that slipped before each layer was laid down level over it; a cover that it does not cut.

    Parameters
    ----------
    throws : tuple of float
        Throw of each step of slip at the level of its time, old to new, m.
    thickness, cover : float
        Of each layer in the footwall, and of the youngest one, m.
    dip : float
        Of the fault, where the middle of the growth strata meets it, in degrees.
    radius : float, optional
        Of a fault along a circle, on which the hanging wall turns, m; straight if left out.
    """
    check_range("dip", dip, 30, 80, " degrees")
    check_range("thickness", thickness, 20, 1000, " m")
    check_range("cover", cover, 20, 2000, " m")
    survey = Survey(**keywords)
    count = len(throws)
    depth = cover + thickness * count / 2
    x = 0.35 * survey.width
    events: list[Event] = [Deposit(level(0))]
    for index, throw in enumerate(throws):
        sunk = cover + thickness * (count - 1 - index)  # by which the basin subsides after this step's layer
        fault = _fault((x, depth - sunk - thickness), dip, radius)
        motion = (
            RigidMotion(shift=throw / fault.direction[1] * fault.direction)
            if isinstance(fault, Straight)
            else RigidMotion(-throw / (fault.radius * np.sin(np.deg2rad(dip))), fault.centre)
        )
        events += [Slip(fault, motion), subside(thickness), Deposit(level(0))]
    events += [subside(cover), Deposit(level(0))]
    line = _fault((x, depth), dip, radius).polyline(survey)
    drawn = Fault(survey.snap(_below(line, cover + thickness)), name="F1")
    layers = (1000.0, *(thickness + throw / 2 for throw in throws), cover)
    rocks = ["sand", *["shaly sand"] * count, "basement"]
    return make_basin("growth fault", survey, events, [drawn], layers, rocks, (0.05 * survey.width, survey.depth / 2))


def half_graben(
    throws: Numbers = (180.0, 140.0, 100.0, 60.0),
    thickness: float = 150.0,
    cover: float = 300.0,
    dip: float = 60.0,
    radius: float = 4000.0,
    **keywords: Unpack[SurveyKeywords],
) -> SyntheticBasin:
    """A basin that opened by turning along a circular fault, with wedges of growth strata under an unfaulted cover.

    The arguments are those of `growth_fault`.
    """
    return growth_fault(throws, thickness, cover, dip, radius, **keywords)


def _fault(point: tuple[float, float], dip: float, radius: float | None) -> Straight | Circular:
    return Straight(point, dip) if radius is None else Circular(point, dip, radius)


def _below(line: np.ndarray, depth: float) -> np.ndarray:
    """The part of a line that descends, below a depth."""
    line = line[np.argsort(line[:, 1])]
    return np.vstack([[np.interp(depth, line[:, 1], line[:, 0]), depth], line[line[:, 1] > depth + 1]])


def folded_unconformity(
    amplitude: float = 120.0,
    wavelength: float = 2500.0,
    thickness: float = 250.0,
    eroded: float = 200.0,
    cover: float = 300.0,
    **keywords: Unpack[SurveyKeywords],
) -> SyntheticBasin:
    """Level layers, folded by vertical shear, eroded to a level, and covered.

    Parameters
    ----------
    amplitude, wavelength : float
        Of the sine fold, m.
    thickness : float
        Of each of three folded layers, m.
    eroded : float
        Depth of the erosion below the mean level of the youngest of them, m.
    cover : float
        Thickness above the unconformity, m.
    """
    check_range("amplitude", amplitude, 0, 500, " m")
    check_range("wavelength", wavelength, 500, 1e5, " m")
    survey = Survey(**keywords)
    fold = ShearFold(lambda x: amplitude * np.sin(2 * np.pi * x / wavelength))
    events: list[Event] = [Deposit(level(0))]
    for _ in range(3):
        events += [subside(thickness), Deposit(level(0))]
    events += [fold, Erode(level(eroded)), subside(cover - eroded), Deposit(level(0))]
    rocks = ["sand", "shaly sand", "shale", "sand", "basement"]
    return make_basin("folded unconformity", survey, events, [], (1000.0, *[thickness] * 3, cover), rocks)


def compacted_basin(
    solids: Numbers = (250.0, 300.0, 200.0, 250.0),
    rocks: Sequence[str] = ("sand", "shale", "shaly sand", "chalk"),
    relief: float = 0.5,
    **keywords: Unpack[SurveyKeywords],
) -> SyntheticBasin:
    """Layers that compacted under each other above a basement that sank, thickest in the middle of the basin.

    Parameters
    ----------
    solids : tuple of float
        Thickness of the grains of each layer in the middle, old to new, m.
    rocks : list of str
        Lithology of each layer, old to new.
    relief : float
        Share by which the layers are thinner at the borders.
    """
    check_range("relief", relief, 0, 0.95)
    survey = Survey(**keywords)
    grains: list[Callable[[np.ndarray], np.ndarray]] = [
        lambda x, solid=solid: solid * (1 - relief * (2 * x / survey.width - 1) ** 2)  # type: ignore[misc]
        for solid in solids
    ]
    named = [LITHOLOGIES[rock] for rock in rocks]
    events: list[Event] = [Deposit(level(0))]
    for index, (load, rock) in enumerate(zip(grains, named, strict=True)):
        older = tuple(grains[:index][::-1]), tuple(named[:index][::-1])
        events += [Compact(*older, level(0), level(0), load, rock), Deposit(level(0))]
    pile = (1000.0, *(2 * solid for solid in solids))
    return make_basin("compacted basin", survey, events, [], pile, [*rocks[::-1], "basement"])
