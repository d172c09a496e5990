"""The two doors: picks from a file, and picks into one."""

import os

from seiswidgets.errors import DataError, SettingError
from seiswidgets.geology.picks import Interpretation
from seiswidgets.geology.section import METRES, Section
from seiswidgets.geology.validation import checked_kind
from seiswidgets.io.document import LARGEST_OURS, check_size, shortened
from seiswidgets.io.files import user_path, write_whole
from seiswidgets.io.picks import charisma, cps3, geojson, opendtect, table
from seiswidgets.io.picks.lines import FileLines, PickLine, in_section_units, interpretation, without_single_points
from seiswidgets.io.picks.map_points import Along, ExportOptions

OURS = {"geojson": geojson, "csv": table}
EXPORTS = {
    "opendtect-horizons": opendtect.read_horizons,
    "opendtect-faults": opendtect.read_faults,
    "charisma-horizons": charisma.read_horizons,
    "charisma-faults": charisma.read_faults,
    "cps3-horizons": cps3.read_horizons,
    "cps3-faults": cps3.read_faults,
}
SUFFIXES = {".geojson": "geojson", ".json": "geojson", ".csv": "csv"}


def read_picks(
    path: str | os.PathLike,
    section: Section,
    *,
    format: str | None = None,  # noqa: A002 - the word that everybody looks for
    x_unit: str | None = None,
    z_unit: str | None = None,
    z_up: bool = False,
    along: Along | None = None,
    line: str | None = None,
) -> Interpretation:
    """Faults and horizons from a file, in the units of a section.

    Parameters
    ----------
    path : path
    section : Section
        What they were picked on.
    format : str, optional
        "geojson" or "csv", told by the suffix if left out; or an export of another program: "opendtect-horizons",
        "opendtect-faults", "charisma-horizons", "charisma-faults" (both of Petrel too), "cps3-horizons" or
        "cps3-faults". The docs list the columns of each.
    x_unit, z_unit : str, optional
        The file's units, as for a Section; needed where it does not state them.
    z_up : bool
        Whether the file's z grows upwards, as elevations from Petrel do; their sign is turned.
    along : optional
        For exports: where on the section a place (X, Y) on the map is. "x" or "y" takes that column; a list of the
        line's own map coordinates [(X, Y), ...] from the section's first trace on takes the distance along it; a
        function of three arrays, X, Y and the trace number, returns x.
    line : str, optional
        For exports of several seismic lines: the one to take. For Charisma, "inline 362" or "xline 800".

    Raises
    ------
    DataError
        If the file cannot be read as picks; the message names the file, the place in it, and what to do.
    SettingError
        If the format is not known, a choice has no meaning for it, or an argument is of another kind.

    Warns
    -----
    UserWarning
        If single points of an export were left out, because they make no line.
    """
    path = user_path(path)
    checked_kind(section, Section, "section")
    if z_up not in (True, False):  # "no" would turn the picks over
        raise SettingError(f"z_up must be True or False, but is {z_up!r}")
    chosen = _format(path, format, (*OURS, *EXPORTS))
    if chosen in OURS:
        if along is not None or line is not None:
            raise SettingError(
                f"along= and line= have no meaning for {chosen}, which is of one section; leave them out"
            )
        found = OURS[chosen].read(path)
        lines = found.lines
    else:
        here = METRES[section.x_unit]
        start = section.x0 * here / METRES.get(x_unit, here)  # in the file's unit, as all that it gives
        found = EXPORTS[chosen](path, ExportOptions(line, along, start))
        lines = without_single_points(path, found.lines)
        if not z_up:
            _check_sign(path, lines, section)
    found = FileLines(
        _turned(lines) if z_up else lines,
        _unit(path, "x_unit", found.x_unit, x_unit),
        _unit(path, "z_unit", found.z_unit, z_unit),
    )
    return interpretation(path, in_section_units(path, found, section) if found.lines else ())


def write_picks(
    interpretation: Interpretation,
    path: str | os.PathLike,
    section: Section,
    *,
    format: str | None = None,  # noqa: A002
) -> None:
    """Write faults and horizons to a file, which states the units; `read_picks` gives back the very same numbers.

    Parameters
    ----------
    interpretation : Interpretation
    path : path
        An older file of that name is replaced once the new one is complete.
    section : Section
        Gives the units.
    format : {"geojson", "csv"}, optional
        Told by the suffix if left out.

    Raises
    ------
    DataError
        If the file cannot be written, or is too large to be read again.
    SettingError
        If the format is not one of these, or an argument is of another kind.
    """
    path = user_path(path)
    checked_kind(interpretation, Interpretation, "interpretation")
    checked_kind(section, Section, "section")
    module = OURS[_format(path, format, tuple(OURS))]
    text = module.text(interpretation, section.x_unit, section.z_unit)
    try:
        content = text.encode()
    except UnicodeEncodeError as error:
        raise DataError(f"{path}: a name holds half a character, {error.object[error.start]!r}; rename it") from None
    check_size(path, content, LARGEST_OURS)
    write_whole(path, content)


def _format(path, asked, known):
    chosen = SUFFIXES.get(path.suffix.lower()) if asked is None else asked
    if chosen is None:
        raise SettingError(f"{path}: its format cannot be told by its suffix; give format=, one of {', '.join(known)}")
    if chosen not in known:
        raise SettingError(f"format must be one of {', '.join(known)}, but is {chosen!r}")
    return chosen


def _unit(path, axis, stated, given):
    """The file's unit, stated or given; both must not differ."""
    if stated is not None and given is not None and stated != given:
        raise DataError(
            f"{path} states {axis} {shortened(repr(stated))}, but {axis}={given!r} is given; leave that out, or "
            "correct the file"
        )
    return given if stated is None else stated


def _turned(lines):
    """The lines with z down."""
    return tuple(PickLine(line.kind, line.name, tuple((x, -z) for x, z in line.points), line.place) for line in lines)


def _check_sign(path, lines, section):
    """Refuse an export whose z must grow upwards, though nobody said so."""
    if lines and section.z0 >= 0 and all(z < 0 for line in lines for _, z in line.points):
        raise DataError(f"{path}: all z are negative, so they seem to grow upwards; if so, say it by z_up=True")
