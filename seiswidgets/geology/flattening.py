"""Unfolding: making a horizon level while it keeps its length (the paper's section 3.2)."""

import time
from collections.abc import Sequence
from functools import partial

import numpy as np
from shapely import LineString

from seiswidgets.core.terms import AreaBarrier, ContourLaplacian, MeanValue
from seiswidgets.geology.bed_mesh import mesh_bed
from seiswidgets.geology.bedding import bedding_terms
from seiswidgets.geology.beyond import FREE, Beyond
from seiswidgets.geology.domain import RestorationDomain
from seiswidgets.geology.observations import observe_level
from seiswidgets.geology.solve import SolverOptions, minimise, warm_start
from seiswidgets.geology.stage import Outcome, Stage
from seiswidgets.geology.stratigraphy import Profile, profile_at

AGAIN = 2  # times that a horizon is brought to a datum that varies along the section


def flatten_stage(
    domain: RestorationDomain,
    name: str,
    pieces: Sequence[LineString],
    datum: float | Profile | None,
    options: SolverOptions,
    guides: Sequence[LineString] = (),
    before: Stage | None = None,
    beyond: str = FREE,
) -> Stage:
    """Bring a horizon to a level, or to a profile.

    Parameters
    ----------
    domain : RestorationDomain
    name : str
        Name of the horizon.
    pieces : list of LineString
        The horizon before the step.
    datum : float, or points (x, z), or None
        In metres of rock; None for the horizon's mean level.
    options : SolverOptions
    guides : list of LineString
        Other horizons, which give the direction of the beds too.
    before : Stage, optional
        The stage before.
    beyond : {"free", "keep", "level", "trend"}
        What happens to the rock beyond the horizon's ends.
    """
    began = time.perf_counter()
    rest = Beyond.of(pieces, domain, beyond)
    bed = mesh_bed(domain, name, [*pieces, *rest.extensions], options.start, before)
    mesh = bed.mesh
    datum = _mean_level(bed.positions(mesh.vertices)[bed.edges], rest) if datum is None else datum
    varies, free = isinstance(datum, tuple), rest.free_vertices(mesh)
    start = warm_start(mesh, free, options.start)
    vertices = mesh.vertices if start is None else start
    bedding = bedding_terms(mesh, [*pieces, *guides], domain.spacing, options.row_weights)
    for _ in range(AGAIN if varies else 1):  # the datum at each point depends on its final x
        target = profile_at(datum, bed.positions(vertices)[np.unique(bed.edges), 0])
        level = bed.level(target, options.row_weights.flatten)
        terms = [
            MeanValue(mesh, options.row_weights.mean_value),
            ContourLaplacian(mesh, options.row_weights.contour),
            *bed.terms(level, options.row_weights),
            AreaBarrier(mesh),
            *bedding,
        ]
        solution = minimise(mesh, terms, vertices, free, domain, options)
        vertices = solution.vertices.copy()
    if not varies and free.all():  # a shift of the whole sideways costs nothing: choose the least
        vertices[:, 0] -= np.average(vertices[:, 0] - mesh.vertices[:, 0], weights=mesh.vertex_areas)
    observe = partial(observe_level, name, bed, level, vertices, rest)
    outcome = Outcome((name,), solution, options.solver, time.perf_counter() - began, observe)
    return Stage("flatten", mesh, vertices, (), domain, outcome, bed)


def _mean_level(ends: np.ndarray, rest: Beyond) -> float:
    """Mean level of a horizon, without its extensions, from the ends of its edges, shape (k, 2, 2)."""
    ends = ends[rest.is_drawn(ends[:, :, 0].mean(axis=1))] if rest.extensions else ends
    lengths = np.hypot(*(ends[:, 1] - ends[:, 0]).T)
    return float(np.average(ends[:, :, 1].mean(axis=1), weights=lengths))
