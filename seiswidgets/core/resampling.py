"""Interpolation of amplitudes between the samples of a picture."""

from collections.abc import Callable
from functools import partial

import numpy as np
from numpy.typing import ArrayLike
from scipy.ndimage import distance_transform_edt, map_coordinates, spline_filter

from seiswidgets.core.point_location import TOLERANCE, batches
from seiswidgets.errors import SettingError

Sampler = Callable[[np.ndarray, np.ndarray], np.ndarray]


def resample(amplitude: ArrayLike, columns: ArrayLike, rows: ArrayLike, order: int) -> np.ndarray:
    """Interpolate amplitudes at fractional sample positions; shape of ``columns``, dtype of ``amplitude`` if floating.

    NaN where the position is NaN or outside, and where more than half of the neighbouring weight is NaN.

    Parameters
    ----------
    amplitude : array, shape (nz, nx)
    columns, rows : array, the same shape
        Positions in samples from the first.
    order : int
        1 (linear) or 3 (cubic spline).

    Raises
    ------
    SettingError
        If the order is neither.
    """
    if order not in (1, 3):
        raise SettingError(f"the order of interpolation must be 1 (linear) or 3 (cubic), but is {order}")
    amplitude = np.asarray(amplitude)
    values = amplitude.astype(np.promote_types(amplitude.dtype, np.float32), copy=False)
    columns, rows = np.asarray(columns, float), np.asarray(rows, float)
    result = np.full(columns.shape, np.nan, amplitude.dtype if amplitude.dtype.kind == "f" else values.dtype)
    sample = _sampler(values, order)
    flat, columns, rows = result.reshape(-1), columns.ravel(), rows.ravel()
    last_row, last_column = np.array(values.shape) - 1
    for batch in batches(len(flat)):
        row, column = rows[batch], columns[batch]
        inside = np.flatnonzero(_on_samples(row, last_row) & _on_samples(column, last_column))
        row, column = np.clip(row[inside], 0, last_row), np.clip(column[inside], 0, last_column)
        flat[batch][inside] = sample(row, column)
    return result


def _on_samples(positions: np.ndarray, last: int) -> np.ndarray:
    return np.asarray((positions >= -TOLERANCE) & (positions <= last + TOLERANCE))


def _sampler(amplitude: np.ndarray, order: int) -> Sampler:
    """A function of rows and columns that returns amplitudes, NaN where NaN has more than half of the weight."""
    missing = ~np.isfinite(amplitude)
    if not missing.any():
        return _complete_sampler(amplitude, order)
    if missing.all():
        return lambda rows, columns: np.full(rows.shape, np.nan)
    nearest = distance_transform_edt(missing, return_distances=False, return_indices=True)
    sample = _complete_sampler(amplitude[tuple(nearest)], order)
    share = _complete_sampler(missing.astype(np.float32), 1)
    return lambda rows, columns: np.where(share(rows, columns) > 0.5, np.nan, sample(rows, columns))


def _complete_sampler(amplitude: np.ndarray, order: int) -> Sampler:
    if order == 1:
        return partial(_linear, amplitude)
    spline = spline_filter(amplitude, 3, mode="mirror")
    return lambda rows, columns: map_coordinates(spline, (rows, columns), order=3, mode="mirror", prefilter=False)


def _linear(amplitude: np.ndarray, rows: np.ndarray, columns: np.ndarray) -> np.ndarray:
    flat, width = amplitude.ravel(), amplitude.shape[1]
    row, below, down = _neighbours(rows, amplitude.shape[0])
    column, beside, right = _neighbours(columns, width)
    upper, lower = (
        start + right * (flat[line + beside] - start)
        for line, start in ((line, flat[line + column]) for line in (row * width, below * width))
    )
    return np.asarray(upper + down * (lower - upper))


def _neighbours(positions: np.ndarray, count: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """The sample before each position, the one after, and the fraction between them."""
    before = np.minimum(positions.astype(np.int64), max(count - 2, 0))
    return before, np.minimum(before + 1, count - 1), positions - before
