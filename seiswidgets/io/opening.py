"""Opening and previewing section files of every supported format."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from os import PathLike
from pathlib import Path
from typing import NamedTuple, Unpack
from zipfile import BadZipFile, ZipFile

from seiswidgets.errors import DataError
from seiswidgets.geology.section import Section
from seiswidgets.io.files import existing_file
from seiswidgets.io.info import SectionInfo
from seiswidgets.io.options import (
    DAMAGED,
    PICTURE_OPTIONS,
    LayoutKeywords,
    OpenKeywords,
    OpenOptions,
    Progress,
    report_progress,
)
from seiswidgets.io.rasters.arrays import open_array, open_text, preview_array, preview_text
from seiswidgets.io.rasters.images import open_picture, preview_picture
from seiswidgets.io.segy.layout import begins_like_segy
from seiswidgets.io.segy.reading import open_segy, preview_segy
from seiswidgets.signatures import strict_keywords


class Reader(NamedTuple):
    """Functions that open and preview one kind of file."""

    open: Callable[[Path, OpenOptions, Progress | None], Section]
    preview: Callable[[Path, OpenOptions], SectionInfo]


READERS = {
    "SEG-Y": Reader(open_segy, preview_segy),
    "picture": Reader(open_picture, preview_picture),
    "array": Reader(open_array, preview_array),
    "text": Reader(open_text, preview_text),
}
SIGNATURES = {  # first bytes of a file
    b"\x89PNG": "picture",
    b"\xff\xd8\xff": "picture",
    b"II*\0": "picture",
    b"MM\0*": "picture",
    b"II+\0": "picture",
    b"MM\0+": "picture",
    b"\x93NUMPY": "array",
    b"PK\3\4": "array",
}
ARCHIVES = {b"\x1f\x8b": "gzip", b"7z\xbc\xaf\x27\x1c": "7-Zip", b"Rar!\x1a\x07": "RAR"}
SUFFIXES = {
    **dict.fromkeys((".sgy", ".segy", ".seg"), "SEG-Y"),
    **dict.fromkeys((".png", ".jpg", ".jpeg", ".tif", ".tiff"), "picture"),
    **dict.fromkeys((".npy", ".npz"), "array"),
    **dict.fromkeys((".txt", ".csv", ".asc", ".ascii", ".tsv"), "text"),
}


@strict_keywords
def open_section(path: str | PathLike, *, progress: Progress | None = None, **options: Unpack[OpenKeywords]) -> Section:
    """Open a section file: SEG-Y, an image (PNG, JPEG, TIFF), NumPy's .npy or .npz, or a text matrix.

    The format is recognised by the content, or by the suffix where the content is ambiguous. If neither the file nor
    an option gives a value that is needed, the error names it. ``preview`` shows what a file holds and which options
    it needs.

    Parameters
    ----------
    path : str or Path
    progress : callable(share), optional
        Called with the share done while a file is read; returning False cancels.
    dx, dz, x0, z0 : float, optional
        Spacing and origin as in ``Section``; they take precedence over the file's. If left out, dx of SEG-Y is
        measured between the positions of the traces, which must be evenly spaced.
    extent : (x_min, x_max, z_min, z_max), optional
        For an image or a matrix, instead of spacing and origin: positions of the first and last trace and sample,
        which are the centres of its corner cells.
    crop : (left, right, top, bottom), optional
        For an image: the first and last column and the first and last row of pixels to keep, counted from 0. ``extent``
        is then that of the part that is kept.
    calibration : dict, optional
        For an image, instead of spacing and origin: two points with known values on each axis, in pixels of the whole
        image, as in ``{"x": [(120, 40, 0), (1480, 40, 10000)], "z": [(118, 60, 0), (118, 800, 2000)]}``, each a column,
        a row and a value. Values of z increase downwards; where those of x decrease to the right, the image is
        mirrored. A warning says so if an axis is rotated by more than a degree; ``"deskew": True`` straightens it.
    x_unit : str, optional
        Unit of dx or of the file's positions: metres, or feet where a SEG-Y file says so.
    z_unit : str, optional
        "m", "ft" or "km" if z is a depth; "ms" (the default when a velocity is given) or "s" if it is a two-way time.
    velocity : float, optional
        Seismic velocity in m/s; needed for time.
    name, credit : str, optional
        As in ``Section``; the name defaults to the file's name.
    inline, crossline : int, optional
        Number of the line to take from a SEG-Y volume; columns without a trace become NaN.
    offset : int, optional
        Offset of the traces to take from a SEG-Y file before stack.
    traces : slice or range, optional
        Traces to take from a SEG-Y file, counted from 0, whichever line they belong to.
    header_bytes : dict, optional
        Positions in SEG-Y's trace header, counted from byte 1, of "x", "y", "scalar" (for both), "inline", "crossline"
        and "offset"; by default 181, 185, 71, 189, 193 and 37, as in the standard. A tuple adds width and kind, as in
        ``{"x": (181, "f4"), "inline": (17, "i2")}``: i2, u2, i4, u4, f4, f8 or ibm.
    sample_format : str or int, optional
        Format of SEG-Y's samples if the header does not state the true one: "ibm", "ieee", "f4", "f8", "i1", "i2",
        "i4", "u1", "u2", "u4", or the standard's code; "<i2" and ">i2" give their byte order too.
    byte_order : {"big", "little"}, optional
        Byte order of a SEG-Y file.
    revision : {0, 1, 2}, optional
        Revision of the SEG-Y standard that a file follows, which says what some bytes mean.

    Raises
    ------
    DataError
        If the file is missing, damaged, too large, in an unsupported format, or lacks a value that was not given; or
        if a package that it needs is not installed.
    SettingError, SectionError
        If an option is missing or invalid.
    Cancelled
        If ``progress`` returned False.
    """
    path = existing_file(path)
    checked = OpenOptions(**options)
    with _read_errors_as_data_errors(path):
        kind = _kind(path)
        if kind != "picture":
            checked.refuse(PICTURE_OPTIONS, f"{kind}; only a picture can be cropped or calibrated")
        section = READERS[kind].open(path, checked, progress)
    report_progress(progress, 1.0)
    return section


@strict_keywords
def preview(path: str | PathLike, **options: Unpack[LayoutKeywords]) -> SectionInfo:
    """Summarise a section file and the options that it needs, without reading all of it.

    Parameters
    ----------
    path : str or Path
    header_bytes, sample_format, byte_order, revision
        For SEG-Y, as for ``open_section``.

    Raises
    ------
    DataError, SettingError
        As for ``open_section``.
    """
    path, checked = existing_file(path), OpenOptions(**options)
    with _read_errors_as_data_errors(path):
        return READERS[_kind(path)].preview(path, checked)


def kind_of(path: str | PathLike) -> str:
    """Kind of a section file: "SEG-Y", "picture", "array" or "text".

    Raises
    ------
    DataError
        If the file is missing or in an unsupported format.
    """
    path = existing_file(path)
    with _read_errors_as_data_errors(path):
        return _kind(path)


@contextmanager
def _read_errors_as_data_errors(path: Path) -> Iterator[None]:
    try:
        yield
    except OSError as error:
        if isinstance(error, DataError):
            raise
        raise DataError(f"{path} cannot be read: {error}") from error


def _kind(path: Path) -> str:
    """Recognise a file by its first bytes, then by its suffix, or as text where it looks like numbers."""
    with path.open("rb") as file:
        head = file.read(4096)
    if not head:
        raise DataError(f"{path} is empty; copy it again from its source")
    _refuse_archives(path, head)
    for signature, kind in SIGNATURES.items():
        if head.startswith(signature):
            return kind
    by_suffix = SUFFIXES.get(path.suffix.lower())
    if by_suffix in ("SEG-Y", "text"):
        return by_suffix
    if by_suffix is not None:
        raise DataError(
            f"{path} has the suffix {path.suffix}, but does not begin like such a file; it is damaged or misnamed: "
            "save it again"
        )
    if begins_like_segy(head):
        return "SEG-Y"
    if _looks_like_numbers(head):
        return "text"
    raise DataError(
        f"{path} is in an unsupported file format; convert it to SEG-Y, PNG, JPEG, TIFF, .npy, .npz or a text matrix"
    )


def _refuse_archives(path: Path, head: bytes) -> None:
    """Raise DataError for a packed file, unless it is an .npz."""
    for signature, kind in ARCHIVES.items():
        if head.startswith(signature):
            raise DataError(f"{path} is packed with {kind}; unpack it, and open the file that it holds")
    if head.startswith(b"PK\3\4"):
        names = _files_in_zip(path)
        if names and not any(name.endswith(".npy") for name in names):
            raise DataError(
                f"{path} is a zip archive; unzip it, and open the file that it holds: {', '.join(map(repr, names[:3]))}"
                f"{', ...' if len(names) > 3 else ''}"
            )


def _files_in_zip(path: Path) -> list[str]:
    """Names of the files in a zip archive; none if it is damaged, which is reported when it is read."""
    try:
        with ZipFile(path) as archive:
            return [name for name in archive.namelist() if not name.endswith("/")]
    except (BadZipFile, *DAMAGED):
        return []


def _looks_like_numbers(head: bytes) -> bool:
    return set(head[:1000]) <= set(b"0123456789+-.eE,;nNaA \t\r\n")
