"""Ensembles of a saved session, computed without a notebook and written to a file."""

from collections.abc import Iterator
from concurrent.futures import Executor
from contextlib import contextmanager
from pathlib import Path

from seiswidgets.errors import DataError
from seiswidgets.geology.ensembles.ensemble import Ensemble
from seiswidgets.geology.ensembles.uncertainty import Uncertainty
from seiswidgets.io.ensembles import MemberProgress, ensemble
from seiswidgets.io.exports.ensembles import write_ensemble
from seiswidgets.io.files import import_optional, output_path
from seiswidgets.io.session.session import open_session

PATIENCE = 10.0  # seconds that a scheduler has to answer


def study_session(
    path: Path,
    out: Path,
    uncertainty: Uncertainty,
    members: int,
    seed: int = 0,
    *,
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
    section = session.open_section(allow_changed=allow_changed)
    partial = out.with_name(f"{out.name}.part")
    task = section, session.interpretation, session.plan, uncertainty, members, seed
    with dask_executor(scheduler) as executor:
        result = ensemble(*task, executor, workers=workers, partial=partial, progress=progress)
    write_ensemble(result, out)
    partial.unlink()
    return result


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
