"""Picks as GeoJSON: one feature per pick, with the units and the version of the format beside the features."""

import warnings
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

from seiswidgets.errors import DataError
from seiswidgets.geology.bodies import BODY, Body
from seiswidgets.geology.picks import AUTO, CONSTRAIN, FAULT, HORIZON, USES, Fault, Horizon, Interpretation
from seiswidgets.io.document import Entry, json_text, read_json
from seiswidgets.io.picks.lines import FileLines, PickLine, choices_of

MARK = "seiswidgets_picks"  # a foreign member, as RFC 7946 allows
VERSION = 1
GEOMETRY = {
    FAULT: "LineString",
    HORIZON: "MultiLineString",
    BODY: "Polygon",
}  # as written


def read(path: Path) -> FileLines:
    """Read a FeatureCollection whose member ``seiswidgets_picks`` holds version, x_unit and z_unit.

    A fault is a LineString, a horizon a MultiLineString of its pieces, a body a Polygon; ``properties`` hold kind and
    name, and use and ends where they are not the usual ones. Positions are (x, z) on the section, not longitude and
    latitude. A GIS may have left out the member with the units, changed one kind of lines to the other, or added a
    third coordinate of 0.
    """
    document = read_json(path)
    lines = tuple(line for feature in document["features"].items() for line in _pick_lines(feature))
    empty = sum(feature["geometry"].value is None for feature in document["features"].items())
    if empty:
        message = f"{path}: left out {empty} feature{'s' if empty > 1 else ''} without a geometry"
        warnings.warn(message, stacklevel=4)  # points to the call of read_picks
    return FileLines(lines, *_units(document))


def _units(document: Entry) -> tuple[str | None, str | None]:
    """Units of x and z; None if the member that states them is missing."""
    if MARK not in document.members():
        return None, None
    mark = document[MARK]
    if (version := mark["version"].number()) > VERSION:
        raise DataError(
            f"{document.path} is in version {version:g} of the GeoJSON of seiswidgets, and this release reads up to "
            f"{VERSION}; update seiswidgets"
        )
    return mark["x_unit"].text(), mark["z_unit"].text()


def _pick_lines(feature: Entry) -> Iterator[PickLine]:
    properties, geometry = feature["properties"], feature["geometry"]
    if geometry.value is None:
        return iter(())
    kind = properties["kind"].text()
    if kind not in GEOMETRY:
        raise properties["kind"].error("'fault', 'horizon' or 'body'")
    geometry_type = geometry["type"].text()
    if geometry_type not in GEOMETRY.values() or (geometry_type == GEOMETRY[BODY]) != (kind == BODY):
        raise geometry["type"].error(f"{GEOMETRY[kind]!r} for a {kind}")
    coordinates = geometry["coordinates"]
    name = properties["name"].text()
    pieces = [coordinates] if geometry_type == GEOMETRY[FAULT] else list(coordinates.items())
    if not pieces:
        raise coordinates.error("a list of pieces")
    use, ends = (properties.optional(key, Entry.text, default) for key, default in (("use", CONSTRAIN), ("ends", AUTO)))
    if use not in USES and kind != BODY:
        raise properties["use"].error(f"one of {', '.join(USES)}")
    lines = (PickLine(kind, name, _flat(piece).points(), piece.location, use, ends) for piece in pieces)
    return map(_open, lines) if kind == BODY else lines


def _open(ring: PickLine) -> PickLine:
    """A ring of a Polygon without its last point, which repeats the first."""
    points = ring.points
    return replace(ring, points=points[:-1] if points[:1] == points[-1:] else points)


def _flat(line: Entry) -> Entry:
    """A line without the third coordinate of 0 that a GIS may have added to its points."""
    if not isinstance(line.value, list):
        return line
    is_extra = (isinstance(point, list) and len(point) > 2 and not any(point[2:]) for point in line.value)
    return replace(
        line, value=[point[:2] if extra else point for point, extra in zip(line.value, is_extra, strict=True)]
    )


def as_text(interpretation: Interpretation, x_unit: str, z_unit: str) -> str:
    """The GeoJSON document of an interpretation, with exact numbers."""
    faults = [_feature(fault, FAULT, fault.points.tolist()) for fault in interpretation.faults]
    horizons = [
        _feature(horizon, HORIZON, [piece.tolist() for piece in horizon.pieces]) for horizon in interpretation.horizons
    ]
    bodies = [
        _feature(body, BODY, [[*body.points.tolist(), body.points[0].tolist()]]) for body in interpretation.bodies
    ]
    mark = {"version": VERSION, "x_unit": x_unit, "z_unit": z_unit}
    return json_text({"type": "FeatureCollection", MARK: mark, "features": faults + horizons + bodies})


def _feature(pick: Fault | Horizon | Body, kind: str, coordinates: list) -> dict[str, object]:
    geometry = {"type": GEOMETRY[kind], "coordinates": coordinates}
    properties = {"kind": kind, "name": str(pick.name)}
    use, ends = choices_of(pick)
    properties |= ({"use": use} if use != CONSTRAIN else {}) | ({"ends": ends} if ends != AUTO else {})
    return {"type": "Feature", "properties": properties, "geometry": geometry}
