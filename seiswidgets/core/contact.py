"""Contact of the two sides of a fault: the term of the energy that lets one slide along the other."""

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np
import shapely
from scipy.sparse import csr_array
from shapely import LineString

from seiswidgets.core.junctions import NOTHING, Continuation
from seiswidgets.core.mesh import Mesh
from seiswidgets.core.term import MOVING, Layer, PaperTerm
from seiswidgets.core.terms import coordinates, sparse_rows

RETURNED, HALF = 0.1, 0.5  # of a segment's length
BEYOND = 1e-6  # weight of the distance beyond a segment's end: of two at the same corner the less overshot is nearer


def _unchosen() -> np.ndarray:
    return np.empty(0, int)


@dataclass(frozen=True, eq=False)
class Contact(PaperTerm):
    """Term that keeps each vertex of one side of a fault on the other side (eq. 17).

    The vertices at rest lie on the smooth curve of the fault. The residual is the signed distance from the nearest
    segment of the other side's polyline, corrected for the bulge of the curve over it; so sliding along the fault costs
    nothing. Both sides may move. Beyond an end of
    the polyline the fault is unknown, and the residual is zero.

    Parameters
    ----------
    points : array, shape (p,)
        The vertices of one side.
    segments : array, shape (s, 2)
        The other side, as directed pairs of vertices, then segments of other faults that continue it.
    bulge : array, shape (s, 3)
        Distance of the smooth fault from each segment at rest, as coefficients of 1, s and s^2.
    count : int
        Number of vertices of the mesh.
    own : int
        Number of segments of the other side.
    continued : array
        The vertices at which other segments continue it.
    partner, former, stay : arrays, shape (p,)
        The segment that each point is held to (-1 for none), the previous one, and the distance beyond its end, in
        segment lengths, up to which a point is still held to it; empty until chosen by ``with_contacts``.
    """

    points: np.ndarray
    segments: np.ndarray
    bulge: np.ndarray
    count: int
    own: int
    continued: np.ndarray
    weight: float = 1.0
    name: str = "contact"
    partner: np.ndarray = field(default_factory=_unchosen)
    former: np.ndarray = field(default_factory=_unchosen)
    stay: np.ndarray = field(default_factory=_unchosen)
    pattern = MOVING

    @cached_property
    def _open(self) -> np.ndarray:
        """True where the polyline ends at a segment's first or second vertex, shape (s, 2)."""
        vertices, counts = np.unique(self.segments, return_counts=True)
        return np.asarray(counts[np.searchsorted(vertices, self.segments)] == 1)

    @property
    def _chosen(self) -> bool:
        return len(self.stay) == len(self.points)

    def with_contacts(self, vertices: np.ndarray) -> "Contact":
        """Hold each point to the segment that is nearest to it now.

        Where two segments meet, their distances are equal on the bisector, so that the energy is continuous if a point
        changes its partner there. A partner to which a point has returned is kept while the point's foot is on it or a
        little beyond, by a margin that doubles with each return: otherwise two segments could alternate for ever.
        Points beyond an end of their own fault are held to the nearest segment of those that continue it, if any.
        """
        along, _, _, _ = self._feet(vertices, self.points[:, None], self.segments[None])
        clipped = np.clip(along, 0, 1)
        start, stop = vertices[self.segments[:, 0]], vertices[self.segments[:, 1]]
        away = vertices[self.points][:, None] - start - clipped[..., None] * (stop - start)
        past = np.abs(along - clipped)
        squared = np.sum(away**2, axis=2) + BEYOND * past**2 * np.sum((stop - start) ** 2, axis=1)
        partner, end = self._choose(slice(0, self.own), along, past, squared)
        if len(self.continued):
            continuing, _ = self._choose(slice(self.own, None), along, past, squared)
            partner = np.where(np.isin(end, self.continued), continuing, partner)
        return self._hold(partner)

    def _choose(
        self, among: slice, along: np.ndarray, past: np.ndarray, squared: np.ndarray
    ) -> tuple[np.ndarray, np.ndarray]:
        """Index of the segment, of some, that each point is held to, or -1 and the end of theirs that it is beyond."""
        nearest = np.argmin(squared[:, among], axis=1) + among.start
        stay: float | np.ndarray = 0.0
        if self._chosen:
            stay = self.stay
            eligible = (self.partner >= among.start) & (self.partner < (among.stop or len(self.segments)))
            kept = eligible & (past[np.arange(len(nearest)), self.partner] < stay)
            nearest = np.where(kept, self.partner, nearest)
        foot, ends = along[np.arange(len(nearest)), nearest], self._open[nearest]
        stay = np.broadcast_to(stay, foot.shape)
        # where another fault goes on, rock would sink into it: no margin, or one inwards for a point that is held there
        inwards = np.where(self.partner >= self.own, -np.minimum(stay, HALF), 0) if self._chosen else 0 * stay
        continued = np.isin(self.segments[nearest], self.continued)
        reach = np.where(continued, inwards[:, None], stay[:, None]) + 1e-9
        first, last = ends[:, 0] & (foot < -reach[:, 0]), ends[:, 1] & (foot > 1 + reach[:, 1])
        end = np.where(first, self.segments[nearest, 0], np.where(last, self.segments[nearest, 1], -1))
        return np.where(end < 0, nearest, -1), end

    def _hold(self, partner: np.ndarray) -> "Contact":
        if not self._chosen:
            return replace(self, partner=partner, former=partner, stay=np.zeros(len(partner)))
        left = partner != self.partner
        stay = np.where(left & (partner == self.former), np.maximum(2 * self.stay, RETURNED), self.stay)
        return replace(self, partner=partner, former=np.where(left, self.partner, self.former), stay=stay)

    def _feet(
        self, vertices: np.ndarray, points: np.ndarray, segments: np.ndarray
    ) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
        """Foot of each point on its segment's line (0 and 1 are its ends), signed distance, normal, and segment."""
        start, stop = vertices[segments[..., 0]], vertices[segments[..., 1]]
        along, arm = stop - start, vertices[points] - start
        length = np.maximum(np.hypot(along[..., 0], along[..., 1]), np.finfo(float).tiny)
        normal = along[..., ::-1] * [-1, 1] / length[..., None]
        foot = np.sum(along / length[..., None] * arm, axis=-1) / length
        return foot, np.sum(normal * arm, axis=-1), normal, along

    def _pairs(self) -> tuple[np.ndarray, np.ndarray]:
        held = self.partner >= 0
        return self.points[held], self.segments[self.partner[held]]

    def _distance(self, along: np.ndarray, distance: np.ndarray) -> np.ndarray:
        bulge = np.sum(np.vander(along, 3, increasing=True) * self._held_bulge, axis=1)
        return np.asarray(distance - bulge)

    @property
    def _held_bulge(self) -> np.ndarray:
        return self.bulge[self.partner[self.partner >= 0]]

    @property
    def held_points(self) -> np.ndarray:
        """The vertices that are held to a segment, in the order of ``distances``."""
        return self.points[self.partner >= 0]

    def distances(self, vertices: np.ndarray) -> np.ndarray:
        """Signed distance of each held point from the smooth fault of the other side, in metres."""
        along, distance, _, _ = self._feet(vertices, *self._pairs())
        return self._distance(along, distance)

    def lengths(self, rest: np.ndarray) -> np.ndarray:
        """Length of fault that each held point represents, in metres; ``rest`` are all vertices at rest."""
        middles = rest[self.segments].mean(axis=1)
        half = np.hypot(*(rest[self.segments[:, 1]] - rest[self.segments[:, 0]]).T) / 2
        near = np.argsort(np.linalg.norm(rest[self.points][:, None] - middles[None], axis=2), axis=1)[:, :2]
        return np.asarray(half[near].sum(axis=1)[self.partner >= 0])

    def residual(self, vertices: np.ndarray) -> np.ndarray:
        return self.weight * self.distances(vertices)

    def jacobian(self, vertices: np.ndarray) -> csr_array:
        points, segments = self._pairs()
        foot, distance, normal, along = self._feet(vertices, points, segments)
        squared = np.maximum(np.sum(along**2, axis=1), np.finfo(float).tiny)
        slope = (self._held_bulge[:, 1] + 2 * self._held_bulge[:, 2] * foot) / squared
        foot, distance, slope = foot[:, None], distance[:, None], slope[:, None]
        by_point = normal - slope * along
        by_stop = -foot * normal - slope * (distance * normal - foot * along)
        data = self.weight * np.hstack([by_point, -by_point - by_stop, by_stop])
        return sparse_rows(coordinates(np.column_stack([points, segments])), data, vertices.size)

    def curvature(self, vertices: np.ndarray) -> Sequence[Layer]:
        """Second derivatives, as in `Term`.

        With the segment u and the point's arm w as complex numbers, w/u = t + i d/L holds the foot t and the distance d
        over the length L. To first order it changes by -b and to second order by a b, where a = du/u and
        b = a w/u - dw/u.
        """
        points, segments = self._pairs()
        foot, distance, normal, along = self._feet(vertices, points, segments)
        length = np.hypot(*along.T)[:, None]
        tangent, normal, none = along / length**2, normal / length, np.zeros_like(along)
        stretch, turn = np.hstack([none, -tangent, tangent]), np.hstack([none, -normal, normal])
        foot, offset = foot[:, None], distance[:, None] / length
        back = foot * stretch - offset * turn - np.hstack([tangent, -tangent, none])
        aside = foot * turn + offset * stretch - np.hstack([normal, -normal, none])
        linear, square = self._held_bulge[:, 1:2], self._held_bulge[:, 2:]
        slope = linear + 2 * square * foot
        products = [
            (length * back, turn - (slope * stretch + square * back) / length),
            (turn * length, offset / 2 * turn + slope / length * aside),
        ]
        factor = 0.5 * self.weight * self.residual(vertices)
        return [((one + sign * other).ravel(), sign * factor) for one, other in products for sign in (1, -1)]

    @cached_property
    def rows(self) -> csr_array:
        return sparse_rows(self.points[:, None], np.full((len(self.points), 1), self.weight), self.count)

    def target(self, vertices: np.ndarray) -> np.ndarray:
        """Projection of each point on its partner; its present position if it has none."""
        along, distance, normal, _ = self._feet(vertices, *self._pairs())
        target = vertices[self.points].copy()
        target[self.partner >= 0] -= self._distance(along, distance)[:, None] * normal
        return np.asarray(self.weight * target)


def contacts(
    mesh: Mesh,
    sides: np.ndarray,
    line: LineString,
    weight: float,
    name: str,
    beyond: Sequence[Continuation] = (NOTHING, NOTHING),
) -> tuple[Contact, Contact]:
    """Contact of each side of a fault with the other: errors at the corners of one side cancel those of the other.

    Parameters
    ----------
    mesh : Mesh
        Cut along the fault.
    sides : array, shape (2, s, 2)
        Both copies of the fault's edges, in order.
    line : shapely LineString
        The smooth curve of the fault.
    beyond : pair of Continuation
        For points of the first and of the second side.
    """
    bulge = bulges_of(mesh.vertices[sides[0]], line)

    def contact(side: np.ndarray, other: np.ndarray, beyond: Continuation) -> Contact:
        points = np.setdiff1d(side, other)  # a tip belongs to both sides
        segments, bulges = np.vstack([other, beyond.segments]), np.vstack([bulge, np.zeros((len(beyond.segments), 3))])
        corners = np.array(beyond.corners, int)
        return Contact(points, segments, bulges, len(mesh.vertices), len(other), corners, weight, name)

    return contact(sides[0], sides[1], beyond[0]), contact(sides[1], sides[0], beyond[1])


def bulges_of(ends: np.ndarray, line: LineString) -> np.ndarray:
    """Parabolas over chords of a curve, through its point halfway between their ends; (s, 2, 2) to shape (s, 3)."""
    arc_lengths = shapely.line_locate_point(line, shapely.points(ends)).mean(axis=1)
    arms, middles = ends[:, 1] - ends[:, 0], ends.mean(axis=1)
    away = shapely.get_coordinates(shapely.line_interpolate_point(line, arc_lengths)) - middles
    height = np.sum(away * arms[:, ::-1] * [-1, 1], axis=1) / np.hypot(*arms.T)
    return np.outer(height, [0, 4, -4])
