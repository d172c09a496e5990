"""Real sections, by name.

No data come with the package. A file is looked for in the folder that the environment variable
``SEISWIDGETS_DATA_DIR`` names, then in a cache, and is else fetched from where its owner published it; each by its
SHA-256, so that what is read is what was published, byte for byte.
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
        Where it was published.
    sha256 : str
        Its hash, in hexadecimal.
    host : str
        Where its repository is served from.
    """

    repository: str
    commit: str
    path: str
    sha256: str
    host: str = HOST

    @property
    def name(self) -> str:
        """The file's own name."""
        return self.path.rpartition("/")[2]

    @property
    def url(self) -> str:
        """The address to download it from."""
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
    """Inline 362 of the F3 block, Dutch North Sea: 951 traces, 25 m apart, of 463 samples of 4 ms.

    Credit: dGB Earth Sciences and TNO, CC BY-SA 3.0.

    Parameters
    ----------
    velocity : float
        Velocity of sound in the rock, in m/s; 2,000 suits its shallow, soft sediment.

    Raises
    ------
    DataError
        If the file is damaged, or neither here nor to be downloaded; the message says where to put it by hand.
    """
    return Section(
        read_ascii_inline(located(F3), shape=(463, 951)),
        dx=25.0,
        dz=4.0,
        z_unit="ms",
        velocity=velocity,
        name="F3, inline 362",
        credit="dGB Earth Sciences and TNO, CC BY-SA 3.0",
    )


def teapot(velocity: float = 3600.0) -> Section:
    """Section of Teapot Dome, Wyoming: 357 traces, 25 m apart, of 251 samples of 4 ms, from 500 ms down.

    Credit: RMOTC, U.S. Department of Energy; from dhale/jtk, Apache-2.0.

    Parameters
    ----------
    velocity : float
        Velocity of sound in the rock, in m/s; 3,600 suits its well-compacted rock.

    Raises
    ------
    DataError
        If the file is damaged, or neither here nor to be downloaded; the message says where to put it by hand.
    """
    return Section(
        read_raw_traces(located(TEAPOT), shape=(251, 357)),
        dx=25.0,
        dz=4.0,
        z0=500.0,
        z_unit="ms",
        velocity=velocity,
        name="Teapot Dome",
        credit="RMOTC, U.S. Department of Energy; from dhale/jtk, Apache-2.0",
    )


def located(source: Source, cache: Path | None = None) -> Path:
    """Path of a source's file: in the user's folder, or in the cache, downloaded into it if need be.

    Parameters
    ----------
    source : Source
        What to look for.
    cache : Path, optional
        The cache's folder; else the usual one of this system.

    Raises
    ------
    DataError
        If the user's folder does not exist, a file in it is not the one expected, or the download fails.
    """
    folder = _user_folder()
    if folder is not None and (folder / source.name).exists():
        return _verified(folder / source.name, source)
    return _downloaded(source, cache)


def _user_folder():
    value = os.environ.get(FOLDER_VARIABLE)
    if not value:
        return None
    folder = Path(value).expanduser()
    if not folder.is_dir():
        raise DataError(f"{FOLDER_VARIABLE} is set to {value!r}, which is not a folder; correct it or unset it")
    return folder


def _verified(path, source):
    try:
        with path.open("rb") as file:
            sha256 = file_digest(file, "sha256").hexdigest()
    except OSError as error:
        raise DataError(f"{path} cannot be read: {error}") from error
    if sha256 != source.sha256:
        raise DataError(
            f"{path} is damaged or another version: its SHA-256 must be {source.sha256}, but is {sha256}. "
            f"Replace it by {source.url}, or take it away to have that downloaded"
        )
    return path


def _downloaded(source, cache):
    import pooch  # here, since it takes as long to import as all the rest, and most sessions need no download

    cache = Path(pooch.os_cache("seiswidgets") if cache is None else cache)
    try:
        found = pooch.retrieve(source.url, known_hash=f"sha256:{source.sha256}", fname=source.name, path=cache)
    except (OSError, ValueError) as error:  # pooch's word for a hash that differs is ValueError
        raise DataError(_out_of_reach(source, cache, error)) from error
    return Path(found)


def _out_of_reach(source, cache, error):
    value = os.environ.get(FOLDER_VARIABLE)
    looked = f"the folder {value} ({FOLDER_VARIABLE})" if value else f"a folder of yours ({FOLDER_VARIABLE} is not set)"
    return (
        f"{source.name} is neither in {looked} nor in the cache {cache}, and could not be downloaded. "
        f"Fetch it by hand from {source.url} and put it into {cache}, or into a folder that {FOLDER_VARIABLE} names. "
        f"The download ended with {type(error).__name__}: {error}"
    )


def read_ascii_inline(path: Path, shape: tuple[int, int]) -> np.ndarray:
    """Amplitudes of an inline exported as text: a line a trace, its inline and crossline number, then its samples.

    Traces are put in the order of their crosslines, which must follow each other without a gap.

    Parameters
    ----------
    path : Path
        The text file.
    shape : (int, int)
        Number of samples and of traces, (nz, nx), that it must hold.

    Returns
    -------
    array of float32, shape (nz, nx)

    Raises
    ------
    DataError
        If the file does not hold numbers, or not that many, or lacks or repeats a crossline.
    """
    nz, nx = shape
    try:
        lines = np.loadtxt(path, dtype=np.float32, ndmin=2)
    except ValueError as error:
        raise DataError(f"{path} is not a text of {nx} traces of equal length: {error}") from error
    if lines.shape != (nx, nz + 2):
        raise DataError(
            f"{path} must hold {nx} lines of {nz + 2} numbers (inline, crossline, {nz} samples), "
            f"but holds {lines.shape[0]} of {lines.shape[1]}; it was cut short, or is another version"
        )
    traces = lines[np.argsort(lines[:, 1])]
    if not (np.diff(traces[:, 1]) == 1).all():
        raise DataError(f"{path} lacks a crossline between the first and the last, or holds one twice")
    return np.ascontiguousarray(traces[:, 2:].T)


def read_raw_traces(path: Path, shape: tuple[int, int]) -> np.ndarray:
    """Amplitudes of a file that is nothing but big-endian 32-bit floats, trace by trace.

    Parameters
    ----------
    path : Path
        The binary file.
    shape : (int, int)
        Number of samples and of traces, (nz, nx), that it must hold.

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
            "it was cut short, or is another version"
        )
    traces = np.fromfile(path, dtype=">f4").reshape(nx, nz)
    return np.ascontiguousarray(traces.T, dtype=np.float32)
