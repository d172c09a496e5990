"""A section from a file of any kind that we know."""

from collections.abc import Mapping
from contextlib import contextmanager
from os import PathLike

from seiswidgets.errors import DataError
from seiswidgets.geology.section import Section
from seiswidgets.io.files import existing_file
from seiswidgets.io.info import SectionInfo
from seiswidgets.io.options import OpenOptions, Progress, tell
from seiswidgets.io.rasters.arrays import open_array, open_text, preview_array, preview_text
from seiswidgets.io.rasters.images import open_picture, preview_picture
from seiswidgets.io.segy.layout import begins_like_segy
from seiswidgets.io.segy.reading import open_segy, preview_segy

READERS = {
    "SEG-Y": (open_segy, preview_segy),
    "picture": (open_picture, preview_picture),
    "array": (open_array, preview_array),
    "text": (open_text, preview_text),
}
BEGINNINGS = {  # of a file's content
    b"\x89PNG": "picture",
    b"\xff\xd8\xff": "picture",
    b"II*\0": "picture",
    b"MM\0*": "picture",
    b"II+\0": "picture",
    b"MM\0+": "picture",
    b"\x93NUMPY": "array",
    b"PK\3\4": "array",
}
SUFFIXES = {
    **dict.fromkeys((".sgy", ".segy", ".seg"), "SEG-Y"),
    **dict.fromkeys((".png", ".jpg", ".jpeg", ".tif", ".tiff"), "picture"),
    **dict.fromkeys((".npy", ".npz"), "array"),
    **dict.fromkeys((".txt", ".csv", ".asc", ".ascii", ".tsv"), "text"),
}


def open_section(
    path: str | PathLike,
    *,
    dx: float | None = None,
    dz: float | None = None,
    x0: float | None = None,
    z0: float | None = None,
    extent: tuple[float, float, float, float] | None = None,
    x_unit: str | None = None,
    z_unit: str | None = None,
    velocity: float | None = None,
    name: str | None = None,
    credit: str | None = None,
    inline: int | None = None,
    crossline: int | None = None,
    traces: slice | range | None = None,
    header_bytes: Mapping[str, int] | None = None,
    progress: Progress | None = None,
) -> Section:
    """A section from a file: SEG-Y, a picture (PNG, JPEG, TIFF), NumPy's .npy or .npz, or a matrix of text.

    The kind is told by the content, and by the suffix where the content does not say. What neither the file nor the
    user says is asked for by an error. ``preview`` tells beforehand what a file holds and needs.

    Parameters
    ----------
    path : str or Path
    dx, dz, x0, z0 : float, optional
        Spacing and origin as in ``Section``; over what the file says. Of SEG-Y, dx is else measured between the
        positions of the traces, which must be even.
    extent : (x_min, x_max, z_min, z_max), optional
        Of a picture or a matrix, in place of spacing and origin: places of the first and the last trace and sample,
        which are the centres of its corners.
    x_unit : str, optional
        Of dx or of the file's positions: metres, or feet where a SEG-Y file says so.
    z_unit : str, optional
        "m", "ft" or "km" if z is a depth; "ms" (taken when a velocity is given) or "s" if it is a two-way time.
    velocity : float, optional
        In m/s; time needs it.
    name, credit : str, optional
        As in ``Section``; the file's name if left out.
    inline, crossline : int, optional
        Which line of a SEG-Y volume.
    traces : slice or range, optional
        Which traces of a SEG-Y file, counted from 0, whatever line they belong to.
    header_bytes : dict, optional
        At which byte of SEG-Y's trace header "x", "y", "scalar" (of both), "inline" and "crossline" stand, counted
        from 1; else at 181, 185, 71, 189, 193, where the standard has them.
    progress : callable(share), optional
        Called while a file is read, with the share done; returning False cancels.

    Raises
    ------
    DataError
        If the file is missing, damaged, too large, of no kind that we know, or lacks what was not given; or if a
        package that it takes is not installed.
    SettingError, SectionError
        If a choice is missing or cannot be.
    Cancelled
        If ``progress`` returned False.
    """
    path = existing_file(path)
    choices = OpenOptions(
        dx=dx,
        dz=dz,
        x0=x0,
        z0=z0,
        extent=extent,
        x_unit=x_unit,
        z_unit=z_unit,
        velocity=velocity,
        name=name,
        credit=credit,
        inline=inline,
        crossline=crossline,
        traces=traces,
        header_bytes=header_bytes,
    )
    with _readable(path):
        open_it, _ = READERS[_kind(path)]
        section = open_it(path, choices, progress)
    tell(progress, 1.0)
    return section


def preview(path: str | PathLike, *, header_bytes: Mapping[str, int] | None = None) -> SectionInfo:
    """What a file holds and which choices it needs, without reading it all.

    Parameters
    ----------
    path : str or Path
    header_bytes : dict, optional
        Of SEG-Y, as for ``open_section``.

    Raises
    ------
    DataError, SettingError
        As for ``open_section``.
    """
    path = existing_file(path)
    with _readable(path):
        _, preview_it = READERS[_kind(path)]
        return preview_it(path, OpenOptions(header_bytes=header_bytes))


def kind_of(path: str | PathLike) -> str:
    """The kind of a file: "SEG-Y", "picture", "array" or "text".

    Raises
    ------
    DataError
        If the file is missing, or of no kind that we know.
    """
    path = existing_file(path)
    with _readable(path):
        return _kind(path)


@contextmanager
def _readable(path):
    try:
        yield
    except OSError as error:
        if isinstance(error, DataError):
            raise
        raise DataError(f"{path} cannot be read: {error}") from error


def _kind(path):
    """The kind of a file: by how it begins, by its suffix, or as text where it looks like one."""
    with path.open("rb") as file:
        head = file.read(4096)
    if not head:
        raise DataError(f"{path} is empty; copy it again from where it came")
    for beginning, kind in BEGINNINGS.items():
        if head.startswith(beginning):
            return kind
    kind = SUFFIXES.get(path.suffix.lower())
    if kind in ("SEG-Y", "text"):
        return kind
    if kind is not None:
        raise DataError(
            f"{path} is called {path.suffix}, but does not begin like one; it is damaged, or misnamed: save it anew"
        )
    if begins_like_segy(head):
        return "SEG-Y"
    if _looks_like_text(head):
        return "text"
    raise DataError(
        f"{path} is of no kind that is read here; convert it to SEG-Y, PNG, JPEG, TIFF, .npy, .npz or a text of numbers"
    )


def _looks_like_text(head):
    """Whether a file begins with nothing but what numbers are written with."""
    return set(head[:1000]) <= set(b"0123456789+-.eE,;nNaA \t\r\n")
