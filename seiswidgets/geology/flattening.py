"""Unfolding: making a horizon level while it keeps its length (the paper's section 3.2)."""

import time
from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial

import numpy as np
import shapely
from shapely import LineString

from seiswidgets.core.mesh import Mesh, edge_keys
from seiswidgets.core.term import Term
from seiswidgets.core.terms import AreaBarrier, ContourLaplacian, EdgeLength, Level, MeanValue
from seiswidgets.core.triangulation import edges_along
from seiswidgets.errors import PickError
from seiswidgets.geology.bedding import bedding_terms
from seiswidgets.geology.domain import RestorationDomain
from seiswidgets.geology.fault_lines import merge_close_points
from seiswidgets.geology.observations import observe_level
from seiswidgets.geology.picks import HORIZON
from seiswidgets.geology.segments import join_pieces
from seiswidgets.geology.solve import SolverOptions, minimise, reusable_setup, warm_start
from seiswidgets.geology.stage import Outcome, Stage
from seiswidgets.geology.weights import Weights


@dataclass(frozen=True, eq=False)
class Bed:
    """A mesh with a horizon among its edges.

    Attributes
    ----------
    mesh : Mesh
    edges : array, shape (k, 2)
        Edges of the horizon.
    fingerprint : tuple
        Everything that shaped the mesh.
    """

    mesh: Mesh
    edges: np.ndarray
    fingerprint: tuple

    @property
    def reach(self) -> float:
        """Factor of the horizon's weights: the root of the number of its edges.

        A horizon is a line, but has to move an area, whose stiffness stays the same on a finer mesh while that of the
        line's edges falls. With this factor the horizon keeps its length, and lies level, on any mesh.
        """
        return float(np.sqrt(len(self.edges)))


def flatten_stage(
    domain: RestorationDomain,
    name: str,
    pieces: Sequence[LineString],
    datum: float | None,
    options: SolverOptions,
    guides: Sequence[LineString] = (),
) -> Stage:
    """Make a horizon level.

    Parameters
    ----------
    domain : RestorationDomain
    name : str
        Name of the horizon.
    pieces : list of LineString
        The horizon before the step.
    datum : float or None
        In metres of rock; None for the horizon's mean level.
    options : SolverOptions
    guides : list of LineString
        Other horizons, which give the direction of the beds too.
    """
    began = time.perf_counter()
    bed = mesh_bed(domain, name, pieces, options.start)
    mesh = bed.mesh
    datum = _mean_level(mesh.vertices[bed.edges]) if datum is None else datum
    level = Level(np.unique(bed.edges), datum, len(mesh.vertices), options.row_weights.flatten * bed.reach)
    free = np.ones(len(mesh.vertices), bool)
    start = warm_start(mesh, free, options.start)
    start = mesh.vertices if start is None else start
    terms = [
        *_terms(bed, level, options.row_weights),
        *bedding_terms(mesh, [*pieces, *guides], domain.spacing, options.row_weights),
    ]
    solution = minimise(mesh, terms, start, free, domain, options)
    vertices = solution.vertices.copy()
    drift = np.average(vertices[:, 0] - mesh.vertices[:, 0], weights=mesh.vertex_areas)
    vertices[:, 0] -= drift  # a shift of the whole sideways costs nothing: choose the least
    observe = partial(observe_level, name, bed, level, vertices, domain)
    outcome = Outcome((name,), solution, options.solver, time.perf_counter() - began, observe)
    return Stage("flatten", mesh, vertices, (), domain, outcome, bed)


def mesh_bed(domain: RestorationDomain, name: str, pieces: Sequence[LineString], start: Stage | None = None) -> Bed:
    """Mesh a horizon; an earlier stage's set-up is reused if it is identical.

    Raises
    ------
    PickError
        If too little of the horizon lies inside the rock.
    """
    fingerprint = domain.fingerprint({name: pieces})
    if earlier := reusable_setup(start, Bed, fingerprint):
        return earlier
    lines = _tidy(join_pieces(pieces, domain.cell), domain, name)
    mesh = domain.mesh({(HORIZON, name): lines})
    return Bed(mesh, np.concatenate([edges_along(mesh, line, domain.spacing) for line in lines]), fingerprint)


def _terms(bed: Bed, level: Level, weights: Weights) -> list[Term]:
    mesh = bed.mesh
    others = mesh.edges[~np.isin(edge_keys(mesh.edges), edge_keys(bed.edges))]
    return [
        MeanValue(mesh, weights.mean_value),
        ContourLaplacian(mesh, weights.contour),
        EdgeLength(mesh.vertices, others, weights.edge),
        EdgeLength(mesh.vertices, bed.edges, weights.length * bed.reach, "bed length"),
        level,
        AreaBarrier(mesh),
    ]


def _mean_level(ends: np.ndarray) -> float:
    lengths = np.hypot(*(ends[:, 1] - ends[:, 0]).T)
    return float(np.average(ends[:, :, 1].mean(axis=1), weights=lengths))


def _tidy(lines: Sequence[LineString], domain: RestorationDomain, name: str) -> list[LineString]:
    """Simplify the lines of a horizon; PickError if too little of it lies inside the rock."""
    pieces = [merge_close_points(shapely.get_coordinates(line), domain.spacing) for line in lines]
    tidied = [domain.simplify(domain.on_border(LineString(points))) for points in pieces if len(points) > 1]
    inside = [shapely.get_coordinates(line.intersection(domain.outline)) for line in tidied]
    if all(len(points) < 2 or domain.is_short(points) for points in inside):
        raise PickError(
            f"horizon {name!r} is no longer than three traces and samples, too short to flatten; draw more of it",
            pick=name,
            where=domain.position(pieces[0][0]) if pieces else None,
        )
    return tidied
