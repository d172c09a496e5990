"""Unfolding: making a horizon level while it keeps its length (the paper's section 3.2)."""

import time
from dataclasses import dataclass
from functools import partial

import numpy as np
import shapely
from shapely import LineString

from seiswidgets.core.mesh import Mesh, edge_keys
from seiswidgets.core.terms import AreaBarrier, ContourLaplacian, EdgeLength, Level, MeanValue
from seiswidgets.core.triangulation import edges_along
from seiswidgets.errors import PickError
from seiswidgets.geology.bed_length import length_change, stretched_bed
from seiswidgets.geology.domain import RestorationDomain
from seiswidgets.geology.fault_lines import merged
from seiswidgets.geology.findings import Finding
from seiswidgets.geology.report import BedReport
from seiswidgets.geology.solve import Options, reusable_setup, solved, vertex_masses, warm_start
from seiswidgets.geology.stage import Stage, staged

JOINED = 0.5  # of the mesh spacing: ends of two pieces that lie closer are one place


@dataclass(frozen=True, eq=False)
class Bed:
    """A mesh with a horizon among its edges.

    Attributes
    ----------
    mesh : Mesh
    edges : array, shape (k, 2)
        Those of the horizon.
    fingerprint : tuple
        What it was made for.
    """

    mesh: Mesh
    edges: np.ndarray
    fingerprint: tuple

    @property
    def reach(self) -> float:
        """What multiplies the horizon's weights: the root of the number of its edges.

        A horizon is a line, but has to move an area, whose stiffness stays the same on a finer mesh while that of the
        line's edges falls. With this factor the horizon keeps its length, and lies level, on any mesh.
        """
        return float(np.sqrt(len(self.edges)))


def flattened(domain: RestorationDomain, name: str, pieces, datum: float | None, options: Options) -> Stage:
    """The stage that makes a horizon level.

    Parameters
    ----------
    domain : RestorationDomain
    name : str
        The horizon's.
    pieces : list of LineString
        The horizon as it lies now.
    datum : float or None
        In metres of rock; None for the horizon's mean level.
    options : Options
    """
    began = time.perf_counter()
    fingerprint = domain.fingerprint({name: pieces})
    setup = reusable_setup(options.start, fingerprint) or _bed(domain, name, pieces, fingerprint)
    mesh, bed = setup.mesh, setup.edges
    datum = _mean_level(mesh.vertices[bed]) if datum is None else datum
    level = Level(np.unique(bed), datum, len(mesh.vertices), options.weights.flatten * setup.reach)
    free = np.ones(len(mesh.vertices), bool)
    terms = _terms(setup, level, options.weights)
    start = warm_start(mesh, free, options.start)
    start = mesh.vertices if start is None else start
    solution = solved(mesh, terms, start, free, domain.spacing, options, domain.where)
    vertices = solution.vertices.copy()
    drift = np.average(vertices[:, 0] - mesh.vertices[:, 0], weights=vertex_masses(mesh))
    vertices[:, 0] -= drift  # how far the whole moves sideways costs nothing: let it move least
    seconds = time.perf_counter() - began
    achieved = partial(_achieved, name, setup, level, vertices, domain)
    return staged("flatten", (name,), domain, mesh, vertices, solution, options.solver, seconds, setup, achieved)


def _achieved(name, setup, level, vertices, domain):
    """What is reported of the horizon."""
    off = vertices[level.vertices, 1] - level.datum
    flatness = float(np.sqrt(np.mean(off**2)) / domain.section.metres[1])
    report = BedReport(name, length_change([setup.edges], setup.mesh.vertices, vertices), flatness)
    uneven = () if np.abs(off).max() <= domain.slack else (_still_uneven(name, setup.mesh, level, off, domain),)
    stretched = stretched_bed(name, [setup.edges], setup.mesh.vertices, vertices, domain)
    return {"beds": (report,), "findings": (*uneven, *stretched)}


def _bed(domain, name, pieces, fingerprint):
    lines = _inside(joined(pieces, domain.spacing), domain, name)
    mesh = domain.mesh(lines)
    return Bed(mesh, np.concatenate([edges_along(mesh, line, domain.spacing) for line in lines]), fingerprint)


def _terms(setup, level, weights):
    mesh = setup.mesh
    others = mesh.edges[~np.isin(edge_keys(mesh.edges), edge_keys(setup.edges))]
    return [
        MeanValue(mesh, weights.mean_value),
        ContourLaplacian(mesh, weights.contour),
        EdgeLength(mesh.vertices, others, weights.edge),
        EdgeLength(mesh.vertices, setup.edges, weights.length * setup.reach, "bed length"),
        level,
        AreaBarrier(mesh),
    ]


def _mean_level(ends):
    lengths = np.hypot(*(ends[:, 1] - ends[:, 0]).T)
    return float(np.average(ends[:, :, 1].mean(axis=1), weights=lengths))


def _still_uneven(name, mesh, level, off, domain):
    farthest = mesh.vertices[level.vertices[np.argmax(np.abs(off))]]
    text = (
        f"horizon {name} is still up to {np.abs(off).max() / domain.section.metres[1]:.2g} {domain.section.z_unit} off "
        f"its datum near {domain.where(farthest)}; check how it is drawn there, or raise the weight flatten"
    )
    return Finding("problem", "datum", text, name, domain.position(farthest))


def _inside(lines, domain, name):
    pieces = [merged(shapely.get_coordinates(line), domain.spacing) for line in lines]
    lines = [domain.simplified(LineString(points)) for points in pieces if len(points) > 1]
    if not any(line.intersection(domain.outline).length > domain.spacing for line in lines):
        raise PickError(
            f"horizon {name!r} is no longer than the mesh spacing of {domain.spacing:.4g} m; draw more of it, or "
            "choose a finer spacing"
        )
    return lines


def joined(pieces, spacing) -> list[LineString]:
    """Pieces of a horizon whose ends nearly meet, as across a restored fault, brought together there."""
    points = [shapely.get_coordinates(piece).copy() for piece in pieces]
    ends = [(piece, place) for piece in range(len(points)) for place in (0, -1)]
    pairs = sorted(
        (float(np.hypot(*(points[one][a] - points[other][b]))), (one, a), (other, b))
        for number, (one, a) in enumerate(ends)
        for other, b in ends[:number]
        if one != other
    )
    met = set()
    for distance, one, other in pairs:
        if distance < JOINED * spacing and not {one, other} & met:
            middle = (points[one[0]][one[1]] + points[other[0]][other[1]]) / 2
            points[one[0]][one[1]] = points[other[0]][other[1]] = middle
            met |= {one, other}
    return list(
        shapely.get_parts(shapely.line_merge(shapely.multilinestrings([LineString(piece) for piece in points])))
    )
