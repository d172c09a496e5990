"""Picks as GeoJSON: one feature per pick, with the units and the version of the format beside the features."""

from collections.abc import Iterator
from pathlib import Path

from seiswidgets.errors import DataError
from seiswidgets.geology.picks import FAULT, HORIZON, Interpretation
from seiswidgets.io.document import Entry, json_text, read_json
from seiswidgets.io.picks.lines import FileLines, PickLine

MARK = "seiswidgets_picks"  # a foreign member, as RFC 7946 allows
VERSION = 1
GEOMETRY = {FAULT: "LineString", HORIZON: "MultiLineString"}


def read(path: Path) -> FileLines:
    """Read a FeatureCollection whose member ``seiswidgets_picks`` holds version, x_unit and z_unit.

    A fault is a LineString, a horizon a MultiLineString of its pieces; ``properties`` hold kind and name. Positions
    are (x, z) on the section, not longitude and latitude.
    """
    document = read_json(path)
    if MARK not in document.members():
        raise DataError(
            f"{path} is not GeoJSON of picks: it lacks {MARK!r}, which states their units; save picks with write_picks"
        )
    mark = document[MARK]
    if (version := mark["version"].number()) > VERSION:
        raise DataError(
            f"{path} is in version {version:g} of the GeoJSON of seiswidgets, and this release reads up to {VERSION}; "
            "update seiswidgets"
        )
    lines = tuple(line for feature in document["features"].items() for line in _pick_lines(feature))
    return FileLines(lines, mark["x_unit"].text(), mark["z_unit"].text())


def _pick_lines(feature: Entry) -> Iterator[PickLine]:
    properties, geometry = feature["properties"], feature["geometry"]
    kind = properties["kind"].text()
    if kind not in GEOMETRY:
        raise properties["kind"].error("'fault' or 'horizon'")
    if geometry["type"].text() != GEOMETRY[kind]:
        raise geometry["type"].error(f"{GEOMETRY[kind]!r} for a {kind}")
    coordinates = geometry["coordinates"]
    name = properties["name"].text()
    pieces = [coordinates] if kind == FAULT else list(coordinates.items())
    if not pieces:
        raise coordinates.error("a list of pieces")
    return (PickLine(kind, name, piece.points(), piece.location) for piece in pieces)


def as_text(interpretation: Interpretation, x_unit: str, z_unit: str) -> str:
    """The GeoJSON document of an interpretation, with exact numbers."""
    faults = [_feature(FAULT, fault.name, fault.points.tolist()) for fault in interpretation.faults]
    horizons = [
        _feature(HORIZON, horizon.name, [piece.tolist() for piece in horizon.pieces])
        for horizon in interpretation.horizons
    ]
    mark = {"version": VERSION, "x_unit": x_unit, "z_unit": z_unit}
    return json_text({"type": "FeatureCollection", MARK: mark, "features": faults + horizons})


def _feature(kind: str, name: str, coordinates: list) -> dict[str, object]:
    geometry = {"type": GEOMETRY[kind], "coordinates": coordinates}
    return {"type": "Feature", "properties": {"kind": kind, "name": str(name)}, "geometry": geometry}
