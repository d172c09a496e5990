"""Blocks, points and levels that are held while blocks slide, and the rigid motion that they leave free."""

from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from seiswidgets.core.holds import Hold
from seiswidgets.core.interpolated import PointsInMesh
from seiswidgets.core.mesh import Mesh
from seiswidgets.core.point_location import triangle_at
from seiswidgets.core.rigid import nearest_rigid, rigid_motion
from seiswidgets.errors import PickError
from seiswidgets.geology.domain import RestorationDomain

STRONG = 1e3  # weight of a held point, so that it moves by less than a millimetre


def _none() -> np.ndarray:
    return np.empty((0, 2))


@dataclass(frozen=True, eq=False)
class Holds:
    """Points that hold a section, in metres of rock.

    Attributes
    ----------
    fixed : array, shape (2,), or None
        A point in the block that stays, or whose far field does.
    pins : array, shape (k, 2)
        Points that stay.
    level : array, shape (k, 2)
        Points that keep their depth.
    """

    fixed: np.ndarray | None = None
    pins: np.ndarray = field(default_factory=_none)
    level: np.ndarray = field(default_factory=_none)


@dataclass(frozen=True, eq=False)
class PinnedMesh:
    """A mesh, none of whose vertices is held, with pins and points of a level.

    Attributes
    ----------
    mesh : Mesh
    holds : Holds
    domain : RestorationDomain
    upright : bool
        True if a turn of the whole costs energy.
    """

    mesh: Mesh
    holds: Holds
    domain: RestorationDomain
    upright: bool

    @cached_property
    def term(self) -> Hold | None:
        """The term that holds the points; None if there are none."""
        points = np.concatenate([self.holds.pins, self.holds.level])
        if not len(points):
            return None
        corners = self.mesh.triangles[[self._triangle(point) for point in points]]
        within = PointsInMesh.in_triangles(self.mesh.vertices, corners, points)
        held = np.ones(points.shape, bool)
        held[len(self.holds.pins) :, 0] = False
        return Hold(within, points, held, len(self.mesh.vertices), STRONG)

    def _triangle(self, point: np.ndarray) -> int:
        triangle = triangle_at(self.mesh.vertices, self.mesh.triangles, point)
        if triangle < 0:
            raise PickError(
                f"no rock lies at the held point {self.domain.where(point)}; choose one inside the rock",
                where=self.domain.position(point),
            )
        return triangle

    @property
    def is_adrift(self) -> bool:
        """True if every rigid motion of the whole costs nothing."""
        return self.term is None and not self.upright

    @property
    def loose(self) -> np.ndarray:
        """Coordinates that may change, shape (n, 2): all but one for each rigid motion that the points leave free.

        A motion that costs nothing would make the solver slow.
        """
        free = np.ones(self.mesh.vertices.shape, bool)
        if self._may_turn:
            arms = np.abs(self.mesh.vertices - self.holds.pins[0])
            far = np.argmax(np.hypot(*arms.T))
            free[far, 1 if arms[far, 0] >= arms[far, 1] else 0] = False
        elif self._may_shift:
            free[np.argmin(np.hypot(*(self.mesh.vertices - self.mesh.vertices.mean(axis=0)).T)), self._shifts] = False
        return free

    @property
    def _may_turn(self) -> bool:
        """True if the section may turn about its only pin."""
        return len(self.holds.pins) == 1 and not len(self.holds.level) and not self.upright

    @property
    def _may_shift(self) -> bool:
        """True if the section may be shifted along ``_shifts``."""
        return not len(self.holds.pins) and (self.upright or len(self.holds.level) > 0)

    @property
    def _shifts(self) -> list[int]:
        """The coordinates that a shift changes: x alone where a level is held."""
        return [0] if len(self.holds.level) else [0, 1]

    def begin(self, vertices: np.ndarray) -> np.ndarray:
        """Move a start for the solver rigidly to where its held points lie nearest to their places."""
        if self.term is None:
            return vertices
        now = self.term.within.positions(vertices)
        goal = np.where(self.term.held, self.term.points, now)
        if len(now) == 1:
            return np.asarray(vertices + (goal - now)[0])
        return rigid_motion(now, goal, np.ones(len(now)))(vertices)

    def settle(self, vertices: np.ndarray) -> np.ndarray:
        """Choose the least of the rigid motions that the held points leave free."""
        mesh = self.mesh
        if self.is_adrift:
            return nearest_rigid(mesh.vertices, vertices, mesh.vertex_areas)
        if self._may_turn:
            return rigid_motion(vertices, mesh.vertices, mesh.vertex_areas, self.holds.pins[0])(vertices)
        if self._may_shift:
            drift = np.average(vertices - mesh.vertices, axis=0, weights=mesh.vertex_areas)
            vertices = vertices.copy()
            vertices[:, self._shifts] -= drift[self._shifts]
        return vertices
