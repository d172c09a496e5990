"""Matrices from NumPy's .npy and .npz and from text. Nothing in a file is unpickled or evaluated."""

import lzma
import tokenize
import warnings
import zipfile
import zlib
from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager
from math import prod
from pathlib import Path
from reprlib import repr as brief
from typing import Any, BinaryIO, cast

import numpy as np
from numpy.lib import format as npy

from seiswidgets.errors import DataError, SeiswidgetsError
from seiswidgets.geology.section import METRES, Section
from seiswidgets.io.document import shortened
from seiswidgets.io.info import TIME_OR_DEPTH, SectionInfo
from seiswidgets.io.options import (
    AXIS_OPTIONS,
    DAMAGED,
    SEGY_OPTIONS,
    OpenOptions,
    Progress,
    check_memory,
    check_shape,
    make_section,
)

STORED = ("dx", "dz", "x0", "z0", "x_unit", "z_unit", "velocity", "name", "credit")  # beside the amplitude, in .npz
MOST_TEXT_BYTES, MOST_ROW_CHARACTERS = 2**28, 2**24
AXES_NEEDED = "extent, or dx and dz"  # an entry of ``SectionInfo.needed``
WRITE_AGAIN = "write it again"
TEXT_FORMAT = (
    "write its numbers with a decimal point, separated by spaces, commas or semicolons, with nan where there are no "
    "data and # before headings, in UTF-8"
)
DELIMITERS = (";", ",", None)  # None: white space


def open_array(path: Path, options: OpenOptions, _progress: Progress | None) -> Section:
    """Open an .npy file, or an .npz file that ``save_section`` wrote or that holds a single matrix.

    Raises
    ------
    DataError
        If the file is damaged, holds Python objects, or no matrix of real numbers.
    SettingError
        If its axes or units are neither given nor in the file.
    """
    options.refuse(SEGY_OPTIONS, "an array")
    with _read_errors_as_data_errors(path, WRITE_AGAIN), path.open("rb") as file:
        if zipfile.is_zipfile(file):
            arrays = _read_npz(path, file)
        else:
            file.seek(0)
            arrays = {"": _read_array(str(path), file, path.stat().st_size)}
    amplitude, stored = _matrix(path, arrays), _stored_fields(arrays)
    if {"dx", "dz"} <= stored.keys() and options.keywords.get("extent") is None:
        return make_section(path, amplitude, options, **stored | options.given(AXIS_OPTIONS))
    return make_section(path, amplitude, options, **stored | options.axes(path, amplitude.shape))


def preview_array(path: Path, options: OpenOptions) -> SectionInfo:
    """Summarise an array file by its header; an .npz file has to be read."""
    options.refuse(SEGY_OPTIONS, "an array")
    stored: dict[str, Any] = {}
    with _read_errors_as_data_errors(path, WRITE_AGAIN), path.open("rb") as file:
        if zipfile.is_zipfile(file):
            arrays = _read_npz(path, file)
            array, stored = _matrix(path, arrays), _stored_fields(arrays)
            shape, dtype = array.shape, array.dtype
        else:
            file.seek(0)
            shape, _, dtype = _read_header(str(path), file, path.stat().st_size)
            check_shape(path, shape)
    needed = [] if {"dx", "dz"} <= stored.keys() else [AXES_NEEDED]
    needed += [] if "velocity" in stored or stored.get("z_unit") in tuple(METRES) else [TIME_OR_DEPTH]
    return SectionInfo(path, "array", str(dtype), path.stat().st_size, cast(tuple[int, int], shape), tuple(needed))


def open_text(path: Path, options: OpenOptions, _progress: Progress | None) -> Section:
    """Open a text matrix: one row per sample and one column per trace, with # before comments.

    Columns are separated by white space, commas or semicolons.

    Raises
    ------
    DataError
        If the text is not a matrix of numbers.
    SettingError
        If its axes or units are not given.
    """
    options.refuse(SEGY_OPTIONS, "a text")
    options.time_or_depth(path)
    amplitude = _read_numbers(path)
    return make_section(path, amplitude, options, **options.axes(path, amplitude.shape))


def preview_text(path: Path, options: OpenOptions) -> SectionInfo:
    """Summarise a text matrix; only its first row is read as numbers."""
    options.refuse(SEGY_OPTIONS, "a text")
    columns = _read_numbers(path, rows=1).shape[-1]
    with _read_errors_as_data_errors(path, TEXT_FORMAT), path.open(encoding="utf-8-sig") as file:
        rows = sum(bool(_without_comment(line)) for line in file)
    check_shape(path, (rows, columns))
    return SectionInfo(path, "text", "numbers", path.stat().st_size, (rows, columns), (AXES_NEEDED, TIME_OR_DEPTH))


@contextmanager
def _read_errors_as_data_errors(path: Path, remedy: str) -> Iterator[None]:
    """Turn any error of a reader into a DataError that names the file and a remedy."""
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # about old headers and empty texts, which are checked here
            yield
    except SeiswidgetsError:
        raise
    except (*DAMAGED, tokenize.TokenError, lzma.LZMAError, zipfile.BadZipFile, zlib.error) as error:
        raise DataError(f"{path} is damaged, or not a matrix of numbers: {shortened(str(error))}; {remedy}") from error


def _read_npz(path: Path, file: BinaryIO) -> dict[str, np.ndarray]:
    """Arrays of an .npz file, by name; beside an amplitude only the section's fields."""
    with zipfile.ZipFile(file) as archive:
        infos = {info.filename.removesuffix(".npy"): info for info in archive.infolist()}
        if "amplitude" in infos:
            infos = {name: infos[name] for name in ("amplitude", *STORED) if name in infos}
        check_memory(path, (sum(info.file_size for info in infos.values()),), itemsize=1)
        arrays = {}
        for name, info in infos.items():
            with archive.open(info) as member:
                arrays[name] = _read_array(f"{path}: {name}", cast(BinaryIO, member), info.file_size)
    return arrays


def _stored_fields(arrays: Mapping[str, np.ndarray]) -> dict[str, Any]:
    """Fields of the section in an .npz file; name and credit are made strings."""
    fields = {name: arrays[name].item() for name in STORED if name in arrays and arrays[name].ndim == 0}
    return fields | {name: str(fields[name]) for name in ("name", "credit") if name in fields}


def _matrix(path: Path, arrays: Mapping[str, np.ndarray]) -> np.ndarray:
    """The array called "amplitude", or the only matrix in the file."""
    matrices = [array for array in arrays.values() if array.ndim == 2]
    array = arrays.get("amplitude", matrices[0] if len(matrices) == 1 else None)
    if array is None or array.dtype.kind not in "fiub":
        contents = ", ".join(f"{name or 'one'} of shape {array.shape}" for name, array in arrays.items())
        raise DataError(
            f"{path} must hold one matrix of real numbers, or one called 'amplitude', but holds "
            f"{shortened(contents) or 'no array'}: write it that way"
        )
    check_shape(path, array.shape)
    return array


def _read_array(name: str, file: BinaryIO, size: int) -> np.ndarray:
    """Read an array of numbers or strings in NumPy's format."""
    shape, column_major, dtype = _read_header(name, file, size)
    return np.frombuffer(file.read(), dtype).reshape(shape, order="F" if column_major else "C")


def _read_header(name: str, file: BinaryIO, size: int) -> tuple[tuple[int, ...], bool, np.dtype]:
    """Shape, order and dtype of an array in NumPy's format, checked against its size before more of it is read."""
    version = npy.read_magic(file)
    if version not in ((1, 0), (2, 0)):
        raise DataError(f"{name} is in version {version} of NumPy's format, which no matrix of numbers needs")
    read = npy.read_array_header_1_0 if version == (1, 0) else npy.read_array_header_2_0
    shape, column_major, dtype = read(file)
    if dtype.kind not in "fiubU":
        raise DataError(f"{name} holds {dtype}, not real numbers; nothing else is read from an array file")
    itemsize = dtype.itemsize if dtype == np.float32 else max(dtype.itemsize, 8)  # as the section will hold it
    check_memory(Path(name), shape, itemsize)
    count, left = dtype.itemsize * prod(shape), size - file.tell()
    if min(shape, default=0) < 0 or count != left:
        raise DataError(
            f"{name} claims to hold an array of shape {shape}, {count} bytes, but has {left} after its header; "
            "it is truncated or damaged: write it again"
        )
    return shape, column_major, dtype


def _read_numbers(path: Path, rows: int | None = None) -> np.ndarray:
    """Numbers of a text file, float64, whichever its delimiter is."""
    size = path.stat().st_size
    if size > MOST_TEXT_BYTES:
        raise DataError(
            f"{path} is a text file of {size:,} bytes; the limit is {MOST_TEXT_BYTES:,}: save it with numpy.save "
            "instead"
        )
    with _read_errors_as_data_errors(path, TEXT_FORMAT):
        with path.open(encoding="utf-8-sig") as file:
            first = next((line for line in file if _without_comment(line)), "")
        if len(first) > MOST_ROW_CHARACTERS:
            raise DataError(f"{path} has a first row of {len(first):,} characters; write one row for each sample")
        delimiter = next(mark for mark in DELIMITERS if mark is None or mark in _without_comment(first))
        try:
            return np.loadtxt(path, delimiter=delimiter, ndmin=2, max_rows=rows, encoding="utf-8-sig")
        except UnicodeDecodeError:
            raise
        except ValueError:
            _raise_first_bad_row(path, delimiter)
            raise


def _raise_first_bad_row(path: Path, delimiter: str | None) -> None:
    """Raise DataError for the first row that contains other things than numbers, or whose length differs."""
    width = None
    with path.open(encoding="utf-8-sig") as file:
        for count, line in enumerate(file, 1):
            if not (row := _without_comment(line)):
                continue
            values = row.split(delimiter)
            width = width or len(values)
            if len(values) != width:
                raise DataError(
                    f"{path}: row {count} has {len(values)} values, and those before it {width}; {TEXT_FORMAT}"
                )
            if not _are_numbers(values):
                column, value = next(pair for pair in enumerate(values, 1) if not _are_numbers(pair[1:]))
                raise DataError(
                    f"{path}: row {count}, value {column} must be a number, but is {brief(value.strip())}; "
                    f"{TEXT_FORMAT}"
                )


def _without_comment(line: str) -> str:
    return line.partition("#")[0].strip()


def _are_numbers(texts: Iterable[str]) -> bool:
    try:
        list(map(float, texts))
    except ValueError:
        return False
    return True
