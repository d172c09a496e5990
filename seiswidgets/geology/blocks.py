"""Meshing of a section that is cut into blocks: faults, horizons, and the vertices at which they meet."""

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np
import shapely
from shapely import LineString

from seiswidgets.core.curves import move_onto
from seiswidgets.core.interpolated import AtPoints, PointsInMesh
from seiswidgets.core.junctions import Continuation, continuations
from seiswidgets.core.mesh import Cut, Mesh, edge_keys
from seiswidgets.core.term import Term
from seiswidgets.core.terms import Stitch
from seiswidgets.core.triangulation import edges_along
from seiswidgets.errors import Keyword, PickError
from seiswidgets.geology.cutoffs import CutOffPair, PickNetwork
from seiswidgets.geology.domain import RestorationDomain
from seiswidgets.geology.fault_curves import meshed_parts
from seiswidgets.geology.fault_lines import NO_ENDS, fault_lines, settle_tips
from seiswidgets.geology.picks import FAULT, HORIZON, TIP, Ends
from seiswidgets.geology.prescribed_slip import FaultSides
from seiswidgets.geology.segments import hanging_side, horizon_segments, segments_beside
from seiswidgets.geology.shared_stretches import continue_along, follow
from seiswidgets.geology.slip_profile import SlipProfile
from seiswidgets.geology.solve import reusable_setup
from seiswidgets.geology.stage import Stage

NO_PROFILES: Mapping[str, SlipProfile] = {}


@dataclass(frozen=True, eq=False)
class Blocks:
    """A section cut into blocks, and the picks in its mesh.

    Attributes
    ----------
    cut : Cut
    lines : dict of str to LineString
        The lines along which it is cut: the faults, drawn on along boundaries that they share.
    sides : dict of str to array, shape (2, s, 2)
        Both copies of each fault's edges.
    beyond : list of (Continuation, Continuation)
        For each fault, the sides of others that continue its own.
    network : PickNetwork
    cutoffs : list of CutOffPair
    stitches : array, shape (c, 2)
        The vertices of each pair of cut-offs, in the hanging wall and in the footwall; with ``points``, their indices.
    beds : dict of str to list of array, shape (k, 2)
        The edges of each segment of each horizon.
    boundaries : tuple of LineString
        Faults that stay as they are.
    fingerprint : tuple
        Everything that shaped the mesh.
    ends : dict of str to pair of str
        See `Fault.ends`.
    drawn : dict of str to array, shape (n, 2)
        The points of each fault before it was extended.
    profiles : dict of str to SlipProfile
        Prescribed slip, by fault.
    points : PointsInMesh, optional
        Cut-offs between vertices: those of horizons that have moved since the mesh was made, for a preview.
    """

    cut: Cut
    lines: dict[str, LineString]
    sides: dict[str, np.ndarray]
    beyond: list[tuple[Continuation, Continuation]]
    network: PickNetwork
    cutoffs: list[CutOffPair]
    stitches: np.ndarray
    beds: dict[str, list[np.ndarray]]
    boundaries: tuple[LineString, ...]
    fingerprint: tuple
    ends: Mapping[str, Ends]
    drawn: Mapping[str, np.ndarray]
    profiles: Mapping[str, SlipProfile] = field(default_factory=dict)
    points: PointsInMesh | None = None

    @property
    def mesh(self) -> Mesh:
        """The mesh, cut."""
        return self.cut.mesh

    @property
    def reach(self) -> float:
        """Factor of the weight of a stitch: the root of the average number of edges along a fault.

        A stitch is one vertex, but has to move the whole side of a fault. With this factor it counts for as many as
        the contact has there, and cut-offs meet as well on a fine mesh as on a coarse one.
        """
        return float(np.sqrt(np.mean([sides.shape[1] for sides in self.sides.values()])))

    def cutoff_positions(self, vertices: np.ndarray) -> np.ndarray:
        """Both cut-offs of each pair after a deformation, hanging wall first; shape (c, 2, 2)."""
        positions = vertices if self.points is None else self.points.positions(vertices)
        return np.asarray(positions[self.stitches])

    @property
    def stitched_vertices(self) -> np.ndarray:
        """The vertices at the ends of each stitch, or next to them, hanging wall first; shape (c, 2)."""
        return self.stitched if self.points is None else self.points.corners[self.stitched, 0]

    def stitch(self, weight: float) -> Term:
        """The term that brings pairs of cut-offs together."""
        if self.points is None:
            return Stitch(self.stitched, len(self.mesh.vertices), weight * self.reach)
        return AtPoints(Stitch(self.stitched, self.stitches.size, weight * self.reach), self.points)

    def slips(self) -> dict[str, np.ndarray]:
        """For each fault the points between its pairs of cut-offs, and the distance of each pair, in metres."""
        ends = self.cutoff_positions(self.mesh.vertices)
        rows = np.column_stack([ends.mean(axis=1), np.hypot(*(ends[:, 0] - ends[:, 1]).T)])
        slips = {name: rows[[pair.fault == name for pair in self.cutoffs]] for name in self.network.faults}
        return slips | {name: sides.rows for name, sides in self.prescribed.items()}

    @cached_property
    def prescribed(self) -> dict[str, FaultSides]:
        """The sides of the faults whose slip is prescribed."""
        return {
            name: FaultSides.of(name, profile, self.mesh, self.sides[name], self.lines[name], self.drawn[name])
            for name, profile in self.profiles.items()
        }

    @cached_property
    def stitched(self) -> np.ndarray:
        """The pairs of cut-offs to be brought together: none at a blind tip, or where the slip is prescribed."""
        free = np.array([pair.fault not in self.profiles for pair in self.cutoffs], bool)
        return self.stitches[free & (self.stitches[:, 0] != self.stitches[:, 1])]


def mesh_blocks(
    domain: RestorationDomain,
    faults: Mapping[str, np.ndarray],
    horizons: Mapping[str, Sequence[LineString]],
    boundaries: Mapping[str, np.ndarray],
    ends: Mapping[str, Ends] = NO_ENDS,
    start: Stage | None = None,
    profiles: Mapping[str, SlipProfile] = NO_PROFILES,
) -> Blocks:
    """Match faults and horizons, and mesh them; an earlier stage's set-up is reused if it is identical.

    A fault with a slip profile needs no horizon.

    Raises
    ------
    PickError
        If a pick cannot be used as it was drawn.
    """
    others = [LineString(points) for points in boundaries.values()]
    drawn = {name: [LineString(points)] for name, points in faults.items()}
    profiles = {name: profile for name, profile in profiles.items() if name in faults}
    cuts = domain.fingerprint(drawn, {"": others}), ends, tuple(profiles)
    fingerprint = cuts, {name: [piece.wkb for piece in pieces] for name, pieces in horizons.items()}
    blocks = reusable_setup(start, Blocks, fingerprint)
    earlier = start.mesh_setup if domain.quick and start and isinstance(start.mesh_setup, Blocks) else None
    if not blocks and earlier and earlier.fingerprint[0] == cuts:
        blocks = _keep_mesh(earlier, horizons, fingerprint, domain, tuple(profiles))
    blocks = blocks or _mesh_blocks(domain, faults, horizons, others, fingerprint, ends, tuple(profiles))
    return replace(blocks, profiles=profiles) if profiles else blocks


def _keep_mesh(
    earlier: Blocks,
    horizons: Mapping[str, Sequence[LineString]],
    fingerprint: tuple,
    domain: RestorationDomain,
    prescribed: Collection[str],
) -> Blocks | None:
    """The same mesh for horizons that have moved: their cut-offs are points on the edges of their faults.

    None if there are no cut-offs.
    """
    known, now = earlier.fingerprint[1], fingerprint[1]
    faults, segments = earlier.network.faults, earlier.network.horizons
    moved = {name: pieces for name, pieces in horizons.items() if known.get(name) != now[name]}
    moved_segments = _match(faults, moved, earlier.boundaries, domain).horizons
    network = replace(earlier.network, horizons={name: moved_segments.get(name) or segments[name] for name in horizons})
    cutoffs, rest = network.cutoffs(prescribed), earlier.mesh.vertices
    if not cutoffs:
        return None
    ends = [(pair, side, end) for pair in cutoffs for side, end in ((1, pair.hanging_wall), (-1, pair.footwall))]
    on_sides = [
        PointsInMesh.on_edges(
            rest, _edges_of_wall(earlier, pair.fault, side), np.array([network.point(pair.horizon, end)])
        )
        for pair, side, end in ends
    ]
    points = PointsInMesh(*(np.concatenate([getattr(one, name) for one in on_sides]) for name in ("corners", "shares")))
    stitches = np.arange(2 * len(cutoffs)).reshape(-1, 2)
    return replace(
        earlier, network=network, cutoffs=cutoffs, stitches=stitches, points=points, beds={}, fingerprint=fingerprint
    )


def _edges_of_wall(blocks: Blocks, fault: str, side: int) -> np.ndarray:
    """The edges along a fault in its hanging wall (1) or footwall (-1), shape (s, 2)."""
    right, left = blocks.sides[fault]
    start, stop = blocks.mesh.vertices[right[len(right) // 2]]
    middle, beside = (start + stop) / 2, (stop - start)[::-1] * [-1, 1]
    return right if hanging_side(blocks.network.faults[fault], middle, middle + beside) == side else left


def _mesh_blocks(
    domain: RestorationDomain,
    faults: Mapping[str, np.ndarray],
    horizons: Mapping[str, Sequence[LineString]],
    boundaries: Sequence[LineString],
    fingerprint: tuple,
    ends: Mapping[str, Ends],
    prescribed: Collection[str],
) -> Blocks:
    curves = fault_lines(faults, domain, ends, boundaries)
    boundaries = [follow(line, curves.values(), domain.sample) for line in boundaries]
    laid = {name: [domain.on_border(piece) for piece in pieces] for name, pieces in horizons.items()}
    network = _network(curves, laid, boundaries, domain)
    cutoffs = network.cutoffs(prescribed)
    cuts = {name: _drawn_on(name, network.faults, boundaries, ends) for name in network.faults}
    lines = {name: meshed_parts(name, cuts, network.ends_at(name), domain) for name in cuts}
    bed_lines = {
        name: [domain.simplify(segment.line) for segment in segments] for name, segments in network.horizons.items()
    }
    meshed = {(FAULT, name): parts for name, parts in lines.items()}
    whole = domain.mesh(meshed | {(HORIZON, name): bed for name, bed in bed_lines.items()})
    edges = {name: _inner_edges(whole, parts, name, domain) for name, parts in lines.items()}
    for name, along in edges.items():
        whole = move_onto(whole, along, cuts[name])
    cut_edges = np.concatenate(list(edges.values()))
    cut = whole.cut(cut_edges)
    beds = {
        name: [cut.along(edges_along(whole, line, domain.spacing, without=cut_edges)) for line in bed]
        for name, bed in bed_lines.items()
    }
    sides = {name: cut.sides(along) for name, along in edges.items()}
    _check_meshed(cutoffs, beds, network)
    beyond = continuations(whole.vertices, list(edges.values()), list(sides.values()))
    stitches = _stitches(cutoffs, beds)
    fixed = tuple(boundaries)
    return Blocks(cut, cuts, sides, beyond, network, cutoffs, stitches, beds, fixed, fingerprint, ends, faults)


def _network(
    curves: dict[str, LineString],
    horizons: Mapping[str, Sequence[LineString]],
    boundaries: Sequence[LineString],
    domain: RestorationDomain,
) -> PickNetwork:
    """Match faults and horizons, and the ends of faults that nearly coincide with them."""
    network = _match(curves, horizons, boundaries, domain)
    beds = [piece for pieces in horizons.values() for piece in pieces]
    settled = settle_tips(curves, beds, {name: network.ends_at(name) for name in curves}, domain)
    return network if settled == curves else _match(settled, horizons, boundaries, domain)


def _match(
    curves: dict[str, LineString],
    horizons: Mapping[str, Sequence[LineString]],
    boundaries: Sequence[LineString],
    domain: RestorationDomain,
) -> PickNetwork:
    walls = [*curves.values(), *boundaries]
    segments = {name: horizon_segments(pieces, walls, domain.cell) for name, pieces in horizons.items()}
    if domain.bodies:
        bodies = shapely.union_all(list(domain.bodies.values()))
        segments = {name: segments_beside(parts, bodies) for name, parts in segments.items()}
    return PickNetwork(curves, segments, domain.where, domain.position, domain.length)


def _inner_edges(mesh: Mesh, parts: Sequence[LineString], name: str, domain: RestorationDomain) -> np.ndarray:
    along = np.concatenate([edges_along(mesh, part, domain.spacing) for part in parts])
    inner = ~np.isin(edge_keys(along), edge_keys(mesh.boundary))
    if not inner.any():
        point = parts[0].coords[0]
        raise PickError(
            f"fault {name!r} runs along the border of the section near {domain.where(point)}, where there is nothing "
            "to slide; draw it inside",
            pick=name,
            where=domain.position(point),
        )
    return along[inner]


def _drawn_on(
    name: str, faults: Mapping[str, LineString], boundaries: Sequence[LineString], ends: Mapping[str, Ends]
) -> LineString:
    """A fault with the boundaries that it continues along, unless its ends are tips."""
    if TIP in ends.get(name, ()):
        return faults[name]
    return continue_along(faults[name], boundaries, [line for other, line in faults.items() if other != name])


def _check_meshed(cutoffs: Sequence[CutOffPair], beds: Mapping[str, list[np.ndarray]], network: PickNetwork) -> None:
    for pair in cutoffs:
        for index, which in (pair.hanging_wall, pair.footwall):
            segment = network.horizons[pair.horizon][index]
            if not len(beds[pair.horizon][index]):
                point = segment.end_point(which)
                raise PickError(
                    f"piece {segment.piece} of horizon {pair.horizon!r} is too short to be meshed at "
                    f"fault {pair.fault!r}, near {network.where(point)}; draw more of it, or reduce ",
                    Keyword("spacing"),
                    pick=pair.horizon,
                    where=network.position(point),
                )


def _stitches(cutoffs: Sequence[CutOffPair], beds: Mapping[str, list[np.ndarray]]) -> np.ndarray:
    """The vertices of each pair of cut-offs, hanging wall first; shape (c, 2)."""
    ends = [
        [beds[pair.horizon][index][which, which] for index, which in (pair.hanging_wall, pair.footwall)]
        for pair in cutoffs
    ]
    return np.array(ends, dtype=int).reshape(-1, 2)
