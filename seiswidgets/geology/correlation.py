"""Similarity of the two walls of a fault: a check that a restoration has put together what belongs together."""

import warnings
from functools import cached_property

import numpy as np
from scipy.special import stdtr

from seiswidgets.core.warping import local_correlation
from seiswidgets.errors import PickError
from seiswidgets.geology.fault_traces import FOOT, HANGING, LEAST_SAMPLES, FaultTraces, fault_traces
from seiswidgets.geology.picks import Fault
from seiswidgets.geology.restoration import Restoration
from seiswidgets.geology.section import Section
from seiswidgets.geology.slip_profile import SlipProfile

BESIDE = 0.25  # samples beside a fault at which its two sides are distinguished
ON_FAULT = 3.0  # samples: points that come from farther off the present-day fault do not count
WINDOW = 0.5  # of the dominant wavelength: standard deviation of the windows of local correlation


class Correlation(float):
    """Correlation of the two walls of a fault, from -1 to 1: a number that knows how far it can be believed.

    Attributes
    ----------
    s : array, shape (n,)
        Arc lengths along the present-day fault from its upper end, in metres of rock, halfway between the two walls'.
    slip : array, shape (n,)
        Slip there, in metres, positive for a normal fault.
    local, above, below : arrays, shape (n,)
        Correlation in a window around each of these, and in its halves above and below; 0 where data are missing.
    samples : float
        Number of independent samples that were compared: neighbouring samples of one reflection are not independent.
    significance : float
        Probability that the walls of unrelated rock would correlate less; a high correlation of few samples can have
        a low significance.
    """

    s: np.ndarray
    slip: np.ndarray
    samples: float
    significance: float
    _walls: tuple[np.ndarray, np.ndarray]
    _window: float

    @cached_property
    def local(self) -> np.ndarray:
        return local_correlation(*self._walls, self._window)

    @cached_property
    def above(self) -> np.ndarray:
        return local_correlation(*self._walls, self._window, -1)

    @cached_property
    def below(self) -> np.ndarray:
        return local_correlation(*self._walls, self._window, 1)

    @property
    def total(self) -> float:
        """The correlation, as a plain number."""
        return float(self)

    @classmethod
    def of(cls, traces: FaultTraces, hanging_wall: np.ndarray, footwall: np.ndarray) -> "Correlation":
        """Compare points of the two walls, given by their arc lengths and equally spaced, NaN for none.

        Raises
        ------
        PickError
            If fewer than eight samples have data on both sides.
        """
        one, other = traces.read(HANGING, hanging_wall), traces.read(FOOT, footwall)
        both = np.isfinite(one) & np.isfinite(other)
        count = both.sum() * traces.step / (traces.section.dz * traces.section.metres[1])
        if count < LEAST_SAMPLES:
            raise PickError(
                f"only {count:.0f} samples beside fault {traces.name!r} have a counterpart with data on the other "
                f"side; at least {LEAST_SAMPLES} are needed to compare them",
                kind="short",
                pick=traces.name,
            )
        total = cls(correlation_of(one[both], other[both]))
        total.samples = max(1.0, both.sum() * traces.step / traces.independence)
        total.significance = significance(total, total.samples)
        total.s, total.slip = (hanging_wall + footwall) / 2, hanging_wall - footwall
        total._walls, total._window = (one, other), WINDOW * traces.wavelength / traces.step
        return total

    @classmethod
    def of_profile(cls, traces: FaultTraces, profile: SlipProfile) -> "Correlation":
        """Compare the points of the two walls that a slip brings together; PickError as above."""
        s = traces.s[traces.within]
        slip = profile.at(s)
        return cls.of(traces, s + slip / 2, s - slip / 2)

    def __repr__(self) -> str:
        belief = f"{self.samples:.0f} independent samples, significance {self.significance:.3f}"
        return f"<Correlation {float(self):.2f} of {belief}>"


def correlation_of(one: np.ndarray, other: np.ndarray) -> float:
    """Pearson's correlation; 0 if either is constant."""
    one, other = one - one.mean(), other - other.mean()
    return float(one @ other / max(np.sqrt((one @ one) * (other @ other)), np.finfo(float).tiny))


def significance(correlation: float, samples: float) -> float:
    """Probability that ``samples`` independent pairs without any relation correlate less (Student's t)."""
    if samples <= 2:
        return 0.0
    freedom = samples - 2
    return float(stdtr(freedom, correlation * np.sqrt(freedom / max(1 - correlation**2, 1e-12))))


def local_samples(traces: FaultTraces) -> float:
    """Number of independent samples in a window of local correlation."""
    return float(2 * np.sqrt(np.pi) * WINDOW * traces.wavelength / traces.independence)


def cross_fault_correlation(restoration: Restoration, fault: Fault, gap: int = 2, width: int = 8) -> Correlation:
    """Correlation of what a restoration has brought together on the two sides of a fault.

    Each point of the hanging wall faces a point of the footwall in the restored section. The amplitudes of the beds
    that reach the fault there are read in the present-day section, where beds are followed along their dip, so that
    only the slip counts and not how the rock is bent next to it. Without any stage this is the present-day correlation.

    Parameters
    ----------
    restoration : Restoration
    fault : Fault
    gap, width : int
        Traces that are left out next to the fault, where its image is smeared, and traces that are averaged.

    Returns
    -------
    Correlation
        A number, with the correlation as a function along the fault, and its significance.

    Raises
    ------
    PickError
        If the fault lies outside the section, all amplitudes beside it are alike, or fewer than eight samples have data
        on both sides.
    """
    section = restoration.original
    traces = fault_traces(section, fault, gap, width)
    inside = traces.s[traces.within]
    out = BESIDE * section.dz * section.metres[1]
    points = section.to_rock(traces.points(inside))
    moved = restoration.to_restored(section.from_rock(points + out * traces.into_hanging_wall(points)))
    here = section.to_rock(moved)
    across = restoration.to_original(section.from_rock(here - 2 * out * traces.into_hanging_wall(here)))
    return Correlation.of(
        traces, np.where(np.isfinite(moved[:, 0]), inside, np.nan), _arcs(traces, section.to_rock(across))
    )


def match(section: Section, fault: Fault, profile: SlipProfile, gap: int = 2, width: int = 8) -> Correlation:
    """Correlation of the two sides of a fault after undoing a slip, without a mesh: for trying many.

    The first call for a section and a fault reads the amplitudes beside it; every other takes about a millisecond.

    Parameters
    ----------
    section : Section
    fault : Fault
    profile : SlipProfile
    gap, width : int
        As for `cross_fault_correlation`.

    Raises
    ------
    PickError
        As for `cross_fault_correlation`.

    Examples
    --------
    >>> import seiswidgets as sw
    >>> case = sw.synthetic.planar_fault(throw=150, dip=90)
    >>> fault = case.interpretation.faults[0]
    >>> [sw.match(case.section, fault, sw.SlipProfile([0], [slip])) > 0.9 for slip in (0, 150)]
    [False, True]
    """
    return Correlation.of_profile(fault_traces(section, fault, gap, width), profile)


def likeness(restoration: Restoration, fault: Fault, gap: int = 2, width: int = 8) -> Correlation:
    """Former name of `cross_fault_correlation`; deprecated since 0.1.0, and removed in 0.2.0."""
    warnings.warn("sw.likeness is now called sw.cross_fault_correlation", DeprecationWarning, stacklevel=2)
    return cross_fault_correlation(restoration, fault, gap, width)


def _arcs(traces: FaultTraces, points: np.ndarray) -> np.ndarray:
    """Arc lengths of points beside the fault, NaN for those that come from elsewhere."""
    known = np.isfinite(points).all(axis=1)
    arcs, distance = traces.arcs(np.where(known[:, None], points, 0))
    near = distance <= ON_FAULT * traces.section.dz * traces.section.metres[1]
    return np.where(known & near, arcs, np.nan)
