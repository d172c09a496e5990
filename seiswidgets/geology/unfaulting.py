"""Sliding fault blocks back until horizons match across the faults (the paper's section 3.1)."""

import time
from collections import deque
from dataclasses import dataclass
from functools import partial

import numpy as np
from shapely import LineString

from seiswidgets.core.contact import Contact, contacts
from seiswidgets.core.finder import triangle_at
from seiswidgets.core.mesh import Cut, Mesh, edge_keys
from seiswidgets.core.rigid import rigid_blocks
from seiswidgets.core.terms import AreaBarrier, ContourLaplacian, EdgeLength, MeanValue, Stitch
from seiswidgets.core.triangulation import edges_along
from seiswidgets.core.weld import welded
from seiswidgets.errors import PickError
from seiswidgets.geology.cutoffs import CutOffs, Drawing
from seiswidgets.geology.faultlines import CLOSE, EDGES, crossings, fault_lines, passing_through, with_points
from seiswidgets.geology.findings import Finding
from seiswidgets.geology.ground import Ground
from seiswidgets.geology.parts import parts
from seiswidgets.geology.report import BedReport, CutOffReport, SeamReport
from seiswidgets.geology.solving import (
    GAUSS_NEWTON,
    Options,
    laid_before,
    nearest_rigid,
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
    drawing : Drawing
    cutoffs : list of CutOffs
    stitches : array, shape (c, 2)
        For each of the cut-offs its vertex in the hanging wall and in the footwall.
    beds : dict of str to list of array, shape (k, 2)
        The edges of each part of each horizon.
    task : tuple
        What they were made for.
    """

    cut: Cut
    sides: dict[str, np.ndarray]
    drawing: Drawing
    cutoffs: list[CutOffs]
    stitches: np.ndarray
    beds: dict[str, list[np.ndarray]]
    task: tuple

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


def unfaulted(ground: Ground, faults: dict, horizons: dict, fixed, options: Options) -> Stage:
    """The stage that undoes the slip on some faults.

    Parameters
    ----------
    ground : Ground
    faults : dict of str to array, shape (n, 2)
    horizons : dict of str to list of LineString
    fixed : array, shape (2,), or None
        A point in the block that stays.
    options : Options
    """
    began = time.perf_counter()
    task = ground.task({name: [LineString(points)] for name, points in faults.items()}, horizons)
    blocks = laid_before(options.start, task) or _blocks(ground, faults, horizons, task)
    mesh, free = blocks.mesh, _free(blocks.mesh, fixed, ground)
    terms = _terms(blocks, options.weights)
    start = warm_start(mesh, free, options.start)
    if start is None:
        slid = options.solver == GAUSS_NEWTON
        start = _slid_together(mesh, blocks.stitches, free, terms) if slid else mesh.vertices  # the paper's own start
    adrift = bool(free.all())
    solution = solved(mesh, terms, start, free, ground.spacing, options, ground.where, adrift)
    vertices = solution.vertices
    if adrift:
        vertices = nearest_rigid(mesh.vertices, vertices, vertex_masses(mesh))
    whole, vertices = welded(mesh, vertices, [_still_side_last(sides, free) for sides in blocks.sides.values()])
    seconds, achieved = time.perf_counter() - began, partial(_achieved, blocks, solution, ground)
    picks, lines = tuple(blocks.drawing.faults), tuple(blocks.drawing.faults.values())
    return staged("unfault", picks, ground, whole, vertices, solution, options.solver, seconds, blocks, achieved, lines)


def _achieved(blocks, solution, ground):
    """What is reported of seams, cut-offs and beds."""
    seams, gave_way = _seams(blocks, solution, ground)
    cutoffs, apart = _cutoffs(blocks, solution.vertices, ground)
    beds = tuple(
        BedReport(name, length_change(edges, blocks.mesh.vertices, solution.vertices))
        for name, edges in blocks.beds.items()
    )
    return {"seams": seams, "cutoffs": cutoffs, "beds": beds, "findings": (*apart, *gave_way)}


def _blocks(ground, faults, horizons, task):
    drawing = _drawing(fault_lines(faults, ground), horizons, ground)
    cutoffs = drawing.cutoffs()
    lines = {name: _meshed_line(name, line, drawing, ground) for name, line in drawing.faults.items()}
    beds = {name: [ground.simplified(part.line) for part in horizon] for name, horizon in drawing.horizons.items()}
    whole = ground.mesh([*lines.values(), *(line for bed in beds.values() for line in bed)])
    edges = {name: _inner_edges(whole, line, name, ground) for name, line in lines.items()}
    slipped = np.concatenate(list(edges.values()))
    cut = whole.cut(slipped)
    beds = {
        name: [cut.along(edges_along(whole, line, ground.spacing, without=slipped)) for line in bed]
        for name, bed in beds.items()
    }
    sides = {name: cut.sides(along) for name, along in edges.items()}
    _check_meshed(cutoffs, beds, drawing, ground)
    return Blocks(cut, sides, drawing, cutoffs, _stitches(cutoffs, beds), beds, task)


def _drawing(drawn, horizons, ground):
    """Faults and horizons matched with each other, the faults without drawn points that lie close to a cut-off."""
    drawing = _matched(drawn, horizons, ground)
    settled = {
        name: passing_through(line, drawing.ends_at(name), crossings(name, drawn), CLOSE * ground.spacing)
        for name, line in drawn.items()
    }
    return drawing if settled == drawn else _matched(settled, horizons, ground)


def _matched(drawn, horizons, ground):
    faults = list(drawn.values())
    return Drawing(drawn, {name: parts(pieces, faults) for name, pieces in horizons.items()}, ground.where)


def _meshed_line(name, line, drawing, ground):
    """A fault with its cut-offs among its points, in edges short enough to slip along."""
    line = with_points(line, drawing.ends_at(name))
    return line.segmentize(min(ground.spacing, line.length / EDGES))


def _inner_edges(mesh, line, name, ground):
    along = edges_along(mesh, line, ground.spacing)
    inner = ~np.isin(edge_keys(along), edge_keys(mesh.boundary))
    if not inner.any():
        raise PickError(
            f"fault {name!r} runs along the border of the section near {ground.where(line.coords[0])}, where there is "
            "nothing to slide; draw it inside"
        )
    return along[inner]


def _check_meshed(cutoffs, beds, drawing, ground):
    for pair in cutoffs:
        for index, place in (pair.hanging_wall, pair.footwall):
            part = drawing.horizons[pair.horizon][index]
            if not len(beds[pair.horizon][index]):
                raise PickError(
                    f"piece {part.number} of horizon {pair.horizon!r} is only {part.line.length:.2g} m long at fault "
                    f"{pair.fault!r}, near {ground.where(part.ends[place].point)}; draw more of it, or choose a finer "
                    "spacing"
                )


def _stitches(cutoffs, beds):
    """The vertices of each pair of cut-offs, hanging wall first; shape (c, 2)."""
    ends = [
        [beds[pair.horizon][index][place, place] for index, place in (pair.hanging_wall, pair.footwall)]
        for pair in cutoffs
    ]
    return np.array(ends, dtype=int)


def _free(mesh, fixed, ground):
    """Which vertices may move: all, or all but those of the block that holds a point."""
    if fixed is None:
        return np.ones(len(mesh.vertices), bool)
    triangle = triangle_at(mesh.vertices, mesh.triangles, fixed)
    if triangle < 0:
        raise PickError(f"no rock lies at fixed, {ground.where(fixed)}; choose a point inside the block to hold")
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
            for term in contacts(mesh, sides, blocks.drawing.faults[name], weights.slide, "contact")
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


def _seams(blocks, solution, ground):
    """Gap and overlap along each fault, and in words where they are wider than the slack."""
    seams, gave_way = [], []
    held = [term for term in solution.terms if isinstance(term, Contact)]
    for name, pair in zip(blocks.sides, zip(held[::2], held[1::2], strict=True), strict=True):
        gap = overlap = widest = 0.0
        for term, outwards in zip(pair, (1, -1), strict=True):
            distances, lengths = outwards * term.distances(solution.vertices), term.lengths(blocks.mesh.vertices)
            gap += 0.5 * float(lengths @ np.maximum(distances, 0))
            overlap += 0.5 * float(lengths @ np.maximum(-distances, 0))
            widest = max(widest, float(np.max(np.abs(distances), initial=0)))
        seams.append(SeamReport(name, gap, overlap, widest))
        if widest > ground.slack:
            text = f"the sides of fault {name} are up to {widest:.2g} m apart or overlapping"
            gave_way.append(Finding("warning", "contact", text, name))
    return tuple(seams), gave_way


def _cutoffs(blocks, vertices, ground):
    """Throw, heave and what is left between each pair of cut-offs, and in words where that is more than the slack."""
    reports, apart = [], []
    for pair, (hanging_wall, footwall) in zip(blocks.cutoffs, blocks.stitches, strict=True):
        before = ground.section.from_rock(blocks.mesh.vertices[[hanging_wall, footwall]])
        top, bottom = sorted((blocks.drawing.faults[pair.fault].coords[k] for k in (0, -1)), key=lambda end: end[1])
        misfit = float(np.hypot(*(vertices[hanging_wall] - vertices[footwall])))
        heave = (before[0, 0] - before[1, 0]) * (1 if bottom[0] >= top[0] else -1)
        reports.append(CutOffReport(pair.fault, pair.horizon, float(before[0, 1] - before[1, 1]), float(heave), misfit))
        if misfit > ground.slack:
            text = f"horizon {pair.horizon} at fault {pair.fault}: its cut-offs are still {misfit:.2g} m apart"
            where = tuple(map(float, before[0]))
            apart.append(Finding("problem", "cut-off", text, pair.horizon, where))
    return tuple(reports), apart


def length_change(edges, before, after) -> float:
    """Change of the length of some polylines, as a share of it."""
    lengths = [sum(np.hypot(*(at[line[:, 1]] - at[line[:, 0]]).T).sum() for line in edges) for at in (before, after)]
    return float(lengths[1] / lengths[0] - 1)
