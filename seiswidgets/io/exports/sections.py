"""Sections out: SEG-Y and .npz."""

from collections.abc import Mapping
from os import PathLike
from pathlib import Path

import numpy as np

from seiswidgets.errors import SettingError
from seiswidgets.geology.restoration import Restoration
from seiswidgets.geology.section import Section
from seiswidgets.geology.validation import finite_number
from seiswidgets.io.files import checked_path, existing_file, written
from seiswidgets.io.options import OF_SEGY, OpenOptions
from seiswidgets.io.rasters.arrays import STORED
from seiswidgets.io.segy.writing import write_segy

SUFFIXES = (".sgy", ".segy", ".npz")


def save_section(
    section: Section | Restoration,
    path: str | PathLike,
    *,
    like: str | PathLike | None = None,
    inline: int | None = None,
    crossline: int | None = None,
    traces: slice | range | None = None,
    header_bytes: Mapping[str, int] | None = None,
    x0: float = 0.0,
):
    """Write a section, or the restored section of a restoration, as SEG-Y (.sgy, .segy) or NumPy's .npz.

    An .npz file keeps all of a section, and ``open_section`` needs no more than its path. SEG-Y is written in
    big-endian IEEE floats of 4 bytes, with 0 where there are no data (a trace without any is marked dead), and its
    textual header says that it was restored and is no measurement. Opened again, its line starts at x = 0: give x0=.

    Parameters
    ----------
    section : Section or Restoration
    path : str or Path
        A file that is there is replaced, but only when the new one is whole.
    like : str or Path, optional
        For SEG-Y: the file that the original was opened from, whose headers are carried over. Traces beyond its ends
        continue the numbers and positions of its line.
    inline, crossline, traces, header_bytes, x0
        Which line of ``like`` it is, as they were given to ``open_section``.

    Raises
    ------
    SettingError
        If the path ends otherwise, SEG-Y cannot hold the section, or a choice has no meaning.
    DataError
        If the file cannot be written, or ``like`` cannot be read.
    """
    path = checked_path(path, SUFFIXES)
    line = OpenOptions(
        inline=inline, crossline=crossline, traces=traces, header_bytes=header_bytes, x0=finite_number("x0", x0)
    )
    done = section if isinstance(section, Restoration) else None
    section = section.section if done else section
    if not isinstance(section, Section):
        raise SettingError(f"save_section takes a Section or a Restoration, but got a {type(section).__name__}")
    if path.suffix.lower() == ".npz":
        if like is not None or line.given(OF_SEGY):
            raise SettingError(f"{path} becomes an .npz file, which has no headers; leave like= and its line out")
        write_npz(section, path)
    elif like is None and line.given(OF_SEGY):
        raise SettingError(f"{', '.join(line.given(OF_SEGY))}= is of the line that like= holds; give that file too")
    else:
        write_segy(section, path, done, None if like is None else existing_file(like), line)


def write_npz(section: Section, path: Path):
    """Write all of a section as arrays of their names."""
    fields = {name: getattr(section, name) for name in STORED if getattr(section, name) is not None}
    with written(path) as draft, draft.open("wb") as file:
        np.savez_compressed(file, amplitude=section.amplitude, **fields)
