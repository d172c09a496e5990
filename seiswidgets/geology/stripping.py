"""Stripping: removing the rock above a horizon."""

import time
from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import shapely
from shapely import LineString

from seiswidgets.core.solver import Progress
from seiswidgets.errors import PickError
from seiswidgets.geology.bodies import Region
from seiswidgets.geology.closed_form import ClosedForm
from seiswidgets.geology.domain import RestorationDomain
from seiswidgets.geology.report import Observations
from seiswidgets.geology.stage import STRIP, Stage
from seiswidgets.geology.surfaces import region_below, surface_line


def strip_stage(
    domain: RestorationDomain,
    name: str,
    pieces: Sequence[LineString],
    faults: Sequence[LineString],
    progress: Progress | None = None,
) -> Stage:
    """Remove the rock above a horizon: the identity below it, nothing above.

    Parameters
    ----------
    domain : RestorationDomain
    name : str
        Name of the horizon.
    pieces, faults : list of LineString
        Before the step; between two pieces that end at one fault the border follows the fault.
    progress : callable, optional

    Raises
    ------
    PickError
        If the horizon makes no surface, or no rock lies below it.
    """
    began = time.perf_counter()
    surface, notes = surface_line(name, pieces, faults, domain)
    left = remaining(name, domain, surface)
    mesh = replace(domain, outline=left).mesh({})
    removed = domain.outline.area - left.area

    def observe() -> Observations:
        share = removed / domain.outline.area
        return Observations(details=(("removed", f"{domain.area(removed)} of rock, {share:.1%}, above {name}"),))

    making = ClosedForm(STRIP, (name,), domain, progress, tuple(faults))
    return making.stage(mesh, mesh.vertices.copy(), observe, notes, began)


def remaining(name: str, domain: RestorationDomain, surface: LineString) -> Region:
    """The rock below a surface, without slivers thinner than two samples; PickError if there is none."""
    below = domain.outline.intersection(region_below(surface, domain))
    parts = [part for part in shapely.get_parts(below) if part.geom_type == "Polygon"]
    parts = [part for part in parts if not part.buffer(-domain.sample).is_empty]
    if not parts:
        point = np.mean(shapely.get_coordinates(surface), axis=0)
        raise PickError(
            f"nothing is left of the section below horizon {name!r}; strip a younger horizon, or none",
            kind="nothing left",
            pick=name,
            where=domain.position(point),
        )
    return shapely.union_all(parts)
