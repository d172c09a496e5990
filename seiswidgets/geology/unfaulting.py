"""Sliding fault blocks back until horizons match across the faults (the paper's section 3.1)."""

import time
from collections import deque
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import partial

import numpy as np
from shapely import LineString

from seiswidgets.core.contact import Contact, contacts
from seiswidgets.core.curves import move_onto
from seiswidgets.core.holds import EdgeDirection
from seiswidgets.core.junctions import Continuation, continuations
from seiswidgets.core.mesh import Cut, Mesh, edge_keys
from seiswidgets.core.point_location import triangle_at
from seiswidgets.core.rigid import rigid_blocks
from seiswidgets.core.seams import weld_seams
from seiswidgets.core.term import Term
from seiswidgets.core.terms import AreaBarrier, ContourLaplacian, EdgeLength, MeanValue, Stitch
from seiswidgets.core.triangulation import edges_along
from seiswidgets.errors import Keyword, PickError, SettingError
from seiswidgets.geology.cutoffs import CutOffPair, PickNetwork
from seiswidgets.geology.domain import RestorationDomain
from seiswidgets.geology.fault_curves import meshed_parts
from seiswidgets.geology.fault_lines import NO_ENDS, fault_lines, settle_tips
from seiswidgets.geology.holds import Holds, PinnedMesh
from seiswidgets.geology.motion import RockParts
from seiswidgets.geology.observations import observe_slip
from seiswidgets.geology.picks import FAULT, HORIZON, TIP, Ends
from seiswidgets.geology.segments import horizon_segments
from seiswidgets.geology.shared_stretches import continue_along, follow
from seiswidgets.geology.solve import GAUSS_NEWTON, SolverOptions, minimise, reusable_setup, warm_start
from seiswidgets.geology.stage import Outcome, Stage
from seiswidgets.geology.weights import Weights


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
        The vertices of each pair of cut-offs, in the hanging wall and in the footwall.
    beds : dict of str to list of array, shape (k, 2)
        The edges of each segment of each horizon.
    boundaries : tuple of LineString
        Faults that stay as they are.
    fingerprint : tuple
        Everything that shaped the mesh.
    ends : dict of str to pair of str
        See `Fault.ends`.
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

    def slips(self) -> dict[str, np.ndarray]:
        """For each fault the points between its pairs of cut-offs, and the distance of each pair, in metres."""
        ends = self.mesh.vertices[self.stitches]
        rows = np.column_stack([ends.mean(axis=1), np.hypot(*(ends[:, 0] - ends[:, 1]).T)])
        return {name: rows[[pair.fault == name for pair in self.cutoffs]] for name in self.network.faults}


def unfault_stage(
    domain: RestorationDomain,
    faults: Mapping[str, np.ndarray],
    horizons: Mapping[str, Sequence[LineString]],
    holds: Holds,
    options: SolverOptions,
    boundaries: Mapping[str, np.ndarray],
    *,
    ends: Mapping[str, Ends] = NO_ENDS,
) -> Stage:
    """Undo the slip on some faults.

    Parameters
    ----------
    domain : RestorationDomain
    faults : dict of str to array, shape (n, 2)
    horizons : dict of str to list of LineString
    holds : Holds
    options : SolverOptions
    boundaries : dict of str to array, shape (n, 2)
        Faults that are not restored in this stage, and that beds do not cross.
    ends : dict of str to pair of str
        See `Fault.ends`.
    """
    began = time.perf_counter()
    blocks = mesh_blocks(domain, faults, horizons, boundaries, ends, options.start)
    mesh, free = blocks.mesh, free_vertices(blocks, holds.fixed, domain)
    pinned = PinnedMesh(mesh, holds, domain, upright=options.weights.rotation > 0)
    unheld = bool(free.all())
    if pinned.term is not None and options.solver != GAUSS_NEWTON:
        raise SettingError("pins and a regional level need ", Keyword("solver", GAUSS_NEWTON))
    terms = [*_terms(blocks, options.row_weights), *([pinned.term] if pinned.term else [])]
    start = warm_start(mesh, free, options.start)
    if start is None:  # the paper starts its own solver from the unmoved mesh
        start = _slide_blocks(mesh, blocks.stitches, free, terms) if options.solver == GAUSS_NEWTON else mesh.vertices
        start = pinned.begin(start) if unheld else start
    adrift = unheld and pinned.is_adrift
    loose = pinned.loose if unheld and not adrift else free
    solution = minimise(mesh, terms, start, loose, domain, options, adrift=adrift)
    vertices = pinned.settle(solution.vertices) if unheld else solution.vertices
    welded, vertices = weld_seams(mesh, vertices, [_still_side_last(sides, free) for sides in blocks.sides.values()])
    observe = partial(observe_slip, blocks, solution, domain)
    seconds = time.perf_counter() - began
    outcome = Outcome(tuple(blocks.lines), solution, options.solver, seconds, observe)
    return Stage("unfault", welded, vertices, tuple(blocks.lines.values()), domain, outcome, blocks, blocks.boundaries)


def mesh_blocks(
    domain: RestorationDomain,
    faults: Mapping[str, np.ndarray],
    horizons: Mapping[str, Sequence[LineString]],
    boundaries: Mapping[str, np.ndarray],
    ends: Mapping[str, Ends] = NO_ENDS,
    start: Stage | None = None,
) -> Blocks:
    """Match faults and horizons, and mesh them; an earlier stage's set-up is reused if it is identical.

    Raises
    ------
    PickError
        If a pick cannot be used as it was drawn.
    """
    others = [LineString(points) for points in boundaries.values()]
    drawn = {name: [LineString(points)] for name, points in faults.items()}
    fingerprint = domain.fingerprint(drawn, horizons, {"": others}), ends
    earlier = reusable_setup(start, Blocks, fingerprint)
    return earlier or _mesh_blocks(domain, faults, horizons, others, fingerprint, ends)


def _mesh_blocks(
    domain: RestorationDomain,
    faults: Mapping[str, np.ndarray],
    horizons: Mapping[str, Sequence[LineString]],
    boundaries: Sequence[LineString],
    fingerprint: tuple,
    ends: Mapping[str, Ends],
) -> Blocks:
    curves = fault_lines(faults, domain, ends, boundaries)
    boundaries = [follow(line, curves.values(), domain.sample) for line in boundaries]
    laid = {name: [domain.on_border(piece) for piece in pieces] for name, pieces in horizons.items()}
    network = _network(curves, laid, boundaries, domain)
    cutoffs = network.cutoffs()
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
    return Blocks(
        cut, cuts, sides, beyond, network, cutoffs, _stitches(cutoffs, beds), beds, tuple(boundaries), fingerprint, ends
    )


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
                    f"piece {segment.piece} of horizon {pair.horizon!r} is only {segment.line.length:.2g} m long at "
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
    return np.array(ends, dtype=int)


def free_vertices(blocks: Blocks, fixed: np.ndarray | None, domain: RestorationDomain) -> np.ndarray:
    """The vertices that may move: all, or all but those of the block that holds a point.

    Where a fault dies out inside that block, holding all of it would hold the fault too: then only the far field on the
    point's side of the fault stays.
    """
    mesh = blocks.mesh
    if fixed is None:
        return np.ones(len(mesh.vertices), bool)
    triangle = triangle_at(mesh.vertices, mesh.triangles, fixed)
    if triangle < 0:
        raise PickError(
            f"no rock lies at fixed, {domain.where(fixed)}; choose a point inside the block to hold",
            kind="held outside",
            where=domain.position(fixed),
        )
    block = mesh.blocks == mesh.blocks[mesh.triangles[triangle, 0]]
    if not any(block[sides[0]].any() and block[sides[1]].any() for sides in blocks.sides.values()):
        return np.asarray(~block)
    return ~_far_field(blocks, fixed, triangle, domain)


def _far_field(blocks: Blocks, fixed: np.ndarray, triangle: int, domain: RestorationDomain) -> np.ndarray:
    """The vertices at the end of the section on a point's side of the faults; those of its triangle if there are none.

    Returns
    -------
    array of bool, shape (n,)
    """
    mesh, parts = blocks.mesh, RockParts(domain.outline, blocks.lines)
    centres = mesh.vertices[mesh.triangles].mean(axis=1)
    limb = np.zeros(len(mesh.vertices), bool)
    limb[mesh.triangles[parts.locate(centres) == parts.locate(fixed[None])]] = True
    x, (x_min, _, x_max, _) = mesh.vertices[:, 0], domain.outline.bounds
    ends = [limb & (np.abs(x - end) < 0.5 * domain.spacing) for end in (x_min, x_max)]
    within = np.isin(np.arange(len(x)), mesh.triangles[triangle])
    return min([end for end in ends if end.sum() > 1] or [within], key=lambda end: abs(fixed[0] - x[end].mean()))


def _terms(blocks: Blocks, weights: Weights) -> list[Term]:
    mesh = blocks.mesh
    pairs = blocks.stitches[blocks.stitches[:, 0] != blocks.stitches[:, 1]]  # at a blind tip both are one
    return [
        MeanValue(mesh, weights.mean_value),
        ContourLaplacian(mesh, weights.contour),
        EdgeLength(mesh.vertices, mesh.edges, weights.edge),
        Stitch(pairs, len(mesh.vertices), weights.stitch * blocks.reach),
        *(
            term
            for (name, sides), beyond in zip(blocks.sides.items(), blocks.beyond, strict=True)
            for term in contacts(mesh, sides, blocks.lines[name], weights.slide, "contact", beyond)
        ),
        AreaBarrier(mesh),
        *([EdgeDirection(mesh.vertices, mesh.edges, weights.rotation)] if weights.rotation else []),
    ]


def _slide_blocks(mesh: Mesh, stitches: np.ndarray, free: np.ndarray, terms: Sequence[Term]) -> np.ndarray:
    """Move blocks rigidly so that their cut-offs meet and their sides touch, as a start for the solver.

    They are shifted one after the other, from the block that stays (or the largest), then moved and turned together.
    """
    label = mesh.blocks
    root = label[~free][0] if not free.all() else np.bincount(label, mesh.vertex_areas).argmax()
    shift = np.full((label.max() + 1, 2), np.nan)
    shift[root] = 0
    queue = deque([root])
    while queue:
        block = queue.popleft()
        for near, far in (stitches.T, stitches[:, ::-1].T):
            for other in np.unique(label[far[(label[near] == block)]]):
                if np.isnan(shift[other]).any():
                    pair = (label[near] == block) & (label[far] == other)
                    shift[other] = shift[block] + np.mean(mesh.vertices[near[pair]] - mesh.vertices[far[pair]], axis=0)
                    queue.append(other)
    between = [term for term in terms if isinstance(term, Contact | Stitch)]
    return rigid_blocks(label, between, mesh.vertices + np.nan_to_num(shift)[label], label != root)


def _still_side_last(sides: np.ndarray, free: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """The two sides of a seam, first the one whose vertices may be moved onto the other."""
    return (sides[1], sides[0]) if not free[sides[0]].all() else (sides[0], sides[1])
