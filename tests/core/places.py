"""Points carried through triangles one by one, as slowly and plainly as can be."""

import numpy as np


def carried(maps, points):
    """Points after a chain of (source, target, triangles), by barycentric coordinates; shape (n, 2)."""
    for source, target, triangles in maps:
        points = np.array([_carried(source[triangles], target[triangles], point) for point in points])
    return points


def _carried(before, after, point):
    matrix = np.concatenate([before.transpose(0, 2, 1), np.ones((len(before), 1, 3))], axis=1)
    weights = np.linalg.solve(matrix, np.append(point, 1.0)[:, None])[..., 0]
    best = np.argmax(weights.min(axis=1))
    return weights[best] @ after[best]
