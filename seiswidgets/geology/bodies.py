"""Areas without beds to restore, such as salt or gaps in the data: holes in the mesh, whose borders are free."""

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, replace
from typing import TypeAlias

import numpy as np
import shapely
from numpy.typing import ArrayLike
from shapely import MultiPolygon, Polygon

from seiswidgets.errors import PickError, SettingError, number_text
from seiswidgets.geology.section import Section

BODY = "body"
KINDS = SALT, NO_DATA = "salt", "no data"
LEAST_AREA = 4  # cells, that a body covers

Region: TypeAlias = Polygon | MultiPolygon


@dataclass(frozen=True, eq=False)
class Body:
    """An area without beds to restore: a hole in the mesh with a free border.

    Salt flows, so nobody knows which grain of it was where: the restored section is empty inside a body, and points in
    it have no restored position. The report gives its area before and after each step.

    Parameters
    ----------
    points : array, shape (n, 2), n >= 3
        Rows ``(x, z)`` in the section's units, around the body; the last one is joined to the first.
    kind : {"salt", "no data"}
    name : str
        Its name in errors and reports.

    Raises
    ------
    PickError
        If there are fewer than three different points, one is not finite, or the border crosses itself.
    SettingError
        If there is no such kind.
    """

    points: np.ndarray
    kind: str = SALT
    name: str = "body"

    def __post_init__(self) -> None:
        check_kind(self.name, self.kind)
        object.__setattr__(self, "points", _border(self.points, f"body {self.name!r}", self.name))

    def mapped(self, line_map: Callable[[np.ndarray], np.ndarray]) -> "Body":
        """Apply a function of lines, shape (n, 2) to (m, 2), to the closed border."""
        return replace(self, points=line_map(np.vstack([self.points, self.points[:1]])))


def check_kind(name: str, kind: str) -> None:
    """Raise SettingError for a kind of body that does not exist."""
    if kind not in KINDS:
        text = f"the kind of body {name!r} must be {' or '.join(map(repr, KINDS))}, but is {kind!r}"
        raise SettingError(text, pick=name)


def _border(points: ArrayLike, what: str, name: str) -> np.ndarray:
    """Validate the points around a body, without a repetition of the first at the end."""
    try:
        line = np.array(points, dtype=float)
    except (TypeError, ValueError):
        raise PickError(f"{what} must be a list of points (x, z), each of two numbers", pick=name) from None
    if line.ndim != 2 or line.shape[1] != 2 or not np.isfinite(line).all():
        raise PickError(f"{what} must be a list of finite points (x, z); correct them", pick=name)
    line = line[:-1] if len(line) > 1 and (line[0] == line[-1]).all() else line
    if len(np.unique(line, axis=0)) < 3:
        raise PickError(f"{what} needs at least three different points around it; draw more", pick=name)
    ring = shapely.LinearRing(line)
    if not ring.is_simple or Polygon(ring).area == 0:
        x, z = line[0].tolist()
        text = f"the border of {what}, from x={number_text(x)}, z={number_text(z)}, crosses itself; redraw it"
        raise PickError(text, pick=name, where=(x, z))
    line.setflags(write=False)
    return line


def body_polygons(section: Section, bodies: Iterable[Body]) -> dict[str, Region]:
    """The area of each body inside a section, in metres of rock, by name.

    Raises
    ------
    PickError
        If a body lies outside the section, or is too small to be left out of a mesh.
    """
    x_min, x_max, z_min, z_max = section.extent
    box = shapely.box(*section.to_rock([(x_min, z_min), (x_max, z_max)]).ravel())
    cell = float(np.prod([section.dx, section.dz] * section.metres))
    found: dict[str, Region] = {}
    for body in bodies:
        inside = shapely.intersection(Polygon(section.to_rock(body.points)), box)
        if inside.area < LEAST_AREA * cell:
            x, z = body.points[0].tolist()
            raise PickError(
                f"body {body.name!r} covers less than {LEAST_AREA} samples of the section, which reaches from "
                f"{section.reach}; leave it out, or check its coordinates",
                pick=body.name,
                where=(x, z),
            )
        found[body.name] = inside
    return found


def without_bodies(outline: Region, bodies: Mapping[str, Region]) -> Region:
    """The rock of an outline beside some bodies; PickError if nothing is left."""
    left = shapely.difference(outline, shapely.union_all(list(bodies.values()))) if bodies else outline
    if left.is_empty:
        raise PickError("no rock is left beside the bodies; make them smaller", pick=next(iter(bodies)))
    return left
