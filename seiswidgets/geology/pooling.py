"""A class's interpretations of one section, pooled into one picture of their uncertainty."""

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

from seiswidgets.errors import PickError
from seiswidgets.geology.comparison import PickComparison, compare_picks
from seiswidgets.geology.picks import HORIZON, Interpretation
from seiswidgets.geology.section import Section


@dataclass(frozen=True, eq=False)
class PooledPicks:
    """Many interpretations of one section, matched with a reference; see `pool_picks`.

    Attributes
    ----------
    reference : Interpretation
    interpretations : tuple of Interpretation
    comparisons : tuple of PickComparison
    x : array, shape (n,)
    depths : dict of str to array, shape (interpretations, n)
        Of each horizon of the reference, in the section's unit of z; NaN where it was not picked.
    throws : dict of (str, str) to array, shape (interpretations,)
        By fault and horizon, in the section's unit of z; NaN where there is none.
    """

    reference: Interpretation
    interpretations: tuple[Interpretation, ...]
    comparisons: tuple[PickComparison, ...]
    x: np.ndarray = field(repr=False)
    depths: dict[str, np.ndarray] = field(repr=False)
    throws: dict[tuple[str, str], np.ndarray] = field(repr=False)

    def depth_percentiles(self, horizon: str, percentiles: Sequence[float] = (10, 50, 90)) -> np.ndarray:
        """Percentiles of a horizon's depth along x, shape (percentiles, n); NaN where fewer than half picked it."""
        depths = self.depths[horizon]
        enough = np.isfinite(depths).sum(axis=0) >= max(1, len(depths) / 2)
        found = np.full((len(percentiles), depths.shape[1]), np.nan)
        found[:, enough] = np.nanpercentile(depths[:, enough], percentiles, axis=0)
        return found

    def throw_percentiles(
        self, fault: str, horizon: str, percentiles: Sequence[float] = (10, 50, 90)
    ) -> np.ndarray | None:
        """Percentiles of a throw; None if nobody has it."""
        throws = self.throws[fault, horizon]
        return np.nanpercentile(throws, percentiles) if np.isfinite(throws).any() else None


def pool_picks(
    section: Section, interpretations: Sequence[Interpretation], reference: Interpretation | None = None
) -> PooledPicks:
    """Pool a class's interpretations of one section, to see how far they differ.

    Parameters
    ----------
    section : Section
    interpretations : sequence of Interpretation
    reference : Interpretation, optional
        The truth, or a teacher's picks, by which picks are matched; the first interpretation if left out.

    Raises
    ------
    PickError
        If there is no interpretation.
    """
    if not interpretations:
        raise PickError("there is no interpretation to pool; give one or more")
    reference = interpretations[0] if reference is None else reference
    comparisons = tuple(compare_picks(section, picks, reference) for picks in interpretations)
    pooled = list(zip(interpretations, comparisons, strict=True))
    depths = {
        horizon.name: np.array([_depths(section.x, picks, found, horizon.name) for picks, found in pooled])
        for horizon in reference.horizons
    }
    keys = [(score.fault, score.horizon) for score in comparisons[0].throws]
    values = np.array([[np.nan if one.picked is None else one.picked for one in found.throws] for found in comparisons])
    throws = {key: values[:, index] for index, key in enumerate(keys)}
    return PooledPicks(reference, tuple(interpretations), comparisons, section.x, depths, throws)


def _depths(x: np.ndarray, picks: Interpretation, found: PickComparison, name: str) -> np.ndarray:
    """Depth along x of the pick that was matched with a horizon."""
    depth = np.full(len(x), np.nan)
    pick = next(line.pick for line in found.lines if (line.kind, line.name) == (HORIZON, name))
    for piece in picks.horizon(pick).pieces if pick is not None else ():
        along, down = piece[np.argsort(piece[:, 0], kind="stable")].T
        inside = (x >= along[0]) & (x <= along[-1])
        depth[inside] = np.interp(x[inside], along, down)
    return depth
