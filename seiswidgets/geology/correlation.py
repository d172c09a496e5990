"""Similarity of the two sides of a fault: a check that a restoration has put together what belongs together."""

import warnings

import numpy as np
import shapely
from scipy.ndimage import map_coordinates

from seiswidgets.errors import Keyword, PickError
from seiswidgets.geology.picks import Fault
from seiswidgets.geology.restoration import Restoration

BESIDE = 0.1  # traces beside a fault at which its two sides are distinguished
LEAST_SAMPLES = 8


def cross_fault_correlation(restoration: Restoration, fault: Fault, gap: int = 2, width: int = 4) -> float:
    """Normalised cross-correlation of the strips on both sides of a fault, from -1 to 1.

    The strips follow the fault as it lies in the restored section. Each point on it has a left and a right side; the
    amplitudes beside the fault are read where these two lie in the present-day section, so that only the slip counts
    and not how the rock is bent next to it. Without any stage this is the present-day correlation.

    Parameters
    ----------
    restoration : Restoration
    fault : Fault
    gap, width : int
        Traces that are left out next to the fault, where its image is smeared, and traces that are compared.

    Raises
    ------
    PickError
        If the strips have fewer than eight samples with data on both sides.
    """
    section = restoration.original
    along = _sample_points(np.concatenate(restoration.carried(fault)), section.dz / 2)
    left, right = (_strip(restoration, along, side, gap, width) for side in (-1, 1))
    both = np.isfinite(left) & np.isfinite(right)
    if both.sum() < LEAST_SAMPLES:
        raise PickError(
            f"only {both.sum()} samples beside fault {fault.name!r} have data on both sides; at least {LEAST_SAMPLES} "
            "are needed to compare them: reduce ",
            Keyword("gap"),
            " or ",
            Keyword("width"),
            ", or choose a longer fault",
            pick=fault.name,
        )
    left, right = left[both] - left[both].mean(), right[both] - right[both].mean()
    return float(left @ right / max(np.sqrt((left @ left) * (right @ right)), np.finfo(float).tiny))


def likeness(restoration: Restoration, fault: Fault, gap: int = 2, width: int = 4) -> float:
    """Former name of `cross_fault_correlation`; deprecated since 0.1.0, and removed in 0.2.0."""
    warnings.warn("sw.likeness is now called sw.cross_fault_correlation", DeprecationWarning, stacklevel=2)
    return cross_fault_correlation(restoration, fault, gap, width)


def _sample_points(points: np.ndarray, step: float) -> np.ndarray:
    """Points along a line, about a step in z apart, shape (k, 2)."""
    line = shapely.LineString(points[np.argsort(points[:, 1], kind="stable")])
    count = max(2, int(np.ptp(shapely.get_coordinates(line)[:, 1]) / step))
    return shapely.get_coordinates(line.interpolate(np.linspace(0, 1, count), normalized=True))


def _strip(restoration: Restoration, along: np.ndarray, side: int, gap: int, width: int) -> np.ndarray:
    """Present-day amplitudes beside the points that are now on one side of a fault, shape (k, width)."""
    section = restoration.original
    points = restoration.to_original(along + [side * BESIDE * section.dx, 0])
    steps = side * (gap + np.arange(width))
    columns = (points[:, :1] - section.x0) / section.dx + steps
    rows = np.broadcast_to((points[:, 1:] - section.z0) / section.dz, columns.shape)
    return np.asarray(map_coordinates(section.amplitude, [rows, columns], order=1, cval=np.nan))
