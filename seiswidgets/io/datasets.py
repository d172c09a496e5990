"""Real sections, by name.

The package contains no data. A file is searched for in the folder named by the environment variable
``SEISWIDGETS_DATA_DIR``, then in a cache; otherwise it is downloaded from its publisher. Its SHA-256 is checked, so
that it is read exactly as it was published.
"""

import os
from dataclasses import dataclass
from hashlib import file_digest
from pathlib import Path

import numpy as np

from seiswidgets.errors import DataError
from seiswidgets.geology.section import Section

FOLDER_VARIABLE = "SEISWIDGETS_DATA_DIR"
HOST = "https://raw.githubusercontent.com"


@dataclass(frozen=True)
class Source:
    """A file in a public repository, at one commit.

    Parameters
    ----------
    repository, commit, path : str
        Location of the published file.
    sha256 : str
        Hash of the file, in hexadecimal.
    host : str
        Server of the repository.
    """

    repository: str
    commit: str
    path: str
    sha256: str
    host: str = HOST

    @property
    def name(self) -> str:
        """File name without its folders."""
        return self.path.rpartition("/")[2]

    @property
    def url(self) -> str:
        """Download address."""
        return f"{self.host}/{self.repository}/{self.commit}/{self.path}"


F3 = Source(
    repository="seg/tutorials-2017",
    commit="b38f798866dd4e1a38c78cfd45edb7b2cfd3d785",
    path="1710_Colored_inversion/data/export_inline362.ascii",
    sha256="a4a03b1e452c93d8dfcf8cde151b89b28bf6df4fc1382500ceffdc440027caa5",
)
TEAPOT = Source(
    repository="dhale/jtk",
    commit="881408f2afd0a012efd28686ee600aeb6459eb77",
    path="demo/data/tp73.dat",
    sha256="0f6d5e56b3623fe6f7b55f529278387455f8d68e197db0b4f24bda5cd1a21237",
)


def f3(velocity: float = 2000.0) -> Section:
    """Inline 362 of the F3 block, Dutch North Sea: 951 traces, 25 m apart, each with 463 samples, 4 ms apart.

    Credit: dGB Earth Sciences and TNO, CC BY-SA 3.0.

    Parameters
    ----------
    velocity : float
        Seismic velocity in m/s; 2,000 suits its shallow, soft sediment.

    Raises
    ------
    DataError
        If the file is damaged, or neither available locally nor downloadable; the message says where to put it.
    """
    return Section(
        read_ascii_inline(find_file(F3), shape=(463, 951)),
        dx=25.0,
        dz=4.0,
        z_unit="ms",
        velocity=velocity,
        name="F3, inline 362",
        credit="dGB Earth Sciences and TNO, CC BY-SA 3.0",
    )


def teapot(velocity: float = 3600.0) -> Section:
    """Section across Teapot Dome, Wyoming: 357 traces, 25 m apart, each with 251 samples, 4 ms apart, from 500 ms.

    Credit: RMOTC, U.S. Department of Energy; from dhale/jtk, Apache-2.0.

    Parameters
    ----------
    velocity : float
        Seismic velocity in m/s; 3,600 suits its well-compacted rock.

    Raises
    ------
    DataError
        If the file is damaged, or neither available locally nor downloadable; the message says where to put it.
    """
    return Section(
        read_raw_traces(find_file(TEAPOT), shape=(251, 357)),
        dx=25.0,
        dz=4.0,
        z0=500.0,
        z_unit="ms",
        velocity=velocity,
        name="Teapot Dome",
        credit="RMOTC, U.S. Department of Energy; from dhale/jtk, Apache-2.0",
    )


def find_file(source: Source, cache: Path | None = None) -> Path:
    """Find a published file in the user's folder or in the cache, downloading it into the cache if necessary.

    Parameters
    ----------
    source : Source
    cache : Path, optional
        Folder of the cache; the system's usual one if left out.

    Raises
    ------
    DataError
        If the user's folder does not exist, a file in it is not the one expected, or the download fails.
    """
    folder = _user_folder()
    if folder is not None and (folder / source.name).exists():
        return _verified(folder / source.name, source)
    return _downloaded(source, cache)


def _user_folder() -> Path | None:
    value = os.environ.get(FOLDER_VARIABLE)
    if not value:
        return None
    folder = Path(value).expanduser()
    if not folder.is_dir():
        raise DataError(f"{FOLDER_VARIABLE} is set to {value!r}, which is not a folder; correct it or unset it")
    return folder


def _verified(path: Path, source: Source) -> Path:
    try:
        with path.open("rb") as file:
            sha256 = file_digest(file, "sha256").hexdigest()
    except OSError as error:
        raise DataError(f"{path} cannot be read: {error}") from error
    if sha256 != source.sha256:
        raise DataError(
            f"{path} is damaged or another version: its SHA-256 must be {source.sha256}, but is {sha256}. "
            f"Replace it with {source.url}, or remove it to have that downloaded"
        )
    return path


def _downloaded(source: Source, cache: Path | None) -> Path:
    import pooch  # imported here: it takes as long as everything else together, and most sessions download nothing

    cache = Path(pooch.os_cache("seiswidgets") if cache is None else cache)
    try:
        path = pooch.retrieve(source.url, known_hash=f"sha256:{source.sha256}", fname=source.name, path=cache)
    except (OSError, ValueError) as error:  # pooch raises ValueError if the hash differs
        raise DataError(_out_of_reach(source, cache, error)) from error
    return Path(path)


def _out_of_reach(source: Source, cache: Path, error: Exception) -> str:
    value = os.environ.get(FOLDER_VARIABLE)
    folder = f"the folder {value} ({FOLDER_VARIABLE})" if value else f"your own folder ({FOLDER_VARIABLE} is not set)"
    return (
        f"{source.name} is neither in {folder} nor in the cache {cache}, and could not be downloaded. "
        f"Download it from {source.url} and put it into {cache}, or into another folder and set {FOLDER_VARIABLE} "
        f"to that folder. The download failed with {type(error).__name__}: {error}"
    )


def read_ascii_inline(path: Path, shape: tuple[int, int]) -> np.ndarray:
    """Read an inline exported as text: one line per trace, with its inline and crossline numbers, then its samples.

    Traces are sorted by crossline; no crossline may be missing.

    Parameters
    ----------
    path : Path
    shape : (int, int)
        Number of samples and traces, (nz, nx), that it must hold.

    Returns
    -------
    array of float32, shape (nz, nx)

    Raises
    ------
    DataError
        If the file does not hold that many numbers, or a crossline is missing or repeated.
    """
    nz, nx = shape
    try:
        lines = np.loadtxt(path, dtype=np.float32, ndmin=2)
    except ValueError as error:
        raise DataError(f"{path} is not a text file of {nx} traces of equal length: {error}") from error
    if lines.shape != (nx, nz + 2):
        raise DataError(
            f"{path} must hold {nx} lines of {nz + 2} numbers (inline, crossline, {nz} samples), "
            f"but holds {lines.shape[0]} lines of {lines.shape[1]}; it is truncated, or another version"
        )
    traces = lines[np.argsort(lines[:, 1])]
    if not (np.diff(traces[:, 1]) == 1).all():
        raise DataError(f"{path} lacks a crossline between its first and last one, or holds one twice")
    return np.ascontiguousarray(traces[:, 2:].T)


def read_raw_traces(path: Path, shape: tuple[int, int]) -> np.ndarray:
    """Read a file of big-endian 32-bit floats, trace by trace, without headers.

    Parameters
    ----------
    path : Path
    shape : (int, int)
        Number of samples and traces, (nz, nx), that it must hold.

    Returns
    -------
    array of float32, shape (nz, nx)

    Raises
    ------
    DataError
        If the file has another size.
    """
    nz, nx = shape
    size, expected = path.stat().st_size, 4 * nz * nx
    if size != expected:
        raise DataError(
            f"{path} must hold {expected} bytes ({nx} traces of {nz} samples of 4 bytes), but holds {size}; "
            "it is truncated, or another version"
        )
    traces = np.fromfile(path, dtype=">f4").reshape(nx, nz)
    return np.ascontiguousarray(traces.T, dtype=np.float32)
