"""The picture of a restored section: each sample fetched once, from the original."""

from collections.abc import Sequence
from dataclasses import replace
from itertools import count

import numpy as np

from seiswidgets.core.resampling import resampled
from seiswidgets.geology.section import Section
from seiswidgets.geology.stage import Stage


def picture(original: Section, stages: Sequence[Stage], order: int, cells: int | None) -> Section:
    """A section after some stages, interpolated in the original; see ``Restoration.picture``."""
    x, z, step = _lattice(original, stages, cells)
    columns, rows = _origins(original, stages, x, z) if stages else np.meshgrid(x, z)
    return replace(
        original,
        amplitude=resampled(original.amplitude, columns, rows, order),
        x0=original.x0 + original.dx * x[0],
        z0=original.z0 + original.dz * z[0],
        dx=original.dx * step,
        dz=original.dz * step,
    )


def _lattice(original, stages, cells):
    """Columns and rows of the picture, counted in samples of the original, and the step between them.

    The step is the least that leaves no more than so many cells, and every column and row is a multiple of it: a
    lattice that stands still while the rock moves over it.
    """
    low, high = _reach(original, stages)
    for step in count(1):
        first, last = np.ceil(low / step - 1e-6), np.floor(high / step + 1e-6)
        thin = last <= first  # a section has two traces and two samples at least
        first, last = np.where(thin, np.floor(low / step), first), np.where(thin, np.floor(low / step) + 1, last)
        if cells is None or np.prod(last - first + 1) <= cells:
            return *(step * np.arange(a, b + 1) for a, b in zip(first, last, strict=True)), step


def _reach(original, stages):
    """First and last column and row that the rock reaches, in samples of the original."""
    if not stages:
        return np.zeros(2), np.array(original.shape[::-1]) - 1.0
    vertices = stages[-1].vertices
    return np.transpose(_in_samples(original, np.stack([vertices.min(axis=0), vertices.max(axis=0)])))


def _origins(original, stages, x, z):
    """Where each node of a lattice comes from, in samples of the original: columns and rows, of its shape."""
    scale = original.metres
    places = (
        stages[-1]
        .map.inverse_on_grid((original.x0 + original.dx * x) * scale[0], (original.z0 + original.dz * z) * scale[1])
        .reshape(-1, 2)
    )
    for stage in reversed(stages[:-1]):
        places = stage.map.inverse(places)
    return [line.reshape(len(z), len(x)) for line in _in_samples(original, places)]


def _in_samples(original, places):
    """Columns and rows of places in the rock, counted in samples of the original."""
    first, step = np.array([original.x0, original.z0]), np.array([original.dx, original.dz])
    return [places[:, k] / (original.metres[k] * step[k]) - first[k] / step[k] for k in (0, 1)]
