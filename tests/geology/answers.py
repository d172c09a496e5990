"""Restorations that several modules read, and how far a stage is from a synthetic section's true answer."""

from functools import cache

import numpy as np

import seiswidgets as sw
from seiswidgets.geology.solve import nearest_rigid


def restored_in_two_stages(case, **choices):
    picks = case.interpretation
    unfaulted = sw.Restoration(case.section, **choices).unfault(picks.faults, picks.horizons, fixed=case.fixed)
    return unfaulted.flatten(picks.horizons[1])


@cache
def restored_fold():
    """A faulted fold on a coarse mesh, and its restoration in two stages."""
    case = sw.synthetic.faulted_fold()
    return case, restored_in_two_stages(case, spacing=120)


def random_points(section, count, seed=0):
    x_min, x_max, z_min, z_max = section.extent
    return np.random.default_rng(seed).uniform((x_min, z_min), (x_max, z_max), (count, 2))


def spacing_for(section, count):
    """A mesh spacing that gives about so many vertices."""
    x_min, x_max, z_min, z_max = section.extent
    return np.sqrt((x_max - x_min) * (z_max - z_min) * 1.15 / count)


def block_errors(stage, truth, block, rigid=False):
    """Distance of each triangle's centre from where it belongs, in metres, and the label of its block, shape (m,).

    A triangle between a round fault and the polygon that stands for it may be on the wrong side of the true fault: its
    block is the one that most of its connected neighbours are in, and where the two differ the error is left out.
    """
    centres, moved = (at[stage.mesh.triangles].mean(axis=1) for at in (stage.mesh.vertices, stage.vertices))
    part, label = stage.mesh.blocks[stage.mesh.triangles[:, 0]], block(centres)
    own = np.array([np.bincount(label[part == number]).argmax() for number in range(part.max() + 1)])[part]
    right = own == label
    if rigid:
        moved = nearest_rigid(truth(centres)[right], moved[right], stage.mesh.areas[right])
        return np.hypot(*(moved - truth(centres)[right]).T), own[right]
    return np.hypot(*(moved - truth(centres))[right].T), own[right]


def largest_throw(stage):
    return max(abs(cutoff.throw) for cutoff in stage.report.cutoffs)
