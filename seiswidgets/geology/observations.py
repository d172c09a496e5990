"""Observations of a stage's solution: what is left at faults and cut-offs, off the datum, and of beds' lengths."""

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from seiswidgets.core.contact import Contact
from seiswidgets.core.solver import Solution
from seiswidgets.core.terms import Level
from seiswidgets.geology.beyond import Beyond
from seiswidgets.geology.cutoffs import CutOffPair, separation
from seiswidgets.geology.domain import RestorationDomain
from seiswidgets.geology.extensions import extension_findings
from seiswidgets.geology.fault_ends import fault_end_findings
from seiswidgets.geology.findings import Finding
from seiswidgets.geology.growth import growth_findings
from seiswidgets.geology.heave_closure import heave_findings
from seiswidgets.geology.passive import carried_finding
from seiswidgets.geology.report import BedReport, CutOffReport, Observations, SeamReport, SlipReport

if TYPE_CHECKING:  # both modules import this one
    from seiswidgets.geology.bed_mesh import Bed
    from seiswidgets.geology.blocks import Blocks

KEPT = 0.005  # of a horizon's length: a larger change is worth a finding


def observe_slip(blocks: "Blocks", solution: Solution, domain: RestorationDomain) -> Observations:
    """Measure what an unfaulting stage has left at seams and cut-offs, and done to beds."""
    seams, wide = _seams(blocks, solution, domain)
    cutoffs, apart = _cutoffs(blocks, solution.vertices, domain)
    before, after = blocks.mesh.vertices, solution.vertices
    beds = tuple(BedReport(name, length_change(edges, before, after)) for name, edges in blocks.beds.items())
    stretched = [
        finding for name, edges in blocks.beds.items() for finding in _stretched(name, edges, before, after, domain)
    ]
    slips, off = _slips(blocks, after, domain)
    made = {name: _length(edges, after) - _length(edges, before) for name, edges in blocks.beds.items()}
    open_heave = heave_findings(cutoffs, made, _places(blocks), domain)
    found = (*apart, *off, *wide, *stretched, *open_heave, *observe_picks(blocks, domain))
    return Observations(cutoffs, seams, beds, found, slips)


def _slips(
    blocks: "Blocks", vertices: np.ndarray, domain: RestorationDomain
) -> tuple[tuple[SlipReport, ...], list[Finding]]:
    reports = [sides.report(vertices, domain) for sides in blocks.prescribed.values()]
    return tuple(report for report, _ in reports), [finding for _, found in reports for finding in found]


def observe_picks(blocks: "Blocks", domain: RestorationDomain) -> list[Finding]:
    """Findings about picks as they were drawn, which need no solution."""
    faults, slips = blocks.network.faults, blocks.slips()
    return [
        *growth_findings(faults, slips, domain),
        *fault_end_findings(blocks.lines, slips, domain, blocks.ends),
        *extension_findings(blocks.network.horizons, list(faults), domain),
        *map(carried_finding, blocks.network.refusals),
        *(finding for sides in blocks.prescribed.values() for finding in sides.findings(domain)),
    ]


def observe_level(name: str, bed: "Bed", level: Level, vertices: np.ndarray, rest: Beyond) -> Observations:
    """Measure how level a flattened horizon is, how its length has changed, and how far the rest has moved."""
    domain, moved = rest.domain, vertices
    before, vertices = bed.positions(bed.mesh.vertices), bed.positions(vertices)
    off = vertices[level.vertices, 1] - level.datum
    flatness = float(np.sqrt(np.mean(off**2)) / domain.section.metres[1])
    report = BedReport(name, length_change([bed.edges], before, vertices), flatness)
    farthest = before[level.vertices[np.argmax(np.abs(off))]]
    uneven = _uneven(name, float(np.abs(off).max()), farthest, domain)
    stretched = _stretched(name, [bed.edges], before, vertices, domain)
    drawn = rest.is_drawn(before[level.vertices, 0])
    own = np.max(np.abs((vertices - before)[level.vertices, 1][drawn]), initial=0.0)
    findings = (*uneven, *stretched, *rest.findings(name, bed.mesh, moved, float(own)))
    return Observations(beds=(report,), findings=findings)


def observe_bed(
    name: str, edges: np.ndarray, before: np.ndarray, after: np.ndarray, domain: RestorationDomain
) -> Observations:
    """Measure how the length of a horizon has changed that was brought to its datum exactly."""
    report = BedReport(name, length_change([edges], before, after), 0.0)
    return Observations(beds=(report,), findings=tuple(_stretched(name, [edges], before, after, domain)))


def length_change(edges: Sequence[np.ndarray], before: np.ndarray, after: np.ndarray) -> float:
    """Relative change of the total length of some polylines.

    Parameters
    ----------
    edges : list of array, each of shape (k, 2)
        Pairs of vertices.
    before, after : array, shape (n, 2)
    """
    return _length(edges, after) / _length(edges, before) - 1


def _length(edges: Sequence[np.ndarray], vertices: np.ndarray) -> float:
    return float(_lengths(np.concatenate(edges), vertices).sum())


def _lengths(edges: np.ndarray, vertices: np.ndarray) -> np.ndarray:
    return np.hypot(*(vertices[edges[:, 1]] - vertices[edges[:, 0]]).T)


def _stretched(
    name: str, edges: Sequence[np.ndarray], before: np.ndarray, after: np.ndarray, domain: RestorationDomain
) -> list[Finding]:
    """A finding if a horizon's length has changed by more than 0.5%, at the edge that changed most."""
    change = length_change(edges, before, after)
    if abs(change) <= KEPT:
        return []
    all_edges = np.concatenate(edges)
    most = np.argmax(np.sign(change) * (_lengths(all_edges, after) - _lengths(all_edges, before)))
    point = before[all_edges[most]].mean(axis=0)
    text = (
        f"horizon {name} has become {abs(change):.1%} {'longer' if change > 0 else 'shorter'}, most of all near "
        f"{domain.where(point)}; check there how the horizon and the faults beside it are drawn"
    )
    return [Finding("warning", "bed length", text, name, domain.position(point))]


def _uneven(name: str, off: float, point: np.ndarray, domain: RestorationDomain) -> list[Finding]:
    """A finding if a horizon is more than the slack off its datum."""
    if off <= domain.slack:
        return []
    text = (
        f"horizon {name} is still up to {off / domain.section.metres[1]:.2g} {domain.section.z_unit} off its datum "
        f"near {domain.where(point)}; check how it is drawn there, or raise the weight flatten"
    )
    return [Finding("problem", "datum", text, name, domain.position(point))]


def _seams(
    blocks: "Blocks", solution: Solution, domain: RestorationDomain
) -> tuple[tuple[SeamReport, ...], list[Finding]]:
    """Gap and overlap along each fault, and findings where they are wider than the slack."""
    seams, wide = [], []
    contacts = [term for term in solution.terms if isinstance(term, Contact)]
    for name, pair in zip(blocks.sides, zip(contacts[::2], contacts[1::2], strict=True), strict=True):
        gap = overlap = widest = 0.0
        for term, outwards in zip(pair, (1, -1), strict=True):
            distances, lengths = outwards * term.distances(solution.vertices), term.lengths(blocks.mesh.vertices)
            gap += 0.5 * float(lengths @ np.maximum(distances, 0))
            overlap += 0.5 * float(lengths @ np.maximum(-distances, 0))
            if np.max(np.abs(distances), initial=0) > widest:
                widest = float(np.max(np.abs(distances)))
                point = blocks.mesh.vertices[term.held_points[np.argmax(np.abs(distances))]]
        seams.append(SeamReport(name, gap, overlap, widest))
        if widest > domain.slack:
            wide.append(_sides_apart(seams[-1], point, domain))
    return tuple(seams), wide


def _sides_apart(seam: SeamReport, point: np.ndarray, domain: RestorationDomain) -> Finding:
    text = (
        f"the sides of fault {seam.fault} are up to {domain.length(seam.widest)} apart or overlapping, most of all "
        f"near {domain.where(point)}, with {domain.area(seam.gap)} of gap and {domain.area(seam.overlap)} of "
        "overlap; check the shape of the fault there, and the cut-offs on both its sides"
    )
    return Finding("warning", "contact", text, seam.fault, domain.position(point))


def _places(blocks: "Blocks") -> dict[tuple[str, str], np.ndarray]:
    """A point at the cut-offs of each fault and horizon."""
    pairs = zip(blocks.cutoffs, blocks.cutoff_positions(blocks.mesh.vertices), strict=True)
    return {(pair.fault, pair.horizon): points[0] for pair, points in pairs}


def _cutoffs(
    blocks: "Blocks", vertices: np.ndarray, domain: RestorationDomain
) -> tuple[tuple[CutOffReport, ...], list[Finding]]:
    """Throw, heave and misfit of each pair of cut-offs, and findings where the misfit is more than the slack."""
    reports, apart = [], []
    at_rest, restored = (blocks.cutoff_positions(points) for points in (blocks.mesh.vertices, vertices))
    for pair, before, (hanging_wall, footwall) in zip(blocks.cutoffs, at_rest, restored, strict=True):
        slip = separation(blocks.network.faults[pair.fault].coords, *domain.section.from_rock(before))
        misfit = float(np.hypot(*(hanging_wall - footwall)))
        reports.append(CutOffReport(pair.fault, pair.horizon, *slip, misfit))
        if misfit > domain.slack:
            apart.append(_cutoffs_apart(pair, misfit, before[0], domain))
    return tuple(reports), apart


def _cutoffs_apart(pair: CutOffPair, misfit: float, point: np.ndarray, domain: RestorationDomain) -> Finding:
    text = (
        f"horizon {pair.horizon} at fault {pair.fault}: its cut-offs are still {domain.length(misfit)} apart, near "
        f"{domain.where(point)}; check that both pieces belong to one horizon and end at the fault where they should, "
        "or leave one out"
    )
    return Finding("problem", "cut-off", text, pair.horizon, domain.position(point))
