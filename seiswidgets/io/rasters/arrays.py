"""Matrices in: NumPy's .npy and .npz, and text. Nothing in them is unpickled or evaluated."""

import lzma
import tokenize
import warnings
import zipfile
import zlib
from contextlib import contextmanager
from math import prod
from pathlib import Path
from reprlib import repr as brief

import numpy as np
from numpy.lib import format as npy

from seiswidgets.errors import DataError, SeiswidgetsError
from seiswidgets.geology.section import METRES, Section
from seiswidgets.io.document import shortened
from seiswidgets.io.info import HEIGHT, SectionInfo
from seiswidgets.io.options import (
    DAMAGED,
    OF_AXES,
    OF_SEGY,
    OpenOptions,
    Progress,
    checked_shape,
    checked_size,
    section_of,
)

STORED = ("dx", "dz", "x0", "z0", "x_unit", "z_unit", "velocity", "name", "credit")  # beside the amplitude, in .npz
MOST_TEXT, MOST_ROW = 2**28, 2**24  # bytes of a text file, and characters of its first row
AXES = "extent, or dx and dz"  # that a file does not say
ANEW = "write it anew"
PLAIN = (
    "write its numbers with a decimal point, parted by blanks, commas or semicolons, nan where there is none and # "
    "before headings, as UTF-8"
)
DELIMITERS = (";", ",", None)  # None: blanks


def open_array(path: Path, choices: OpenOptions, _progress: Progress | None) -> Section:
    """A section of an .npy file, or of an .npz file: one of ``save_section``, or one that holds a single matrix.

    Raises
    ------
    DataError
        If the file is damaged, holds objects, or no matrix of real numbers.
    SettingError
        If its axes or units are neither said nor in the file.
    """
    choices.refuse(OF_SEGY, "an array")
    with _honest(path, ANEW), path.open("rb") as file:
        if zipfile.is_zipfile(file):
            arrays = _of_npz(path, file)
        else:
            file.seek(0)
            arrays = {"": _array(path, file, path.stat().st_size)}
    amplitude, stored = _the_matrix(path, arrays), _stored(arrays)
    if {"dx", "dz"} <= stored.keys() and choices.extent is None:
        return section_of(path, amplitude, choices, **stored | choices.given(OF_AXES))
    return section_of(path, amplitude, choices, **stored | choices.axes(path, amplitude.shape))


def preview_array(path: Path, choices: OpenOptions) -> SectionInfo:
    """What an array's file holds, from its header; an .npz file has to be read."""
    choices.refuse(OF_SEGY, "an array")
    stored = {}
    with _honest(path, ANEW), path.open("rb") as file:
        if zipfile.is_zipfile(file):
            arrays = _of_npz(path, file)
            array, stored = _the_matrix(path, arrays), _stored(arrays)
            shape, dtype = array.shape, array.dtype
        else:
            file.seek(0)
            shape, _, dtype = _header(path, file, path.stat().st_size)
            checked_shape(path, shape)
    needed = () if {"dx", "dz"} <= stored.keys() else (AXES,)
    needed += () if "velocity" in stored or stored.get("z_unit") in tuple(METRES) else (HEIGHT,)
    return SectionInfo(path, "array", str(dtype), path.stat().st_size, shape, needed)


def open_text(path: Path, choices: OpenOptions, _progress: Progress | None) -> Section:
    """A section of a text: a line a sample, a column a trace, parted by blanks, commas or semicolons; # for remarks.

    Raises
    ------
    DataError
        If the text is no matrix of numbers.
    SettingError
        If its axes or units are not said.
    """
    choices.refuse(OF_SEGY, "a text")
    choices.time_or_depth(path)
    amplitude = _numbers(path)
    return section_of(path, amplitude, choices, **choices.axes(path, amplitude.shape))


def preview_text(path: Path, choices: OpenOptions) -> SectionInfo:
    """What a text holds; only its first row is read as numbers."""
    choices.refuse(OF_SEGY, "a text")
    columns = _numbers(path, rows=1).shape[-1]
    with _honest(path, PLAIN), path.open(encoding="utf-8-sig") as file:
        rows = sum(bool(line.partition("#")[0].strip()) for line in file)
    checked_shape(path, (rows, columns))
    return SectionInfo(path, "text", "numbers", path.stat().st_size, (rows, columns), (AXES, HEIGHT))


@contextmanager
def _honest(path, remedy):
    """Whatever goes wrong while a file is read says so of the file, in our words."""
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # about old headers and empty texts, which are checked here
            yield
    except SeiswidgetsError:
        raise
    except (*DAMAGED, tokenize.TokenError, lzma.LZMAError, zipfile.BadZipFile, zlib.error) as error:
        raise DataError(f"{path} is damaged, or no matrix of numbers: {shortened(str(error))}; {remedy}") from error


def _of_npz(path, file):
    """The arrays of an .npz file, by name; beside an amplitude only what tells where it is."""
    with zipfile.ZipFile(file) as archive:
        infos = {info.filename.removesuffix(".npy"): info for info in archive.infolist()}
        if "amplitude" in infos:
            infos = {name: infos[name] for name in ("amplitude", *STORED) if name in infos}
        checked_size(path, (sum(info.file_size for info in infos.values()),), itemsize=1)
        found = {}
        for name, info in infos.items():
            with archive.open(info) as member:
                found[name] = _array(f"{path}: {name}", member, info.file_size)
    return found


def _stored(arrays):
    """What an .npz file says of its section, names as text whatever they are there."""
    found = {name: arrays[name].item() for name in STORED if name in arrays and arrays[name].ndim == 0}
    return found | {name: str(found[name]) for name in ("name", "credit") if name in found}


def _the_matrix(path, arrays):
    """The amplitude, or else the only matrix that there is."""
    matrices = [array for array in arrays.values() if array.ndim == 2]
    array = arrays.get("amplitude", matrices[0] if len(matrices) == 1 else None)
    if array is None or array.dtype.kind not in "fiub":
        held = ", ".join(f"{name or 'one'} of shape {array.shape}" for name, array in arrays.items())
        raise DataError(
            f"{path} must hold one matrix of real numbers, or one called 'amplitude', but holds "
            f"{shortened(held) or 'none'}: write it so"
        )
    checked_shape(path, array.shape)
    return array


def _array(path, file, size):
    """An array of numbers or text in NumPy's format."""
    shape, by_columns, dtype = _header(path, file, size)
    return np.frombuffer(file.read(), dtype).reshape(shape, order="F" if by_columns else "C")


def _header(path, file, size):
    """Shape, order and dtype of an array in NumPy's format, held against its size before more of it is read."""
    version = npy.read_magic(file)
    if version not in ((1, 0), (2, 0)):
        raise DataError(f"{path} is of version {version} of NumPy's format, which no matrix of numbers needs")
    read = npy.read_array_header_1_0 if version == (1, 0) else npy.read_array_header_2_0
    shape, by_columns, dtype = read(file)
    if dtype.kind not in "fiubU":
        raise DataError(f"{path} holds {dtype}, not real numbers; nothing else is read from an array's file")
    checked_size(path, shape, dtype.itemsize if dtype == np.float32 else max(dtype.itemsize, 8))  # as a section has it
    count, left = dtype.itemsize * prod(shape), size - file.tell()
    if min(shape, default=0) < 0 or count != left:
        raise DataError(
            f"{path} says that it holds an array of shape {shape}, {count} bytes, but has {left} after its header; "
            "it was cut short, or is damaged: write it anew"
        )
    return shape, by_columns, dtype


def _numbers(path, rows=None):
    """Numbers of a text, float64, by whichever delimiter it has."""
    size = path.stat().st_size
    if size > MOST_TEXT:
        raise DataError(
            f"{path} is a text of {size:,} bytes; there may be {MOST_TEXT:,}: save it by numpy.save instead"
        )
    with _honest(path, PLAIN):
        with path.open(encoding="utf-8-sig") as file:
            first = next((line for line in file if line.partition("#")[0].strip()), "")
        if len(first) > MOST_ROW:
            raise DataError(f"{path} has a first row of {len(first):,} characters; write a row for each sample")
        delimiter = next(mark for mark in DELIMITERS if mark is None or mark in first.partition("#")[0])
        try:
            return np.loadtxt(path, delimiter=delimiter, ndmin=2, max_rows=rows, encoding="utf-8-sig")
        except UnicodeDecodeError:
            raise
        except ValueError:
            _say_where(path, delimiter)
            raise


def _say_where(path, delimiter):
    """DataError that names the first row of a text that is none of numbers, or is not as long as those before it."""
    width = None
    with path.open(encoding="utf-8-sig") as file:
        for place, line in enumerate(file, 1):
            if not (row := line.partition("#")[0].strip()):
                continue
            values = row.split(delimiter)
            width = width or len(values)
            if len(values) != width:
                raise DataError(f"{path}: row {place} has {len(values)} values, and those before it {width}; {PLAIN}")
            if not _are_numbers(values):
                number, value = next(pair for pair in enumerate(values, 1) if not _are_numbers(pair[1:]))
                raise DataError(
                    f"{path}: row {place}, value {number} must be a number, but is {brief(value.strip())}; {PLAIN}"
                )


def _are_numbers(texts):
    try:
        list(map(float, texts))
    except ValueError:
        return False
    return True
