"""Steps in which whole columns of rock move up or down: flattening by vertical shear, and isostasy."""

import time
from collections.abc import Sequence
from functools import partial

import numpy as np
import shapely
from shapely import LineString

from seiswidgets.core.mesh import Mesh
from seiswidgets.core.solver import Progress
from seiswidgets.core.triangulation import edges_along
from seiswidgets.errors import PickError
from seiswidgets.geology.closed_form import ClosedForm
from seiswidgets.geology.domain import RestorationDomain
from seiswidgets.geology.layers import Layers
from seiswidgets.geology.observations import observe_bed
from seiswidgets.geology.picks import HORIZON
from seiswidgets.geology.stage import Stage
from seiswidgets.geology.stratigraphy import Profile, profile_at
from seiswidgets.geology.surfaces import FAR, surface_line, without_steps_back

FLATTENINGS = LENGTH, VERTICAL_SHEAR = "length", "vertical shear"


def shear_flat_stage(
    domain: RestorationDomain,
    name: str,
    pieces: Sequence[LineString],
    faults: Sequence[LineString],
    datum: float | Profile | None,
    progress: Progress | None = None,
) -> Stage:
    """Move each column up or down until a horizon lies on its datum: exact, and it keeps every area.

    Parameters
    ----------
    domain : RestorationDomain
    name : str
        Name of the horizon.
    pieces, faults : list of LineString
    datum : float, or points (x, z), optional
        In metres of rock; the horizon's mean level if left out.
    progress : callable, optional

    Raises
    ------
    PickError
        If the horizon has two depths in one column, as at a reverse fault.
    """
    began = time.perf_counter()
    surface, notes = surface_line(name, pieces, faults, domain)
    points = without_steps_back(shapely.get_coordinates(surface), FAR * float(domain.cell[0]))
    back = np.flatnonzero(np.diff(points[:, 0]) < -1e-6 * domain.spacing)
    if len(back):
        raise PickError(
            f"{HORIZON} {name!r} has two depths in one column near {domain.where(points[back[0]])}; undo the slip of "
            "the fault there first, or flatten it by length",
            pick=name,
            where=domain.position(points[back[0]]),
        )
    points = points[np.append(True, np.diff(points[:, 0]) > 1e-6 * domain.spacing)]
    is_top = _is_border(surface, domain)
    mesh = domain.mesh({} if is_top else {(HORIZON, name): [surface]})
    x, z = mesh.vertices.T
    depth = Layers(domain, {}, (), 1).columns(x).surface if is_top else np.interp(x, *points.T)
    target = profile_at(_mean_level(points, domain) if datum is None else datum, x)
    vertices = np.column_stack([x, z + target - depth])
    on_top = np.abs(z - depth) <= 1e-6 * domain.spacing
    edges = mesh.boundary[on_top[mesh.boundary].all(axis=1)] if is_top else _edges(mesh, surface, domain)
    observe = partial(observe_bed, name, edges, mesh.vertices, vertices, domain)
    return ClosedForm("flatten", (name,), domain, progress).stage(mesh, vertices, observe, notes, began)


def _mean_level(points: np.ndarray, domain: RestorationDomain) -> float:
    x_min, _, x_max, _ = domain.outline.bounds
    return float(np.interp(np.linspace(x_min, x_max, 1001), *points.T).mean())


def _is_border(surface: LineString, domain: RestorationDomain) -> bool:
    """True for the horizon that the section was stripped to: its line nearly is the border, but for simplification."""
    inside = surface.intersection(domain.outline)
    return bool(inside.difference(domain.outline.boundary.buffer(domain.sample)).length < domain.spacing)


def _edges(mesh: Mesh, surface: LineString, domain: RestorationDomain) -> np.ndarray:
    inside = shapely.get_parts(surface.intersection(domain.outline.buffer(1e-6 * domain.spacing)))
    lines = [part for part in inside if part.geom_type == "LineString"]
    return np.concatenate([edges_along(mesh, line, domain.spacing) for line in lines])
