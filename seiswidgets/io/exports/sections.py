"""Export of sections to SEG-Y and .npz."""

from os import PathLike
from pathlib import Path
from typing import Unpack

import numpy as np

from seiswidgets.errors import Keyword, SettingError
from seiswidgets.geology.restoration import Restoration
from seiswidgets.geology.section import Section
from seiswidgets.geology.validation import finite_number
from seiswidgets.io.files import atomic_write, existing_file, output_path
from seiswidgets.io.options import SEGY_OPTIONS, LineKeywords, OpenOptions
from seiswidgets.io.rasters.arrays import STORED
from seiswidgets.io.segy.writing import write_segy
from seiswidgets.signatures import strict_keywords

SUFFIXES = (".sgy", ".segy", ".npz")


@strict_keywords
def save_section(
    section: Section | Restoration,
    path: str | PathLike,
    *,
    like: str | PathLike | None = None,
    x0: float = 0.0,
    **line: Unpack[LineKeywords],
) -> None:
    """Write a section, or the restored section of a restoration, as SEG-Y (.sgy, .segy) or NumPy's .npz.

    An .npz file keeps everything, and ``open_section`` needs only its path. SEG-Y is written as big-endian 4-byte IEEE
    floats, with 0 where there are no data (a trace without any is marked as dead), and its textual header says that
    the section was restored, not measured. When it is opened again, its line starts at x = 0 unless x0= is given.

    Parameters
    ----------
    section : Section or Restoration
    path : str or Path
        An existing file is replaced once the new one is complete.
    like : str or Path, optional
        For SEG-Y: the file that the original was opened from, whose headers are copied. Traces beyond its ends continue
        the numbers and positions of its line.
    x0, **line
        Line of ``like``, as given to ``open_section``.

    Raises
    ------
    SettingError
        If the path has another suffix, SEG-Y cannot hold the section, or an option has no meaning.
    DataError
        If the file cannot be written, or ``like`` cannot be read.
    """
    path = output_path(path, SUFFIXES)
    options = OpenOptions(x0=finite_number("x0", x0), **line)
    restored, section = (section, section.section) if isinstance(section, Restoration) else (None, section)
    if not isinstance(section, Section):
        raise SettingError(f"save_section takes a Section or a Restoration, but got a {type(section).__name__}")
    if path.suffix.lower() == ".npz":
        if like is not None or options.given(SEGY_OPTIONS):
            raise SettingError(
                f"{path} becomes an .npz file, which has no headers; leave ", Keyword("like"), " and its line out"
            )
        write_npz(section, path)
        return
    for name in options.given(SEGY_OPTIONS):
        if like is None:
            raise SettingError(Keyword(name), " selects a line of the file ", Keyword("like"), "; give that file too")
    write_segy(section, path, restored, None if like is None else existing_file(like), options)


def write_npz(section: Section, path: Path) -> None:
    """Write all of a section as arrays of an .npz file, named like its fields."""
    fields = {name: getattr(section, name) for name in STORED if getattr(section, name) is not None}
    with atomic_write(path) as draft, draft.open("wb") as file:
        np.savez_compressed(file, amplitude=section.amplitude, **fields)
