"""Sliding fault blocks back until horizons match across the faults (the paper's section 3.1)."""

import time
from collections import deque
from collections.abc import Mapping, Sequence
from functools import partial

import numpy as np
from shapely import LineString

from seiswidgets.core.contact import Contact, contacts
from seiswidgets.core.facing import Facing
from seiswidgets.core.holds import EdgeDirection
from seiswidgets.core.interpolated import AtPoints
from seiswidgets.core.mesh import Mesh
from seiswidgets.core.point_location import triangle_at
from seiswidgets.core.rigid import rigid_blocks
from seiswidgets.core.seams import weld_seams
from seiswidgets.core.term import Term
from seiswidgets.core.terms import AreaBarrier, ContourLaplacian, EdgeLength, MeanValue, Stitch
from seiswidgets.errors import Keyword, PickError, SettingError
from seiswidgets.geology.bedding import bedding_terms
from seiswidgets.geology.blocks import NO_PROFILES, Blocks, mesh_blocks
from seiswidgets.geology.domain import RestorationDomain
from seiswidgets.geology.fault_lines import NO_ENDS
from seiswidgets.geology.holds import Holds, PinnedMesh
from seiswidgets.geology.motion import RockParts
from seiswidgets.geology.observations import observe_slip
from seiswidgets.geology.picks import Ends
from seiswidgets.geology.slip_profile import SlipProfile
from seiswidgets.geology.solve import GAUSS_NEWTON, SolverOptions, minimise, warm_start
from seiswidgets.geology.stage import Outcome, Stage
from seiswidgets.geology.weights import Weights


def unfault_stage(
    domain: RestorationDomain,
    faults: Mapping[str, np.ndarray],
    horizons: Mapping[str, Sequence[LineString]],
    holds: Holds,
    options: SolverOptions,
    boundaries: Mapping[str, np.ndarray],
    *,
    ends: Mapping[str, Ends] = NO_ENDS,
    profiles: Mapping[str, SlipProfile] = NO_PROFILES,
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
    profiles : dict of str to SlipProfile
        Slip of the faults where it is prescribed, whatever the horizons there say.
    """
    began = time.perf_counter()
    blocks = mesh_blocks(domain, faults, horizons, boundaries, ends, options.start, profiles)
    mesh, free = blocks.mesh, free_vertices(blocks, holds.fixed, domain)
    pinned = PinnedMesh(mesh, holds, domain, upright=options.weights.rotation > 0)
    unheld = bool(free.all())
    if pinned.term is not None and options.solver != GAUSS_NEWTON:
        raise SettingError("pins and a regional level need ", Keyword("solver", GAUSS_NEWTON))
    terms = [*_terms(blocks, options.row_weights, domain.spacing), *([pinned.term] if pinned.term else [])]
    start = warm_start(mesh, free, options.start)
    if start is None:  # the paper starts its own solver from the unmoved mesh
        is_newton = options.solver == GAUSS_NEWTON
        start = _slide_blocks(mesh, blocks.stitched_vertices, free, terms) if is_newton else mesh.vertices
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


def _terms(blocks: Blocks, weights: Weights, spacing: float) -> list[Term]:
    mesh, segments = blocks.mesh, blocks.network.horizons.values()
    return [
        MeanValue(mesh, weights.mean_value),
        ContourLaplacian(mesh, weights.contour),
        EdgeLength(mesh.vertices, mesh.edges, weights.edge),
        blocks.stitch(weights.stitch),
        *(term for sides in blocks.prescribed.values() for term in sides.facing(weights.stitch)),
        *(
            term
            for (name, sides), beyond in zip(blocks.sides.items(), blocks.beyond, strict=True)
            for term in contacts(mesh, sides, blocks.lines[name], weights.slide, "contact", beyond)
        ),
        AreaBarrier(mesh),
        *bedding_terms(mesh, [segment.line for bed in segments for segment in bed], spacing, weights),
        *([EdgeDirection(mesh.vertices, mesh.edges, weights.rotation)] if weights.rotation else []),
    ]


def _slide_blocks(mesh: Mesh, stitches: np.ndarray, free: np.ndarray, terms: Sequence[Term]) -> np.ndarray:
    """Move blocks rigidly so that their cut-offs meet and their sides touch, as a start for the solver.

    They are shifted one after the other, from the block that stays (or the largest), then moved and turned together.
    """
    label = mesh.blocks
    facing = [np.column_stack([term.points, term.nearest]) for term in terms if isinstance(term, Facing)]
    stitches = np.concatenate([stitches, *facing])
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
    between = [term for term in terms if isinstance(term, Contact | Facing | Stitch | AtPoints)]
    return rigid_blocks(label, between, mesh.vertices + np.nan_to_num(shift)[label], label != root)


def _still_side_last(sides: np.ndarray, free: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """The two sides of a seam, first the one whose vertices may be moved onto the other."""
    return (sides[1], sides[0]) if not free[sides[0]].all() else (sides[0], sides[1])
