"""Readers of the original files of the real sections; amplitudes come as (samples, traces)."""

from pathlib import Path

import numpy as np

from seiswidgets.errors import DataError


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
