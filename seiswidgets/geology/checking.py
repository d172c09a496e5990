"""Checks of picks and a plan before anything is solved: all findings at once."""

from collections.abc import Iterator, Sequence

from seiswidgets.errors import PickError, SeiswidgetsError
from seiswidgets.geology.bed_mesh import mesh_bed
from seiswidgets.geology.blocks import Blocks, mesh_blocks
from seiswidgets.geology.crossings import crossing_findings
from seiswidgets.geology.findings import Finding, worst_first
from seiswidgets.geology.observations import observe_picks
from seiswidgets.geology.picks import Fault, Horizon, Interpretation
from seiswidgets.geology.plan import Plan, RestorationJob
from seiswidgets.geology.restoration import Restoration
from seiswidgets.geology.section import Section
from seiswidgets.geology.stage import STRIP
from seiswidgets.geology.steps import FLATTEN, UNFAULT, WITH_LAYERS, Step
from seiswidgets.geology.stratified_rock import fault_lines_of
from seiswidgets.geology.surfaces import surface_line
from seiswidgets.geology.unfaulting import free_vertices
from seiswidgets.geology.usable_picks import Beds, EndsOfFaults, Lines
from seiswidgets.geology.validation import checked_kind
from seiswidgets.geology.vertical_shear import LENGTH


def check(section: Section, interpretation: Interpretation, plan: Plan | None = None) -> list[Finding]:
    """Everything about picks and a plan that deserves a look, found without solving; problems first.

    Each step is checked on the present-day section. A problem prevents its step, or makes its result doubtful; the
    text of a warning says what becomes of the pick.

    Parameters
    ----------
    section : Section
    interpretation : Interpretation
    plan : Plan, optional
        By default all faults, then the first horizon.

    Examples
    --------
    >>> import seiswidgets as sw
    >>> case = sw.synthetic.planar_fault()
    >>> sw.check(case.section, case.interpretation)
    []
    """
    checked_kind(interpretation, Interpretation, "interpretation")
    job = RestorationJob(section, interpretation, plan or Plan())
    found = crossing_findings(section, [bed for bed in interpretation.horizons if bed.constrains])
    try:
        start = job.start
        for step in job.steps:
            found += _check_step(start, job, step)
    except SeiswidgetsError as error:
        found.append(_refusal(error))
    return list(worst_first(dict.fromkeys([*found, *_idle_steps(job)])))


def _idle_steps(job: RestorationJob) -> Iterator[Finding]:
    """A note about each step that is on, but lacks what it works on."""
    for step in job.plan.steps:
        drawn = job.interpretation.faults if step.kind == UNFAULT else job.interpretation.horizons
        if step.on and drawn and step not in job.steps:
            lacks = (
                "there is no stratigraphy"
                if step.kind in WITH_LAYERS
                else "the use of none of its picks is 'constrain'"
            )
            yield Finding("note", "skipped", f"the step {step.kind} is skipped: {lacks}")


def _check_step(start: Restoration, job: RestorationJob, step: Step) -> Sequence[Finding]:
    try:
        if step.kind == UNFAULT:
            return _check_unfaulting(start, job, step)
        if step.kind in WITH_LAYERS and job.plan.stratigraphy:
            rock = start.stratified(job.plan.stratigraphy, job.interpretation)
            _ = rock.layers.layer_of_face
            return rock.notes
        if step.kind == STRIP or (step.kind == FLATTEN and step.by != LENGTH):
            return _check_surface(start, job.horizon(step), job.interpretation.faults)
        return _check_flattening(start, job.horizon(step)) if step.kind == FLATTEN else ()
    except SeiswidgetsError as error:
        return [_refusal(error)]


def _check_surface(start: Restoration, horizon: Horizon, faults: Sequence[Fault]) -> Sequence[Finding]:
    picks = start.usable_picks
    _, notes = surface_line(horizon.name, picks.bed_lines(horizon), fault_lines_of(picks, faults), start.domain)
    return (*notes, *picks.notes([horizon]))


def _check_flattening(start: Restoration, horizon: Horizon) -> Sequence[Finding]:
    mesh_bed(start.domain, horizon.name, start.usable_picks.bed_lines(horizon))
    return start.usable_picks.notes([horizon])


def _check_unfaulting(start: Restoration, job: RestorationJob, step: Step) -> Sequence[Finding]:
    def mesh(lines: Lines, beds: Beds, walls: Lines, ends: EndsOfFaults) -> Blocks:
        return mesh_blocks(start.domain, lines, beds, walls, ends, profiles=job.slip(step))

    faults, boundaries = job.faults(step), job.boundaries(step)
    blocks, notes = start.usable_picks.use(mesh, faults, job.horizons(step), boundaries)
    found = [*notes, *observe_picks(blocks, start.domain)]
    try:
        holds = start.usable_picks.holds(job.plan.fixed, job.plan.pins, job.plan.regional)
        free_vertices(blocks, holds.fixed, start.domain)
    except PickError as error:
        found.append(_refusal(error))
    return found


def _refusal(error: SeiswidgetsError) -> Finding:
    return Finding("problem", error.kind or "refused", error.text, error.pick, error.where)
