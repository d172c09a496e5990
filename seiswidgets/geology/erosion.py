"""Putting eroded rock back, as an area without an image."""

import time
from dataclasses import replace

import numpy as np
import shapely
from shapely import LineString, Polygon

from seiswidgets.core.solver import Progress
from seiswidgets.errors import SettingError
from seiswidgets.geology.bodies import Region
from seiswidgets.geology.closed_form import ClosedForm
from seiswidgets.geology.domain import RestorationDomain
from seiswidgets.geology.layers import Layers
from seiswidgets.geology.picks import HORIZON
from seiswidgets.geology.report import Observations
from seiswidgets.geology.stage import UNERODE, Stage
from seiswidgets.geology.stratigraphy import Profile, profile_at


def unerode_stage(
    domain: RestorationDomain, surface: float | Profile, name: str, progress: Progress | None = None
) -> Stage:
    """Fill the room between the rock and a surface above it with rock that has no image.

    Parameters
    ----------
    domain : RestorationDomain
    surface : float, or points (x, z)
        In metres of rock; level beyond its ends.
    name : str
        Names it in the report.
    progress : callable, optional

    Raises
    ------
    SettingError
        If the surface lies nowhere above the rock.
    """
    began = time.perf_counter()
    x_min, _, x_max, z_max = domain.outline.bounds
    inner = [x for x, _ in surface if x_min < x < x_max] if isinstance(surface, tuple) else []
    x = np.array([x_min, *inner, x_max])
    top = domain.simplify(LineString(np.column_stack([x, profile_at(surface, x)])))
    added = _above(domain, Polygon([*top.coords, (x_max, z_max), (x_min, z_max)]))
    if added.area <= domain.slack * domain.spacing:
        raise SettingError("the surface of the rock that was eroded lies nowhere above the rock; draw it higher")
    whole = shapely.union_all([domain.outline, added], grid_size=2.0**-30 * (x_max - x_min))
    filled = replace(domain, outline=whole)
    old = shapely.get_parts(shapely.line_merge(domain.outline.boundary.intersection(added)))
    mesh = filled.mesh({(HORIZON, name): [line for line in old if line.geom_type == "LineString"]})
    burial = mesh.vertices[:, 1] - Layers(filled, {}, (), 1).columns(mesh.vertices[:, 0]).surface

    def observe() -> Observations:
        return Observations(details=(("put back", f"{domain.area(added.area)} of rock without an image"),))

    making = ClosedForm(UNERODE, (name,), domain, progress)
    return making.stage(mesh, mesh.vertices.copy(), observe, (), began, np.maximum(burial, 0))


def _above(domain: RestorationDomain, filled: Polygon) -> Region:
    """The parts of an area beside the rock that lie on it, and not below or beside it."""
    _, _, _, z_max = domain.outline.bounds
    parts = [
        part
        for part in shapely.get_parts(filled.difference(domain.outline))
        if part.area > 0 and part.geom_type == "Polygon"
    ]
    rays = [LineString([point.coords[0], (point.x, z_max)]) for point in map(shapely.point_on_surface, parts)]
    thick = [not part.buffer(-domain.slack).is_empty for part in parts]
    return shapely.union_all(
        [
            part
            for part, ray, is_thick in zip(parts, rays, thick, strict=True)
            if is_thick and ray.intersects(domain.outline)
        ]
    )
