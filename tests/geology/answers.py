"""How far a stage is from a synthetic section's true answer."""

import numpy as np

from seiswidgets.geology.solve import nearest_rigid


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
