"""Gaussian noise along a line whose values are alike over a length."""

import numpy as np

APART, BEYOND = 0.75, 1.5  # correlation lengths: between the kernels, and from an end of the line to the last of them


def noise_kernels(arc_length: np.ndarray, length: float) -> np.ndarray:
    """Kernels whose sum, weighted by independent standard normal numbers, is correlated noise of variance 1.

    Two points a distance d apart have the correlation exp(-d² / 2 length²): 0.61 at the length, 0.14 at twice that.

    Parameters
    ----------
    arc_length : array, shape (n,)
        Positions along the line.
    length : float

    Returns
    -------
    array, shape (n, m)
    """
    low, high = arc_length[0] - BEYOND * length, arc_length[-1] + BEYOND * length
    centres = np.linspace(low, high, int(np.ceil((high - low) / (APART * length))) + 1)
    kernels = np.exp(-(((arc_length[:, None] - centres) / length) ** 2))
    return np.asarray(kernels / np.sqrt(np.sum(kernels**2, axis=1, keepdims=True)))
