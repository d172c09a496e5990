"""Carry points, picks, amplitudes and area ratios of a section through the stages of a restoration."""

from collections.abc import Callable, Hashable, Mapping, Sequence
from dataclasses import replace
from itertools import count

import numpy as np
import shapely
from numpy.typing import ArrayLike
from shapely import LineString

from seiswidgets.errors import PickError
from seiswidgets.geology import validation
from seiswidgets.geology.bodies import Body, body_polygons
from seiswidgets.geology.clipping import clip_line
from seiswidgets.geology.domain import RestorationDomain
from seiswidgets.geology.fault_curves import fault_curve
from seiswidgets.geology.fault_lines import merge_close_points, resample_fine
from seiswidgets.geology.picks import Fault, Horizon
from seiswidgets.geology.section import Section
from seiswidgets.geology.stage import Stage

Lines = list[LineString]

OUTSIDE = "outside"  # kind of the errors about picks that are not in the rock


def carried_fault(
    original: Section, stages: Sequence[Stage], fault: Fault, domain: RestorationDomain | None = None
) -> np.ndarray:
    """The points of a fault after some stages, shape (n, 2); what sticks out of the section is left out.

    Parameters
    ----------
    original : Section
    stages : list of Stage
    fault : Fault
    domain : RestorationDomain, optional
        The rock before the first stage, for which the fault is resampled if it was digitised finely.
    """
    lines = _carried_parts(original, stages, fault, domain)
    if not lines and not clip_line(original, fault.points):
        raise _outside(original, f"fault {fault.name!r}", fault)
    if not lines:
        raise PickError(
            f"nothing is left of fault {fault.name!r} after the stages before; it lies outside the rock",
            kind=OUTSIDE,
            pick=fault.name,
        )
    return shapely.get_coordinates(lines)


def carried_boundaries(
    original: Section, stages: Sequence[Stage], faults: Mapping[str, Fault], domain: RestorationDomain
) -> dict[str, np.ndarray]:
    """The points of faults after some stages, each of shape (n, 2), without those of which nothing is left."""
    parts = {name: _carried_parts(original, stages, fault, domain) for name, fault in faults.items()}
    return {name: shapely.get_coordinates(lines) for name, lines in parts.items() if lines}


def _carried_parts(
    original: Section, stages: Sequence[Stage], fault: Fault, domain: RestorationDomain | None
) -> list[LineString]:
    parts = clip_line(original, fault.points)
    if domain is not None:
        parts = [resample_fine(merge_close_points(points, domain.spacing), domain) for points in parts]
    lines = [fault_curve(points, original.dz * float(original.metres[1])) for points in parts]
    key = fault, domain is not None
    return _through(
        stages, key, lines, lambda stage, lines: [part for line in lines for part in stage.carried_fault(line)]
    )


def _through(stages: Sequence[Stage], key: Hashable, lines: Lines, carry: Callable[[Stage, Lines], Lines]) -> Lines:
    """Carry lines through stages, each of which remembers what it has carried."""
    known = next((count for count in range(len(stages), 0, -1) if key in stages[count - 1].carried), 0)
    if known:
        lines = stages[known - 1].carried[key]
    for stage in stages[known:]:
        lines = carry(stage, lines)
        stage.remember(key, lines)
    return lines


def carried_horizon(
    original: Section, stages: Sequence[Stage], horizon: Horizon, *, flawless: bool = False
) -> list[LineString]:
    """The pieces of a horizon after some stages, joined where they now meet; without what sticks out of the section.

    Pieces with a flaw can be left out.
    """
    pieces = [piece for piece, flaw in zip(horizon.pieces, horizon.flaws, strict=True) if not (flawless and flaw)]
    lines = [LineString(points) for piece in pieces for points in clip_line(original, piece)]
    if not lines:
        raise _outside(original, f"horizon {horizon.name!r}", horizon)
    return _through(stages, (horizon, flawless), lines, lambda stage, lines: stage.carried_horizon(lines))


def carried_body(original: Section, stages: Sequence[Stage], body: Body) -> list[LineString]:
    """The closed borders of a body's parts after some stages."""
    region = body_polygons(original, [body])[body.name]
    for stage in stages:
        region = stage.carried_body(region)
    return [LineString(part.exterior) for part in shapely.get_parts(region)]


def _outside(original: Section, what: str, pick: Fault | Horizon) -> PickError:
    x, z = (pick.points if isinstance(pick, Fault) else pick.pieces[0])[0].tolist()
    return PickError(
        f"{what} lies outside the section, which reaches from {original.reach}; leave it out, or check its coordinates",
        kind=OUTSIDE,
        pick=pick.name,
        where=(x, z),
    )


def carried_point(original: Section, stages: Sequence[Stage], held: ArrayLike, name: str = "fixed") -> np.ndarray:
    """A held point after some stages, shape (2,); ``name`` names it in errors."""
    try:
        point = validation.as_points(held).reshape(2)
    except ValueError:
        raise PickError(f"{name} must be one point (x, z), but is {held!r}") from None
    point = validation.point_in_section(original, point, name)[None]
    for stage in stages:
        point = stage.map.forward(point)
    return point[0]


def area_ratio_at(stages: Sequence[Stage], points: np.ndarray) -> np.ndarray:
    """Present-day over restored area, of all stages together, at points of the rock before the first one; shape (n,).

    Parameters
    ----------
    stages : list of Stage
    points : array, shape (n, 2)
        In metres of rock; points outside give NaN.
    """
    ratio = np.ones(len(points))
    for stage in stages:
        triangles = stage.map.source_finder(points)
        points = stage.map.forward(points, triangles)
        ratio = ratio * stage.area_ratio[triangles]
    return np.where(np.isfinite(points).all(axis=1), ratio, np.nan)


def picture(original: Section, stages: Sequence[Stage], order: int, cells: int | None) -> Section:
    """A section after some stages, interpolated in the original; see `Restoration.picture`."""
    x, z, step = _lattice(original, stages, cells)
    columns, rows = _origins(original, stages, x, z) if stages else np.meshgrid(x, z)
    return replace(
        original,
        amplitude=original.sampled(np.asarray(columns), np.asarray(rows), order),
        x0=original.x0 + original.dx * x[0],
        z0=original.z0 + original.dz * z[0],
        dx=original.dx * step,
        dz=original.dz * step,
        conversion=None,
    )


def _lattice(original: Section, stages: Sequence[Stage], cells: int | None) -> tuple[np.ndarray, np.ndarray, int]:
    """Columns and rows of the picture, counted in samples of the original, and the step between them.

    The step is the least that leaves at most ``cells`` cells, and every column and row is a multiple of it: the lattice
    stays in place while the rock moves over it.
    """
    low, high = _reach(original, stages)
    for step in count(1):
        first, last = np.ceil(low / step - 1e-6), np.floor(high / step + 1e-6)
        thin = last <= first  # a section has at least two traces and two samples
        first, last = np.where(thin, np.floor(low / step), first), np.where(thin, np.floor(low / step) + 1, last)
        if cells is None or np.prod(last - first + 1) <= cells:
            break
    x, z = (step * np.arange(a, b + 1) for a, b in zip(first, last, strict=True))
    return x, z, step


def _reach(original: Section, stages: Sequence[Stage]) -> tuple[np.ndarray, np.ndarray]:
    """First and last column and row that the rock reaches, in samples of the original."""
    if not stages:
        return np.zeros(2), np.array(original.shape[::-1]) - 1.0
    vertices = stages[-1].vertices
    low, high = np.transpose(_in_samples(original, np.stack([vertices.min(axis=0), vertices.max(axis=0)])))
    return low, high


def _origins(original: Section, stages: Sequence[Stage], x: np.ndarray, z: np.ndarray) -> list[np.ndarray]:
    """Columns and rows of the original that the nodes of a lattice come from, of the lattice's shape."""
    scale = original.metres
    points = (
        stages[-1]
        .map.inverse_on_grid((original.x0 + original.dx * x) * scale[0], (original.z0 + original.dz * z) * scale[1])
        .reshape(-1, 2)
    )
    for stage in reversed(stages[:-1]):
        points = stage.map.inverse(points)
    return [index.reshape(len(z), len(x)) for index in _in_samples(original, points)]


def _in_samples(original: Section, points: np.ndarray) -> list[np.ndarray]:
    """Columns and rows of points in the rock, counted in samples of the original."""
    first, step = np.array([original.x0, original.z0]), np.array([original.dx, original.dz])
    return [points[:, k] / (original.metres[k] * step[k]) - first[k] / step[k] for k in (0, 1)]
