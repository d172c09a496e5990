"""Matrices from NumPy's .npy and .npz and from text. Nothing in a file is unpickled or evaluated."""

import lzma
import re
import tokenize
import warnings
import zipfile
import zlib
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from functools import partial
from io import BytesIO
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
SMALL = 2**16  # bytes of an array that a preview reads, and of a header
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
    arrays = _read_arrays(path)
    amplitude, stored = _matrix(path, arrays), _stored_fields(arrays)
    if {"dx", "dz"} <= stored.keys() and options.keywords.get("extent") is None:
        return make_section(path, amplitude, options, **stored | options.given(AXIS_OPTIONS))
    return make_section(path, amplitude, options, **stored | options.axes(path, amplitude.shape))


def preview_array(path: Path, options: OpenOptions) -> SectionInfo:
    """Summarise an array file by the headers of its arrays."""
    options.refuse(SEGY_OPTIONS, "an array")
    arrays = _read_arrays(path, headers_only=True)
    array, stored = _matrix(path, arrays), _stored_fields(arrays)
    needed = [] if {"dx", "dz"} <= stored.keys() else [AXES_NEEDED]
    needed += [] if "velocity" in stored or stored.get("z_unit") in tuple(METRES) else [TIME_OR_DEPTH]
    shape = cast(tuple[int, int], array.shape)
    return SectionInfo(path, "array", str(array.dtype), path.stat().st_size, shape, tuple(needed))


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
    rows = columns = 0
    with _read_errors_as_data_errors(path, TEXT_FORMAT), path.open(encoding="utf-8-sig") as file:
        for count, line in enumerate(iter(partial(file.readline, MOST_ROW_CHARACTERS), ""), 1):
            row = _without_comment(line)
            if row and not rows:
                columns = _count_numbers(path, count, row, _delimiter(path, row))
            rows += bool(row)
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


def _read_arrays(path: Path, headers_only: bool = False) -> dict[str, np.ndarray]:
    """Arrays of an .npy or .npz file, by name; with ``headers_only``, matrices of the right shape without content."""
    with _read_errors_as_data_errors(path, WRITE_AGAIN), path.open("rb") as file:
        if zipfile.is_zipfile(file):
            return _read_npz(path, file, headers_only)
        file.seek(0)
        return {"": _read_array(str(path), file, path.stat().st_size, headers_only)}


def _read_npz(path: Path, file: BinaryIO, headers_only: bool) -> dict[str, np.ndarray]:
    """Arrays of an .npz file, by name; beside an amplitude only the section's fields."""
    with zipfile.ZipFile(file) as archive:
        infos = {info.filename.removesuffix(".npy"): info for info in archive.infolist()}
        if "amplitude" in infos:
            infos = {name: infos[name] for name in ("amplitude", *STORED) if name in infos}
        check_memory(path, (sum(info.file_size for info in infos.values()),), itemsize=1)
        arrays = {}
        for name, info in infos.items():
            with archive.open(info) as member:
                without_content = headers_only and info.file_size > SMALL
                stream = cast(BinaryIO, member)
                arrays[name] = _read_array(f"{path}: {name}", stream, info.file_size, without_content)
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


def _read_array(name: str, file: BinaryIO, size: int, header_only: bool) -> np.ndarray:
    """Read an array of numbers or strings in NumPy's format, or only its shape and dtype."""
    shape, column_major, dtype = _read_header(name, file, size)
    if header_only:
        return np.broadcast_to(np.zeros((), dtype), shape)  # takes the memory of one element
    return np.frombuffer(file.read(), dtype).reshape(shape, order="F" if column_major else "C")


def _read_header(name: str, file: BinaryIO, size: int) -> tuple[tuple[int, ...], bool, np.dtype]:
    """Shape, order and dtype of an array in NumPy's format, checked against its size before more of it is read."""
    version = npy.read_magic(file)
    if version not in ((1, 0), (2, 0)):
        raise DataError(f"{name} is in version {version} of NumPy's format, which no matrix of numbers needs")
    read = npy.read_array_header_1_0 if version == (1, 0) else npy.read_array_header_2_0
    length = file.read(2 if version == (1, 0) else 4)
    text = file.read(min(int.from_bytes(length, "little"), SMALL))
    shape, column_major, dtype = read(BytesIO(length + text))
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


def _read_numbers(path: Path) -> np.ndarray:
    """Numbers of a text file, float64, whichever its delimiter is."""
    size = path.stat().st_size
    if size > MOST_TEXT_BYTES:
        raise DataError(
            f"{path} is a text file of {size:,} bytes; the limit is {MOST_TEXT_BYTES:,}: save it with numpy.save "
            "instead"
        )
    with _read_errors_as_data_errors(path, TEXT_FORMAT):
        with path.open(encoding="utf-8-sig") as file:
            lines = map(_without_comment, iter(partial(file.readline, MOST_ROW_CHARACTERS), ""))
            delimiter = _delimiter(path, next(filter(None, lines), ""))
        try:
            return np.loadtxt(path, delimiter=delimiter, ndmin=2, encoding="utf-8-sig")
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
            values = sum(1 for _ in _values(row, delimiter))
            width = width or values
            if values != width:
                raise DataError(f"{path}: row {count} has {values} values, and those before it {width}; {TEXT_FORMAT}")
            _count_numbers(path, count, row, delimiter)


def _delimiter(path: Path, first: str) -> str | None:
    """The mark that separates the values of the first row; None for white space."""
    if len(first) >= MOST_ROW_CHARACTERS - 1:
        raise DataError(
            f"{path} has a first row of {MOST_ROW_CHARACTERS:,} characters or more; write one row for each sample"
        )
    return next(mark for mark in DELIMITERS if mark is None or mark in first)


def _values(row: str, delimiter: str | None) -> Iterator[str]:
    """Iterate over the values of a row, one by one: as a list they would take much more memory than the row."""
    pattern = r"\S+" if delimiter is None else f"(?:^|(?<={delimiter}))[^{delimiter}]*"
    return (match[0].strip() for match in re.finditer(pattern, row))


def _count_numbers(path: Path, count: int, row: str, delimiter: str | None) -> int:
    """Number of values in a row; DataError for the first one that is not a number."""
    column = 0
    for column, value in enumerate(_values(row, delimiter), 1):
        try:
            float(value)
        except ValueError:
            raise DataError(
                f"{path}: row {count}, value {column} must be a number, but is {brief(value)}; {TEXT_FORMAT}"
            ) from None
    return column


def _without_comment(line: str) -> str:
    return line.partition("#")[0].strip()
