"""Change of the length of horizons, which restoration should leave as it is."""

import numpy as np

from seiswidgets.geology.domain import RestorationDomain
from seiswidgets.geology.findings import Finding

KEPT = 0.005  # of a horizon's length: a larger change is worth a finding


def length_change(edges, before, after) -> float:
    """Change of the length of some polylines, as a share of it.

    Parameters
    ----------
    edges : list of array, each of shape (k, 2)
        Pairs of vertices.
    before, after : array, shape (n, 2)
    """
    old, new = (_lengths(np.concatenate(edges), vertices).sum() for vertices in (before, after))
    return float(new / old - 1)


def stretched_bed(name: str, edges, before, after, domain: RestorationDomain) -> list[Finding]:
    """A finding if a horizon has become longer or shorter by more than 0.5%, at the place where it changed most."""
    change = length_change(edges, before, after)
    if abs(change) <= KEPT:
        return []
    edges = np.concatenate(edges)
    most = np.argmax(np.sign(change) * (_lengths(edges, after) - _lengths(edges, before)))
    place = before[edges[most]].mean(axis=0)
    text = (
        f"horizon {name} has become {abs(change):.1%} {'longer' if change > 0 else 'shorter'}, most of all near "
        f"{domain.where(place)}; check there how the horizon and the faults beside it are drawn"
    )
    return [Finding("warning", "bed length", text, name, domain.position(place))]


def _lengths(edges, vertices):
    return np.hypot(*(vertices[edges[:, 1]] - vertices[edges[:, 0]]).T)
