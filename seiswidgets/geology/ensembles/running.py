"""Computing the members of an ensemble, in this process or on the workers of an executor."""

from collections.abc import Iterable, Iterator
from concurrent.futures import Executor

from seiswidgets.geology.ensembles.member import Frame, Member, Study, compute_member
from seiswidgets.geology.parallel import Lost, run_tasks


def iterate_members(
    study: Study, indices: Iterable[int], executor: Executor | None = None, workers: int | None = None
) -> Iterator[Member | None]:
    """Yield members as they are computed, and None while there is none.

    Without a step that restores anything, a member takes milliseconds, and is computed in this process unless an
    executor is given. Other arguments and errors are as for `run_tasks`.
    """
    frame = study.frame
    if executor is None and workers is None and not frame.nodes.size:
        yield from (compute_member((study, frame), index) for index in indices)
        return
    for arrived in run_tasks(
        compute_member, (Study(study.drawn, study.uncertainty, study.seed), frame), indices, executor, workers
    ):
        if arrived is None:
            yield None
            continue
        index, member = arrived
        yield frame.member(index, {}, str(member)) if isinstance(member, Lost) else member


def complete(frame: Frame, members: Iterable[Member]) -> list[Member]:
    """Members whose arrays fit the frame; others come from another version of the section or of seiswidgets."""
    shapes = (len(frame.labels),), (len(frame.horizons), len(frame.x)), frame.nodes.shape[:2]
    return [one for one in members if (one.values.shape, one.depths.shape, one.ratio.shape) == shapes]
