"""Strain of each triangle, and its distribution over the section."""

import numpy as np
from numpy.typing import ArrayLike

from seiswidgets.core.mapping import PiecewiseAffineMap
from seiswidgets.core.mesh import Mesh, triangle_areas
from seiswidgets.errors import SettingError

USUAL_SPAN = 1.1  # colours end at 10%, so that pictures can be compared, unless the user rescales them
LEAST_SPAN = 1.01  # of a histogram in which no area has changed
AREA_RATIO_COLOURS = "RdBu_r"  # red is compression, blue expansion; distinguishable with colour blindness
SPANS = (1.02, 1.05, 1.1, 1.25, 1.5, 2.0, 3.0, 5.0)  # area ratios at which colours may end


def area_ratio(mesh: Mesh, vertices: ArrayLike) -> np.ndarray:
    """Area before over area after the deformation, of each triangle (fig. 6d); above 1 it was compressed; shape (m,).

    Parameters
    ----------
    mesh : Mesh
    vertices : array, shape (n, 2)
        Positions of the mesh's vertices after the deformation.
    """
    return np.asarray(mesh.areas / triangle_areas(np.asarray(vertices, float), mesh.triangles))


def principal_stretches(mesh: Mesh, vertices: np.ndarray) -> np.ndarray:
    """Singular values of each triangle's affine map, the larger first; shape (m, 2).

    Parameters
    ----------
    mesh : Mesh
    vertices : array, shape (n, 2)
        Positions of the mesh's vertices after the deformation.
    """
    (xx, xz), (zx, zz) = PiecewiseAffineMap(mesh.vertices, vertices, mesh.triangles).gradient.transpose(1, 2, 0)
    larger = (np.hypot(xx + zz, zx - xz) + np.hypot(xx - zz, zx + xz)) / 2
    smaller = np.abs(xx * zz - xz * zx) / np.maximum(larger, np.finfo(float).tiny)
    return np.column_stack([larger, smaller])


def area_ratio_histogram(
    ratio: np.ndarray, areas: np.ndarray, bins: int = 41, span: float | None = None
) -> tuple[np.ndarray, np.ndarray]:
    """Edges of bins of area ratio, shape (bins + 1,), and the share of the area in each, shape (bins,).

    The edges run from 1 / span to span, evenly in the logarithm; an odd number of bins has one about 1. Ratios
    beyond the ends are counted in the end bins.

    Parameters
    ----------
    ratio, areas : array, shape (m,)
        Area ratio of each triangle, and its area before.
    bins : int
    span : float, optional
        Largest ratio, above 1; by default the most extreme ratio, or its inverse.

    Raises
    ------
    SettingError
        If the span is not above 1.
    """
    if span is None:
        span = max(np.max(ratio), 1 / np.min(ratio), LEAST_SPAN)
    if not span > 1:
        raise SettingError(f"span must be above 1, since the histogram runs from 1 / span to span, but is {span:g}")
    edges = span ** np.linspace(-1, 1, bins + 1)
    bin_of_triangle = np.searchsorted(edges[1:-1], ratio, side="right")
    return edges, np.bincount(bin_of_triangle, weights=areas, minlength=bins) / np.sum(areas)


def weighted_percentiles(values: ArrayLike, weights: ArrayLike, percents: ArrayLike) -> np.ndarray:
    """Percentiles of values weighted, for example, by areas; shape of ``percents``.

    Each value lies at the middle of its own weight, and between values the percentile is linear (Hazen's rule).

    Parameters
    ----------
    values, weights : array, shape (m,)
    percents : array
        From 0 to 100.
    """
    order = np.argsort(values)
    sorted_weights = np.asarray(weights, float)[order]
    through = np.cumsum(sorted_weights)
    middle = 100 * (through - sorted_weights / 2) / through[-1]
    return np.asarray(np.interp(np.asarray(percents, float), middle, np.asarray(values, float)[order]))


def colour_span(ratio: np.ndarray, areas: np.ndarray) -> float:
    """End of a colour scale: a round area ratio such that 98% of the area lie between its inverse and it; at most 5.

    Parameters
    ----------
    ratio, areas : array, shape (m,)
    """
    low, high = weighted_percentiles(ratio, areas, (1, 99))
    farthest = max(high, 1 / low)
    return next((span for span in SPANS if span >= farthest), SPANS[-1])
