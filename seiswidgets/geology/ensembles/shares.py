"""How much of the variance of each result an input explains, by linear regression.

The numbers that drew a member are independent, so that the variance of a linear model of a result is the sum of its
parts by input: the first-order shares of variance. What the model leaves over is interaction, curvature and noise.
"""

from collections.abc import Mapping

import numpy as np

LEAST = 1.5  # members for each number that is drawn: with fewer, the regression would fit anything
TINY = 1e-12  # of a result's size: variance by rounding


def first_order_shares(inputs: Mapping[str, np.ndarray], results: np.ndarray) -> dict[str, np.ndarray]:
    """Share of each result's variance that each input explains alone.

    Each share is the variance of the input's part of an ordinary least-squares fit, less what noise adds to it.

    Parameters
    ----------
    inputs : dict of str to array, shape (n, m)
        Standard normal numbers of each input.
    results : array, shape (n, q)
        NaN where a member has none.

    Returns
    -------
    dict of str to array, shape (q,)
        NaN where there are too few members for the regression, or the result does not vary.
    """
    every = np.column_stack([np.ones(len(results)), *inputs.values()])
    stops = np.cumsum([1, *(numbers.shape[1] for numbers in inputs.values())])
    columns = dict(zip(inputs, map(slice, stops[:-1], stops[1:]), strict=True))
    shares = {name: np.full(results.shape[1], np.nan) for name in inputs}
    for index, result in enumerate(results.T):
        known = np.isfinite(result)
        variance = float(np.var(result[known])) if known.any() else 0.0
        if known.sum() < LEAST * every.shape[1] or variance <= (TINY * np.abs(result[known]).max()) ** 2:
            continue
        for name, share in _shares(every[known], result[known], columns).items():
            shares[name][index] = np.clip(share / variance, 0, 1)
    return shares


def _shares(design: np.ndarray, result: np.ndarray, columns: Mapping[str, slice]) -> dict[str, float]:
    """Variance explained by the columns of each input."""
    inverse = np.linalg.pinv(design.T @ design)
    slopes = inverse @ design.T @ result
    noise = float(np.sum((result - design @ slopes) ** 2)) / max(1, len(result) - design.shape[1])
    explained = {}
    for name, chosen in columns.items():
        spread = np.atleast_2d(np.cov(design[:, chosen], rowvar=False, ddof=0))
        part = slopes[chosen] @ spread @ slopes[chosen] - noise * np.sum(spread * inverse[chosen, chosen])
        explained[name] = float(part)
    return explained
