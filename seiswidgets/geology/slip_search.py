"""The slip of each kind for which two walls match best: constant, linear, elliptic, or varying along the fault."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from scipy.signal import find_peaks, peak_widths

from seiswidgets.core.warping import PathSearch, TracePair, local_correlation, refine_lags
from seiswidgets.geology.correlation import correlation_of, significance
from seiswidgets.geology.fault_traces import FaultTraces
from seiswidgets.geology.slip_profile import SlipProfile

KINDS = CONSTANT, LINEAR, ELLIPTIC, PIECEWISE, VARYING = "constant", "linear", "elliptic", "piecewise", "varying"
WINDOW, NODES, KNOTS = 0.35, 0.5, 0.25  # of the wavelength: of local correlation, of paths and of their refinement
STEEPEST, PATH_STIFFNESS = 0.8, 0.05  # metres of slip per metre of fault; score lost by a change of one lag
STIFFNESS = 5000.0  # times the variance of what does not match: weight of the slip's second differences
NORMAL = 0.45  # median of the square of a normal variable
GRADIENTS = np.linspace(-0.2, 0.2, 17)  # metres of slip per metre of fault
MOST_PEAKS = 6
ROWS = 81  # positions of a profile that is neither constant nor linear
LEAST = 8  # points that two walls have in common
PROMINENT = 0.02
NOISE = 0.05  # of the variance: no image matches better


@dataclass(frozen=True)
class Peak:
    """A slip for which the walls of a fault match better than for those beside it.

    Attributes
    ----------
    slip : float
        At the middle of the fault, in metres of rock, positive for a normal fault.
    profile : SlipProfile
        The slip along the fault.
    correlation, samples, significance : float
        As for `Correlation`; the significance allows for all the slips that were tried.
    prominence : float
        Correlation by which the peak stands out of the curve.
    half_width : float
        Half its width at half its prominence, in metres.
    weight : float
        Relative likelihood; those of all peaks of a curve sum to 1.
    """

    slip: float
    profile: SlipProfile
    correlation: float
    samples: float
    significance: float
    prominence: float
    half_width: float
    weight: float = 1.0


@dataclass(frozen=True, eq=False)
class Curve:
    """The best correlation against the slip at the middle of a fault.

    Attributes
    ----------
    kind : {"constant", "linear", "elliptic", "varying", "piecewise"}
        How the slip may vary along the fault; elliptic slip dies out at both its ends, piecewise slip is linear in each
        interval.
    slip, correlation : arrays, shape (k,)
        In metres of rock; for varying and piecewise slip the mean of the local correlation.
    peaks : tuple of Peak
        At least one, the likeliest first.
    chance : float
        Correlation that the same search finds where there is nothing to find: between a wall and the other one upside
        down.
    freedom : float
        Number of parameters of the slip.
    """

    kind: str
    slip: np.ndarray
    correlation: np.ndarray
    peaks: tuple[Peak, ...]
    chance: float
    freedom: float

    @property
    def credible(self) -> bool:
        """True if the best match exceeds chance by more than the uncertainty of a correlation."""
        first = self.peaks[0]
        excess = np.subtract(*np.arctanh(np.clip([first.correlation, self.chance], -0.9999, 0.9999)))
        return bool(excess > 1.645 / np.sqrt(max(first.samples - 3, 0.1)))

    @property
    def cost(self) -> float:
        """Bayesian information criterion of the best match: its misfit, and a price for each parameter."""
        return misfit(self.peaks[0].correlation, self.peaks[0].samples) + self.freedom * np.log(
            max(self.peaks[0].samples, 2)
        )


def misfit(correlation: float, samples: float) -> float:
    """Twice the negative logarithm of the likelihood of a correlation."""
    return float(samples * np.log(max(1 - max(correlation, 0.0) ** 2, NOISE)))


@dataclass(frozen=True, eq=False)
class SlipSearch:
    """Search for the slip between two traces.

    Attributes
    ----------
    traces : FaultTraces
        The fault.
    pair : TracePair
        Its walls, or others of the same length.
    tried : array, shape (k,)
        Slips, in increasing order.
    intervals : array, shape (j,)
        Ends of the intervals of piecewise slip, in metres along the fault.
    """

    traces: FaultTraces
    pair: TracePair
    tried: np.ndarray
    intervals: np.ndarray

    def chances(self) -> Mapping[str, float]:
        """The highest correlation of each kind."""
        starts = {
            CONSTANT: self._at(CONSTANT, int(np.argmax(self._of_shape(CONSTANT)))),
            VARYING: self._varying(int(np.argmax(self._of_paths))),
        }
        elliptic = self._at(ELLIPTIC, int(np.argmax(self._of_shape(ELLIPTIC))))
        found = starts | {LINEAR: self._linear(starts.values()), ELLIPTIC: elliptic}
        if len(self.intervals):
            found[PIECEWISE] = self._piecewise(starts[VARYING])
        return {kind: self._correlation(slip) for kind, slip in found.items()}

    def curve(self, kind: str, chance: float) -> Curve:
        """The curve of one kind, and its peaks."""
        on_paths = kind in (VARYING, PIECEWISE)
        correlation = self._of_paths if on_paths else self._of_lines if kind == LINEAR else self._of_shape(kind)
        axis = self._lags if on_paths else self.tried
        peaks = self._peaks(kind, axis, correlation)
        varying = 2 + self.traces.length / (2 * self.traces.wavelength)
        freedom = {LINEAR: 2.0, VARYING: varying, PIECEWISE: float(len(self.intervals))}.get(kind, 1.0)
        return Curve(kind, axis, correlation, peaks, chance, freedom)

    def _peaks(self, kind: str, axis: np.ndarray, correlation: np.ndarray) -> tuple[Peak, ...]:
        """The highest peaks of a curve, the likeliest first; the highest point of a curve that has none."""
        indices, shape = find_peaks(correlation, prominence=PROMINENT)
        widths = peak_widths(correlation, indices)[0] * np.diff(axis).mean() / 2
        rows = list(zip(indices, shape["prominences"], widths, strict=True))
        rows = sorted(rows, key=lambda row: -correlation[row[0]])[:MOST_PEAKS]
        found = [self._peak(kind, int(index), *size) for index, *size in rows or [(correlation.argmax(), 0.0, np.nan)]]
        costs = np.array([misfit(peak.correlation, peak.samples) for peak in found])
        weights = np.exp((costs.min() - costs) / 2)
        weighted = [
            replace(peak, weight=float(weight)) for peak, weight in zip(found, weights / weights.sum(), strict=True)
        ]
        return tuple(sorted(weighted, key=lambda peak: -peak.weight))

    def _peak(self, kind: str, index: int, prominence: float, half_width: float) -> Peak:
        slip = self._at(kind, index)
        total, samples = self._correlation(slip), self._samples(slip)
        trials = max(1.0, np.ptp(self.tried) / self.traces.independence)
        middle = float(np.interp(self.traces.length / 2, self.traces.s, slip))
        believed = significance(total, samples) ** trials
        size = float(prominence), float(half_width)
        return Peak(middle, self._profile(kind, slip), total, samples, believed, *size)

    def _at(self, kind: str, index: int) -> np.ndarray:
        """The slip at a peak of a curve, refined; shape (n,)."""
        if kind in (VARYING, PIECEWISE):
            slips = self._varying(index)
            return slips if kind == VARYING else self._piecewise(slips)
        slip = float(self.tried[index])
        if kind != LINEAR:
            shape = self._shape(kind)
            return refine_lags(self.pair, slip * shape, shape[:, None], 0.0, self._within)
        return self._linear([slip + GRADIENTS[self._lines[:, index].argmax()] * self._from_middle])

    @cached_property
    def _within(self) -> slice:
        first, last = np.flatnonzero(self.traces.within)[[0, -1]]
        return slice(first, last + 1)

    @property
    def _from_middle(self) -> np.ndarray:
        return np.asarray(self.traces.s - self.traces.length / 2)

    def _walls(self, slip: np.ndarray, among: slice) -> tuple[np.ndarray, np.ndarray]:
        """Amplitudes that a slip brings together; shape (..., n) where the fault is."""
        s = self.traces.s
        ends = (s[among] + slip / 2, self.pair.first), (s[among] - slip / 2, self.pair.second)
        one, other = (np.interp(at, s, trace, left=np.nan, right=np.nan) for at, trace in ends)
        return one, other

    def _correlation(self, slip: np.ndarray) -> float:
        return _total(*self._walls(slip[self._within], self._within))

    def _samples(self, slip: np.ndarray) -> float:
        one, other = self._walls(slip[self._within], self._within)
        both = np.isfinite(one) & np.isfinite(other)
        return float(max(1.0, both.sum() * self.traces.step / self.traces.independence))

    def _shape(self, kind: str) -> np.ndarray:
        """Slip as a multiple of that at the middle: 1, or half an ellipse."""
        if kind != ELLIPTIC:
            return np.ones(len(self.traces.s))
        return np.sqrt(np.maximum(1 - (2 * self._from_middle / self.traces.length) ** 2, 0))

    def _of_shape(self, kind: str) -> np.ndarray:
        """Correlation for each slip at the middle."""
        shape = self._shape(kind)[self._within]
        return np.array([_discounted(*self._walls(slip * shape, self._within)) for slip in self.tried])

    @cached_property
    def _lines(self) -> np.ndarray:
        """Correlation by gradient and slip at the middle, at every third point of the fault."""
        among = slice(self._within.start, self._within.stop, 3)
        trend = GRADIENTS[:, None, None] * self._from_middle[among]
        one, other = self._walls(trend + self.tried[:, None], among)
        return _discounted(one, other)

    @property
    def _of_lines(self) -> np.ndarray:
        return np.asarray(self._lines.max(axis=0))

    @cached_property
    def _lags(self) -> np.ndarray:
        """Slips that paths consist of."""
        step = 2 * self.traces.step
        first, last = np.ceil(self.tried[0] / step), np.floor(self.tried[-1] / step)
        if last - first < 2:  # a peak has a slip on either side
            first, last = first - 2, last + 2
        return np.asarray(step * np.arange(first, last + 1))

    @cached_property
    def _paths(self) -> PathSearch:
        step, wavelength = self.traces.step, self.traces.wavelength
        walls = self._walls(self._lags[:, None], slice(None))
        stretch = max(2, round(NODES * wavelength / step))
        score = local_correlation(*walls, WINDOW * wavelength / step)
        return PathSearch(score, stretch, max(1, int(STEEPEST * stretch / 2)), PATH_STIFFNESS)

    @property
    def _middle(self) -> int:
        return int(np.argmin(np.abs(self._from_middle[self._paths.nodes])))

    @cached_property
    def _of_paths(self) -> np.ndarray:
        return self._paths.scores(self._middle) / len(self.traces.s)

    def _varying(self, index: int) -> np.ndarray:
        """The best path through a slip at the middle, refined."""
        step, wavelength = self.traces.step, self.traces.wavelength
        path = self._paths.path(self._middle, index)
        slip = np.interp(path, np.arange(len(self._lags)), self._lags)
        apart = np.subtract(*self._walls(slip, slice(None)))
        apart = apart[np.isfinite(apart)]
        variance = max(float(np.median(apart**2)) / NORMAL, 1e-4) if len(apart) else 1.0
        hats = _hats(len(slip), max(2, round(KNOTS * wavelength / step)))
        return refine_lags(self.pair, slip, hats, STIFFNESS * variance / (step * wavelength), slice(None))

    def _piecewise(self, start: np.ndarray) -> np.ndarray:
        """The best slip that is linear in each interval, from a slip that varies freely."""
        hats = [np.interp(self.traces.s, self.intervals, row) for row in np.eye(len(self.intervals))]
        return refine_lags(self.pair, start, np.column_stack(hats), 0.0, self._within)

    def _linear(self, starts: Iterable[np.ndarray]) -> np.ndarray:
        """The best line from any of some starts."""
        line = np.column_stack([np.ones(len(self.traces.s)), self._from_middle / self.traces.length])
        fits = [np.polyfit(self._from_middle[self._within], slip[self._within], 1) for slip in starts]
        lines = [np.polyval(fit, self._from_middle) for fit in fits]
        return max((refine_lags(self.pair, slip, line, 0.0, self._within) for slip in lines), key=self._correlation)

    def _profile(self, kind: str, slip: np.ndarray) -> SlipProfile:
        s, inside = self.traces.s[self._within], slip[self._within]
        count = {CONSTANT: 1, LINEAR: 2}.get(kind, min(ROWS, len(s)))
        rows = np.linspace(0, len(s) - 1, count).astype(int)
        return SlipProfile(tuple(s[rows]), tuple(inside[rows]))


def _total(one: np.ndarray, other: np.ndarray) -> float:
    """Correlation of two walls; 0 if they have nearly no points in common."""
    both = np.isfinite(one) & np.isfinite(other)
    return correlation_of(one[both], other[both]) if both.sum() >= LEAST else 0.0


def _discounted(one: np.ndarray, other: np.ndarray) -> np.ndarray:
    """Correlation along the last axis, less where few points are in common: they correlate by chance."""
    both = np.isfinite(one) & np.isfinite(other)
    count = np.maximum(both.sum(axis=-1, keepdims=True), 1)
    one, other = (np.where(both, wall, 0) for wall in (one, other))
    one, other = (np.where(both, wall - wall.sum(axis=-1, keepdims=True) / count, 0) for wall in (one, other))
    size = np.sqrt((one**2).sum(axis=-1) * (other**2).sum(axis=-1))
    return np.asarray((one * other).sum(axis=-1) / np.maximum(size, np.finfo(float).tiny) * np.sqrt(both.mean(axis=-1)))


def _hats(count: int, spacing: int) -> np.ndarray:
    """Functions that are 1 at one knot and 0 at the others, linear between; shape (count, knots)."""
    knots = np.linspace(0, count - 1, max(2, round(count / spacing) + 1))
    return np.array([np.interp(np.arange(count), knots, row) for row in np.eye(len(knots))]).T
