"""Ensembles and scans of a saved session, computed without a notebook and written to a file."""

from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import Executor
from contextlib import contextmanager
from dataclasses import asdict, replace
from pathlib import Path
from typing import Any

from seiswidgets.errors import DataError, SeiswidgetsError
from seiswidgets.geology.ensembles.ensemble import Ensemble
from seiswidgets.geology.ensembles.uncertainty import Uncertainty
from seiswidgets.geology.parallel import run_tasks
from seiswidgets.geology.picks import Interpretation
from seiswidgets.geology.scan import scan
from seiswidgets.geology.section import Section
from seiswidgets.io.document import json_text
from seiswidgets.io.ensembles import MemberProgress, ensemble
from seiswidgets.io.exports.ensembles import write_ensemble
from seiswidgets.io.files import import_optional, output_path, write_file
from seiswidgets.io.session.session import open_session

PATIENCE = 10.0  # seconds that a scheduler has to answer


def study_session(
    path: Path,
    out: Path,
    uncertainty: Uncertainty,
    members: int,
    seed: int = 0,
    *,
    matches: Sequence[str] = (),
    workers: int | None = None,
    scheduler: str | None = None,
    progress: MemberProgress | None = None,
    allow_outside: bool = False,
    allow_changed: bool = False,
) -> Ensemble:
    """Compute the ensemble of the session in a file, and write it as NetCDF.

    Until it is complete, its members are kept beside it in ``<out>.part``, from which another run continues.

    Parameters
    ----------
    path, out : Path
    uncertainty, members, seed, workers, progress
        As for `ensemble`.
    matches : list of str
        Names of faults that are scanned; each member takes one of the peaks.
    scheduler : str, optional
        Address of a scheduler of Dask, whose workers compute the members.
    allow_outside, allow_changed : bool
        As for `open_session` and `Session.restore`.

    Raises
    ------
    SeiswidgetsError
        Any of its subclasses.
    """
    out = output_path(out, (".nc",))
    import_optional("xarray", f"to write {out.name}")
    session = open_session(path, allow_outside=allow_outside)
    section, picks = session.open_section(allow_changed=allow_changed), session.interpretation
    uncertainty = replace(uncertainty, matches={name: scan(section, picks.fault(name)) for name in matches})
    partial = out.with_name(f"{out.name}.part")
    task = section, picks, session.plan, uncertainty, members, seed
    with dask_executor(scheduler) as executor:
        result = ensemble(*task, executor, workers=workers, partial=partial, progress=progress)
    write_ensemble(result, out)
    partial.unlink()
    return result


def scan_session(
    path: Path,
    out: Path,
    *,
    workers: int | None = None,
    scheduler: str | None = None,
    progress: Callable[[int, int], object] | None = None,
    allow_outside: bool = False,
    allow_changed: bool = False,
) -> list[dict[str, Any]]:
    """Scan the faults of the session in a file, and write the curves and their peaks as JSON.

    Parameters
    ----------
    path, out : Path
    workers, scheduler, allow_outside, allow_changed
        As for `study_session`.
    progress : callable(done, faults), optional

    Returns
    -------
    list of dict
        For each fault what the file says; a fault that cannot be scanned has the reason as "refused".

    Raises
    ------
    SeiswidgetsError
        Any of its subclasses.
    """
    out = output_path(out, (".json",))
    session = open_session(path, allow_outside=allow_outside)
    section, picks = session.open_section(allow_changed=allow_changed), session.interpretation
    count, found = len(picks.faults), dict[int, dict[str, Any]]()
    with dask_executor(scheduler) as executor:
        for arrived in run_tasks(_scan_fault, (section, picks), range(count), executor, workers):
            if arrived is not None:
                index, result = arrived
                found[index] = result if isinstance(result, dict) else {"refused": str(result)}
                if progress is not None:
                    progress(len(found), count)
    results = [{"fault": fault.name, **found[index]} for index, fault in enumerate(picks.faults)]
    write_file(out, json_text({"session": str(path), "faults": results}).encode())
    return results


def _scan_fault(content: tuple[Section, Interpretation], index: int) -> dict[str, Any]:
    """The scan of a fault as plain values."""
    section, picks = content
    try:
        found = scan(section, picks.faults[index], picks.horizons)
    except SeiswidgetsError as error:
        return {"refused": str(error)}
    return {
        "slip varies": found.best.kind,
        "slip": found.slip.tolist(),
        "correlation": found.correlation.tolist(),
        "peaks": [asdict(peak) for peak in found.peaks],
        "findings": [str(finding.text) for finding in found.findings],
    }


@contextmanager
def dask_executor(address: str | None) -> Iterator[Executor | None]:
    """The executor of a Dask cluster; None without an address.

    Raises
    ------
    DataError
        If Dask is not installed, or no scheduler answers.
    """
    if address is None:
        yield None
        return
    distributed = import_optional("distributed", "to use a cluster", extra="cluster")
    try:
        client = distributed.Client(address, timeout=PATIENCE)
    except (OSError, ValueError) as error:
        raise DataError(f"no scheduler of Dask answers at {address}: {error}; check that it runs there") from error
    with client, client.get_executor() as executor:
        yield executor
