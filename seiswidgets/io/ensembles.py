"""Ensembles of restorations: the public function, which resumes from a file."""

import os
from collections.abc import Callable, Iterator
from concurrent.futures import Executor
from contextlib import nullcontext

from seiswidgets.errors import Cancelled
from seiswidgets.geology import validation
from seiswidgets.geology.ensembles.ensemble import Ensemble
from seiswidgets.geology.ensembles.member import Member, Study
from seiswidgets.geology.ensembles.running import complete, iterate_members
from seiswidgets.geology.ensembles.uncertainty import Uncertainty
from seiswidgets.geology.hypothesis import Hypothesis
from seiswidgets.geology.picks import Interpretation
from seiswidgets.geology.plan import Plan
from seiswidgets.geology.section import Section
from seiswidgets.io.files import user_path
from seiswidgets.io.partial_ensembles import PartialEnsemble
from seiswidgets.signatures import strict_keywords

MemberProgress = Callable[[int, int], bool | None]


@strict_keywords
def ensemble(
    section: Section,
    interpretation: Interpretation,
    plan: Plan | None,
    uncertainty: Uncertainty,
    members: int = 200,
    seed: int = 0,
    executor: Executor | None = None,
    *,
    workers: int | None = None,
    partial: str | os.PathLike | None = None,
    progress: MemberProgress | None = None,
) -> Ensemble:
    """Restore a section many times, with the errors of its picks drawn at random, to see how certain the results are.

    Each member is drawn from a seed of its own, so that results depend neither on the number of workers nor on the
    order in which members are done, and that 200 members are the first of 1,000. A plan without steps makes no mesh,
    unless a match needs one: only throw and heave are measured, in milliseconds.

    Parameters
    ----------
    section : Section
    interpretation : Interpretation
    plan : Plan or None
        By default all faults, then the first horizon.
    uncertainty : Uncertainty
    members : int
    seed : int
    executor : concurrent.futures.Executor, optional
        Such as ``dask.distributed.Client(...).get_executor()`` on a cluster. By default processes of this computer, as
        many as it has cores; each uses one thread.
    workers : int, optional
        Another number of those processes.
    partial : path, optional
        A file that keeps each member once it is done. If it exists, the members in it are not computed again: after a
        crash, or to go on to more members, run the same again.
    progress : callable(done, members), optional
        Called after each member, and about ten times a second; returning False cancels.

    Raises
    ------
    SettingError
        If ``members`` is below 1, or the executor has been shut down.
    PickError, SettingError, FlippedError
        If the interpretation as drawn cannot be restored, or lacks a fault that has matches; what refuses a
        member is its ``problem`` instead.
    DataError
        If the file belongs to another ensemble, or the disk is full; what was done before is kept.
    Cancelled
        If ``progress`` returned False.

    Examples
    --------
    >>> import seiswidgets as sw
    >>> case = sw.synthetic.planar_fault(throw=100)
    >>> uncertainty = sw.Uncertainty(horizon=1)
    >>> result = sw.ensemble(case.section, case.interpretation, sw.Plan(steps=()), uncertainty, members=50)
    >>> low, high = result.percentiles((5, 95))["throw", "H1 at F1"]
    >>> print(low < 100 < high)
    True
    """
    for value, kind, name in (
        (section, Section, "section"),
        (interpretation, Interpretation, "interpretation"),
        (uncertainty, Uncertainty, "uncertainty"),
    ):
        validation.checked_kind(value, kind, name)
    for fault in uncertainty.matches:
        interpretation.fault(fault)
    members = validation.whole_number("members", members, least=1)
    drawn = Hypothesis(section, interpretation, plan or Plan())
    study = Study(drawn, uncertainty, validation.whole_number("seed", seed, least=0))
    with PartialEnsemble(user_path(partial), study.fingerprint) if partial is not None else nullcontext() as file:
        done = {one.index: one for one in complete(study.frame, file.members if file else ()) if one.index < members}
        missing = [index for index in range(members) if index not in done]
        for member in _watched(iterate_members(study, missing, executor, workers), len(done), members, progress):
            done[member.index] = member
            if file:
                file.append(member)
    return Ensemble.of(study, study.frame, done.values())


def _watched(
    arriving: Iterator[Member | None], done: int, members: int, progress: MemberProgress | None
) -> Iterator[Member]:
    """Pass members on and report the progress; Cancelled if the report returns False."""
    for member in arriving:
        if member is not None:
            yield member
            done += 1
        if progress is not None and progress(done, members) is False:
            raise Cancelled(f"the ensemble was cancelled after {done} of {members} members")
