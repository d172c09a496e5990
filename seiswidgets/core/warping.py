"""Alignment of two traces by a lag that varies along them: dynamic programming, then Gauss-Newton.

Both find the lag d(s) for which the first trace at s + d/2 resembles the second one at s - d/2. Dynamic programming
(after Hale, 2013, "Dynamic warping of seismic images") sees all lags at once and so finds the right cycle; Gauss-Newton
starts from its path, and is accurate to a small part of a sample.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy.ndimage import correlate1d, uniform_filter1d

OUTLIER = 2.0  # standard deviations: larger differences do not pull


@dataclass(frozen=True, eq=False)
class TracePair:
    """Two traces on one axis, with a mean of 0 and a mean square of 1, NaN where there are no data.

    Attributes
    ----------
    first, second : arrays, shape (n,)
    step : float
        Distance between their samples.
    """

    first: np.ndarray
    second: np.ndarray
    step: float

    @cached_property
    def slopes(self) -> tuple[np.ndarray, np.ndarray]:
        """Derivatives of both, 0 where there are no data."""
        first, second = (np.nan_to_num(np.gradient(trace, self.step)) for trace in (self.first, self.second))
        return first, second

    def shifted(self, lags: int) -> tuple[np.ndarray, np.ndarray]:
        """Both traces for all lags of -lags to lags samples, each half of the lag apart; shape (2 lags + 1, n).

        A lag of k is one of 2 k steps.
        """
        n, missing = len(self.first), np.full(lags, np.nan)
        index = np.arange(n) + np.arange(-lags, lags + 1)[:, None] + lags
        padded = [np.concatenate([missing, trace, missing]) for trace in (self.first, self.second)]
        return padded[0][index], padded[1][2 * lags + 2 * np.arange(n) - index]


def local_correlation(first: np.ndarray, second: np.ndarray, width: float, half: int = 0) -> np.ndarray:
    """Correlation of two arrays along their last axis in triangular windows, 0 where either has no data.

    Parameters
    ----------
    first, second : arrays, shape (..., n)
    width : float
        Standard deviation of the window, in samples.
    half : int
        -1 or 1 for the half of the window before or after each sample only.
    """
    known = np.isfinite(first) & np.isfinite(second)
    first, second = np.where(known, first, 0), np.where(known, second, 0)
    products = [_smooth(one * other, width, half) for one, other in ((first, second), (first, first), (second, second))]
    size = np.sqrt(np.maximum(products[1] * products[2], 0))
    return np.where(known & (size > 0), products[0] / np.where(size > 0, size, 1), 0)


def _smooth(values: np.ndarray, width: float, half: int) -> np.ndarray:
    box = max(1, round(np.sqrt(6) * width))  # two of these make a triangle
    if not half:
        return np.asarray(uniform_filter1d(uniform_filter1d(values, box, mode="constant"), box, mode="constant"))
    steps = np.arange(-box, box + 1)
    return np.asarray(correlate1d(values, (box - np.abs(steps)) * (half * steps >= 0.0), mode="constant"))


@dataclass(frozen=True, eq=False)
class PathSearch:
    """Dynamic programming for the lag at each position for which the sum of the scores along the path is largest.

    Paths are straight between nodes.

    Parameters
    ----------
    score : array, shape (k, n)
        By lag, counted in rows, and position.
    stretch : int
        Distance between nodes, in positions.
    steepest : int
        Largest change of the lag between two nodes, in rows.
    stiffness : float
        Score lost by a change of the lag between two nodes by one row, growing with its square.
    """

    score: np.ndarray
    stretch: int
    steepest: int
    stiffness: float

    @cached_property
    def nodes(self) -> np.ndarray:
        """Positions of the nodes, from first to last."""
        last = self.score.shape[1] - 1
        return np.linspace(0, last, max(1, round(last / self.stretch)) + 1).astype(int)

    @cached_property
    def _gains(self) -> list[np.ndarray]:
        """Between each two nodes, the score of each change from each lag; shape (changes, k)."""
        count, changes = len(self.score), np.arange(-self.steepest, self.steepest + 1)[:, None]
        start = np.arange(count)
        price = np.where((start + changes < 0) | (start + changes >= count), np.inf, self.stiffness * changes**2)
        gains = []
        for first, last in zip(self.nodes[:-1], self.nodes[1:], strict=True):
            gain = -price
            for position in range(first, last):
                shift = np.rint(changes * (position - first) / (last - first)).astype(int)
                gain = gain + self.score[np.clip(start + shift, 0, count - 1), position]
            gains.append(gain)
        return gains

    @cached_property
    def _ahead(self) -> list[tuple[np.ndarray, np.ndarray]]:
        """For each node but the last, the best score from there on by lag, and the change that leads to it."""
        return self._accumulate(1)

    @cached_property
    def _behind(self) -> list[tuple[np.ndarray, np.ndarray]]:
        """For each node but the first, the best score up to there by lag, and the change that it came by."""
        return self._accumulate(-1)

    def _accumulate(self, direction: int) -> list[tuple[np.ndarray, np.ndarray]]:
        count, changes = len(self.score), np.arange(-self.steepest, self.steepest + 1)
        columns = np.clip(np.arange(count) + direction * changes[:, None], 0, count - 1)
        best, found = np.zeros(count), []
        for gain in self._gains[::-direction]:
            if direction > 0:
                total = gain + best[columns]
            else:
                total = np.take_along_axis(gain, columns, axis=1) + best[columns]
                total[columns != np.arange(count) - changes[:, None]] = -np.inf
            best, choice = total.max(axis=0), changes[total.argmax(axis=0)]
            found.append((best, choice))
        return found[::-direction]

    def scores(self, node: int) -> np.ndarray:
        """The best score of all paths through each lag at a node, shape (k,)."""
        ahead = self._ahead[node][0] if node < len(self._gains) else 0.0
        return np.asarray((self._behind[node - 1][0] if node > 0 else np.zeros(len(self.score))) + ahead)

    def path(self, node: int, lag: int) -> np.ndarray:
        """The best path through a lag at a node, shape (n,), in rows."""
        before, after = [lag], [lag]
        for _, choice in self._behind[:node][::-1]:
            before.append(before[-1] - int(choice[before[-1]]))
        for _, choice in self._ahead[node:]:
            after.append(after[-1] + int(choice[after[-1]]))
        return np.interp(np.arange(self.score.shape[1]), self.nodes, [*before[:0:-1], *after])


def refine_lags(
    traces: TracePair, lags: np.ndarray, basis: np.ndarray, stiffness: float, among: slice, iterations: int = 12
) -> np.ndarray:
    """Improve lags by least squares: the traces' differences, and second differences of the lags; shape (n,).

    Parameters
    ----------
    traces : TracePair
    lags : array, shape (n,)
        Close to the answer, by less than a quarter of a wavelength.
    basis : array, shape (n, k)
        The lags are sums of its columns.
    stiffness : float
        Weight of the squared second differences of the coefficients.
    among : slice
        Positions whose differences count.
    """
    s = traces.step * np.arange(len(lags))
    bend = np.sqrt(stiffness) * np.diff(np.eye(basis.shape[1]), 2, axis=0)
    found = _solve(basis.T @ basis, basis.T @ lags)

    def differences(coefficients: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        lag = basis @ coefficients
        ends = (s + lag / 2, s - lag / 2)
        apart = np.subtract(*(_interpolate(*end, s) for end in zip(ends, (traces.first, traces.second), strict=True)))
        slope = sum(np.interp(end, s, trace) for end, trace in zip(ends, traces.slopes, strict=True)) / 2
        return apart[among], np.where(np.isfinite(apart), slope, 0)[among]

    def energy(coefficients: np.ndarray) -> float:
        apart = np.minimum(np.nan_to_num(differences(coefficients)[0], nan=np.sqrt(2)) ** 2, OUTLIER**2)
        return float(np.sum(apart) + np.sum((bend @ coefficients) ** 2))

    now = energy(found)
    for _ in range(iterations):
        apart, slope = differences(found)
        pulls = np.isfinite(apart) & (np.abs(apart) < OUTLIER)
        rows = basis[among][pulls] * slope[pulls, None]
        step = _solve(rows.T @ rows + bend.T @ bend, -rows.T @ apart[pulls] - bend.T @ (bend @ found))
        share = 1.0
        while share > 0.05 and (then := energy(found + share * step)) > now:
            share /= 2
        if share <= 0.05:
            break
        found, now = found + share * step, then
        if np.max(np.abs(step)) < 0.01 * traces.step:
            break
    return np.asarray(basis @ found)


def _solve(matrix: np.ndarray, vector: np.ndarray) -> np.ndarray:
    """Solve normal equations, slightly damped: a coefficient that nothing depends on stays as it is."""
    damping = 1e-9 * max(float(np.trace(matrix)), np.finfo(float).tiny) * np.eye(len(vector))
    return np.linalg.solve(matrix + damping, vector)


def _interpolate(at: np.ndarray, trace: np.ndarray, s: np.ndarray) -> np.ndarray:
    return np.interp(at, s, trace, left=np.nan, right=np.nan)
