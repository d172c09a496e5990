"""Public functions that read picks from a file and write them to one."""

import os
from collections.abc import Callable, Iterable
from dataclasses import replace
from pathlib import Path
from typing import NamedTuple

import numpy as np

from seiswidgets.errors import DataError, Keyword, SettingError
from seiswidgets.geology.picks import Interpretation
from seiswidgets.geology.section import Section
from seiswidgets.geology.validation import checked_kind
from seiswidgets.io.document import check_file_size, read_text, shortened
from seiswidgets.io.files import user_path, write_file
from seiswidgets.io.picks import charisma, cps3, export_writing, geojson, iesx, named_columns, opendtect, table
from seiswidgets.io.picks.lines import (
    FileLines,
    PickLine,
    build_interpretation,
    in_section_units,
    without_single_points,
)
from seiswidgets.io.picks.map_points import Along, ExportOptions
from seiswidgets.io.picks.recognition import refuse_other_formats
from seiswidgets.signatures import strict_keywords


class PickFormat(NamedTuple):
    """Functions that read and write one of the formats of seiswidgets."""

    read: Callable[[Path], FileLines]
    as_text: Callable[[Interpretation, str, str], str]


OWN_FORMATS = {"geojson": PickFormat(geojson.read, geojson.as_text), "csv": PickFormat(table.read, table.as_text)}
EXPORTS = {
    "opendtect-horizons": opendtect.read_horizons,
    "opendtect-faults": opendtect.read_faults,
    "charisma-horizons": charisma.read_horizons,
    "charisma-faults": charisma.read_faults,
    "cps3-horizons": cps3.read_horizons,
    "cps3-faults": cps3.read_faults,
    "iesx-horizons": iesx.read_horizons,
    "iesx-faults": iesx.read_faults,
    "earthvision-horizons": named_columns.read_horizons,
    "petrel-points": named_columns.read_petrel_points,
    "kingdom-horizons": named_columns.read_horizons,
    "kingdom-faults": named_columns.read_faults,
    "geographix-horizons": named_columns.read_horizons,
    "geographix-faults": named_columns.read_faults,
    "dug-horizons": named_columns.read_dug_horizons,
    "dug-faults": named_columns.read_dug_faults,
}
WRITERS = {
    "opendtect-horizons": export_writing.opendtect_horizons,
    "opendtect-faults": export_writing.opendtect_faults,
    "petrel-points": export_writing.petrel_points,
}
SPOT = 1e-3  # of a section's width and height: picks no larger than this are in another unit
SUFFIXES = {".geojson": "geojson", ".json": "geojson", ".csv": "csv"}


@strict_keywords
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
    """Read faults and horizons from a file, in the units of a section.

    Parameters
    ----------
    path : path
    section : Section
        The section that they were picked on.
    format : str, optional
        "geojson" or "csv", recognised by the suffix if left out; or an export of another program: "opendtect-horizons",
        "opendtect-faults", "charisma-horizons", "charisma-faults", "iesx-horizons", "iesx-faults", "cps3-horizons",
        "cps3-faults", "earthvision-horizons", "petrel-points" (Petrel writes all of these), "kingdom-horizons",
        "kingdom-faults", "geographix-horizons", "geographix-faults", "dug-horizons" or "dug-faults". The docs list the
        columns of each.
    x_unit, z_unit : str, optional
        Units of the file, as for a Section; needed if it does not state them.
    z_up : bool
        Whether the file's z grows upwards, like elevations from Petrel; its sign is then changed.
    along : optional
        For exports: how positions (X, Y) on the map become positions along the section. "x" or "y" takes that column;
        a list of the line's own map coordinates [(X, Y), ...], from the section's first trace on, takes the distance
        along it; a function of three arrays, X, Y and the trace number, returns x.
    line : str, optional
        For exports of several seismic lines: the one to take; of a 3-D survey, "inline 362" or "xline 800".

    Raises
    ------
    DataError
        If the file cannot be read as picks; the message names the file, the location in it, and what to do.
    SettingError
        If the format is unknown, an option has no meaning for it, or an argument has the wrong type.

    Warns
    -----
    UserWarning
        If single points of an export were left out, because they cannot form a line.
    """
    path = user_path(path)
    checked_kind(section, Section, "section")
    if z_up not in (True, False):  # a truthy "no" would turn the picks over
        raise SettingError(Keyword("z_up"), f" must be True or False, but is {z_up!r}")
    format_name = _checked_format(path, format, (*OWN_FORMATS, *EXPORTS))
    if format_name in OWN_FORMATS:
        _refuse_export_options(format_name, along, line)
        file_lines = OWN_FORMATS[format_name].read(path)
    else:
        file_lines = _read_export(path, format_name, ExportOptions(line, along))
        file_lines = replace(file_lines, lines=without_single_points(path, file_lines.lines))
        if not z_up:
            _check_sign(path, file_lines.lines, section)
    states_units = file_lines.x_unit is not None
    file_lines = FileLines(
        tuple(_flipped(line) for line in file_lines.lines) if z_up else file_lines.lines,
        _agreed_unit(path, "x_unit", file_lines.x_unit, x_unit),
        _agreed_unit(path, "z_unit", file_lines.z_unit, z_unit),
    )
    lines = in_section_units(path, file_lines, section) if file_lines.lines else ()
    if not (along is None or isinstance(along, str) or callable(along)):  # distances from the first trace
        lines = tuple(replace(each, points=tuple((section.x0 + x, z) for x, z in each.points)) for each in lines)
    if format_name == "geojson" and not states_units:
        _check_degrees(path, lines, section)
    return build_interpretation(path, lines)


@strict_keywords
def write_picks(
    interpretation: Interpretation,
    path: str | os.PathLike,
    section: Section,
    *,
    format: str | None = None,  # noqa: A002
    along: Along | None = None,
    line: str | None = None,
) -> None:
    """Write faults and horizons to a file.

    GeoJSON and CSV state their units, and `read_picks` returns exactly the same numbers. The formats of other programs
    have positions on a map: OpendTect's horizons are sampled at the traces, and its files hold either horizons or
    faults; Petrel's points hold both, with Z negative downwards (give ``z_up=True`` to read them again). Only GeoJSON
    and CSV hold bodies, and the use and the ends of picks.

    Parameters
    ----------
    interpretation : Interpretation
    path : path
        An existing file is replaced once the new one is complete.
    section : Section
        The section that they were picked on, which has the units.
    format : {"geojson", "csv", "opendtect-horizons", "opendtect-faults", "petrel-points"}, optional
        GeoJSON and CSV are chosen by the suffix if it is left out.
    along : optional
        For other programs: "x" or "y" if the section runs along that axis of the map, or the line's own map coordinates
        [(X, Y), ...], from the section's first trace on, in its unit of x.
    line : str, optional
        For OpendTect: name of the seismic line; by default the section's name.

    Raises
    ------
    DataError
        If the file cannot be written, or is too large to be read again.
    SettingError
        If the format is not one of these, or an argument has the wrong type.
    """
    path = user_path(path)
    checked_kind(interpretation, Interpretation, "interpretation")
    checked_kind(section, Section, "section")
    format_name = _checked_format(path, format, (*OWN_FORMATS, *WRITERS))
    if format_name in WRITERS:
        route = export_writing.ExportRoute(path, section, along, line or section.name or "line")
        text = WRITERS[format_name](interpretation, route)
    else:
        _refuse_export_options(format_name, along, line)
        text = OWN_FORMATS[format_name].as_text(interpretation, section.x_unit, section.z_unit)
    try:
        content = text.encode()
    except UnicodeEncodeError as error:
        raise DataError(
            f"{path}: a name contains an unpaired surrogate, {error.object[error.start]!r}; rename that pick"
        ) from None
    check_file_size(path, content)
    write_file(path, content)


def _read_export(path: Path, format_name: str, options: ExportOptions) -> FileLines:
    """Read an export, unless it shows the marks of another format."""
    text = read_text(path)
    family, _, kind = format_name.partition("-")
    refuse_other_formats(path, text, family, kind, tuple(EXPORTS))
    return EXPORTS[format_name](path, text, options)


def _checked_format(path: Path, given: str | None, known: tuple[str, ...]) -> str:
    name = SUFFIXES.get(path.suffix.lower()) if given is None else given
    if name is None:
        raise SettingError(
            f"{path}: its suffix does not tell its format; give ", Keyword("format"), f", one of {', '.join(known)}"
        )
    if name not in known:
        raise SettingError(Keyword("format"), f" must be one of {', '.join(known)}, but is {name!r}")
    return name


def _refuse_export_options(format_name: str, along: Along | None, line: str | None) -> None:
    for keyword, value in (("along", along), ("line", line)):
        if value is not None:
            raise SettingError(
                Keyword(keyword), f" has no meaning for {format_name}, which is of one section; leave it out"
            )


def _agreed_unit(path: Path, axis: str, stated: str | None, given: str | None) -> str | None:
    """The unit that the file states or the user gave; they must not differ."""
    if stated is not None and given is not None and stated != given:
        raise DataError(
            f"{path} states {axis} {shortened(repr(stated))}, but ",
            Keyword(axis, given),
            " is given; leave that out, or correct the file",
        )
    return given if stated is None else stated


def _flipped(line: PickLine) -> PickLine:
    """The line with the sign of z changed."""
    return replace(line, points=tuple((x, -z) for x, z in line.points))


def _check_degrees(path: Path, lines: Iterable[PickLine], section: Section) -> None:
    """Raise DataError for picks that a GIS has converted to degrees: all of them are at one spot of the section."""
    points = np.array([point for line in lines for point in line.points])
    x_min, x_max, z_min, z_max = section.extent
    if len(points) and (np.ptp(points, axis=0) < SPOT * np.array([x_max - x_min, z_max - z_min])).all():
        x, z = points[0].tolist()
        raise DataError(
            f"{path}: all picks lie within {SPOT:.1%} of the section, near x={x:g}, z={z:g}, so they seem to be in "
            "degrees; save them from the GIS in the layer's own coordinates, without a conversion to WGS 84"
        )


def _check_sign(path: Path, lines: Iterable[PickLine], section: Section) -> None:
    """Raise DataError for an export whose z seems to grow upwards."""
    depths = [z for line in lines for _, z in line.points]
    if depths and section.z0 >= 0 and max(depths) < 0:
        raise DataError(f"{path}: all z are negative, so z seems to grow upwards; if so, give ", Keyword("z_up", True))
