"""Slope of the reflections in a picture, from its structure tensor."""

import numpy as np
from scipy.ndimage import gaussian_filter

STEEPEST = 3.0  # samples per trace


def bed_slopes(
    amplitude: np.ndarray, weight: np.ndarray, scale: tuple[float, float], window: tuple[float, float]
) -> np.ndarray:
    """Slope of the reflections around each sample, in samples per trace, down to the right; shape of the picture.

    The structure tensor is averaged where there is weight only, so that what lies beyond a fault does not count.

    Parameters
    ----------
    amplitude : array, shape (nz, nx)
        Finite.
    weight : array, the same shape
        Weight of each sample in the averages.
    scale, window : pair of float
        Standard deviations, in samples and traces, of the Gaussians that the gradient and the averages are taken with.
    """
    down, across = (gaussian_filter(amplitude, scale, order=order) for order in ((1, 0), (0, 1)))
    xx, xz, zz = (gaussian_filter(weight * product, window) for product in (across**2, across * down, down**2))
    angle = 0.5 * np.arctan2(2 * xz, xx - zz)  # of the gradient, from the x axis
    steep = np.maximum(np.abs(np.sin(angle)), 1 / np.hypot(1, STEEPEST)) * np.where(np.sin(angle) < 0, -1, 1)
    return np.asarray(np.clip(-np.cos(angle) / steep, -STEEPEST, STEEPEST))
