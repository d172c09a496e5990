"""Sliding fault blocks back until horizons match across the faults (the paper's section 3.1)."""

import time
from collections import deque
from dataclasses import dataclass
from functools import partial

import numpy as np
from shapely import LineString

from seiswidgets.core.contact import Contact, contacts
from seiswidgets.core.mesh import Cut, Mesh, edge_keys
from seiswidgets.core.point_location import triangle_at
from seiswidgets.core.rigid import rigid_blocks
from seiswidgets.core.seams import welded
from seiswidgets.core.terms import AreaBarrier, ContourLaplacian, EdgeLength, MeanValue, Stitch
from seiswidgets.core.triangulation import edges_along
from seiswidgets.errors import PickError
from seiswidgets.geology.cutoffs import CutOffPair, PickNetwork
from seiswidgets.geology.domain import RestorationDomain
from seiswidgets.geology.fault_lines import CLOSE, EDGES, crossings, fault_lines, passing_through, with_points
from seiswidgets.geology.segments import horizon_segments
from seiswidgets.geology.slip_report import slip_report
from seiswidgets.geology.solve import (
    GAUSS_NEWTON,
    Options,
    nearest_rigid,
    reusable_setup,
    solved,
    vertex_masses,
    warm_start,
)
from seiswidgets.geology.stage import Stage, staged


@dataclass(frozen=True, eq=False)
class Blocks:
    """A section cut into blocks, and what is known of their slip.

    Attributes
    ----------
    cut : Cut
    sides : dict of str to array, shape (2, s, 2)
        Both copies of each fault's edges.
    network : PickNetwork
    cutoffs : list of CutOffPair
    stitches : array, shape (c, 2)
        For each of the cut-offs its vertex in the hanging wall and in the footwall.
    beds : dict of str to list of array, shape (k, 2)
        The edges of each part of each horizon.
    fingerprint : tuple
        What they were made for.
    """

    cut: Cut
    sides: dict[str, np.ndarray]
    network: PickNetwork
    cutoffs: list[CutOffPair]
    stitches: np.ndarray
    beds: dict[str, list[np.ndarray]]
    fingerprint: tuple

    @property
    def mesh(self) -> Mesh:
        """The mesh, cut."""
        return self.cut.mesh

    @property
    def reach(self) -> float:
        """What multiplies the weight of a stitch: the root of the number of edges along a fault, on average.

        A stitch is one vertex, but has to move the whole side of a fault. So it counts for as many as the contact
        does there, and cut-offs meet as well on a fine mesh as on a coarse one.
        """
        return float(np.sqrt(np.mean([sides.shape[1] for sides in self.sides.values()])))

    def slips(self) -> dict[str, np.ndarray]:
        """For each fault the points between its pairs of cut-offs, and the distance of each pair, in metres."""
        ends = self.mesh.vertices[self.stitches]
        rows = np.column_stack([ends.mean(axis=1), np.hypot(*(ends[:, 0] - ends[:, 1]).T)])
        return {name: rows[[pair.fault == name for pair in self.cutoffs]] for name in self.network.faults}


def unfaulted(domain: RestorationDomain, faults: dict, horizons: dict, fixed, options: Options) -> Stage:
    """The stage that undoes the slip on some faults.

    Parameters
    ----------
    domain : RestorationDomain
    faults : dict of str to array, shape (n, 2)
    horizons : dict of str to list of LineString
    fixed : array, shape (2,), or None
        A point in the block that stays.
    options : Options
    """
    began = time.perf_counter()
    fingerprint = domain.fingerprint({name: [LineString(points)] for name, points in faults.items()}, horizons)
    blocks = reusable_setup(options.start, fingerprint) or _blocks(domain, faults, horizons, fingerprint)
    mesh, free = blocks.mesh, _free(blocks.mesh, fixed, domain)
    terms = _terms(blocks, options.weights)
    start = warm_start(mesh, free, options.start)
    if start is None:
        slid = options.solver == GAUSS_NEWTON
        start = _slid_together(mesh, blocks.stitches, free, terms) if slid else mesh.vertices  # the paper's own start
    adrift = bool(free.all())
    solution = solved(mesh, terms, start, free, domain.spacing, options, domain.where, adrift)
    vertices = solution.vertices
    if adrift:
        vertices = nearest_rigid(mesh.vertices, vertices, vertex_masses(mesh))
    whole, vertices = welded(mesh, vertices, [_still_side_last(sides, free) for sides in blocks.sides.values()])
    seconds, achieved = time.perf_counter() - began, partial(slip_report, blocks, solution, domain)
    picks, lines = tuple(blocks.network.faults), tuple(blocks.network.faults.values())
    return staged("unfault", picks, domain, whole, vertices, solution, options.solver, seconds, blocks, achieved, lines)


def _blocks(domain, faults, horizons, fingerprint):
    network = _network(fault_lines(faults, domain), horizons, domain)
    cutoffs = network.cutoffs()
    lines = {name: _meshed_line(name, line, network, domain) for name, line in network.faults.items()}
    beds = {name: [domain.simplified(part.line) for part in horizon] for name, horizon in network.horizons.items()}
    whole = domain.mesh([*lines.values(), *(line for bed in beds.values() for line in bed)])
    edges = {name: _inner_edges(whole, line, name, domain) for name, line in lines.items()}
    slipped = np.concatenate(list(edges.values()))
    cut = whole.cut(slipped)
    beds = {
        name: [cut.along(edges_along(whole, line, domain.spacing, without=slipped)) for line in bed]
        for name, bed in beds.items()
    }
    sides = {name: cut.sides(along) for name, along in edges.items()}
    _check_meshed(cutoffs, beds, network, domain)
    return Blocks(cut, sides, network, cutoffs, _stitches(cutoffs, beds), beds, fingerprint)


def _network(drawn, horizons, domain):
    """Faults and horizons matched with each other, the faults without drawn points that lie close to a cut-off."""
    network = _matched(drawn, horizons, domain)
    settled = {
        name: passing_through(line, network.ends_at(name), crossings(name, drawn), CLOSE * domain.spacing)
        for name, line in drawn.items()
    }
    return network if settled == drawn else _matched(settled, horizons, domain)


def _matched(drawn, horizons, domain):
    faults = list(drawn.values())
    segments = {name: horizon_segments(pieces, faults) for name, pieces in horizons.items()}
    return PickNetwork(drawn, segments, domain.where)


def _meshed_line(name, line, network, domain):
    """A fault with its cut-offs among its points, in edges short enough to slip along."""
    line = with_points(line, network.ends_at(name))
    return line.segmentize(min(domain.spacing, line.length / EDGES))


def _inner_edges(mesh, line, name, domain):
    along = edges_along(mesh, line, domain.spacing)
    inner = ~np.isin(edge_keys(along), edge_keys(mesh.boundary))
    if not inner.any():
        raise PickError(
            f"fault {name!r} runs along the border of the section near {domain.where(line.coords[0])}, where there is "
            "nothing to slide; draw it inside"
        )
    return along[inner]


def _check_meshed(cutoffs, beds, network, domain):
    for pair in cutoffs:
        for index, place in (pair.hanging_wall, pair.footwall):
            part = network.horizons[pair.horizon][index]
            if not len(beds[pair.horizon][index]):
                raise PickError(
                    f"piece {part.number} of horizon {pair.horizon!r} is only {part.line.length:.2g} m long at fault "
                    f"{pair.fault!r}, near {domain.where(part.ends[place].point)}; draw more of it, or choose a finer "
                    "spacing"
                )


def _stitches(cutoffs, beds):
    """The vertices of each pair of cut-offs, hanging wall first; shape (c, 2)."""
    ends = [
        [beds[pair.horizon][index][place, place] for index, place in (pair.hanging_wall, pair.footwall)]
        for pair in cutoffs
    ]
    return np.array(ends, dtype=int)


def _free(mesh, fixed, domain):
    """Which vertices may move: all, or all but those of the block that holds a point."""
    if fixed is None:
        return np.ones(len(mesh.vertices), bool)
    triangle = triangle_at(mesh.vertices, mesh.triangles, fixed)
    if triangle < 0:
        raise PickError(f"no rock lies at fixed, {domain.where(fixed)}; choose a point inside the block to hold")
    if mesh.blocks.max() == 0:
        raise PickError(
            "fixed is given, but the faults cut no block off: all of them end inside the section; leave fixed out"
        )
    return mesh.blocks != mesh.blocks[mesh.triangles[triangle, 0]]


def _terms(blocks, weights):
    mesh = blocks.mesh
    pairs = blocks.stitches[blocks.stitches[:, 0] != blocks.stitches[:, 1]]  # at a blind tip both are one
    return [
        MeanValue(mesh, weights.mean_value),
        ContourLaplacian(mesh, weights.contour),
        EdgeLength(mesh.vertices, mesh.edges, weights.edge),
        Stitch(pairs, len(mesh.vertices), weights.stitch * blocks.reach),
        *(
            term
            for name, sides in blocks.sides.items()
            for term in contacts(mesh, sides, blocks.network.faults[name], weights.slide, "contact")
        ),
        AreaBarrier(mesh),
    ]


def _slid_together(mesh, stitches, free, terms):
    """Where the solver starts: blocks moved as wholes so that their cut-offs meet and their sides touch.

    They are shifted one after the other, from the block that stays (or the largest), then moved and turned together.
    """
    label = mesh.blocks
    root = label[~free][0] if not free.all() else np.bincount(label, vertex_masses(mesh)).argmax()
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


def _still_side_last(sides, free):
    """The two sides of a seam, first the one whose vertices may be laid on the other."""
    return (sides[1], sides[0]) if not free[sides[0]].all() else (sides[0], sides[1])
