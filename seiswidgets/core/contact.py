"""Contact of the two sides of a fault, the energy's term that lets one slide along the other."""

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
import shapely

from seiswidgets.core.terms import MOVING, coordinates, sparse_rows

STAY = 0.1  # of a segment's length
CORNER = np.radians(10)  # a drawn line that turns by more has a corner there; by less, it samples a smooth curve


@dataclass(frozen=True, eq=False)
class Bulge:
    """How far the smooth curve through a drawn line's points lies beside the line, as a function of the way along it.

    Over each drawn segment the curve is a parabola with the curvature that the turns at the segment's ends suggest.
    Without it two sides of a round fault, which are polygons, would catch in each other like cogs.

    Parameters
    ----------
    line : shapely LineString
        As it was drawn.
    """

    line: object

    @cached_property
    def _segments(self):
        """The way to each drawn point, and the curvature of each drawn segment."""
        arms = np.diff(shapely.get_coordinates(self.line), axis=0)
        lengths = np.hypot(*arms.T)
        turns = np.diff(np.unwrap(np.arctan2(arms[:, 1], arms[:, 0])))
        bend = np.where(np.abs(turns) > CORNER, np.nan, 2 * turns / (lengths[:-1] + lengths[1:]))
        ends = np.stack([np.append(np.nan, bend), np.append(bend, np.nan)])
        known = np.isfinite(ends)
        curvature = np.where(known, ends, 0).sum(axis=0) / np.maximum(known.sum(axis=0), 1)
        return np.append(0, np.cumsum(lengths)), curvature

    def parabola(self, start, stop) -> np.ndarray:
        """Coefficients of 1, s, s^2 for s from 0 to 1 between two ways along the line in one drawn segment; (k, 3)."""
        ways, curvature = self._segments
        segment = np.clip(np.searchsorted(ways, (start + stop) / 2) - 1, 0, len(curvature) - 1)
        first, last, half_curvature = ways[segment], ways[segment + 1], curvature[segment] / 2
        span = stop - start
        return np.column_stack(
            [
                -half_curvature * (start - first) * (last - start),
                -half_curvature * span * (first + last - 2 * start),
                half_curvature * span**2,
            ]
        )


@dataclass(frozen=True, eq=False)
class Contact:
    """Keeps each vertex of one side of a fault on the other side (eq. 17).

    The residual is the signed distance from the nearest segment of the other side's polyline, with what the smooth
    fault bulges beside its polyline at either place; so sliding along the fault costs nothing. Both sides may move.
    Beyond an end of the polyline nothing is known of the fault, and the term is silent.

    Parameters
    ----------
    points : array, shape (p,)
        The vertices of the one side.
    segments : array, shape (s, 2)
        The other side, as directed pairs of vertices.
    lift : array, shape (p,)
        Bulge of the smooth fault at each point.
    bulge : array, shape (s, 3)
        The same along each segment, as coefficients of 1, s and s^2.
    count : int
        How many vertices the mesh has.
    partner, former, stay : arrays, shape (p,)
        The segment that each point is held to, -1 for none, the one before, and how far beyond its segment's end a
        point is still held to it, in lengths of it; chosen by ``at``.
    """

    points: np.ndarray
    segments: np.ndarray
    lift: np.ndarray
    bulge: np.ndarray
    count: int
    weight: float = 1.0
    name: str = "contact"
    partner: np.ndarray | None = None
    former: np.ndarray | None = None
    stay: np.ndarray | None = None
    pattern = MOVING

    @cached_property
    def _open(self):
        """Whether the polyline ends at each segment's first and second vertex, shape (s, 2)."""
        vertices, counts = np.unique(self.segments, return_counts=True)
        return counts[np.searchsorted(vertices, self.segments)] == 1

    def at(self, vertices) -> "Contact":
        """The term with each point held to the segment that is nearest to it now.

        A partner is kept while the point's foot is on it or a little beyond, and the farther beyond the more often the
        point has come back to a partner it had just left: else two segments of a bent fault could take turns for ever.
        """
        along, _, _, _ = self._feet(vertices, self.points[:, None], self.segments[None])
        clipped = np.clip(along, 0, 1)
        start, stop = vertices[self.segments[:, 0]], vertices[self.segments[:, 1]]
        away = vertices[self.points][:, None] - start - clipped[..., None] * (stop - start)
        nearest = np.argmin(np.sum(away**2, axis=2), axis=1)
        row = np.arange(len(self.points))
        if self.partner is None:
            return self._held_to(self._unless_beyond(nearest, along, STAY))
        kept = (self.partner >= 0) & (np.abs(along - clipped)[row, self.partner] < self.stay)
        return self._held_to(self._unless_beyond(np.where(kept, self.partner, nearest), along, self.stay))

    def _unless_beyond(self, nearest, along, stay):
        """Partners, -1 for points that lie beyond an end of the polyline."""
        along, ends = along[np.arange(len(nearest)), nearest], self._open[nearest]
        reach = stay - STAY + 1e-9
        return np.where((ends[:, 0] & (along < -reach)) | (ends[:, 1] & (along > 1 + reach)), -1, nearest)

    def _held_to(self, partner):
        if self.partner is None:
            return replace(self, partner=partner, former=partner, stay=np.full(len(partner), STAY))
        left = partner != self.partner
        stay = np.where(left & (partner == self.former), 2 * self.stay, self.stay)
        return replace(self, partner=partner, former=np.where(left, self.partner, self.former), stay=stay)

    def _feet(self, vertices, points, segments):
        """Foot of each point on its segment's line (0 and 1 are its ends), signed distance, normal, and segment."""
        start, stop = vertices[segments[..., 0]], vertices[segments[..., 1]]
        along, arm = stop - start, vertices[points] - start
        length = np.maximum(np.hypot(along[..., 0], along[..., 1]), np.finfo(float).tiny)
        normal = along[..., ::-1] * [-1, 1] / length[..., None]
        foot = np.sum(along / length[..., None] * arm, axis=-1) / length
        return foot, np.sum(normal * arm, axis=-1), normal, along

    def _pairs(self):
        held = self.partner >= 0
        return self.points[held], self.segments[self.partner[held]]

    def _distance(self, along, distance):
        return (
            distance
            + self.lift[self.partner >= 0]
            - np.sum(np.vander(along, 3, increasing=True) * self._held_bulge, axis=1)
        )

    @property
    def _held_bulge(self):
        return self.bulge[self.partner[self.partner >= 0]]

    @property
    def held_points(self) -> np.ndarray:
        """The vertices that are held to a segment now, in the order of ``distances``."""
        return self.points[self.partner >= 0]

    def distances(self, vertices) -> np.ndarray:
        """Signed distance of each held point from the smooth fault of the other side, in metres."""
        along, distance, _, _ = self._feet(vertices, *self._pairs())
        return self._distance(along, distance)

    def lengths(self, rest) -> np.ndarray:
        """Length of fault that each held point stands for, in metres; ``rest`` are all vertices at rest."""
        places = rest[self.segments].mean(axis=1)
        half = np.hypot(*(rest[self.segments[:, 1]] - rest[self.segments[:, 0]]).T) / 2
        near = np.argsort(np.linalg.norm(rest[self.points][:, None] - places[None], axis=2), axis=1)[:, :2]
        return half[near].sum(axis=1)[self.partner >= 0]

    def residual(self, vertices):
        return self.weight * self.distances(vertices)

    def jacobian(self, vertices):
        points, segments = self._pairs()
        foot, distance, normal, along = self._feet(vertices, points, segments)
        squared = np.maximum(np.sum(along**2, axis=1), np.finfo(float).tiny)
        slope = (self._held_bulge[:, 1] + 2 * self._held_bulge[:, 2] * foot) / squared
        foot, distance, slope = foot[:, None], distance[:, None], slope[:, None]
        by_point = normal - slope * along
        by_stop = -foot * normal - slope * (distance * normal - foot * along)
        data = self.weight * np.hstack([by_point, -by_point - by_stop, by_stop])
        return sparse_rows(coordinates(np.column_stack([points, segments])), data, vertices.size)

    @cached_property
    def rows(self):
        return sparse_rows(self.points[:, None], np.full((len(self.points), 1), self.weight), self.count)

    def target(self, vertices):
        """Each point's projection on its partner; where it is now, if it has none."""
        along, distance, normal, _ = self._feet(vertices, *self._pairs())
        target = vertices[self.points].copy()
        target[self.partner >= 0] -= self._distance(along, distance)[:, None] * normal
        return self.weight * target


def contacts(mesh, sides, line, weight, name) -> tuple[Contact, Contact]:
    """The contact of either side of a fault with the other: what one side's corners get wrong, the other's get right.

    Parameters
    ----------
    mesh : Mesh
        Cut along the fault.
    sides : array, shape (2, s, 2)
        Both copies of the fault's edges, in order.
    line : shapely LineString
        The fault as it was drawn.
    """
    ways = shapely.line_locate_point(line, shapely.points(mesh.vertices[sides]))
    curve = Bulge(line)
    bulge = curve.parabola(*ways[0].T)
    terms = []
    for side, other in (sides, sides[::-1]):
        points, first = np.unique(side, return_index=True)
        apart = ~np.isin(points, other)  # a tip belongs to both sides
        way = ways[0].ravel()[first[apart]]
        lift = curve.parabola(way, way)[:, 0]
        terms.append(Contact(points[apart], other, lift, bulge, len(mesh.vertices), weight, name))
    return tuple(terms)
