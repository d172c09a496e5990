"""What a stage that slides blocks back has achieved: what is left at its faults, cut-offs and beds."""

import numpy as np

from seiswidgets.core.contact import Contact
from seiswidgets.core.solver import Solution
from seiswidgets.geology.bed_length import length_change, stretched_bed
from seiswidgets.geology.domain import RestorationDomain
from seiswidgets.geology.fault_ends import fault_end_findings
from seiswidgets.geology.findings import Finding
from seiswidgets.geology.report import BedReport, CutOffReport, SeamReport


def slip_report(blocks, solution: Solution, domain: RestorationDomain) -> dict:
    """What the report of an unfaulting stage says of seams, cut-offs and beds, and its findings.

    Parameters
    ----------
    blocks : Blocks
        Of ``unfaulting``.
    solution : Solution
    domain : RestorationDomain
    """
    seams, gave_way = _seams(blocks, solution, domain)
    cutoffs, apart = _cutoffs(blocks, solution.vertices, domain)
    beds = tuple(
        BedReport(name, length_change(edges, blocks.mesh.vertices, solution.vertices))
        for name, edges in blocks.beds.items()
    )
    stretched = [
        finding
        for name, edges in blocks.beds.items()
        for finding in stretched_bed(name, edges, blocks.mesh.vertices, solution.vertices, domain)
    ]
    ends = fault_end_findings(blocks.network.faults, blocks.slips(), domain)
    findings = (*apart, *gave_way, *stretched, *ends)
    return {"seams": seams, "cutoffs": cutoffs, "beds": beds, "findings": findings}


def _seams(blocks, solution, domain):
    """Gap and overlap along each fault, and in words where they are wider than the slack."""
    seams, gave_way = [], []
    held = [term for term in solution.terms if isinstance(term, Contact)]
    for name, pair in zip(blocks.sides, zip(held[::2], held[1::2], strict=True), strict=True):
        gap = overlap = widest = 0.0
        place = None
        for term, outwards in zip(pair, (1, -1), strict=True):
            distances, lengths = outwards * term.distances(solution.vertices), term.lengths(blocks.mesh.vertices)
            gap += 0.5 * float(lengths @ np.maximum(distances, 0))
            overlap += 0.5 * float(lengths @ np.maximum(-distances, 0))
            if np.max(np.abs(distances), initial=0) > widest:
                widest = float(np.max(np.abs(distances)))
                place = blocks.mesh.vertices[term.held_points[np.argmax(np.abs(distances))]]
        seams.append(SeamReport(name, gap, overlap, widest))
        if widest > domain.slack:
            gave_way.append(_parted(name, widest, place, domain))
    return tuple(seams), gave_way


def _parted(name, widest, place, domain):
    text = (
        f"the sides of fault {name} are up to {domain.length(widest)} apart or overlapping, most of all near "
        f"{domain.where(place)}; check the shape of the fault there, and the cut-offs on both its sides"
    )
    return Finding("warning", "contact", text, name, domain.position(place))


def _apart(pair, misfit, place, domain):
    text = (
        f"horizon {pair.horizon} at fault {pair.fault}: its cut-offs are still {domain.length(misfit)} apart, near "
        f"{domain.where(place)}; check that both pieces are of one horizon and end at the fault where they should, or "
        "leave one out"
    )
    return Finding("problem", "cut-off", text, pair.horizon, domain.position(place))


def _cutoffs(blocks, vertices, domain):
    """Throw, heave and what is left between each pair of cut-offs, and in words where that is more than the slack."""
    reports, apart = [], []
    for pair, (hanging_wall, footwall) in zip(blocks.cutoffs, blocks.stitches, strict=True):
        before = domain.section.from_rock(blocks.mesh.vertices[[hanging_wall, footwall]])
        top, bottom = sorted((blocks.network.faults[pair.fault].coords[k] for k in (0, -1)), key=lambda end: end[1])
        misfit = float(np.hypot(*(vertices[hanging_wall] - vertices[footwall])))
        heave = (before[0, 0] - before[1, 0]) * (1 if bottom[0] >= top[0] else -1)
        reports.append(CutOffReport(pair.fault, pair.horizon, float(before[0, 1] - before[1, 1]), float(heave), misfit))
        if misfit > domain.slack:
            apart.append(_apart(pair, misfit, blocks.mesh.vertices[hanging_wall], domain))
    return tuple(reports), apart
